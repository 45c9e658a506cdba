//! The impacts with the largest peak forces and approach energies of each unit. The breakage analysis selects from
//! these impacts.
//!
//! An impact needs about 0.5 kB, and its force history at most 2.5 kB. A unit therefore needs at most 48 kB in any run.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::event::ContactEvent;
use super::force_history::ForceHistory;

/// Largest number of impacts that are kept per unit because of their peak force.
pub const MAX_HARDEST: usize = 12;

/// Largest number of further impacts that are kept per unit because of their approach energy.
pub const MAX_MOST_ENERGETIC: usize = 4;

/// A contact with its force history.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecordedContact {
    /// Start, peak and end of the contact.
    pub event: ContactEvent,
    /// Force on `event.body` against time.
    pub history: ForceHistory,
}

/// Rank of an impact. The impact with the larger `value` [N or J] comes first; if values are equal, the earlier impact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Rank {
    value: f64,
    number: u64,
}

impl Rank {
    fn is_before(&self, other: &Self) -> bool {
        self.value.total_cmp(&other.value).then(other.number.cmp(&self.number)).is_gt()
    }
}

/// The impacts of one unit, highest rank first.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
struct UnitRanks {
    by_force: Vec<Rank>,
    by_energy: Vec<Rank>,
}

/// The hardest impacts of each unit so far, with their histories.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ImpactLog {
    impacts: BTreeMap<u64, RecordedContact>,
    units: Vec<UnitRanks>,
}

/// Inserts `new` into the ranked list. If the list exceeds `room` entries, removes and returns the lowest rank.
fn rank_in(list: &mut Vec<Rank>, room: usize, new: Rank) -> Option<Rank> {
    let index = list.iter().position(|old| new.is_before(old)).unwrap_or(list.len());
    list.insert(index, new);
    if list.len() > room { list.pop() } else { None }
}

fn has_room(list: &[Rank], room: usize, new: Rank) -> bool {
    list.len() < room || list.last().is_some_and(|last| new.is_before(last))
}

/// Numbers of the one or two units of a contact, from 0.
fn units_of(event: &ContactEvent) -> impl Iterator<Item = usize> + use<> {
    let partner = event.partner_unit().filter(|partner| *partner != event.body);
    [Some(event.body), partner].into_iter().flatten().map(|unit| unit as usize)
}

fn ranks(event: &ContactEvent) -> [Rank; 2] {
    [event.peak_force, event.approach_energy].map(|value| Rank { value, number: event.number })
}

impl ImpactLog {
    /// The kept impacts, in the order in which they started.
    pub fn impacts(&self) -> impl Iterator<Item = &RecordedContact> {
        self.impacts.values()
    }

    /// The kept impacts, in descending order of peak force.
    pub fn into_hardest_first(self) -> Vec<RecordedContact> {
        let mut impacts: Vec<RecordedContact> = self.impacts.into_values().collect();
        // The sort is stable: of impacts with equal peak force, the earlier impact comes first.
        impacts.sort_by(|a, b| b.event.peak_force.total_cmp(&a.event.peak_force));
        impacts
    }

    /// Returns true if the log would keep an impact with its current peak force and approach energy.
    pub fn would_keep(&self, event: &ContactEvent) -> bool {
        let [force, energy] = ranks(event);
        let keeps = |unit: usize| {
            self.units.get(unit).is_none_or(|unit| {
                has_room(&unit.by_force, MAX_HARDEST, force) || has_room(&unit.by_energy, MAX_MOST_ENERGETIC, energy)
            })
        };
        event.peak_force > 0.0 && units_of(event).any(keeps)
    }

    /// Adds an ended contact if it is among the hardest impacts of one of its units.
    pub fn add(&mut self, mut contact: RecordedContact) {
        if !self.would_keep(&contact.event) {
            return;
        }
        contact.history.shorten();
        let event = contact.event;
        self.impacts.insert(event.number, contact);
        let out: Vec<u64> = units_of(&event).filter_map(|unit| self.rank(unit, &event)).collect();
        out.into_iter().for_each(|number| self.drop_if_unranked(number));
    }

