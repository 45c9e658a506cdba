//! One run of the flume model, from a [`FlumeSetup`] to a [`FlumeRecord`].

use thiserror::Error;

use crate::geometry::profile::Profile;
use crate::waves::flume_model::incoming::IncomingWave;
use crate::waves::flume_model::layered::{
    Breaking, Friction, LayeredFlume, LayeredParameters, LeftEnd, Pressure, RightEnd,
};
use crate::waves::flume_model::record::{FlumeRecord, SurfaceProfile};
use crate::waves::theory::regular::WaveError;
use crate::waves::theory::solitary::SolitaryWave;

/// Largest number of layers; two or three layers resolve the velocity profile of long waves over the depth.
pub const MAX_LAYERS: usize = 8;
/// Courant number of a long wave in the largest depth [-]. The scheme is stable up to the Courant number 1. Up to about
/// 0.4, the errors of the time step are smaller than the errors of the grid.
const COURANT: f64 = 0.4;
/// Length over which the cells follow the piston, in strokes. At this length, no cell is compressed by more than 10 %.
const MAPPED_STROKES: f64 = 10.0;
/// Largest relative compression of the cells in front of the piston [-].
const MAX_COMPRESSION: f64 = 0.5;

/// Parameters of a flume run: flume, wave, grid and records.
#[derive(Debug, Clone, PartialEq)]
pub struct FlumeSetup {
    /// Bed, from the piston at rest or the inflow (first point) to the right end (last point), including the mound.
    pub profile: Profile,
    /// Still water level z [m].
    pub still_level_m: f64,
    /// Gravitational acceleration [m/s2].
    pub gravity_m_s2: f64,
    /// The incoming wave and how it is generated.
    pub wave: WaveSource,
    /// Right end of the flume.
    pub right_end: RightEnd,
    /// Pressure model.
    pub pressure: Pressure,
    /// Bed friction.
    pub friction: Friction,
    /// Wave breaking.
    pub breaking: Breaking,
    /// Number of layers, from 1 to [`MAX_LAYERS`].
    pub layers: usize,
    /// Cell width [m].
    pub cell_m: f64,
    /// Positions x of the wave gauges [m].
    pub gauges_x_m: Vec<f64>,
    /// Times of surface profiles along the whole flume [s]; the first time step that reaches a time records the
    /// profile.
    pub profile_times_s: Vec<f64>,
    /// Range of x in which the flow is recorded [m], limited to the flume.
    pub window_x_m: [f64; 2],
    /// Time between records [s].
    pub record_interval_s: f64,
    /// End of the run [s].
    pub end_s: f64,
}

/// Wave generation at the left end. The depth of the wave must equal the still water depth there.
#[derive(Debug, Clone, PartialEq)]
pub enum WaveSource {
    /// A piston that generates a solitary wave; its stroke starts at t = 0.
    Piston(SolitaryWave),
    /// An inflow boundary through which the wave enters.
    Inflow(IncomingWave),
}

impl WaveSource {
    /// Still water depth of the wave [m].
    fn depth_m(&self) -> f64 {
        match self {
            Self::Piston(wave) => wave.depth_m,
            Self::Inflow(wave) => wave.depth_m(),
        }
    }

    /// Height of the wave [m].
    fn height_m(&self) -> f64 {
        match self {
            Self::Piston(wave) => wave.height_m,
            Self::Inflow(wave) => wave.height_m(),
        }
    }

    /// Stroke of the piston [m]; 0 for an inflow.
    fn stroke_m(&self) -> f64 {
        match self {
            Self::Piston(wave) => wave.stroke_m(),
            Self::Inflow(_) => 0.0,
        }
    }
}

/// Errors of a flume run.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FlumeError {
    /// A value is outside its range.
    #[error("flume: {name} is {value}, it must be {allowed}")]
    Value {
        /// Name of the value.
        name: &'static str,
        /// The value.
        value: f64,
        /// Allowed range.
        allowed: String,
    },
    /// The wave cannot be generated.
    #[error(transparent)]
    Wave(#[from] WaveError),
    /// The run became unstable.
    #[error("flume: the run became unstable at t = {time_s:.3} s, x = {x_m:.3} m; try smaller cells or fewer layers")]
    Unstable {
        /// Time [s].
        time_s: f64,
        /// Position [m].
        x_m: f64,
    },
}

