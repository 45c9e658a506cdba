//! The cohesive (traction-separation) law at an integration point of a joint, eqs. 1 to 4 of Guo, Latham and Xiang.
//!
//! The paper leaves some points open. This module makes these choices:
//!
//! | point | choice |
//! | --- | --- |
//! | initial stiffness | p_0 / h in tension, sliding and compression, with the joint penalty p_0 [Pa] and the mean edge length h of the joint. The opening at the peak stress f_t is then delta_np = 2 h f_t / p_0 |
//! | softening range | `Range::Exact`: the area under the traction-separation curve is the fracture energy G_f. `Range::Published`: max(2 delta_np, 3 G_f / f_t), which dissipates at least 1.16 G_f after the peak |
//! | unloading and reloading | along the secant to the origin; damage never decreases |
//! | sliding | return mapping to the yield stress f_s z(D), with the shear strength f_s and the softening curve z of the damage D (eq. 3). The elastic part of the slip has the stiffness p_0 / h; the remaining slip is plastic and causes damage. The parabola of eq. 2 is used in tension only: in sliding, it would create energy when f_s changes with the normal stress |
//! | mixed mode | the damage D of eq. 4 reduces both the tensile and the shear strength |
//! | snap-back | the softening range in sliding is long enough that the shear stress never falls more steeply than p_0 / h. Where this limit applies, a joint dissipates more than the fracture energy in sliding, G_fII |
//!
//! The dissipation is never negative on any path.

use super::Strength;
use super::softening::{AREA, STEEPEST, z};

/// Choice of the softening range of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Range {
    /// The area under the traction-separation curve is the fracture energy G_f.
    #[default]
    Exact,
    /// max(2 delta_np, 3 G_f / f_t), as in the published programs; see the comment of this module.
    Published,
}

/// Cohesive parameters of the joints of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cohesion {
    /// Strength of the material.
    pub strength: Strength,
    /// Joint penalty p_0 [Pa]; the initial stiffness of a joint with the mean edge length h is p_0 / h.
    pub penalty: f64,
    /// Softening range.
    pub range: Range,
    /// True if faces are tied until they reach their strength. With [`Range::Exact`], their joints then dissipate all
    /// of G_f after the peak.
    pub tied: bool,
}

/// Cohesive law of a joint with a given edge length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CohesiveLaw {
    strength: Strength,
    /// Initial stiffness p_0 / h [Pa/m].
    stiffness: f64,
    /// Opening at peak stress, delta_np [m].
    peak_opening: f64,
    /// Softening range in opening, from the peak stress to failure: delta_nc - delta_np [m].
    opening_range: f64,
    range: Range,
}

/// Number of values in the stored state of an integration point, see [`PointState::to_array`].
pub const POINT_STATE_LENGTH: usize = 10;

/// State of an integration point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointState {
    /// Largest damage D so far [-].
    pub damage: f64,
    /// Stiffness of the secant to the origin in opening [Pa/m]; infinite for a point without damage.
    secant: f64,
    /// Opening at the last call of [`CohesiveLaw::respond`] [m].
    opening: f64,
    /// Slip at the last call of [`CohesiveLaw::respond`] in the axes of the joint [m].
    slip: [f64; 2],
    /// Plastic slip in the axes of the joint [m].
    plastic: [f64; 2],
    /// Accumulated plastic slip (path length) [m].
    accumulated_slip: f64,
    /// Energy dissipated by opening and by sliding so far [J/m2].
    pub dissipated: [f64; 2],
}

impl PointState {
    /// Returns the state as numbers, for a checkpoint.
    pub fn to_array(self) -> [f64; POINT_STATE_LENGTH] {
        let Self { damage, secant, opening, slip: [a, b], plastic: [c, d], accumulated_slip, dissipated: [e, f] } =
            self;
        [damage, secant, opening, a, b, c, d, accumulated_slip, e, f]
    }

    /// Restores the state from the numbers of [`Self::to_array`].
    pub fn from_array(
        [damage, secant, opening, a, b, c, d, accumulated_slip, e, f]: [f64; POINT_STATE_LENGTH],
    ) -> Self {
        Self { damage, secant, opening, slip: [a, b], plastic: [c, d], accumulated_slip, dissipated: [e, f] }
    }

    /// Returns true if the point has neither damage nor plastic slip.
    #[inline]
    pub fn is_intact(&self) -> bool {
        self.damage == 0.0 && self.plastic == [0.0; 2]
    }

    /// Returns the elastic part of the slip [m].
    #[inline]
    fn elastic_slip(&self) -> [f64; 2] {
        [self.slip[0] - self.plastic[0], self.slip[1] - self.plastic[1]]
    }
}

