//! Builds bodies, triangle sets and node sets from the sections of an MSH file.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use glam::DVec3;

use super::super::{Body, Mesh, NodeSet, TriangleSet, faces};
use super::error::MshError;
use super::sections::{ElementBlock, Key, Sections, TRIANGLE, element_type};

/// Marks a node that no element uses.
const UNUSED: u32 = u32::MAX;

/// Builds the mesh of a file, with lengths multiplied by `scale`.
pub(super) fn mesh(file: &Sections, scale: f64) -> Result<Mesh, MshError> {
    let volumes = volume_blocks(file)?;
    let surfaces = surface_blocks(file)?;
    let count = volumes.values().flatten().map(|block| block.tags.len()).sum();
    if count > faces::MOST_TETS {
        return Err(MshError::TooLarge { what: "tetrahedra", count, limit: faces::MOST_TETS });
    }
    let mut nodes = NodeTable::new(file, scale)?;
    let mut mesh = Mesh::default();
    for (name, blocks) in named(file, 3, volumes)? {
        let first = mesh.tets.len();
        for block in &blocks {
            mesh.tets.extend(elements::<4>(block, &mut nodes)?);
            mesh.tet_tags.extend(&block.tags);
        }
        mesh.bodies.push(Body { name, tets: first..mesh.tets.len() });
    }
    let in_body = nodes.used.clone();
    for (name, blocks) in named(file, 2, surfaces)? {
        let mut triangles = Vec::new();
        for block in &blocks {
            triangles.extend(elements::<3>(block, &mut nodes)?);
        }
        mesh.sets.push(TriangleSet { name, triangles });
    }
    for dimension in [1, 0] {
        for (name, blocks) in named(file, dimension, line_blocks(file, dimension))? {
            let kind = kind_of(dimension);
            if mesh.sets.iter().any(|set| set.name == name) || mesh.node_sets.iter().any(|set| set.name == name) {
                return Err(MshError::SameName { kind: "set", name });
            }
            let indices: Option<BTreeSet<u32>> =
                blocks.iter().flat_map(|block| &block.nodes).map(|tag| nodes.index(*tag)).collect();
            let count = |set: &BTreeSet<u32>| set.iter().filter(|node| !in_body[**node as usize]).count();
            match indices {
                Some(set) if count(&set) == 0 => {
                    mesh.node_sets.push(NodeSet { name, nodes: set.into_iter().collect() });
                }
                Some(set) => return Err(MshError::NodesOutsideBodies { kind, name, count: count(&set) }),
                None => return Err(MshError::NodesOutsideBodies { kind, name, count: 1 }),
            }
        }
    }
    nodes.drop_unused(&mut mesh);
    Ok(mesh)
}

/// Blocks of elements of each physical group, by the tag of the group.
type Groups<'a> = BTreeMap<i32, Vec<&'a ElementBlock>>;

/// Collects the element blocks of each body. Every volume must be in exactly one body.
fn volume_blocks(file: &Sections) -> Result<Groups<'_>, MshError> {
    let mut groups = declared(file, 3);
    if groups.is_empty() {
        return Err(MshError::NoVolume);
    }
    for block in file.blocks.iter().filter(|block| block.dimension == 3) {
        match file.groups.get(&(3, block.entity)).map_or(&[][..], Vec::as_slice) {
            [group] => groups.entry(*group).or_default().push(block),
            [] => return Err(MshError::UngroupedVolume { entity: block.entity, count: block.tags.len() }),
            several => {
                let name = |group: &i32| file.names.get(&(3, *group)).cloned().unwrap_or_else(|| group.to_string());
                let names = several.iter().map(name).collect::<Vec<_>>().join(", ");
                return Err(MshError::AmbiguousVolume { entity: block.entity, count: several.len(), names });
            }
        }
    }
    Ok(groups)
}

/// Collects the element blocks of each triangle set. A surface may be in several sets or in none.
fn surface_blocks(file: &Sections) -> Result<Groups<'_>, MshError> {
    let mut groups = declared(file, 2);
    for block in file.blocks.iter().filter(|block| block.dimension == 2) {
        for group in file.groups.get(&(2, block.entity)).into_iter().flatten() {
            if block.kind != TRIANGLE {
                let ElementBlock { dimension, entity, kind, .. } = *block;
                let expected = "triangles (type 2), because it is in a physical surface: do not recombine the mesh";
                return Err(MshError::WrongShape { dimension, entity, kind, name: element_type(kind).0, expected });
            }
            groups.entry(*group).or_default().push(block);
        }
    }
    Ok(groups)
}

