use glam::DVec3;
use proptest::prelude::*;

use super::super::block::{Pattern, block};
use super::super::{Mesh, prepare};
use super::*;

/// Mesh of a box of 2 x 1 x 1 cells with a crack across its middle.
fn cracked() -> Mesh {
    let mut mesh = block(DVec3::new(2.0, 1.0, 1.0), [2, 1, 1], Pattern::Diagonal);
    let triangles = mesh.faces_within(|node| node.x == 1.0);
    mesh.sets.push(super::super::TriangleSet { name: "crack middle".to_owned(), triangles });
    mesh
}

/// The mesh of [`cracked`] as a text file.
fn text() -> String {
    String::from_utf8(write(&cracked(), false)).unwrap()
}

/// Error message of the reader for a text.
fn error_of(text: &str) -> String {
    parse(text.as_bytes(), 1.0).unwrap_err().to_string()
}

/// Error message of the reader for the text of [`text`] in which `to` replaces `from`. `from` must occur in the text.
fn error_with(from: &str, to: &str) -> String {
    let text = text();
    assert!(text.contains(from), "{from:?} not in {text}");
    error_of(&text.replacen(from, to, 1))
}

fn fixture(name: &str) -> Mesh {
    let path = format!("{}/tests/data/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
    parse(&std::fs::read(path).unwrap(), 1.0).unwrap()
}

#[test]
fn text_and_binary_read_back_as_written() {
    for pattern in [Pattern::Diagonal, Pattern::Centred] {
        let mut mesh = block(DVec3::new(0.3, 0.2, 0.1), [3, 2, 1], pattern);
        mesh.node_sets = vec![super::super::NodeSet { name: "support".to_owned(), nodes: vec![0, 2, 5] }];
        for binary in [false, true] {
            assert_eq!(parse(&write(&mesh, binary), 1.0).unwrap(), mesh);
        }
        // The same test with tags that have gaps, are not in order and are too large for 32 bits.
        mesh.node_tags.iter_mut().for_each(|tag| *tag = 5_000_000_000 - 7 * *tag);
        mesh.tet_tags.reverse();
        for binary in [false, true] {
            assert_eq!(parse(&write(&mesh, binary), 1.0).unwrap(), mesh);
        }
    }
}

#[test]
fn physical_curves_become_node_sets() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/fracture/meshes/beam-coarse.msh");
    let mesh = prepare(parse(&std::fs::read(path).unwrap(), 1.0).unwrap()).unwrap().mesh;
    let lines = [("load", 0.0, 0.04), ("support_left", -0.157, 0.0), ("support_right", 0.157, 0.0)];
    assert_eq!(mesh.node_sets.len(), lines.len());
    for (name, x, z) in lines {
        let set = mesh.node_sets.iter().find(|set| set.name == name).unwrap();
        assert!(set.nodes.len() > 2);
        let on_line = |at: DVec3| (at.x - x).abs() < 1e-9 && (at.z - z).abs() < 1e-9;
        assert!(set.nodes.iter().all(|node| on_line(mesh.nodes[*node as usize])), "{name}");
    }
}

#[test]
fn node_sets_must_belong_to_a_body_and_have_unique_names() {
    let mut mesh = cracked();
    mesh.node_sets = vec![super::super::NodeSet { name: "xmin".to_owned(), nodes: vec![0] }];
    let same = error_of(&String::from_utf8(write(&mesh, false)).unwrap());
    assert!(same.contains("two physical sets are named \"xmin\""), "{same}");
    mesh.node_sets[0].name = "support".to_owned();
    mesh.nodes.push(DVec3::splat(9.0));
    mesh.node_tags.push(1000);
    mesh.node_sets[0].nodes = vec![mesh.nodes.len() as u32 - 1];
    let loose = error_of(&String::from_utf8(write(&mesh, false)).unwrap());
    assert!(loose.contains("physical Point \"support\": 1 of its nodes belong to no tetrahedron"), "{loose}");
    mesh.node_sets[0].nodes.clear();
    let empty = error_of(&String::from_utf8(write(&mesh, false)).unwrap());
    assert!(empty.contains("physical Point \"support\" has no elements"), "{empty}");
}

