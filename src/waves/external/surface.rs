//! Surface level over time at one position.

use std::path::{Path, PathBuf};

use super::error::ExternalError;
use super::numbers::as_text;
use super::table::{Place, check_times, linear, median};

/// Largest distance of the surface levels from the still water level, relative to the still water depth [-]. The
/// set-down under waves is smaller: H^2 / (16 d) in shallow water (Longuet-Higgins & Stewart 1964), 0.02 d for H = 0.6 d.
const OFF_DATUM: f64 = 0.05;

/// Surface level over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceSeries {
    file: PathBuf,
    times_s: Vec<f64>,
    z_m: Vec<f64>,
}

impl SurfaceSeries {
    /// Creates a series of levels z [m] at increasing times [s]; `file` is named in errors.
    ///
    /// # Errors
    /// If the times do not increase or have a gap, or a level is not a finite number.
    ///
    /// # Panics
    /// If the numbers of times and levels differ.
    pub fn new(file: &Path, times_s: Vec<f64>, z_m: Vec<f64>) -> Result<Self, ExternalError> {
        assert_eq!(times_s.len(), z_m.len(), "one level per time");
        check_times(file, &times_s)?;
        if let Some(i) = z_m.iter().position(|z| !z.is_finite()) {
            let problem = format!("the surface level is {} m", as_text(z_m[i]));
            return Err(ExternalError::moment(file, times_s[i], problem, "correct or delete the row"));
        }
        Ok(Self { file: file.to_owned(), times_s, z_m })
    }

    /// Times [s] and levels z [m].
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.times_s.iter().zip(&self.z_m).map(|(&t, &z)| [t, z])
    }

    /// Refuses levels that do not fit the still water level, see [`check_datum`].
    pub(super) fn check_datum(&self, place: &Place, advice: &str) -> Result<(), ExternalError> {
        check_datum(&self.file, &self.z_m, 0.0, place, advice)
    }

    /// Highest level z [m] and its time [s], from the parabola through the highest point and its two neighbours.
    pub fn crest(&self) -> (f64, f64) {
        let highest = (0..self.z_m.len()).max_by(|&a, &b| self.z_m[a].total_cmp(&self.z_m[b])).unwrap_or(0);
        let (top, time) = (self.z_m[highest], self.times_s[highest]);
        if highest == 0 || highest + 1 == self.z_m.len() {
            return (top, time);
        }
        let (before, after) = (time - self.times_s[highest - 1], self.times_s[highest + 1] - time);
        let (rise, fall) = ((top - self.z_m[highest - 1]) / before, (self.z_m[highest + 1] - top) / after);
        let curvature = 2.0 * (fall - rise) / (before + after);
        if curvature >= 0.0 {
            return (top, time);
        }
        let slope = (rise * after + fall * before) / (before + after);
        (top - 0.5 * slope * slope / curvature, time - slope / curvature)
    }

    /// Levels z [m] at the given times [s], linearly interpolated.
    ///
    /// # Errors
    /// If a time is outside the series.
    pub fn at_times(&self, times_s: &[f64]) -> Result<Vec<f64>, ExternalError> {
        let (first, last) = (self.times_s[0], self.times_s[self.times_s.len() - 1]);
        // Other programs write times with few digits, so equal times may differ by rounding.
        let rounding = 1e-5 * (last - first);
        let level = |&t: &f64| {
            if t < first - rounding || t > last + rounding {
                return Err(ExternalError::moment(
                    &self.file,
                    t,
                    format!(
                        "there is a velocity but no surface level; surface levels cover {} to {} s",
                        as_text(first),
                        as_text(last)
                    ),
                    "write velocities and surface levels for the same times",
                ));
            }
            Ok(linear(&self.times_s, &self.z_m, t))
        };
        times_s.iter().map(level).collect()
    }
}

