//! Values of the varied keys and their combinations.

use std::collections::HashSet;

use serde_json::{Value, json};

use super::{key::short, random::RandomValues};
use crate::case::file::{Combine, RandomFile, SweepFile, VaryFile};

/// Largest number of runs in one sweep.
pub(super) const MOST_RUNS: usize = 10_000;

/// A varied key of the case and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// Path of the key, as in `friction[1].coefficient`.
    pub key: String,
    /// Values of the key; if they are random, one for each repetition.
    pub values: Vec<Value>,
    /// True if the values are random.
    pub is_random: bool,
}

impl Varied {
    /// Returns the last part of the key with a value, as in `height_m=0.045`.
    pub(super) fn with(&self, value: &Value) -> String {
        format!("{}={}", short(&self.key), in_words(value))
    }
}

impl VaryFile {
    /// Returns the listed or equally spaced values of entry `number` (from 0) of `vary`.
    pub(super) fn values(&self, number: usize) -> Result<Varied, String> {
        let path = format!("vary[{number}] ({})", self.key);
        let values = match (&self.values, self.from, self.to, self.count) {
            (Some(values), None, None, None) if !values.is_empty() => values.clone(),
            (None, Some(from), Some(to), Some(count)) if (2..=MOST_RUNS).contains(&count) => {
                let step = (to - from) / (count - 1) as f64;
                // Round to twelve decimals, so that 0.1 + 2 * 0.11 is written as 0.32.
                let value = |k: usize| (1e12 * (from + k as f64 * step)).round() / 1e12;
                (0..count).map(|k| json!(value(k))).collect()
            }
            _ => {
                return Err(format!(
                    "{path}: must have either `values` (a list), or `from`, `to` and `count` (at least 2), or `random`"
                ));
            }
        };
        let mut seen = HashSet::new();
        match values.iter().find(|value| !seen.insert(value.to_string())) {
            Some(value) => Err(format!("{path}: {} is listed twice; write each value once", in_words(value))),
            None => Ok(Varied { key: self.key.clone(), values, is_random: false }),
        }
    }

    /// Draws one random value for each repetition.
    pub(super) fn draws(
        &self,
        number: usize,
        distribution: RandomFile,
        random: &mut RandomValues,
        repetitions: usize,
    ) -> Result<Varied, String> {
        let path = format!("vary[{number}] ({})", self.key);
        if self.values.is_some() || self.from.is_some() || self.to.is_some() || self.count.is_some() {
            return Err(format!("{path}: must have only `random` or only other values"));
        }
        let values = (0..repetitions).map(|_| random.draw(distribution)).collect::<Result<_, _>>();
        let values = values.map_err(|what| format!("{path}: random: {what}"))?;
        Ok(Varied { key: self.key.clone(), values, is_random: true })
    }
}

/// Returns the number of runs of each combination.
pub(super) fn repetitions(file: &SweepFile) -> Result<usize, String> {
    let is_random = file.vary.iter().any(|vary| vary.random.is_some());
    match file.repetitions {
        None if !is_random => Ok(1),
        Some(count) if is_random && (2..=MOST_RUNS).contains(&count) => Ok(count),
        None => Err(format!("repetitions: (missing): must be 2 to {MOST_RUNS} with `random` values")),
        Some(count) if is_random => Err(format!("repetitions = {count}: must be 2 to {MOST_RUNS}")),
        Some(_) => {
            Err("repetitions: must be left out without `random` values: equal runs give equal results".to_owned())
        }
    }
}

impl Combine {
    /// Returns the number of combinations; `None` on overflow.
    pub(super) fn combinations(self, varied: &[Varied]) -> Option<usize> {
        let mut values = varied.iter().filter(|one| !one.is_random).map(|one| one.values.len());
        match self {
            Self::All => values.try_fold(1, usize::checked_mul),
            Self::OneAtATime => values.try_fold(1, usize::checked_add),
        }
    }