#[test]
fn windows_line_ends_are_accepted() {
    assert_eq!(parse(text().replace('\n', "\r\n").as_bytes(), 1.0).unwrap(), cracked());
}

#[test]
fn lengths_are_scaled_and_unused_nodes_left_out() {
    let mut mesh = cracked();
    mesh.nodes.insert(0, DVec3::splat(7.0));
    mesh.node_tags.insert(0, 99);
    for node in mesh.tets.iter_mut().flatten() {
        *node += 1;
    }
    for node in mesh.sets.iter_mut().flat_map(|set| set.triangles.iter_mut().flatten()) {
        *node += 1;
    }
    let read = parse(&write(&mesh, false), 1e-3).unwrap();
    assert_eq!(read.tets, cracked().tets);
    assert_eq!(read.nodes, cracked().nodes.iter().map(|node| *node * 1e-3).collect::<Vec<_>>());
}

#[test]
fn meshes_written_by_gmsh_are_read() {
    let [binary, renumbered] = ["cube_with_crack_binary.msh", "cube_with_crack_renumbered.msh"].map(fixture);
    for mesh in [&binary, &renumbered] {
        assert_eq!((mesh.bodies.len(), mesh.bodies[0].name.as_str(), mesh.tets.len()), (1, "unit", 48));
        let sets: Vec<_> = mesh.sets.iter().map(|set| (set.name.as_str(), set.triangles.len())).collect();
        assert_eq!(sets, [("crack mid", 4), ("bottom", 4), ("top", 4)]);
        let prepared = prepare(mesh.clone()).unwrap();
        // The corners of the cube are exact; only the sum has rounding errors.
        assert!((prepared.quality[0].volume - 1.0).abs() < 1e-14);
        assert_eq!((prepared.faces.cracks[0].faces.len(), prepared.faces.boundaries.len()), (4, 2));
    }
    // In the second file, Gmsh has renumbered the nodes: the tags have no gaps but are not in order. The reader must
    // find the same shapes.
    let corners = |mesh: &Mesh| (0..mesh.tets.len()).map(|tet| mesh.corners(tet)).collect::<Vec<_>>();
    assert_eq!(corners(&binary), corners(&renumbered));
    assert_ne!(binary.node_tags, renumbered.node_tags);
}

#[test]
fn unsupported_files_are_refused_with_advice() {
    for content in ["", "\n", "solid x\n", "$NOD\n1\n", "MeshFormat\n"] {
        assert!(error_of(content).contains("first line is not $MeshFormat"), "{content:?}");
    }
    for version in ["2.2", "4", "4.0", "5", ""] {
        let message = error_with("4.1 0 8", &format!("{version} 0 8"));
        assert!(message.contains("Mesh.MshFileVersion = 4.1") && message.contains(version), "{message}");
    }
    assert!(error_with("4.1 0 8", "4.1 0 4").contains("\"0 4\""));
    assert!(error_with("4.1 0 8\n", "4.1 1 8\n\0\0\0\u{1}").contains("big-endian"));
    assert!(error_with("$Entities", "$PartitionedEntities").contains("partitioned"));
    assert!(error_of(&text()[..text().find("$Nodes").unwrap()]).contains("no section $Nodes"));
    assert!(error_with("$Nodes", "$Knots").contains("inside section $Knots"));
    assert!(
        error_of(&format!("{0}{1}", text(), &text()[text().find("$Nodes").unwrap()..])).contains("$Nodes occurs twice")
    );
}

#[test]
fn truncated_files_are_reported() {
    for binary in [false, true] {
        let whole = write(&cracked(), binary);
        let end = whole.len() - "$EndElements\n".len();
        for length in 0..end {
            assert!(parse(&whole[..length], 1.0).is_err(), "{length} of {end} bytes");
        }
        let error = parse(&whole[..end - 40], 1.0).unwrap_err();
        assert!(matches!(&error, MshError::Truncated { section, .. } if section == "Elements"), "{error}");
    }
}

