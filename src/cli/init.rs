//! `breakwater init`: a template of a case.

use std::path::PathBuf;

use clap::Args;

use super::Trouble;
use crate::output::write_atomically;

/// Write a template of a flume case, and the JSON schema next to it.
#[derive(Args)]
pub struct InitArguments {
    /// The new case file.
    #[arg(default_value = "case.json")]
    file: PathBuf,
}

impl InitArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let schema = self.file.with_file_name("case.schema.json");
        if self.file.exists() {
            return Err(Trouble::refused(format!("{}: exists already; choose another name", self.file.display())));
        }
        write_atomically(&self.file, crate::case::template_text().as_bytes()).map_err(Trouble::failed)?;
        write_atomically(&schema, crate::case::schema_text().as_bytes()).map_err(Trouble::failed)?;
        println!(
            "{} and {} written; next: breakwater check {}",
            self.file.display(),
            schema.display(),
            self.file.display()
        );
        Ok(())
    }
}
