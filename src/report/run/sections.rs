//! Text and tables in the report of a flume run, section by section.

use super::super::plot::{escape, short};
use super::folder::RunFolder;
use super::moments::Moments;
use super::{
    breakage, charts,
    facts::{self, height_symbol},
    film, views,
};
use crate::{
    case::DamageMeasure,
    output::{ForceComponent, ForceSummary, GroupSummary, Stopped, Summary, UnitSummary, WaveSummary},
    report::{
        film::Scene,
        page::{grouped, section},
    },
};

/// Returns the content of the `<main>` element of the page.
pub fn body(run: &RunFolder, moments: Option<&Moments>, film: Option<&Scene>) -> String {
    let mut html = header(&run.summary);
    html += &key_figures(&run.summary);
    html += &film.map_or(String::new(), |film| section("Film", &film::section(film)));
    html += &section("Units before and after the wave", &views::views(run));
    html += &moments.map_or(String::new(), |moments| section(moments.heading(), &moments.section()));
    html += &displacement(run);
    html += &water(run);
    html += &forces(run);
    html += &section("Breakage of the units", &breakage::breakage(run));
    html += &energy(run);
    html += &facts::warnings(&run.summary);
    html += &facts::assumptions(&run.summary);
    html += &facts::facts(&run.summary);
    html + &facts::files(run)
}

fn header(summary: &Summary) -> String {
    let mut parts = Vec::new();
    parts.push(match &summary.wave {
        Some(wave) => wave_in_words(wave),
        None => "No wave height given".to_owned(),
    });
    match summary.units.len() {
        0 => parts.push("no armour units".to_owned()),
        1 => parts.push("one armour unit".to_owned()),
        n => parts.push(format!("{n} armour units")),
    }
    parts.push(match summary.two_dimensional {
        true => "two-dimensional".to_owned(),
        false => format!("domain {} m wide", short(summary.domain_width_m, 3)),
    });
    let progress = match summary.stopped {
        Stopped::Running => {
            let simulated = short(summary.simulated_s, 2);
            format!("<p class=\"running\"><strong>The run is in progress: {simulated} s are simulated.</strong></p>\n")
        }
        _ => String::new(),
    };
    let lead = escape(&parts.join(" \u{b7} "));
    format!("<h1>{}</h1>\n<p class=\"lead\">{lead}</p>\n{progress}", escape(&summary.title))
}

fn wave_in_words(wave: &WaveSummary) -> String {
    let noun = if wave.kind == "solitary" { "wave" } else { "waves" };
    let (kind, height) = (capitalised(&wave.kind), short(100.0 * wave.height_m, 2));
    format!("{kind} {noun}, {} = {height} cm at the wavemaker", height_symbol(wave))
}

fn key_figures(summary: &Summary) -> String {
    let mut keys: Vec<(&str, String, String)> = Vec::new();
    if let (Some(ratio), Some(mean), Some(distance)) =
        (summary.damage_ratio, summary.mean_displacement_m, summary.damage_distance_m)
    {
        let count = format!("{} of {} units", summary.damaged(), summary.movable());
        keys.push(("Damage ratio", format!("{} %", short(100.0 * ratio, 0)), count));
        let in_distances =
            format!("{} times the damage distance of {} m", short(mean / distance, 2), short(distance, 3));
        keys.push(("Mean displacement", format!("{mean:.3} m"), in_distances));
        let furthest = summary.units.iter().max_by(|a, b| a.displacement_m.total_cmp(&b.displacement_m));
        if let Some(unit) = furthest {
            keys.push(("Largest displacement", format!("{:.3} m", unit.displacement_m), format!("unit {}", unit.unit)));
        }
        let force = summary.units.iter().max_by(|a, b| a.peak_fluid_force_n.total_cmp(&b.peak_fluid_force_n));
        if let Some(unit) = force {
            let note = "minus the mean force of still water".to_owned();
            keys.push(("Peak force of the water", format!("{} N", short(unit.peak_fluid_force_n, 2)), note));
        }
    } else {
        let highest = |crest: fn(&crate::output::GaugeSummary) -> Option<f64>| {
            summary.gauges.iter().filter_map(|g| Some((crest(g)?, g.name.clone()))).max_by(|a, b| a.0.total_cmp(&b.0))
        };
        if let Some((crest, name)) = highest(|g| g.crest_sph_m) {
            keys.push(("Highest water level", format!("{crest:.3} m"), format!("above still water level, at {name}")));
        }
        keys.push(("Simulated time", format!("{} s", short(summary.simulated_s, 2)), String::new()));
        keys.push(("Particles", grouped(summary.particles), format!("spacing {} mm", short(1000.0 * summary.dp_m, 2))));
        keys.push(("Time steps", grouped(summary.steps), String::new()));
    }
    let cells: String = (keys.iter())
        .map(|(name, value, note)| {
            format!("<div><dt>{name}</dt><dd>{value}<small>{}</small></dd></div>\n", escape(note))
        })
        .collect();
    format!("<dl class=\"keys\">\n{cells}</dl>\n")
}

