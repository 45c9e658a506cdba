//! Selects the impacts that are re-run at prototype scale.

use crate::case::{ImpactMeasure, Selection};
use crate::output::{Impact, Impacts};
use crate::rigid::Feature;

/// Returns the quantity by which impacts are ranked: force [N], velocity [m/s] or energy [J].
pub fn hardness(impact: &Impact, by: ImpactMeasure) -> f64 {
    match by {
        ImpactMeasure::PeakForce => impact.event.peak_force,
        ImpactMeasure::ApproachVelocity => impact.event.approach_normal,
        ImpactMeasure::KineticEnergy => impact.event.approach_energy,
    }
}

/// Returns the indices of the impacts to re-run, the hardest first. If a unit lands on three feet, only the hardest
/// contact is selected, because its re-run includes the other two contacts.
pub fn select(impacts: &Impacts, selection: &Selection) -> Vec<usize> {
    let all = &impacts.impacts;
    let score = |index: &usize| hardness(&all[*index], selection.by);
    let mut order: Vec<usize> = (0..all.len()).filter(|index| score(index) >= selection.at_least).collect();
    // The sort is stable: impacts that are equally hard keep the order of the file, in which larger forces come first.
    order.sort_by(|a, b| score(b).total_cmp(&score(a)));
    let mut chosen: Vec<usize> = Vec::new();
    for index in order {
        if chosen.len() == selection.worst.unwrap_or(usize::MAX) {
            break;
        }
        if !chosen.iter().any(|other| same_collision(&all[*other], &all[index])) {
            chosen.push(index);
        }
    }
    chosen
}

/// Returns true if two contacts are between the same bodies, and the time between their starts is at most the duration
/// of the longer contact. The duration of a contact is estimated as twice the time from its start to its peak force.
pub fn same_collision(a: &Impact, b: &Impact) -> bool {
    let bodies = |impact: &Impact| {
        let (body, partner) = (Some(impact.event.body), impact.event.partner_unit());
        let wall = if let Feature::Wall { wall, .. } = impact.event.partner { Some(wall) } else { None };
        ([body.max(partner), body.min(partner)], wall)
    };
    let rise_time = |impact: &Impact| impact.event.peak_time - impact.event.start;
    let duration = 2.0 * rise_time(a).max(rise_time(b));
    bodies(a) == bodies(b) && (a.event.start - b.event.start).abs() <= duration
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::{BodyState, ContactEvent};
    use glam::{DQuat, DVec3};

    fn impact(body: u32, start: f64, peak_force: f64, approach: f64) -> Impact {
        let before = BodyState::at_rest(DVec3::ZERO, DQuat::IDENTITY);
        let event = ContactEvent {
            number: 0,
            start,
            end: start + 2e-3,
            body,
            partner: Feature::Ground { place: 0, end: 0 },
            point: [0.0; 3],
            point_in_body: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            before,
            partner_before: None,
            approach_normal: approach,
            approach_tangential: 0.0,
            approach_energy: 0.5 * approach * approach,
            rebound: 0.0,
            peak_force,
            peak: [0.0, 0.0, peak_force],
            peak_time: start + 1e-3,
            impulse: [0.0; 3],
        };
        Impact { event, history: Vec::new(), fluid: None }
    }

    #[test]
    fn hardest_impacts_come_first_and_a_landing_on_several_feet_counts_once() {
        let list = vec![
            impact(0, 1.0, 50.0, 0.3),
            impact(0, 1.0005, 49.0, 0.3),
            impact(1, 1.0, 40.0, 0.2),
            impact(0, 2.0, 30.0, 0.6),
        ];
        let impacts = Impacts { places: Vec::new(), impacts: list };
        let chosen = |by, worst, at_least| select(&impacts, &Selection { by, worst, at_least });
        assert_eq!(chosen(ImpactMeasure::PeakForce, None, 0.0), [0, 2, 3]);
        assert_eq!(chosen(ImpactMeasure::PeakForce, Some(2), 0.0), [0, 2]);
        assert_eq!(chosen(ImpactMeasure::PeakForce, None, 35.0), [0, 2]);
        assert_eq!(chosen(ImpactMeasure::ApproachVelocity, Some(1), 0.0), [3]);
        assert_eq!(chosen(ImpactMeasure::KineticEnergy, None, 0.1), [3]);
    }
}
