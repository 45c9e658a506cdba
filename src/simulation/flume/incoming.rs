//! The wave of a case: its run of the flume model and its wavemaker in the particle domain.

use crate::{
    case::{self, Case, Quantity, Start, Wave},
    waves::{
        absorption::Absorption,
        flume::{self, FlumeError, FlumeSetup, WaveSource},
        incoming::IncomingWave,
        irregular::IrregularWave,
        layered::{Breaking, Pressure},
        ml_piston::{MlPiston, start_of_rows, start_time},
        paddle::{Paddle, PaddleMotion},
        record::FlumeRecord,
        regular::{MeanFlow, RegularWave, WaveError},
        stream_function::StreamFunctionWave,
        wavemaker::Wavemaker,
    },
};

/// Longest interval of the records of the flume model and of the piston motion [s]; a solitary wave lasts seconds.
const LONGEST_INTERVAL: f64 = 0.02;
/// Least number of records per wave period.
const RECORDS_PER_PERIOD: f64 = 60.0;

/// Distance beyond both ends of the particle domain over which the flow is recorded [m], because the piston moves.
const FLUME_MARGIN: f64 = 1.5;

/// Longest flume time in which the wave must arrive at the particles, over the time that its energy takes from the
/// seaward end [-].
const ARRIVAL_ALLOWANCE: f64 = 2.5;

/// Time, in wave periods, over which the rows of a piston return to their start positions against the drift of the
/// water. It changes the oscillation by only 1 / (2 pi 4)^2 / 2 = 0.08 % of its height and 2.3 degrees.
const DRIFT_PERIODS: f64 = 4.0;

/// Runs the flume model, if the wave of the case comes from it, until the end of the particle run.
///
/// # Errors
/// If the flume model fails.
pub fn run_flume(case: &Case) -> Result<Option<FlumeRecord>, FlumeError> {
    if !case.wavemaker.is_ml_piston() {
        return Ok(None);
    }
    let Some(wave) = source(&case.wave)? else { return Ok(None) };
    let [x0, x1] = case.domain.x;
    let latest_start = match case.domain.start {
        Start::At(start) => start,
        Start::AtShare(_) => latest_arrival(case, x0),
    };
    let gauges = case.gauges.iter().filter(|gauge| gauge.quantity == Quantity::Elevation);
    let record = flume::run(&FlumeSetup {
        profile: case.flume.profile.clone(),
        still_level_m: case.flume.still_level,
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

/// Returns the source of the wave at the seaward end of the flume.
fn source(wave: &Wave) -> Result<Option<WaveSource>, WaveError> {
    let inflow = match *wave {
        Wave::None | Wave::Given(_) => return Ok(None),
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

/// Returns the interval of the records of the flume model [s].
fn interval(wave: &Wave) -> f64 {
    wave.period().map_or(LONGEST_INTERVAL, |period| LONGEST_INTERVAL.min(period / RECORDS_PER_PERIOD))
}

/// Returns the time by which the wave has certainly arrived at x [m] with its full height [s].
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
        Wave::None | Wave::Given(_) => (long, 0.0),
    };
    ARRIVAL_ALLOWANCE * distance / speed + growth
}

/// Returns the time at which the particles start [s]: flume time, or time of the files with the wave.
pub fn particle_start(case: &Case, record: Option<&FlumeRecord>) -> f64 {
    let (place, level) = (case.domain.x[0], case.flume.still_level);
    match (case.domain.start, record, &case.wave) {
        (Start::At(start), ..) => start,
        (Start::AtShare(share), Some(record), _) => start_time(record, place, share),
        (Start::AtShare(share), None, Wave::Given(wave)) => start_of_rows(&wave.rows, level, share),
        (Start::AtShare(_), None, _) => 0.0,
    }
}

/// Returns the particle time of the crest of a solitary wave at x [m], by the flume model [s]; 0 for other waves.
pub(super) fn crest_time(case: &Case, record: Option<&FlumeRecord>, start: f64, x: f64) -> f64 {
    let (Some(record), Wave::Solitary(_) | Wave::SolitaryInflow(_)) = (record, &case.wave) else { return 0.0 };
    let end = start + case.stop.duration;
    let times = record.times_s().iter().filter(|time| (start..=end).contains(*time));
    let levels = times.map(|&time| (time - start, record.elevation(x, time)));
    // Of equal levels the first: where x stays dry, the run does not wait.
    levels.reduce(|highest, next| if next.1 > highest.1 { next } else { highest }).map_or(0.0, |(time, _)| time)
}

/// Returns the multi-layer piston for the wave of the case.
pub fn ml_piston(case: &Case, record: &FlumeRecord, start: f64) -> MlPiston {
    let interval = interval(&case.wave);
    let end = (start + case.stop.duration).max(start + interval);
    let drawn_back = case.wave.period().map(|period| DRIFT_PERIODS * period);
    let rows = case.domain.wavemaker_rows(&case.flume);
    MlPiston::from_record(record, case.domain.x[0], &rows, [start, end], interval, drawn_back)
}

/// Returns the wavemaker of the particle domain, if the case has a wave.
pub(super) fn wavemaker(case: &Case, flume: Option<&FlumeRecord>, start: f64) -> Option<Wavemaker> {
    if let Some(record) = flume {
        let piston = ml_piston(case, record, start);
        return Some(Wavemaker::MlPiston(match case.wavemaker.absorption_gauge() {
            Some(gauge) => {
                let (depth, period) = (case.flume.still_depth(case.domain.x[0]), case.wave.period());
                let reach = piston.shoreward_reach_m().max(piston.seaward_reach_m());
                piston.absorbing(Absorption::of_piston(gauge, depth, period, case.fluid.gravity, reach))
            }
            None => piston,
        }));
    }
    let place = case.domain.x[0];
    let bed = case.flume.profile.z(place);
    let (motion, depth) = match case.wave {
        Wave::Given(ref wave) => {
            let end = (start + case.stop.duration).max(start + LONGEST_INTERVAL);
            return Some(Wavemaker::MlPiston(MlPiston::from_rows(
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
    let rows = case.domain.wavemaker_rows(&case.flume);
    let paddle = Paddle::new(place, rows, [bed, depth], shape, motion);
    Some(Wavemaker::Paddle(match case.wavemaker {
        case::Wavemaker::Piston { absorption_gauge: Some(gauge) } => paddle.absorbing(gauge),
        _ => paddle,
    }))
}