fn displacement(run: &RunFolder) -> String {
    if run.summary.units.is_empty() {
        return String::new();
    }
    let mut content = format!(
        "<p>Displacement is the horizontal distance between initial and final position of the centre of mass. {}</p>\n\
         {}<figure>{}</figure>\n",
        damage_in_words(&run.summary),
        group_table(&run.summary),
        charts::displacements(run)
    );
    if !run.motions.is_empty() {
        content += &format!("<figure>{}</figure>\n", charts::paths(run));
    }
    section("Displacement", &(content + &unit_table(&run.summary)))
}

/// Says when a unit counts as damaged.
fn damage_in_words(summary: &Summary) -> String {
    let [group] = &summary.groups[..] else {
        return match summary.groups.len() {
            0 => format!("A unit counts as damaged above {} m.", short(summary.damage_distance_m.unwrap_or(0.0), 3)),
            _ => "A unit counts as damaged if it moves further than the damage distance of its group.".to_owned(),
        };
    };
    let distance = short(group.damage_distance_m, 3);
    match group.damage_measure {
        DamageMeasure::Horizontal => format!("A unit counts as damaged if its displacement exceeds {distance} m."),
        DamageMeasure::Spatial => {
            format!("A unit counts as damaged if its centre moves by more than {distance} m in space.")
        }
    }
}

/// Table of the groups. It is left out for one group whose damage is defined as in the experiments of Mitsui et al.
fn group_table(summary: &Summary) -> String {
    if let [] | [GroupSummary { damage_measure: DamageMeasure::Horizontal, .. }] = summary.groups[..] {
        return String::new();
    }
    let row = |group: &GroupSummary| {
        let [first, last] = group.units;
        let results = match group.fixed {
            true => "<td colspan=\"11\">fixed</td>".to_owned(),
            false => {
                let way = match group.damage_measure {
                    DamageMeasure::Horizontal => "in plan",
                    DamageMeasure::Spatial => "in space",
                };
                format!(
                    "<td>{} {way}</td><td>{} %</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
                     <td>{}</td><td>{:.3}</td><td>{:.3}</td>",
                    short(group.damage_distance_m, 3),
                    short(100.0 * group.damage_ratio, 0),
                    short(group.nominal_diameter_m, 3),
                    group.displaced,
                    short(group.n_od, 2),
                    group.rocking,
                    short(group.n_or, 2),
                    short(group.n_omov, 2),
                    group.rotated,
                    group.mean_displacement_m,
                    group.mean_settlement_m
                )
            }
        };
        format!("<tr><td>{}</td><td>{first} to {last}</td>{results}</tr>\n", escape(&group.name))
    };
    let rows: String = summary.groups.iter().map(row).collect();
    let limits = |group: &GroupSummary| [group.rotation_limit_deg, group.rocking_limit_deg];
    let [rotation, rocking] = summary.groups.iter().find(|group| !group.fixed).map_or([0.0; 2], limits);
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr><th>Group</th><th>Units</th><th>Damage distance [m]</th>\
         <th>Damaged</th><th>D<sub>n</sub> [m]</th><th>Displaced</th><th>N<sub>od</sub></th><th>Rocking</th>\
         <th>N<sub>or</sub></th><th>N<sub>omov</sub></th><th>Rotated</th>\
         <th>Mean displace&shy;ment [m]</th><th>Mean settlement [m]</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n\
         <figcaption>Displaced: the centre moved further than D<sub>n</sub> in space. N<sub>od</sub>: displaced units in a \
         strip of the width D<sub>n</sub>. Rocking: rotated back and forth by more than {} degrees, and not displaced. \
         N<sub>or</sub>: rocking units in this strip. N<sub>omov</sub> = N<sub>od</sub> + N<sub>or</sub>. Rotated: by \
         more than {} degrees from the start to the end. Settlement: fall of the centre.</figcaption>\n",
        short(rocking, 1),
        short(rotation, 0)
    )
}

