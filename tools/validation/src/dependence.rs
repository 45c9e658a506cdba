//! Sensitivity: effect of changed inputs on the mean displacement.

use breakwater::{
    case::ReferenceWave,
    report::plot::{TornadoChart, TornadoInput},
    sweep::key::brief,
};

use crate::{
    change::{Change, FRICTION},
    compared::{Compared, centimetres, millimetres},
    markdown::{Page, signed},
};

/// Runs of the different waves with the same changes and the same particle spacing.
struct Group<'a> {
    dp_m: f64,
    changes: &'a [Change],
    /// Change of the mean displacement from the base case [%], for each wave.
    percents: Vec<Option<f64>>,
}

/// Groups the runs by changes and particle spacing. Runs of the friction sweep are left out; they have their own
/// figure.
fn groups<'a>(waves: &[&ReferenceWave], results: &'a [Compared]) -> Vec<Group<'a>> {
    let mut groups: Vec<Group> = Vec::new();
    for result in results {
        let is_alike = |other: &&Compared| other.wave == result.wave && other.dp_m() == result.dp_m();
        let base = results.iter().filter(is_alike).find(|other| other.changes.is_empty());
        let (Some(base), Some(wave)) = (base, waves.iter().position(|wave| *wave == result.wave)) else { continue };
        let is_friction = result.changes.iter().any(|change| change.key == FRICTION);
        if result.changes.is_empty() || is_friction {
            continue;
        }
        let (dp_m, changes) = (result.dp_m(), &result.changes[..]);
        let index =
            groups.iter().position(|group| group.dp_m == dp_m && group.changes == changes).unwrap_or_else(|| {
                groups.push(Group { dp_m, changes, percents: vec![None; waves.len()] });
                groups.len() - 1
            });
        groups[index].percents[wave] = Some(100.0 * (result.run.mean_m / base.run.mean_m - 1.0));
    }
    let key = |group: &Group| {
        (group.changes.iter().map(|change| change.key.clone()).collect::<Vec<_>>(), group.changes[0].value_in_words())
    };
    groups.sort_by_key(key);
    groups
}

/// Adds figure and table of the changed inputs to the page, unless no run has a changed input.
pub fn add(page: &mut Page, waves: &[&ReferenceWave], results: &[Compared]) {
    let groups = groups(waves, results);
    if groups.is_empty() {
        return;
    }
    let caption = "Change of the mean displacement when one input is changed; the label of a bar gives the changed \
                   value and the wave.";
    page.figure("fudo-dependence.svg", &chart(waves, &groups), caption);
    page.add("## What the result depends on");
    let mut head = ["input", "base value", "changed value", "particle spacing [mm]"].map(str::to_owned).to_vec();
    head.extend(waves.iter().map(|wave| format!("{} cm [%]", centimetres(wave))));
    let row = |group: &Group| {
        let joined = |words: &dyn Fn(&Change) -> String| group.changes.iter().map(words).collect::<Vec<_>>().join("; ");
        let mut row = vec![
            joined(&|change| format!("`{}`", brief(&change.key))),
            joined(&Change::base_in_words),
            joined(&Change::value_in_words),
            millimetres(group.dp_m),
        ];
        row.extend(group.percents.iter().map(|percent| percent.map(signed).unwrap_or_default()));
        row
    };
    page.table(&head, &groups.iter().map(row).collect::<Vec<_>>());
    page.add(
        "For each wave, the last columns give the change of the mean displacement from the base case at the same \
         particle spacing. An empty cell means that there is no such run.",
    );
}

fn chart(waves: &[&ReferenceWave], groups: &[Group]) -> String {
    let mut levers: Vec<TornadoInput> = Vec::new();
    for group in groups {
        let [change] = group.changes else { continue };
        let name = format!("{} {}", brief(&change.key), change.base_in_words());
        let values = waves.iter().zip(&group.percents).filter_map(|(wave, percent)| {
            Some((format!("{}, {} cm", change.value_in_words(), centimetres(wave)), (*percent)?))
        });
        match levers.iter_mut().find(|lever| lever.name == name) {
            Some(lever) => lever.values.extend(values),
            None => levers.push(TornadoInput { name, values: values.collect() }),
        }
    }
    TornadoChart {
        title: "What the mean displacement depends on".to_owned(),
        x_label: "change of the mean displacement [%]".to_owned(),
        levers,
        width: 920.0,
    }
    .svg()
}
