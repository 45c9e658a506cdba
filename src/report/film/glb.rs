//! A film as a GLB file (glTF 2.0, binary), which Blender, PowerPoint and other programs open and play.
//!
//! Format: <https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html>. Bodies are nodes that move. A series with many
//! frames is one node per frame, whose scale is 1 while the frame is shown and 0 at other times, because the frames
//! have different points. One unit of the clock is one second of the file: films in milliseconds are slow motion. Dots
//! are left out, because most programs do not draw points.

use serde_json::{Value, json};

use super::scene::{Bodies, Scene, Seen, Series};
use super::simplify::Mesh;

/// Codes of the component types and targets in glTF.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_BYTE: u32 = 5121;
const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
/// Turn from the axes of the flume (z upwards) to those of glTF (y upwards), as a quaternion.
const UPRIGHT: [f64; 4] = [-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2];
const GREY: &str = "#9aa2aa";

/// Returns a film as the bytes of a GLB file.
pub fn glb(scene: &Scene) -> Vec<u8> {
    let mut file = File::default();
    let first = scene.times.first().copied().unwrap_or(0.0);
    let times: Vec<f32> = scene.times.iter().map(|time| (time - first) as f32).collect();
    let mut children = Vec::new();
    for series in scene.series.iter().filter(|series| series.dot == 0.0) {
        children.extend(file.series(series, &times));
    }
    children.extend(scene.bodies.iter().flat_map(|bodies| file.bodies(bodies, &times)));
    file.bytes(&children)
}

