//! A film in a page: the data for the viewer, and the viewer itself.

use serde_json::{Value, json};

use super::arrays::{Arrays, bounds};
use super::scene::{Bodies, Field, Scene, Series};
use crate::report::film::Mesh;

/// The program of the viewer, in the order of its parts.
const PROGRAM: [&str; 7] = [
    include_str!("viewer/arrays.js"),
    include_str!("viewer/camera.js"),
    include_str!("viewer/drawing.js"),
    include_str!("viewer/panel.js"),
    include_str!("viewer/film.js"),
    include_str!("viewer/controls.js"),
    include_str!("viewer/start.js"),
];

/// Returns a film as HTML: the viewer with its data and its program.
pub fn viewer_html(scene: &Scene) -> String {
    let mut arrays = Arrays::default();
    let head = json!({
        "clock": scene.clock,
        "times": scene.times,
        "start": scene.start,
        "box": scene.corners,
        "series": scene.series.iter().map(|series| of_series(series, &mut arrays)).collect::<Vec<_>>(),
        "bodies": scene.bodies.as_ref().map(|bodies| of_bodies(bodies, &mut arrays)),
    });
    // A text cannot end the script element early.
    let head = head.to_string().replace('<', "\\u003c");
    format!(
        "{}<script type=\"application/json\" id=\"film-head\">{head}</script>\n\
         <script type=\"text/plain\" id=\"film-data\">{}</script>\n\
         <script>\n\"use strict\";\n(() => {{\n{}}})();\n</script>\n",
        include_str!("viewer/film.html"),
        arrays.packed(),
        PROGRAM.concat()
    )
}

/// Size of a frame in a page [bytes].
pub fn packed_size(series: &Series, frame: &Mesh) -> usize {
    let mut arrays = Arrays::default();
    of_frame(series, frame, bounds(&frame.points), &mut arrays);
    arrays.packed().len()
}

fn of_series(series: &Series, arrays: &mut Arrays) -> Value {
    let ends: Vec<[[f32; 3]; 2]> =
        series.frames.iter().filter(|frame| !frame.points.is_empty()).map(|frame| bounds(&frame.points)).collect();
    let corners = bounds(ends.as_flattened());
    let frames: Vec<Value> = series.frames.iter().map(|frame| of_frame(series, frame, corners, arrays)).collect();
    json!({
        "name": series.name,
        "plain": series.plain,
        "opacity": series.opacity,
        "dot": series.dot,
        "seen": series.seen,
        "smooth": series.smooth,
        "low": corners[0],
        "high": corners[1],
        "fields": series.fields,
        "frames": frames,
    })
}

fn of_frame(series: &Series, frame: &Mesh, corners: [[f32; 3]; 2], arrays: &mut Arrays) -> Value {
    let points = arrays.points(&frame.points, corners);
    let triangles = (series.dot == 0.0).then(|| arrays.integers(frame.triangles.as_flattened(), 1));
    let colours = |(field, values): (&Field, &Vec<f32>)| {
        let bytes: Vec<u32> = values.iter().map(|value| (255.0 * field.share(*value)).round() as u32).collect();
        arrays.integers(&bytes, 1)
    };
    let values: Vec<Value> = series.fields.iter().zip(&frame.values).map(colours).collect();
    json!({ "points": points, "triangles": triangles, "values": values })
}

fn of_shape(mesh: &Mesh, arrays: &mut Arrays) -> Value {
    let corners = bounds(&mesh.points);
    json!({
        "low": corners[0],
        "high": corners[1],
        "points": arrays.points(&mesh.points, corners),
        "triangles": arrays.integers(mesh.triangles.as_flattened(), 1),
    })
}

fn of_bodies(bodies: &Bodies, arrays: &mut Arrays) -> Value {
    let field = |(field, values): &(Field, Vec<f32>), arrays: &mut Arrays| {
        let mut described = json!(field);
        described["values"] = arrays.numbers(&values.iter().map(|value| [*value]).collect::<Vec<_>>());
        described
    };
    json!({
        "name": bodies.name,
        "meshes": bodies.meshes.iter().map(|mesh| of_shape(mesh, arrays)).collect::<Vec<_>>(),
        "position": arrays.numbers(&bodies.position),
        "orientation": arrays.numbers(&bodies.orientation),
        "fields": bodies.fields.iter().map(|one| field(one, arrays)).collect::<Vec<_>>(),
        "list": bodies.list,
    })
}

#[cfg(test)]
mod tests {
    use super::super::scene::Clock;
    use super::*;

    #[test]
    fn a_page_contains_the_film_and_no_text_ends_its_data_early() {
        let mesh =
            Mesh { points: vec![[0.0; 3], [1.0; 3], [0.0, 1.0, 2.0]], triangles: vec![[0, 1, 2]], values: Vec::new() };
        let scene = Scene {
            clock: Clock { unit: "s", per_second: 1.0, digits: 2 },
            times: vec![0.0, 0.5],
            start: 1,
            corners: [[0.0; 3], [1.0; 3]],
            series: vec![Series::new("Bed </script>", "#8d8370", 1.0, vec![mesh.clone()])],
            bodies: None,
        };
        let html = viewer_html(&scene);
        assert_eq!((html.matches("<script").count(), html.matches("</script>").count()), (3, 3));
        let head = html.split("id=\"film-head\">").nth(1).unwrap().split("</script>").next().unwrap();
        let head: Value = serde_json::from_str(head).unwrap();
        assert_eq!(head["series"][0]["name"], "Bed </script>");
        assert_eq!(head["series"][0]["high"], json!([1.0, 1.0, 2.0]));
        assert_eq!(head["series"][0]["frames"][0]["triangles"]["count"], 3);
        assert!(packed_size(&scene.series[0], &mesh) > 10);
        // The page loads nothing: no addresses, no imports.
        assert!(!html.contains("http://") && !html.contains("https://") && !html.contains("import "));
    }
}
