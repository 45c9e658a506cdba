//! Contact points of bodies with each other, with periodic images, with the ground and with walls.
//!
//! Bounding spheres select pairs of bodies and pairs of parts. [`super::contact_search`] decides when the contact points
//! of a pair are computed.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::broad_phase::{self, BodyPair};
use super::ground::{Approach, GroundSurface, PlaneWall};
use super::nearest_points::{self, Nearest};
use super::part_pair::PartPair;
use super::polyhedron_contact::{self, NearPoint};
use super::terrain_contact;
use crate::geometry::convex::convex_part::ConvexPart;
use crate::geometry::terrain::Terrain;
use crate::rigid::contact::{Contact, ContactKey, ContactPoint, Feature, WHOLE_PART};
use crate::rigid::error::RigidError;
use crate::rigid::kinematics::Placements;
use crate::rigid::setup::{BodyKind, RigidSetup, Sides};

/// Surface of the bodies of one kind.
#[derive(Debug, Clone)]
struct KindSurface {
    parts: Vec<ConvexPart>,
    /// Radius of the sphere about the centre of mass that encloses a body [m].
    reach: f64,
    is_fixed: bool,
}

/// All surfaces that can be in contact.
#[derive(Debug, Clone)]
pub struct Surfaces {
    kinds: Vec<KindSurface>,
    period: Option<f64>,
    ground: Option<GroundSurface>,
    /// Triangle surfaces, each with the number of its first element.
    triangles: Vec<(u32, Arc<Terrain>)>,
    walls: Vec<PlaneWall>,
}

impl Surfaces {
    /// Creates the surfaces of a world.
    pub fn new(setup: &RigidSetup) -> Self {
        let surface = |kind: &BodyKind| KindSurface {
            parts: kind.shape.parts.clone(),
            reach: kind.shape.reach(),
            is_fixed: kind.is_fixed,
        };
        let wall = |index, origin, normal| PlaneWall { index, origin, normal };
        let mut walls = Vec::new();
        if let Sides::Walls { width } = setup.sides {
            walls.extend([wall(0, DVec3::ZERO, DVec3::Y), wall(1, DVec3::Y * width, DVec3::NEG_Y)]);
        }
        if let Some([seaward, shoreward]) = setup.end_walls {
            walls.extend([wall(2, DVec3::X * seaward, DVec3::X), wall(3, DVec3::X * shoreward, DVec3::NEG_X)]);
        }
        Self {
            kinds: setup.kinds.iter().map(surface).collect(),
            period: if let Sides::Periodic { width } = setup.sides { Some(width) } else { None },
            ground: setup.ground.as_ref().map(|g| GroundSurface::new(&g.profile)),
            triangles: setup.first_places().zip(setup.surfaces.iter().map(|surface| surface.terrain.clone())).collect(),
            walls,
        }
    }

    /// Contact points of one body with the ground, the walls and the bodies of lower index.
    pub fn contact_points_of(
        &self,
        body: usize,
        placements: Placements<'_>,
        time: f64,
    ) -> Result<Vec<ContactPoint>, RigidError> {
        let radius = |body: usize| self.reach(placements.kind[body]);
        let pairs = broad_phase::pairs_with(body, placements.position, radius, self.period);
        let mut contact_points = Vec::new();
        self.fixed_contact_points(body, placements, 0.0, time, &mut contact_points)?;
        let mut near = Vec::new();
        pairs.iter().for_each(|pair| self.near_parts_of(pair, placements, 0.0, &mut near));
        for pair in &near {
            self.part_contact_points(pair, placements, &[], [0.0; 2], time, &mut contact_points)?;
        }
        Ok(contact_points)
    }

    /// Radius of the sphere about the centre of mass that encloses a body of the given kind [m].
    pub fn reach(&self, kind: usize) -> f64 {
        self.kinds[kind].reach
    }

    fn parts(&self, body: usize, placements: Placements<'_>) -> &[ConvexPart] {
        &self.kinds[placements.kind[body]].parts
    }

    /// Returns true if the body does not move.
    pub fn is_fixed(&self, body: usize, placements: Placements<'_>) -> bool {
        self.kinds[placements.kind[body]].is_fixed
    }

