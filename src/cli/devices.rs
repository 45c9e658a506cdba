//! `breakwater devices`, and the option --device.

use clap::Args;

use super::CommandError;
use crate::{
    case::Case,
    simulation::flume::scheme::unsupported_on_gpu,
    sph::device::{Device, DeviceChoice},
};

/// List the devices that can compute the water (processor, graphics cards), and how many particles each card can hold.
#[derive(Args)]
pub struct DevicesArguments {}

/// The option --device of the commands that compute water.
#[derive(Args)]
pub(super) struct DeviceArgument {
    /// Device that computes the water: auto (a graphics card if one can compute the case, otherwise the processor),
    /// cpu, gpu, or gpu:N as listed by `breakwater devices`.
    #[arg(long, default_value = "auto", value_name = "DEVICE")]
    pub(super) device: DeviceChoice,
}

impl DeviceArgument {
    /// Opens the device for a case. With `auto`, returns the processor if no graphics card can compute the case.
    pub(super) fn open(&self, case: &Case, quiet: bool) -> Result<Device, CommandError> {
        let (mut device, mut reason) =
            Device::open(self.device, unsupported_on_gpu(case)).map_err(CommandError::refused)?;
        if self.device == DeviceChoice::Auto && !device.fits(case.estimate().particles()) {
            reason = Some(format!("{} has too little memory", device.name()));
            device = Device::Cpu;
        }
        if let (Some(reason), false) = (reason, quiet) {
            eprintln!("computing on the processor: {reason}");
        }
        Ok(device)
    }
}

impl DeviceArgument {
    /// Returns an error if a graphics card is selected for a run without water.
    pub(super) fn refuse_card(&self) -> Result<(), CommandError> {
        match self.device {
            DeviceChoice::Gpu(_) => Err(CommandError::refused(
                "--device gpu: dry tests and fracture runs have no water and run on the processor; leave the option out",
            )),
            DeviceChoice::Auto | DeviceChoice::Cpu => Ok(()),
        }
    }
}

impl DevicesArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        println!("cpu    the processor, {threads} threads");
        list_cards();
        Ok(())
    }
}

#[cfg(feature = "gpu")]
fn list_cards() {
    use crate::sph::gpu::{card::Card, memory::max_particles};

    let cards = Card::all();
    for (number, card) in cards.iter().enumerate() {
        let software = if card.is_software { "; emulated on the processor, for tests only" } else { "" };
        println!("gpu:{number}  {} ({}){software}", card.name, card.interface);
        let memory =
            card.memory.map_or_else(|| "memory unknown".to_owned(), |bytes| format!("{:.1} GB", bytes as f64 / 1e9));
        println!(
            "       {memory}, buffers of at most {:.2} GB: room for {:.1} million particles",
            card.largest_binding.min(card.largest_buffer) as f64 / 1e9,
            max_particles(card) as f64 / 1e6
        );
    }
    if cards.is_empty() {
        println!("no graphics card found with Vulkan, Metal or DirectX 12");
    }
}

#[cfg(not(feature = "gpu"))]
fn list_cards() {
    println!("no graphics cards: breakwater was built without the feature `gpu`");
}
