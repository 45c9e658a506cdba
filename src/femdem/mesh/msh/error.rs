//! Errors of the MSH 4.1 reader.

use std::fmt;

use thiserror::Error;

/// Position in a file, counted from one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FilePosition {
    /// Line of a text file.
    Line(usize),
    /// Byte of a binary file.
    Byte(usize),
}

impl fmt::Display for FilePosition {
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
    /// The file is not an MSH file.
    #[error("not a Gmsh mesh: its first line is not $MeshFormat; write it with `gmsh -3 -format msh41`")]
    NotMsh,
    /// The file has an older or newer version of the MSH format.
    #[error(
        "MSH version {0} is not supported, only 4.1; set `Mesh.MshFileVersion = 4.1` in Gmsh and write the mesh again \
         (`gmsh -3 -format msh41`)"
    )]
    Version(String),
    /// The header of the file is not supported. On common machines, Gmsh does not write such headers.
    #[error(
        "the line after $MeshFormat ends in {0:?}; it must be `4.1 0 8` (text) or `4.1 1 8` (binary, little-endian)"
    )]
    Header(String),
    /// The file is truncated.
    #[error("the file ends at {position} inside section ${section}; it is incomplete: write or copy it again")]
    Truncated { position: FilePosition, section: String },
    /// The file contains an unexpected word or line.
    #[error("{position}, section ${section}: found {found:?}, expected {expected}")]
    Unexpected { position: FilePosition, section: String, expected: &'static str, found: String },
    /// The file contains no nodes or no elements, because no mesh was generated or saved.
    #[error("no section ${0}: the file contains no mesh; mesh in three dimensions (`gmsh -3 -format msh41`)")]
    NoSection(&'static str),
    /// The file contains two meshes.
    #[error("section ${0} occurs twice, but a file must contain one mesh; write it again with `gmsh -3 -format msh41`")]
    SectionTwice(&'static str),
    /// The mesh is partitioned for several processes.
    #[error(
        "the mesh is partitioned; write it unpartitioned (`Mesh.PartitionSplitMeshFiles = 0`, no `Mesh.NbPartitions`)"
    )]
    Partitioned,
    /// The file contains elements other than points, lines, triangles, quadrangles and linear tetrahedra.
    #[error(
        "{position}: {count} elements of type {kind} ({name}) in entity {entity} of dimension {dimension}; bodies must \
         consist of linear tetrahedra (type 4): {remedy}"
    )]
    ElementType {
        position: FilePosition,
        count: u64,
        kind: i32,
        name: &'static str,
        entity: i32,
        dimension: i32,
        remedy: &'static str,
    },
    /// The elements of an entity have a shape that is not allowed in this entity.
    #[error("{dimension}-D entity {entity} has elements of type {kind} ({name}); it must have {expected}")]
    WrongShape { dimension: i32, entity: i32, kind: i32, name: &'static str, expected: &'static str },
    /// The file defines no bodies.
    #[error("no physical volume; each body needs one: write Physical Volume(\"unit\") = Volume{{:}}; in the .geo file")]
    NoVolume,
    /// A volume belongs to no body.
    #[error(
        "volume {entity} has {count} tetrahedra but is in no physical volume; add it to one, or set Mesh.SaveAll = 0 \
         to leave it out of the file"
    )]
    UngroupedVolume { entity: i32, count: usize },
    /// A volume belongs to more than one body.
    #[error("volume {entity} is in {count} physical volumes ({names}); it must be in exactly one")]
    AmbiguousVolume { entity: i32, count: usize, names: String },
    /// A physical group has no name.
    #[error("physical {kind} {tag} has no name; give it a name: Physical {kind}(\"name\", {tag}) = ...")]
    Unnamed { kind: &'static str, tag: i32 },
    /// Two physical groups have the same name.
    #[error("two physical {kind}s are named {name:?}; names must differ")]
    SameName { kind: &'static str, name: String },
    /// A physical volume has no tetrahedra.
    #[error("physical volume {0:?} has no tetrahedra; mesh in three dimensions (`gmsh -3`)")]
    EmptyVolume(String),
    /// A physical surface has no triangles.
    #[error("physical surface {0:?} has no triangles; remove it or assign it to a meshed surface")]
    EmptySurface(String),
    /// A physical curve or point has no elements.
    #[error("physical {kind} {name:?} has no elements; remove it or assign it to a meshed {kind}")]
    EmptyNodeSet { kind: &'static str, name: String },
    /// A physical curve or point has nodes outside all bodies.
    #[error(
        "physical {kind} {name:?}: {count} of its nodes belong to no tetrahedron; make the {kind} part of the volume \
         before meshing (Curve{{...}} In Surface or Volume, BooleanFragments)"
    )]
    NodesOutsideBodies { kind: &'static str, name: String, count: usize },
    /// Two nodes have the same number.
    #[error("node {0} occurs twice; write the mesh again with `gmsh -3 -format msh41`")]
    DuplicateNode(u64),
    /// A coordinate of a node is not a finite number.
    #[error("node {tag} is at ({x}, {y}, {z}); coordinates must be finite numbers")]
    NotFinite { tag: u64, x: f64, y: f64, z: f64 },
    /// An element refers to a node that is not in the file.
    #[error("element {element} refers to node {node}, which is not in section $Nodes; write the mesh again")]
    NoSuchNode { element: u64, node: u64 },
    /// The mesh is too large for 32-bit node or face numbers.
    #[error("the mesh has {count} {what}; at most {limit} are supported")]
    TooLarge { what: &'static str, count: usize, limit: usize },
}
