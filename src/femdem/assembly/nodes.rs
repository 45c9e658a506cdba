//! The nodes of a world. A mesh node has a copy in each of its tetrahedra; copies that move together are one node.

use glam::DVec3;

/// Marks the nodes of rigid bodies in [`Nodes::constraint`]. The rigid body applies the constraints of these nodes.
pub const RIGID: u16 = u16::MAX;

/// Number of a node copy: 4 x number of its tetrahedron + number of its vertex in the tetrahedron (0 to 3).
pub type NodeCopy = u32;

/// Positions, velocities and masses of the nodes.
#[derive(Debug, Clone, Default)]
pub struct Nodes {
    /// Positions x [m].
    pub position: Vec<DVec3>,
    /// Velocities v [m/s]. They refer to half a time step before the time of the positions.
    pub velocity: Vec<DVec3>,
    /// Lumped masses [kg].
    pub mass: Vec<f64>,
    /// Number of the constraint of each node, counted from 1. 0 marks a free node, [`RIGID`] a node of a rigid body.
    pub constraint: Vec<u16>,
    /// Copies of each node.
    pub copies: NodeCopies,
}

impl Nodes {
    /// Returns the number of nodes.
    pub fn count(&self) -> usize {
        self.position.len()
    }

    /// Returns the copies of a node.
    #[inline]
    pub fn copies_of(&self, node: usize) -> &[NodeCopy] {
        self.copies.of(node)
    }
}

/// The copies of every node.
#[derive(Debug, Clone, Default)]
pub struct NodeCopies {
    /// For each node, the index of its first copy in `list` and the number of its copies.
    pub(super) span: Vec<[u32; 2]>,
    pub(super) list: Vec<NodeCopy>,
}

impl NodeCopies {
    /// Returns the copies of a node.
    #[inline]
    pub fn of(&self, node: usize) -> &[NodeCopy] {
        let [first, count] = self.span[node];
        &self.list[first as usize..(first + count) as usize]
    }
}
