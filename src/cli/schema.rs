//! `breakwater schema`: the JSON schema of case files.

use clap::Args;

use super::Trouble;

/// Print the JSON schema of case files, for editors that complete and check as you type.
#[derive(Args)]
pub struct SchemaArguments {}

impl SchemaArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        println!("{}", crate::case::schema_text());
        Ok(())
    }
}
