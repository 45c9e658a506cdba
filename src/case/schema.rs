//! The JSON schemas of case files, for editors and other programs.

use schemars::JsonSchema;

use super::file::{CaseFile, DryFile, FractureFile, ReferenceFile};

/// JSON schema of [`CaseFile`], indented.
pub fn schema_text() -> String {
    text_of::<CaseFile>()
}

/// JSON schema of [`DryFile`], indented.
pub fn dry_schema_text() -> String {
    text_of::<DryFile>()
}

/// JSON schema of [`FractureFile`], indented.
pub fn fracture_schema_text() -> String {
    text_of::<FractureFile>()
}

/// JSON schema of [`ReferenceFile`], indented.
pub fn reference_schema_text() -> String {
    text_of::<ReferenceFile>()
}

fn text_of<T: JsonSchema>() -> String {
    let schema = schemars::schema_for!(T);
    // A schema is plain JSON: alternate formatting indents it and cannot fail.
    format!("{:#}", schema.as_value())
}
