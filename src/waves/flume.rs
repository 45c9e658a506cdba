//! One run of the layered model: a flume, a wave, what stops it; what comes out is a [`FlumeRecord`].

use thiserror::Error;

use crate::geometry::profile::Profile;
use crate::waves::incoming::IncomingWave;
use crate::waves::layered::{Breaking, Friction, LayeredFlume, LayeredParameters, LeftEnd, Pressure, RightEnd};
use crate::waves::record::{FlumeRecord, SurfaceProfile};
use crate::waves::regular::WaveError;
use crate::waves::solitary::SolitaryWave;

/// Most layers the model takes: the vertical profile of these long waves is resolved by two or three.
pub const MOST_LAYERS: usize = 8;
/// Courant number of a long wave on the largest depth [-]: the scheme is stable to 1, and its errors in time stay below
/// those in space up to about 0.4.
const COURANT: f64 = 0.4;
/// Cells follow the piston over this many strokes, so that none is squeezed by more than a tenth.
const MAPPED_STROKES: f64 = 10.0;
/// The piston may squeeze the cells in front of it by at most this share.
const MOST_SQUEEZE: f64 = 0.5;

/// A flume with a wave, and what to record.
#[derive(Debug, Clone, PartialEq)]
pub struct FlumeSetup {
    /// Bed, from the piston at rest (first point) to the end wall (last point); the mound is part of it.
    pub profile: Profile,
    /// Still-water level z [m].
    pub still_level_m: f64,
    /// Gravity [m/s2].
    pub gravity_m_s2: f64,
    /// The wave and what makes it.
    pub wave: WaveSource,
    /// What stands at the right end.
    pub right_end: RightEnd,
    /// Vertical accelerations.
    pub pressure: Pressure,
    /// Friction on the bed.
    pub friction: Friction,
    /// Breaking of waves.
    pub breaking: Breaking,
    /// Number of layers, 1..=8.
    pub layers: usize,
    /// Width of a cell [m].
    pub cell_m: f64,
    /// Places of wave gauges [m].
    pub gauges_x_m: Vec<f64>,
    /// Times at which the surface along the whole flume is recorded [s], each at the end of the step that passes it.
    pub profile_times_s: Vec<f64>,
    /// Window [m] in which the whole flow is recorded; cut to the flume.
    pub window_x_m: [f64; 2],
    /// Time between records [s].
    pub record_interval_s: f64,
    /// End of the run [s].
    pub end_s: f64,
}

/// The wave and what makes it at the left end, its depth that at this end.
#[derive(Debug, Clone, PartialEq)]
pub enum WaveSource {
    /// A piston that makes a solitary wave; its stroke starts at t = 0.
    Piston(SolitaryWave),
    /// Water that flows in and out with the wave.
    Inflow(IncomingWave),
}

impl WaveSource {
    /// Depth for which the wave is made [m].
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

    /// Way of the piston [m].
    fn stroke_m(&self) -> f64 {
        match self {
            Self::Piston(wave) => wave.stroke_m(),
            Self::Inflow(_) => 0.0,
        }
    }
}

/// What can go wrong with a flume.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FlumeError {
    /// A value outside its range.
    #[error("flume: {name} is {value}, it must be {allowed}")]
    Value {
        /// Which value.
        name: &'static str,
        /// The value.
        value: f64,
        /// What would be allowed.
        allowed: String,
    },
    /// A wave that cannot be made.
    #[error(transparent)]
    Wave(#[from] WaveError),
    /// The computation went astray.
    #[error("flume: unstable at t = {time_s:.3} s, x = {x_m:.3} m; try a smaller cell or fewer layers")]
    Unstable {
        /// Time [s].
        time_s: f64,
        /// Place [m].
        x_m: f64,
    },
}

