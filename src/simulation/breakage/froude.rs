//! Scale factors from the model to the prototype.

/// Froude's law: gravity and water density are the same in model and prototype. A length in the prototype is lambda
/// times the length in the model.
///
/// Strength, Young's modulus and fracture energy of concrete do not follow this law. For example, stresses in the
/// prototype are lambda times the stresses in the model, but the strength is the same. Young's modulus determines force
/// and duration of an impact, so [`Self::blow`] scales force and duration by Hertz's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Froude {
    /// Scale lambda: prototype length divided by model length [-].
    pub scale: f64,
}

/// Scale factors of the force and the duration of an impact. Their product is the scale factor of the impulse, which
/// follows Froude's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactScale {
    /// Force in the prototype divided by force in the model [-].
    pub force: f64,
    /// Duration in the prototype divided by duration in the model [-].
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

    /// Returns the scale factors of an impact by Hertz's law. The effective Young's moduli of the contact are
    /// E*_m = `model_modulus` and E*_p = `prototype_modulus` [Pa]. Let k = E*_p / (lambda E*_m). Overlap and duration
    /// are k^(-2/5) times their values by Froude's law; the force is k^(2/5) times its value by Froude's law.
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
        // The duration is proportional to overlap / speed. The limit 1e-12 allows only rounding errors.
        assert!((after / before / froude.velocity() / blow.time - 1.0).abs() < 1e-12);
        assert!((blow.force * blow.time / (froude.mass() * froude.velocity()) - 1.0).abs() < 1e-12);
        // If the prototype has lambda times the modulus of the model, the force scales by Froude's law alone.
        let soft = froude.blow(model, 50.0 * model);
        assert!((soft.force / froude.mass() - 1.0).abs() < 1e-12);
    }
}
