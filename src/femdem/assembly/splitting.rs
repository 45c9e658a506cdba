//! Node splitting: which copies of a mesh node move together as one node.
//!
//! If a body has joints from the start, every copy is a separate node. If its faces are tied, a node is split as soon
//! as the tied faces around it no longer connect all its copies.

use glam::DVec3;

use super::nodes::{NodeCopies, NodeCopy, Nodes, RIGID};
use super::tets::Tets;
use crate::femdem::setup::Setup;

impl Nodes {
    /// Replaces the initial nodes by the nodes of a later time. `vertices` are the node numbers at the vertices of the
    /// tetrahedra; each node has a position [m] and a velocity [m/s]. Copies, masses and constraints follow from the
    /// vertices and the initial nodes.
    ///
    /// # Errors
    /// If these nodes cannot result from splitting the initial nodes. The text gives the reason.
    pub fn restore_split(
        &mut self,
        tets: &mut Tets,
        setup: &Setup,
        vertices: Vec<[u32; 4]>,
        [position, velocity]: [Vec<DVec3>; 2],
    ) -> Result<(), &'static str> {
        let count = position.len();
        let exists = |node: &u32| (*node as usize) < count;
        if velocity.len() != count || vertices.len() != setup.tets.len() || !vertices.iter().flatten().all(exists) {
            return Err("its nodes and tetrahedra do not match the mesh");
        }
        let mut span = vec![[0; 2]; count];
        vertices.iter().flatten().for_each(|node| span[*node as usize][1] += 1);
        let mut first = 0;
        for [begin, copies] in &mut span {
            *begin = first;
            first += std::mem::take(copies);
        }
        let mut copies = vec![0; first as usize];
        for (copy, node) in vertices.iter().flatten().enumerate() {
            let [begin, found] = &mut span[*node as usize];
            copies[(*begin + *found) as usize] = copy as NodeCopy;
            *found += 1;
        }
        let mut restored = Self { position, velocity, copies: NodeCopies { span, list: copies }, ..Self::default() };
        let mesh_node = |copy: NodeCopy| setup.tets[copy as usize / 4][copy as usize % 4];
        let initial_node = |copy: NodeCopy| tets.nodes[copy as usize / 4][copy as usize % 4] as usize;
        for node in 0..count {
            let node_copies = restored.copies_of(node);
            let Some(first_copy) = node_copies.first() else { return Err("it has nodes without a tetrahedron") };
            if node_copies.iter().any(|copy| mesh_node(*copy) != mesh_node(*first_copy)) {
                return Err("it merges nodes that are separate in the mesh");
            }
            let constraint = self.constraint[initial_node(*first_copy)];
            restored.mass.push(lumped_mass(node_copies, tets, setup));
            restored.constraint.push(constraint);
        }
        tets.nodes = vertices;
        *self = restored;
        Ok(())
    }
}

/// Builds nodes and tetrahedra. Copies of a mesh node become one node if tied faces connect them. `tied(number)` is
/// true if the interface with this number is tied. Nodes are numbered in the order of the tetrahedra.
pub fn assemble(setup: &Setup, tied: impl Fn(u32) -> bool) -> (Nodes, Tets) {
    let mut tets = Tets::new(setup);
    let around = copies_around(setup);
    let mut groups: Vec<Vec<NodeCopy>> = Vec::new();
    for copies in around.iter().filter(|copies| !copies.is_empty()) {
        groups.extend(connected_groups(&tets, setup, copies, &tied));
    }
    groups.sort_unstable_by_key(|group| group[0]);
    let mut constraint_of = vec![0; setup.nodes.len()];
    for (number, constraint) in setup.constraints.iter().enumerate() {
        constraint.nodes.iter().for_each(|node| constraint_of[*node as usize] = number as u16 + 1);
    }
    let mut nodes = Nodes::default();
    for group in groups {
        let (t, k) = (group[0] as usize / 4, group[0] as usize % 4);
        let mesh_node = setup.tets[t][k] as usize;
        let body = &setup.bodies[usize::from(tets.body[t])];
        let position = setup.nodes[mesh_node];
        nodes.position.push(position);
        nodes.velocity.push(body.velocity + body.angular_velocity.cross(position - body.pivot));
        nodes.constraint.push(if body.rigid { RIGID } else { constraint_of[mesh_node] });
        nodes.copies.span.push([nodes.copies.list.len() as u32, group.len() as u32]);
        nodes.copies.list.extend(&group);
    }
    for node in 0..nodes.count() {
        let copies = nodes.copies_of(node).to_vec();
        copies.iter().for_each(|copy| tets.nodes[*copy as usize / 4][*copy as usize % 4] = node as u32);
        nodes.mass.push(lumped_mass(&copies, &tets, setup));
    }
    (nodes, tets)
}