    /// Adds an impact to the ranking of a unit. Returns the number of the impact that leaves the ranking, if any.
    fn rank(&mut self, unit: usize, event: &ContactEvent) -> Option<u64> {
        if self.units.len() <= unit {
            self.units.resize_with(unit + 1, UnitRanks::default);
        }
        let [force, _] = ranks(event);
        let lists = &mut self.units[unit];
        // An impact that leaves the ranking by force can still enter the ranking by energy.
        let weaker = rank_in(&mut lists.by_force, MAX_HARDEST, force)?;
        let [_, energy] = ranks(&self.impacts[&weaker.number].event);
        rank_in(&mut lists.by_energy, MAX_MOST_ENERGETIC, energy).map(|out| out.number)
    }

    /// Removes an impact if no unit has it in its ranking.
    fn drop_if_unranked(&mut self, number: u64) {
        let ranked = |unit: usize| {
            let UnitRanks { by_force, by_energy } = &self.units[unit];
            by_force.iter().chain(by_energy).any(|rank| rank.number == number)
        };
        let is_unranked = self.impacts.get(&number).is_some_and(|impact| !units_of(&impact.event).any(ranked));
        if is_unranked {
            self.impacts.remove(&number);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::Feature;
    use crate::rigid::record::event::event_for_tests;

    /// Contact of unit `number % 3` with the next unit or a wall; forces and energies are quasi-random.
    fn contact(number: u64) -> RecordedContact {
        let spread = |factor: f64| (number as f64 * factor).fract();
        let body = (number % 3) as u32;
        let partner = match number % 2 {
            0 => Feature::Unit { body: (body + 1) % 3, image: 0, part: 0 },
            _ => Feature::Wall { wall: 0, end: 0 },
        };
        let (peak_force, approach_energy) = (1.0 + spread(0.618_033_988_7), spread(0.414_213_562_4));
        let event = ContactEvent { number, body, partner, peak_force, approach_energy, ..event_for_tests() };
        RecordedContact { event, history: ForceHistory::default() }
    }

    /// Numbers of the contacts that the log should keep, found from the full list.
    fn expected(contacts: &[RecordedContact]) -> Vec<u64> {
        let mut kept: Vec<u64> = Vec::new();
        for unit in 0..3 {
            let mut own: Vec<&ContactEvent> =
                contacts.iter().map(|c| &c.event).filter(|e| units_of(e).any(|u| u == unit)).collect();
            own.sort_by(|a, b| b.peak_force.total_cmp(&a.peak_force));
            let mut rest = own.split_off(MAX_HARDEST.min(own.len()));
            rest.sort_by(|a, b| b.approach_energy.total_cmp(&a.approach_energy));
            kept.extend(own.iter().chain(rest.iter().take(MAX_MOST_ENERGETIC)).map(|event| event.number));
        }
        kept.sort_unstable();
        kept.dedup();
        kept
    }

    #[test]
    fn impact_log_keeps_exactly_the_hardest_and_most_energetic_of_each_unit() {
        let mut log = ImpactLog::default();
        let contacts: Vec<RecordedContact> = (0..2000).map(contact).collect();
        for (count, contact) in contacts.iter().enumerate() {
            let would = log.would_keep(&contact.event);
            log.add(contact.clone());
            let kept: Vec<u64> = log.impacts().map(|impact| impact.event.number).collect();
            assert!(kept.len() <= 3 * (MAX_HARDEST + MAX_MOST_ENERGETIC));
            assert_eq!(would, kept.contains(&contact.event.number));
            if count % 100 == 7 {
                assert_eq!(kept, expected(&contacts[..=count]));
            }
        }
        let text = serde_json::to_string(&log).unwrap();
        assert_eq!(serde_json::from_str::<ImpactLog>(&text).unwrap(), log);
        let forces: Vec<f64> = log.into_hardest_first().iter().map(|c| c.event.peak_force).collect();
        assert!(forces.is_sorted_by(|a, b| a >= b));
    }
}