/// Compute the flume from rest to `end_s`.
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
            take_record(&flume, &mut record);
        }
        flume.advance_depths();
        if let Some(x_m) = flume.astray_at() {
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

/// Refuse what cannot be computed.
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
    require("cell_m", setup.cell_m, setup.cell_m <= widest, &format!("at most a tenth of the flume, {widest}"))?;
    let allowed = format!("from 1 to {MOST_LAYERS}");
    require("layers", setup.layers as f64, (1..=MOST_LAYERS).contains(&setup.layers), &allowed)?;
    positive("still_level_m above the bed at the wavemaker", depth)?;
    let height = setup.wave.height_m();
    positive("the wave's height_m", height)?;
    let highest = 0.7 * depth;
    let allowed = format!("at most 0.7 of the depth, {highest}, where solitary waves break");
    require("the wave's height_m", height, height <= highest, &allowed)?;
    // The wave's law holds for the depth it is made in; a millimetre is within what a flume is filled to.
    let same = (setup.wave.depth_m() - depth).abs() <= 1e-3;
    require("the wave's depth_m", setup.wave.depth_m(), same, &format!("the depth at the wavemaker, {depth}"))?;
    check_what_stops_the_wave(setup, length)?;
    let [from, to] = setup.window_x_m;
    require("window_x_m[0]", from, from.is_finite() && from < to, &format!("below window_x_m[1], {to}"))?;
    let end = points[points.len() - 1][0];
    require("window_x_m[0]", from, from < end, &format!("below the flume's end, {end}"))?;
    let start = points[0][0];
    require("window_x_m[1]", to, to > start, &format!("above the flume's start, {start}"))?;
    setup.gauges_x_m.iter().try_for_each(|&x| {
        require("a gauge's x", x, (start..=end).contains(&x), &format!("inside the flume, {start} to {end}"))
    })
}

