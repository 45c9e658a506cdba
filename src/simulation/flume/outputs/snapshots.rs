//! Snapshots of the water and of the surfaces of the units for ParaView.
//!
//! A [`Frame`] is a copy of the data in single precision. A separate thread can write the copy while the run continues.

use std::path::Path;

use rayon::prelude::*;

use super::surface::{SurfaceSeries, WaterParts, particles_in};
use crate::simulation::flume::Simulation;
use crate::{
    case::{FluidField, Output, UnitGroup, group},
    output::{Cells, FieldKind, FieldValues, OutputError, PolyDataSeries},
    rigid::BodyState,
    sph::particles::water::Water,
};

/// File name of the snapshots of the water.
pub const WATER_FILE: &str = "fluid.vtkhdf";
/// File name of the snapshots of the unit surfaces.
pub const SURFACES_FILE: &str = "units.vtkhdf";

/// Field of the unit surfaces.
pub const UNIT_FIELDS: [(&str, FieldKind); 1] = [("unit", FieldKind::Integer)];
/// While no point of a surface has moved further than this, a film shows the last position: distance divided by the
/// smallest unit height [-].
const AT_REST: f64 = 1e-3;

/// Returns the distance below which the units of a film are at rest [m].
pub fn rest_of(groups: &[UnitGroup]) -> f64 {
    AT_REST * group::models(groups).map(|(_, model)| model.shape.height()).fold(f64::INFINITY, f64::min)
}

/// Open snapshot files; `None` for a file that the case does not request.
pub struct SnapshotFiles {
    water: Option<PolyDataSeries>,
    surfaces: Option<PolyDataSeries>,
    water_surface: Option<SurfaceSeries>,
}

impl SnapshotFiles {
    /// Creates the files in the run folder.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(simulation: &Simulation, dir: &Path) -> Result<Self, OutputError> {
        let fields = water_fields(&simulation.case.output);
        let water = |_| PolyDataSeries::create(&dir.join(WATER_FILE), Cells::Vertices, &fields);
        let rest = simulation.units.as_ref().map_or(0.0, |units| rest_of(&units.groups));
        let surfaces = |_| -> Result<PolyDataSeries, OutputError> {
            let series = PolyDataSeries::create(&dir.join(SURFACES_FILE), Cells::Triangles, &UNIT_FIELDS)?;
            Ok(series.skipping_rest(rest))
        };
        Ok(Self {
            water: simulation.case.output.fluid_interval.map(water).transpose()?,
            surfaces: surfaces_interval(simulation).map(surfaces).transpose()?,
            water_surface: simulation.case.output.surface_interval.map(|_| SurfaceSeries::create(dir)).transpose()?,
        })
    }

    /// Opens the files of an interrupted run. Keeps the first snapshots of each file: of the water, of the surfaces of
    /// the units, and of the surface of the water. Creates a file that the case requests only since the interruption.
    ///
    /// # Errors
    /// If a file is missing or shorter than at the checkpoint.
    pub fn reopen(
        simulation: &Simulation,
        dir: &Path,
        [water, surfaces, water_surface]: [u64; 3],
    ) -> Result<Self, OutputError> {
        let fields = water_fields(&simulation.case.output);
        let open = |file: &str, cells: Cells, fields: &[(&str, FieldKind)], steps: u64| {
            PolyDataSeries::reopen(&dir.join(file), cells, fields, steps as usize)
        };
        let water = |_| open(WATER_FILE, Cells::Vertices, &fields, water);
        let rest = simulation.units.as_ref().map_or(0.0, |units| rest_of(&units.groups));
        let surfaces = |_| -> Result<PolyDataSeries, OutputError> {
            Ok(open(SURFACES_FILE, Cells::Triangles, &UNIT_FIELDS, surfaces)?.skipping_rest(rest))
        };
        Ok(Self {
            water: simulation.case.output.fluid_interval.map(water).transpose()?,
            surfaces: surfaces_interval(simulation).map(surfaces).transpose()?,
            water_surface: (simulation.case.output.surface_interval)
                .map(|_| SurfaceSeries::reopen(dir, water_surface))
                .transpose()?,
        })
    }

    /// Appends a snapshot of the surface of the water, if its file is open.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn append_water_surface(&mut self, water: &WaterParts) -> Result<(), OutputError> {
        self.water_surface.as_mut().map_or(Ok(()), |series| series.append(water))
    }

    /// Appends a snapshot of the water, if its file is open.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn append_water(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.water.as_mut().map_or(Ok(()), |series| frame.append_to(series))
    }

    /// Appends a snapshot of the unit surfaces, if their file is open.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn append_surfaces(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.surfaces.as_mut().map_or(Ok(()), |series| frame.append_to(series))
    }
}

fn surfaces_interval(simulation: &Simulation) -> Option<f64> {
    simulation.case.output.units_interval.filter(|_| simulation.units.is_some())
}

fn water_fields(output: &Output) -> Vec<(&'static str, FieldKind)> {
    let kind = |field: FluidField| match field {
        FluidField::Velocity => FieldKind::Vector,
        FluidField::Pressure | FluidField::Density => FieldKind::Scalar,
        FluidField::Id => FieldKind::Integer,
    };
    output.fluid_fields.iter().map(|&field| (field.name(), kind(field))).collect()
}

/// One snapshot of the water or of the unit surfaces.
pub struct Frame {
    /// Flume time [s].
    time: f64,
    /// Points [m].
    points: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Fields in the order of the file; each has one value per point.
    fields: Vec<Column>,
}

