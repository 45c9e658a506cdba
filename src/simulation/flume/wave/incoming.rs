//! The wave of a case: run of the flume model, start of the particles, and wavemaker in the particle domain.

use super::ends::MovingEnd;
use crate::{
    case::{self, Case, Quantity, Start, Wave},
    waves::{
        flume_model::incoming::IncomingWave,
        flume_model::layered::{Breaking, Pressure},
        flume_model::record::FlumeRecord,
        flume_model::{self, FlumeError, FlumeSetup, WaveSource},
        generation::absorption::Absorption,
        generation::ml_piston::{MlPiston, motion_start_time, velx_start_time},
        generation::paddle::{Paddle, PaddleMotion},
        generation::wavemaker::Wavemaker,
        theory::irregular::IrregularWave,
        theory::regular::{MeanFlow, RegularWave, WaveError},
        theory::stream_function::StreamFunctionWave,
    },
};

/// Longest time between two records of the flume model or of the piston motion [s]. It is short compared with the
/// duration of a solitary wave, some seconds.
const LONGEST_INTERVAL: f64 = 0.02;
/// Smallest number of records per wave period.
const RECORDS_PER_PERIOD: f64 = 60.0;

/// Distance by which the recorded flow of the flume model extends beyond both ends of the particle domain [m]. The
/// distance is necessary because the piston moves beyond the end of the domain.
const FLUME_MARGIN: f64 = 1.5;

/// Upper limit of the arrival time of the wave at the particles, divided by the time in which the wave energy travels
/// from the seaward end to the particles [-].
const ARRIVAL_ALLOWANCE: f64 = 2.5;

/// When the rise of the water level has fallen to this share of its maximum, the crest of a solitary wave has passed [-].
/// The velocity of a long wave is about proportional to the rise. The force on a unit is then 56 % of its maximum if it
/// is proportional to the square of the velocity, and 75 % if it is proportional to the velocity.
const PASSED_SHARE: f64 = 0.75;

/// Smallest rise of the water level that counts as a wave, divided by the particle spacing [-]. Particles do not resolve
/// smaller waves.
const LEAST_RISE: f64 = 0.05;

/// Time constant, in wave periods, with which the rows of a piston return to their start positions against the drift of
/// the water. With 4 wave periods, the return reduces the oscillation of the rows by only 1 / (2 pi 4)^2 / 2 = 0.08 %,
/// and shifts its phase by 2.3 degrees.
const DRIFT_PERIODS: f64 = 4.0;

/// Runs the flume model until the end of the particle run. Returns `None` if the wave of the case does not come from
/// the flume model.
///
/// # Errors
/// If the flume model fails.
pub fn run_flume(case: &Case) -> Result<Option<FlumeRecord>, FlumeError> {
    if !case.wavemaker.follows_flume_model() {
        return Ok(None);
    }
    let Some(wave) = source(&case.wave)? else { return Ok(None) };
    let [x0, x1] = case.domain.x;
    let latest_start = match case.domain.start {
        Start::At(start) => start,
        Start::AtShare(_) => latest_arrival(case, x0),
    };
    let gauges = case.gauges.iter().filter(|gauge| gauge.quantity == Quantity::Elevation);
    let record = flume_model::run(&FlumeSetup {
        profile: case.flume.section().clone(),
        still_level_m: case.flume.still_water_level,
        gravity_m_s2: case.fluid.gravity,
        wave,
        right_end: case.flume.right_end,
        pressure: Pressure::NonHydrostatic,
        friction: case.flume.friction,
        breaking: Breaking::default(),
        layers: case.flume.layers,
        cell_m: case.flume.cell,
        gauges_x_m: gauges.map(|gauge| gauge.at[0]).collect(),
        profile_times_s: Vec::new(),
        window_x_m: [x0 - FLUME_MARGIN, x1 + FLUME_MARGIN],
        record_interval_s: interval(&case.wave),
        end_s: latest_start + case.stop.duration,
    })?;
    Ok(Some(record))
}

