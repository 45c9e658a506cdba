//! Choice of the device that computes the water: the processor or a graphics card.

use std::{fmt, str::FromStr};

use glam::DVec3;

#[cfg(feature = "gpu")]
use super::gpu::{card::Card, memory::max_particles, solver::GpuSolver};
use super::parameters::Parameters;
use super::solver::backend::{Backend, DeviceError, PROCESSOR};
use super::solver::step::Solver;

/// Device that the user requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DeviceChoice {
    /// The first hardware graphics card if it can compute the case, otherwise the processor.
    Auto,
    /// The processor.
    #[default]
    Cpu,
    /// The graphics card with this number in the list of `breakwater devices`.
    Gpu(usize),
}

impl fmt::Display for DeviceChoice {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => write!(out, "auto"),
            Self::Cpu => write!(out, "cpu"),
            Self::Gpu(number) => write!(out, "gpu:{number}"),
        }
    }
}

impl FromStr for DeviceChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse_number = |text: &str| {
            text.parse().map_err(|_| format!("{text:?} is not a device number; breakwater devices lists the numbers"))
        };
        match text.split_once(':') {
            None if text == "auto" => Ok(Self::Auto),
            None if text == "cpu" => Ok(Self::Cpu),
            None if text == "gpu" => Ok(Self::Gpu(0)),
            Some(("gpu", index)) => parse_number(index).map(Self::Gpu),
            _ => Err("must be auto, cpu, gpu or gpu:N; breakwater devices lists the numbers N".to_owned()),
        }
    }
}

impl DeviceChoice {
    /// Returns the device with the given name, which a checkpoint stores, or `Auto` if there is no such device.
    pub fn named(name: &str) -> Self {
        if name == PROCESSOR {
            return Self::Cpu;
        }
        #[cfg(feature = "gpu")]
        if let Some(number) = Card::all().iter().position(|card| card.name == name) {
            return Self::Gpu(number);
        }
        Self::Auto
    }
}

/// An open device.
#[derive(Debug, Clone, Default)]
pub enum Device {
    /// The processor.
    #[default]
    Cpu,
    /// A graphics card.
    #[cfg(feature = "gpu")]
    Gpu(Card),
}

impl Device {
    /// Opens the requested device. The second result is the reason why `Auto` uses the processor, if it does. `scheme`
    /// names the part of the numerical scheme that graphics cards do not support, if any.
    ///
    /// # Errors
    /// If the requested graphics card does not exist or cannot be used.
    pub fn open(choice: DeviceChoice, scheme: Option<&'static str>) -> Result<(Self, Option<String>), DeviceError> {
        match choice {
            DeviceChoice::Cpu => Ok((Self::Cpu, None)),
            DeviceChoice::Auto => {
                let reason = match scheme {
                    Some(what) => format!("the GPU does not support {what}"),
                    None => match Self::best_card() {
                        Ok(device) => return Ok((device, None)),
                        Err(error) => error.to_string(),
                    },
                };
                Ok((Self::Cpu, Some(reason)))
            }
            DeviceChoice::Gpu(number) => match scheme {
                Some(what) => Err(DeviceError::Scheme(what)),
                None => Ok((Self::card(number)?, None)),
            },
        }
    }

    /// Opens the first card that is not a software renderer.
    #[cfg(feature = "gpu")]
    fn best_card() -> Result<Self, DeviceError> {
        let number = Card::all().iter().position(|card| !card.is_software);
        let missing =
            || DeviceError::Missing("there is no graphics card; breakwater devices lists the devices".to_owned());
        Self::card(number.ok_or_else(missing)?)
    }

    #[cfg(feature = "gpu")]
    fn card(number: usize) -> Result<Self, DeviceError> {
        Card::open(number).map(Self::Gpu)
    }

    #[cfg(not(feature = "gpu"))]
    fn best_card() -> Result<Self, DeviceError> {
        Self::card(0)
    }

