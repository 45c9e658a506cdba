//! Surface level over time at one position.

use std::path::{Path, PathBuf};

use super::error::ExternalError;
use super::table::{check_times, linear};

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
            let problem = format!("the surface level is {} m", z_m[i]);
            return Err(ExternalError::moment(file, times_s[i], problem, "correct or delete the row"));
        }
        Ok(Self { file: file.to_owned(), times_s, z_m })
    }

    /// Times [s] and levels z [m].
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.times_s.iter().zip(&self.z_m).map(|(&t, &z)| [t, z])
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
                    format!("there is a velocity but no surface level; surface levels cover {first} to {last} s"),
                    "write velocities and surface levels for the same times",
                ));
            }
            Ok(linear(&self.times_s, &self.z_m, t))
        };
        times_s.iter().map(level).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
