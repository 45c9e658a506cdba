//! Particles: the water, and the layers of particles that stand for bed, walls, wavemaker and armour units.

pub mod bed;
pub mod boundary;
pub mod fill;
pub mod obstacle;
pub mod unit;
pub mod water;
