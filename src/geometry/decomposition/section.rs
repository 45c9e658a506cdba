//! Plane sections of a body: polygons, possibly with holes, as sets of directed edges.

use glam::DVec3;

/// Directed edge: indices of its start and its end.
pub(super) type Edge = [u32; 2];

/// Vector normal to a set of directed edges that form closed polygons in a plane; its length is the area.
pub(super) fn area(vertices: &[DVec3], edges: &[Edge]) -> DVec3 {
    let origin = vertices[edges[0][0] as usize];
    let twice = |[a, b]: &Edge| (vertices[*a as usize] - origin).cross(vertices[*b as usize] - origin);
    0.5 * edges.iter().map(twice).sum::<DVec3>()
}

/// Connected polygons of a plane section with the given normal. A hole goes to the polygon around it. Pairs of opposite
/// edges cancel.
pub(super) fn polygons(vertices: &[DVec3], edges: impl Iterator<Item = Edge>, normal: DVec3) -> Vec<Vec<Edge>> {
    let edges = without_opposites(edges);
    let mut used: Vec<u32> = edges.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let index = |v: u32| used.binary_search(&v).unwrap_or_default() as u32;
    let group = groups(used.len(), edges.iter().map(|edge| edge.map(index)));
    let mut sorted: Vec<(u32, Edge)> = edges.iter().map(|edge| (group[index(edge[0]) as usize], *edge)).collect();
    sorted.sort_unstable();
    let outlines = sorted.chunk_by(|(a, _), (b, _)| a == b).map(|part| part.iter().map(|(_, edge)| *edge).collect());
    let (mut outer, holes): (Vec<_>, Vec<_>) =
        outlines.partition(|outline: &Vec<Edge>| area(vertices, outline).dot(normal) >= 0.0);
    for hole in holes {
        let corner = vertices[hole[0][0] as usize];
        let size = |outline: &Vec<Edge>| area(vertices, outline).length();
        let around = outer.iter_mut().filter(|outline| contains(vertices, outline, normal, corner));
        if let Some(outline) = around.min_by(|a, b| size(a).total_cmp(&size(b))) {
            outline.extend(hole);
        } else {
            outer.push(hole);
        }
    }
    outer
}

/// Removes pairs of opposite edges.
fn without_opposites(edges: impl Iterator<Item = Edge>) -> Vec<Edge> {
    let mut signed: Vec<(Edge, i32)> = edges.map(|[a, b]| ([a.min(b), a.max(b)], if a < b { 1 } else { -1 })).collect();
    signed.sort_unstable();
    let mut left = Vec::new();
    for same in signed.chunk_by(|(a, _), (b, _)| a == b) {
        let ([a, b], sum) = (same[0].0, same.iter().map(|(_, sign)| sign).sum::<i32>());
        left.extend(std::iter::repeat_n(if sum > 0 { [a, b] } else { [b, a] }, sum.unsigned_abs() as usize));
    }
    left
}

/// Returns true if an odd number of edges crosses a ray from the point in the plane with the given normal.
fn contains(vertices: &[DVec3], edges: &[Edge], normal: DVec3, point: DVec3) -> bool {
    let (u, v) = normal.any_orthonormal_pair();
    let crosses = |[a, b]: &&Edge| {
        let [a, b] = [a, b].map(|index| vertices[*index as usize] - point);
        let [(x_a, y_a), (x_b, y_b)] = [a, b].map(|r| (r.dot(u), r.dot(v)));
        (y_a > 0.0) != (y_b > 0.0) && x_a + (x_b - x_a) * y_a / (y_a - y_b) > 0.0
    };
    edges.iter().filter(crosses).count() % 2 == 1
}

/// For each vertex, the lowest index of the vertices to which edges connect it.
pub(super) fn groups(count: usize, edges: impl Iterator<Item = Edge>) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..count as u32).collect();
    let root = |parent: &mut Vec<u32>, mut v: u32| {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    };
    for [a, b] in edges {
        let [a, b] = [root(&mut parent, a), root(&mut parent, b)];
        parent[a.max(b) as usize] = a.min(b);
    }
    (0..count as u32).map(|v| root(&mut parent, v)).collect()
}