/// Values of a field, one per point.
enum Column {
    Scalar(Vec<f32>),
    Vector(Vec<[f32; 3]>),
    Integer(Vec<i32>),
}

impl Column {
    fn values(&self) -> FieldValues<'_> {
        match self {
            Self::Scalar(values) => FieldValues::Scalar(values),
            Self::Vector(values) => FieldValues::Vector(values),
            Self::Integer(values) => FieldValues::Integer(values),
        }
    }
}

impl Frame {
    /// Copies the current water of all regions, without their buffers: the fields and the box that the `output` section
    /// of the case requests.
    pub fn of_water(simulation: &Simulation) -> Self {
        let output = &simulation.case.output;
        let mut chosen: Vec<(&Water, Vec<u32>)> = Vec::new();
        for region in simulation.regions() {
            chosen.push((&region.water, particles_in(region, region.own_x(), output.fluid_box)));
        }
        let tait = simulation.solver().parameters().tait;
        let column = |field: &FluidField| match field {
            FluidField::Velocity => Column::Vector(pick(&chosen, |water, i| water.velocity[i].as_vec3().to_array())),
            FluidField::Pressure => Column::Scalar(pick(&chosen, |water, i| tait.pressure(water.density[i]) as f32)),
            FluidField::Density => Column::Scalar(pick(&chosen, |water, i| water.density[i] as f32)),
            FluidField::Id => Column::Integer(pick(&chosen, |water, i| water.id[i] as i32)),
        };
        Self {
            time: simulation.flume_time(),
            points: pick(&chosen, |water, i| water.position[i].as_vec3().to_array()),
            triangles: Vec::new(),
            fields: output.fluid_fields.iter().map(column).collect(),
        }
    }

    /// Copies the surfaces of the units, with the number of the unit of each point.
    pub fn of_surfaces(groups: &[UnitGroup], states: &[BodyState], time: f64) -> Self {
        let (mut points, mut triangles, mut number) = (Vec::new(), Vec::new(), Vec::new());
        let surfaces: Vec<_> = group::models(groups).map(|(_, model)| model.shape.unit().film_surface()).collect();
        for (unit, (model, state)) in group::model_of_each(groups).zip(states).enumerate() {
            let (first, (vertices, faces)) = (points.len() as u32, &surfaces[model]);
            triangles.extend(faces.iter().map(|corners| corners.map(|corner| first + corner)));
            points.extend(vertices.iter().map(|v| (state.position + state.rotation * *v).as_vec3().to_array()));
            number.extend(vertices.iter().map(|_| unit as i32 + 1));
        }
        Self { time, points, triangles, fields: vec![Column::Integer(number)] }
    }

    /// Appends the snapshot to a file with the same fields.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn append_to(&self, series: &mut PolyDataSeries) -> Result<(), OutputError> {
        let values: Vec<FieldValues> = self.fields.iter().map(Column::values).collect();
        series.append(self.time, &self.points, &self.triangles, &values)
    }
}

/// Returns `value` of each of the `chosen` particles of each region, in the same order.
fn pick<T: Send>(chosen: &[(&Water, Vec<u32>)], value: impl Fn(&Water, usize) -> T + Sync) -> Vec<T> {
    let mut values = Vec::with_capacity(chosen.iter().map(|(_, chosen)| chosen.len()).sum());
    for (water, chosen) in chosen {
        values.par_extend(chosen.par_iter().with_min_len(4096).map(|&i| value(water, i as usize)));
    }
    values
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use serde_json::json;

    use super::*;
    use crate::case::Case;

    #[test]
    fn a_snapshot_has_the_fields_and_the_box_of_the_case() {
        let case = json!({
            "title": "Still water",
            "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "still_water_level_m": 0.3 },
            "domain": { "x_m": [0.0, 1.0], "width_m": 0.3, "sides": "periodic", "top_z_m": 0.5, "dp_m": 0.025 },
            "output": { "fluid_fields": ["id", "pressure"], "fluid_box_m": [[0.4, 0.0, 0.0], [0.6, 0.3, 0.1]] },
            "stop": { "duration_s": 1.0 }
        });
        let case = Case::from_str(&case.to_string(), "test").unwrap_or_else(|errors| panic!("{errors}"));
        let simulation = Simulation::new(Arc::new(case)).unwrap();
        let frame = Frame::of_water(&simulation);
        // The box contains 8 particles along the flume, 12 across the flume and 4 vertically.
        assert_eq!(frame.points.len(), 8 * 12 * 4);
        assert!(frame.points.iter().all(|p| (0.4..=0.6).contains(&p[0]) && p[2] <= 0.1));
        let [Column::Integer(id), Column::Scalar(pressure)] = &frame.fields[..] else { panic!("id and pressure") };
        assert_eq!((id.len(), pressure.len()), (frame.points.len(), frame.points.len()));
        let index_of = |id: i32| simulation.water.id.iter().position(|&other| other as i32 == id).unwrap();
        for (point, &id) in frame.points.iter().zip(id) {
            assert_eq!(*point, simulation.water.position[index_of(id)].as_vec3().to_array());
        }
        // The still water level is 0.3 m: p = rho g (0.3 m - z). The density rises with depth, so p may differ by 1 %.
        let expected = |point: &[f32; 3]| 9810.0 * (0.3 - point[2]);
        assert!(frame.points.iter().zip(pressure).all(|(point, p)| (p / expected(point) - 1.0).abs() < 0.01));
    }
}