fn unit_table(summary: &Summary) -> String {
    let row = |u: &UnitSummary| {
        let damaged = if u.damaged { "<td class=\"yes\">yes</td>" } else { "<td>no</td>" };
        format!(
            "<tr><td>{}</td><td>{:.3}</td>{damaged}<td>{}</td><td>{:.3}</td><td>{:.3}</td><td>{}</td><td>{}</td>\
             <td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            u.unit,
            u.displacement_m,
            short(u.direction_deg, 0),
            u.end_m[0] - u.start_m[0],
            u.end_m[2] - u.start_m[2],
            short(u.rotation_deg, 0),
            u.rocking_movements,
            short(u.largest_rocking_deg, 1),
            short(u.peak_fluid_force_n, 2),
            short(u.peak_contact_force_n, 1),
            u.bed_contacts,
            u.unit_contacts
        )
        .replace(">-", ">\u{2212}")
    };
    let rows: String = summary.units.iter().map(row).collect();
    let mean = summary.mean_displacement_m.unwrap_or(0.0);
    format!(
        "<div class=\"scroll tall\" tabindex=\"0\" role=\"region\" aria-label=\"Table of the units\"><table>\n<thead><tr><th>Unit</th><th>Displace&shy;ment [m]</th><th>Damaged</th><th>Direction [&deg;]</th>\
         <th>&Delta;x [m]</th><th>&Delta;z [m]</th><th>Rotation [&deg;]</th>\
         <th>Rocking movements</th><th>Largest rocking angle [&deg;]</th><th>Peak force of the water [N]</th>\
         <th>Peak contact force [N]</th><th>Contacts with bed</th><th>Contacts with units</th></tr></thead>\n<tbody>\n{rows}\
         <tr class=\"sum\"><td>Mean</td><td>{mean:.3}</td><td>{} of {}</td><td colspan=\"10\"></td></tr>\n</tbody></table></div>\n\
         <figcaption>Direction in plan view: 0 is shoreward, positive is towards larger y. The peak force of the water \
         is the peak after subtraction of the mean force of still water. A rocking movement is a rotation away and \
         back; its angle is the smaller of the two.</figcaption>\n",
        summary.damaged(),
        summary.movable()
    )
}

fn water(run: &RunFolder) -> String {
    let charts = charts::gauges(run);
    if charts.is_empty() {
        return String::new();
    }
    let mut content = String::from("<p>The surface elevation \u{3b7} is relative to the still water level.");
    if run.flume_gauges.is_some() {
        content += " The flume model computes the wave along the whole flume, without units; breaking waves are \
                    simplified to bores. If the elevations of flume model and particles agree until the wave reaches \
                    the units, the wave has entered the particle domain correctly.";
    }
    content += "</p>\n";
    content += &gauge_table(&run.summary);
    content += &pressure_table(&run.summary);
    content += &force_table(&run.summary);
    content += &format!("<div class=\"pair\">\n{}\n</div>\n", charts.join("\n"));
    section("Water at the gauges", &content)
}

fn gauge_table(summary: &Summary) -> String {
    if summary.gauges.is_empty() {
        return String::new();
    }
    let centimetres = |crest: Option<f64>| crest.map_or("\u{2013}".to_owned(), |c| format!("{:.2}", 100.0 * c));
    let rows: String = (summary.gauges.iter())
        .map(|g| {
            let difference = match (g.crest_sph_m, g.crest_flume_m) {
                (Some(sph), Some(flume)) if flume != 0.0 => {
                    format!("{:+.1}", 100.0 * (sph / flume - 1.0)).replace('-', "\u{2212}")
                }
                _ => "\u{2013}".to_owned(),
            };
            format!(
                "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{difference}</td></tr>\n",
                escape(&g.name),
                short(g.x_m, 3),
                centimetres(g.crest_sph_m),
                centimetres(g.crest_flume_m)
            )
        })
        .collect();
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr><th>Gauge</th><th>x [m]</th><th>Crest, particles [cm]</th>\
         <th>Crest, flume model [cm]</th><th>Particles minus flume model [%]</th></tr></thead>\n\
         <tbody>\n{rows}</tbody></table></div>\n"
    )
}

