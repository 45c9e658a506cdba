//! Results of the breakage analysis for each unit: displacement, hardest impact, and breakage.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::blow::{Balance, ScaledImpact};
use super::fracture_case::{PARTNER, is_unit};
use super::model::{Model, Role};
use crate::case::{BreakageSettings, RerunMethod};
use crate::output::{BreakageSummary, CsvSeries, Impacts, OutputError, columns, write_atomically};
use crate::simulation::fracture::summary::FractureSummary;

/// A unit is broken if its heaviest piece has less than this share of the mass of the unit [-]. A unit with chipped
/// edges or crushed feet does not count as broken.
pub const BROKEN: f64 = 0.95;

/// Displacement of a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moved {
    /// Displacement in the run [m].
    pub displacement: f64,
    /// True if the displacement exceeds the damage distance.
    pub damaged: bool,
}

/// Content of `breakage.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Breakage {
    /// Length in the prototype divided by length in the run [-].
    pub scale: f64,
    /// Share of the units that moved further than the damage distance [-].
    pub damaged_ratio: f64,
    /// Share of the units that broke in the re-runs [-].
    pub broken_ratio: f64,
    /// Results for each unit of the group.
    pub units: Vec<UnitBreakage>,
    /// The impacts that were re-run, the hardest first.
    pub impacts: Vec<Outcome>,
}

/// Displacement and breakage of a unit. Forces, stresses and areas are at prototype scale.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UnitBreakage {
    /// Number of the unit, from 1.
    pub unit: usize,
    /// Displacement in the run [m].
    pub displacement_m: f64,
    /// True if the displacement exceeds the damage distance.
    pub damaged: bool,
    /// Largest force of the unit's recorded impacts, scaled by [`ScaledImpact::scale`] [N]; 0 without impacts.
    pub peak_force_n: f64,
    /// Largest nominal stress of the unit's recorded impacts by beam theory [Pa]; none for units from STL files.
    pub nominal_stress_pa: Option<f64>,
    /// Largest first principal stress in the re-runs of the unit's impacts [Pa]; none if no impact of the unit was
    /// re-run.
    pub sigma_1_pa: Option<f64>,
    /// Largest crack area in the re-runs of the unit's impacts [m2]; none if no impact of the unit was re-run.
    pub crack_area_m2: Option<f64>,
    /// Largest number of pieces in the re-runs of the unit's impacts; none if no impact of the unit was re-run.
    pub pieces: Option<usize>,
    /// Mass of the heaviest piece divided by the mass of the unit [-]: smallest value in the re-runs of the unit's
    /// impacts; none if no impact of the unit was re-run.
    pub heaviest_share: Option<f64>,
    /// True if the unit broke, that is, if `heaviest_share` is below 0.95; none if no impact of the unit was re-run.
    pub broken: Option<bool>,
}

/// An impact that was re-run at prototype scale.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Name of the fracture case, and of its result folder in `impacts/`.
    pub name: String,
    /// Method of the re-run: collision or recorded forces.
    pub way: RerunMethod,
    /// Number of the unit, from 1.
    pub unit: usize,
    /// Number of the other unit of the impact, from 1; none for an impact on bed or wall.
    pub partner: Option<usize>,
    /// Time in the run at which the contact began [s].
    pub t_s: f64,
    /// Normal velocity of approach in the run [m/s].
    pub approach_m_s: f64,
    /// Largest force of the impact in the run [N].
    pub peak_force_n: f64,
    /// Largest force of the impact, scaled to the prototype by [`ScaledImpact::scale`] [N].
    pub prototype_force_n: f64,
    /// Duration of the impact in the prototype by Hertz's law [s].
    pub blow_s: f64,
    /// Mass, momentum and energy of the unit in the run and in the fracture run, at prototype scale.
    pub balance: Balance,
    /// Results for the unit, and for the other unit if it was part of the re-run.
    pub found: Vec<Found>,
    /// Largest residual of the energy balance, divided by the largest kinetic energy [-]; none after a failure.
    pub energy_residual_ratio: Option<f64>,
    /// Reason why the fracture run failed; none if it succeeded.
    pub failure: Option<String>,
}

