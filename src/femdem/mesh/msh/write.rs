//! Writes meshes as MSH 4.1 files, with one entity per body and per set. All nodes of a node set are written as
//! elements of one point entity.

use super::super::Mesh;

/// Output buffer for text or binary content.
struct Sink {
    bytes: Vec<u8>,
    binary: bool,
}

impl Sink {
    fn text(&mut self, line: &str) {
        self.bytes.extend_from_slice(line.as_bytes());
    }

    fn int(&mut self, number: i32) {
        if self.binary { self.bytes.extend(number.to_le_bytes()) } else { self.text(&format!("{number} ")) }
    }

    fn size(&mut self, number: usize) {
        if self.binary { self.bytes.extend((number as u64).to_le_bytes()) } else { self.text(&format!("{number} ")) }
    }

    fn real(&mut self, number: f64) {
        if self.binary { self.bytes.extend(number.to_le_bytes()) } else { self.text(&format!("{number:?} ")) }
    }

    fn ints(&mut self, numbers: &[i32]) {
        numbers.iter().for_each(|number| self.int(*number));
    }

    fn sizes(&mut self, numbers: &[usize]) {
        numbers.iter().for_each(|number| self.size(*number));
    }

    fn reals(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|number| self.real(*number));
    }

    fn line_end(&mut self) {
        if !self.binary {
            self.text("\n");
        }
    }
}

/// Returns the content of a mesh file, as text or binary. Bodies become the volumes 1, 2, ..., triangle sets the
/// surfaces 1, 2, ..., and node sets the points 1, 2, ...
pub fn write(mesh: &Mesh, binary: bool) -> Vec<u8> {
    let mut sink = Sink { bytes: Vec::new(), binary };
    sink.text(if binary { "$MeshFormat\n4.1 1 8\n" } else { "$MeshFormat\n4.1 0 8\n" });
    if binary {
        sink.int(1);
    }
    sink.text("\n$EndMeshFormat\n$PhysicalNames\n");
    sink.text(&format!("{}\n", mesh.bodies.len() + mesh.sets.len() + mesh.node_sets.len()));
    for (tag, set) in (1..).zip(&mesh.node_sets) {
        sink.text(&format!("0 {tag} \"{}\"\n", set.name));
    }
    for (tag, set) in (1..).zip(&mesh.sets) {
        sink.text(&format!("2 {tag} \"{}\"\n", set.name));
    }
    for (tag, body) in (1..).zip(&mesh.bodies) {
        sink.text(&format!("3 {tag} \"{}\"\n", body.name));
    }
    sink.text("$EndPhysicalNames\n$Entities\n");
    sink.sizes(&[mesh.node_sets.len(), 0, mesh.sets.len(), mesh.bodies.len()]);
    sink.line_end();
    for tag in 1..=mesh.node_sets.len() as i32 {
        sink.int(tag);
        sink.reals(&[0.0; 3]);
        sink.size(1);
        sink.int(tag);
        sink.line_end();
    }
    for count in [mesh.sets.len(), mesh.bodies.len()] {
        for tag in 1..=count as i32 {
            sink.int(tag);
            sink.reals(&[0.0; 6]);
            sink.size(1);
            sink.int(tag);
            sink.size(0);
            sink.line_end();
        }
    }
    sink.text("\n$EndEntities\n$Nodes\n");
    let nodes = mesh.nodes.len();
    sink.sizes(&[1, nodes, 1, nodes]);
    sink.line_end();
    sink.ints(&[3, 1, 0]);
    sink.size(nodes);
    sink.line_end();
    for tag in &mesh.node_tags {
        sink.size(*tag as usize);
        sink.line_end();
    }
    for node in &mesh.nodes {
        sink.reals(&node.to_array());
        sink.line_end();
    }
    sink.text("\n$EndNodes\n$Elements\n");
    let triangles: usize = mesh.sets.iter().map(|set| set.triangles.len()).sum();
    let points: usize = mesh.node_sets.iter().map(|set| set.nodes.len()).sum();
    let elements = mesh.tets.len() + triangles + points;
    sink.sizes(&[mesh.bodies.len() + mesh.sets.len() + mesh.node_sets.len(), elements, 1, elements]);
    sink.line_end();
    let mut next_tag = mesh.tet_tags.iter().max().map_or(1, |tag| *tag as usize + 1);
    for (entity, set) in (1..).zip(&mesh.node_sets) {
        sink.ints(&[0, entity, 15]);
        sink.size(set.nodes.len());
        sink.line_end();
        for node in &set.nodes {
            sink.size(next_tag);
            next_tag += 1;
            sink.size(mesh.node_tags[*node as usize] as usize);
            sink.line_end();
        }
    }
    for (entity, set) in (1..).zip(&mesh.sets) {
        sink.ints(&[2, entity, 2]);
        sink.size(set.triangles.len());
        sink.line_end();
        for triangle in &set.triangles {
            sink.size(next_tag);
            next_tag += 1;
            sink.sizes(&triangle.map(|node| mesh.node_tags[node as usize] as usize));
            sink.line_end();
        }
    }
    for (entity, body) in (1..).zip(&mesh.bodies) {
        sink.ints(&[3, entity, 4]);
        sink.size(body.tets.len());
        sink.line_end();
        for tet in body.tets.clone() {
            sink.size(mesh.tet_tags[tet] as usize);
            sink.sizes(&mesh.tets[tet].map(|node| mesh.node_tags[node as usize] as usize));
            sink.line_end();
        }
    }
    sink.text("\n$EndElements\n");
    sink.bytes
}
