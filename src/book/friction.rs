//! Friction of the mound: how far the units go with it, how much of it the water asks for, where motion begins. Units that
//! it holds fast may roll over their feet instead.

use serde_json::Value;

use super::{
    entry::Entry,
    markdown::Page,
    standing::{self, MEAN_OVER_S, STILL_M},
    variation::{Change, changes},
};
use crate::{
    output::UnitSummary,
    report::{
        compare::{FRICTION_ON_MOUND, PublishedWave, RunResult},
        plot::{Line, LineChart, short},
    },
};

/// Friction of the units on the mound in a case, if it has it.
pub fn on_mound(case: &Value) -> Option<f64> {
    let pair = [case.pointer("/units/material")?, case.pointer("/flume/material")?];
    let mut table = case.get("friction")?.as_array()?.iter();
    let of_pair = |row: &&Value| {
        let between = row.get("between").and_then(Value::as_array);
        between.is_some_and(|names| pair.iter().all(|name| names.contains(name)) && names.len() == pair.len())
    };
    table.find(of_pair)?.get("coefficient")?.as_f64()
}

/// Whether a run has the friction of the experiment, so that its displacements may be held against the measured ones.
pub fn is_measured(entry: &Entry) -> bool {
    on_mound(&entry.case).is_none_or(|friction| (friction - FRICTION_ON_MOUND).abs() < 1e-9)
}

/// A run and its friction.
struct Rubbed<'a> {
    friction: f64,
    run: &'a RunResult,
    entry: &'a Entry,
}

/// Runs that differ in friction alone, by friction; at least two.
struct Alike<'a> {
    dp_m: f64,
    units: usize,
    /// What they have otherwise than the case as given, but for friction.
    changes: Vec<Change>,
    runs: Vec<Rubbed<'a>>,
}

impl<'a> Alike<'a> {
    /// Groups of runs, those of the case as it is given first, then by the distance between particles.
    fn groups(runs: &[(&'a RunResult, &'a Entry)]) -> Vec<Self> {
        let mut groups: Vec<Self> = Vec::new();
        for &(run, entry) in runs {
            let Some(friction) = on_mound(&entry.case) else { continue };
            let mut changes = changes(&entry.case);
            changes.retain(|change| !change.is_of_friction());
            let (rubbed, dp_m) = (Rubbed { friction, run, entry }, run.summary.dp_m);
            let units = run.summary.units.len();
            let is_alike = |group: &&mut Self| (group.dp_m, group.units) == (dp_m, units) && group.changes == changes;
            match groups.iter_mut().find(is_alike) {
                Some(group) => group.runs.push(rubbed),
                None => groups.push(Self { dp_m, units, changes, runs: vec![rubbed] }),
            }
        }
        for group in &mut groups {
            group.runs.sort_by(|a, b| a.friction.total_cmp(&b.friction));
        }
        let varies = |group: &Self| group.runs.iter().any(|run| run.friction != group.runs[0].friction);
        groups.retain(varies);
        groups.sort_by(|a, b| a.changes.len().cmp(&b.changes.len()).then(a.dp_m.total_cmp(&b.dp_m)));
        groups
    }

    /// What tells a group from the others, each change by `words`.
    fn name(&self, words: impl Fn(&Change) -> String) -> String {
        let distance = format!("every {} mm", short(1000.0 * self.dp_m, 2));
        [distance].into_iter().chain(self.changes.iter().map(words)).collect::<Vec<_>>().join(", ")
    }
}

/// Adds what friction does: a chart, and for runs that differ in nothing else a table and the friction that holds the
/// units; nothing unless it alone varies.
pub fn add(page: &mut Page, published: &PublishedWave, runs: &[(&RunResult, &Entry)], centimetres: &str) {
    let groups = Alike::groups(runs);
    if groups.is_empty() {
        return;
    }
    page.heading(3, &format!("Friction of the mound under the wave of {centimetres} cm"));
    page.figure(
        &format!("fudo-{centimetres}-friction.svg"),
        &chart(published, &groups),
        "Mean displacement against the friction of the mound (as Fig. 18 of the paper), beside what section 4.7 says in numbers \
         about particles of 5 mm; the rest of its curve was not published as numbers.",
        &Entry::again(groups.iter().flat_map(|group| &group.runs).map(|one| one.entry)),
    );
    page.paragraph(&format!("Published, with particles of 5 mm: {}.", said(published)));
    for group in &groups {
        page.paragraph(&format!("Particles {}:", group.name(Change::in_words)));
        add_table(page, &group.runs);
        page.list(findings(&group.runs));
    }
    page.paragraph(&format!(
        "Mobilised is the force of the water towards the shore over the weight that it leaves on the ground, means over {MEAN_OVER_S} s, \
         at most while a unit has moved less than {} mm: one value for each unit. A unit that slides later has mobilised all of \
         its friction; one that turns over has found its feet first; the value of one that does neither is the friction that \
         this wave asks for.",
        short(1000.0 * STILL_M, 2)
    ));
}

