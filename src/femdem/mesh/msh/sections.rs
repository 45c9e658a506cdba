//! Raw content of an MSH 4.1 file, section by section.
//!
//! Format: Gmsh reference manual, section "MSH file format". The crate `mshio` 0.4.2 is not used, because it ignores
//! node tags that have no gaps. It therefore mixes up the nodes of a mesh in which Gmsh has renumbered the nodes.

use std::collections::BTreeMap;

use glam::DVec3;

use super::error::MshError;
use super::source::Source;

/// Gmsh's element type of a triangle with three nodes.
pub(super) const TRIANGLE: i32 = 2;
/// Gmsh's element type of a tetrahedron with four nodes.
pub(super) const TETRAHEDRON: i32 = 4;

/// Dimension and number of a physical group or of an entity.
pub(super) type Key = (i32, i32);

/// Content of an MSH file.
#[derive(Debug, Default)]
pub(super) struct Sections {
    /// Name of each physical group.
    pub names: BTreeMap<Key, String>,
    /// Physical groups of each entity.
    pub groups: BTreeMap<Key, Vec<i32>>,
    /// Tag and position of each node, in the units of the file.
    pub nodes: Vec<(u64, DVec3)>,
    /// Elements of all entities.
    pub blocks: Vec<ElementBlock>,
}

/// Elements of one shape in one entity.
#[derive(Debug)]
pub(super) struct ElementBlock {
    /// Dimension of the entity: 0 for a point, 1 for a curve, 2 for a surface, 3 for a volume.
    pub dimension: i32,
    /// Number of the entity.
    pub entity: i32,
    /// Gmsh's element type.
    pub kind: i32,
    /// Tag of each element.
    pub tags: Vec<u64>,
    /// Tags of the nodes of all elements, element by element.
    pub nodes: Vec<u64>,
}

