//! `breakwater init`: writes a template of a case file.

use std::path::PathBuf;

use clap::Args;

use super::CommandError;
use crate::output::write_atomically;

/// Write a template of a flume case, and its JSON schema in the same folder.
#[derive(Args)]
pub struct InitArguments {
    /// Name of the new case file.
    #[arg(default_value = "case.json")]
    file: PathBuf,
}

impl InitArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let schema = self.file.with_file_name("case.schema.json");
        if self.file.exists() {
            return Err(CommandError::refused(format!("{}: exists already; choose another name", self.file.display())));
        }
        write_atomically(&self.file, crate::case::template_text().as_bytes()).map_err(CommandError::failed)?;
        write_atomically(&schema, crate::case::schema_text().as_bytes()).map_err(CommandError::failed)?;
        println!(
            "{} and {} written; next: breakwater check {}",
            self.file.display(),
            schema.display(),
            self.file.display()
        );
        Ok(())
    }
}
