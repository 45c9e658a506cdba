//! Gmsh geometry of an armour unit for tetrahedral meshes, with exact cones and plane faces instead of triangles.

use std::fmt::Write;

use super::{ArmourUnit, tetrapod};
use crate::geometry::convex::polyhedron::Polyhedron;

/// Returns a `.geo` file for the OpenCASCADE kernel of Gmsh 4: the unit in body axes [m] as one volume, with mesh size
/// `size` [m]. `None` for a unit from STL, whose exact shape is unknown.
pub fn geometry(unit: &ArmourUnit, size: f64) -> Option<String> {
    let mut text = String::from("// Armour unit about its centre of mass, lengths in metres. Mesh: gmsh -3 FILE\n");
    text.push_str("SetFactory(\"OpenCASCADE\");\n");
    // Writing to a String cannot fail.
    let _ = writeln!(text, "Mesh.MeshSizeMin = {size};\nMesh.MeshSizeMax = {size};\nMesh.MshFileVersion = 4.1;");
    let count = if unit.is_tetrapod() {
        cones(unit.height(), &mut text)
    } else if unit.is_exact() {
        polyhedra(unit.blocks(), &mut text)
    } else {
        return None;
    };
    if count > 1 {
        let _ = writeln!(text, "BooleanUnion{{ Volume{{1}}; Delete; }}{{ Volume{{2:{count}}}; Delete; }}");
    }
    text.push_str("Physical Volume(\"unit\") = Volume{:};\n");
    Some(text)
}

/// Writes the legs of a Tetrapod as cones from its centre to the tips; returns the number of legs.
fn cones(height: f64, text: &mut String) -> usize {
    let ([base, tip], length) = tetrapod::cone(height);
    for (index, axis) in tetrapod::leg_axes().iter().enumerate() {
        let leg = *axis * length;
        let _ = writeln!(text, "Cone({}) = {{0, 0, 0, {}, {}, {}, {base}, {tip}}};", index + 1, leg.x, leg.y, leg.z);
    }
    tetrapod::leg_axes().len()
}

/// Writes the corners, edges and faces of polyhedra; returns the number of polyhedra. All curve loops precede the first
/// surface, because OpenCASCADE assigns the next free number to the outline of a surface.
fn polyhedra(blocks: &[Polyhedron], text: &mut String) -> usize {
    let (mut points, mut lines, mut faces) = (0, 0, 0);
    let (mut surfaces, mut volumes) = (String::new(), String::new());
    for (number, block) in blocks.iter().enumerate() {
        for corner in block.corners() {
            points += 1;
            let _ = writeln!(text, "Point({points}) = {{{}, {}, {}}};", corner.x, corner.y, corner.z);
        }
        let first_point = points - block.corners().len() + 1;
        let first_line = lines + 1;
        for edge in block.edges() {
            lines += 1;
            let [a, b] = edge.ends.map(|end| first_point + end);
            let _ = writeln!(text, "Line({lines}) = {{{a}, {b}}};");
        }
        let first_face = faces + 1;
        for face in block.faces() {
            faces += 1;
            let next = face.ring.iter().cycle().skip(1);
            let sides: Vec<String> = face.ring.iter().zip(next).map(|(a, b)| line(block, first_line, *a, *b)).collect();
            let _ = writeln!(text, "Curve Loop({faces}) = {{{}}};", sides.join(", "));
            let _ = writeln!(surfaces, "Plane Surface({faces}) = {{{faces}}};");
        }
        let volume = number + 1;
        let _ = writeln!(surfaces, "Surface Loop({volume}) = {{{first_face}:{faces}}};");
        let _ = writeln!(volumes, "Volume({volume}) = {{{volume}}};");
    }
    text.push_str(&surfaces);
    text.push_str(&volumes);
    blocks.len()
}

/// Number of the line from corner `a` to corner `b`, negative if the line has the opposite direction.
fn line(block: &Polyhedron, first_line: usize, a: usize, b: usize) -> String {
    let forward = block.edges().iter().position(|edge| edge.ends == [a, b]);
    let backward = block.edges().iter().position(|edge| edge.ends == [b, a]);
    match (forward, backward) {
        (Some(index), _) => (first_line + index).to_string(),
        (None, Some(index)) => format!("-{}", first_line + index),
        // Unreachable, because every side of a face is an edge.
        (None, None) => "0".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polyhedron_faces_refer_to_existing_lines() {
        for unit in [ArmourUnit::dolos(1.0, 0.34, 0.03).unwrap(), ArmourUnit::grooved_cube(1.0, 0.03).unwrap()] {
            let text = geometry(&unit, 0.1).unwrap();
            assert!(!text.contains("{0,") && !text.contains(", 0}") && !text.contains(" 0,"), "{text}");
            assert_eq!(text.matches("\nVolume(").count(), unit.blocks().len());
        }
        assert_eq!(geometry(&ArmourUnit::tetrapod(1.0, 0.05).unwrap(), 0.1).unwrap().matches("Cone(").count(), 4);
    }
}
