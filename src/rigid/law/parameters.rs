//! Parameters of the contact laws: materials, resistance and the choice of the law.

/// Elastic constants and restitution of a material in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio nu [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution e [-].
    pub restitution: f64,
}

/// Choice of the contact law, the same for all pairs of surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ContactModel {
    /// Hertz-Mindlin law; the tangential spring is kept from substep to substep.
    #[default]
    HertzMindlin,
    /// Linear springs; every [`Resistance`] must have a stiffness.
    Linear,
    /// Contact law of Chrono 4.0 for contacts between meshes.
    Chrono4,
}

/// Friction, rolling resistance and optional restitution and stiffness of a pair of surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resistance {
    /// Coefficient of static friction [-].
    pub static_friction: f64,
    /// Coefficient of kinetic friction [-].
    pub kinetic_friction: f64,
    /// Coefficient of rolling resistance [-].
    pub rolling: f64,
    /// Coefficient of restitution [-]; `None` selects the smaller restitution of the two materials.
    pub restitution: Option<f64>,
    /// Normal stiffness k_n of the linear law [N/m]; the other laws ignore it.
    pub stiffness: Option<f64>,
}

impl From<f64> for Resistance {
    /// Uses `friction` as static and kinetic friction coefficient, without rolling resistance.
    fn from(friction: f64) -> Self {
        Self { static_friction: friction, kinetic_friction: friction, rolling: 0.0, restitution: None, stiffness: None }
    }
}
