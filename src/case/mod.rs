//! Input files: parsing, validation and error messages.
//!
//! 1. An input file becomes a [`Document`]. Its top-level keys determine the kind of the file.
//! 2. Parsing turns the document into a struct of [`file`] and checks keys and types.
//! 3. Validation turns this struct into a [`Case`] or another variant of [`InputFile`] and checks the values.
//!
//! Solvers read only validated cases.
//!
//! | file | contents |
//! | --- | --- |
//! | `input_file` | an input file of any kind |
//! | `flume_case`, `dry_test`, `fracture` | the three kinds of cases |
//! | `breakage` | settings of the breakage analysis |
//! | `reference` | measured displacements that runs are compared with |
//! | `layer_job` | the parts of a case that `breakwater place` needs |
//! | `output`, `units`, `wave`, `flume` | sections of a case; each imports only from those to its right in this row |
//! | `reading` | JSON, keys, types, errors |
//! | [`file`] | all input files as the user writes them |

mod breakage;
mod dry_test;
pub mod file;
mod flume;
mod flume_case;
mod fracture;
mod input_file;
mod layer_job;
mod output;
mod reading;
mod reference;
mod units;
mod wave;

pub use breakage::{BreakageSettings, Selection};
pub use dry_test::{DryOutput, DryTestCase, DryTestKind};
pub use file::{
    ArmourOrientation, Boundary, ContactLawName, DamageMeasure, DensityDiffusion, FluidField, ImpactMeasure,
    PlacedGroupFile, PlacementFile, PoseFile, RerunMethod, Sides, SolitaryTheory, Viscosity, WallSlip,
};
pub use flume::bed::{Flume, Mound};
pub use flume::body::BodyPart;
pub use flume::domain::{Domain, Start, StillWater, Water};
pub use flume::part::{Part, PartShape};
pub use flume::regions::Region;
pub use flume::site::Site;
pub use flume::terrain::SiteTerrain;
pub use flume::zones::{DampingZone, RelaxationZone};
pub use flume_case::Case;
pub use flume_case::estimate::Estimate;
pub use flume_case::numerics::{Fluid, Numerics};
pub use fracture::{FractureCase, Landmark, Plane};
pub use input_file::InputFile;
pub use layer_job::{Armour, Heap, LayerJob, Layers, Placing};
pub use output::files::Output;
pub use output::gauges::{Gauge, Motion, Quantity};
pub use output::stop::{AtRest, Stop};
pub use reading::document::{Document, InputKind};
pub use reading::error::{CaseError, CaseErrors};
pub use reading::identity::{CaseIdentity, difference};
pub use reading::schema::{
    dry_schema_text, fracture_schema_text, reference_schema_text, schema_text, sweep_schema_text,
};
pub use reading::template::template_text;
pub use reference::{Reference, ReferenceWave, ReferenceWaveKind, Resolution, Series, SeriesRole, mean};
pub use units::contact::Contact;
pub use units::damage::DamageLimits;
pub use units::group::{self, UnitGroup, UnitModel};
pub use units::materials::{FrictionPair, Material};
pub use units::shape::{UnitKind, UnitShape};
pub use units::way::Way;
pub use units::{UnitPose, Units};
pub use wave::Wave;
pub use wave::external_wave::{ExternalWave, ROWS_FILE};
pub use wave::wavemaker::{SHARE_TO_GAUGE, Wavemaker};