/// The lists of a glTF file, and the bytes to which they refer.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl File {
    /// Adds the frames of a series. Returns the indices of their nodes.
    fn series(&mut self, series: &Series, times: &[f32]) -> Vec<usize> {
        let colour = if series.fields.is_empty() { series.plain } else { "#ffffff" };
        let material = self.material(colour, series.opacity, series.seen == Seen::Both);
        let mut nodes = Vec::new();
        for (number, frame) in series.frames.iter().enumerate().filter(|(_, frame)| !frame.triangles.is_empty()) {
            let mesh = self.mesh(series, frame, material);
            let node = self.node(json!({ "name": format!("{} {number}", series.name), "mesh": mesh }));
            if series.frames.len() > 1 {
                // A program that does not play the film shows only its first frame.
                let scale = if number == 0 { 1.0 } else { 0.0 };
                self.nodes[node]["scale"] = json!([scale, scale, scale]);
                self.show_from_to(node, number, times);
            }
            nodes.push(node);
        }
        nodes
    }

    /// Adds the bodies; bodies of one shape share a mesh. Returns the indices of their nodes.
    fn bodies(&mut self, bodies: &Bodies, times: &[f32]) -> Vec<usize> {
        let material = self.material(GREY, 1.0, true);
        let series = Series::new(bodies.name, GREY, 1.0, Vec::new());
        let meshes: Vec<usize> = bodies.meshes.iter().map(|mesh| self.mesh(&series, mesh, material)).collect();
        let input = self.times(times);
        let count = bodies.list.len();
        let of_body = |index: usize| (0..times.len()).map(move |frame| frame * count + index);
        let mut nodes = Vec::new();
        for (index, body) in bodies.list.iter().enumerate() {
            let positions: Vec<[f32; 3]> = of_body(index).map(|at| bodies.position[at]).collect();
            let turns: Vec<[f32; 4]> = of_body(index).map(|at| unit(bodies.orientation[at])).collect();
            let node = self.node(json!({
                "name": format!("unit {}", body.number),
                "mesh": meshes[body.mesh],
                "translation": positions[0],
                "rotation": turns[0],
            }));
            let outputs = [("translation", self.floats(&positions, None)), ("rotation", self.floats(&turns, None))];
            for (path, output) in outputs {
                self.animate(node, path, "LINEAR", input, output);
            }
            nodes.push(node);
        }
        nodes
    }

    /// Shows a node from the time of one frame to the time of the next frame.
    fn show_from_to(&mut self, node: usize, frame: usize, times: &[f32]) {
        let begin = (frame > 0).then_some((0.0, 0.0));
        let end = times.get(frame + 1).map(|time| (*time, 0.0));
        let keys: Vec<(f32, f32)> = begin.into_iter().chain([(times[frame], 1.0)]).chain(end).collect();
        let input = self.times(&keys.iter().map(|(time, _)| *time).collect::<Vec<_>>());
        let output = self.floats(&keys.iter().map(|(_, scale)| [*scale; 3]).collect::<Vec<_>>(), None);
        self.animate(node, "scale", "STEP", input, output);
    }

    fn animate(&mut self, node: usize, path: &str, interpolation: &str, input: usize, output: usize) {
        self.channels.push(json!({ "sampler": self.samplers.len(), "target": { "node": node, "path": path } }));
        self.samplers.push(json!({ "input": input, "output": output, "interpolation": interpolation }));
    }

    fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn material(&mut self, colour: &str, opacity: f32, is_double: bool) -> usize {
        let [r, g, b] = linear(colour);
        let mode = if opacity < 1.0 { "BLEND" } else { "OPAQUE" };
        self.materials.push(json!({
            "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, opacity], "metallicFactor": 0.0, "roughnessFactor": 0.8 },
            "alphaMode": mode,
            "doubleSided": is_double,
        }));
        self.materials.len() - 1
    }

    /// Adds a mesh, coloured by the first field of its series.
    fn mesh(&mut self, series: &Series, mesh: &Mesh, material: usize) -> usize {
        let mut attributes = json!({ "POSITION": self.positions(&mesh.points) });
        if series.smooth {
            let side = if series.seen == Seen::Inside { -1.0 } else { 1.0 };
            let normals: Vec<[f32; 3]> = mesh.normals().iter().map(|normal| normal.map(|part| side * part)).collect();
            attributes["NORMAL"] = json!(self.floats(&normals, Some(ARRAY_BUFFER)));
        }
        if let (Some(field), Some(values)) = (series.fields.first(), mesh.values.first()) {
            let palette: Vec<[f32; 3]> = field.colours.iter().map(|colour| linear(colour)).collect();
            let colour = |value: &f32| {
                let index = (field.share(*value) * palette.len() as f32) as usize;
                let [r, g, b] = palette[index.min(palette.len() - 1)].map(|part| (255.0 * part).round() as u8);
                [r, g, b, 255]
            };
            let bytes: Vec<u8> = values.iter().flat_map(colour).collect();
            let view = self.view(&bytes, Some(ARRAY_BUFFER));
            self.accessors.push(json!({
                "bufferView": view, "componentType": UNSIGNED_BYTE, "normalized": true, "count": values.len(), "type": "VEC4",
            }));
            attributes["COLOR_0"] = json!(self.accessors.len() - 1);
        }
        // A triangle of glTF is seen from the side on which its corners are counter-clockwise.
        let turned = |[a, b, c]: &[u32; 3]| if series.seen == Seen::Inside { [*a, *c, *b] } else { [*a, *b, *c] };
        let corners: Vec<u32> = mesh.triangles.iter().flat_map(turned).collect();
        let bytes: Vec<u8> = corners.iter().flat_map(|corner| corner.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "count": corners.len(), "type": "SCALAR",
        }));
        let primitive = json!({ "attributes": attributes, "indices": self.accessors.len() - 1, "material": material });
        self.meshes.push(json!({ "name": series.name, "primitives": [primitive] }));
        self.meshes.len() - 1
    }

    fn positions(&mut self, points: &[[f32; 3]]) -> usize {
        let accessor = self.floats(points, Some(ARRAY_BUFFER));
        let [low, high] = super::bounds(points);
        self.accessors[accessor]["min"] = json!(low);
        self.accessors[accessor]["max"] = json!(high);
        accessor
    }

    fn times(&mut self, times: &[f32]) -> usize {
        let accessor = self.floats(&times.iter().map(|time| [*time]).collect::<Vec<_>>(), None);
        self.accessors[accessor]["min"] = json!([times[0]]);
        self.accessors[accessor]["max"] = json!([times[times.len() - 1]]);
        accessor
    }

    /// Adds rows of numbers. Returns the index of their accessor.
    fn floats<const N: usize>(&mut self, rows: &[[f32; N]], target: Option<u32>) -> usize {
        let bytes: Vec<u8> = rows.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        let view = self.view(&bytes, target);
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.accessors.push(json!({ "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": kind }));
        self.accessors.len() - 1
    }

    /// Adds bytes at a multiple of four. Returns the index of their view.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Returns the file: its header, the lists as JSON, and the bytes. `children` are the nodes of the scene.
    fn bytes(mut self, children: &[usize]) -> Vec<u8> {
        let root = self.node(json!({ "name": "flume", "rotation": UPRIGHT, "children": children }));
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut lists = json!({
            "asset": { "version": "2.0", "generator": concat!("breakwater ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": [root] }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len() }],
        });
        if !self.channels.is_empty() {
            lists["animations"] = json!([{ "name": "film", "samplers": self.samplers, "channels": self.channels }]);
        }
        let mut text = lists.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + text.len() + 8 + self.bytes.len();
        let mut file = Vec::with_capacity(length);
        for number in [0x4654_6c67, 2, length as u32, text.len() as u32, 0x4e4f_534a] {
            file.extend(number.to_le_bytes());
        }
        file.extend(text);
        for number in [self.bytes.len() as u32, 0x004e_4942] {
            file.extend(number.to_le_bytes());
        }
        file.extend(self.bytes);
        file
    }
}

