//! The impacts of each unit that a fracture computation may want to take over: the hardest and the fastest.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::event::ContactEvent;
use super::history::ForceHistory;

/// Impacts kept for a unit because of their peak force.
pub const HARDEST: usize = 12;

/// Impacts kept for a unit besides those because of their energy of approach.
pub const MOST_ENERGETIC: usize = 4;

/// A contact with the history of its force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecordedContact {
    /// The contact.
    pub event: ContactEvent,
    /// Force on `event.body`.
    pub history: ForceHistory,
}

/// Rank of an impact: more of `value` [N or J] goes first, and of two alike the earlier one.
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

/// The impacts of one unit, the first in rank first.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
struct OfUnit {
    by_force: Vec<Rank>,
    by_energy: Vec<Rank>,
}

/// The hardest impacts of each unit so far, with their histories.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ImpactLog {
    impacts: BTreeMap<u64, RecordedContact>,
    units: Vec<OfUnit>,
}

/// Puts `new` where it belongs if there is room or something of lower rank, which is returned.
fn rank_in(list: &mut Vec<Rank>, room: usize, new: Rank) -> Option<Rank> {
    let place = list.iter().position(|old| new.is_before(old)).unwrap_or(list.len());
    list.insert(place, new);
    if list.len() > room { list.pop() } else { None }
}

fn has_room(list: &[Rank], room: usize, new: Rank) -> bool {
    list.len() < room || list.last().is_some_and(|last| new.is_before(last))
}

/// Units that take part in a contact.
fn units_of(event: &ContactEvent) -> impl Iterator<Item = usize> + use<> {
    let partner = event.partner_unit().filter(|partner| *partner != event.body);
    [Some(event.body), partner].into_iter().flatten().map(|unit| unit as usize)
}

fn ranks(event: &ContactEvent) -> [Rank; 2] {
    [event.peak_force, event.approach_energy].map(|value| Rank { value, number: event.number })
}

impl ImpactLog {
    /// The impacts kept, in the order in which they began.
    pub fn impacts(&self) -> impl Iterator<Item = &RecordedContact> {
        self.impacts.values()
    }

    /// Whether a contact is kept.
    pub fn has(&self, number: u64) -> bool {
        self.impacts.contains_key(&number)
    }

    /// The impacts kept, the hardest first.
    pub fn into_hardest_first(self) -> Vec<RecordedContact> {
        let mut impacts: Vec<RecordedContact> = self.impacts.into_values().collect();
        // The sort is stable: of two alike the earlier one goes first.
        impacts.sort_by(|a, b| b.event.peak_force.total_cmp(&a.event.peak_force));
        impacts
    }

    /// Whether an impact would be kept as it is now.
    pub fn would_keep(&self, event: &ContactEvent) -> bool {
        let [force, energy] = ranks(event);
        let of = |unit: usize| {
            self.units.get(unit).is_none_or(|unit| {
                has_room(&unit.by_force, HARDEST, force) || has_room(&unit.by_energy, MOST_ENERGETIC, energy)
            })
        };
        event.peak_force > 0.0 && units_of(event).any(of)
    }

    /// Takes in a contact that has ended, if it is among the hardest of one of its units.
    pub fn take(&mut self, mut contact: RecordedContact) {
        if !self.would_keep(&contact.event) {
            return;
        }
        contact.history.shorten();
        let event = contact.event;
        self.impacts.insert(event.number, contact);
        let out: Vec<u64> = units_of(&event).filter_map(|unit| self.rank(unit, &event)).collect();
        out.into_iter().for_each(|number| self.let_go(number));
    }

    /// Ranks an impact among those of a unit; the number of the one that has to leave its list.
    fn rank(&mut self, unit: usize, event: &ContactEvent) -> Option<u64> {
        if self.units.len() <= unit {
            self.units.resize_with(unit + 1, OfUnit::default);
        }
        let [force, _] = ranks(event);
        let lists = &mut self.units[unit];
        // What is no longer among the hardest may still be among the most energetic.
        let weaker = rank_in(&mut lists.by_force, HARDEST, force)?;
        let [_, energy] = ranks(&self.impacts[&weaker.number].event);
        rank_in(&mut lists.by_energy, MOST_ENERGETIC, energy).map(|out| out.number)
    }

    /// Drops an impact that no unit ranks any more.
    fn let_go(&mut self, number: u64) {
        let ranked = |unit: usize| {
            let OfUnit { by_force, by_energy } = &self.units[unit];
            by_force.iter().chain(by_energy).any(|rank| rank.number == number)
        };
        let no_longer = self.impacts.get(&number).is_some_and(|impact| !units_of(&impact.event).any(ranked));
        if no_longer {
            self.impacts.remove(&number);
        }
    }
}
