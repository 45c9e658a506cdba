//! The armour units as the user writes them: one group, or a list of groups.

use std::fmt;

use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::UnitsFile;

/// The armour units: one group of equal units, or a list of groups. Groups differ in shape, size, mass, material or
/// placing.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum UnitGroupsFile {
    /// Equal units.
    One(Box<UnitsFile>),
    /// Groups of equal units.
    Several(Vec<UnitsFile>),
}

impl UnitGroupsFile {
    /// Returns the groups.
    pub fn groups(&self) -> &[UnitsFile] {
        match self {
            Self::One(group) => std::slice::from_ref(group),
            Self::Several(groups) => groups,
        }
    }

    /// Returns the groups.
    pub fn groups_mut(&mut self) -> &mut [UnitsFile] {
        match self {
            Self::One(group) => std::slice::from_mut(group),
            Self::Several(groups) => groups,
        }
    }

    /// Returns the path of a group in the file.
    pub fn path(&self, index: usize) -> String {
        match self {
            Self::One(_) => "units".to_owned(),
            Self::Several(_) => format!("units[{index}]"),
        }
    }
}

/// Unlike serde's derived code for an enum without tags, this keeps the position of an error inside a group.
impl<'de> Deserialize<'de> for UnitGroupsFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Groups;
        impl<'de> Visitor<'de> for Groups {
            type Value = UnitGroupsFile;

            fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                out.write_str("a group of units { ... } or a list of groups [ ... ]")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<UnitGroupsFile, A::Error> {
                UnitsFile::deserialize(MapAccessDeserializer::new(map))
                    .map(|group| UnitGroupsFile::One(Box::new(group)))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<UnitGroupsFile, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(list)).map(UnitGroupsFile::Several)
            }
        }
        deserializer.deserialize_any(Groups)
    }
}
