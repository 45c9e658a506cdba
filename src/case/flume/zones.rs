//! The validated damping zone and relaxation zone.

use crate::case::file::{DampingZoneFile, RelaxationZoneFile};
use crate::case::reading::check::{Checker, as_text, more_than};

/// Largest allowed rate f at the end of a zone [1/s]. At this rate, water with a velocity of 1 m/s stops within a
/// millimetre, so the zone reflects waves like a wall.
const LARGEST_COEFFICIENT: f64 = 1000.0;

/// Zone in which the velocity v of the water decays, dv/dt = -f(x) v; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampingZone {
    /// x of the seaward and of the shoreward end [m].
    pub x: [f64; 2],
    /// Rate f at the shoreward end [1/s].
    pub coefficient: f64,
}

impl DampingZone {
    /// Returns the rate f at x [1/s]. In the zone, f = coefficient times ((x - x0) / (x1 - x0))^2 with the seaward end
    /// x0 and the shoreward end x1. Seaward of the zone f = 0, shoreward of the zone f = coefficient.
    pub fn rate(&self, x: f64) -> f64 {
        let share = ((x - self.x[0]) / (self.x[1] - self.x[0])).clamp(0.0, 1.0);
        self.coefficient * share * share
    }
}

/// Zone in which the velocity v of the water relaxes to the velocity of the flume model, dv/dt = -f(x) (v - v_flume);
/// SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationZone {
    /// x of the seaward and of the shoreward end [m].
    pub x: [f64; 2],
    /// Rate f at the seaward end [1/s].
    pub coefficient: f64,
}

impl RelaxationZone {
    /// Returns the rate f at x [1/s]. In the zone, f = coefficient times ((x1 - x) / (x1 - x0))^2 with the seaward end
    /// x0 and the shoreward end x1. Shoreward of the zone f = 0.
    pub fn rate(&self, x: f64) -> f64 {
        let share = ((self.x[1] - x) / (self.x[1] - self.x[0])).clamp(0.0, 1.0);
        self.coefficient * share * share
    }
}

/// Validates a relaxation zone. It begins at the seaward end of the domain and must end seaward of the damping zone.
pub fn validate_relaxation(
    file: &RelaxationZoneFile,
    domain_x: [f64; 2],
    damping: Option<&DampingZone>,
    check: &mut Checker,
) -> RelaxationZone {
    let [seaward, shoreward] = [domain_x[0], damping.map_or(domain_x[1], |zone| zone.x[0])];
    check.number(
        "domain.relaxation_zone.end_x_m",
        file.end_x_m,
        more_than(seaward).up_to(shoreward),
        "m",
        "the zone begins at the wavemaker and is usually one wavelength long",
    );
    check.number(
        "domain.relaxation_zone.coefficient_per_s",
        file.coefficient_per_s,
        more_than(0.0).up_to(LARGEST_COEFFICIENT),
        "1/s",
        "10 is usual",
    );
    RelaxationZone { x: [seaward, file.end_x_m], coefficient: file.coefficient_per_s }
}

/// Validates a damping zone. `domain_x` are x of the seaward and of the shoreward end of the domain [m].
pub fn validate_damping(file: &DampingZoneFile, domain_x: [f64; 2], check: &mut Checker) -> DampingZone {
    let [from, to] = file.x_m;
    if !(from >= domain_x[0] && to <= domain_x[1] && to - from > 0.0) {
        check.reject(
            "domain.damping_zone.x_m",
            format!("[{}, {}]", as_text(from), as_text(to)),
            format!("increasing and within the domain, {} to {} m", as_text(domain_x[0]), as_text(domain_x[1])),
            "write the seaward end first; usually the zone covers the last wavelength of the domain",
        );
    }
    check.number(
        "domain.damping_zone.coefficient_per_s",
        file.coefficient_per_s,
        more_than(0.0).up_to(LARGEST_COEFFICIENT),
        "1/s",
        "10 is usual (Altomare et al. 2017)",
    );
    DampingZone { x: file.x_m, coefficient: file.coefficient_per_s }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relaxation_rate_is_largest_at_the_wavemaker() {
        let zone = RelaxationZone { x: [2.0, 4.0], coefficient: 10.0 };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 9.0].map(|x| zone.rate(x)), [10.0, 10.0, 2.5, 0.0, 0.0]);
    }

    #[test]
    fn damping_rate_grows_with_the_square_of_the_distance() {
        let zone = DampingZone { x: [2.0, 4.0], coefficient: 10.0 };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 9.0].map(|x| zone.rate(x)), [0.0, 0.0, 2.5, 10.0, 10.0]);
    }
}