/// Returns a colour `#rrggbb` in linear light (IEC 61966-2-1), as glTF uses it.
fn linear(colour: &str) -> [f32; 3] {
    [1, 3, 5].map(|at| {
        let part = colour.get(at..at + 2).and_then(|digits| u8::from_str_radix(digits, 16).ok()).unwrap_or(0);
        let part = f32::from(part) / 255.0;
        if part <= 0.040_45 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
    })
}

/// Returns a quaternion of length 1.
fn unit(turn: [f32; 4]) -> [f32; 4] {
    let length = turn.iter().map(|part| part * part).sum::<f32>().sqrt();
    if length > 0.0 { turn.map(|part| part / length) } else { [0.0, 0.0, 0.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::super::scene::{Body, Clock, DENSE, Field};
    use super::*;

    fn number(file: &[u8], at: usize) -> usize {
        u32::from_le_bytes([file[at], file[at + 1], file[at + 2], file[at + 3]]) as usize
    }

    #[test]
    fn the_file_has_its_chunks_and_every_view_lies_in_the_bytes() {
        let mesh = |height: f32| Mesh {
            points: vec![[0.0, 0.0, height], [1.0, 0.0, height], [0.0, 1.0, height]],
            triangles: vec![[0, 1, 2]],
            values: vec![vec![0.0, 1.0, 2.0]],
        };
        let mut water = Series::new("Water", "#5b9bd5", 0.7, vec![mesh(0.1), mesh(0.2), mesh(0.3)]);
        water.fields = vec![Field::numbers("speed", "m/s", [0.0, 2.0], &DENSE)];
        water.smooth = true;
        let bodies = Bodies {
            name: "Units",
            meshes: vec![Mesh { values: Vec::new(), ..mesh(0.0) }],
            position: vec![[0.0; 3], [1.0; 3], [2.0; 3]],
            orientation: vec![[0.0, 0.0, 0.0, 2.0]; 3],
            fields: Vec::new(),
            list: vec![Body { number: 1, mesh: 0, facts: Vec::new() }],
        };
        let clock = Clock { unit: "s", per_second: 1.0, digits: 2 };
        let bed = Series::new("Bed", "#b9ae9a", 1.0, vec![mesh(0.0)]);
        let corners = [[0.0; 3], [1.0; 3]];
        let scene = Scene {
            clock,
            times: vec![4.0, 4.5, 5.0],
            start: 0,
            corners,
            series: vec![bed, water],
            bodies: Some(bodies),
        };
        let file = glb(&scene);
        assert_eq!((&file[..4], number(&file, 4), number(&file, 8)), (&b"glTF"[..], 2, file.len()));
        let text = number(&file, 12);
        let lists: Value = serde_json::from_slice(&file[20..20 + text]).unwrap();
        let bytes = &file[20 + text + 8..];
        assert_eq!(lists["buffers"][0]["byteLength"], bytes.len());
        for view in lists["bufferViews"].as_array().unwrap() {
            let [offset, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
            assert!(offset % 4 == 0 && offset + length <= bytes.len());
        }
        // One node for the bed, three for the water, one for the unit, and the root with all of them.
        assert_eq!(lists["nodes"].as_array().unwrap().len(), 6);
        assert_eq!(lists["nodes"][5]["children"], json!([0, 1, 2, 3, 4]));
        let animation = &lists["animations"][0];
        assert_eq!(animation["channels"].as_array().unwrap().len(), 3 + 2);
        // The second frame of the water is shown from 0.5 s to 1 s of the film.
        let input = animation["samplers"][1]["input"].as_u64().unwrap() as usize;
        let view = &lists["bufferViews"][lists["accessors"][input]["bufferView"].as_u64().unwrap() as usize];
        let at = view["byteOffset"].as_u64().unwrap() as usize;
        let keys: Vec<f32> = (0..3).map(|key| f32::from_bits(number(bytes, at + 4 * key) as u32)).collect();
        assert_eq!(keys, [0.0, 0.5, 1.0]);
        assert_eq!(lists["nodes"][4]["rotation"], json!([0.0, 0.0, 0.0, 1.0]));
    }

    #[test]
    fn colours_are_in_linear_light() {
        assert_eq!(linear("#ffffff"), [1.0; 3]);
        assert_eq!(linear("#000000"), [0.0; 3]);
        // IEC 61966-2-1: 188/255 is 0.503 in linear light.
        assert!((linear("#bc0000")[0] - 0.503).abs() < 1e-3);
    }
}