#[test]
fn unexpected_words_are_reported_with_line_and_section() {
    let line = 1 + text()[..text().find("0.0 1.0 0.0 \n").unwrap()].matches('\n').count();
    let message = error_with("0.0 1.0 0.0 \n", "0.0 half 0.0 \n");
    assert_eq!(message, format!("line {line}, section $Nodes: found \"half\", expected a number"));
    // The stated number of nodes is one too high, so the reader reads a coordinate as a tag.
    let message = error_with("3 1 0 12 \n", "3 1 0 13 \n");
    assert!(message.contains("section $Nodes: found \"0.0\", expected a count or a tag"), "{message}");
    // The stated number of nodes is one too low, so the reader reads the last tag as a coordinate. Numbers then remain
    // before the end of the section.
    let message = error_with("3 1 0 12 \n", "3 1 0 11 \n");
    assert!(message.contains("section $Nodes: ") && message.contains("expected the end of the section"), "{message}");
    let message = error_with("3 1 4 12 \n", "3 1 4 99999999999999999 \n");
    assert!(message.contains("section $Elements: found \"$EndElements\", expected a count or a tag"), "{message}");
    let message = error_with("2 1 \"xmin\"", "2 1 xmin");
    assert!(message.contains("line 7, section $PhysicalNames: found \"2 1 xmin\""), "{message}");
    let message = error_with("$EndElements\n", "$EndElements\nmore\n");
    assert!(message.contains("found \"more\", expected the start of the next section"), "{message}");
}

#[test]
fn unnamed_empty_or_ambiguous_groups_are_refused() {
    let no_volume = text().replacen("$PhysicalNames\n8\n", "$PhysicalNames\n7\n", 1).replacen("3 1 \"block\"\n", "", 1);
    let unnamed = error_of(&no_volume);
    assert!(unnamed.contains("Volume 1 has no name"), "{unnamed}");
    let volume = "1 0.0 0.0 0.0 0.0 0.0 0.0 1 1 0 \n\n$EndEntities";
    let in_none = "1 0.0 0.0 0.0 0.0 0.0 0.0 0 0 \n\n$EndEntities";
    assert!(error_of(&no_volume.replacen(volume, in_none, 1)).contains("no physical volume"));
    assert!(error_with(volume, in_none).contains("volume 1 has 12 tetrahedra but is in no physical volume"));
    let in_two = error_with(volume, "1 0.0 0.0 0.0 0.0 0.0 0.0 2 1 2 0 \n\n$EndEntities");
    assert!(in_two.contains("in 2 physical volumes (block, 2)"), "{in_two}");
    assert!(error_with("2 2 \"xmax\"", "2 2 \"xmin\"").contains("two physical Surfaces are named \"xmin\""));
    let empty = text().replacen("$PhysicalNames\n8\n", "$PhysicalNames\n9\n3 9 \"gone\"\n", 1);
    assert!(error_of(&empty).contains("\"gone\" has no tetrahedra"));
    assert!(error_of(&empty.replacen("3 9", "2 9", 1)).contains("\"gone\" has no triangles"));
}

#[test]
fn only_linear_tetrahedra_make_bodies() {
    for (kind, name, remedy) in [
        (11, "second order", "ElementOrder"),
        (5, "hexahedra", "recombine"),
        (7, "pyramids", "recombine"),
        (29, "not", ""),
    ] {
        let message = error_with("3 1 4 12", &format!("3 1 {kind} 12"));
        assert!(message.contains(&format!("type {kind}")), "{message}");
        assert!(message.contains(name) && message.contains(remedy), "{message}");
    }
    // Quadrangles have four nodes, like tetrahedra, but cannot mesh a volume.
    assert!(error_with("3 1 4 12", "3 1 3 12").contains("quadrangles"));
    let quads = error_with("2 7 2 2 \n33 2 3 4 \n34 2 4 8 \n", "2 7 3 1 \n33 2 3 4 8 \n");
    assert!(quads.contains("2-D entity 7") && quads.contains("quadrangles") && quads.contains("recombine"), "{quads}");
}

