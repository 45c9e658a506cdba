//! `breakwater bench`: measures the speed of the solver on this machine.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};
use serde::Serialize;
use serde_json::json;

use super::{CommandError, input::load};
use crate::{
    bench::{Measurement, block::Block, coupled, machine::Machine, measure},
    case::{Case, InputFile, InputKind},
    output::write_atomically,
    sph::{
        device::{Device, DeviceChoice},
        lanes::InstructionSet,
    },
};

/// Measure the speed of the solver: evaluations and particle pairs per second for a block of water, with 1 to N
/// threads. With CASE, measure time steps of this case, with its units and walls, and of its water alone.
///
/// A "full evaluation" computes continuity, density diffusion, pressure and viscosity of one particle. A time step has
/// two full evaluations per particle, and also sorting, neighbour lists and the boundary. The rate of full evaluations
/// includes boundary particles, although mDBC computes only their density. The number in brackets after this rate is
/// the rate for water particles only.
#[derive(Args)]
pub struct BenchArguments {
    /// Case whose time steps are measured instead of the block of water.
    #[arg(value_name = "CASE", conflicts_with_all = ["particles", "support", "instructions", "device"])]
    case: Option<PathBuf>,
    /// Number of water particles.
    #[arg(long, default_value_t = 170_000, value_parser = clap::value_parser!(u32).range(512..=50_000_000))]
    particles: u32,
    /// Support radius 2h of the SPH kernel divided by the particle spacing dp [-]; h = 1.2 sqrt(3) dp gives 4.16.
    #[arg(long, default_value_t = 4.157)]
    support: f64,
    /// Largest number of threads; default: the number of cores.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: Option<u32>,
    /// Duration of each measurement [s].
    #[arg(long, default_value_t = 5.0)]
    seconds: f64,
    /// SIMD instruction set; default: the best one of this processor.
    #[arg(long, value_enum)]
    instructions: Option<Instructions>,
    /// Device to measure: cpu, gpu, or gpu:N as listed by `breakwater devices`.
    #[arg(long, value_name = "DEVICE", default_value = "cpu")]
    device: DeviceChoice,
    /// Also write the measurements to this JSON file; its top-level keys have the values of the last measurement
    /// (moving water, all threads); default: not written.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Instructions {
    /// Arrays of eight numbers, vectorised by the compiler.
    Portable,
    /// AVX2: eight numbers per instruction.
    Avx2,
    /// AVX-512: sixteen numbers per instruction.
    Avx512,
}

impl Instructions {
    fn set(self) -> InstructionSet {
        match self {
            Self::Portable => InstructionSet::Portable,
            Self::Avx2 => InstructionSet::Avx2,
            Self::Avx512 => InstructionSet::Avx512,
        }
    }
}