/// Returns the source of the wave at the seaward end of the flume model; `None` for still water or for waves from
/// files.
fn source(wave: &Wave) -> Result<Option<WaveSource>, WaveError> {
    let inflow = match *wave {
        Wave::None | Wave::External(_) => return Ok(None),
        Wave::Solitary(wave) => return Ok(Some(WaveSource::Piston(wave))),
        Wave::SolitaryInflow(wave) => IncomingWave::solitary(wave),
        Wave::Regular { wave, ramp_periods } => IncomingWave::Regular {
            wave: StreamFunctionWave::new(wave, MeanFlow::NoTransport)?,
            ramp_s: ramp_periods * wave.period_s,
        },
        Wave::Irregular { sea, ramp_periods } => {
            IncomingWave::Irregular { wave: IrregularWave::new(sea)?, ramp_s: ramp_periods * sea.peak_period_s }
        }
    };
    Ok(Some(WaveSource::Inflow(inflow)))
}

/// Returns the time between two records of the flume model [s].
fn interval(wave: &Wave) -> f64 {
    wave.period().map_or(LONGEST_INTERVAL, |period| LONGEST_INTERVAL.min(period / RECORDS_PER_PERIOD))
}

/// Returns a flume time [s] at which the wave has certainly reached its full height at the position `x` [m].
fn latest_arrival(case: &Case, x: f64) -> f64 {
    let (distance, gravity) = (x - case.flume.ends()[0], case.fluid.gravity);
    let mean_depth = 0.5 * (case.flume.offshore_depth() + case.flume.still_depth(x));
    let long = (gravity * mean_depth).sqrt();
    let (speed, growth) = match case.wave {
        Wave::Regular { wave, ramp_periods } => {
            (RegularWave { depth_m: mean_depth, ..wave }.group_velocity_m_s(), ramp_periods * wave.period_s)
        }
        Wave::Irregular { sea, ramp_periods } => {
            let (height_m, period_s) = (sea.significant_height_m, sea.peak_period_s);
            let peak = RegularWave { height_m, period_s, depth_m: mean_depth, gravity };
            (peak.group_velocity_m_s(), ramp_periods * period_s)
        }
        Wave::Solitary(wave) => (long, wave.duration_s()),
        Wave::SolitaryInflow(wave) => (long, 2.0 * wave.half_length_m() / wave.celerity_m_s()),
        Wave::None | Wave::External(_) => (long, 0.0),
    };
    ARRIVAL_ALLOWANCE * distance / speed + growth
}

/// Returns the time at which the particles start [s]: a flume time or, for waves from files, a time of these files.
pub fn particle_start(case: &Case, record: Option<&FlumeRecord>) -> f64 {
    let (place, level) = (case.domain.x[0], case.flume.still_water_level);
    match (case.domain.start, record, &case.wave) {
        (Start::At(start), ..) => start,
        (Start::AtShare(share), Some(record), _) => motion_start_time(record, place, share),
        (Start::AtShare(share), None, Wave::External(wave)) => velx_start_time(&wave.rows, level, share),
        (Start::AtShare(_), None, _) => 0.0,
    }
}

/// Returns the time since the start of the particles at which the crest of a solitary wave has passed x [m] in the flume
/// model [s]: the water level above rest has fallen to [`PASSED_SHARE`] of its maximum. If it does not fall so far, the
/// time is the duration of the run. 0 for other waves, or if the wave does not reach x.
pub(crate) fn passing_time(case: &Case, record: Option<&FlumeRecord>, start: f64, x: f64) -> f64 {
    let (Some(record), Wave::Solitary(_) | Wave::SolitaryInflow(_)) = (record, &case.wave) else { return 0.0 };
    let rest = (case.flume.section().z(x) - case.flume.still_water_level).max(0.0);
    let rise = |time: &&f64| record.elevation(x, **time) - rest;
    let in_run: Vec<&f64> =
        record.times_s().iter().filter(|time| (start..=start + case.stop.duration).contains(*time)).collect();
    let highest = in_run.iter().map(&rise).fold(0.0, f64::max);
    if highest < LEAST_RISE * case.domain.dp {
        return 0.0;
    }
    let mut since_crest = in_run.iter().skip_while(|time| rise(time) < highest);
    let passed = since_crest.find(|time| rise(time) <= PASSED_SHARE * highest);
    passed.map_or(case.stop.duration, |time| **time - start)
}