fn pressure_table(summary: &Summary) -> String {
    if summary.pressure_gauges.is_empty() {
        return String::new();
    }
    let kilopascals = |pressure: Option<f64>| pressure.map_or("\u{2013}".to_owned(), |p| format!("{:.2}", 1e-3 * p));
    let rows: String = (summary.pressure_gauges.iter())
        .map(|g| {
            let [x, y, z] = g.at_m.map(|value| short(value, 3));
            let (name, mean, now) = (escape(&g.name), kilopascals(g.highest_mean_pa), kilopascals(g.highest_pa));
            format!("<tr><td>{name}</td><td>{x}, {y}, {z}</td><td>{mean}</td><td>{now}</td></tr>\n")
        })
        .collect();
    format!(
        "<p>The highest mean is over the time between two rows of <code>gauges.csv</code>, as a sensor of this bandwidth \
         would show it; compare measurements with it. The highest single value is from the times of the rows \
         only.</p>\n<div class=\"scroll\"><table>\n<thead><tr><th>Gauge</th><th>x, y, z [m]</th>\
         <th>Highest mean [kPa]</th><th>Highest single value [kPa]</th></tr></thead>\n\
         <tbody>\n{rows}</tbody></table></div>\n"
    )
}

fn force_table(summary: &Summary) -> String {
    if summary.force_gauges.is_empty() {
        return String::new();
    }
    let rows_of = |gauge: &ForceSummary| -> String {
        let row = |(index, component): (usize, ForceComponent)| {
            let first = match index {
                0 => format!("<td rowspan=\"6\">{}</td>", escape(&gauge.name)),
                _ => String::new(),
            };
            let values = [component.largest, component.smallest]
                .map(|[value, time]| format!("<td>{value:.4}</td><td>{time:.3}</td>"))
                .concat();
            let impulse = component.impulse_n_s.map_or("\u{2013}".to_owned(), |impulse| format!("{impulse:.4}"));
            format!("<tr>{first}<td>{}</td>{values}<td>{impulse}</td></tr>\n", component.name)
                .replace(">-", ">\u{2212}")
        };
        gauge.components().enumerate().map(row).collect()
    };
    let rows: String = summary.force_gauges.iter().map(rows_of).collect();
    format!(
        "<p>The forces of the water are means over the time between two rows of <code>gauges.csv</code>; the times are \
         those of the rows. The impulse is the sum of the means, each multiplied by its interval.</p>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>Gauge</th><th>Component</th><th>Largest</th><th>at [s]</th>\
         <th>Smallest</th><th>at [s]</th><th>Impulse [N s]</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

fn forces(run: &RunFolder) -> String {
    let [along, up, contact] = charts::forces(run);
    if along.is_empty() {
        return String::new();
    }
    let contacts = &run.summary.contacts;
    let content = format!(
        "<p>Force of the water minus the force of still water (mean over the first 0.2 s). With more than six units, a \
         band shows the mean \u{b1} one standard deviation over the units.</p>\n\
         <div class=\"pair\">\n<figure><figcaption>Horizontal force, positive shoreward</figcaption>{along}</figure>\n\
         <figure><figcaption>Vertical force, positive upwards</figcaption>{up}</figure>\n</div>\n\
         <figure>{contact}<figcaption>Resultant contact force from bed and neighbouring units. Contact events: {} with \
         the bed, {} between units. Largest force in one event: {} N. Largest approach velocity: {} m/s.\
         </figcaption></figure>\n",
        grouped(contacts.with_bed),
        grouped(contacts.between_units),
        short(contacts.peak_force_n, 1),
        short(contacts.peak_normal_velocity_m_s, 3)
    );
    section("Forces on the units", &content)
}

fn energy(run: &RunFolder) -> String {
    let chart = charts::energy(run);
    if chart.is_empty() {
        return String::new();
    }
    let mut words = String::from("Each energy minus its initial value.");
    if let Some(energy) = &run.summary.energy {
        let change = energy.end_j - energy.start_j;
        words += &format!(
            " The total energy changed by {} J: work of the wavemaker minus dissipation in the water and the units.",
            short(change, 2)
        );
    }
    section("Energy", &format!("<figure>{chart}<figcaption>{words}</figcaption></figure>\n"))
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn irregular_waves_are_described_by_the_significant_height() {
        let wave = |kind: &str| WaveSummary { kind: kind.to_owned(), height_m: 0.12, ..WaveSummary::default() };
        assert_eq!(wave_in_words(&wave("irregular")), "Irregular waves, H_s = 12 cm at the wavemaker");
        assert_eq!(wave_in_words(&wave("solitary")), "Solitary wave, H = 12 cm at the wavemaker");
    }
}
