//! Sorts tetrahedra and nodes so that neighbours in space are neighbours in memory.
//!
//! Tetrahedra follow the Z-order curve of Morton (1966) through their centroids; nodes are in the order in which the
//! tetrahedra first use them. The solver then finds most data in the cache.

use glam::DVec3;

use super::{Mesh, TriangleSet};

/// Bits of a Morton code per axis. The three axes need 63 of 64 bits.
const BITS: u32 = 21;

/// Marks a node that has no new number yet.
const UNUSED: u32 = u32::MAX;

/// Returns the mesh with the tetrahedra of each body sorted along the Z-order curve. Tags move with their nodes and
/// tetrahedra. Tetrahedra with the same Morton code keep their order, so the result depends only on the mesh. Nodes
/// that only triangles use come last.
pub fn along_curve(mesh: &Mesh) -> Mesh {
    let mut order = Vec::with_capacity(mesh.tets.len());
    for body in &mesh.bodies {
        let centroids: Vec<DVec3> = body.tets.clone().map(|tet| mesh.centroid(tet)).collect();
        let min = centroids.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let max = centroids.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let size = (max - min).max_element();
        let codes = centroids.iter().map(|centroid| morton((*centroid - min) / size));
        let mut coded: Vec<(u64, usize)> = codes.zip(body.tets.clone()).collect();
        coded.sort_unstable();
        order.extend(coded.into_iter().map(|(_, tet)| tet));
    }
    let mut sorted = Mesh {
        tets: order.iter().map(|tet| mesh.tets[*tet]).collect(),
        tet_tags: order.iter().map(|tet| mesh.tet_tags[*tet]).collect(),
        bodies: mesh.bodies.clone(),
        sets: mesh.sets.clone(),
        node_sets: mesh.node_sets.clone(),
        nodes: Vec::with_capacity(mesh.nodes.len()),
        node_tags: Vec::with_capacity(mesh.nodes.len()),
    };
    let mut new_index = vec![UNUSED; mesh.nodes.len()];
    let triangles = |set: &TriangleSet| set.triangles.clone().into_iter().flatten();
    for old in sorted.tets.clone().into_iter().flatten().chain(mesh.sets.iter().flat_map(triangles)) {
        let old = old as usize;
        if new_index[old] == UNUSED {
            new_index[old] = sorted.nodes.len() as u32;
            sorted.nodes.push(mesh.nodes[old]);
            sorted.node_tags.push(mesh.node_tags[old]);
        }
    }
    let triangles = sorted.sets.iter_mut().flat_map(|set| set.triangles.iter_mut().flatten());
    for node in sorted.tets.iter_mut().flatten().chain(triangles) {
        *node = new_index[*node as usize];
    }
    for set in &mut sorted.node_sets {
        // Every node of a set has a new number, because it is a node of a tetrahedron.
        set.nodes.iter_mut().for_each(|node| *node = new_index[*node as usize]);
        set.nodes.sort_unstable();
    }
    sorted
}

/// Morton code of a point in the unit cube: the interleaved bits of its coordinates.
fn morton(point: DVec3) -> u64 {
    let cells = f64::from((1u32 << BITS) - 1);
    // For a body of one tetrahedron, `point` is 0/0 = NaN. The cast turns NaN into 0.
    let [x, y, z] = point.to_array().map(|coordinate| spread((coordinate * cells) as u64));
    x | (y << 1) | (z << 2)
}

/// Inserts two zero bits between neighbouring bits of a number that has [`BITS`] bits.
fn spread(number: u64) -> u64 {
    let mut bits = number;
    for (shift, mask) in [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        bits = (bits | (bits << shift)) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::super::block::{Pattern, block};
    use super::super::prepare;
    use super::*;

    #[test]
    fn morton_codes_interleave_the_bits() {
        assert_eq!(morton(DVec3::ZERO), 0);
        assert_eq!(morton(DVec3::ONE), (1 << (3 * BITS)) - 1);
        for bit in 0..BITS {
            assert_eq!(spread(1 << bit), 1 << (3 * bit));
        }
        assert_eq!(morton(DVec3::NAN), 0);
    }

    #[test]
    fn the_sorted_mesh_does_not_depend_on_the_order_of_elements_in_the_file() {
        let mesh = block(DVec3::new(1.0, 2.0, 3.0), [4, 5, 6], Pattern::Centred);
        let sorted = along_curve(&mesh);
        assert_eq!(along_curve(&sorted), sorted);
        let mut turned = mesh.clone();
        turned.tets.reverse();
        turned.tet_tags.reverse();
        // In this mesh, no two centroids have the same Morton code, so the sorted mesh does not depend on the order.
        assert_eq!(along_curve(&turned), sorted);
    }

    #[test]
    fn sorting_keeps_tags_and_brings_neighbours_together() {
        let mesh = block(DVec3::ONE, [16; 3], Pattern::Diagonal);
        let sorted = prepare(mesh.clone()).unwrap().mesh;
        for (tet, tag) in sorted.tets.iter().zip(&sorted.tet_tags) {
            let old = mesh.tets[*tag as usize - 1].map(|node| mesh.node_tags[node as usize]);
            assert_eq!(tet.map(|node| sorted.node_tags[node as usize]), old);
        }
        for (node, tag) in sorted.nodes.iter().zip(&sorted.node_tags) {
            assert_eq!(*node, mesh.nodes[*tag as usize - 1]);
        }
        // `span` is the range of the node numbers of a tetrahedron. `block` numbers nodes by layers, so without sorting
        // the range is typically more than the 17 x 17 = 289 nodes of a layer.
        let span = |tet: &[u32; 4]| tet.iter().max().unwrap() - tet.iter().min().unwrap();
        let median = |mesh: &Mesh| {
            let mut spans: Vec<u32> = mesh.tets.iter().map(span).collect();
            spans.sort_unstable();
            spans[spans.len() / 2]
        };
        assert!(median(&mesh) > 289 && median(&sorted) < 289, "{} -> {}", median(&mesh), median(&sorted));
        assert_eq!(sorted.tets[0], [0, 1, 2, 3], "nodes are numbered in the order of their first use");
    }
}
