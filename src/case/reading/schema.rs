//! The JSON schemas of input files, for editors and other programs.

use schemars::JsonSchema;

use crate::case::file::{CaseFile, DryFile, FractureFile, ReferenceFile, SweepFile};

/// Returns the JSON schema of [`CaseFile`], indented.
pub fn schema_text() -> String {
    indented_schema::<CaseFile>()
}

/// Returns the JSON schema of [`DryFile`], indented.
pub fn dry_schema_text() -> String {
    indented_schema::<DryFile>()
}

/// Returns the JSON schema of [`FractureFile`], indented.
pub fn fracture_schema_text() -> String {
    indented_schema::<FractureFile>()
}

/// Returns the JSON schema of [`SweepFile`], indented.
pub fn sweep_schema_text() -> String {
    indented_schema::<SweepFile>()
}

/// Returns the JSON schema of [`ReferenceFile`], indented.
pub fn reference_schema_text() -> String {
    indented_schema::<ReferenceFile>()
}

fn indented_schema<T: JsonSchema>() -> String {
    let schema = schemars::schema_for!(T);
    // The alternate format indents the JSON text. It cannot fail.
    format!("{:#}", schema.as_value())
}
