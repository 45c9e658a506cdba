//! Text of the report of a fracture run, section by section.

use super::folder::{FractureFolder, place_in_words};
use super::{charts, film, pictures, tables};
use crate::report::film::viewer_html;
use crate::report::plot::{escape, short};
use crate::{
    output::OutputError,
    report::page::{clock, grouped, section},
};

/// Returns the content of the `<main>` element of the page.
///
/// # Errors
/// If a file of the run cannot be read.
pub fn body(run: &FractureFolder) -> Result<String, OutputError> {
    let mut html = header(run);
    html += &key_figures(run);
    html += &cracks(run);
    let film = film::film(run)?;
    html += &film.map_or(String::new(), |scene| section("Film", &viewer_html(&scene)));
    html += &section("Pictures", &pictures::pictures(run)?);
    html += &energy(run);
    html += &fragments(run);
    html += &facts(run);
    html += &list("Warnings", "The results may be unreliable for these reasons.", &run.summary.warnings);
    let words = "No source gives these values. The author of the case chose them, and the results depend on them.";
    html += &list("Assumptions", words, &run.summary.assumptions);
    Ok(html + &files(run))
}

fn header(run: &FractureFolder) -> String {
    let summary = &run.summary;
    let lead = format!(
        "{} bodies, {} tetrahedra \u{b7} {} \u{b7} {} ms",
        run.case.names.len(),
        grouped(summary.tets as u64),
        joints_in_words(run),
        short(summary.simulated_s * 1e3, 2)
    );
    format!("<h1>{}</h1>\n<p class=\"lead\">{}</p>\n", escape(&summary.title), escape(&lead))
}

fn joints_in_words(run: &FractureFolder) -> &'static str {
    match run.case.setup.bodies.iter().find_map(|body| body.cohesion) {
        Some(cohesion) if cohesion.tied => "cracks along element faces; faces stay tied up to the strength",
        Some(_) => "cracks along element faces; all faces have joints from the start",
        None => "no body can crack",
    }
}

fn key_figures(run: &FractureFolder) -> String {
    let summary = &run.summary;
    let first = summary.initiation.first();
    let pieces = summary.fragments.len();
    let heaviest = summary.fragments.first().map_or(String::new(), |piece| {
        let whole: f64 = summary.fragments.iter().filter(|f| f.body == piece.body).map(|f| f.mass_kg).sum();
        format!("heaviest: {} % of {}", short(100.0 * piece.mass_kg / whole, 1), piece.body)
    });
    let faces =
        run.cracks.as_ref().map_or(String::new(), |table| format!("{} faces failed", grouped(table.rows() as u64)));
    let keys = [
        (
            "First crack",
            first.map_or("none".to_owned(), |crack| format!("{:.2} ms", run.clock_ms(crack.t_s))),
            first.map_or("no body cracked".to_owned(), |crack| {
                format!("{}, {}", run.clock_name(), place_in_words(crack))
            }),
        ),
        ("Crack area", format!("{} cm\u{b2}", short(summary.crack_area_m2 * 1e4, 1)), faces),
        ("Pieces", pieces.to_string(), heaviest),
        (
            "Energy residual",
            format!("{} %", short(100.0 * summary.energy_residual_ratio, 2)),
            "largest error of the energy balance, relative to the peak kinetic energy".to_owned(),
        ),
    ];
    let cells: String = (keys.iter())
        .map(|(name, value, note)| {
            format!("<div><dt>{name}</dt><dd>{value}<small>{}</small></dd></div>\n", escape(note))
        })
        .collect();
    format!("<dl class=\"keys\">\n{cells}</dl>\n")
}

fn cracks(run: &FractureFolder) -> String {
    if run.summary.initiation.is_empty() {
        return section("Crack initiation", "<p>No body cracked.</p>\n");
    }
    let since = match run.summary.impact_s {
        Some(impact) => format!(
            "Times count from the impact (first contact of two bodies), {} \u{b5}s after the start of the run. ",
            short(impact * 1e6, 1)
        ),
        None => "No bodies touched, so times count from the start of the run. ".to_owned(),
    };
    let content = format!(
        "<p>{since}A failed face starts a new crack if all faces that failed earlier are more than four edge lengths \
         away; otherwise the face belongs to the nearest crack. The table gives the centre of the first failed face in \
         the undeformed mesh. This position is accurate to the mesh size, about {} mm.</p>\n{}<figure>{}</figure>\n",
        short(face_length(run) * 1e3, 0),
        tables::cracks(run),
        charts::crack_area(run)
    );
    section("Crack initiation", &content)
}

/// Mean edge length of the mesh [m]; the largest value of the bodies that the pictures show.
fn face_length(run: &FractureFolder) -> f64 {
    let lengths = run.shown_bodies().into_iter().map(|body| run.case.mesh.quality[body].edge_mean);
    lengths.fold(0.0, f64::max)
}

