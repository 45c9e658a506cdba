//! From the model to the prototype.

/// Froude's law: gravity and the density of water are the same in model and prototype, lengths are `scale` times as long.
///
/// The strength, the stiffness and the fracture energy of concrete do not follow it: a unit lambda times as long meets
/// stresses of lambda times the model's with the strength of the same concrete. And the duration of a blow depends on
/// Young's modulus, which Froude's law would have lambda times as large: see [`Self::blow`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Froude {
    /// Lengths of the prototype over those of the model, lambda [-].
    pub scale: f64,
}

/// How the force of a blow changes from the model to the prototype; its impulse changes by Froude's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlowScale {
    /// Force of the prototype over that of the model [-].
    pub force: f64,
    /// Duration of the prototype's blow over that of the model's [-].
    pub time: f64,
}

impl Froude {
    /// Lengths [-].
    pub fn length(&self) -> f64 {
        self.scale
    }

    /// Velocities [-]; times, too.
    pub fn velocity(&self) -> f64 {
        self.scale.sqrt()
    }

    /// Angular velocities [-].
    pub fn angular_velocity(&self) -> f64 {
        1.0 / self.scale.sqrt()
    }

    /// Masses, forces [-].
    pub fn mass(&self) -> f64 {
        self.scale.powi(3)
    }

    /// Moments, energies [-].
    pub fn moment(&self) -> f64 {
        self.scale.powi(4)
    }

    /// A blow by Hertz's law: with k = E*_p / (lambda E*_m) for the moduli of contact E* [Pa] of prototype and model, the
    /// overlap of an impact is k^(-2/5) times what Froude's law gives, so is its duration, and the force k^(2/5) times.
    pub fn blow(&self, model_modulus: f64, prototype_modulus: f64) -> BlowScale {
        let stiffer = (prototype_modulus / (self.scale * model_modulus)).powf(0.4);
        BlowScale { force: self.mass() * stiffer, time: self.velocity() / stiffer }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::impact_overlap;

    #[test]
    fn a_blow_has_the_overlap_of_hertz_at_the_scale_and_keeps_its_impulse() {
        let froude = Froude { scale: 50.0 };
        let [model, prototype] = [2e8, 1.4e10];
        let blow = froude.blow(model, prototype);
        let [radius, mass, speed] = [0.003, 0.16, 0.3];
        let before = impact_overlap(model, radius, mass, speed);
        let after = impact_overlap(prototype, 50.0 * radius, 50f64.powi(3) * mass, 50f64.sqrt() * speed);
        // The duration goes as overlap over speed; rounding.
        assert!((after / before / froude.velocity() / blow.time - 1.0).abs() < 1e-12);
        assert!((blow.force * blow.time / (froude.mass() * froude.velocity()) - 1.0).abs() < 1e-12);
        // Concrete that were as soft as the model asks for: Froude's law alone.
        let soft = froude.blow(model, 50.0 * model);
        assert!((soft.force / froude.mass() - 1.0).abs() < 1e-12);
    }
}