    #[cfg(not(feature = "gpu"))]
    fn card(_: usize) -> Result<Self, DeviceError> {
        Err(DeviceError::Missing("breakwater was built without the feature `gpu`".to_owned()))
    }

    /// Returns true if this number of particles fits into the memory of a graphics card; always true for the processor.
    pub fn fits(&self, #[cfg_attr(not(feature = "gpu"), allow(unused_variables))] particles: f64) -> bool {
        match self {
            Self::Cpu => true,
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => particles <= max_particles(card.info()) as f64,
        }
    }

    /// Returns the name of the device.
    pub fn name(&self) -> String {
        match self {
            Self::Cpu => PROCESSOR.to_owned(),
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => card.name().to_owned(),
        }
    }

    /// Creates the solver with bins in the box from `low` to `high` [m]. All particles must stay in the box `bounds`
    /// [m].
    ///
    /// # Errors
    /// If the device does not support the numerical scheme.
    pub fn solver(
        &self,
        parameters: Parameters,
        [low, high]: [DVec3; 2],
        // Not used for the processor: there, the simulation checks the positions in its own arrays.
        #[cfg_attr(not(feature = "gpu"), allow(unused_variables))] bounds: [DVec3; 2],
    ) -> Result<Box<dyn Backend>, DeviceError> {
        match self {
            Self::Cpu => Ok(Box::new(Solver::new(parameters, low, high))),
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => Ok(Box::new(GpuSolver::new(card.clone(), parameters, [low, high], bounds)?)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gpu_refuses_unsupported_schemes_and_names_their_key() {
        use crate::sph::parameters::BoundaryCondition;
        use crate::sph::solver::backend::unsupported_on_gpu;
        use crate::sph::terms::density_diffusion::DensityDiffusion;
        use crate::sph::terms::wall_slip::WallSlip;
        let published = Parameters::published(0.01, 0.02, 30.0, 9.81, None);
        assert_eq!(unsupported_on_gpu(&published), None);
        let free_slip = Parameters { slip: WallSlip::FreeSlip, ..published };
        let dynamic = Parameters { boundary: BoundaryCondition::Dynamic, ..published };
        let gaps = Parameters { gap_pressure: false, ..published };
        let mut antuono = published;
        antuono.diffusion.kind = DensityDiffusion::Antuono;
        for (parameters, key) in [
            (free_slip, "wall_slip"),
            (dynamic, "numerics.boundary"),
            (gaps, "gap_pressure"),
            (antuono, "density_diffusion"),
        ] {
            assert!(unsupported_on_gpu(&parameters).is_some_and(|what| what.contains(key)), "{key}");
            // With `gpu:0`, the function returns an error. `auto` uses the processor and gives the reason.
            let refused = Device::open(DeviceChoice::Gpu(0), unsupported_on_gpu(&parameters)).unwrap_err().to_string();
            assert!(refused.contains(key) && refused.contains("--device cpu"), "{refused}");
            let (device, reason) = Device::open(DeviceChoice::Auto, unsupported_on_gpu(&parameters)).unwrap();
            assert!(matches!(device, Device::Cpu) && reason.is_some_and(|reason| reason.contains(key)));
        }
    }

    #[test]
    fn device_choices_are_parsed() {
        let read = |text: &str| text.parse::<DeviceChoice>();
        assert_eq!(DeviceChoice::named(PROCESSOR), DeviceChoice::Cpu);
        assert_eq!(DeviceChoice::named("a card of another machine"), DeviceChoice::Auto);
        assert_eq!(read("auto"), Ok(DeviceChoice::Auto));
        assert_eq!(read("cpu"), Ok(DeviceChoice::Cpu));
        assert_eq!(read("gpu"), Ok(DeviceChoice::Gpu(0)));
        assert_eq!(read("gpu:2"), Ok(DeviceChoice::Gpu(2)));
        for wrong in ["", "cuda", "gpu:", "gpu:x", "cpu:1", "gpu:-1"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
