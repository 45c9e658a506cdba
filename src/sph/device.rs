//! What the water is computed on: the processor, or a graphics card.

use std::str::FromStr;

use glam::DVec3;

use super::{
    backend::{Backend, DeviceError},
    parameters::Parameters,
    step::Solver,
};
#[cfg(feature = "gpu")]
use super::gpu::{card::Card, solver::GpuSolver};

/// What the user asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DeviceChoice {
    /// A graphics card if there is one that computes the case, else the processor.
    Auto,
    /// The processor.
    #[default]
    Cpu,
    /// A graphics card, by its number in `breakwater devices`.
    Gpu(usize),
}

impl FromStr for DeviceChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.parse().map_err(|_| format!("{text:?} is not the number of a device"));
        match text.split_once(':') {
            None if text == "auto" => Ok(Self::Auto),
            None if text == "cpu" => Ok(Self::Cpu),
            None if text == "gpu" => Ok(Self::Gpu(0)),
            Some(("gpu", index)) => number(index).map(Self::Gpu),
            _ => Err("must be auto, cpu, gpu or gpu:N with N as in breakwater devices".to_owned()),
        }
    }
}

/// A device that is ready.
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
    /// Open what was asked for; with a reason if that came to be the processor. `scheme` is what of the case a card
    /// does not compute, if there is such a thing.
    ///
    /// # Errors
    /// If there is no such card, or it cannot be used.
    pub fn open(choice: DeviceChoice, scheme: Option<&'static str>) -> Result<(Self, Option<String>), DeviceError> {
        match choice {
            DeviceChoice::Cpu => Ok((Self::Cpu, None)),
            DeviceChoice::Auto => {
                let reason = match scheme {
                    Some(what) => format!("the GPU does not compute {what}"),
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

    /// The first card that is no software.
    #[cfg(feature = "gpu")]
    fn best_card() -> Result<Self, DeviceError> {
        let number = Card::all().iter().position(|card| !card.is_software);
        let missing = || DeviceError::Missing("there is no graphics card; breakwater devices shows what there is".to_owned());
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
        Err(DeviceError::Missing("this breakwater was built without the feature `gpu`".to_owned()))
    }

    /// Its name.
    pub fn name(&self) -> String {
        match self {
            Self::Cpu => "CPU".to_owned(),
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => card.name().to_owned(),
        }
    }

    /// What computes water in the box from `low` to `high` [m].
    ///
    /// # Errors
    /// If the device does not know the scheme.
    pub fn solver(&self, parameters: Parameters, low: DVec3, high: DVec3) -> Result<Box<dyn Backend>, DeviceError> {
        match self {
            Self::Cpu => Ok(Box::new(Solver::new(parameters, low, high))),
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => Ok(Box::new(GpuSolver::new(card.clone(), parameters, low, high)?)),
        }
    }
}

/// The part of a scheme that cards do not compute, if there is one.
pub fn not_on_cards(parameters: &Parameters) -> Option<&'static str> {
    use super::{density_diffusion::DensityDiffusion, parameters::BoundaryCondition, viscosity::Viscosity, wall_slip::WallSlip};
    if parameters.boundary == BoundaryCondition::Dynamic {
        return Some("the dynamic boundary condition (numerics.boundary = \"dbc\")");
    }
    if !matches!(parameters.viscosity, Viscosity::Artificial { .. }) {
        return Some("laminar viscosity (numerics.viscosity)");
    }
    if parameters.diffusion.kind == DensityDiffusion::Antuono {
        return Some("density diffusion with renormalised gradients (numerics.density_diffusion = \"antuono\")");
    }
    if parameters.slip != WallSlip::Original {
        return Some("walls that slide or stick (numerics.wall_slip other than \"original\")");
    }
    parameters.shifting.map(|_| "particle shifting (numerics.shifting)")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_read_as_they_are_written() {
        let read = |text: &str| text.parse::<DeviceChoice>();
        assert_eq!(read("auto"), Ok(DeviceChoice::Auto));
        assert_eq!(read("cpu"), Ok(DeviceChoice::Cpu));
        assert_eq!(read("gpu"), Ok(DeviceChoice::Gpu(0)));
        assert_eq!(read("gpu:2"), Ok(DeviceChoice::Gpu(2)));
        for wrong in ["", "cuda", "gpu:", "gpu:x", "cpu:1", "gpu:-1"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