impl Sections {
    /// Reads a whole file. Memory and time depend only on the size of the file, even if the file states wrong counts.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, MshError> {
        let mut source = Source::new(bytes)?;
        let mut content = Self::default();
        let mut seen: Vec<&str> = Vec::new();
        while let Some(section) = source.next_section()? {
            match section {
                "PhysicalNames" => content.read_names(&mut source)?,
                "Entities" => content.read_entities(&mut source)?,
                "PartitionedEntities" => return Err(MshError::Partitioned),
                "Nodes" => content.read_nodes(&mut source)?,
                "Elements" => content.read_elements(&mut source)?,
                _ => {
                    source.skip_section()?;
                    continue;
                }
            }
            source.end()?;
            seen.push(section);
        }
        for section in ["Nodes", "Elements"] {
            match seen.iter().filter(|name| **name == section).count() {
                0 => return Err(MshError::NoSection(section)),
                1 => {}
                _ => return Err(MshError::SectionTwice(section)),
            }
        }
        Ok(content)
    }

    /// Reads lines `dimension tag "name"`, which are text even in binary files.
    fn read_names(&mut self, source: &mut Source) -> Result<(), MshError> {
        let start = source.position();
        let line = source.text_line()?;
        let count: usize = line.parse().map_err(|_| source.unexpected(start, "a count", line.as_bytes()))?;
        for _ in 0..count {
            let start = source.position();
            let line = source.text_line()?;
            let (key, name) = physical_name(line)
                .ok_or_else(|| source.unexpected(start, "`dimension tag \"name\"`", line.as_bytes()))?;
            self.names.insert(key, name);
        }
        Ok(())
    }

    /// Reads the physical groups of points, curves, surfaces and volumes.
    fn read_entities(&mut self, source: &mut Source) -> Result<(), MshError> {
        let counts = [source.size()?, source.size()?, source.size()?, source.size()?];
        for (dimension, count) in (0..).zip(counts) {
            for _ in 0..count {
                let entity = source.int()?;
                // A point has a position, other entities have a bounding box.
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    source.real()?;
                }
                let mut groups = Vec::new();
                for _ in 0..source.size()? {
                    // The sign of the number gives the orientation of the entity, which is not needed.
                    groups.push(source.int()?.saturating_abs());
                }
                groups.sort_unstable();
                groups.dedup();
                self.groups.insert((dimension, entity), groups);
                if dimension > 0 {
                    for _ in 0..source.size()? {
                        source.int()?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Reads blocks of node tags followed by positions.
    fn read_nodes(&mut self, source: &mut Source) -> Result<(), MshError> {
        let blocks = source.size()?;
        // Skips the number of nodes and the smallest and largest tag, which are redundant.
        for _ in 0..3 {
            source.size()?;
        }
        for _ in 0..blocks {
            let dimension = source.int()?;
            source.int()?;
            let start = source.position();
            let parameters = match source.int()? {
                0 => 0,
                // Parametric coordinates on the curve, surface or volume follow the position.
                1 => dimension.clamp(0, 3),
                other => return Err(source.unexpected(start, "0 or 1", other.to_string().as_bytes())),
            };
            let count = source.size()?;
            let first = self.nodes.len();
            for _ in 0..count {
                self.nodes.push((source.size()?, DVec3::ZERO));
            }
            for node in &mut self.nodes[first..] {
                node.1 = DVec3::new(source.real()?, source.real()?, source.real()?);
                for _ in 0..parameters {
                    source.real()?;
                }
            }
        }
        Ok(())
    }

    /// Reads blocks of elements of one shape.
    fn read_elements(&mut self, source: &mut Source) -> Result<(), MshError> {
        let blocks = source.size()?;
        // Skips the number of elements and the smallest and largest tag, which are redundant.
        for _ in 0..3 {
            source.size()?;
        }
        for _ in 0..blocks {
            let start = source.position();
            let (dimension, entity, kind) = (source.int()?, source.int()?, source.int()?);
            let count = source.size()?;
            let (name, shape) = element_type(kind);
            let Some((shape_dimension, corners)) = shape else {
                let remedy = if matches!(kind, 5..=7) {
                    "do not recombine the mesh or extrude it in layers"
                } else {
                    "set Mesh.ElementOrder = 1"
                };
                let position = source.file_position(start);
                return Err(MshError::ElementType { position, count, kind, name, entity, dimension, remedy });
            };
            if shape_dimension != dimension {
                let expected = "elements of its own dimension; write the mesh again";
                return Err(MshError::WrongShape { dimension, entity, kind, name, expected });
            }
            let mut block = ElementBlock { dimension, entity, kind, tags: Vec::new(), nodes: Vec::new() };
            for _ in 0..count {
                let tag = source.size()?;
                block.tags.push(tag);
                for _ in 0..corners {
                    block.nodes.push(source.size()?);
                }
            }
            if count > 0 {
                self.blocks.push(block);
            }
        }
        Ok(())
    }
}

/// Parses a line of $PhysicalNames: dimension, tag and name.
fn physical_name(line: &str) -> Option<(Key, String)> {
    let (numbers, rest) = line.split_once('"')?;
    let name = rest.strip_suffix('"')?;
    let mut numbers = numbers.split_ascii_whitespace();
    let key = (numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?);
    (numbers.next().is_none() && !name.is_empty()).then(|| (key, name.to_owned()))
}

/// Returns the name of an element type, and for allowed types also their dimension and number of nodes.
pub(super) fn element_type(kind: i32) -> (&'static str, Option<(i32, usize)>) {
    match kind {
        1 => ("lines", Some((1, 2))),
        TRIANGLE => ("triangles", Some((2, 3))),
        3 => ("quadrangles", Some((2, 4))),
        TETRAHEDRON => ("tetrahedra", Some((3, 4))),
        5 => ("hexahedra", None),
        6 => ("prisms", None),
        7 => ("pyramids", None),
        8..=14 | 16..=19 => ("second order", None),
        15 => ("points", Some((0, 1))),
        _ => ("not a linear element", None),
    }
}
