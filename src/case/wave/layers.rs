//! Checks that the layers of the flume model carry waves of the period of the case.

use super::{Surroundings, Wave};
use crate::case::reading::check::{Checker, as_text};
use crate::waves::flume_model::{MAX_LAYERS, dispersion, record};
use crate::waves::theory::irregular::IrregularWave;
use crate::waves::theory::regular::RegularWave;

/// Error of wavelength or height above which the validation gives a warning [-].
const NOTICEABLE: f64 = 0.02;
/// Error above which the wave is refused [-]: the flume model does not carry it in any useful sense.
const LOST: f64 = 0.5;
/// Share of the energy of irregular waves that may lie outside of each end of the checked band of periods [-].
const OUTSIDE: f64 = 0.05;
/// Number of periods that are checked in the band.
const PERIODS: u32 = 16;

/// Checks regular and irregular waves of the flume model.
pub(super) fn validate(wave: &Wave, around: &Surroundings, check: &mut Checker) {
    let (Some(flume), Some(domain)) = (around.flume, around.domain) else { return };
    let periods = match wave {
        _ if !around.wavemaker.follows_flume_model() => return,
        Wave::Regular { wave, .. } => vec![wave.period_s],
        Wave::Irregular { sea, .. } => {
            let Ok(components) = IrregularWave::new(*sea) else { return };
            let [shortest, longest] = components.period_band_s(OUTSIDE);
            let step = (longest / shortest).powf(1.0 / f64::from(PERIODS - 1));
            (0..PERIODS).map(|i| shortest * step.powf(f64::from(i))).collect()
        }
        Wave::None | Wave::Solitary(_) | Wave::SolitaryInflow(_) | Wave::External(_) => return,
    };
    let deepest = flume.section().points().iter().map(|point| flume.still_water_level - point[1]).fold(0.0, f64::max);
    let places = Places { periods, deepest, at_wavemaker: flume.still_depth(domain.x[0]), gravity: around.gravity };
    let shortest = places.periods[0];
    let Some(length) = places.wavelength_error(flume.layers).filter(|error| error.abs() <= LOST) else {
        let least = (1..=MAX_LAYERS).find(|layers| places.wavelength_error(*layers).is_some_and(is_small));
        let advice = match least {
            Some(layers) => format!("write {layers} layers"),
            None => "write longer waves or a smaller depth".to_owned(),
        };
        let limit = dispersion::shortest_period_s(deepest, around.gravity, flume.layers);
        check.reject(
            "flume.layers",
            flume.layers.to_string(),
            format!(
                "enough for waves of {} s in {} m of water (with this number, waves shorter than {} s do not propagate)",
                as_text(shortest),
                as_text(deepest),
                as_text((1e2 * limit).round() / 1e2)
            ),
            &advice,
        );
        return;
    };
    warn(&places, length, flume.layers, check);
}

/// Periods [s] from the shortest, depths [m] and gravity [m/s2] for which the errors are computed.
struct Places {
    periods: Vec<f64>,
    deepest: f64,
    at_wavemaker: f64,
    gravity: f64,
}

impl Places {
    /// Returns the wavelength error of the largest magnitude in the deepest water [-]; `None` if a wave is lost.
    fn wavelength_error(&self, layers: usize) -> Option<f64> {
        let errors =
            self.periods.iter().map(|&period| dispersion::wavelength_error(period, self.deepest, self.gravity, layers));
        errors.collect::<Option<Vec<f64>>>().map(largest)
    }

    /// Returns the height error of the largest magnitude at the wavemaker of the particles [-].
    fn height_error(&self, layers: usize) -> f64 {
        let depth_m = self.at_wavemaker;
        let errors = self.periods.iter().map(|&period_s| {
            let wave = RegularWave { height_m: 0.0, period_s, depth_m, gravity: self.gravity };
            let kd = wave.wavenumber_per_m() * depth_m;
            let longer = dispersion::wavelength_error(period_s, depth_m, self.gravity, layers).unwrap_or(0.0);
            record::height_error(kd, kd / (1.0 + longer), layers)
        });
        largest(errors.collect())
    }
}

fn largest(errors: Vec<f64>) -> f64 {
    errors.into_iter().fold(0.0, |most: f64, error| if error.abs() > most.abs() { error } else { most })
}

fn is_small(error: f64) -> bool {
    error.abs() < NOTICEABLE
}