/// Runs the flume model from still water to `end_s`.
pub fn run(setup: &FlumeSetup) -> Result<FlumeRecord, FlumeError> {
    check(setup)?;
    let mapped_m = mapped_length_m(setup)?;
    let steps_per_record = steps_per_record(setup, mapped_m);
    let step_s = setup.record_interval_s / steps_per_record as f64;
    let mut flume = LayeredFlume::new(parameters(setup, mapped_m, step_s));
    let mut record = empty_record(setup, flume.volume_m2());
    let records = (setup.end_s / setup.record_interval_s).ceil() as usize;
    let mut profile_times = setup.profile_times_s.clone();
    profile_times.sort_by(f64::total_cmp);
    let mut profile_times = profile_times.into_iter().peekable();
    for step in 0..=records * steps_per_record {
        while profile_times.next_if(|&time| time <= flume.time_s() + 1e-9 * step_s).is_some() {
            record.profiles.push(SurfaceProfile { time_s: flume.time_s(), points: flume.surface_profile() });
        }
        flume.advance_velocities();
        if step % steps_per_record == 0 {
            add_record(&flume, &mut record);
        }
        flume.advance_depths();
        if let Some(x_m) = flume.first_unstable_x_m() {
            return Err(FlumeError::Unstable { time_s: flume.time_s(), x_m });
        }
    }
    Ok(record)
}

fn parameters(setup: &FlumeSetup, mapped_m: f64, step_s: f64) -> LayeredParameters {
    LayeredParameters {
        profile: setup.profile.clone(),
        still_level_m: setup.still_level_m,
        gravity_m_s2: setup.gravity_m_s2,
        layers: setup.layers,
        cell_m: setup.cell_m,
        step_s,
        left_end: match &setup.wave {
            WaveSource::Piston(wave) => LeftEnd::Piston { wave: *wave, mapped_m },
            WaveSource::Inflow(wave) => LeftEnd::Inflow(wave.clone()),
        },
        right_end: setup.right_end,
        pressure: setup.pressure,
        friction: setup.friction,
        breaking: setup.breaking,
    }
}

/// Returns an error for the first value outside its range.
fn check(setup: &FlumeSetup) -> Result<(), FlumeError> {
    let points = setup.profile.points();
    let length = points[points.len() - 1][0] - points[0][0];
    let depth = setup.still_level_m - points[0][1];
    let require = |name, value: f64, fits: bool, allowed: &str| {
        if fits { Ok(()) } else { Err(FlumeError::Value { name, value, allowed: allowed.to_owned() }) }
    };
    let positive = |name, value: f64| require(name, value, value.is_finite() && value > 0.0, "above 0");
    positive("gravity_m_s2", setup.gravity_m_s2)?;
    positive("record_interval_s", setup.record_interval_s)?;
    positive("end_s", setup.end_s)?;
    positive("cell_m", setup.cell_m)?;
    let widest = length / 10.0;
    require("cell_m", setup.cell_m, setup.cell_m <= widest, &format!("at most {widest} (a tenth of the flume)"))?;
    let allowed = format!("from 1 to {MAX_LAYERS}");
    require("layers", setup.layers as f64, (1..=MAX_LAYERS).contains(&setup.layers), &allowed)?;
    positive("still_level_m above the bed at the wavemaker", depth)?;
    let height = setup.wave.height_m();
    positive("the wave's height_m", height)?;
    let highest = 0.7 * depth;
    let allowed = format!("at most {highest} (0.7 of the depth); higher solitary waves break");
    require("the wave's height_m", height, height <= highest, &allowed)?;
    // A difference of 1 mm is allowed: the still water level of a laboratory flume is not known more accurately.
    let is_same = (setup.wave.depth_m() - depth).abs() <= 1e-3;
    require("the wave's depth_m", setup.wave.depth_m(), is_same, &format!("{depth}, the depth at the wavemaker"))?;
    check_right_end_and_friction(setup, length)?;
    let [from, to] = setup.window_x_m;
    require("window_x_m[0]", from, from.is_finite() && from < to, &format!("below window_x_m[1], {to}"))?;
    let end = points[points.len() - 1][0];
    require("window_x_m[0]", from, from < end, &format!("below {end}, the end of the flume"))?;
    let start = points[0][0];
    require("window_x_m[1]", to, to > start, &format!("above {start}, the start of the flume"))?;
    setup.gauges_x_m.iter().try_for_each(|&x| {
        require("a gauge's x", x, (start..=end).contains(&x), &format!("inside the flume, from {start} to {end}"))
    })
}

