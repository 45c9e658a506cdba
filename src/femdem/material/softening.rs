//! The softening curve z(D) of concrete in tension, eq. 3.

/// Material constants a, b, c of eq. 3, fitted to concrete (Xian et al. 1991, Munjiza et al. 1999) [-].
const A: f64 = 0.63;
const B: f64 = 1.8;
const C: f64 = 6.0;

/// Integral of z over D from 0 to 1 [-], computed by adaptive quadrature.
pub const AREA: f64 = 0.386_307_29;

/// Largest value of -dz/dD, the steepest decrease of z [-].
pub const STEEPEST: f64 = 2.040_2;

/// Returns the remaining share z of the strength at the damage D, eq. 3: 1 for D = 0, 0 for D >= 1.
pub fn z(damage: f64) -> f64 {
    if damage <= 0.0 {
        return 1.0;
    }
    if damage >= 1.0 {
        return 0.0;
    }
    let left = 1.0 - damage;
    let exponent = damage * (A + B * C) / ((A + B) * (1.0 - A - B));
    (1.0 - (A + B - 1.0) / (A + B) * exponent.exp()) * (A * left + B * left.powf(C))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn z_decreases_from_one_to_zero_with_the_given_area_and_slope() {
        // z must not jump at D = 0: the formula has the limit 1 there.
        assert!((z(1e-9) - 1.0).abs() < 1e-8 && z(0.0) == 1.0);
        assert_eq!(z(1.0), 0.0);
        let count = 20_000;
        let share = |i: u32| f64::from(i) / f64::from(count);
        let mut area = 0.0;
        let mut steepest = 0.0f64;
        for i in 0..count {
            let (from, to) = (z(share(i)), z(share(i + 1)));
            assert!(to <= from);
            area += (from + 4.0 * z(0.5 * (share(i) + share(i + 1))) + to) / 6.0 / f64::from(count);
            steepest = steepest.max((from - to) * f64::from(count));
        }
        println!("area {area:.10}, steepest {steepest:.6}");
        // Tolerances: rounding of the constants `AREA` and `STEEPEST`, and the error of differences over 1/20,000 of D.
        assert!((area - AREA).abs() < 1e-7);
        assert!((steepest - STEEPEST).abs() < 1e-3);
    }
}
