//! Reads input files and recognises their kind.

use std::{path::Path, sync::Arc};

use super::Trouble;
use crate::{
    case::{Case, DryCase, FractureCase, PlacementFile},
    sweep::plan::Sweep,
};

/// A flume case or a dry test.
pub(super) enum AnyCase {
    /// A flume case: water, and perhaps units.
    Wet(Arc<Case>),
    /// A dry test: units on a bed without water.
    Dry(Arc<DryCase>),
}

/// Reads a flume case or a dry test and shows its warnings.
pub(super) fn load_any(path: &Path) -> Result<AnyCase, Trouble> {
    if placement(path).is_some() {
        let what = "is a placement file, not a case; run the case that names it as `units.placement_file`";
        return Err(Trouble::refused(format!("{}: {what}", path.display())));
    }
    if is_fracture(path) {
        let what = "is a fracture case; run it with breakwater fracture";
        return Err(Trouble::refused(format!("{}: {what}", path.display())));
    }
    if is_sweep(path) {
        let what = "is a sweep file; run it with breakwater sweep";
        return Err(Trouble::refused(format!("{}: {what}", path.display())));
    }
    let is_dry = std::fs::read_to_string(path).is_ok_and(|text| DryCase::is_one(&text));
    if !is_dry {
        return load(path).map(AnyCase::Wet);
    }
    let case = DryCase::load(path).map_err(Trouble::refused)?;
    show_warnings(&case.warnings);
    Ok(AnyCase::Dry(Arc::new(case)))
}

/// Returns whether a file is a sweep file.
pub(super) fn is_sweep(path: &Path) -> bool {
    std::fs::read_to_string(path).is_ok_and(|text| Sweep::is_one(&text))
}

/// Returns whether a file is a fracture case.
pub(super) fn is_fracture(path: &Path) -> bool {
    std::fs::read_to_string(path).is_ok_and(|text| FractureCase::is_one(&text))
}

/// Reads the poses from a file, if it is a placement file.
pub(super) fn placement(path: &Path) -> Option<PlacementFile> {
    serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()
}

/// Reads a flume case and shows its warnings.
pub(super) fn load(path: &Path) -> Result<Arc<Case>, Trouble> {
    let case = Case::load(path).map_err(Trouble::refused)?;
    show_warnings(&case.warnings);
    Ok(Arc::new(case))
}

pub(super) fn show_warnings(warnings: &[String]) {
    warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
}