    /// Lists the pairs of parts with gaps of at most `margin` [m], ordered by body and part numbers.
    pub fn near_parts(&self, placements: Placements<'_>, margin: f64, out: &mut Vec<PartPair>) {
        let radius = |body: usize| self.reach(placements.kind[body]) + 0.5 * margin;
        out.clear();
        for pair in broad_phase::pairs(placements.position, radius, self.period) {
            if !(self.is_fixed(pair.first, placements) && self.is_fixed(pair.second, placements)) {
                self.near_parts_of(&pair, placements, margin, out);
            }
        }
    }

    /// Appends the pairs of parts of two bodies whose bounding spheres have gaps of at most `margin` [m].
    fn near_parts_of(&self, pair: &BodyPair, placements: Placements<'_>, margin: f64, out: &mut Vec<PartPair>) {
        let [(q_a, x_a), (q_b, x_b)] = self.poses(pair, placements);
        for (i, part_a) in self.parts(pair.first, placements).iter().enumerate() {
            let (centre_a, reach_a) = part_a.bounding_sphere();
            let centre_a = q_a * centre_a + x_a;
            for (j, part_b) in self.parts(pair.second, placements).iter().enumerate() {
                let (centre_b, reach_b) = part_b.bounding_sphere();
                let clearance = (q_b * centre_b + x_b).distance(centre_a) - reach_a - reach_b;
                if clearance <= margin {
                    out.push(PartPair { bodies: *pair, parts: [i, j], clearance });
                }
            }
        }
    }

    /// Rotation and position of both bodies of a pair. The second body is at its image near the first.
    fn poses(&self, pair: &BodyPair, placements: Placements<'_>) -> [(DQuat, DVec3); 2] {
        let Placements { rotation, position, .. } = placements;
        let shift = self.shift(pair);
        [(rotation[pair.first], position[pair.first]), (rotation[pair.second], position[pair.second] + shift)]
    }

    /// Shift of the second body to its image near the first [m].
    fn shift(&self, pair: &BodyPair) -> DVec3 {
        DVec3::Y * (f64::from(pair.image) * self.period.unwrap_or(0.0))
    }

    /// Appends the contact points of a body with the ground and the walls.
    pub fn fixed_contact_points(
        &self,
        body: usize,
        placements: Placements<'_>,
        margin: f64,
        time: f64,
        contact_points: &mut Vec<ContactPoint>,
    ) -> Result<(), RigidError> {
        let (q, x) = (placements.rotation[body], placements.position[body]);
        // In a periodic flume, triangle surfaces are given for bodies with 0 <= y < width.
        let image = DVec3::Y * self.period.map_or(0.0, |width| (x.y / width).floor() * width);
        let mut approaches = Vec::new();
        for (index, part) in self.parts(body, placements).iter().enumerate() {
            approaches.clear();
            let near = part.rounding() + margin;
            if let Some(ground) = &self.ground {
                ground.approaches(part, q, x, near, &mut approaches);
            }
            let from = approaches.len();
            for (first, terrain) in &self.triangles {
                terrain_contact::approaches((terrain, *first), part, q, x - image, near, &mut approaches);
            }
            approaches[from..].iter_mut().for_each(|approach| approach.core += image);
            for wall in &self.walls {
                wall.approaches(part, q, x, near, &mut approaches);
            }
            for approach in &approaches {
                contact_points.push(fixed_contact_point(body, index, part, approach, time)?);
            }
        }
        Ok(())
    }

