//! The JSON schema of the case file, for editors and other programs.

use super::file::CaseFile;

/// JSON schema of [`CaseFile`], indented.
pub fn schema_text() -> String {
    let schema = schemars::schema_for!(CaseFile);
    // A schema is plain JSON: alternate formatting indents it and cannot fail.
    format!("{:#}", schema.as_value())
}
