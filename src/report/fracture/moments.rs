//! Choice of the recorded times (moments) that the report shows.

use crate::simulation::fracture::summary::InitiationSummary;

/// Largest number of main cracks: the largest cracks, for which the report shows when and where they start.
const MAIN_CRACKS: usize = 4;
/// Minimum number of moments that are shown, if the run recorded enough.
const LEAST: usize = 6;

/// A recorded time that the report shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Moment {
    /// Index of the recorded time in the files.
    pub frame: usize,
    /// Numbers (from 1) of the cracks that started after the previous moment that is shown.
    pub begun: Vec<usize>,
    /// Why the report shows this moment.
    pub why: Why,
}

/// Why a moment is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Why {
    /// The first moment after the impact or, if no bodies touched, the start of the run.
    Impact,
    /// A main crack has just started.
    Crack,
    /// The moment is halfway between two other shown moments.
    Between,
    /// The last moment.
    End,
}

/// Returns the numbers of the main cracks (from 1), in chronological order.
pub fn main_cracks(initiations: &[InitiationSummary]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..initiations.len()).collect();
    order.sort_by(|a, b| initiations[*b].area_m2.total_cmp(&initiations[*a].area_m2));
    order.truncate(MAIN_CRACKS);
    order.sort_unstable();
    order.into_iter().map(|index| index + 1).collect()
}

/// Chooses the moments just after the impact, at the start of each main crack and at the end. Adds intermediate moments
/// until there are `LEAST` moments, if the run recorded enough.
pub fn moments(times_s: &[f64], impact_s: Option<f64>, initiations: &[InitiationSummary]) -> Vec<Moment> {
    let mut shown = ends(times_s, impact_s);
    for crack in main_cracks(initiations) {
        shown.extend(first_after(times_s, initiations[crack - 1].t_s).map(|frame| (frame, Why::Crack)));
    }
    // If a crack starts at the last moment, the reason `Crack` is sorted first and replaces the reason `End`.
    shown.sort_by_key(|(frame, why)| (*frame, *why == Why::End));
    shown.dedup_by_key(|(frame, _)| *frame);
    while shown.len() < LEAST {
        let widest = (1..shown.len()).max_by_key(|k| shown[*k].0 - shown[*k - 1].0);
        match widest.filter(|k| shown[*k].0 - shown[*k - 1].0 > 1) {
            Some(k) => shown.insert(k, ((shown[k - 1].0 + shown[k].0) / 2, Why::Between)),
            None => break,
        }
    }
    with_cracks(shown, times_s, initiations)
}

/// Chooses only the moments just after the impact and at the end.
pub fn impact_and_end(times_s: &[f64], impact_s: Option<f64>, initiations: &[InitiationSummary]) -> Vec<Moment> {
    with_cracks(ends(times_s, impact_s), times_s, initiations)
}

/// Returns the first moment after the impact and the last moment, or only one moment if both are the same.
fn ends(times_s: &[f64], impact_s: Option<f64>) -> Vec<(usize, Why)> {
    let impact = first_after(times_s, impact_s.unwrap_or(0.0)).map(|frame| (frame, Why::Impact));
    let end = times_s.len().checked_sub(1).map(|last| (last, Why::End));
    let mut ends: Vec<(usize, Why)> = impact.into_iter().chain(end).collect();
    ends.dedup_by_key(|(frame, _)| *frame);
    ends
}

/// Returns the index of the first recorded time at or after `time_s` [s], or the last index if there is none. `None`
/// without recorded times.
fn first_after(times_s: &[f64], time_s: f64) -> Option<usize> {
    times_s.iter().position(|t| *t >= time_s).or(times_s.len().checked_sub(1))
}

/// Adds to each chosen moment the cracks that started after the previous chosen moment.
fn with_cracks(shown: Vec<(usize, Why)>, times_s: &[f64], initiations: &[InitiationSummary]) -> Vec<Moment> {
    let mut counted = 0;
    let begun_by = |frame: usize| initiations.iter().filter(|i| i.t_s <= times_s[frame]).count();
    shown
        .into_iter()
        .map(|(frame, why)| {
            let begun = (counted + 1..=begun_by(frame)).collect();
            counted = begun_by(frame);
            Moment { frame, begun, why }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crack(t_s: f64, area_m2: f64) -> InitiationSummary {
        let body = "unit".to_owned();
        let mode = "opening".to_owned();
        let (since_impact_s, near, distance_m) = (None, None, None);
        InitiationSummary { t_s, since_impact_s, body, place: [0.0; 3], near, distance_m, mode, area_m2 }
    }

    #[test]
    fn impact_main_cracks_and_end_are_shown() {
        let times: Vec<f64> = (0..=20).map(f64::from).collect();
        let cracks = [(5.5, 2.0), (6.0, 0.1), (6.1, 9.0), (7.0, 1.0), (12.0, 1.5)].map(|(t, area)| crack(t, area));
        assert_eq!(main_cracks(&cracks), [1, 3, 4, 5]);
        let shown = moments(&times, Some(0.4), &cracks);
        assert_eq!(shown.iter().map(|m| m.frame).collect::<Vec<_>>(), [1, 6, 7, 12, 16, 20]);
        assert_eq!(shown[1].begun, [1, 2]);
        assert_eq!(shown[2].begun, [3, 4]);
        assert_eq!((shown[0].why, shown[5].why), (Why::Impact, Why::End));
    }

    #[test]
    fn a_run_without_cracks_is_shown_at_intermediate_moments() {
        let times: Vec<f64> = (0..=20).map(f64::from).collect();
        let shown = moments(&times, None, &[]);
        assert_eq!(shown.iter().map(|m| m.frame).collect::<Vec<_>>(), [0, 5, 10, 15, 17, 20]);
        assert_eq!(moments(&[0.0], None, &[]).len(), 1);
        assert!(moments(&[], None, &[]).is_empty());
    }

    #[test]
    fn impact_and_end_can_be_shown_without_other_moments() {
        let times: Vec<f64> = (0..=20).map(f64::from).collect();
        let shown = impact_and_end(&times, Some(2.5), &[crack(5.5, 2.0), crack(12.0, 1.0)]);
        assert_eq!(shown.iter().map(|m| (m.frame, m.why)).collect::<Vec<_>>(), [(3, Why::Impact), (20, Why::End)]);
        assert_eq!(shown[1].begun, [1, 2]);
        assert_eq!(impact_and_end(&times, Some(50.0), &[]).len(), 1);
        assert!(impact_and_end(&[], None, &[]).is_empty());
    }
}
