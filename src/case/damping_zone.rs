//! Where the water is slowed down, validated.

use super::check::{Checker, above, show};
use super::file::DampingZoneFile;

/// Rate at the end of a zone at most [1/s]: water would stop within a millimetre there, and waves return from a wall.
const LARGEST_COEFFICIENT: f64 = 1000.0;

/// Where the velocity v of the water decays, dv/dt = -f(x) v; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampingZone {
    /// Seaward and shoreward end [m].
    pub x: [f64; 2],
    /// Rate at the shoreward end [1/s].
    pub coefficient: f64,
}

impl DampingZone {
    /// Rate f at x [1/s]: the coefficient times the square of the share of the zone that lies seaward of x; 0 before the
    /// zone, the coefficient beyond it.
    pub fn rate(&self, x: f64) -> f64 {
        let share = ((x - self.x[0]) / (self.x[1] - self.x[0])).clamp(0.0, 1.0);
        self.coefficient * share * share
    }
}

/// Validate the zone in a domain between two x [m].
pub(super) fn validate(file: &DampingZoneFile, domain_x: [f64; 2], check: &mut Checker) -> DampingZone {
    let [from, to] = file.x_m;
    if !(from >= domain_x[0] && to <= domain_x[1] && to - from > 0.0) {
        check.refuse(
            "domain.damping_zone.x_m",
            format!("[{}, {}]", show(from), show(to)),
            format!("rising and within the domain, {} to {} m", show(domain_x[0]), show(domain_x[1])),
            "write the seaward end first; a wavelength before the shoreward end of the domain is usual",
        );
    }
    check.number(
        "domain.damping_zone.coefficient_per_s",
        file.coefficient_per_s,
        above(0.0).up_to(LARGEST_COEFFICIENT),
        "1/s",
        "10 is usual (Altomare et al. 2017)",
    );
    DampingZone { x: file.x_m, coefficient: file.coefficient_per_s }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_grows_as_the_square() {
        let zone = DampingZone { x: [2.0, 4.0], coefficient: 10.0 };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 9.0].map(|x| zone.rate(x)), [0.0, 0.0, 2.5, 10.0, 10.0]);
    }
}