fn energy(run: &FractureFolder) -> String {
    let chart = charts::energy(run);
    if chart.is_empty() {
        return String::new();
    }
    let per_area = run.summary.energy_over_g_f.map_or(String::new(), |ratio| {
        format!(" The cracks dissipated {} times the product of crack area and fracture energy.", short(ratio, 3))
    });
    let content = format!(
        "<p>Stored energy, and energy dissipated and supplied since the start. The gravity energy is zero at the \
         start.</p>\n\
         <figure>{chart}</figure>\n<figure>{}<figcaption>Dissipated and released energy only.</figcaption></figure>\n\
         <figure>{}<figcaption>Error of the energy balance: stored plus dissipated minus supplied energy, minus the \
         initial value of this sum. The error is at most {} % of the peak kinetic energy.{per_area}\
         </figcaption></figure>\n",
        charts::losses(run),
        charts::residual(run),
        short(100.0 * run.summary.energy_residual_ratio, 3)
    );
    section("Energy", &content)
}

fn fragments(run: &FractureFolder) -> String {
    if run.summary.fragments.is_empty() {
        return String::new();
    }
    let words = "<p>Pieces at the end of the run, the heaviest first. Tetrahedra that are connected by intact faces \
                 belong to the same piece. A body in one piece may still have deep cracks.</p>\n";
    section("Pieces", &format!("{words}{}", tables::fragments(run)))
}

fn facts(run: &FractureFolder) -> String {
    let (summary, case) = (&run.summary, &run.case);
    let friction = |a: usize, b: usize| {
        let coefficient = case.setup.friction([a, b]);
        (coefficient > 0.0).then(|| format!("{} \u{2013} {}: {}", case.names[a], case.names[b], short(coefficient, 3)))
    };
    let count = case.names.len();
    let pairs: Vec<String> = (0..count).flat_map(|a| (a..count).filter_map(move |b| friction(a, b))).collect();
    let moving = case.names.iter().zip(&case.setup.bodies).filter_map(|(name, body)| {
        let (velocity, turn) = (body.velocity.length(), body.angular_velocity.length());
        let both = [(velocity, "m/s"), (turn, "rad/s")].into_iter().filter(|(size, _)| *size > 0.0);
        let words: Vec<String> = both.map(|(size, unit)| format!("{} {unit}", short(size, 4))).collect();
        (!words.is_empty()).then(|| format!("{name} {}", words.join(" and ")))
    });
    let moving: Vec<String> = moving.collect();
    let or_none = |words: Vec<String>| if words.is_empty() { "none".to_owned() } else { words.join("; ") };
    let rows = [
        ("Faces between tetrahedra", format!("{}; {}", grouped(summary.joints as u64), joints_in_words(run))),
        ("Initial velocity", or_none(moving)),
        ("Friction coefficient", or_none(pairs)),
        (
            "Time step",
            format!(
                "{:.3} \u{b5}s; {} time steps, {} ms",
                summary.dt_s * 1e6,
                grouped(summary.steps),
                short(summary.simulated_s * 1e3, 3)
            ),
        ),
        (
            "Computing time",
            format!(
                "{} with {} threads; {} million tetrahedra times time steps per second",
                clock(summary.execution.wall_s),
                summary.execution.threads,
                short(summary.tet_steps_per_s * 1e-6, 2)
            ),
        ),
        ("breakwater", format!("version {}", summary.breakwater_version)),
    ];
    let mut html: String =
        rows.iter().map(|(name, value)| format!("<tr><td>{name}</td><td>{}</td></tr>\n", escape(value))).collect();
    html += &format!("<tr><td>Case hash</td><td><code>{}</code></td></tr>\n", escape(&summary.case_hash));
    let table = format!("<table class=\"facts\"><tbody>\n{html}</tbody></table>\n");
    section("How the run was made", &(tables::bodies(run) + &table))
}

fn list(heading: &str, words: &str, items: &[String]) -> String {
    let items: String = items.iter().map(|item| format!("<li>{}</li>\n", escape(item))).collect();
    let content = if items.is_empty() { items } else { format!("<p>{words}</p>\n<ul>\n{items}</ul>\n") };
    section(heading, &content)
}

/// Files of a run folder and their contents, in the order of the table in the report.
const FILES: [(&str, &str); 11] = [
    ("cracks.csv", "every failed face: time, position, area, mode (1 opening, 2 sliding)"),
    ("fragments.csv", "pieces at the end: mass, centre, velocity"),
    ("energy.csv", "energy balance, crack area, pairs of tetrahedra in contact"),
    ("bodies.csv", "energies of each body at the times of the energy balance"),
    ("surfaces.vtkhdf", "outer surfaces of the bodies with velocity and stress: open in ParaView 5.12 or later"),
    ("cracks.vtkhdf", "crack faces with time and mode: open in ParaView together with the surfaces"),
    ("section.vtkhdf", "section plane with velocity and stress"),
    ("tets.vtkhdf", "all tetrahedra with stress tensor, principal stresses, body and piece"),
    ("summary.json", "the results on this page as JSON, for other programs"),
    ("case.json", "the case that was run"),
    ("mesh.msh", "the mesh of the case"),
];

fn files(run: &FractureFolder) -> String {
    let rows: String = (FILES.iter().filter(|(name, _)| run.has(name)))
        .map(|(name, what)| format!("<tr><td><code>{name}</code></td><td>{what}</td></tr>\n"))
        .collect();
    let words = "<p>Tables are CSV files in SI units; each column name includes the unit. The times in these files \
                 count from the start of the run.</p>\n";
    section("Files of this run", &format!("{words}<table class=\"facts\"><tbody>\n{rows}</tbody></table>\n"))
}