#[test]
fn duplicate_missing_and_non_finite_nodes_are_refused() {
    let mut mesh = cracked();
    mesh.node_tags[3] = mesh.node_tags[4];
    assert_eq!(parse(&write(&mesh, true), 1.0), Err(MshError::DuplicateNode(5)));
    let mut mesh = cracked();
    for bad in [f64::NAN, f64::INFINITY] {
        mesh.nodes[2].y = bad;
        for binary in [false, true] {
            let error = parse(&write(&mesh, binary), 1.0).unwrap_err();
            assert!(matches!(error, MshError::NotFinite { tag: 3, .. }), "{error}");
        }
    }
    let missing = error_with("\n12 2 9 11 12 \n", "\n12 2 9 11 77 \n");
    assert!(missing.contains("element 12 refers to node 77"), "{missing}");
}

/// A way to damage a file.
#[derive(Debug, Clone)]
enum Damage {
    /// Replaces the byte at a position.
    Byte(usize, u8),
    /// Exchanges eight bytes (binary) or words (text) at two positions.
    Exchange(usize, usize),
    /// Truncates the file at a position.
    Cut(usize),
}

/// Returns the range of eight bytes at a position in a binary file, or of the word at a position in a text file.
fn word_range(bytes: &[u8], position: usize, binary: bool) -> std::ops::Range<usize> {
    if binary {
        let start = position.min(bytes.len() - 8);
        return start..start + 8;
    }
    let start = bytes[..position].iter().rposition(u8::is_ascii_whitespace).map_or(0, |space| space + 1);
    let length = bytes[start..].iter().position(u8::is_ascii_whitespace).unwrap_or(bytes.len() - start);
    start..start + length
}

fn apply_damage(bytes: &mut Vec<u8>, damage: &Damage, binary: bool) {
    match *damage {
        Damage::Byte(position, byte) => {
            let position = position % bytes.len();
            bytes[position] = byte;
        }
        Damage::Cut(position) => bytes.truncate((position % bytes.len()).max(8)),
        Damage::Exchange(a, b) => {
            let [a, b] = [a, b].map(|position| word_range(bytes, position % bytes.len(), binary));
            let (first, second) = if a.start < b.start { (a, b) } else { (b, a) };
            if first.end <= second.start {
                let exchanged = [
                    &bytes[..first.start],
                    &bytes[second.clone()],
                    &bytes[first.end..second.start],
                    &bytes[first],
                    &bytes[second.end..],
                ]
                .concat();
                *bytes = exchanged;
            }
        }
    }
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        4 => (any::<usize>(), any::<u8>()).prop_map(|(position, byte)| Damage::Byte(position, byte)),
        4 => (any::<usize>(), b'0'..=b'9').prop_map(|(position, digit)| Damage::Byte(position, digit)),
        4 => (any::<usize>(), any::<usize>()).prop_map(|(a, b)| Damage::Exchange(a, b)),
        1 => any::<usize>().prop_map(Damage::Cut),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// A damaged file is read or refused without a panic; a mesh that is read has valid indices.
    #[test]
    fn damaged_files_never_cause_a_panic(binary: bool, damages in prop::collection::vec(damage(), 1..5)) {
        let mut bytes = write(&cracked(), binary);
        for damage in &damages {
            apply_damage(&mut bytes, damage, binary);
        }
        if let Ok(mesh) = parse(&bytes, 1.0) {
            prop_assert!(mesh.tets.iter().flatten().all(|node| (*node as usize) < mesh.nodes.len()));
            // The result of `prepare` does not matter; only a panic is an error.
            let _ = prepare(mesh);
        }
    }
}
