//! Computes the forces of all contacts at one instant; updates the tangential springs and the energy balance.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::contact::{Contact, ContactKey, ContactPoint, Feature, LONGEST_SUBSTEP, Substep};
use super::kinematics::{ContactMotion, Motion};
use super::law::{ContactLaw, Rolling};
use super::motion::Load;
use super::record::{ContactRecords, ForceStep, RunningRecord};
use super::search::ground::places_between;
use super::setup::{BodyKind, Ground, MaterialPair, RigidSetup};

/// Energy balance of all bodies [J]. For constant gravity, kinetic + potential + elastic + friction + damping -
/// load_work is constant. Small errors come from the time stepping, and from the change of the tangential stiffness
/// with the overlap.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy of translation and rotation.
    pub kinetic: f64,
    /// Potential energy of gravity; 0 for a centre of mass at the origin.
    pub potential: f64,
    /// Elastic energy stored in contacts.
    pub elastic: f64,
    /// Energy dissipated by friction since the start.
    pub friction: f64,
    /// Energy dissipated by the dashpots since the start.
    pub damping: f64,
    /// Work of the external loads since the start.
    pub load_work: f64,
}

/// Contact laws of all pairs of surfaces.
#[derive(Debug, Clone)]
pub struct Laws {
    kinds: Vec<LawsOfKind>,
    /// For each cover, the first and the last number of the ground elements under it.
    covers: Vec<[u32; 2]>,
    /// Number of the first element of each triangle surface.
    first_places: Vec<u32>,
    least_radius: f64,
}

/// Contact laws of the bodies of one kind.
#[derive(Debug, Clone)]
struct LawsOfKind {
    /// With each kind of body.
    bodies: Vec<ContactLaw>,
    ground: ContactLaw,
    /// With each cover of the ground.
    covers: Vec<ContactLaw>,
    /// With each triangle surface.
    surfaces: Vec<ContactLaw>,
    wall: ContactLaw,
    /// Mass [kg]; infinite for fixed bodies.
    mass: f64,
    /// Lower bound of the principal moments of inertia [kg m2].
    least_inertia: f64,
}

/// State that an evaluation of all contacts advances.
pub struct ContactResults<'a> {
    /// Total contact load on each body.
    pub loads: &'a mut [Load],
    /// Active contacts, sorted by key; before the evaluation, those of the last evaluation.
    pub contacts: &'a mut Vec<Contact>,
    /// Energy balance.
    pub energy: &'a mut Energy,
    /// Records of the active contacts, in the order of `contacts`.
    pub records: &'a mut ContactRecords,
}

/// Memory of an evaluation.
#[derive(Debug, Clone, Default)]
pub struct EvaluationMemory {
    /// Stiffness of the contacts of each body [N/m].
    stiffness: Vec<f64>,
    /// Contacts of the last evaluation, whether each of them continues, and their records.
    before: Vec<Contact>,
    used: Vec<bool>,
    old_records: Vec<Option<RunningRecord>>,
}

impl Laws {
    /// Creates the contact laws. On ground and walls, effective mass and radius are those of the body. Between two
    /// bodies, they are half of the harmonic mean: m = m_a m_b / (m_a + m_b), R = R_a R_b / (R_a + R_b).
    pub fn new(setup: &RigidSetup) -> Self {
        let covers_of = |ground: &Ground| -> Vec<[u32; 2]> {
            ground.covers.iter().map(|cover| places_between(&ground.profile, cover.x)).collect()
        };
        let covers = setup.ground.as_ref().map(covers_of).unwrap_or_default();
        let least_radius = setup.kinds.iter().map(rounding).fold(f64::MAX, f64::min);
        let beta = |pair: &MaterialPair| {
            let [a, b] = pair.between.map(|index| &setup.materials[index]);
            ContactLaw::damping_factor(setup.model, a, b, pair.resistance)
        };
        let betas: Vec<f64> = setup.pairs.iter().map(beta).collect();
        let kinds = setup.kinds.iter().map(|kind| LawsOfKind::new(kind, setup, &betas)).collect();
        Self { kinds, covers, first_places: setup.first_places().collect(), least_radius }
    }

