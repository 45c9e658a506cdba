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

/// Contact law of all pairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ContactModel {
    /// Hertz-Mindlin with tangential history.
    #[default]
    HertzMindlin,
    /// Linear springs; every [`Resistance`] needs a stiffness.
    Linear,
    /// The law of Chrono 4.0 between meshes.
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
    /// Coefficient of restitution [-]; default: the smaller one of the two materials.
    pub restitution: Option<f64>,
    /// Stiffness of the linear law [N/m].
    pub stiffness: Option<f64>,
}

impl From<f64> for Resistance {
    /// The same static and kinetic friction coefficient; no rolling resistance.
    fn from(friction: f64) -> Self {
        Self { static_friction: friction, kinetic_friction: friction, rolling: 0.0, restitution: None, stiffness: None }
    }
}
