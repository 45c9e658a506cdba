use glam::DVec3;
use proptest::prelude::*;

use super::super::block::{Pattern, block};
use super::super::{Mesh, prepare};
use super::*;

/// Box of 2 x 1 x 1 cells with a crack across its middle.
fn cracked() -> Mesh {
    let mut mesh = block(DVec3::new(2.0, 1.0, 1.0), [2, 1, 1], Pattern::Diagonal);
    let triangles = mesh.faces_within(|node| node.x == 1.0);
    mesh.sets.push(super::super::TriangleSet { name: "crack middle".to_owned(), triangles });
    mesh
}

/// The same mesh as text.
fn text() -> String {
    String::from_utf8(write(&cracked(), false)).unwrap()
}

/// What the reader says of a text.
fn refusal(text: &str) -> String {
    parse(text.as_bytes(), 1.0).unwrap_err().to_string()
}

/// What the reader says of the good text with one piece, which must occur, replaced.
fn refusal_with(from: &str, to: &str) -> String {
    let text = text();
    assert!(text.contains(from), "{from:?} not in {text}");
    refusal(&text.replacen(from, to, 1))
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
        // Tags with gaps, out of order and too long for 32 bits.
        mesh.node_tags.iter_mut().for_each(|tag| *tag = 5_000_000_000 - 7 * *tag);
        mesh.tet_tags.reverse();
        for binary in [false, true] {
            assert_eq!(parse(&write(&mesh, binary), 1.0).unwrap(), mesh);
        }
    }
}

#[test]
fn physical_curves_are_sets_of_nodes() {
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
fn sets_of_nodes_must_belong_to_a_body_and_have_names_of_their_own() {
    let mut mesh = cracked();
    mesh.node_sets = vec![super::super::NodeSet { name: "xmin".to_owned(), nodes: vec![0] }];
    let same = refusal(&String::from_utf8(write(&mesh, false)).unwrap());
    assert!(same.contains("two physical sets are named \"xmin\""), "{same}");
    mesh.node_sets[0].name = "support".to_owned();
    mesh.nodes.push(DVec3::splat(9.0));
    mesh.node_tags.push(1000);
    mesh.node_sets[0].nodes = vec![mesh.nodes.len() as u32 - 1];
    let loose = refusal(&String::from_utf8(write(&mesh, false)).unwrap());
    assert!(loose.contains("physical Point \"support\": 1 of its nodes belong to no tetrahedron"), "{loose}");
    mesh.node_sets[0].nodes.clear();
    let empty = refusal(&String::from_utf8(write(&mesh, false)).unwrap());
    assert!(empty.contains("physical Point \"support\" has no elements"), "{empty}");
}

#[test]
fn lines_may_end_as_on_windows() {
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
        // Corners of the cube are exact; rounding of the sum only.
        assert!((prepared.quality[0].volume - 1.0).abs() < 1e-14);
        assert_eq!((prepared.faces.cracks[0].faces.len(), prepared.faces.boundaries.len()), (4, 2));
    }
    // Gmsh gave the nodes of the second file other numbers, without gaps and out of order: the shapes must not change.
    let corners = |mesh: &Mesh| (0..mesh.tets.len()).map(|tet| mesh.corners(tet)).collect::<Vec<_>>();
    assert_eq!(corners(&binary), corners(&renumbered));
    assert_ne!(binary.node_tags, renumbered.node_tags);
}

#[test]
fn other_files_are_refused_with_the_way_out() {
    for content in ["", "\n", "solid x\n", "$NOD\n1\n", "MeshFormat\n"] {
        assert!(refusal(content).contains("first line is not $MeshFormat"), "{content:?}");
    }
    for version in ["2.2", "4", "4.0", "5", ""] {
        let message = refusal_with("4.1 0 8", &format!("{version} 0 8"));
        assert!(message.contains("Mesh.MshFileVersion = 4.1") && message.contains(version), "{message}");
    }
    assert!(refusal_with("4.1 0 8", "4.1 0 4").contains("\"0 4\""));
    assert!(refusal_with("4.1 0 8\n", "4.1 1 8\n\0\0\0\u{1}").contains("big-endian"));
    assert!(refusal_with("$Entities", "$PartitionedEntities").contains("partitioned"));
    assert!(refusal(&text()[..text().find("$Nodes").unwrap()]).contains("no section $Nodes"));
    assert!(refusal_with("$Nodes", "$Knots").contains("inside section $Knots"));
    assert!(
        refusal(&format!("{0}{1}", text(), &text()[text().find("$Nodes").unwrap()..])).contains("$Nodes occurs twice")
    );
}