fn add_table(page: &mut Page, runs: &[Rubbed]) {
    let head = [
        "run",
        "friction",
        "mean displacement [m]",
        "damaged [%]",
        "turned by [°]",
        "friction mobilised while they stand",
    ];
    let row = |Rubbed { friction, run, entry }: &Rubbed| {
        vec![
            run.name.clone(),
            short(*friction, 2),
            format!("{:.3}", run.mean_m),
            short(100.0 * run.damage_ratio, 0),
            run.summary.units.iter().map(|unit| short(unit.rotation_deg, 0)).collect::<Vec<_>>().join(", "),
            standing::of(entry).iter().map(|unit| format!("{:.3}", unit.mobilised)).collect::<Vec<_>>().join(", "),
        ]
    };
    page.table(&head.map(str::to_owned), &runs.iter().map(row).collect::<Vec<_>>());
}

/// What section 4.7 of the paper says in numbers.
fn said(published: &PublishedWave) -> String {
    let said = published.friction;
    let beyond = if said.less_than_m == 0.0 {
        "no unit moves".to_owned()
    } else {
        format!("the mean displacement is less than {} m", short(said.less_than_m, 2))
    };
    format!(
        "{} m with a friction of {}; with more than {} {beyond}",
        short(said.mean_m, 2),
        short(said.least, 2),
        short(said.beyond, 2)
    )
}

/// Where motion begins in runs of rising friction.
fn findings(runs: &[Rubbed]) -> Vec<String> {
    let stands = |run: &RunResult| run.summary.units.iter().all(stands_still);
    let moved = runs.iter().filter(|one| !stands(one.run)).map(|one| one.friction).reduce(f64::max);
    let held = runs.iter().filter(|one| stands(one.run)).map(|one| one.friction).reduce(f64::min);
    let mut found = Vec::new();
    if let Some(friction) = moved {
        found.push(format!("A unit or more moves with every friction up to {}.", short(friction, 2)));
    }
    if let Some(friction) = held {
        found.push(format!("All stand still with {} and more.", short(friction, 2)));
    }
    // The units held best have mobilised least by creeping.
    let held_best = runs.iter().rev().map(|one| (one, asked_for(one))).find(|(_, asked)| !asked.is_empty());
    if let Some((one, asked)) = held_best {
        found.push(format!("The wave asks for a friction of {} (`{}`).", asked.join(" and "), one.run.name));
    }
    found
}

fn stands_still(unit: &UnitSummary) -> bool {
    unit.displacement_m < STILL_M
}

/// What the water mobilises at most under each unit of a run that stands still, in words.
fn asked_for(Rubbed { run, entry, .. }: &Rubbed) -> Vec<String> {
    let units = run.summary.units.iter().zip(standing::of(entry));
    units
        .filter(|(unit, _)| stands_still(unit))
        .map(|(unit, standing)| format!("{:.2} to hold unit {}", standing.mobilised, unit.unit))
        .collect()
}

/// Mean displacement against friction, a line for each group, beside the published numbers.
fn chart(published: &PublishedWave, groups: &[Alike]) -> String {
    let said = published.friction;
    let points = vec![[said.least, said.mean_m], [said.beyond, said.less_than_m]];
    let mut lines = vec![Line {
        name: "published in numbers, every 5 mm".to_owned(),
        points,
        dots: true,
        dashed: true,
        colour: 0,
        ..Line::default()
    }];
    for group in groups {
        let points = group.runs.iter().map(|one| [one.friction, one.run.mean_m]).collect();
        lines.push(Line {
            name: group.name(Change::in_brief),
            points,
            dots: true,
            colour: lines.len(),
            ..Line::default()
        });
    }
    let measured = published.measured_mean_m();
    LineChart {
        title: "Mean displacement against the friction of the mound".to_owned(),
        x_label: "friction of the units on the mound".to_owned(),
        y_label: "mean displacement [m]".to_owned(),
        lines,
        marks: vec![(measured, format!("EXP {measured:.3} m, friction {}", short(FRICTION_ON_MOUND, 2)))],
        size: [920.0, 320.0],
    }
    .svg()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_friction_on_the_mound_is_found_whatever_the_order() {
        let case = json!({
            "units": { "material": "mortar" }, "flume": { "material": "pvc" },
            "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.65 },
                         { "between": ["pvc", "mortar"], "coefficient": 0.43 }]
        });
        assert_eq!(on_mound(&case), Some(0.43));
        assert_eq!(on_mound(&json!({})), None);
    }
}