    /// Appends the contact points of two parts with gaps of at most `margin` [m]. Returns a lower bound of the gap [m].
    /// The bound is the gap itself up to `margin + measured` [m].
    pub fn part_contact_points(
        &self,
        pair: &PartPair,
        placements: Placements<'_>,
        before: &[Contact],
        [margin, measured]: [f64; 2],
        time: f64,
        contact_points: &mut Vec<ContactPoint>,
    ) -> Result<f64, RigidError> {
        let PartPair { bodies, parts, .. } = pair;
        let [pose_a, pose_b] = self.poses(bodies, placements);
        let part_a = &self.parts(bodies.first, placements)[parts[0]];
        let part_b = &self.parts(bodies.second, placements)[parts[1]];
        let roundings = [part_a.rounding(), part_b.rounding()];
        let sum = roundings[0] + roundings[1];
        let reach = sum + margin + measured;
        let shift = self.shift(bodies);
        let mut add = |near: NearPoint| {
            let point = unit_contact_point(pair, near, roundings, shift, time)?;
            let core = pose_b.0.inverse() * (near.points[1] - pose_b.1);
            contact_points.push(ContactPoint { core, ..point });
            Ok(())
        };
        let gap_of = |nearest: Nearest| match nearest {
            Nearest::Apart => reach - sum,
            Nearest::Overlap => -sum,
            Nearest::Points(p_a, p_b) => p_a.distance(p_b) - sum,
        };
        if let (Some(core_a), Some(core_b)) = (part_a.as_polyhedron(), part_b.as_polyhedron()) {
            let rounding = 0.5 * sum;
            let near = polyhedron_contact::near_points((core_a, pose_a), (core_b, pose_b), rounding, sum + margin);
            if near.is_empty() {
                return Ok(gap_of(nearest_points::nearest(part_a, pose_a, part_b, pose_b, reach)));
            }
            near.into_iter().try_for_each(add)?;
            return Ok(f64::NEG_INFINITY);
        }
        let key = pair.key([WHOLE_PART; 2]);
        let last_core =
            before.binary_search_by_key(&key, |contact| contact.point.key).ok().map(|index| before[index].point.core);
        let near_last =
            last_core.and_then(|core| nearest_points::nearest_from(part_a, pose_a, part_b, pose_b, core, reach));
        let nearest = near_last.unwrap_or_else(|| nearest_points::nearest(part_a, pose_a, part_b, pose_b, reach));
        let gap = gap_of(nearest);
        if gap <= margin {
            // Two equal points stand for overlapping cores; `unit_contact_point` returns an error for them.
            let points = if let Nearest::Points(p_a, p_b) = nearest { [p_a, p_b] } else { [pose_a.1; 2] };
            add(NearPoint { features: [WHOLE_PART; 2], points, overlap_reduction: 0.0 })?;
        }
        Ok(gap)
    }
}

/// Creates the contact point of two parts with the given rounding radii [m].
fn unit_contact_point(
    pair: &PartPair,
    near: NearPoint,
    roundings: [f64; 2],
    shift: DVec3,
    time: f64,
) -> Result<ContactPoint, RigidError> {
    let NearPoint { features, points: [p_a, p_b], overlap_reduction } = near;
    let distance = (p_a - p_b).length();
    let sum = roundings[0] + roundings[1];
    let overlap = sum - distance;
    // The cores touch when the overlap equals the sum of the radii. The normal is defined only for a smaller overlap.
    let allowed = 0.75 * sum;
    if overlap > allowed {
        let BodyPair { first, second, .. } = pair.bodies;
        let partner = format!("unit {}", second + 1);
        return Err(RigidError::TooDeep { time, body: first, partner, depth: overlap, allowed });
    }
    let normal = (p_a - p_b) / distance;
    Ok(ContactPoint {
        key: pair.key(features),
        position: p_a - normal * (roundings[0] - 0.5 * overlap),
        normal,
        overlap: overlap - overlap_reduction,
        shift,
        core: DVec3::ZERO,
    })
}

/// Creates the contact point of a part with the ground or a wall.
fn fixed_contact_point(
    body: usize,
    index: usize,
    part: &ConvexPart,
    approach: &Approach,
    time: f64,
) -> Result<ContactPoint, RigidError> {
    let overlap = part.rounding() - approach.distance;
    if overlap > part.rounding() || overlap.is_nan() {
        let partner = match approach.feature {
            Feature::Wall { .. } => "a wall",
            Feature::Terrain { .. } => "the triangle surface",
            Feature::Ground { .. } | Feature::Unit { .. } => "the ground",
        };
        return Err(RigidError::TooDeep {
            time,
            body,
            partner: partner.into(),
            depth: overlap,
            allowed: part.rounding(),
        });
    }
    Ok(ContactPoint {
        key: ContactKey { body: body as u32, part: index as u16, feature: approach.feature },
        position: approach.core - approach.normal * (part.rounding() - 0.5 * overlap),
        normal: approach.normal,
        overlap,
        shift: DVec3::ZERO,
        core: approach.core - approach.normal * approach.distance,
    })
}