/// Returns an error for an invalid right end or friction.
fn check_right_end_and_friction(setup: &FlumeSetup, length: f64) -> Result<(), FlumeError> {
    let refuse = |name, value, allowed| Err(FlumeError::Value { name, value, allowed });
    let points = setup.profile.points();
    let depth_at_end = setup.still_level_m - points[points.len() - 1][1];
    match setup.right_end {
        RightEnd::Radiating if depth_at_end <= 2.0 * setup.wave.height_m() => {
            let allowed = "more than two wave heights; otherwise use a wall or a sponge".to_owned();
            return refuse("the depth at a radiating end", depth_at_end, allowed);
        }
        RightEnd::Sponge { length_m } if !(length_m > 0.0 && length_m < length) => {
            let allowed = format!("above 0 and below {length}, the length of the flume");
            return refuse("the sponge's length_m", length_m, allowed);
        }
        _ => {}
    }
    match setup.friction {
        Friction::Manning { n_s_m13 } if !(0.0..=0.2).contains(&n_s_m13) => {
            refuse("manning_s_m13", n_s_m13, "from 0 to 0.2".to_owned())
        }
        _ => Ok(()),
    }
}

/// Length over which the cells follow the piston [m]: ten strokes, or less if the level bed or the flume is shorter.
fn mapped_length_m(setup: &FlumeSetup) -> Result<f64, FlumeError> {
    let points = setup.profile.points();
    let level = points.windows(2).take_while(|w| w[0][1] == w[1][1]).last().map_or(0.0, |w| w[1][0] - points[0][0]);
    let length = points[points.len() - 1][0] - points[0][0];
    let stroke = setup.wave.stroke_m();
    let wanted = (MAPPED_STROKES * stroke).max(10.0 * setup.cell_m).min(0.5 * length);
    let mapped = if level >= 0.4 * wanted { wanted.min(level) } else { wanted };
    if stroke > MAX_COMPRESSION * mapped {
        let allowed = format!("at most {} in a flume of this length", MAX_COMPRESSION * mapped);
        return Err(FlumeError::Value { name: "the piston's stroke", value: stroke, allowed });
    }
    Ok(mapped)
}

/// Number of time steps between two records, from the Courant number.
fn steps_per_record(setup: &FlumeSetup, mapped_m: f64) -> usize {
    let lowest = setup.profile.points().iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let depth = setup.still_level_m - lowest + 2.0 * setup.wave.height_m();
    let narrowest = setup.cell_m * (1.0 - setup.wave.stroke_m() / mapped_m);
    let step = COURANT * narrowest / (setup.gravity_m_s2 * depth).sqrt();
    (setup.record_interval_s / step).ceil().max(1.0) as usize
}

/// Creates an empty record. Its window is limited to the flume and has about one point per cell.
fn empty_record(setup: &FlumeSetup, volume_m2: f64) -> FlumeRecord {
    let points = setup.profile.points();
    let from = setup.window_x_m[0].max(points[0][0]);
    let to = setup.window_x_m[1].min(points[points.len() - 1][0]);
    let intervals = ((to - from) / setup.cell_m).ceil().max(1.0) as usize;
    let window = (0..=intervals).map(|i| from + (to - from) * i as f64 / intervals as f64).collect();
    let mut record = FlumeRecord::new(
        setup.profile.clone(),
        setup.still_level_m,
        setup.layers,
        setup.record_interval_s,
        setup.gauges_x_m.clone(),
        window,
    );
    record.volume_m2 = volume_m2;
    record
}