impl BenchArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        if !(2.0..=8.0).contains(&self.support) {
            return Err(CommandError::refused(format!("--support {}: must be between 2 and 8", self.support)));
        }
        if !(0.1..=600.0).contains(&self.seconds) {
            return Err(CommandError::refused(format!("--seconds {}: must be between 0.1 and 600", self.seconds)));
        }
        if self.device != DeviceChoice::Cpu {
            return self.measure_card();
        }
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = self.threads.map_or(cores, |threads| threads as usize);
        if let Some(case) = &self.case {
            return self.measure_case(case, threads);
        }
        let instructions = self.instructions.map_or_else(InstructionSet::best, Instructions::set);
        if !InstructionSet::available().contains(&instructions) {
            return Err(CommandError::refused(format!(
                "--instructions: this processor does not support {instructions:?}"
            )));
        }
        let machine = Machine::measure(instructions, threads).map_err(CommandError::failed)?;
        println!("{instructions:?}, {} lanes", instructions.lanes());
        for count in 1..=threads {
            println!(
                "{count} threads: peak {:.0} GFLOP/s, memory {:.1} GB/s",
                machine.flops(count) / 1e9,
                machine.bandwidth(count) / 1e9
            );
        }
        let mut measurements = Vec::new();
        for moving in [false, true] {
            for count in 1..=threads {
                let mut block = Block::new(instructions, self.particles as usize, self.support, moving);
                let measured = measure(&mut block, count, self.seconds, &machine).map_err(CommandError::failed)?;
                print(&measured);
                measurements.push(measured);
            }
        }
        write_json(self.json.as_deref(), &measurements, ("instructions", format!("{instructions:?}")))
    }

    fn measure_case(&self, path: &Path, threads: usize) -> Result<(), CommandError> {
        let InputFile::Flume(case) = load(path, &[InputKind::Flume])? else {
            unreachable!("only flume cases are loaded")
        };
        if case.domain.regions.len() > 1 {
            let what = "bench compares the time steps of a case without domain.fine_x_m; remove this key";
            return Err(CommandError::refused(format!("{}: {what}", path.display())));
        }
        let case: Arc<Case> = Arc::from(case);
        let mut measurements = Vec::new();
        for count in 1..=threads {
            let measured = coupled::measure(case.clone(), count, self.seconds).map_err(CommandError::failed)?;
            println!(
                "{count} threads: {:.0} thousand particles ({:.0} thousand of water), {} units, {} time steps",
                measured.particles as f64 / 1e3,
                measured.water_particles as f64 / 1e3,
                measured.units,
                measured.steps
            );
            println!(
                "  {:.2} million full evaluations/s, {:.0} % of the water alone ({:.2} million/s)",
                measured.full_evaluations_per_s / 1e6,
                100.0 * measured.full_evaluations_per_s / measured.water_alone_per_s,
                measured.water_alone_per_s / 1e6
            );
            measurements.push(measured);
        }
        write_json(self.json.as_deref(), &measurements, ("case", path.display().to_string()))
    }

    #[cfg(feature = "gpu")]
    fn measure_card(self) -> Result<(), CommandError> {
        use crate::bench::card::{Peaks, measure_on_card};

        let (device, reason) = Device::open(self.device, None).map_err(CommandError::refused)?;
        let Device::Gpu(card) = device else { return Err(CommandError::refused(reason.unwrap_or_default())) };
        let peaks = Peaks::measure(&card).map_err(CommandError::failed)?;
        println!("{}: peak {:.0} GFLOP/s, memory {:.1} GB/s", card.name(), peaks.flops / 1e9, peaks.bandwidth / 1e9);
        let mut measurements = Vec::new();
        for moving in [false, true] {
            let mut block = Block::new(InstructionSet::best(), self.particles as usize, self.support, moving);
            let measured = measure_on_card(&mut block, &card, self.seconds, peaks).map_err(CommandError::failed)?;
            print(&measured);
            measurements.push(measured);
        }
        write_json(self.json.as_deref(), &measurements, ("device", card.name().to_owned()))
    }

    #[cfg(not(feature = "gpu"))]
    fn measure_card(self) -> Result<(), CommandError> {
        Device::open(self.device, None).map_err(CommandError::refused).map(|_| ())
    }
}

/// Writes the list of measurements. The top-level keys have the values of the last measurement: moving water with all
/// threads, as in a run.
fn write_json<M: Serialize>(
    path: Option<&Path>,
    measurements: &[M],
    (key, value): (&str, String),
) -> Result<(), CommandError> {
    let Some(path) = path else { return Ok(()) };
    let mut text = json!(measurements.last());
    text[key] = json!(value);
    text["measurements"] = json!(measurements);
    write_atomically(path, format!("{text:#}\n").as_bytes()).map_err(CommandError::refused)
}

fn print(measured: &Measurement) {
    let on = if measured.threads == 0 { "graphics card".to_owned() } else { format!("{} threads", measured.threads) };
    println!(
        "\n{} water, {on}: {:.0} thousand particles ({:.0} thousand of water), {:.0} neighbours per water particle, \
         {} time steps",
        measured.water,
        measured.particles as f64 / 1e3,
        measured.water_particles as f64 / 1e3,
        measured.neighbours_mean,
        measured.steps
    );
    println!(
        "  {:.2} million full evaluations/s ({:.2} million for water), {:.0} million pairs/s, {:.0} bytes per particle",
        measured.full_evaluations_per_s / 1e6,
        measured.water_evaluations_per_s / 1e6,
        measured.pairs_per_s / 1e6,
        measured.bytes_per_particle
    );
    if measured.useful_lanes.is_finite() {
        println!("  {:.0} % of the SIMD lanes used", 100.0 * measured.useful_lanes);
    }
    println!(
        "  {:.0} % of the arithmetic peak ({:.0} % in the pair loop), at least {:.0} % of the memory bandwidth",
        100.0 * measured.share_of_peak,
        100.0 * measured.share_of_peak_in_rates,
        100.0 * measured.share_of_bandwidth
    );
    for phase in &measured.phases {
        println!("  {:<20}{:5.1} %{:9.2} ns per particle", phase.name, 100.0 * phase.share, phase.ns_per_particle);
    }
}
