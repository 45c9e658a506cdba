//! Results of the gauges in the summary of a run.

use serde::{Deserialize, Serialize};

use super::{OutputError, Table, columns};

/// Highest surface elevation at an elevation gauge.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GaugeSummary {
    /// Name of the gauge.
    pub name: String,
    /// Position x of the gauge along the flume [m].
    pub x_m: f64,
    /// Highest elevation above still water level in the particle domain [m]; `None` if the gauge is outside this
    /// domain.
    pub crest_sph_m: Option<f64>,
    /// Highest elevation above still water level in the flume model [m]; `None` without flume model.
    pub crest_flume_m: Option<f64>,
}

/// Highest pressures at a pressure gauge.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct PressureSummary {
    /// Name of the gauge.
    pub name: String,
    /// Initial position [x, y, z] [m].
    pub at_m: [f64; 3],
    /// Highest mean over `output.series_interval_s` [Pa]; `None` if the gauge was always dry, or if a graphics card
    /// computed the water.
    pub highest_mean_pa: Option<f64>,
    /// Highest of the pressures at the times of the rows of `gauges.csv` [Pa]; `None` if the gauge was dry at these
    /// times.
    pub highest_pa: Option<f64>,
}

/// Extremes and impulse at a force gauge, from the rows of `gauges.csv`. Every row is a mean over the time since the
/// row before. The first row has the values at the start.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ForceSummary {
    /// Name of the gauge.
    pub name: String,
    /// Point [x, y, z] about which the moment acts [m].
    pub about_m: [f64; 3],
    /// Extremes of the force [N].
    pub force_n: Extremes,
    /// Extremes of the moment [N m].
    pub moment_n_m: Extremes,
    /// Impulse of the force along x, y and z [N s]: sum of the means, each multiplied by its interval.
    pub impulse_n_s: [f64; 3],
}

/// Largest and smallest value of each component along x, y and z, each with the flume time of its row [s]. If several
/// rows have the same value, the first counts.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Extremes {
    /// Largest value.
    pub largest: [f64; 3],
    /// Time of the largest value [s].
    pub largest_at_s: [f64; 3],
    /// Smallest value.
    pub smallest: [f64; 3],
    /// Time of the smallest value [s].
    pub smallest_at_s: [f64; 3],
}

impl ForceSummary {
    /// Summarises the force gauge `name`, whose moment acts about a point [m], from `gauges.csv`.
    ///
    /// # Errors
    /// If the table does not have the columns of the gauge.
    pub fn from_table(name: &str, about_m: [f64; 3], table: &Table) -> Result<Self, OutputError> {
        let mut summary = Self { name: name.to_owned(), about_m, ..Self::default() };
        let times = table.column("time_s")?;
        for (component, column) in columns::force(name).iter().enumerate() {
            let (values, axis) = (table.column(column)?, component % 3);
            let extremes = if component < 3 { &mut summary.force_n } else { &mut summary.moment_n_m };
            for (row, (&time, &value)) in times.iter().zip(values).enumerate() {
                if row == 0 || value > extremes.largest[axis] {
                    (extremes.largest[axis], extremes.largest_at_s[axis]) = (value, time);
                }
                if row == 0 || value < extremes.smallest[axis] {
                    (extremes.smallest[axis], extremes.smallest_at_s[axis]) = (value, time);
                }
                if row > 0 && component < 3 {
                    summary.impulse_n_s[axis] += value * (time - times[row - 1]);
                }
            }
        }
        Ok(summary)
    }

    /// Returns the three components of the force, then those of the moment.
    pub fn components(&self) -> impl Iterator<Item = ForceComponent> {
        let component = |name, extremes: &Extremes, axis: usize, impulse_n_s| ForceComponent {
            name,
            largest: [extremes.largest[axis], extremes.largest_at_s[axis]],
            smallest: [extremes.smallest[axis], extremes.smallest_at_s[axis]],
            impulse_n_s,
        };
        let force = ["Fx [N]", "Fy [N]", "Fz [N]"].into_iter().enumerate();
        let moment = ["Mx [N m]", "My [N m]", "Mz [N m]"].into_iter().enumerate();
        force
            .map(move |(axis, name)| component(name, &self.force_n, axis, Some(self.impulse_n_s[axis])))
            .chain(moment.map(move |(axis, name)| component(name, &self.moment_n_m, axis, None)))
    }
}

/// A component of force [N] or moment [N m], as a row of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceComponent {
    /// Name with its unit.
    pub name: &'static str,
    /// Largest value and its time [s].
    pub largest: [f64; 2],
    /// Smallest value and its time [s].
    pub smallest: [f64; 2],
    /// Impulse of a component of the force [N s].
    pub impulse_n_s: Option<f64>,
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn a_series_of_forces_gives_its_extremes_with_times_and_its_impulse() {
        // The intervals differ. The row at 2 s has no interval before it. All numbers are exact in binary.
        let header = "time_s,p_p_pa,wall_fx_n,wall_fy_n,wall_fz_n,wall_mx_n_m,wall_my_n_m,wall_mz_n_m";
        let rows = ["2,9,8,0,-1,0.5,1,-1", "2.5,,12,0,-3,0.5,2,-2", "2.75,9,-4,0,-3,0.25,7,-4", "3.75,9,2,0,1,0,3,-3"];
        let table = Table::parse(Path::new("gauges.csv"), &format!("{header}\n{}\n", rows.join("\n"))).unwrap();
        let summary = ForceSummary::from_table("wall", [1.0, 0.5, 0.0], &table).unwrap();
        let wanted = ForceSummary {
            name: "wall".to_owned(),
            about_m: [1.0, 0.5, 0.0],
            force_n: Extremes {
                largest: [12.0, 0.0, 1.0],
                largest_at_s: [2.5, 2.0, 3.75],
                smallest: [-4.0, 0.0, -3.0],
                smallest_at_s: [2.75, 2.0, 2.5],
            },
            moment_n_m: Extremes {
                largest: [0.5, 7.0, -1.0],
                largest_at_s: [2.0, 2.75, 2.0],
                smallest: [0.0, 1.0, -4.0],
                smallest_at_s: [3.75, 2.0, 2.75],
            },
            // 12 x 0.5 - 4 x 0.25 + 2 x 1, and -3 x 0.5 - 3 x 0.25 + 1 x 1.
            impulse_n_s: [7.0, 0.0, -1.25],
        };
        assert_eq!(summary, wanted);
        assert!(ForceSummary::from_table("toe", [0.0; 3], &table).unwrap_err().to_string().contains("toe_fx_n"));
        let (largest, smallest) = ([-1.0, 2.0], [-4.0, 2.75]);
        let last = ForceComponent { name: "Mz [N m]", largest, smallest, impulse_n_s: None };
        assert_eq!(summary.components().last(), Some(last));
        assert_eq!(summary.components().nth(2).and_then(|up| up.impulse_n_s), Some(-1.25));
    }
}
