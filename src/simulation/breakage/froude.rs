//! Scale factors from the model to the prototype.

/// Froude's law: gravity and water density are the same in model and prototype; prototype lengths are lambda times the
/// model lengths.
///
/// Strength, stiffness and fracture energy of concrete do not follow this law: stresses are multiplied by lambda, but
/// the strength of the concrete stays the same. The duration of an impact depends on Young's modulus, which is not
/// lambda times as large in the prototype: see [`Self::blow`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Froude {
    /// Prototype length over model length, lambda [-].
    pub scale: f64,
}

/// Scale factors of the force and the duration of an impact. The product of both, the scale of the impulse, follows
/// Froude's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactScale {
    /// Force in the prototype over force in the model [-].
    pub force: f64,
    /// Duration in the prototype over duration in the model [-].
    pub time: f64,
}

impl Froude {
    /// Returns the scale factor of lengths [-].
    pub fn length(&self) -> f64 {
        self.scale
    }

    /// Returns the scale factor of velocities and times [-].
    pub fn velocity(&self) -> f64 {
        self.scale.sqrt()
    }

    /// Returns the scale factor of angular velocities [-].
    pub fn angular_velocity(&self) -> f64 {
        1.0 / self.scale.sqrt()
    }

    /// Returns the scale factor of masses and forces [-].
    pub fn mass(&self) -> f64 {
        self.scale.powi(3)
    }

    /// Returns the scale factor of moments and energies [-].
    pub fn moment(&self) -> f64 {
        self.scale.powi(4)
    }

    /// Returns the scale factors of an impact by Hertz's law. Let k = E*_p / (lambda E*_m), with the contact moduli E*
    /// [Pa] of prototype and model. Overlap and duration are k^(-2/5) times their values by Froude's law; the force is
    /// k^(2/5) times its value by Froude's law.
    pub fn blow(&self, model_modulus: f64, prototype_modulus: f64) -> ImpactScale {
        let stiffer = (prototype_modulus / (self.scale * model_modulus)).powf(0.4);
        ImpactScale { force: self.mass() * stiffer, time: self.velocity() / stiffer }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::impact_overlap;

    #[test]
    fn scaled_impact_has_hertz_overlap_and_froude_impulse() {
        let froude = Froude { scale: 50.0 };
        let [model, prototype] = [2e8, 1.4e10];
        let blow = froude.blow(model, prototype);
        let [radius, mass, speed] = [0.003, 0.16, 0.3];
        let before = impact_overlap(model, radius, mass, speed);
        let after = impact_overlap(prototype, 50.0 * radius, 50f64.powi(3) * mass, 50f64.sqrt() * speed);
        // The duration is proportional to overlap / speed. Tolerance: rounding.
        assert!((after / before / froude.velocity() / blow.time - 1.0).abs() < 1e-12);
        assert!((blow.force * blow.time / (froude.mass() * froude.velocity()) - 1.0).abs() < 1e-12);
        // If the concrete is as soft as Froude's law requires, the force follows Froude's law alone.
        let soft = froude.blow(model, 50.0 * model);
        assert!((soft.force / froude.mass() - 1.0).abs() < 1e-12);
    }
}