/// Result of a re-run for one unit of the prototype.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Number of the unit, from 1.
    pub unit: usize,
    /// Largest first principal stress [Pa].
    pub sigma_1_pa: f64,
    /// Crack area [m2].
    pub crack_area_m2: f64,
    /// Number of pieces; 1 for a unit in one piece.
    pub pieces: usize,
    /// Mass of the heaviest piece divided by the mass of the unit [-].
    pub heaviest_share: f64,
    /// Change of momentum from just before the impact to the end of the fracture run [N s].
    pub impulse_n_s: [f64; 3],
}

impl From<&Breakage> for BreakageSummary {
    fn from(breakage: &Breakage) -> Self {
        let Breakage { scale, damaged_ratio, broken_ratio, .. } = *breakage;
        Self { scale, damaged_ratio, broken_ratio }
    }
}

impl Outcome {
    /// Returns the outcome of an impact whose fracture run ended with a summary or with an error.
    pub fn of(
        name: &str,
        way: RerunMethod,
        blow: &ScaledImpact,
        balance: Balance,
        ended: Result<FractureSummary, String>,
    ) -> Self {
        let touched = |summary: &FractureSummary| way == RerunMethod::LoadHistory || summary.impact_s.is_some();
        let ended = match ended {
            Ok(summary) if !touched(&summary) => Err("the bodies did not touch: raise breakage.duration_s".to_owned()),
            ended => ended,
        };
        let event = &blow.impact.event;
        let unit = event.body as usize + 1;
        let partner = event.partner_unit().map(|unit| unit as usize + 1);
        let found = |summary: &FractureSummary| {
            let (mover, other) = blow.movers();
            let bodies = summary.bodies.iter().filter(|body| is_unit(&body.name));
            let result = |body: &crate::simulation::fracture::summary::BodySummary| {
                let is_partner = body.name == PARTNER;
                let pieces: Vec<_> = summary.fragments.iter().filter(|piece| piece.body == body.name).collect();
                let heaviest = pieces.iter().map(|piece| piece.mass_kg).fold(0.0, f64::max);
                let before =
                    if is_partner { other.map_or(mover.velocity, |other| other.velocity) } else { mover.velocity };
                Found {
                    unit: if is_partner { partner.unwrap_or(unit) } else { unit },
                    sigma_1_pa: body.peak.sigma_1_pa,
                    crack_area_m2: body.crack_area_m2,
                    // Bodies that cannot crack have no fragments.
                    pieces: pieces.len().max(1),
                    heaviest_share: if pieces.is_empty() { 1.0 } else { heaviest / body.mass_kg },
                    impulse_n_s: std::array::from_fn(|axis| body.mass_kg * (body.velocity_m_s[axis] - before[axis])),
                }
            };
            bodies.map(result).collect()
        };
        Self {
            name: name.to_owned(),
            way,
            unit,
            partner,
            t_s: event.start,
            approach_m_s: event.approach_normal,
            peak_force_n: event.peak_force,
            prototype_force_n: event.peak_force * blow.scale.force,
            blow_s: blow.duration,
            balance,
            found: ended.as_ref().map(found).unwrap_or_default(),
            energy_residual_ratio: ended.as_ref().ok().map(|summary| summary.energy_residual_ratio),
            failure: ended.err(),
        }
    }

    /// Describes the outcome in one line.
    pub fn in_words(&self) -> String {
        if let Some(failure) = &self.failure {
            return format!("not computed: {failure}");
        }
        let describe = |found: &Found| {
            let state = state_in_words(found.heaviest_share < BROKEN, found.crack_area_m2);
            format!(
                "unit {} {state}, sigma_1 {:.2} MPa, crack area {:.3} m2, pieces: {}",
                found.unit,
                found.sigma_1_pa * 1e-6,
                found.crack_area_m2,
                found.pieces
            )
        };
        self.found.iter().map(describe).collect::<Vec<_>>().join("; ")
    }
}

