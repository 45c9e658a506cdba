//! Where the water is led to a velocity of its own, validated.

use super::check::{Checker, above, show};
use super::file::{DampingZoneFile, RelaxationZoneFile};
use super::{wave::Wave, wavemaker::Wavemaker};

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
    /// Rate f at x [1/s]: the coefficient times the square of the share of the zone that lies seaward of x; 0 before
    /// the zone, the coefficient beyond it.
    pub fn rate(&self, x: f64) -> f64 {
        let share = ((x - self.x[0]) / (self.x[1] - self.x[0])).clamp(0.0, 1.0);
        self.coefficient * share * share
    }
}

/// Where the velocity v of the water goes over to that of the flume model, dv/dt = -f(x) (v - v_flume); SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationZone {
    /// Seaward and shoreward end [m].
    pub x: [f64; 2],
    /// Rate at the seaward end [1/s].
    pub coefficient: f64,
}

impl RelaxationZone {
    /// Rate f at x [1/s]: the coefficient times the square of the share of the zone that lies shoreward of x; 0 beyond
    /// the zone.
    pub fn rate(&self, x: f64) -> f64 {
        let share = ((self.x[1] - x) / (self.x[1] - self.x[0])).clamp(0.0, 1.0);
        self.coefficient * share * share
    }
}

/// Validate a relaxation zone that begins at the seaward end of a domain between two x [m] and must end before a
/// damping zone.
pub(super) fn validate_relaxation(
    file: &RelaxationZoneFile,
    domain_x: [f64; 2],
    damping: Option<&DampingZone>,
    check: &mut Checker,
) -> RelaxationZone {
    let [seaward, shoreward] = [domain_x[0], damping.map_or(domain_x[1], |zone| zone.x[0])];
    check.number(
        "domain.relaxation_zone.end_x_m",
        file.end_x_m,
        above(seaward).up_to(shoreward),
        "m",
        "it begins at the wavemaker; a wavelength is usual",
    );
    check.number(
        "domain.relaxation_zone.coefficient_per_s",
        file.coefficient_per_s,
        above(0.0).up_to(LARGEST_COEFFICIENT),
        "1/s",
        "10 is usual",
    );
    RelaxationZone { x: [seaward, file.end_x_m], coefficient: file.coefficient_per_s }
}

/// Refuse a relaxation zone where no wave comes from the flume model.
pub(super) fn validate_wave(zone: Option<&RelaxationZone>, wave: &Wave, wavemaker: Wavemaker, check: &mut Checker) {
    let from_flume = wavemaker.is_ml_piston() && !matches!(wave, Wave::None | Wave::Given(_));
    if zone.is_some() && !from_flume {
        check.refuse(
            "domain.relaxation_zone",
            "present",
            "absent, because no wave comes from the flume model",
            "leave it out, or give a wave that the flume model makes and a wavemaker of kind \"ml_piston\"",
        );
    }
}

/// Validate a damping zone in a domain between two x [m].
pub(super) fn validate_damping(file: &DampingZoneFile, domain_x: [f64; 2], check: &mut Checker) -> DampingZone {
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
    fn relaxation_is_strongest_at_the_wavemaker() {
        let zone = RelaxationZone { x: [2.0, 4.0], coefficient: 10.0 };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 9.0].map(|x| zone.rate(x)), [10.0, 10.0, 2.5, 0.0, 0.0]);
    }

    #[test]
    fn rate_grows_as_the_square() {
        let zone = DampingZone { x: [2.0, 4.0], coefficient: 10.0 };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 9.0].map(|x| zone.rate(x)), [0.0, 0.0, 2.5, 10.0, 10.0]);
    }
}
