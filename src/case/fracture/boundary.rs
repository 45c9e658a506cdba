//! Validates the friction between the bodies of a fracture case, and the constraints.

use std::collections::BTreeSet;

use super::loads::factor;
use crate::case::file::{BodyFrictionFile, FractureFile, VelocityFile};
use crate::case::reading::check::{Checker, at_least};
use crate::femdem::loads::history::History;
use crate::femdem::mesh::PreparedMesh;
use crate::femdem::mesh::faces::FaceSet;
use crate::femdem::setup::Constraint;

/// Returns the friction coefficients [-] as a symmetric table: row and column are body indices in the order of the
/// mesh.
pub fn friction(file: &FractureFile, mesh: &PreparedMesh, check: &mut Checker) -> Vec<Vec<f64>> {
    let count = mesh.mesh.bodies.len();
    let mut table = vec![vec![0.0; count]; count];
    for (index, BodyFrictionFile { between, coefficient }) in file.friction.iter().enumerate() {
        let path = format!("friction[{index}].coefficient");
        check.number(&path, *coefficient, at_least(0.0).up_to(10.0), "", "concrete on concrete has 0.6");
        let numbers = between.each_ref().map(|name| mesh.mesh.bodies.iter().position(|body| body.name == *name));
        match numbers {
            [Some(a), Some(b)] => {
                table[a][b] = *coefficient;
                table[b][a] = *coefficient;
            }
            _ => check.reject(
                &format!("friction[{index}].between"),
                format!("{between:?}"),
                "names of two bodies of the mesh",
                "for the crack faces of one body, write its name twice",
            ),
        }
    }
    table
}

/// Returns the nodes of a named set of the mesh in ascending order.
fn nodes_of(name: &str, mesh: &PreparedMesh) -> Option<Vec<u32>> {
    if let Some(set) = mesh.mesh.node_sets.iter().find(|set| set.name == name) {
        return Some(set.nodes.clone());
    }
    let set: &FaceSet = mesh.faces.boundaries.iter().find(|set| set.name == name)?;
    let corners = set.faces.iter().flat_map(|face| {
        let exterior = &mesh.faces.exteriors[*face as usize];
        exterior.nodes.map(|corner| mesh.mesh.tets[exterior.tet as usize][usize::from(corner)])
    });
    let nodes: BTreeSet<u32> = corners.collect();
    Some(nodes.into_iter().collect())
}

/// Returns the constraints. If a node belongs to several sets, the last set that gives a velocity component determines
/// this component.
pub fn constraints(file: &FractureFile, mesh: &PreparedMesh, check: &mut Checker) -> Vec<Constraint> {
    let mut histories: Vec<History<1>> = Vec::new();
    // For each node and direction, the index into `histories`.
    let mut histories_of_node: Vec<[Option<u32>; 3]> = vec![[None; 3]; mesh.mesh.nodes.len()];
    for (index, constraint) in file.constraints.iter().enumerate() {
        let Some(nodes) = nodes_of(&constraint.set, mesh) else {
            let surfaces = mesh.faces.boundaries.iter().map(|set| set.name.as_str());
            let names: Vec<&str> = surfaces.chain(mesh.mesh.node_sets.iter().map(|set| set.name.as_str())).collect();
            let allowed = format!("one of {}", names.join(", "));
            let advice = "sets are the physical surfaces, curves and points of the mesh";
            check.reject(&format!("constraints[{index}].set"), format!("{:?}", constraint.set), allowed, advice);
            continue;
        };
        for (axis, given) in constraint.velocity_m_s.iter().enumerate() {
            let Some(given) = given else { continue };
            let path = format!("constraints[{index}].velocity_m_s[{axis}]");
            let Some(history) = velocity(given, &path, check) else { continue };
            let number = histories.iter().position(|known| *known == history).unwrap_or_else(|| {
                histories.push(history);
                histories.len() - 1
            });
            nodes.iter().for_each(|node| histories_of_node[*node as usize][axis] = Some(number as u32));
        }
    }
    let mut kinds: Vec<[Option<u32>; 3]> = Vec::new();
    let mut constraints: Vec<Constraint> = Vec::new();
    for (node, kind) in histories_of_node.into_iter().enumerate().filter(|(_, kind)| kind.iter().any(Option::is_some)) {
        match kinds.iter().position(|known| *known == kind) {
            Some(index) => constraints[index].nodes.push(node as u32),
            None => {
                kinds.push(kind);
                let velocity = kind.map(|number| number.map(|number| histories[number as usize].clone()));
                constraints.push(Constraint { nodes: vec![node as u32], velocity });
            }
        }
    }
    constraints
}

fn velocity(given: &VelocityFile, path: &str, check: &mut Checker) -> Option<History<1>> {
    let range = || at_least(-1e4).up_to(1e4);
    match given {
        VelocityFile::Constant(v) => {
            check.number(path, *v, range(), "m/s", "0 fixes the nodes").then(|| History::from(*v))
        }
        VelocityFile::History(rows) => {
            let mut good = true;
            for (row, [_, v]) in rows.iter().enumerate() {
                good &= check.number(&format!("{path}[{row}][1]"), *v, range(), "m/s", "0 fixes the nodes");
            }
            factor(rows, path, check).filter(|_| good)
        }
    }
}
