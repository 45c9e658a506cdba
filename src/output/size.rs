//! Estimate of the size of the output files from the case alone.

use super::columns;
use crate::case::{Case, FluidField, Quantity, UnitGroup, UnitModel, Units, group};

/// Mean size of a number in a CSV table, including its comma [bytes]. In the tables of one run: 19.0 to 19.6 bytes.
const BYTES_PER_NUMBER: f64 = 19.0;
/// Numbers of columns of `units.csv` (which has one row per unit), `energy.csv` and `diagnostics.csv`.
const UNIT_COLUMNS: f64 = columns::UNITS.len() as f64;
const ENERGY_COLUMNS: f64 = columns::ENERGY.len() as f64;
const DIAGNOSTICS_COLUMNS: f64 = columns::DIAGNOSTICS.len() as f64;
/// Size of the position of a point in a snapshot: three f32 [bytes].
const BYTES_PER_POINT: f64 = 12.0;
/// Size of a cell [bytes]: its offset, and one corner (vertex) or three corners (triangle), each an i64. A file stores
/// the cells once for all snapshots.
const BYTES_PER_VERTEX: f64 = 16.0;
const BYTES_PER_TRIANGLE: f64 = 32.0;
/// Space that a VTKHDF file reserves for its short lists [bytes]: five lists of 16384 i64.
const RESERVED: f64 = 5.0 * 16_384.0 * 8.0;
/// Size of a vertex of a unit surface in a snapshot [bytes]: its position.
const BYTES_PER_SURFACE_POINT: f64 = 12.0;
/// Size of a square of the water surface in a snapshot [bytes]: a point with velocity and pressure, and two triangles.
const BYTES_PER_SURFACE_SQUARE: f64 = 28.0 + 2.0 * 24.0;
/// Size of a particle in a checkpoint [bytes]. Water: position, velocity, density, mass, number; boundary: density.
const BYTES_PER_WATER_STATE: f64 = 68.0;
const BYTES_PER_BOUNDARY_STATE: f64 = 8.0;

/// Size of the files of a complete run [bytes], with an error of about 10 %. `contacts.csv` and the report are not
/// included, because they are small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputSize {
    /// Size of `fluid.vtkhdf`, if the amount of water in `output.fluid_box_m` stays the same as at the start.
    pub fluid: f64,
    /// Size of `surface.vtkhdf`, if the surface of the water stays as large as at the start.
    pub surface: f64,
    /// Size of `units.vtkhdf`, which contains the surfaces of the units.
    pub units: f64,
    /// Total size of the CSV tables.
    pub tables: f64,
    /// Size of `checkpoint.h5`; a run keeps only the last checkpoint.
    pub checkpoint: f64,
}

impl OutputSize {
    /// Estimates the size of the output files of a complete run of the case.
    pub fn estimate(case: &Case) -> Self {
        let (estimate, output) = (case.estimate(), &case.output);
        // Two outputs are added: one at the start and one at the end of the run.
        let count = |interval: Option<f64>| interval.map_or(0.0, |dt| (case.stop.duration / dt).floor() + 2.0);
        let bytes_per_particle =
            BYTES_PER_POINT + output.fluid_fields.iter().map(|field| field_bytes(*field)).sum::<f64>();
        let particles = estimate.fluid * output.fluid_box.map_or(1.0, |corners| case.share_of_water_in(corners));
        let fluid_bytes = |snapshots: f64| RESERVED + particles * (snapshots * bytes_per_particle + BYTES_PER_VERTEX);
        Self {
            fluid: if output.fluid_interval.is_some() { fluid_bytes(count(output.fluid_interval)) } else { 0.0 },
            surface: water_surface_bytes(case, count(output.surface_interval)),
            units: surfaces_bytes(case, count(output.units_interval)),
            tables: table_bytes(case, count(Some(output.series_interval))),
            checkpoint: BYTES_PER_WATER_STATE * estimate.fluid
                + BYTES_PER_BOUNDARY_STATE * (estimate.boundary + estimate.units),
        }
    }

    /// Returns the total size of all files [bytes].
    pub fn total(&self) -> f64 {
        self.fluid + self.surface + self.units + self.tables + self.checkpoint
    }
}

/// Bytes of the closed surface of the still water: one point and two triangles for each square of one particle spacing.
fn water_surface_bytes(case: &Case, snapshots: f64) -> f64 {
    if snapshots == 0.0 {
        return 0.0;
    }
    let (domain, output) = (&case.domain, &case.output);
    let share = output.fluid_box.map_or(1.0, |corners| case.share_of_water_in(corners));
    let squares = |length: f64, spacing: f64| 2.0 * length * (domain.width + domain.depth) / (spacing * spacing);
    let of_region = |coarseness: f64, x: [f64; 2]| squares(x[1] - x[0], coarseness * domain.dp);
    let count: f64 = domain.regions.iter().map(|region| of_region(f64::from(region.coarseness), region.x)).sum();
    RESERVED + snapshots * BYTES_PER_SURFACE_SQUARE * share * count
}

