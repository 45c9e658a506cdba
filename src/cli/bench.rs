//! `breakwater bench`: how fast is the solver on this machine.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;

use super::Trouble;
use crate::{
    bench::{Measurement, block::Block, machine::Machine, measure},
    output::write_atomically,
    sph::lanes::InstructionSet,
};

/// Time whole steps of a block of water: evaluations and pairs a second, by phase, for 1 to N threads.
///
/// One "full evaluation" is continuity, density diffusion, pressure and viscosity of one particle; a step has two of
/// each, and sorting, listing and the boundary besides.
#[derive(Args)]
pub struct BenchArguments {
    /// Water particles.
    #[arg(long, default_value_t = 170_000, value_parser = clap::value_parser!(u32).range(512..=50_000_000))]
    particles: u32,
    /// Diameter of the kernel's support in particle distances, 2h/dp; h = 1.2 sqrt(3) dp makes 4.16.
    #[arg(long, default_value_t = 4.157)]
    support: f64,
    /// Largest number of threads; as many as cores unless given.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: Option<u32>,
    /// Time for each measurement [s].
    #[arg(long, default_value_t = 5.0)]
    seconds: f64,
    /// Instructions to compute with; the best that the processor has unless given.
    #[arg(long, value_enum)]
    instructions: Option<Instructions>,
    /// Write the measurements to this file too: moving water on all threads, and the list of all.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Instructions {
    /// Whatever the compiler makes of arrays of eight.
    Portable,
    /// Eight lanes of AVX2.
    Avx2,
    /// Sixteen lanes of AVX-512.
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
    pub(super) fn execute(self) -> Result<(), Trouble> {
        if !(2.0..=8.0).contains(&self.support) {
            return Err(Trouble::refused(format!("--support: {} is not between 2 and 8", self.support)));
        }
        if !(0.1..=600.0).contains(&self.seconds) {
            return Err(Trouble::refused(format!("--seconds: {} is not between 0.1 and 600", self.seconds)));
        }
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = self.threads.map_or(cores, |threads| threads as usize);
        let instructions = self.instructions.map_or_else(InstructionSet::best, Instructions::set);
        if !InstructionSet::available().contains(&instructions) {
            return Err(Trouble::refused(format!("--instructions: this processor does not have {instructions:?}")));
        }
        let machine = Machine::measure(instructions, threads).map_err(Trouble::failed)?;
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
                let measured = measure(&mut block, count, self.seconds, &machine).map_err(Trouble::failed)?;
                print(&measured);
                measurements.push(measured);
            }
        }
        let Some(path) = self.json else { return Ok(()) };
        // The moving water on all threads, which is what a run is like; every measurement in the list.
        let mut text = json!(measurements.last());
        text["instructions"] = json!(format!("{instructions:?}"));
        text["measurements"] = json!(measurements);
        write_atomically(&path, format!("{text:#}\n").as_bytes()).map_err(Trouble::refused)
    }
}

fn print(measured: &Measurement) {
    println!(
        "\n{} water, {} threads, {:.0} thousand particles ({:.0} water), {:.0} neighbours, {} steps",
        measured.water,
        measured.threads,
        measured.particles as f64 / 1e3,
        measured.water_particles as f64 / 1e3,
        measured.neighbours_mean,
        measured.steps
    );
    println!(
        "  {:.2} million full evaluations/s, {:.0} million pairs/s, {:.0} bytes a particle",
        measured.full_evaluations_per_s / 1e6,
        measured.pairs_per_s / 1e6,
        measured.bytes_per_particle
    );
    println!(
        "  {:.0} % of the lanes useful; {:.0} % of the arithmetic peak ({:.0} % in the pair loop), at least {:.0} % of the memory bandwidth",
        100.0 * measured.useful_lanes,
        100.0 * measured.share_of_peak,
        100.0 * measured.share_of_peak_in_rates,
        100.0 * measured.share_of_bandwidth
    );
    for phase in &measured.phases {
        println!("  {:<20}{:5.1} %{:9.0} ns a particle", phase.name, 100.0 * phase.share, phase.ns_per_particle);
    }
}
