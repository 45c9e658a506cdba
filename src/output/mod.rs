//! What a run writes, what is read back from it, and the pages made of both.
//!
//! | file of a run folder | written with | holds |
//! | --- | --- | --- |
//! | `case.json` | [`write_atomically`] | the case as it was run |
//! | `profile.csv` | [`CsvSeries`] | bed with mound: `x_m`, `z_m` |
//! | `gauges.csv`, `flume_gauges.csv` | [`CsvSeries`] | water at the gauges, by the particles and by the flume model |
//! | `units.csv`, `contacts.csv`, `energy.csv` | [`CsvSeries`] | motion and forces of the units, contact events, energy |
//! | `impacts.h5` | [`Impacts`] | the hardest impacts of the units with their forces against time |
//! | `diagnostics.csv` | [`CsvSeries`] | whether the run is sound: volume, Mach number, densities, steps |
//! | `unit_surface.json` | [`UnitSurface`] | the unit's surface about its centre of mass |
//! | `fluid.vtkhdf`, `units.vtkhdf` | [`PolyDataSeries`] | particles and moving surfaces, for ParaView |
//! | `report.html`, `picture.svg` | [`write_report`] | the report, and one moment of the run as a picture |
//!
//! The column names of the tables are in [`columns`]. What is long is written by a [`Writer`] while the run goes on.

mod atomic;
pub mod columns;
pub mod driver;
mod error;
mod execution;
mod flume_tables;
mod impacts;
pub mod progress;
mod series;
pub(crate) mod state_file;
mod summary;
mod table;
mod unit_surface;
mod vtkhdf;
mod writer;

pub use atomic::write_atomically;
pub use error::OutputError;
pub use execution::Execution;
pub use flume_tables::{write_flume_gauges, write_flume_piston};
pub use impacts::{FluidAtPeak, Impact, Impacts, PressurePlace};
pub use series::{CsvSeries, is_due};
pub use summary::{
    BreakageSummary, ContactSummary, EnergySummary, GaugeSummary, ParticleCounts, Stopped, Summary, TimeStepSummary,
    UnitSummary, WaveSummary,
};
pub use table::Table;
pub use unit_surface::UnitSurface;
pub use vtkhdf::{
    Cells, FieldKind, FieldValues, PolyDataSeries, TetMoment, TetSeries, TriangleMoments, WaterSnapshot, WaterSnapshots,
};
pub use writer::Writer;