/// Returns the multi-layer piston for the wave of the case.
pub fn ml_piston(case: &Case, record: &FlumeRecord, start: f64) -> MlPiston {
    let interval = interval(&case.wave);
    let end = (start + case.stop.duration).max(start + interval);
    let drawn_back = case.wave.period().map(|period| DRIFT_PERIODS * period);
    let rows = case.domain.wavemaker_rows(&case.flume, case.domain.x[0]);
    MlPiston::from_record(record, case.domain.x[0], &rows, [start, end], interval, drawn_back)
}

/// Returns the moving ends of the particle domain, or of a region of it: none, the wavemaker, or open ends. An end where
/// water of another region continues does not move.
pub(crate) fn ends(case: &Case, flume: Option<&FlumeRecord>, start: f64) -> Vec<MovingEnd> {
    let [seaward, shoreward] = case.domain.continues.map(|continues| !continues);
    match (case.wavemaker, flume) {
        (case::Wavemaker::OpenEnds { gauge }, Some(record)) => {
            let open = |x: f64, inwards: f64| {
                MovingEnd::open(Wavemaker::MlPiston(open_end(case, record, start, x, gauge)), inwards, case.domain.dp)
            };
            let [from, to] = case.domain.x;
            let ends = [seaward.then(|| open(from, 1.0)), shoreward.then(|| open(to, -1.0))];
            ends.into_iter().flatten().collect()
        }
        _ if !seaward => Vec::new(),
        _ => wavemaker(case, flume, start).map(MovingEnd::wavemaker).into_iter().collect(),
    }
}

/// Returns the rows of an open end at x [m]. They follow the flume model, and a gauge at the distance `gauge` [m] lets
/// other waves leave.
fn open_end(case: &Case, record: &FlumeRecord, start: f64, x: f64, gauge: f64) -> MlPiston {
    let interval = interval(&case.wave);
    let end = (start + case.stop.duration).max(start + interval);
    let rows = case.domain.wavemaker_rows(&case.flume, x);
    let (depth, gravity) = (case.flume.still_depth(x), case.fluid.gravity);
    let absorption = Absorption::for_full_depth_piston(gauge, depth, None, gravity, f64::INFINITY);
    MlPiston::at_fixed_place(record, x, &rows, [start, end], interval).with_absorption(absorption)
}

/// Returns the wavemaker of the particle domain; `None` if the case has no wave.
fn wavemaker(case: &Case, flume: Option<&FlumeRecord>, start: f64) -> Option<Wavemaker> {
    if let Some(record) = flume {
        let piston = ml_piston(case, record, start);
        return Some(Wavemaker::MlPiston(match case.wavemaker.absorption_gauge() {
            Some(gauge) => {
                let (depth, period) = (case.flume.still_depth(case.domain.x[0]), case.wave.period());
                let reach = piston.max_shoreward_displacement_m().max(piston.max_seaward_displacement_m());
                piston.with_absorption(Absorption::for_full_depth_piston(
                    gauge,
                    depth,
                    period,
                    case.fluid.gravity,
                    reach,
                ))
            }
            None => piston,
        }));
    }
    let place = case.domain.x[0];
    let bed = case.flume.section().z(place);
    let (motion, depth) = match case.wave {
        Wave::External(ref wave) => {
            let end = (start + case.stop.duration).max(start + LONGEST_INTERVAL);
            return Some(Wavemaker::MlPiston(MlPiston::from_velx(
                &wave.rows,
                [start, end],
                LONGEST_INTERVAL,
                wave.celerity,
            )));
        }
        Wave::Solitary(wave) => (PaddleMotion::Solitary(wave), wave.depth_m),
        Wave::Regular { wave, ramp_periods } => {
            (PaddleMotion::Regular(case.wavemaker.motion(&wave, ramp_periods, bed)), wave.depth_m)
        }
        Wave::None | Wave::SolitaryInflow(_) | Wave::Irregular { .. } => return None,
    };
    let shape = case.wavemaker.shape(bed);
    let rows = case.domain.wavemaker_rows(&case.flume, place);
    let paddle = Paddle::new(place, rows, [bed, depth], shape, motion);
    Some(Wavemaker::Paddle(match case.wavemaker {
        case::Wavemaker::Piston { absorption_gauge: Some(gauge) } => paddle.with_absorption(gauge),
        _ => paddle,
    }))
}
