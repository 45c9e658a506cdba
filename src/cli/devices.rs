//! `breakwater devices`, and the choice of a device.

use clap::Args;

use super::Trouble;
use crate::{
    case::Case,
    simulation::flume::scheme::unsupported_on_gpu,
    sph::device::{Device, DeviceChoice},
};

/// What there is to compute the water on: the processor, graphics cards, and how many particles fit.
#[derive(Args)]
pub struct DevicesArguments {}

/// Choice of a device.
#[derive(Args)]
pub(super) struct DeviceArgument {
    /// What computes the water: auto (a graphics card if there is one for the case), cpu, gpu or gpu:N as in
    /// `breakwater devices`.
    #[arg(long, default_value = "auto", value_name = "DEVICE")]
    pub(super) device: DeviceChoice,
}

impl DeviceArgument {
    /// The device for a case.
    pub(super) fn open(&self, case: &Case, quiet: bool) -> Result<Device, Trouble> {
        let (mut device, mut reason) = Device::open(self.device, unsupported_on_gpu(case)).map_err(Trouble::refused)?;
        if self.device == DeviceChoice::Auto && !device.fits(case.estimate().particles()) {
            reason = Some(format!("{} has not enough memory", device.name()));
            device = Device::Cpu;
        }
        if let (Some(reason), false) = (reason, quiet) {
            eprintln!("on the CPU: {reason}");
        }
        Ok(device)
    }
}

impl DeviceArgument {
    /// Without water there is nothing for a card.
    pub(super) fn refuse_card(&self) -> Result<(), Trouble> {
        match self.device {
            DeviceChoice::Gpu(_) => {
                Err(Trouble::refused("--device gpu: a case without water is computed on the processor"))
            }
            DeviceChoice::Auto | DeviceChoice::Cpu => Ok(()),
        }
    }
}

impl DevicesArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        println!("cpu    the processor, {threads} threads");
        list_cards();
        Ok(())
    }
}

#[cfg(feature = "gpu")]
fn list_cards() {
    use crate::sph::gpu::{card::Card, memory::most_particles};

    let cards = Card::all();
    for (number, card) in cards.iter().enumerate() {
        let software = if card.is_software { "; a program on the processor, for tests" } else { "" };
        println!("gpu:{number}  {} ({}){software}", card.name, card.interface);
        let memory =
            card.memory.map_or_else(|| "memory unknown".to_owned(), |bytes| format!("{:.1} GB", bytes as f64 / 1e9));
        println!(
            "       {memory}, pieces of at most {:.2} GB: room for {:.1} million particles",
            card.largest_binding.min(card.largest_buffer) as f64 / 1e9,
            most_particles(card) as f64 / 1e6
        );
    }
    if cards.is_empty() {
        println!("no graphics card: neither Vulkan, Metal nor DirectX 12 shows one");
    }
}

#[cfg(not(feature = "gpu"))]
fn list_cards() {
    println!("this breakwater was built without the feature `gpu`");
}
