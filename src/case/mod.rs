//! Case files: parsing, validation and error messages.
//!
//! Parsing turns the text into a [`file::CaseFile`] (keys and types). Validation turns that into a [`Case`] (consistent
//! values). Solvers read only the [`Case`].

mod centres;
mod check;
mod domain;
mod dry;
mod error;
mod estimate;
pub mod file;
mod flume;
mod fracture;
mod gauges;
mod given_wave;
mod handover;
mod hash;
mod materials;
mod numerics;
mod obstacles;
mod output;
mod output_size;
mod parse;
mod placing;
mod planar;
mod poses;
mod reference;
mod row;
mod run;
mod schema;
mod site;
mod stl_unit;
mod template;
mod terrain;
mod thickness;
mod unit_shape;
mod units;
mod validate;
mod wave;
mod wavemaker;
mod zones;

pub use domain::{Domain, Start, Water};
pub use dry::{DryCase, DryOutput, DryTest};
pub use error::{CaseError, CaseErrors};
pub use estimate::Estimate;
pub use file::{
    ArmourOrientation, Boundary, ContactLawName, DensityDiffusion, FluidField, PlacementFile, PoseFile, Sides,
    SolitaryTheory, Viscosity, WallSlip,
};
pub use flume::{Flume, Mound};
pub use fracture::{FractureCase, Landmark, Plane};
pub use gauges::{Gauge, Motion, Quantity};
pub use given_wave::{GivenWave, ROWS_FILE};
pub use handover::{Handover, HandoverWay, Hardness, Selection};
pub use materials::{FrictionPair, Material};
pub use numerics::{Fluid, Numerics};
pub use output::Output;
pub use output_size::OutputSize;
pub use placing::{Armour, PlacementJob};
pub use reference::{Reference, ReferenceWave, ReferenceWaveKind, Resolution, Series, SeriesRole, mean};
pub use run::{AtRest, Contact, Stop};
pub use schema::{dry_schema_text, fracture_schema_text, reference_schema_text, schema_text};
pub use site::Site;
pub use template::template_text;
pub use terrain::SiteTerrain;
pub use unit_shape::{UnitKind, UnitShape};
pub use units::{Placement, Units};
pub use validate::Case;
pub use wave::Wave;
pub use wavemaker::Wavemaker;
pub use zones::{DampingZone, RelaxationZone};