    fn law_of(&self, pair: &ContactMotion) -> &ContactLaw {
        let [kind, other] = pair.kinds();
        let laws = &self.kinds[kind];
        match pair.point.key.feature {
            Feature::Unit { .. } => &laws.bodies[other],
            Feature::Ground { place, .. } => {
                let cover = self.covers.iter().rposition(|[first, last]| (*first..=*last).contains(&place));
                cover.map_or(&laws.ground, |cover| &laws.covers[cover])
            }
            Feature::Terrain { place, .. } => {
                &laws.surfaces[self.first_places.partition_point(|first| *first <= place) - 1]
            }
            Feature::Wall { .. } => &laws.wall,
        }
    }

    /// Computes the forces at the contact points. Returns an upper bound of the squared angular frequency of a body on
    /// its contact springs [1/s2].
    pub fn evaluate(
        &self,
        contact_points: &[ContactPoint],
        motion: &Motion,
        results: ContactResults,
        memory: &mut EvaluationMemory,
    ) -> f64 {
        let ContactResults { loads, contacts, energy, records } = results;
        let EvaluationMemory { stiffness, before, used, old_records } = memory;
        let substep = motion.substep;
        std::mem::swap(contacts, before);
        contacts.clear();
        loads.fill(Load::default());
        stiffness.clear();
        stiffness.resize(loads.len(), 0.0);
        used.clear();
        used.resize(before.len(), false);
        old_records.clear();
        old_records.extend(records.running.drain(..).map(Some));
        energy.elastic = 0.0;
        for point in contact_points {
            let pair = ContactMotion::new(point, motion);
            self.add_stiffness(&pair, stiffness);
            if point.overlap <= 0.0 {
                continue;
            }
            let previous = find(before, used, contact_points, point, self.least_radius);
            if let Some(index) = previous.filter(|_| motion.is_held(&point.key)) {
                let contact = before[index].held(substep);
                pair.add_force(contact.force, loads);
                pair.add_torque(contact.rolling_torque, loads);
                energy.elastic += contact.elastic.iter().sum::<f64>();
                records.running.extend(old_records[index].take());
                contacts.push(contact);
                continue;
            }
            let old = previous.map_or_else(|| Contact::started(point, substep), |i| before[i].continued_as(point));
            let mut record = previous
                .and_then(|index| old_records[index].take())
                .unwrap_or_else(|| records.begin(point, pair.start(self.law_of(&pair).mass())));
            record.add_rest(&old, substep.start());
            let initial_overlap = old.initial_overlap.min(point.overlap);
            let deformed = DeformedContact {
                law: self.law_of(&pair),
                pair: &pair,
                old: Contact { initial_overlap, ..old },
                is_new: previous.is_none(),
                overlap: point.overlap - initial_overlap,
                substep,
            };
            let contact = deformed.advance(energy, loads);
            record.add(ForceStep { substep, before: old.force, now: contact.force, v_n: pair.v_n });
            records.running.push(record);
            contacts.push(contact);
        }
        let ended = before.iter().zip(old_records).filter_map(|(old, record)| Some((old, record.take()?)));
        for (old, mut record) in ended {
            record.add_rest(old, substep.start());
            energy.friction += old.elastic[1] + old.elastic[2];
            if let Feature::Terrain { .. } = old.point.key.feature {
                // A contact with a ridge can end before its overlap is zero. The stored energy counts as dissipated.
                energy.damping += old.elastic[0];
            }
            records.end(record, old.force, substep);
        }
        let frequency_squared = |(k, kind): (&f64, &usize)| k / self.kinds[*kind].mass;
        stiffness.iter().zip(motion.placements.kind).map(frequency_squared).fold(0.0, f64::max)
    }

    /// Adds the stiffness [N/m] of a contact to the sum of each of its bodies. A contact that can start within the
    /// longest substep counts too.
    fn add_stiffness(&self, pair: &ContactMotion, stiffness: &mut [f64]) {
        let (point, law) = (pair.point, self.law_of(pair));
        let closing = (-pair.v_n).max(0.0);
        if -point.overlap > closing * LONGEST_SUBSTEP {
            return;
        }
        let expected = point.overlap.max(law.impact_overlap(closing));
        let s_n = law.normal_stiffness(expected);
        // For a contact of two bodies, twice the stiffness gives an upper bound of the frequency, because
        // (a - b)^2 <= 2 a^2 + 2 b^2. Fixed bodies do not swing.
        let free = |(_, kind, _): &(usize, usize, DVec3)| self.kinds[*kind].mass.is_finite();
        let share = pair.bodies().filter(free).count() as f64;
        for (body, kind, arm) in pair.bodies().filter(free) {
            let LawsOfKind { mass, least_inertia, .. } = self.kinds[kind];
            stiffness[body] += share * (s_n * (1.0 + mass * arm.length_squared() / least_inertia));
        }
    }
}

