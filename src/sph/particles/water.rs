//! The water particles.

use glam::DVec3;

/// State of the water, one entry per particle in every array.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Water {
    /// Position [m].
    pub position: Vec<DVec3>,
    /// Velocity [m/s].
    pub velocity: Vec<DVec3>,
    /// Density [kg/m3].
    pub density: Vec<f64>,
    /// Identification number, which the particle keeps when the arrays are sorted.
    pub id: Vec<u32>,
    /// Mass [kg].
    pub mass: Vec<f64>,
}

impl Water {
    /// Returns the number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Keeps only the particles for which `keep` is true; their order remains.
    pub fn retain(&mut self, keep: &[bool]) {
        retain(&mut self.position, keep);
        retain(&mut self.velocity, keep);
        retain(&mut self.density, keep);
        retain(&mut self.id, keep);
        retain(&mut self.mass, keep);
    }

    /// Adds the particles of `other` at the end.
    pub fn append(&mut self, other: Self) {
        self.position.extend(other.position);
        self.velocity.extend(other.velocity);
        self.density.extend(other.density);
        self.id.extend(other.id);
        self.mass.extend(other.mass);
    }

    /// Returns the memory in use [bytes].
    pub fn bytes(&self) -> usize {
        let vectors = (self.position.capacity() + self.velocity.capacity()) * size_of::<DVec3>();
        let numbers = (self.density.capacity() + self.mass.capacity()) * size_of::<f64>();
        vectors + numbers + self.id.capacity() * size_of::<u32>()
    }

    /// Returns true if there are no particles.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }
}

fn retain<T>(values: &mut Vec<T>, keep: &[bool]) {
    let mut flags = keep.iter();
    values.retain(|_| *flags.next().expect("one flag per particle"));
}