    /// Returns the value of each varied key in a repetition of a combination, both counted from 0; `None` for keys that
    /// keep the value of the base case.
    pub(super) fn changes(self, varied: &[Varied], combination: usize, repetition: usize) -> Vec<Option<Value>> {
        let random = |one: &Varied| one.is_random.then(|| one.values[repetition].clone());
        let mut changes: Vec<Option<Value>> = varied.iter().map(random).collect();
        let regular = || varied.iter().enumerate().filter(|(_, one)| !one.is_random);
        match self {
            // The last key varies fastest.
            Self::All => {
                let mut number = combination;
                for (key, one) in regular().collect::<Vec<_>>().into_iter().rev() {
                    changes[key] = Some(one.values[number % one.values.len()].clone());
                    number /= one.values.len();
                }
            }
            Self::OneAtATime => {
                let mut alone = regular().flat_map(|(key, one)| one.values.iter().map(move |value| (key, value)));
                if let Some((key, value)) = combination.checked_sub(1).and_then(|before| alone.nth(before)) {
                    changes[key] = Some(value.clone());
                }
            }
        }
        changes
    }
}

/// Returns the keys that a run changes, with their values, as in `coefficient=0.32 height_m=0.045`.
pub(super) fn label(varied: &[Varied], changes: &[Option<Value>]) -> String {
    let one = |(one, value): (&Varied, &Option<Value>)| Some(one.with(value.as_ref()?));
    let words: Vec<String> = varied.iter().zip(changes).filter_map(one).collect();
    if words.is_empty() { "as_given".to_owned() } else { words.join(" ") }
}

/// Returns a value as text without quotes; empty for null.
pub fn in_words(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_include_both_ends_and_have_short_decimals() {
        let vary = VaryFile {
            key: "a.b".to_owned(),
            values: None,
            from: Some(0.1),
            to: Some(0.98),
            count: Some(9),
            random: None,
        };
        let values: Vec<f64> = vary.values(0).unwrap().values.iter().map(|v| v.as_f64().unwrap()).collect();
        assert_eq!(values, [0.1, 0.21, 0.32, 0.43, 0.54, 0.65, 0.76, 0.87, 0.98]);
        let both = VaryFile { values: Some(vec![json!(1)]), ..vary.clone() };
        assert!(both.values(3).unwrap_err().contains("vary[3] (a.b)"));
        let list = |values: Value| VaryFile {
            values: values.as_array().cloned(),
            from: None,
            to: None,
            count: None,
            ..vary.clone()
        };
        assert!(list(json!([0.3, 0.4, "x", [1, 2]])).values(0).is_ok());
        for twice in [json!([0.3, 0.4, 0.3]), json!(["a", "a"]), json!([null, 1, null])] {
            assert!(list(twice).values(0).unwrap_err().ends_with(" is listed twice; write each value once"));
        }
    }

    #[test]
    fn the_last_key_varies_fastest() {
        let one = |key: &str, values: &[f64]| Varied {
            key: key.to_owned(),
            values: values.iter().map(|v| json!(v)).collect(),
            is_random: false,
        };
        let mut varied = vec![one("x.a", &[1.0, 2.0]), one("b", &[3.0, 4.0, 5.0])];
        let labels = |combine: Combine, varied: &[Varied], repetition: usize| -> Vec<String> {
            let runs = combine.combinations(varied).unwrap();
            (0..runs).map(|k| label(varied, &combine.changes(varied, k, repetition))).collect()
        };
        let all = ["a=1.0 b=3.0", "a=1.0 b=4.0", "a=1.0 b=5.0", "a=2.0 b=3.0", "a=2.0 b=4.0", "a=2.0 b=5.0"];
        assert_eq!(labels(Combine::All, &varied, 0), all);
        let alone = ["as_given", "a=1.0", "a=2.0", "b=3.0", "b=4.0", "b=5.0"];
        assert_eq!(labels(Combine::OneAtATime, &varied, 0), alone);
        varied.insert(1, Varied { is_random: true, ..one("c", &[6.0, 7.0]) });
        assert_eq!(labels(Combine::All, &varied, 1), all.map(|run| run.replace(" b", " c=7.0 b")));
        assert_eq!(labels(Combine::OneAtATime, &varied, 0)[..3], ["c=6.0", "a=1.0 c=6.0", "a=2.0 c=6.0"]);
    }
}