/// Collects the element blocks of each node set: curves (`dimension` 1) or points (`dimension` 0).
fn line_blocks(file: &Sections, dimension: i32) -> Groups<'_> {
    let mut groups = declared(file, dimension);
    for block in file.blocks.iter().filter(|block| block.dimension == dimension) {
        for group in file.groups.get(&(dimension, block.entity)).into_iter().flatten() {
            groups.entry(*group).or_default().push(block);
        }
    }
    groups
}

/// Returns Gmsh's name for the physical groups of a dimension.
fn kind_of(dimension: i32) -> &'static str {
    match dimension {
        0 => "Point",
        1 => "Curve",
        2 => "Surface",
        _ => "Volume",
    }
}

/// Returns all physical groups of a dimension, without their blocks. [`named`] refuses groups that remain empty.
fn declared(file: &Sections, dimension: i32) -> Groups<'_> {
    let named = file.names.keys().filter(|key| key.0 == dimension).map(|key| key.1);
    let used = file.groups.iter().filter(|(key, _)| key.0 == dimension).flat_map(|(_, groups)| groups.iter().copied());
    named.chain(used).map(|group| (group, Vec::new())).collect()
}

/// Returns the groups with their names, and checks that the names are unique and that no group is empty.
fn named<'a>(
    file: &Sections,
    dimension: i32,
    groups: Groups<'a>,
) -> Result<Vec<(String, Vec<&'a ElementBlock>)>, MshError> {
    let kind = kind_of(dimension);
    let mut result: Vec<(String, Vec<&ElementBlock>)> = Vec::with_capacity(groups.len());
    for (tag, blocks) in groups {
        let key: Key = (dimension, tag);
        let name = file.names.get(&key).ok_or(MshError::Unnamed { kind, tag })?.clone();
        if blocks.is_empty() {
            return Err(match dimension {
                3 => MshError::EmptyVolume(name),
                2 => MshError::EmptySurface(name),
                _ => MshError::EmptyNodeSet { kind, name },
            });
        }
        if result.iter().any(|(other, _)| *other == name) {
            return Err(MshError::SameName { kind, name });
        }
        result.push((name, blocks));
    }
    Ok(result)
}

/// Returns the node indices of elements with `N` nodes.
fn elements<const N: usize>(block: &ElementBlock, nodes: &mut NodeTable) -> Result<Vec<[u32; N]>, MshError> {
    let mut result = Vec::with_capacity(block.tags.len());
    for (element, tags) in block.tags.iter().zip(block.nodes.as_chunks::<N>().0) {
        let mut corners = [0; N];
        for (corner, tag) in corners.iter_mut().zip(tags) {
            *corner = nodes.index(*tag).ok_or(MshError::NoSuchNode { element: *element, node: *tag })?;
        }
        result.push(corners);
    }
    Ok(result)
}

/// Nodes of a file. The table finds a node by its tag and marks the nodes that elements use.
struct NodeTable {
    positions: Vec<(u64, DVec3)>,
    index: HashMap<u64, u32>,
    used: Vec<bool>,
}

impl NodeTable {
    fn new(file: &Sections, scale: f64) -> Result<Self, MshError> {
        let limit = UNUSED as usize;
        if file.nodes.len() > limit {
            return Err(MshError::TooLarge { what: "nodes", count: file.nodes.len(), limit });
        }
        let mut index = HashMap::with_capacity(file.nodes.len());
        let mut positions = Vec::with_capacity(file.nodes.len());
        for (number, (tag, position)) in file.nodes.iter().enumerate() {
            if index.insert(*tag, number as u32).is_some() {
                return Err(MshError::DuplicateNode(*tag));
            }
            let position = *position * scale;
            if !position.is_finite() {
                let DVec3 { x, y, z } = position;
                return Err(MshError::NotFinite { tag: *tag, x, y, z });
            }
            positions.push((*tag, position));
        }
        Ok(Self { used: vec![false; positions.len()], positions, index })
    }

    fn index(&mut self, tag: u64) -> Option<u32> {
        let index = *self.index.get(&tag)?;
        self.used[index as usize] = true;
        Some(index)
    }

    /// Moves the used nodes to the mesh, and renumbers the nodes of its elements and sets.
    fn drop_unused(self, mesh: &mut Mesh) {
        let mut new_index = vec![UNUSED; self.positions.len()];
        for (old, (tag, position)) in self.positions.iter().enumerate().filter(|(old, _)| self.used[*old]) {
            new_index[old] = mesh.nodes.len() as u32;
            mesh.node_tags.push(*tag);
            mesh.nodes.push(*position);
        }
        let triangles = mesh.sets.iter_mut().flat_map(|set| set.triangles.iter_mut().flatten());
        for node in mesh.tets.iter_mut().flatten().chain(triangles) {
            *node = new_index[*node as usize];
        }
        let in_sets = mesh.node_sets.iter_mut().flat_map(|set| &mut set.nodes);
        in_sets.for_each(|node| *node = new_index[*node as usize]);
    }
}
