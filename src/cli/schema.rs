//! `breakwater schema`: the JSON schema of case files.

use clap::Args;

use super::Trouble;

/// Print the JSON schema of case files, for editors that complete and check as you type.
#[derive(Args)]
pub struct SchemaArguments {
    /// The schema of dry cases: units on a bed without water.
    #[arg(long)]
    dry: bool,
}

impl SchemaArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let text = if self.dry { crate::case::dry_schema_text() } else { crate::case::schema_text() };
        println!("{text}");
        Ok(())
    }
}
