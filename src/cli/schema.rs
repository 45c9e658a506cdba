//! `breakwater schema`: the JSON schema of case files.

use clap::Args;

use super::CommandError;

/// Print the JSON schema of flume cases or other input files, for editors that complete and check JSON.
#[derive(Args)]
pub struct SchemaArguments {
    /// Print the schema of dry tests (units on a bed without water); default: flume cases.
    #[arg(long = "dry-test", alias = "dry")]
    dry_test: bool,
    /// Print the schema of fracture cases (deformable bodies that crack); default: flume cases.
    #[arg(long, conflicts_with = "dry_test")]
    fracture: bool,
    /// Print the schema of sweep files (one case with varied keys); default: flume cases.
    #[arg(long, conflicts_with_all = ["dry_test", "fracture"])]
    sweep: bool,
    /// Print the schema of `reference.json` (measured displacements for `breakwater compare`); default: flume cases.
    #[arg(long, conflicts_with_all = ["dry_test", "fracture", "sweep"])]
    reference: bool,
}

impl SchemaArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let text = match self {
            Self { dry_test: true, .. } => crate::case::dry_schema_text(),
            Self { fracture: true, .. } => crate::case::fracture_schema_text(),
            Self { sweep: true, .. } => crate::case::sweep_schema_text(),
            Self { reference: true, .. } => crate::case::reference_schema_text(),
            _ => crate::case::schema_text(),
        };
        println!("{text}");
        Ok(())
    }
}
