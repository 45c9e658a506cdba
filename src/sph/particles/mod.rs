//! Particles of the water, and boundary particles of bed, walls, wavemaker and armour units; porosity at any point.

pub mod bed;
pub mod boundary;
pub mod fill;
pub mod obstacle;
pub mod porosity;
pub mod standing;
pub mod sums;
pub mod unit;
pub mod water;