impl LawsOfKind {
    /// Creates the laws of a kind; `betas` are the damping factors of the pairs of materials.
    fn new(kind: &BodyKind, setup: &RigidSetup, betas: &[f64]) -> Self {
        let mass_of = |kind: &BodyKind| if kind.is_fixed { f64::INFINITY } else { kind.shape.mass };
        let (mass, radius) = (mass_of(kind), rounding(kind));
        let law = |other: usize, mass: f64, radius: f64| {
            // `RigidSetup::check` has found the pair of each two surfaces that can touch; the others have no friction.
            let pair = setup.pair(kind.material, other);
            let (resistance, beta) = pair.map_or((0.0.into(), 0.0), |k| (setup.pairs[k].resistance, betas[k]));
            let [a, b] = [kind.material, other].map(|index| &setup.materials[index]);
            ContactLaw::new(setup.model, a, b, resistance, beta, [mass, radius])
        };
        let with =
            |other: &BodyKind| law(other.material, effective(mass, mass_of(other)), effective(radius, rounding(other)));
        let fixed = |other: usize| law(other, mass, radius);
        let ground = setup.ground.as_ref();
        let inertia = &kind.shape.inertia;
        Self {
            bodies: setup.kinds.iter().map(with).collect(),
            ground: fixed(ground.map_or(kind.material, |ground| ground.material)),
            covers: ground.iter().flat_map(|ground| &ground.covers).map(|cover| fixed(cover.material)).collect(),
            surfaces: setup.surfaces.iter().map(|surface| fixed(surface.material)).collect(),
            wall: fixed(setup.wall_material),
            mass,
            // The smallest eigenvalue of an inertia tensor is at least determinant / (trace / 2)^2.
            least_inertia: inertia.determinant() / (0.5 * (0..3).map(|i| inertia.col(i)[i]).sum::<f64>()).powi(2),
        }
    }
}

/// Rounding radius of the sharpest part [m].
fn rounding(kind: &BodyKind) -> f64 {
    kind.shape.parts.iter().map(|part| part.rounding()).fold(f64::MAX, f64::min)
}

/// Effective value a b / (a + b) of two masses or radii; b may be infinite.
fn effective(a: f64, b: f64) -> f64 {
    if a == f64::INFINITY { b } else { a / (1.0 + a / b) }
}

/// A contact with its relative motion over a substep.
struct DeformedContact<'a> {
    law: &'a ContactLaw,
    pair: &'a ContactMotion<'a>,
    /// State of the contact at the start of the substep, with the key of the current contact point.
    old: Contact,
    is_new: bool,
    /// Overlap minus the initial overlap [m]; it determines the contact force.
    overlap: f64,
    substep: Substep,
}