/// Adds the current state to the record.
fn add_record(flume: &LayeredFlume, record: &mut FlumeRecord) {
    let levels: Vec<f64> = record.gauges_x_m.iter().map(|&x| flume.surface_m(x)).collect();
    let window = record.window_x_m.clone();
    record.push(flume.paddle_m(), &levels, window.iter().map(|&x| flume.column(x)));
    record.shore_level_m.push(flume.shore_level_m());
    let error_m2 = flume.volume_m2() - flume.entered_m2() - record.volume_m2;
    record.volume_error = record.volume_error.max((error_m2 / record.volume_m2).abs());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::theory::solitary::PistonTheory;

    fn piston(height_m: f64, depth_m: f64) -> WaveSource {
        WaveSource::Piston(SolitaryWave { height_m, depth_m, gravity: 9.81, theory: PistonTheory::Rayleigh })
    }

    /// A level flume, 24 m long, with an end wall.
    fn setup() -> FlumeSetup {
        FlumeSetup {
            profile: Profile::new(vec![[0.0, 0.0], [24.0, 0.0]]),
            still_level_m: 0.5,
            gravity_m_s2: 9.81,
            wave: piston(0.04, 0.5),
            right_end: RightEnd::Wall,
            pressure: Pressure::NonHydrostatic,
            friction: Friction::None,
            breaking: Breaking::default(),
            layers: 2,
            cell_m: 0.1,
            gauges_x_m: vec![12.0, 24.0],
            profile_times_s: Vec::new(),
            window_x_m: [20.0, 30.0],
            record_interval_s: 0.05,
            end_s: 23.0,
        }
    }

    #[test]
    fn solitary_wave_doubles_at_the_end_wall_and_reflects() {
        let record = run(&setup()).unwrap();
        // The second-order run-up of a solitary wave on a wall is 2 H + H^2 / (2 d) = 2.04 H. The height of the
        // generated wave is within 1 % of H.
        assert!((record.crest(1).0 / 0.04 - 2.04).abs() < 0.03, "{}", record.crest(1).0 / 0.04);
        assert!(record.volume_error < 1e-12);
        let back = (record.crest(1).1 / 0.05) as usize;
        let reflected = record.gauge_elevations_m[0][back..].iter().copied().fold(0.0, f64::max);
        // The wave loses less than 1 % of its height by the reflection, and less than 1 % over 24 m at this cell width.
        assert!((reflected / record.crest(0).0 - 1.0).abs() < 0.02, "{}", reflected / record.crest(0).0);
        assert_eq!(*record.window_x_m.last().unwrap(), 24.0);
    }

    #[test]
    fn piston_completes_its_stroke() {
        let record = run(&FlumeSetup { end_s: 8.0, ..setup() }).unwrap();
        let stroke = record.paddle_m.last().unwrap();
        // The motion stops at the phase where 1 - tanh = 1e-3, so the stroke is 0.1 % shorter than in theory.
        assert!((stroke / setup().wave.stroke_m() - 1.0).abs() < 2e-3);
    }

    #[test]
    fn invalid_setups_are_rejected_with_a_reason() {
        let message = |change: fn(&mut FlumeSetup)| {
            let mut setup = setup();
            change(&mut setup);
            run(&setup).unwrap_err().to_string()
        };
        assert_eq!(message(|s| s.layers = 9), "flume: layers is 9, it must be from 1 to 8");
        assert_eq!(message(|s| s.cell_m = -0.1), "flume: cell_m is -0.1, it must be above 0");
        assert_eq!(message(|s| s.end_s = f64::NAN), "flume: end_s is NaN, it must be above 0");
        assert!(message(|s| s.gauges_x_m = vec![25.0]).contains("inside the flume, from 0 to 24"));
        assert!(message(|s| s.window_x_m = [40.0, 50.0]).contains("below 24, the end of the flume"));
        assert!(message(|s| s.wave = piston(0.04, 0.8)).contains("0.5, the depth at the wavemaker"));
        assert!(message(|s| s.wave = piston(0.4, 0.5)).contains("higher solitary waves break"));
        assert!(message(|s| s.still_level_m = -1.0).contains("above the bed at the wavemaker"));
        assert!(message(|s| s.friction = Friction::Manning { n_s_m13: -0.1 }).contains("from 0 to 0.2"));
        assert!(message(|s| s.right_end = RightEnd::Sponge { length_m: 30.0 }).contains("below 24, the length"));
        let dry_end = |s: &mut FlumeSetup| {
            s.profile = Profile::new(vec![[0.0, 0.0], [20.0, 0.0], [24.0, 0.5]]);
            s.right_end = RightEnd::Radiating;
        };
        assert!(message(dry_end).contains("more than two wave heights"));
        let short = |s: &mut FlumeSetup| {
            s.profile = Profile::new(vec![[0.0, 0.0], [1.0, 0.0]]);
            s.gauges_x_m.clear();
            s.window_x_m = [0.0, 1.0];
        };
        assert!(message(short).contains("the piston's stroke"));
    }
}
