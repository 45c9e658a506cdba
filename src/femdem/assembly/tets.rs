//! The tetrahedra, with references from their faces to the interfaces.

use crate::femdem::element::Shape;
use crate::femdem::setup::Setup;

/// Marks a face without an interface.
const OUTSIDE: u32 = u32::MAX;

/// The tetrahedra.
#[derive(Debug, Clone, Default)]
pub struct Tets {
    /// Node numbers at the vertices of each tetrahedron.
    pub nodes: Vec<[u32; 4]>,
    /// Undeformed shape of each tetrahedron.
    pub shape: Vec<Shape>,
    /// Number of the body of each tetrahedron.
    pub body: Vec<u16>,
    /// For each tetrahedron, the reference to the interface at the face opposite to each vertex.
    pub faces: Vec<[Link; 4]>,
    /// For each tetrahedron, true if one of its faces has, or had, a joint.
    pub jointed: Vec<bool>,
}

/// Reference from a face of a tetrahedron to its interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Link {
    /// 2 x interface number + side; [`OUTSIDE`] if the face has no interface.
    code: u32,
    /// Vertex numbers (0 to 3) of the face in the tetrahedron, in the corner order of the interface.
    pub nodes: [u8; 3],
}

impl Link {
    const NONE: Self = Self { code: OUTSIDE, nodes: [0; 3] };

    /// Returns the number of the interface and the side (0 or 1) of the tetrahedron; `None` without an interface.
    #[inline]
    pub fn interface(self) -> Option<(usize, usize)> {
        (self.code != OUTSIDE).then_some((self.code as usize / 2, self.code as usize % 2))
    }
}

impl Tets {
    /// Builds the tetrahedra of a setup, with the numbers of mesh nodes at their vertices.
    pub fn new(setup: &Setup) -> Self {
        let shape = setup.tets.iter().map(|tet| Shape::new(&tet.map(|v| setup.nodes[v as usize]))).collect();
        let mut body = vec![0; setup.tets.len()];
        for (number, solid) in setup.bodies.iter().enumerate() {
            body[solid.tets.clone()].fill(number as u16);
        }
        let mut faces = vec![[Link::NONE; 4]; setup.tets.len()];
        for (number, interface) in setup.interfaces.iter().enumerate() {
            for side in 0..2 {
                let nodes = interface.nodes[side];
                let opposite = 6 - nodes.iter().map(|v| usize::from(*v)).sum::<usize>();
                let link = Link { code: (2 * number + side) as u32, nodes };
                faces[interface.tets[side] as usize][opposite] = link;
            }
        }
        Self { nodes: setup.tets.clone(), shape, body, faces, jointed: vec![false; setup.tets.len()] }
    }
}