impl DeformedContact<'_> {
    /// Advances the springs, adds the contact force to the loads and updates the energy balance.
    fn advance(&self, energy: &mut Energy, loads: &mut [Load]) -> Contact {
        let Self { law, pair, old, overlap, .. } = self;
        let point = pair.point;
        if *overlap <= 0.0 {
            energy.friction += old.elastic[1] + old.elastic[2];
            return old.idle(point, self.substep);
        }
        let moved = if self.is_new { DVec3::ZERO } else { pair.mean_t * self.substep.dt };
        let kept = if law.keeps_spring() { rotate(old.spring, old.point.normal, point.normal) } else { DVec3::ZERO };
        let forces = law.forces(*overlap, pair.v_n, pair.v_t, kept + moved);
        let force = point.normal * forces.normal + forces.tangential;
        pair.add_force(force, loads);
        let (rolling, rolling_energy) = self.roll(forces.normal, energy);
        pair.add_torque(rolling.torque, loads);
        let contact = Contact {
            point: *point,
            spring: forces.spring,
            rolling_spring: rolling.spring,
            initial_overlap: old.initial_overlap,
            force,
            rolling_torque: rolling.torque,
            dashpot: forces.normal - law.elastic_force(*overlap),
            elastic: [law.normal_energy(*overlap), law.tangential_energy(*overlap, forces.spring), rolling_energy],
            unrecorded: 0.0,
        };
        self.update_energy_balance(&contact, forces.sliding, energy);
        contact
    }

    /// Returns the rolling resistance and its stored energy [J]; adds what it dissipates to the energy balance.
    fn roll(&self, normal_force: f64, energy: &mut Energy) -> (Rolling, f64) {
        let Self { law, pair, old, overlap, substep, .. } = self;
        let [omega, mean_omega] = pair.rolling_velocities();
        let rolled = if self.is_new { DVec3::ZERO } else { mean_omega * substep.dt };
        let spring = rotate(old.rolling_spring, old.point.normal, pair.point.normal) + rolled;
        let Some(rolling) = law.rolling_resistance(*overlap, normal_force, omega, spring) else {
            return (Rolling { torque: DVec3::ZERO, spring: old.rolling_spring, rolling: false }, 0.0);
        };
        let stored = 0.5 * law.rolling_stiffness(*overlap) * rolling.spring.length_squared();
        let lost = -rolling.torque.dot(mean_omega) * substep.dt - (stored - old.elastic[2]);
        *(if rolling.rolling { &mut energy.friction } else { &mut energy.damping }) += lost;
        (rolling, stored)
    }

    /// Adds the stored energy of the contact, and its dissipation by friction and dashpots, to the energy balance.
    fn update_energy_balance(&self, contact: &Contact, is_sliding: bool, energy: &mut Energy) {
        let Self { pair, old, substep, .. } = self;
        // The bodies move under the mean of the forces at the start and at the end of the substep.
        let damped = -0.5 * (old.dashpot + contact.dashpot) * pair.mean_n * substep.dt;
        let gained = contact.elastic[0] + contact.elastic[1] - old.elastic[0] - old.elastic[1];
        let lost = -0.5 * (old.force + contact.force).dot(pair.mean) * substep.dt - gained;
        energy.damping += damped;
        *(if is_sliding { &mut energy.friction } else { &mut energy.damping }) += lost - damped;
        energy.elastic += contact.elastic.iter().sum::<f64>();
    }
}

/// Index in `before` of the contact that continues as `point`; `None` for a new contact. The contact has the same key,
/// or it is a contact of the same part with a neighbouring ground element that the part has just left.
fn find(
    before: &[Contact],
    used: &mut [bool],
    contact_points: &[ContactPoint],
    point: &ContactPoint,
    least_radius: f64,
) -> Option<usize> {
    let key = point.key;
    let index = before.binary_search_by_key(&key, |c| c.point.key).ok().or_else(|| {
        let touching = |k: &ContactKey| {
            contact_points.binary_search_by_key(k, |t| t.key).is_ok_and(|i| contact_points[i].overlap > 0.0)
        };
        let left = |(c, used): (&Contact, &bool)| {
            let next = !*used && are_neighbours(c.point.key.feature, key.feature) && !touching(&c.point.key);
            // Neighbouring ground elements have no gap between them, so the foot point `core` moves only a short way.
            next.then(|| c.point.core.distance(point.core)).filter(|path| *path < least_radius)
        };
        // The contacts are sorted by body and part.
        let part = |c: &Contact| (c.point.key.body, c.point.key.part);
        let first = before.partition_point(|c| part(c) < (key.body, key.part));
        let last = before.partition_point(|c| part(c) <= (key.body, key.part));
        let paths = (first..last).filter_map(|index| Some((index, left((&before[index], &used[index]))?)));
        paths.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    })?;
    used[index] = true;
    Some(index)
}

/// Returns true if a part can move from the ground element `old` to `new` within a substep.
fn are_neighbours(old: Feature, new: Feature) -> bool {
    match (old, new) {
        (Feature::Ground { place: old, .. }, Feature::Ground { place: new, .. }) => old.abs_diff(new) <= 1,
        (Feature::Terrain { .. }, Feature::Terrain { .. }) => true,
        _ => false,
    }
}

/// Rotates a tangential spring from the old to the new contact normal; its length stays the same.
fn rotate(spring: DVec3, old_normal: DVec3, normal: DVec3) -> DVec3 {
    if old_normal == normal || spring == DVec3::ZERO {
        return spring;
    }
    let rotated = DQuat::from_rotation_arc(old_normal, normal) * spring;
    let tangential = rotated - normal * rotated.dot(normal);
    tangential.normalize_or_zero() * spring.length()
}