fn surfaces_bytes(case: &Case, snapshots: f64) -> f64 {
    let Some(units) = case.units.as_ref().filter(|_| snapshots > 0.0) else { return 0.0 };
    let of_model = |(_, model): (&UnitGroup, &UnitModel)| {
        let (vertices, triangles) = model.shape.unit().film_surface();
        let (vertices, triangles) = (vertices.len() as f64, triangles.len() as f64);
        snapshots * BYTES_PER_SURFACE_POINT * vertices + BYTES_PER_TRIANGLE * triangles
    };
    let sizes: Vec<f64> = group::models(&units.groups).map(of_model).collect();
    RESERVED + group::model_of_each(&units.groups).map(|model| sizes[model]).sum::<f64>()
}

fn table_bytes(case: &Case, rows: f64) -> f64 {
    let gauge_columns = |quantity: &Quantity| match quantity {
        Quantity::Elevation | Quantity::Pressure => 2.0,
        Quantity::Velocity => 3.0,
        Quantity::Force(_) | Quantity::PartForce(_) => 6.0,
    };
    let gauges = case.gauges.iter().filter(|gauge| gauge.in_domain).map(|gauge| gauge_columns(&gauge.quantity));
    let units = case.units.as_ref().map_or(0, Units::count) as f64;
    let columns = 1.0 + gauges.sum::<f64>() + ENERGY_COLUMNS + DIAGNOSTICS_COLUMNS + UNIT_COLUMNS * units;
    BYTES_PER_NUMBER * rows * columns
}

/// Returns the size of the value of a field for one particle in one snapshot [bytes].
fn field_bytes(field: FluidField) -> f64 {
    match field {
        FluidField::Velocity => 12.0,
        FluidField::Pressure | FluidField::Density | FluidField::Id => 4.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a case of 1 s: a tank of 2 m x 0.4 m x 0.5 m with a water depth of 0.25 m, which has 25,000 particles.
    fn case(output: &str) -> Case {
        let text = format!(
            r#"{{ "title": "tank",
                "flume": {{ "bed_m": [[0.0, 0.0], [2.0, 0.0]], "still_water_level_m": 0.25 }},
                "domain": {{ "x_m": [0.0, 2.0], "width_m": 0.4, "sides": "periodic", "top_z_m": 0.5, "dp_m": 0.02 }},
                "output": {{ "fluid_interval_s": 0.1, "series_interval_s": 0.1 {output} }},
                "stop": {{ "duration_s": 1.0 }} }}"#
        );
        Case::from_str(&text, "tank").unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn snapshot_size_is_the_sum_of_its_fields() {
        let particles = case("").estimate().fluid;
        assert_eq!(particles, 25_000.0);
        // 12 snapshots with 9 numbers of 4 bytes per particle; the cells, 16 bytes per particle, are stored once.
        assert_eq!(OutputSize::estimate(&case("")).fluid, RESERVED + particles * (12.0 * 36.0 + 16.0));
        let some = OutputSize::estimate(&case(r#", "fluid_fields": ["velocity"]"#));
        assert_eq!(some.fluid, RESERVED + particles * (12.0 * 24.0 + 16.0));
        assert_eq!(some.units, 0.0);
        assert_eq!(some.tables, 19.0 * 12.0 * 22.0);
        assert_eq!(some.checkpoint, OutputSize::estimate(&case("")).checkpoint);
    }

    #[test]
    fn box_limits_the_snapshots_to_the_water_inside() {
        let water = |output: &str| OutputSize::estimate(&case(output)).fluid - RESERVED;
        let share = |corners: &str| water(&format!(r#", "fluid_box_m": {corners}"#)) / water("");
        assert!((share("[[-1, -1, -1], [9, 9, 9]]") - 1.0).abs() < 1e-12);
        // This box contains a quarter of the length, half of the width, and the upper 0.1 m of the depth of 0.25 m.
        assert!((share("[[0.5, 0.2, 0.15], [1.0, 0.6, 0.5]]") - 0.25 * 0.5 * 0.4).abs() < 1e-12);
        // The box is above the initial water surface.
        assert_eq!(share("[[0.5, 0.2, 0.3], [1.0, 0.6, 0.5]]"), 0.0);
    }
}
