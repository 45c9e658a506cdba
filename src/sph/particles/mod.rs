//! Particles of the water, and boundary particles of bed, walls, wavemaker and armour units.

pub mod bed;
pub mod boundary;
pub mod fill;
pub mod obstacle;
pub mod standing;
pub mod sums;
pub mod unit;
pub mod water;