/// Refuses surface levels z [m] if the first level, the median and the mean are all too high, or all too low, for the
/// still water level. `resolution_m` is the error of the levels [m].
///
/// A wrong datum shifts all three values. Waves shift only some of them: the first level is at rest before a solitary
/// wave, the median is the level between two solitary waves, and the mean of periodic waves is close to still water.
pub(super) fn check_datum(
    file: &Path,
    levels_m: &[f64],
    resolution_m: f64,
    place: &Place,
    advice: &str,
) -> Result<(), ExternalError> {
    let mean = levels_m.iter().sum::<f64>() / levels_m.len() as f64;
    let levels = [levels_m[0], median(levels_m), mean];
    let still = place.still_water_z_m;
    let tolerance = (OFF_DATUM * place.depth_m()).max(resolution_m);
    let too_high = levels.iter().all(|z| z - still > tolerance);
    let too_low = levels.iter().all(|z| still - z > tolerance);
    if !too_high && !too_low {
        return Ok(());
    }
    let [first, median, mean] = levels.map(as_text);
    let (off, side) = (as_text((levels[1] - still).abs()), if too_high { "above" } else { "below" });
    Err(ExternalError::file(
        file,
        format!(
            "the surface levels are about {off} m {side} the still water level z = {} m: the first is z = {first} m, \
             the median {median} m, the mean {mean} m; at most {} m is allowed",
            as_text(still),
            as_text(tolerance)
        ),
        advice,
    ))
}

#[cfg(test)]
mod tests {
    use super::super::table::Layers;
    use super::*;

    const PLACE: Place = Place { bed_z_m: -0.5, still_water_z_m: 0.5, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };

    /// Checks the datum of 30 s of a wave, shifted by `shift`.
    fn datum(wave: impl Fn(f64) -> f64, shift: f64) -> Result<(), String> {
        let levels: Vec<f64> = (0..300).map(|i| 0.5 + shift + wave(0.1 * f64::from(i))).collect();
        check_datum(Path::new("wl"), &levels, 0.0, &PLACE, "correct it").map_err(|error| error.to_string())
    }

    #[test]
    fn waves_fit_the_still_water_and_a_shifted_datum_does_not() {
        let solitary = |t: f64| 0.6 / (t - 8.0).cosh().powi(2);
        let regular = |t: f64| 0.3 * (2.0 * t + 1.0).cos();
        let group = |t: f64| 0.2 * (2.0 * t).cos() * (-((t - 15.0) / 6.0).powi(2)).exp();
        // Crests of 0.6 m every 10 s; the trough lies so low that the mean is zero.
        let cnoidal = |t: f64| 0.6 / (t % 10.0 - 5.0).cosh().powi(2) - 0.12;
        // The first level of this file is in the crest, and the file ends soon after the wave.
        let cut = |t: f64| 0.6 / (0.3 * t).cosh().powi(2);
        let waves: [(&str, &dyn Fn(f64) -> f64); 5] =
            [("solitary", &solitary), ("regular", &regular), ("group", &group), ("cnoidal", &cnoidal), ("cut", &cut)];
        for (name, wave) in waves {
            assert_eq!(datum(wave, 0.0), Ok(()), "{name}");
            assert!(datum(wave, 0.02).is_ok(), "{name}: a tide of 2 cm in 1 m of water");
            assert!(datum(wave, 0.4).is_err(), "{name}: 0.4 m too high");
        }
        for (wave, shift) in [(waves[0].1, 0.2), (waves[1].1, 0.4), (waves[2].1, -0.2), (waves[3].1, -0.2)] {
            assert!(datum(wave, shift).is_err(), "{shift}");
        }
        assert_eq!(
            datum(|_| 0.0, -0.2).unwrap_err(),
            "wl: the surface levels are about 0.2 m below the still water level z = 0.5 m: the first is z = 0.3 m, the \
             median 0.3 m, the mean 0.3 m; at most 0.05 m is allowed; correct it"
        );
    }

    #[test]
    fn crest_is_the_top_of_a_parabola() {
        let parabola = |t: f64| 3.0 - (t - 1.1).powi(2);
        let times = vec![0.0, 0.5, 1.0, 1.7, 2.0];
        let series = SurfaceSeries::new(Path::new("wl"), times.clone(), times.into_iter().map(parabola).collect());
        let (level, time) = series.unwrap().crest();
        assert!((level - 3.0).abs() < 1e-12 && (time - 1.1).abs() < 1e-12);
    }

    #[test]
    fn levels_are_interpolated_within_the_series_only() {
        let series = SurfaceSeries::new(Path::new("wl"), vec![0.0, 1.0, 2.0], vec![1.0, 2.0, 0.0]).unwrap();
        assert_eq!(series.at_times(&[0.0, 0.5, 2.0]).unwrap(), [1.0, 1.5, 0.0]);
        assert_eq!(
            series.at_times(&[3.0]).unwrap_err().to_string(),
            "wl: at t = 3 s: there is a velocity but no surface level; surface levels cover 0 to 2 s; write \
             velocities and surface levels for the same times"
        );
    }
}
