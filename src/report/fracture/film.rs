//! The film of a fracture run: units with their pieces, other bodies and crack faces over time.

use super::folder::FractureFolder;
use super::stress_picture::{SCALE, css};
use super::unit_picture::{OLD, OPENED, SLID};
use crate::output::{OutputError, PolyDataMoments};
use crate::report::film::{BUDGET, Clock, Field, Mesh, Scene, Series, bounds, packed_size, thinned};

/// Largest number of frames.
const MOST_FRAMES: usize = 60;
/// Opacity of the units, so that cracks inside are visible [-].
const UNIT_OPACITY: f32 = 0.55;
/// Names and colours of the pieces by their mass. The colours suit colour-blind readers (Okabe & Ito 2008).
const PIECES: [(&str, &str); 7] = [
    ("cannot crack", "#b9bec4"),
    ("heaviest piece", "#f0c94a"),
    ("second", "#56b4e9"),
    ("third", "#009e73"),
    ("fourth", "#cc79a7"),
    ("fifth", "#e69f00"),
    ("smaller", "#6b7178"),
];

/// Makes the film of a fracture run; `None` if the run wrote no surfaces.
///
/// # Errors
/// If a file cannot be read.
pub fn film(run: &FractureFolder) -> Result<Option<Scene>, OutputError> {
    let Some([surfaces, cracks, _]) = &run.pictures else { return Ok(None) };
    let complete = surfaces.times_s().len().min(cracks.times_s().len());
    let Some(last) = complete.checked_sub(1) else { return Ok(None) };
    let shown = run.shown_bodies();
    let others = Series::new("Other bodies", "#c9c6c0", 1.0, Vec::new());
    let mut faces = Series::new("Cracks", "#0d40bf", 1.0, Vec::new());
    let modes = [("pre-existing", css(OLD)), ("opening", css(OPENED)), ("sliding", css(SLID))];
    faces.fields = vec![Field::labels("mode", modes)];
    let mut units = Series::new("Units", "#f0c94a", UNIT_OPACITY, Vec::new());
    units.fields = unit_fields(run, surfaces, &thinned(complete, MOST_FRAMES))?;
    let has_pieces = units.fields.len() > 1;
    // The three meshes at a recorded time, in the order of the series.
    let meshes = |frame: usize| -> Result<[Mesh; 3], OutputError> {
        let whole = body_mesh(surfaces, frame, has_pieces)?;
        let body = surfaces.of_triangles::<i32>(frame, "body")?;
        let is_shown = |face: usize| shown.contains(&(body[face] as usize));
        let mode = cracks.numbers::<i32>(frame, "mode")?;
        let cracked = Mesh {
            points: cracks.points(frame)?,
            triangles: cracks.triangles(frame)?,
            values: vec![mode.iter().map(|mode| *mode as f32).collect()],
        };
        Ok([part(&whole, |face| !is_shown(face)), cracked, part(&whole, is_shown)])
    };
    let mut series = [others, faces, units];
    // The last time has the most cracks.
    let size: usize = series.iter().zip(meshes(last)?).map(|(series, mesh)| packed_size(series, &mesh)).sum();
    let frames = thinned(complete, MOST_FRAMES.min(BUDGET / size.max(1)));
    for frame in &frames {
        series.iter_mut().zip(meshes(*frame)?).for_each(|(series, mesh)| series.frames.push(mesh));
    }
    let [others, faces, units] = series;
    let corners: Vec<[[f32; 3]; 2]> = units.frames.iter().map(|frame| bounds(&frame.points)).collect();
    let times: Vec<f64> = frames.iter().map(|frame| run.clock_ms(surfaces.times_s()[*frame])).collect();
    let has_others = shown.len() < run.case.setup.bodies.len();
    Ok(Some(Scene {
        clock: Clock { unit: "ms", per_second: 1e3, digits: 2 },
        start: times.len() - 1,
        corners: bounds(corners.as_flattened()),
        series: [Some(others).filter(|_| has_others), Some(faces), Some(units)].into_iter().flatten().collect(),
        bodies: None,
        times,
    }))
}

/// Fields of the units: their pieces, if the run recorded them, and the first principal stress.
fn unit_fields(run: &FractureFolder, surfaces: &PolyDataMoments, frames: &[usize]) -> Result<Vec<Field>, OutputError> {
    let strengths = run.case.setup.bodies.iter().filter_map(|body| body.cohesion).map(|c| c.strength.tensile);
    let mut top = 2e-6 * strengths.fold(0.0, f64::max) as f32;
    if top == 0.0 {
        for frame in frames {
            let stresses = surfaces.numbers::<f32>(*frame, "sigma_1")?;
            top = stresses.into_iter().fold(top, |top, sigma| top.max(1e-6 * sigma.abs()));
        }
    }
    let top = if top > 0.0 { top } else { 1.0 };
    let colours = SCALE.map(css);
    let colours: Vec<&str> = colours.iter().map(String::as_str).collect();
    let stress = Field::numbers("first principal stress", "MPa", [-top, top], &colours);
    let pieces = PIECES.map(|(name, colour)| (name, colour.to_owned()));
    let pieces = surfaces.has("fragment").then(|| Field::labels("pieces", pieces));
    Ok(pieces.into_iter().chain([stress]).collect())
}

/// Reads the surfaces of all bodies. Each point has the number of its piece, if `has_pieces` is true, and the first
/// principal stress [MPa].
fn body_mesh(surfaces: &PolyDataMoments, frame: usize, has_pieces: bool) -> Result<Mesh, OutputError> {
    let stress = surfaces.numbers::<f32>(frame, "sigma_1")?.into_iter().map(|sigma| 1e-6 * sigma).collect();
    let mut values = vec![stress];
    if has_pieces {
        let highest = PIECES.len() as i32 - 1;
        let piece = surfaces.numbers::<i32>(frame, "fragment")?;
        values.insert(0, piece.into_iter().map(|piece| piece.clamp(0, highest) as f32).collect());
    }
    Ok(Mesh { points: surfaces.points(frame)?, triangles: surfaces.triangles(frame)?, values })
}

/// Returns the faces for which `is_in` is true, with their points, which they do not share.
fn part(mesh: &Mesh, is_in: impl Fn(usize) -> bool) -> Mesh {
    let chosen: Vec<[u32; 3]> =
        mesh.triangles.iter().enumerate().filter(|(face, _)| is_in(*face)).map(|(_, corners)| *corners).collect();
    let used = || chosen.iter().flatten().map(|corner| *corner as usize);
    Mesh {
        points: used().map(|point| mesh.points[point]).collect(),
        triangles: (0..chosen.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect(),
        values: mesh.values.iter().map(|list| used().map(|point| list[point]).collect()).collect(),
    }
}
