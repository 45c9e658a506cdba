//! Writes and reads the files of a run folder.
//!
//! | file of a run folder | written with | content |
//! | --- | --- | --- |
//! | `case.json` | [`write_atomically`] | copy of the case file |
//! | `profile.csv` | [`CsvSeries`] | bed profile with the mound: `x_m`, `z_m` |
//! | `gauges.csv`, `flume_gauges.csv` | [`CsvSeries`] | gauges in the particle domain, and in the flume model |
//! | `units.csv`, `contacts.csv`, `energy.csv` | [`CsvSeries`] | unit motion and loads, contact events, energy |
//! | `impacts.h5` | [`Impacts`] | the hardest impacts of the units with their force histories |
//! | `diagnostics.csv` | [`CsvSeries`] | checks of the water: volume, Mach number, densities, time steps |
//! | `unit_surface.json` | [`UnitSurface`] | surface of a unit relative to its centre of mass |
//! | `fluid.vtkhdf`, `units.vtkhdf` | [`PolyDataSeries`] | water particles, and surfaces of the units, for ParaView |
//! | `surface.vtkhdf` | [`PolyDataSeries`] | surface of the water, for films |
//! | `progress.json` | [`Summary`] | summary of a run in progress |
//! | `report.html`, `picture.svg` | `report::run::write_report` | the report, and a picture of one moment of the run |
//!
//! [`columns`] defines the column names of the tables. A [`Writer`] writes large files while the run continues.

mod atomic;
pub(crate) mod checksum;
pub mod columns;
pub mod driver;
mod error;
mod execution;
mod flume_tables;
mod gauge_summary;
mod impacts;
pub mod progress;
mod schedule;
mod series;
mod size;
pub(crate) mod state_file;
mod summary;
mod table;
mod unit_summary;
mod unit_surface;
mod vtkhdf;
mod writer;

pub use atomic::write_atomically;
pub use error::OutputError;
pub use execution::Execution;
pub use flume_tables::{write_flume_gauges, write_flume_piston};
pub use gauge_summary::{Extremes, ForceComponent, ForceSummary, GaugeSummary, PressureSummary};
pub use impacts::{FluidAtPeak, Impact, Impacts, PressurePoint};
pub use schedule::Schedule;
pub use series::CsvSeries;
pub use size::OutputSize;
pub use summary::{
    BodySummary, BreakageSummary, ContactSummary, EnergySummary, ParticleCounts, SectionSummary, Stopped, Summary,
    TimeStepSummary, WaveSummary,
};
pub use table::Table;
pub use unit_summary::{GroupSummary, UnitSummary};
pub use unit_surface::UnitSurface;
pub use vtkhdf::{Cells, FieldKind, FieldValues, PolyDataMoments, PolyDataSeries, TetMoment, TetSeries};
pub use writer::Writer;
