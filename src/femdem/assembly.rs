//! Nodes and tetrahedra as arrays, and node splitting.
//!
//! Each vertex of a tetrahedron is a copy of a mesh node. A solver node is a list of copies that move together. With
//! joints from the start, every copy is a node of its own. With tied faces, a node is split as soon as the tied faces
//! around it no longer connect its copies.

use glam::DVec3;

use super::element::Shape;
use super::rigid_body::RIGID;
use super::setup::Setup;

/// Marks a face without an interface.
const OUTSIDE: u32 = u32::MAX;

/// Number of a node copy: 4 x tetrahedron + vertex.
pub type Copy4 = u32;

/// Positions, velocities and masses of the nodes.
#[derive(Debug, Clone, Default)]
pub struct Nodes {
    /// Positions x [m].
    pub place: Vec<DVec3>,
    /// Velocities v [m/s], half a time step before the positions.
    pub velocity: Vec<DVec3>,
    /// Lumped masses [kg].
    pub mass: Vec<f64>,
    /// Constraint number of each node, from 1; 0 is a free node, [`RIGID`] a node of a rigid body.
    pub constraint: Vec<u16>,
    /// Copies of each node.
    pub ties: Ties,
}

impl Nodes {
    /// Number of nodes.
    pub fn count(&self) -> usize {
        self.place.len()
    }

    /// Replaces the initial nodes by the nodes of a later time. `vertices` are the node numbers at the vertices of the
    /// tetrahedra; each node has a position [m] and a velocity [m/s]. Copies, masses and constraints follow from the
    /// vertices and the initial nodes.
    ///
    /// # Errors
    /// Says why these nodes cannot result from splitting the initial ones.
    pub(super) fn come_apart(
        &mut self,
        tets: &mut Tets,
        setup: &Setup,
        vertices: Vec<[u32; 4]>,
        [place, velocity]: [Vec<DVec3>; 2],
    ) -> Result<(), &'static str> {
        let count = place.len();
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
            copies[(*begin + *found) as usize] = copy as Copy4;
            *found += 1;
        }
        let ties = Ties { span, copies };
        let mesh_node = |copy: Copy4| setup.tets[copy as usize / 4][copy as usize % 4];
        let initial_node = |copy: Copy4| tets.nodes[copy as usize / 4][copy as usize % 4] as usize;
        let (mut mass, mut constraint) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for node in 0..count {
            let node_copies = ties.of(node);
            let Some(first_copy) = node_copies.first() else { return Err("it has nodes without a tetrahedron") };
            if node_copies.iter().any(|copy| mesh_node(*copy) != mesh_node(*first_copy)) {
                return Err("it merges nodes that are separate in the mesh");
            }
            mass.push(lumped_mass(node_copies, tets, setup));
            constraint.push(self.constraint[initial_node(*first_copy)]);
        }
        tets.nodes = vertices;
        *self = Self { place, velocity, mass, constraint, ties };
        Ok(())
    }
}

/// The copies of every node.
#[derive(Debug, Clone, Default)]
pub struct Ties {
    /// Start and number of the copies of each node in `copies`.
    span: Vec<[u32; 2]>,
    copies: Vec<Copy4>,
}

impl Ties {
    /// Returns the copies of a node.
    #[inline]
    pub fn of(&self, node: usize) -> &[Copy4] {
        let [first, count] = self.span[node];
        &self.copies[first as usize..(first + count) as usize]
    }
}

/// The tetrahedra.
#[derive(Debug, Clone, Default)]
pub struct Tets {
    /// Nodes at the vertices.
    pub nodes: Vec<[u32; 4]>,
    /// Undeformed shapes.
    pub shape: Vec<Shape>,
    /// Body numbers.
    pub body: Vec<u16>,
    /// Interface at the face opposite to each vertex.
    pub faces: Vec<[Link; 4]>,
    /// Whether one of the faces has, or had, a joint.
    pub jointed: Vec<bool>,
}

/// Reference from a face of a tetrahedron to its interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// 2 x interface number + side; [`OUTSIDE`] if there is none.
    code: u32,
    /// Vertices of the face in the order of the interface.
    pub nodes: [u8; 3],
}

impl Link {
    const NONE: Self = Self { code: OUTSIDE, nodes: [0; 3] };

    /// Returns the interface number and the side, if there is an interface.
    #[inline]
    pub fn interface(self) -> Option<(usize, usize)> {
        (self.code != OUTSIDE).then_some((self.code as usize / 2, self.code as usize % 2))
    }
}

/// Returns the vertex opposite to a face.
pub fn opposite(face: [u8; 3]) -> usize {
    6 - face.iter().map(|v| usize::from(*v)).sum::<usize>()
}

impl Tets {
    /// Builds the tetrahedra of a setup, with mesh nodes at their vertices.
    pub fn new(setup: &Setup) -> Self {
        let shape = setup.tets.iter().map(|tet| Shape::new(&tet.map(|v| setup.nodes[v as usize]))).collect();
        let mut body = vec![0; setup.tets.len()];
        for (number, solid) in setup.bodies.iter().enumerate() {
            body[solid.tets.clone()].fill(number as u16);
        }
        let mut faces = vec![[Link::NONE; 4]; setup.tets.len()];
        for (number, interface) in setup.interfaces.iter().enumerate() {
            for side in 0..2 {
                let face = opposite(interface.nodes[side]);
                let link = Link { code: (2 * number + side) as u32, nodes: interface.nodes[side] };
                faces[interface.tets[side] as usize][face] = link;
            }
        }
        Self { nodes: setup.tets.clone(), shape, body, faces, jointed: vec![false; setup.tets.len()] }
    }
}