#[test]
fn files_cut_short_say_so() {
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
fn misplaced_words_are_named_with_line_and_section() {
    let line = 1 + text()[..text().find("0.0 1.0 0.0 \n").unwrap()].matches('\n').count();
    let message = refusal_with("0.0 1.0 0.0 \n", "0.0 half 0.0 \n");
    assert_eq!(message, format!("line {line}, section $Nodes: \"half\" where a number must be"));
    // One node more than there are: a coordinate is read as a tag.
    let message = refusal_with("3 1 0 12 \n", "3 1 0 13 \n");
    assert!(message.contains("section $Nodes: \"0.0\" where a count or a tag must be"), "{message}");
    // One less: the last tag is read as a coordinate, and a coordinate is left over.
    let message = refusal_with("3 1 0 12 \n", "3 1 0 11 \n");
    assert!(message.contains("section $Nodes: ") && message.contains("the end of the section must be"), "{message}");
    let message = refusal_with("3 1 4 12 \n", "3 1 4 99999999999999999 \n");
    assert!(message.contains("section $Elements: \"$EndElements\" where a count or a tag must be"), "{message}");
    let message = refusal_with("2 1 \"xmin\"", "2 1 xmin");
    assert!(message.contains("line 7, section $PhysicalNames: \"2 1 xmin\""), "{message}");
    let message = refusal_with("$EndElements\n", "$EndElements\nmore\n");
    assert!(message.contains("\"more\" where the start of the next section must be"), "{message}");
}

#[test]
fn groups_must_be_complete() {
    let no_volume = text().replacen("$PhysicalNames\n8\n", "$PhysicalNames\n7\n", 1).replacen("3 1 \"block\"\n", "", 1);
    let unnamed = refusal(&no_volume);
    assert!(unnamed.contains("Volume 1 has no name"), "{unnamed}");
    let volume = "1 0.0 0.0 0.0 0.0 0.0 0.0 1 1 0 \n\n$EndEntities";
    let in_none = "1 0.0 0.0 0.0 0.0 0.0 0.0 0 0 \n\n$EndEntities";
    assert!(refusal(&no_volume.replacen(volume, in_none, 1)).contains("no physical volume"));
    assert!(refusal_with(volume, in_none).contains("volume 1 has 12 tetrahedra but is in no physical volume"));
    let in_two = refusal_with(volume, "1 0.0 0.0 0.0 0.0 0.0 0.0 2 1 2 0 \n\n$EndEntities");
    assert!(in_two.contains("in 2 physical volumes (block, 2)"), "{in_two}");
    assert!(refusal_with("2 2 \"xmax\"", "2 2 \"xmin\"").contains("two physical Surfaces are named \"xmin\""));
    let empty = text().replacen("$PhysicalNames\n8\n", "$PhysicalNames\n9\n3 9 \"gone\"\n", 1);
    assert!(refusal(&empty).contains("\"gone\" has no tetrahedra"));
    assert!(refusal(&empty.replacen("3 9", "2 9", 1)).contains("\"gone\" has no triangles"));
}

#[test]
fn only_linear_tetrahedra_make_bodies() {
    for (kind, name, remedy) in [
        (11, "second order", "ElementOrder"),
        (5, "hexahedra", "recombine"),
        (7, "pyramids", "recombine"),
        (29, "not", ""),
    ] {
        let message = refusal_with("3 1 4 12", &format!("3 1 {kind} 12"));
        assert!(message.contains(&format!("type {kind}")), "{message}");
        assert!(message.contains(name) && message.contains(remedy), "{message}");
    }
    // Quadrangles have as many nodes as tetrahedra, and are no mesh of a volume.
    assert!(refusal_with("3 1 4 12", "3 1 3 12").contains("quadrangles"));
    let quads = refusal_with("2 7 2 2 \n33 2 3 4 \n34 2 4 8 \n", "2 7 3 1 \n33 2 3 4 8 \n");
    assert!(quads.contains("2-D entity 7") && quads.contains("quadrangles") && quads.contains("recombine"), "{quads}");
}

#[test]
fn nodes_must_be_there_once_and_finite() {
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
    let missing = refusal_with("\n12 2 9 11 12 \n", "\n12 2 9 11 77 \n");
    assert!(missing.contains("element 12 names node 77"), "{missing}");
}

/// A way to spoil a file.
#[derive(Debug, Clone)]
enum Damage {
    /// Another byte at a place.
    Byte(usize, u8),
    /// Eight bytes, or the word at one place, and those at another exchanged.
    Exchange(usize, usize),
    /// The end missing.
    Cut(usize),
}

/// Ranges of eight bytes around a place in a binary file, of a word in a text.
fn piece(bytes: &[u8], place: usize, binary: bool) -> std::ops::Range<usize> {
    if binary {
        let start = place.min(bytes.len() - 8);
        return start..start + 8;
    }
    let start = bytes[..place].iter().rposition(u8::is_ascii_whitespace).map_or(0, |space| space + 1);
    let length = bytes[start..].iter().position(u8::is_ascii_whitespace).unwrap_or(bytes.len() - start);
    start..start + length
}

fn spoil(bytes: &mut Vec<u8>, damage: &Damage, binary: bool) {
    match *damage {
        Damage::Byte(place, byte) => {
            let place = place % bytes.len();
            bytes[place] = byte;
        }
        Damage::Cut(place) => bytes.truncate((place % bytes.len()).max(8)),
        Damage::Exchange(a, b) => {
            let [a, b] = [a, b].map(|place| piece(bytes, place % bytes.len(), binary));
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
        4 => (any::<usize>(), any::<u8>()).prop_map(|(place, byte)| Damage::Byte(place, byte)),
        4 => (any::<usize>(), b'0'..=b'9').prop_map(|(place, digit)| Damage::Byte(place, digit)),
        4 => (any::<usize>(), any::<usize>()).prop_map(|(a, b)| Damage::Exchange(a, b)),
        1 => any::<usize>().prop_map(Damage::Cut),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// A spoilt file is read or refused, without panic, and what is read has valid indices.
    #[test]
    fn spoilt_files_do_no_harm(binary: bool, damages in prop::collection::vec(damage(), 1..5)) {
        let mut bytes = write(&cracked(), binary);
        for damage in &damages {
            spoil(&mut bytes, damage, binary);
        }
        if let Ok(mesh) = parse(&bytes, 1.0) {
            prop_assert!(mesh.tets.iter().flatten().all(|node| (*node as usize) < mesh.nodes.len()));
            // What it says does not matter here.
            let _ = prepare(mesh);
        }
    }
}
