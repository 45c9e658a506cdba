//! Nodes, tetrahedra and joints as arrays, and how nodes come apart.
//!
//! A vertex of a tetrahedron is a copy of a node of the mesh. Copies that are tied to each other move as one node; a node
//! is the list of its copies. Where joints hold from the start, every copy is a node of its own; where faces are tied
//! until they fail, a node is split when the faces around it no longer tie its copies together.

use glam::DVec3;

use super::element::Shape;
use super::rigid_body::RIGID;
use super::setup::Setup;

/// No interface at a face.
const OUTSIDE: u32 = u32::MAX;

/// A copy of a node: four times the tetrahedron and the vertex.
pub type Copy4 = u32;

/// Places, motion and masses of the nodes.
#[derive(Debug, Clone, Default)]
pub struct Nodes {
    /// Places x [m].
    pub place: Vec<DVec3>,
    /// Velocities v [m/s], half a step before the places.
    pub velocity: Vec<DVec3>,
    /// Masses [kg].
    pub mass: Vec<f64>,
    /// Constraint of each, counted from 1; 0 is free, [`RIGID`] moves with its body.
    pub constraint: Vec<u16>,
    /// Copies that move as each of them.
    pub ties: Ties,
}

impl Nodes {
    /// How many.
    pub fn count(&self) -> usize {
        self.place.len()
    }

    /// Nodes of a later moment: `vertices` are those at the vertices of the tetrahedra, by number, with their places [m]
    /// and velocities [m/s]. Copies, masses and constraints follow from the vertices and from the nodes of the start,
    /// which these are. The tetrahedra get the new vertices.
    ///
    /// # Errors
    /// If nodes cannot have come apart like that: what is wrong.
    pub(super) fn come_apart(
        &mut self,
        tets: &mut Tets,
        setup: &Setup,
        vertices: Vec<[u32; 4]>,
        [place, velocity]: [Vec<DVec3>; 2],
    ) -> Result<(), &'static str> {
        let count = place.len();
        let known = |node: &u32| (*node as usize) < count;
        if velocity.len() != count || vertices.len() != setup.tets.len() || !vertices.iter().flatten().all(known) {
            return Err("its nodes and tetrahedra are not those of the mesh");
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
        let origin = |copy: Copy4| setup.tets[copy as usize / 4][copy as usize % 4];
        let at_start = |copy: Copy4| tets.nodes[copy as usize / 4][copy as usize % 4] as usize;
        let (mut mass, mut constraint) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for node in 0..count {
            let of_node = ties.of(node);
            let Some(one) = of_node.first() else { return Err("it has nodes without a tetrahedron") };
            if of_node.iter().any(|copy| origin(*copy) != origin(*one)) {
                return Err("it ties nodes together that are apart in the mesh");
            }
            mass.push(mass_of(of_node, tets, setup));
            constraint.push(self.constraint[at_start(*one)]);
        }
        tets.nodes = vertices;
        *self = Self { place, velocity, mass, constraint, ties };
        Ok(())
    }
}

/// The copies of every node.
#[derive(Debug, Clone, Default)]
pub struct Ties {
    /// First of its copies and how many, in `copies`.
    span: Vec<[u32; 2]>,
    copies: Vec<Copy4>,
}

impl Ties {
    /// Copies that move as this node.
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
    /// Number of the body.
    pub body: Vec<u16>,
    /// Interface at the face opposite to each vertex.
    pub faces: Vec<[Link; 4]>,
    /// Whether a joint pulls, or has pulled, at one of its faces.
    pub jointed: Vec<bool>,
}

/// Where a face of a tetrahedron is in the list of interfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// Number of the interface times two, and the side; [`OUTSIDE`] if there is none.
    code: u32,
    /// Vertices of the face in the order of the interface.
    pub nodes: [u8; 3],
}

impl Link {
    const NONE: Self = Self { code: OUTSIDE, nodes: [0; 3] };

    /// Number of the interface and side, if there is one.
    #[inline]
    pub fn interface(self) -> Option<(usize, usize)> {
        (self.code != OUTSIDE).then_some((self.code as usize / 2, self.code as usize % 2))
    }
}

/// Number of the vertex that is not on a face.
pub fn opposite(face: [u8; 3]) -> usize {
    6 - face.iter().map(|v| usize::from(*v)).sum::<usize>()
}

impl Tets {
    /// Tetrahedra of a setup with the nodes of the mesh.
    pub fn new(setup: &Setup) -> Self {
        let shape = setup.tets.iter().map(|tet| Shape::new(&tet.map(|v| setup.nodes[v as usize]))).collect();
        let mut body = vec![0; setup.tets.len()];
        for (number, of) in setup.bodies.iter().enumerate() {
            body[of.tets.clone()].fill(number as u16);
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

/// Groups the copies of every node of the mesh that `tied` faces hold together, and numbers the nodes in the order of the
/// tetrahedra.
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
        let origin = setup.tets[t][k] as usize;
        let of = &setup.bodies[usize::from(tets.body[t])];
        let place = setup.nodes[origin];
        nodes.place.push(place);
        nodes.velocity.push(of.velocity + of.angular_velocity.cross(place - of.pivot));
        nodes.constraint.push(if of.rigid { RIGID } else { constraint_of[origin] });
        nodes.ties.span.push([nodes.ties.copies.len() as u32, group.len() as u32]);
        nodes.ties.copies.extend(&group);
    }
    for node in 0..nodes.count() {
        let copies = nodes.ties.of(node).to_vec();
        copies.iter().for_each(|copy| tets.nodes[*copy as usize / 4][*copy as usize % 4] = node as u32);
        nodes.mass.push(mass_of(&copies, &tets, setup));
    }
    (nodes, tets)
}

/// All copies of every node of the mesh, in rising order.
pub fn copies_around(setup: &Setup) -> Vec<Vec<Copy4>> {
    let mut around: Vec<Vec<Copy4>> = vec![Vec::new(); setup.nodes.len()];
    for (t, tet) in setup.tets.iter().enumerate() {
        for (k, v) in tet.iter().enumerate() {
            around[*v as usize].push((4 * t + k) as Copy4);
        }
    }
    around
}

/// A quarter of the mass of every tetrahedron [kg].
fn mass_of(copies: &[Copy4], tets: &Tets, setup: &Setup) -> f64 {
    let quarter = |copy: &Copy4| {
        let t = *copy as usize / 4;
        0.25 * setup.bodies[usize::from(tets.body[t])].elastic.density * tets.shape[t].volume
    };
    copies.iter().map(quarter).sum()
}

/// Copies of one node in groups that tied faces hold together; each in rising order, the groups by their first. A body
/// that does not crack holds together everywhere.
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
            for neighbour in neighbours(tets, setup, copy, tied) {
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

/// Copies of the same node across the tied faces of its tetrahedron.
fn neighbours<'a>(
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

/// Splits the node at a corner of a face that has come free, if nothing else ties its copies.
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
    let mut at = first;
    for (number, group) in groups.iter().enumerate() {
        let place = at as usize;
        nodes.ties.copies[place..place + group.len()].copy_from_slice(group);
        let span = [at, group.len() as u32];
        let mass = mass_of(group, tets, setup);
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
        at += group.len() as u32;
    }
}