/// Warns of noticeable errors. Names the number of layers that makes both small, or at least the wavelength right.
fn warn(places: &Places, length: f64, layers: usize, check: &mut Checker) {
    let height = if places.at_wavemaker > 0.0 { places.height_error(layers) } else { 0.0 };
    if is_small(length) && is_small(height) {
        return;
    }
    let errors = |length: f64, height: f64| {
        let percent = |error: f64, [low, high]: [&str; 2]| match 100.0 * error {
            p if p.abs() < 0.1 => "exact".to_owned(),
            p => format!("{:.1} % too {}", p.abs(), if p < 0.0 { low } else { high }),
        };
        let (length, height) = (percent(length, ["short", "long"]), percent(height, ["low", "high"]));
        format!("wavelengths {length} in the flume model, and wave heights {height} at the wavemaker")
    };
    let of = |layers: usize| Some((places.wavelength_error(layers)?, places.height_error(layers)));
    let least = |is_enough: &dyn Fn(f64, f64) -> bool| {
        (1..=MAX_LAYERS).find(|&layers| of(layers).is_some_and(|(length, height)| is_enough(length, height)))
    };
    let both_small = least(&|length, height| is_small(length) && is_small(height));
    let better = both_small.or_else(|| least(&|length, _| is_small(length)).filter(|_| !is_small(length)));
    let advice = match better.and_then(|layers| Some((layers, of(layers)?))) {
        Some((better, (length, height))) => format!("{better} layers: {}", errors(length, height)),
        None => "no number of layers makes both errors small; correct the height of the wave".to_owned(),
    };
    let which = if places.periods.len() == 1 { "" } else { "for some of the waves, " };
    check.warn(format!("flume.layers = {layers}: {which}{}; {advice}", errors(length, height)));
}

#[cfg(test)]
mod tests {
    use crate::case::Case;

    fn read(layers: usize, depth: f64, wave: &str) -> Result<Vec<String>, String> {
        let text = format!(
            r#"{{
                "title": "layers",
                "flume": {{ "bed_m": [[0, 0], [25, 0]], "still_water_level_m": {depth}, "layers": {layers} }},
                "domain": {{ "x_m": [3, 8], "sides": "two_dimensional", "top_z_m": 3.0, "dp_m": 0.02 }},
                "wave": {wave}, "stop": {{ "duration_s": 10.0 }}
            }}"#
        );
        let case = Case::from_str(&text, "layers.json").map_err(|errors| errors.to_string())?;
        Ok(case.warnings.into_iter().filter(|warning| warning.starts_with("flume.layers")).collect())
    }

    const SHORT: &str = r#"{ "kind": "regular", "height_m": 0.1, "period_s": 1.0 }"#;

    #[test]
    fn lost_waves_are_refused_with_the_layers_needed() {
        let error = read(1, 2.0, SHORT).unwrap_err();
        assert_eq!(
            error,
            "layers.json: flume.layers = 1: must be enough for waves of 1 s in 2 m of water (with this number, waves \
             shorter than 1.42 s do not propagate); write 3 layers"
        );
        let sea = r#"{ "kind": "irregular", "significant_height_m": 0.1, "peak_period_s": 1.5 }"#;
        assert!(read(1, 2.0, sea).unwrap_err().contains("flume.layers = 1"));
        assert!(read(2, 2.0, sea).is_ok());
    }

    #[test]
    fn noticeable_errors_give_a_warning_with_the_layers_needed() {
        let two = read(2, 2.0, SHORT).unwrap();
        assert!(two[0].starts_with("flume.layers = 2: wavelengths 2.9 % too short in the flume model, and"), "{two:?}");
        assert!(two[0].contains("wave heights 2.7 % too low at the wavemaker; 3 layers: wavelengths exact"), "{two:?}");
        let five = read(5, 2.0, SHORT).unwrap();
        assert!(five[0].ends_with("no number of layers makes both errors small; correct the height of the wave"));
        let longer = r#"{ "kind": "regular", "height_m": 0.1, "period_s": 1.7 }"#;
        let two = read(2, 2.0, longer).unwrap();
        assert!(two[0].contains("; 4 layers: wavelengths 0."), "{two:?}");
        assert_eq!(read(4, 2.0, longer).unwrap(), Vec::<String>::new());
        let long = r#"{ "kind": "regular", "height_m": 0.1, "period_s": 4.0 }"#;
        assert_eq!(read(2, 2.0, long).unwrap(), Vec::<String>::new());
    }

    #[test]
    fn irregular_waves_are_checked_over_their_band() {
        let sea = |period: f64| {
            format!(r#"{{ "kind": "irregular", "significant_height_m": 0.1, "peak_period_s": {period} }}"#)
        };
        // The peak alone has small errors (T = 2.4 s, k d = 1.6), but the short waves of the spectrum have not.
        let warning = read(2, 2.0, &sea(2.4)).unwrap();
        assert!(warning[0].contains("for some of the waves, wave"), "{warning:?}");
        assert_eq!(read(2, 2.0, &sea(6.0)).unwrap(), Vec::<String>::new());
    }
}