/// Returns "broken", "cracked, not broken" or "whole".
pub fn state_in_words(broken: bool, crack_area: f64) -> &'static str {
    match (broken, crack_area > 0.0) {
        (true, _) => "broken",
        (false, true) => "cracked, not broken",
        (false, false) => "whole",
    }
}

impl Breakage {
    /// Name of the result file in the run folder.
    pub const FILE: &str = "breakage.json";
    /// Name of the result table in the run folder.
    pub const TABLE: &str = "breakage.csv";

    /// Collects, for each unit of a run, the results of its impacts.
    pub fn of(
        model: &Model,
        settings: &BreakageSettings,
        impacts: &Impacts,
        moved: &[Moved],
        outcomes: Vec<Outcome>,
    ) -> Self {
        let mut peaks = vec![0.0f64; moved.len()];
        for impact in &impacts.impacts {
            let force = impact.event.peak_force * ScaledImpact::new(model, settings, impact).scale.force;
            for role in Role::of(impact) {
                peaks[role.unit] = peaks[role.unit].max(force);
            }
        }
        let nominal = model.nominal_stresses(settings, impacts);
        let is_known = !model.sections().is_empty();
        let unit = |(index, moved): (usize, &Moved)| {
            let found = || outcomes.iter().flat_map(|outcome| &outcome.found).filter(|f| f.unit == index + 1);
            let largest = |value: fn(&Found) -> f64| found().map(value).reduce(f64::max);
            let share = found().map(|found| found.heaviest_share).reduce(f64::min);
            UnitBreakage {
                unit: index + 1,
                displacement_m: moved.displacement,
                damaged: moved.damaged,
                peak_force_n: peaks[index],
                nominal_stress_pa: is_known.then_some(nominal[index]),
                sigma_1_pa: largest(|found| found.sigma_1_pa),
                crack_area_m2: largest(|found| found.crack_area_m2),
                pieces: found().map(|found| found.pieces).max(),
                heaviest_share: share,
                broken: share.map(|share| share < BROKEN),
            }
        };
        let units: Vec<UnitBreakage> =
            moved.iter().enumerate().filter(|(index, _)| model.members.contains(index)).map(unit).collect();
        let ratio = |is_counted: fn(&UnitBreakage) -> bool| {
            units.iter().filter(|unit| is_counted(unit)).count() as f64 / units.len().max(1) as f64
        };
        Self {
            scale: settings.scale,
            damaged_ratio: ratio(|unit| unit.damaged),
            broken_ratio: ratio(|unit| unit.broken == Some(true)),
            units,
            impacts: outcomes,
        }
    }

    /// Reads `breakage.json` of a run folder; `None` if there is none.
    ///
    /// # Errors
    /// If the file cannot be read or has the wrong format.
    pub fn read_if_present(dir: &Path) -> Result<Option<Self>, OutputError> {
        let path = dir.join(Self::FILE);
        if !path.exists() {
            return Ok(None);
        }
        let text = std::fs::read_to_string(&path).map_err(OutputError::io(&path))?;
        serde_json::from_str(&text).map(Some).map_err(OutputError::json(&path))
    }

    /// Writes `breakage.json` and `breakage.csv`.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, dir: &Path) -> Result<(), OutputError> {
        let path = dir.join(Self::FILE);
        let mut text = serde_json::to_string_pretty(self).map_err(OutputError::json(&path))?;
        text.push('\n');
        write_atomically(&path, text.as_bytes())?;
        let mut table = CsvSeries::create(&dir.join(Self::TABLE), &columns::BREAKAGE)?;
        let as_number = |value: bool| f64::from(u8::from(value));
        for unit in &self.units {
            let or_nan = |value: Option<f64>| value.unwrap_or(f64::NAN);
            table.append(&[
                unit.unit as f64,
                unit.displacement_m,
                as_number(unit.damaged),
                unit.peak_force_n,
                or_nan(unit.nominal_stress_pa),
                or_nan(unit.sigma_1_pa),
                or_nan(unit.crack_area_m2),
                or_nan(unit.pieces.map(|pieces| pieces as f64)),
                or_nan(unit.heaviest_share),
                or_nan(unit.broken.map(as_number)),
            ])?;
        }
        Ok(())
    }
}
