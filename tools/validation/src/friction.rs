//! Friction sweep: mean displacement in runs that differ in the friction coefficient of the mound.

use std::path::Path;

use breakwater::{
    case::ReferenceWave,
    output::{OutputError, Table},
    report::plot::{Line, LineChart},
};

use crate::{
    change::{self, BED, Change, FRICTION, SCHEME},
    compared::{Compared, centimetres, millimetres},
    markdown::Page,
};

/// The two points of a wave's friction sweep that section 4.7 of the paper states as numbers.
pub struct Published {
    height_m: f64,
    /// Friction coefficient [-] and mean displacement [m].
    points: Vec<[f64; 2]>,
}

/// Reads the published points of all waves.
///
/// # Errors
/// If the table cannot be read.
pub fn published(reference: &Path) -> Result<Vec<Published>, OutputError> {
    let table = Table::read(&reference.join("friction_sweep_section47.csv"))?;
    let [height, least, mean] =
        [table.column("H_WG1_cm")?, table.column("least_friction")?, table.column("mean_displacement_m")?];
    let [beyond, less] = [table.column("beyond_friction")?, table.column("less_than_m")?];
    let row = |row: usize| {
        let points = vec![[least[row], mean[row]], [beyond[row], less[row]]];
        Published { height_m: 0.01 * height[row], points }
    };
    Ok((0..table.rows()).map(row).collect())
}

/// Friction coefficient of the mound [-]; `None` if the run has another scheme, or if it differs from the base case in an
/// input other than friction, scheme and material of the bed.
fn friction(result: &Compared, default_scheme: bool) -> Option<f64> {
    let changed = |key: &str| result.changes.iter().find(|change| change.key == key);
    let is_other = |change: &Change| ![FRICTION, SCHEME, BED].contains(&change.key.as_str());
    if changed(SCHEME).is_some() != default_scheme || result.changes.iter().any(is_other) {
        return None;
    }
    changed(FRICTION).map_or(Some(change::base_friction()), |change| change.value.as_f64())
}

/// Adds the figure of the friction sweep to the page, unless every run has the same friction coefficient.
pub fn add(page: &mut Page, waves: &[&ReferenceWave], results: &[Compared], published: &[Published]) {
    let mut lines: Vec<Line> = Vec::new();
    for (index, wave) in waves.iter().enumerate() {
        let mut spacings: Vec<f64> = results.iter().map(Compared::dp_m).collect();
        spacings.sort_by(f64::total_cmp);
        spacings.dedup();
        let before = lines.len();
        for (dp_m, default_scheme) in spacings.iter().flat_map(|dp_m| [(*dp_m, false), (*dp_m, true)]) {
            let alike = results.iter().filter(|result| result.wave == *wave && result.dp_m() == dp_m);
            let mut points: Vec<[f64; 2]> =
                alike.filter_map(|result| Some([friction(result, default_scheme)?, result.run.mean_m])).collect();
            if points.len() < 2 {
                continue;
            }
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let scheme = if default_scheme { ", default scheme" } else { "" };
            let name = format!("{} cm, {} mm{scheme}", centimetres(wave), millimetres(dp_m));
            lines.push(Line { name, points, colour: 1 + lines.len() % 5, dots: true, ..Line::default() });
        }
        let is_same = |published: &&Published| (published.height_m - wave.height_m).abs() < 1e-9;
        if let Some(published) = published.iter().find(is_same).filter(|_| lines.len() > before) {
            let (name, points) = (format!("published, {} cm, 5 mm", centimetres(wave)), published.points.clone());
            let colour = if index == 0 { 0 } else { 5 };
            lines.push(Line { name, points, colour, dashed: true, dots: true, ..Line::default() });
        }
    }
    if lines.is_empty() {
        return;
    }
    let chart = LineChart {
        title: "Mean displacement against the friction of the mound".to_owned(),
        x_label: "friction coefficient of the units on the mound".to_owned(),
        y_label: "mean displacement [m]".to_owned(),
        lines,
        size: [920.0, 320.0],
        ..LineChart::default()
    };
    let caption = format!(
        "Mean displacement against the friction coefficient between units and mound ({} in the experiment); dashed \
         line: the two points that the paper gives as numbers.",
        change::base_friction()
    );
    page.figure("fudo-friction.svg", &chart.svg(), &caption);
}
