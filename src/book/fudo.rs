//! The page beside the experiment of Mitsui et al. (2023).

use std::collections::BTreeMap;

use super::{entry::Entry, markdown::Page, overview, wave};
use crate::report::{compare::Comparison, page::clock, plot::short};

/// Name of the page.
pub const FILE: &str = "fudo.md";

/// The page: an overview, the runs, a section for each wave, what is assumed.
pub fn page(comparison: &Comparison, entries: &[Entry]) -> Page {
    let mut page = Page::new("Tetrapods on a mound under solitary waves, beside Mitsui et al. (2023)");
    page.paragraph(
        "Written by `breakwater book`; every number and figure comes from the folder `runs` beside this page.\n\
         Displacement is the horizontal distance seen from above; a unit counts as damaged when it has moved further than\n\
         0.077 m, its height. EXP1 to EXP3 are the three repetitions in the flume, SPH1 and SPH2 the two published\n\
         simulations with particles of 5 mm, which differ in how the units were turned. A slice is two units between\n\
         periodic sides: it stands for the inner units of the row, has no side walls, and no unit of it is one of the\n\
         experiment's. The published runs lasted 20 s.",
    );
    overview::add(&mut page, comparison, entries);
    page.heading(2, "Runs");
    let head = [
        "run",
        "wave [cm]",
        "particles every [mm]",
        "units",
        "particles",
        "Courant number",
        "steps",
        "mean step [ms]",
        "simulated [s]",
        "ended",
        "took",
        "threads",
        "computed by",
        "on",
    ];
    let rows: Vec<Vec<String>> = entries.iter().map(run_row).collect();
    page.table(&head.map(str::to_owned), &rows);
    page.paragraph("All of them again, from the folder of this page, as every command under a figure:");
    page.code(&Entry::again(entries));
    for of_wave in &comparison.waves {
        wave::add_section(&mut page, of_wave, entries);
    }
    add_words(
        &mut page,
        "Assumed",
        "A run that has a key otherwise than the case as given, by the tables above, keeps the words of that case.",
        entries,
        |entry| &entry.summary.assumptions,
    );
    add_words(
        &mut page,
        "Warnings of the runs",
        "Each with the runs that gave it, unless all did.",
        entries,
        |entry| &entry.summary.warnings,
    );
    page
}

fn run_row(entry: &Entry) -> Vec<String> {
    let summary = &entry.summary;
    let device = summary.execution.device.as_deref().unwrap_or("processor");
    let height = summary.wave.as_ref().map_or(f64::NAN, |wave| wave.height_m);
    vec![
        entry.name.clone(),
        short(100.0 * height, 1),
        short(1000.0 * summary.dp_m, 2),
        summary.units.len().to_string(),
        summary.particles.to_string(),
        entry.case_file().map(|file| short(file.numerics.cfl, 2)).unwrap_or_default(),
        summary.steps.to_string(),
        format!("{:.2}", 1000.0 * summary.simulated_s / summary.steps as f64),
        short(summary.simulated_s, 2),
        summary.stopped.to_string(),
        clock(summary.execution.wall_s),
        summary.execution.threads.to_string(),
        format!("{device}, breakwater {}", summary.breakwater_version),
        summary.execution.processor.clone().unwrap_or_else(|| "not recorded".to_owned()),
    ]
}

/// Sentences of the summaries, and which of the runs they are from if not from all.
fn add_words<'a>(
    page: &mut Page,
    heading: &str,
    about: &str,
    entries: &'a [Entry],
    of: impl Fn(&'a Entry) -> &'a [String],
) {
    let mut said: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for entry in entries {
        of(entry).iter().for_each(|words| said.entry(words).or_default().push(&entry.name));
    }
    if said.is_empty() {
        return;
    }
    page.heading(2, heading);
    page.paragraph(about);
    let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
    page.list(said.into_iter().map(|(words, runs)| words.to_owned() + &whose(&runs, &names)));
}

/// Of which runs something is said, whichever way takes fewer names; nothing if of all.
fn whose(runs: &[&str], all: &[&str]) -> String {
    let others: Vec<&str> = all.iter().copied().filter(|name| !runs.contains(name)).collect();
    match others.len() {
        0 => String::new(),
        few if few < runs.len() => format!(" (all but {})", others.join(", ")),
        _ => format!(" ({})", runs.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_of_most_runs_names_the_others() {
        let all = ["a", "b", "c"];
        assert_eq!(whose(&all, &all), "");
        assert_eq!(whose(&["a", "c"], &all), " (all but b)");
        assert_eq!(whose(&["b"], &all), " (b)");
    }
}
