//! Variable time step (Monaghan et al. 1999): dt = C min(dt_f, dt_cv), with the Courant number C and the limits
//! dt_f = min_a sqrt(h / |dv_a/dt|) and dt_cv = min_a h / (c_a + max_b |h v_ab . r_ab / (r_ab^2 + 0.01 h^2)|). a is a
//! water particle, b one of its neighbours; [`terms`](crate::sph::terms) defines the other symbols. With laminar
//! viscosity nu, dt is also at most h^2 / (8 nu) (Morris et al. 1997).

use rayon::prelude::*;

use crate::sph::{neighbours::records::Record, pairs::rate::Rate, parameters::Parameters, terms::viscosity::Viscosity};

/// Largest acceleration and largest signal speed of all water particles.
#[derive(Debug, Clone, Copy, Default)]
pub struct Limits {
    /// Largest acceleration, max |dv/dt| [m/s2].
    pub acceleration: f64,
    /// Largest signal speed, max_a (c_a + max_b |mu_ab|), with mu_ab of equation 3, also if a and b move apart [m/s].
    pub signal_speed: f64,
}

impl Limits {
    /// Computes the limits from the records and rates of the water. A limit is NaN if one of its values is NaN.
    pub fn of(records: &[Record], rates: &[Rate], gravity: f64) -> Self {
        records
            .par_iter()
            .zip(rates)
            .with_min_len(4096)
            .map(|(record, rate)| {
                let [ax, ay, az] = rate.acceleration.map(f64::from);
                let az = az - gravity;
                Self {
                    acceleration: (ax * ax + ay * ay + az * az).sqrt(),
                    signal_speed: f64::from(record.sound_speed + rate.approach),
                }
            })
            .reduce(Self::default, |a, b| Self {
                acceleration: larger_or_nan(a.acceleration, b.acceleration),
                signal_speed: larger_or_nan(a.signal_speed, b.signal_speed),
            })
    }

    /// Returns the time step [s].
    pub fn time_step(&self, parameters: &Parameters) -> f64 {
        let h = parameters.kernel.h;
        let force_limit = (h / self.acceleration).sqrt();
        let signal_limit = h / self.signal_speed;
        let courant = parameters.cfl * force_limit.min(signal_limit);
        match parameters.viscosity {
            Viscosity::Laminar { nu, .. } | Viscosity::MonaghanGingold { nu } => courant.min(viscous_limit(h, nu)),
            Viscosity::Artificial { .. } => courant,
        }
    }
}

/// Returns the largest time step for viscous diffusion [s], from h [m] and nu [m2/s]; infinite for nu = 0.
pub fn viscous_limit(h: f64, nu: f64) -> f64 {
    0.125 * h * h / nu
}

fn larger_or_nan(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maximum_keeps_nan() {
        assert!(larger_or_nan(f64::NAN, 1.0).is_nan());
        assert!(larger_or_nan(1.0, f64::NAN).is_nan());
        assert_eq!(larger_or_nan(1.0, 2.0), 2.0);
    }
}
