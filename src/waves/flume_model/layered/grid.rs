//! Cells that follow the piston: an arbitrary Lagrangian-Eulerian (ALE) grid in one dimension.
//!
//! Near the piston, the faces move by a share of its displacement X: a face at the distance x0 from the piston at rest
//! moves to x = x0 + X (1 - x0 / L) if x0 < L. Faces beyond L are fixed. The piston is the first face, and all fluxes
//! are relative to the moving faces. Therefore the volume of water is conserved to rounding for any stroke. (An inflow
//! at x = 0 with the piston's velocity would need a correction for the displaced water and would start the wave at the
//! wrong position.)

use crate::geometry::profile::Profile;

/// Number of bed levels that are averaged for the mean bed level of a cell.
const BED_SAMPLES: usize = 8;

/// Cells from the piston to the end of the flume.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    profile: Profile,
    /// Positions of the faces with the piston at rest [m].
    reference_x: Vec<f64>,
    /// Length from the piston at rest over which the faces follow the piston [m].
    mapped_m: f64,
    /// Positions of the faces [m]; one more than the number of cells; the first face is the piston.
    pub face_x: Vec<f64>,
    /// Centres of the cells [m].
    pub centre_x: Vec<f64>,
    /// Widths of the cells [m].
    pub width: Vec<f64>,
    /// Mean bed level of the cells [m].
    pub bed: Vec<f64>,
    /// Velocity of the faces during the current time step [m/s].
    pub face_velocity: Vec<f64>,
    /// Number of faces, counted from the piston, that can move.
    moving_faces: usize,
}

impl Grid {
    /// Creates cells of about `cell_m` over the whole profile; the faces within `mapped_m` follow the piston.
    pub fn new(profile: Profile, cell_m: f64, mapped_m: f64) -> Self {
        let points = profile.points();
        let (start, end) = (points[0][0], points[points.len() - 1][0]);
        let cells = ((end - start) / cell_m).round().max(3.0) as usize;
        let width = (end - start) / cells as f64;
        let reference_x: Vec<f64> = (0..=cells).map(|j| start + width * j as f64).collect();
        let moving_faces = reference_x.partition_point(|x| x - start < mapped_m);
        let mut grid = Self {
            profile,
            mapped_m,
            face_x: reference_x.clone(),
            centre_x: vec![0.0; cells],
            width: vec![0.0; cells],
            bed: vec![0.0; cells],
            face_velocity: vec![0.0; cells + 1],
            reference_x,
            moving_faces,
        };
        (0..cells).for_each(|i| grid.measure(i));
        grid
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.width.len()
    }

    /// Bed level z [m] at x [m].
    pub fn bed_at(&self, x: f64) -> f64 {
        self.profile.z(x)
    }

    /// Distance between the cell centres on both sides of a face [m]; the cell width at the ends.
    pub fn spacing(&self, face: usize) -> f64 {
        if face == 0 || face == self.cells() {
            return self.width[face.min(self.cells() - 1)];
        }
        self.centre_x[face] - self.centre_x[face - 1]
    }

    /// Sets the face velocities [m/s] so that after `dt` [s] the piston displacement is `paddle_m` [m].
    pub fn aim(&mut self, paddle_m: f64, dt: f64) {
        for face in 0..self.moving_faces {
            self.face_velocity[face] = (self.mapped(face, paddle_m) - self.face_x[face]) / dt;
        }
    }

    /// Moves the faces to their positions for a piston displacement `paddle_m` [m], and updates the cells.
    pub fn arrive(&mut self, paddle_m: f64) {
        for face in 0..self.moving_faces {
            self.face_x[face] = self.mapped(face, paddle_m);
        }
        (0..self.moving_faces.min(self.cells())).for_each(|i| self.measure(i));
    }

    /// Position of a face for a piston displacement `paddle_m` [m].
    fn mapped(&self, face: usize, paddle_m: f64) -> f64 {
        let x = self.reference_x[face];
        x + paddle_m * (1.0 - (x - self.reference_x[0]) / self.mapped_m)
    }

    /// Updates centre, width and mean bed level of a cell from the positions of its faces.
    fn measure(&mut self, cell: usize) {
        let (left, right) = (self.face_x[cell], self.face_x[cell + 1]);
        self.width[cell] = right - left;
        self.centre_x[cell] = 0.5 * (left + right);
        let sample = |s: usize| left + (right - left) * (s as f64 + 0.5) / BED_SAMPLES as f64;
        self.bed[cell] = (0..BED_SAMPLES).map(|s| self.profile.z(sample(s))).sum::<f64>() / BED_SAMPLES as f64;
    }
}