/// Returns all copies of every mesh node, in ascending order.
pub fn copies_around(setup: &Setup) -> Vec<Vec<NodeCopy>> {
    let mut around: Vec<Vec<NodeCopy>> = vec![Vec::new(); setup.nodes.len()];
    for (t, tet) in setup.tets.iter().enumerate() {
        for (k, v) in tet.iter().enumerate() {
            around[*v as usize].push((4 * t + k) as NodeCopy);
        }
    }
    around
}

/// Returns the lumped mass of a node [kg]: a quarter of the mass of the tetrahedron of each copy.
fn lumped_mass(copies: &[NodeCopy], tets: &Tets, setup: &Setup) -> f64 {
    let quarter = |copy: &NodeCopy| {
        let t = *copy as usize / 4;
        0.25 * setup.bodies[usize::from(tets.body[t])].elastic.density * tets.shape[t].volume
    };
    copies.iter().map(quarter).sum()
}

/// Splits the copies of a node into groups; tied faces connect the copies of a group. `tied(number)` is true if the
/// face with this number connects its two tetrahedra. Copies and groups are in ascending order. In a body that cannot
/// crack, all copies form one group.
pub fn connected_groups(
    tets: &Tets,
    setup: &Setup,
    copies: &[NodeCopy],
    tied: &impl Fn(u32) -> bool,
) -> Vec<Vec<NodeCopy>> {
    let body = usize::from(tets.body[copies[0] as usize / 4]);
    if setup.bodies[body].cohesion.is_none() {
        return vec![copies.to_vec()];
    }
    let mut group = vec![usize::MAX; copies.len()];
    let mut groups: Vec<Vec<NodeCopy>> = Vec::new();
    for start in 0..copies.len() {
        if group[start] != usize::MAX {
            continue;
        }
        let number = groups.len();
        group[start] = number;
        let (mut found, mut next) = (vec![copies[start]], vec![copies[start]]);
        while let Some(copy) = next.pop() {
            for neighbour in tied_neighbours(tets, setup, copy, tied) {
                if let Ok(index) = copies.binary_search(&neighbour)
                    && group[index] == usize::MAX
                {
                    group[index] = number;
                    found.push(neighbour);
                    next.push(neighbour);
                }
            }
        }
        found.sort_unstable();
        groups.push(found);
    }
    groups
}

/// Returns the copies of the same mesh node in those tetrahedra that share a tied face with the tetrahedron of `copy`.
fn tied_neighbours<'a>(
    tets: &'a Tets,
    setup: &'a Setup,
    copy: NodeCopy,
    tied: &'a impl Fn(u32) -> bool,
) -> impl Iterator<Item = NodeCopy> + 'a {
    let (t, k) = (copy as usize / 4, copy as usize % 4);
    let links = tets.faces[t].into_iter().enumerate().filter(move |(face, _)| *face != k);
    links.filter_map(|(_, link)| link.interface()).filter(|(number, _)| tied(*number as u32)).filter_map(
        move |(number, side)| {
            let interface = &setup.interfaces[number];
            let corner = interface.nodes[side].iter().position(|v| usize::from(*v) == k)?;
            let other = interface.tets[1 - side] as usize;
            Some((4 * other + usize::from(interface.nodes[1 - side][corner])) as NodeCopy)
        },
    )
}

/// Splits the node at corner `corner` (0 to 2) of a face that is no longer tied. The node is not split if other tied
/// faces still connect all its copies. `tied(number)` is true if the interface with this number is tied.
pub fn split(
    nodes: &mut Nodes,
    tets: &mut Tets,
    setup: &Setup,
    interface: usize,
    corner: usize,
    tied: &impl Fn(u32) -> bool,
) {
    let face = &setup.interfaces[interface];
    let [one, other] = [0, 1].map(|side| tets.nodes[face.tets[side] as usize][usize::from(face.nodes[side][corner])]);
    if one != other {
        return;
    }
    let node = one as usize;
    let [first, _] = nodes.copies.span[node];
    let groups = connected_groups(tets, setup, nodes.copies_of(node), tied);
    if groups.len() < 2 {
        return;
    }
    let mut begin = first;
    for (number, group) in groups.iter().enumerate() {
        let start = begin as usize;
        nodes.copies.list[start..start + group.len()].copy_from_slice(group);
        let span = [begin, group.len() as u32];
        let mass = lumped_mass(group, tets, setup);
        if number == 0 {
            nodes.copies.span[node] = span;
            nodes.mass[node] = mass;
        } else {
            let new = nodes.count() as u32;
            nodes.position.push(nodes.position[node]);
            nodes.velocity.push(nodes.velocity[node]);
            nodes.constraint.push(nodes.constraint[node]);
            nodes.mass.push(mass);
            nodes.copies.span.push(span);
            group.iter().for_each(|copy| tets.nodes[*copy as usize / 4][*copy as usize % 4] = new);
        }
        begin += group.len() as u32;
    }
}