impl Default for PointState {
    fn default() -> Self {
        let (secant, zero) = (f64::INFINITY, [0.0; 2]);
        Self { damage: 0.0, secant, opening: 0.0, slip: zero, plastic: zero, accumulated_slip: 0.0, dissipated: zero }
    }
}

/// Traction at an integration point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Traction {
    /// Normal stress sigma [Pa], tension positive.
    pub normal: f64,
    /// Shear stress tau in the axes of the joint [Pa].
    pub shear: [f64; 2],
    /// Energy dissipated since the previous call of [`CohesiveLaw::respond`] [J/m2].
    pub dissipated: f64,
}

impl Cohesion {
    /// Returns the law of a joint with mean edge length h [m].
    #[inline]
    pub fn law(&self, h: f64) -> CohesiveLaw {
        let Strength { tensile, opening_energy, .. } = self.strength;
        let peak_opening = 2.0 * h * tensile / self.penalty;
        // The area under the curve before the peak, a parabola, is 2/3 f_t delta_np.
        let before = if self.tied { 0.0 } else { 2.0 / 3.0 * peak_opening };
        let opening_range = match self.range {
            Range::Exact => (opening_energy / tensile - before) / AREA,
            Range::Published => (2.0 * peak_opening).max(3.0 * opening_energy / tensile),
        };
        let (strength, range) = (self.strength, self.range);
        CohesiveLaw { strength, stiffness: self.penalty / h, peak_opening, opening_range, range }
    }

    /// Returns the longest usable edge length [m]. With longer edges, the work before the peak alone exceeds G_f. Tied
    /// faces and [`Range::Published`] have no such limit.
    pub fn longest_edge(&self) -> f64 {
        if self.tied || self.range == Range::Published {
            return f64::INFINITY;
        }
        0.75 * self.strength.opening_energy * self.penalty / (self.strength.tensile * self.strength.tensile)
    }
}

impl CohesiveLaw {
    /// Returns the initial stiffness p_0 / h [Pa/m].
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Returns the state of a point that carries the given stress [Pa] at zero slip, and its opening at this stress
    /// [m]. A joint starts with this state when a tied face is released. A tensile stress above the tensile strength is
    /// reduced to the strength.
    pub fn loaded(&self, normal: f64, shear: [f64; 2]) -> (PointState, f64) {
        let f_t = self.strength.tensile;
        let opening = if normal > 0.0 {
            self.peak_opening * (1.0 - (1.0 - (normal / f_t).min(1.0)).sqrt())
        } else {
            normal / self.stiffness
        };
        let plastic = shear.map(|tau| -tau / self.stiffness);
        (PointState { opening, plastic, ..PointState::default() }, opening)
    }

    /// Computes the traction at an opening [m] and a slip [m], and updates the state of the point.
    pub fn respond(&self, point: &mut PointState, opening: f64, slip: [f64; 2]) -> Traction {
        let old = *point;
        let opened = ((opening - self.peak_opening) / self.opening_range).max(0.0);
        if opened > point.damage {
            point.damage = opened.min(1.0);
        }
        let mut normal = self.normal(point, opening);
        // The shear strength depends on the normal stress. If plastic slip increases the damage, the normal stress is
        // computed again.
        let shear = self.slide(point, normal, opened, slip);
        if point.damage > old.damage {
            normal = self.normal(point, opening);
        }
        (point.opening, point.slip) = (opening, slip);
        let dissipated = [self.dissipated_normal(&old, point), self.dissipated_shear(&old, point)];
        point.dissipated = [point.dissipated[0] + dissipated[0], point.dissipated[1] + dissipated[1]];
        Traction { normal, shear, dissipated: dissipated[0] + dissipated[1] }
    }

    /// Returns the elastic energy [J/m2] of a point at the opening and slip of its last call of [`Self::respond`].
    pub fn stored(&self, point: &PointState) -> f64 {
        let [a, b] = point.elastic_slip();
        self.stored_normal(point) + 0.5 * self.stiffness * (a * a + b * b)
    }

    /// Returns the normal stress [Pa] and updates the secant. A point without damage, or at its largest opening so far,
    /// follows eq. 2. At a smaller opening, a damaged point follows the secant. Compression is elastic.
    fn normal(&self, point: &mut PointState, opening: f64) -> f64 {
        let left = z(point.damage);
        if opening <= 0.0 {
            if point.damage > 0.0 {
                point.secant = point.secant.min(left * self.stiffness);
            }
            return self.stiffness * opening;
        }
        let r = opening / self.peak_opening;
        let envelope = left * self.strength.tensile * if r < 1.0 { (2.0 - r) * r } else { 1.0 };
        if point.damage == 0.0 {
            return envelope;
        }
        point.secant = point.secant.min(envelope / opening);
        point.secant * opening
    }

