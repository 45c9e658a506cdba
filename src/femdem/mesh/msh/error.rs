//! Errors of the MSH 4.1 reader.

use std::fmt;

use thiserror::Error;

/// Position in a file, counted from one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// Line of a text file.
    Line(usize),
    /// Byte of a binary file.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Reason why a file is not an MSH 4.1 mesh with named volumes of linear tetrahedra.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MshError {
    /// Not an MSH file.
    #[error("not a Gmsh mesh: its first line is not $MeshFormat; write it with `gmsh -3 -format msh41`")]
    NotMsh,
    /// An older or newer format.
    #[error(
        "MSH version {0} is not supported, only 4.1; set `Mesh.MshFileVersion = 4.1` in Gmsh and write the mesh again \
         (`gmsh -3 -format msh41`)"
    )]
    Version(String),
    /// An unsupported header, which Gmsh does not write on common machines.
    #[error(
        "the line after $MeshFormat ends in {0:?}; it must be `4.1 0 8` (text) or `4.1 1 8` (binary, little-endian)"
    )]
    Header(String),
    /// The file is truncated.
    #[error("the file ends at {place} inside section ${section}; it is incomplete: write or copy it again")]
    Truncated { place: Place, section: String },
    /// An unexpected word.
    #[error("{place}, section ${section}: found {found:?}, expected {expected}")]
    Unexpected { place: Place, section: String, expected: &'static str, found: String },
    /// No nodes or no elements: nothing was meshed or saved.
    #[error("no section ${0}: the file contains no mesh; mesh in three dimensions (`gmsh -3 -format msh41`)")]
    NoSection(&'static str),
    /// Two meshes in one file.
    #[error("section ${0} occurs twice, but a file must contain one mesh; write it again with `gmsh -3 -format msh41`")]
    SectionTwice(&'static str),
    /// A mesh split up for several processes.
    #[error(
        "the mesh is partitioned; write it unpartitioned (`Mesh.PartitionSplitMeshFiles = 0`, no `Mesh.NbPartitions`)"
    )]
    Partitioned,
    /// Elements other than points, lines, triangles, quadrangles and linear tetrahedra.
    #[error(
        "{place}: {count} elements of type {kind} ({name}) in entity {entity} of dimension {dimension}; bodies are made \
         of linear tetrahedra (type 4): {remedy}"
    )]
    ElementType {
        place: Place,
        count: u64,
        kind: i32,
        name: &'static str,
        entity: i32,
        dimension: i32,
        remedy: &'static str,
    },
    /// Elements of a shape that does not fit their entity.
    #[error("{dimension}-D entity {entity} has elements of type {kind} ({name}); it must have {expected}")]
    WrongShape { dimension: i32, entity: i32, kind: i32, name: &'static str, expected: &'static str },
    /// No bodies are defined.
    #[error("no physical volume; each body needs one: write Physical Volume(\"unit\") = Volume{{:}}; in the .geo file")]
    NoVolume,
    /// A volume outside all bodies.
    #[error(
        "volume {entity} has {count} tetrahedra but is in no physical volume; add it to one, or set Mesh.SaveAll = 0 to \
         leave it out of the file"
    )]
    LooseVolume { entity: i32, count: usize },
    /// A volume in two bodies.
    #[error("volume {entity} is in {count} physical volumes ({names}); it must be in exactly one")]
    TwoVolumes { entity: i32, count: usize, names: String },
    /// A group without a name.
    #[error("physical {kind} {tag} has no name; give it one: Physical {kind}(\"name\", {tag}) = ...")]
    Unnamed { kind: &'static str, tag: i32 },
    /// Two groups with the same name.
    #[error("two physical {kind}s are named {name:?}; names must differ")]
    SameName { kind: &'static str, name: String },
    /// A physical volume without tetrahedra.
    #[error("physical volume {0:?} has no tetrahedra; mesh in three dimensions (`gmsh -3`)")]
    EmptyVolume(String),
    /// A physical surface without triangles.
    #[error("physical surface {0:?} has no triangles; remove it or assign it to a meshed surface")]
    EmptySurface(String),
    /// A physical curve or point without elements.
    #[error("physical {kind} {name:?} has no elements; remove it or assign it to a meshed {kind}")]
    EmptyNodeSet { kind: &'static str, name: String },
    /// A curve or point outside the bodies.
    #[error(
        "physical {kind} {name:?}: {count} of its nodes belong to no tetrahedron; make it part of the volume before \
         meshing (Curve{{...}} In Surface or Volume, BooleanFragments)"
    )]
    LooseNodes { kind: &'static str, name: String, count: usize },
    /// Two nodes with the same number.
    #[error("node {0} occurs twice; write the mesh again with `gmsh -3 -format msh41`")]
    DuplicateNode(u64),
    /// A coordinate that is not a finite number.
    #[error("node {tag} is at ({x}, {y}, {z}); coordinates must be finite numbers")]
    NotFinite { tag: u64, x: f64, y: f64, z: f64 },
    /// An element refers to a missing node.
    #[error("element {element} refers to node {node}, which is not in section $Nodes; write the mesh again")]
    NoSuchNode { element: u64, node: u64 },
    /// A mesh too large for 32-bit numbers.
    #[error("the mesh has {count} {what}; at most {limit} are supported")]
    TooLarge { what: &'static str, count: usize, limit: usize },
}
