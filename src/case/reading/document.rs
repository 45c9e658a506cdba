//! The text of an input file. Its top-level keys determine its kind before the other keys are parsed.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use serde::Serialize;
use serde::de::{DeserializeOwned, IgnoredAny};

use super::check::Checker;
use super::error::{CaseError, CaseErrors, is_misspelt};
use super::parse::{RENAMED_KEYS, parse, syntax_error};

/// Largest allowed size of an input file [bytes].
const LARGEST_FILE: u64 = 16 << 20;

/// Kind of an input file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputKind {
    /// A flume case.
    Flume,
    /// A dry test.
    DryTest,
    /// A fracture case.
    Fracture,
    /// A sweep.
    Sweep,
    /// A placement file.
    Placement,
    /// `reference.json`, the description of a reference folder.
    Reference,
}

impl InputKind {
    /// Returns the name of the kind with its article, for messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flume => "a flume case",
            Self::DryTest => "a dry test",
            Self::Fracture => "a fracture case",
            Self::Sweep => "a sweep",
            Self::Placement => "a placement file",
            Self::Reference => "the description of a reference folder",
        }
    }
}

/// The text of an input file. It is valid JSON.
#[derive(Debug, Clone)]
pub struct Document {
    /// Path of the file, as the user passed it.
    pub name: String,
    /// Text of the file.
    pub text: String,
    /// Top-level keys.
    keys: Vec<String>,
}

impl Document {
    /// Reads an input file.
    ///
    /// # Errors
    /// If the file cannot be read or is not valid JSON.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let name = path.display().to_string();
        match read_text(path) {
            Ok(text) => Self::new(text, &name),
            Err(reason) => Err(CaseError::Read { file: name, reason }),
        }
    }

    /// Makes a document from the text of an input file; `name` is the file name in messages.
    ///
    /// # Errors
    /// If the text is not valid JSON.
    pub fn new(text: impl Into<String>, name: &str) -> Result<Self, CaseError> {
        let (text, name) = (text.into(), name.to_owned());
        let keys = match serde_json::from_str::<BTreeMap<String, IgnoredAny>>(without_mark(&text)) {
            Ok(object) => object.into_keys().collect(),
            // The text is valid JSON but not an object. Parsing it as a flume case reports this error.
            Err(error) if error.is_data() => Vec::new(),
            Err(error) => return Err(syntax_error(without_mark(&text), &error, &name)),
        };
        Ok(Self { name, text, keys })
    }

    /// Returns the kind of the file. A file without a key of another kind counts as a flume case. A misspelt main key
    /// still decides the kind, so that the message names the right keys.
    pub fn kind(&self) -> InputKind {
        let has_any = |keys: &[&str]| keys.iter().any(|key| self.has(key));
        match () {
            () if self.has("vary") => InputKind::Sweep,
            () if self.has("dry") || self.has_similar("dry_test") => InputKind::DryTest,
            // Old flume cases use the key `fracture` for the breakage analysis.
            () if has_any(&["flume", "domain"]) => InputKind::Flume,
            () if self.has("bodies") || self.has_similar("fracture") => InputKind::Fracture,
            () if has_any(&["series", "waves"]) => InputKind::Reference,
            () if has_any(&["poses", "packing_density", "groups"]) => InputKind::Placement,
            () if self.has("case") || self.has_similar("vary") => InputKind::Sweep,
            () => InputKind::Flume,
        }
    }

    /// Returns true if a key of the file is `key` or differs from it by at most two letters.
    fn has_similar(&self, key: &str) -> bool {
        self.keys.iter().any(|found| is_misspelt(found, key))
    }

    fn has(&self, key: &str) -> bool {
        self.keys.iter().any(|found| found == key)
    }

    /// Parses the file into a struct of the module `case::file`. This checks keys and types.
    ///
    /// # Errors
    /// If a key is unknown or missing, or a value has the wrong type.
    pub fn parse<T: DeserializeOwned + Serialize>(&self) -> Result<T, CaseError> {
        parse(without_mark(&self.text), &self.name)
    }

    /// Returns the text of the case file that a run stores. `file` is the parsed case. `kept` is the same case with
    /// paths that are valid in the run folder. If both are equal, the text is the user's own text. Otherwise it is
    /// `kept` as JSON.
    pub(in crate::case) fn stored_text<F: PartialEq + Serialize>(&self, file: &F, kept: &F) -> String {
        // Writing to memory cannot fail, because every key is a string.
        if kept == file { self.text.clone() } else { serde_json::to_string_pretty(kept).unwrap_or_default() }
    }

    /// Parses the file and validates it. Returns the validated case and the warnings, or all errors.
    pub(in crate::case) fn validate<F: DeserializeOwned + Serialize, C>(
        &self,
        validate: impl FnOnce(&F, &Self, &mut Checker) -> Option<C>,
    ) -> Result<(C, Vec<String>), CaseErrors> {
        let file = self.parse()?;
        let mut check = Checker::new(&self.name);
        if self.kind() != InputKind::Fracture {
            let old_keys = RENAMED_KEYS.iter().filter(|(old, _)| self.has(old));
            old_keys.for_each(|(old, new)| check.warn(format!("{old}: is now called {new}; the old name still works")));
        }
        match validate(&file, self, &mut check) {
            Some(case) if check.count() == 0 => Ok((case, check.warnings)),
            _ => Err(check.into_errors()),
        }
    }
}

/// Returns the text without the Unicode byte order mark that some editors write at its start.
fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

fn read_text(path: &Path) -> Result<String, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mut text = String::new();
    let size = file.take(LARGEST_FILE + 1).read_to_string(&mut text).map_err(|error| error.to_string())?;
    if size as u64 > LARGEST_FILE {
        return Err(format!("larger than {} MiB, the limit for input files", LARGEST_FILE >> 20));
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_main_key_keeps_the_kind_of_the_file() {
        let kind = |text: &str| Document::new(text, "x.json").unwrap().kind();
        assert_eq!(kind(r#"{ "title": "", "case": "a.json", "varry": [] }"#), InputKind::Sweep);
        assert_eq!(kind(r#"{ "title": "", "cas": "a.json", "vari": [] }"#), InputKind::Sweep);
        assert_eq!(kind(r#"{ "dry_tset": {}, "flume": {}, "domain": {} }"#), InputKind::DryTest);
        assert_eq!(kind(r#"{ "fractre": {}, "bodies": [] }"#), InputKind::Fracture);
        assert_eq!(kind(r#"{ "fracture": {}, "bodis": [] }"#), InputKind::Fracture);
        assert_eq!(kind(r#"{ "title": "", "packing_density": 1, "pose": [] }"#), InputKind::Placement);
        assert_eq!(kind(r#"{ "title": "", "groups": [] }"#), InputKind::Placement);
        assert_eq!(kind(r#"{ "source": "", "serie": [], "waves": [], "notes": [] }"#), InputKind::Reference);
        assert_eq!(kind(r#"{ "flumme": {}, "domian": {}, "wave": {}, "units": {} }"#), InputKind::Flume);
        assert_eq!(kind(r#"{ "flume": {}, "fracture": {}, "friction": [] }"#), InputKind::Flume);
        assert_eq!(kind("[1]"), InputKind::Flume);
    }
}