/// Refuse ends and friction that cannot be.
fn check_what_stops_the_wave(setup: &FlumeSetup, length: f64) -> Result<(), FlumeError> {
    let refuse = |name, value, allowed| Err(FlumeError::Value { name, value, allowed });
    let points = setup.profile.points();
    let depth_at_end = setup.still_level_m - points[points.len() - 1][1];
    match setup.right_end {
        RightEnd::Radiating if depth_at_end <= 2.0 * setup.wave.height_m() => {
            let allowed = "more than two wave heights, where waves can leave; else take a wall or a sponge".to_owned();
            return refuse("the depth at a radiating end", depth_at_end, allowed);
        }
        RightEnd::Sponge { length_m } if !(length_m > 0.0 && length_m < length) => {
            let allowed = format!("above 0 and shorter than the flume, {length}");
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

/// Length over which the cells follow the piston [m]: ten strokes, less if the bed is level or the flume short of it.
fn mapped_length_m(setup: &FlumeSetup) -> Result<f64, FlumeError> {
    let points = setup.profile.points();
    let level = points.windows(2).take_while(|w| w[0][1] == w[1][1]).last().map_or(0.0, |w| w[1][0] - points[0][0]);
    let length = points[points.len() - 1][0] - points[0][0];
    let stroke = setup.wave.stroke_m();
    let wanted = (MAPPED_STROKES * stroke).max(10.0 * setup.cell_m).min(0.5 * length);
    let mapped = if level >= 0.4 * wanted { wanted.min(level) } else { wanted };
    if stroke > MOST_SQUEEZE * mapped {
        let allowed = format!("at most {} for a flume of this length", MOST_SQUEEZE * mapped);
        return Err(FlumeError::Value { name: "the piston's stroke", value: stroke, allowed });
    }
    Ok(mapped)
}

/// Steps between two records, for the Courant number.
fn steps_per_record(setup: &FlumeSetup, mapped_m: f64) -> usize {
    let lowest = setup.profile.points().iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let depth = setup.still_level_m - lowest + 2.0 * setup.wave.height_m();
    let narrowest = setup.cell_m * (1.0 - setup.wave.stroke_m() / mapped_m);
    let step = COURANT * narrowest / (setup.gravity_m_s2 * depth).sqrt();
    (setup.record_interval_s / step).ceil().max(1.0) as usize
}

/// The record before the first state, its window cut to the flume and sampled about once a cell.
fn empty_record(setup: &FlumeSetup, volume_m2: f64) -> FlumeRecord {
    let points = setup.profile.points();
    let from = setup.window_x_m[0].max(points[0][0]);
    let to = setup.window_x_m[1].min(points[points.len() - 1][0]);
    let pieces = ((to - from) / setup.cell_m).ceil().max(1.0) as usize;
    let window = (0..=pieces).map(|i| from + (to - from) * i as f64 / pieces as f64).collect();
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

/// Add the present state.
fn take_record(flume: &LayeredFlume, record: &mut FlumeRecord) {
    let levels: Vec<f64> = record.gauges_x_m.iter().map(|&x| flume.surface_m(x)).collect();
    let window = record.window_x_m.clone();
    record.push(flume.paddle_m(), &levels, window.iter().map(|&x| flume.column(x)));
    record.shore_level_m.push(flume.shore_level_m());
    let astray = flume.volume_m2() - flume.entered_m2() - record.volume_m2;
    record.volume_error = record.volume_error.max((astray / record.volume_m2).abs());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::solitary::PistonTheory;

    fn piston(height_m: f64, depth_m: f64) -> WaveSource {
        WaveSource::Piston(SolitaryWave { height_m, depth_m, gravity: 9.81, theory: PistonTheory::Rayleigh })
    }

    /// A level flume of 24 m with a wall at its end.
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
    fn wave_doubles_at_the_end_wall_and_comes_back() {
        let record = run(&setup()).unwrap();
        // Run-up of a solitary wave on a wall, 2H + H^2 / 2d = 2.04 H to second order; the generated wave is within 1
        // %.
        assert!((record.crest(1).0 / 0.04 - 2.04).abs() < 0.03, "{}", record.crest(1).0 / 0.04);
        assert!(record.volume_error < 1e-12);
        let back = (record.crest(1).1 / 0.05) as usize;
        let reflected = record.gauge_elevations_m[0][back..].iter().copied().fold(0.0, f64::max);
        // A collision costs a solitary wave under 1 % of its height, and so do 24 m at this cell.
        assert!((reflected / record.crest(0).0 - 1.0).abs() < 0.02, "{}", reflected / record.crest(0).0);
        assert_eq!(*record.window_x_m.last().unwrap(), 24.0);
    }

    #[test]
    fn the_piston_displaces_what_it_should() {
        let record = run(&FlumeSetup { end_s: 8.0, ..setup() }).unwrap();
        let stroke = record.paddle_m.last().unwrap();
        // The stroke is cut where 1 - tanh = 1e-3.
        assert!((stroke / setup().wave.stroke_m() - 1.0).abs() < 2e-3);
    }

    #[test]
    fn what_cannot_be_computed_is_refused_with_a_reason() {
        let message = |change: fn(&mut FlumeSetup)| {
            let mut setup = setup();
            change(&mut setup);
            run(&setup).unwrap_err().to_string()
        };
        assert_eq!(message(|s| s.layers = 9), "flume: layers is 9, it must be from 1 to 8");
        assert_eq!(message(|s| s.cell_m = -0.1), "flume: cell_m is -0.1, it must be above 0");
        assert_eq!(message(|s| s.end_s = f64::NAN), "flume: end_s is NaN, it must be above 0");
        assert!(message(|s| s.gauges_x_m = vec![25.0]).contains("inside the flume, 0 to 24"));
        assert!(message(|s| s.window_x_m = [40.0, 50.0]).contains("below the flume's end"));
        assert!(message(|s| s.wave = piston(0.04, 0.8)).contains("the depth at the wavemaker, 0.5"));
        assert!(message(|s| s.wave = piston(0.4, 0.5)).contains("where solitary waves break"));
        assert!(message(|s| s.still_level_m = -1.0).contains("above the bed at the wavemaker"));
        assert!(message(|s| s.friction = Friction::Manning { n_s_m13: -0.1 }).contains("from 0 to 0.2"));
        assert!(message(|s| s.right_end = RightEnd::Sponge { length_m: 30.0 }).contains("shorter than the flume, 24"));
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