    /// Returns the shear stress [Pa], by return mapping to the yield stress f_s z(D). Updates plastic slip and damage.
    fn slide(&self, point: &mut PointState, normal: f64, opened: f64, slip: [f64; 2]) -> [f64; 2] {
        let elastic = [slip[0] - point.plastic[0], slip[1] - point.plastic[1]];
        let trial = self.stiffness * (elastic[0] * elastic[0] + elastic[1] * elastic[1]).sqrt();
        let strength = self.strength.shear(normal);
        if trial <= strength * z(point.damage) {
            return elastic.map(|e| self.stiffness * e);
        }
        let range = self.sliding_range(strength);
        let damage = |slid: f64| opened.hypot((point.accumulated_slip + slid) / range).clamp(point.damage, 1.0);
        // `excess` decreases through zero as `slid` increases: the yield stress falls less steeply than the elastic
        // stress.
        let excess = |slid: f64| trial - self.stiffness * slid - strength * z(damage(slid));
        let slid = root(excess, trial / self.stiffness);
        let yielded = (trial - self.stiffness * slid).max(0.0);
        point.damage = damage(slid);
        point.accumulated_slip += slid;
        let direction = elastic.map(|e| e * self.stiffness / trial);
        point.plastic = [point.plastic[0] + direction[0] * slid, point.plastic[1] + direction[1] * slid];
        direction.map(|d| d * yielded)
    }

    /// Returns the plastic slip [m] at which a joint with shear strength f_s [Pa] fails.
    fn sliding_range(&self, strength: f64) -> f64 {
        let range = match self.range {
            Range::Exact => self.strength.sliding_energy / (AREA * strength),
            Range::Published => (4.0 * strength / self.stiffness).max(3.0 * self.strength.sliding_energy / strength),
        };
        range.max(STEEPEST * strength / self.stiffness)
    }

    fn stored_normal(&self, point: &PointState) -> f64 {
        let opening = point.opening;
        if opening <= 0.0 {
            0.5 * self.stiffness * opening * opening
        } else if point.damage == 0.0 {
            let r = opening / self.peak_opening;
            self.strength.tensile * self.peak_opening * r * r * (1.0 - r / 3.0)
        } else {
            0.5 * point.secant * opening * opening
        }
    }

    /// Returns the dissipated work of the normal stress between two calls of [`Self::respond`] [J/m2]: the part that is
    /// not stored.
    fn dissipated_normal(&self, old: &PointState, new: &PointState) -> f64 {
        if new.damage == old.damage && new.secant == old.secant {
            return 0.0;
        }
        let [from, to] = [old.opening, new.opening].map(|opening| opening.max(0.0));
        if old.damage > 0.0 {
            return 0.5 * from * to * (old.secant - new.secant);
        }
        let stress = |point: &PointState, opening: f64| {
            let r = opening / self.peak_opening;
            if point.damage > 0.0 { point.secant * opening } else { self.strength.tensile * (2.0 - r) * r }
        };
        // All work before the peak is stored.
        let from = from.max(to.min(self.peak_opening));
        let work = 0.5 * (stress(old, from) + stress(new, to)) * (to - from);
        let stored = |point: &PointState, opening: f64| self.stored_normal(&PointState { opening, ..*point });
        (work + stored(old, from) - stored(new, to)).max(0.0)
    }

    /// Returns the dissipated work of the shear stress between two calls of [`Self::respond`] [J/m2]: the mean of the
    /// stresses at the two calls, times the plastic slip. This product can be negative if the stress changes sign. It
    /// is then set to zero, and the energy balance has an error of the same amount.
    fn dissipated_shear(&self, old: &PointState, new: &PointState) -> f64 {
        let (before, now) = (old.elastic_slip(), new.elastic_slip());
        let along = |k: usize| 0.5 * (before[k] + now[k]) * (new.plastic[k] - old.plastic[k]);
        (self.stiffness * (along(0) + along(1))).max(0.0)
    }
}

/// Returns the root of a decreasing function between 0 and `end`, or `end` if the function is not negative there. Uses
/// the Illinois variant of the false position method.
fn root(f: impl Fn(f64) -> f64, end: f64) -> f64 {
    let (mut a, mut b) = (0.0, end);
    let (mut f_a, mut f_b) = (f(a), f(b));
    if f_b >= 0.0 {
        return b;
    }
    // The method converges in about eight iterations. The limit of 60 ends the loop if rounding prevents convergence.
    for _ in 0..60 {
        let x = (a * f_b - b * f_a) / (f_b - f_a);
        let f_x = f(x);
        if f_x.abs() <= 1e-12 * f_a.abs().max(f_b.abs()) || b - a <= 1e-15 * end {
            return x;
        }
        if f_x > 0.0 {
            (a, f_a) = (x, f_x);
            f_b *= 0.5;
        } else {
            (b, f_b) = (x, f_x);
            f_a *= 0.5;
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests;
