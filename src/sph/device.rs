//! Choice of the device that computes the water: the processor or a graphics card.

use std::{fmt, str::FromStr};

use glam::DVec3;

#[cfg(feature = "gpu")]
use super::gpu::{card::Card, memory::most_particles, solver::GpuSolver};
use super::{
    backend::{Backend, DeviceError, PROCESSOR},
    parameters::Parameters,
    step::Solver,
};

/// Device that the user requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DeviceChoice {
    /// A graphics card if there is one that supports the case, otherwise the processor.
    Auto,
    /// The processor.
    #[default]
    Cpu,
    /// The graphics card with this number in `breakwater devices`.
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
        let parse_number = |text: &str| text.parse().map_err(|_| format!("{text:?} is not a device number"));
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
    /// Returns the device with this name, as stored in checkpoints, or `Auto` if it is not available.
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
    /// Opens the requested device. With `Auto` it falls back to the processor and returns the reason. `scheme` names
    /// the part of the numerical scheme that graphics cards do not support, if any.
    ///
    /// # Errors
    /// If there is no such card, or it cannot be used.
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
        Err(DeviceError::Missing("this breakwater was built without the feature `gpu`".to_owned()))
    }

    /// Returns whether this number of particles fits into its memory.
    pub fn holds(&self, #[cfg_attr(not(feature = "gpu"), allow(unused_variables))] particles: f64) -> bool {
        match self {
            Self::Cpu => true,
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => particles <= most_particles(card.info()) as f64,
        }
    }

    /// Returns its name.
    pub fn name(&self) -> String {
        match self {
            Self::Cpu => PROCESSOR.to_owned(),
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => card.name().to_owned(),
        }
    }

    /// Creates the solver with bins in the box from `low` to `high`; no particle may leave the box `bounds` [m].
    ///
    /// # Errors
    /// If the device does not support the scheme.
    pub fn solver(
        &self,
        parameters: Parameters,
        [low, high]: [DVec3; 2],
        // On the processor the simulation checks the bounds in its own arrays.
        #[cfg_attr(not(feature = "gpu"), allow(unused_variables))] bounds: [DVec3; 2],
    ) -> Result<Box<dyn Backend>, DeviceError> {
        match self {
            Self::Cpu => Ok(Box::new(Solver::new(parameters, low, high))),
            #[cfg(feature = "gpu")]
            Self::Gpu(card) => Ok(Box::new(GpuSolver::new(card.clone(), parameters, [low, high], bounds)?)),
        }
    }
}

/// Returns the part of a scheme that graphics cards do not support, if any.
pub fn not_on_cards(parameters: &Parameters) -> Option<&'static str> {
    use super::{
        density_diffusion::DensityDiffusion, parameters::BoundaryCondition, viscosity::Viscosity, wall_slip::WallSlip,
    };
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
        return Some("free slip or no slip at walls (numerics.wall_slip other than \"original\")");
    }
    if !parameters.gap_pressure {
        return Some("units without gap pressure (numerics.gap_pressure = false)");
    }
    parameters.shifting.map(|_| "particle shifting (numerics.shifting)")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unsupported_schemes_are_named() {
        use super::super::{density_diffusion::DensityDiffusion, parameters::BoundaryCondition, wall_slip::WallSlip};
        let published = Parameters::published(0.01, 0.02, 30.0, 9.81, None);
        assert_eq!(not_on_cards(&published), None);
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
            assert!(not_on_cards(&parameters).is_some_and(|what| what.contains(key)), "{key}");
            // An explicit GPU is refused; `Auto` falls back to the processor and gives the reason.
            let refused = Device::open(DeviceChoice::Gpu(0), not_on_cards(&parameters)).unwrap_err().to_string();
            assert!(refused.contains(key) && refused.contains("--device cpu"), "{refused}");
            let (device, reason) = Device::open(DeviceChoice::Auto, not_on_cards(&parameters)).unwrap();
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