/// Builds nodes and tetrahedra: copies of a mesh node that `tied` faces connect become one node. Nodes are numbered in
/// the order of the tetrahedra.
pub fn assemble(setup: &Setup, tied: impl Fn(u32) -> bool) -> (Nodes, Tets) {
    let mut tets = Tets::new(setup);
    let around = copies_around(setup);
    let mut groups: Vec<Vec<Copy4>> = Vec::new();
    for copies in around.iter().filter(|copies| !copies.is_empty()) {
        groups.extend(held_together(&tets, setup, copies, &tied));
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
        nodes.place.push(position);
        nodes.velocity.push(body.velocity + body.angular_velocity.cross(position - body.pivot));
        nodes.constraint.push(if body.rigid { RIGID } else { constraint_of[mesh_node] });
        nodes.ties.span.push([nodes.ties.copies.len() as u32, group.len() as u32]);
        nodes.ties.copies.extend(&group);
    }
    for node in 0..nodes.count() {
        let copies = nodes.ties.of(node).to_vec();
        copies.iter().for_each(|copy| tets.nodes[*copy as usize / 4][*copy as usize % 4] = node as u32);
        nodes.mass.push(lumped_mass(&copies, &tets, setup));
    }
    (nodes, tets)
}

/// Returns all copies of every mesh node, in ascending order.
pub fn copies_around(setup: &Setup) -> Vec<Vec<Copy4>> {
    let mut around: Vec<Vec<Copy4>> = vec![Vec::new(); setup.nodes.len()];
    for (t, tet) in setup.tets.iter().enumerate() {
        for (k, v) in tet.iter().enumerate() {
            around[*v as usize].push((4 * t + k) as Copy4);
        }
    }
    around
}

/// Lumped mass of a node [kg]: a quarter of the mass of the tetrahedron of each copy.
fn lumped_mass(copies: &[Copy4], tets: &Tets, setup: &Setup) -> f64 {
    let quarter = |copy: &Copy4| {
        let t = *copy as usize / 4;
        0.25 * setup.bodies[usize::from(tets.body[t])].elastic.density * tets.shape[t].volume
    };
    copies.iter().map(quarter).sum()
}

/// Splits the copies of a node into groups connected by tied faces. Copies and groups are in ascending order. In a body
/// that cannot crack, all copies are one group.
pub fn held_together(tets: &Tets, setup: &Setup, copies: &[Copy4], tied: &impl Fn(u32) -> bool) -> Vec<Vec<Copy4>> {
    let body = usize::from(tets.body[copies[0] as usize / 4]);
    if setup.bodies[body].cohesion.is_none() {
        return vec![copies.to_vec()];
    }
    let mut group = vec![usize::MAX; copies.len()];
    let mut groups: Vec<Vec<Copy4>> = Vec::new();
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

/// Returns the copies of the same node across the tied faces of a copy's tetrahedron.
fn tied_neighbours<'a>(
    tets: &'a Tets,
    setup: &'a Setup,
    copy: Copy4,
    tied: &'a impl Fn(u32) -> bool,
) -> impl Iterator<Item = Copy4> + 'a {
    let (t, k) = (copy as usize / 4, copy as usize % 4);
    let links = tets.faces[t].into_iter().enumerate().filter(move |(face, _)| *face != k);
    links.filter_map(|(_, link)| link.interface()).filter(|(number, _)| tied(*number as u32)).filter_map(
        move |(number, side)| {
            let interface = &setup.interfaces[number];
            let corner = interface.nodes[side].iter().position(|v| usize::from(*v) == k)?;
            let other = interface.tets[1 - side] as usize;
            Some((4 * other + usize::from(interface.nodes[1 - side][corner])) as Copy4)
        },
    )
}

/// Splits the node at a corner of a face that is no longer tied, unless other tied faces still connect its copies.
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
    let [first, _] = nodes.ties.span[node];
    let groups = held_together(tets, setup, nodes.ties.of(node), tied);
    if groups.len() < 2 {
        return;
    }
    let mut begin = first;
    for (number, group) in groups.iter().enumerate() {
        let start = begin as usize;
        nodes.ties.copies[start..start + group.len()].copy_from_slice(group);
        let span = [begin, group.len() as u32];
        let mass = lumped_mass(group, tets, setup);
        if number == 0 {
            nodes.ties.span[node] = span;
            nodes.mass[node] = mass;
        } else {
            let new = nodes.count() as u32;
            nodes.place.push(nodes.place[node]);
            nodes.velocity.push(nodes.velocity[node]);
            nodes.constraint.push(nodes.constraint[node]);
            nodes.mass.push(mass);
            nodes.ties.span.push(span);
            group.iter().for_each(|copy| tets.nodes[*copy as usize / 4][*copy as usize % 4] = new);
        }
        begin += group.len() as u32;
    }
}
