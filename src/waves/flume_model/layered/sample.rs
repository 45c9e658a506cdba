//! Flow at any x, interpolated between the cells.

use super::{DRY_DEPTH_M, LayeredFlume};
use crate::waves::flume_model::interpolation::Stencil;

/// Water depth at the shoreline, relative to the largest still water depth [-]. In a laboratory, run-up is observed at
/// the front of the water, not in the thin film that remains behind it.
const SHORE_FILM_SHARE: f64 = 1e-3;

/// Flow at one position and time.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Surface level z [m]; the bed level where dry.
    pub surface_m: f64,
    /// Bed level z [m].
    pub bed_m: f64,
    /// Horizontal velocity of each layer, from the bed upwards [m/s].
    pub u: Vec<f64>,
    /// Vertical velocity at each layer interface, from bed to surface [m/s]; one value more than the number of layers.
    pub w: Vec<f64>,
}

/// Water surface in a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Centre of the cell [m].
    pub x_m: f64,
    /// Surface level z [m]; the bed level in a dry cell.
    pub surface_m: f64,
    /// Depth of the water [m].
    pub depth_m: f64,
}

impl LayeredFlume {
    /// Surface level z [m] at x [m], cubic between the cells; the bed level where dry.
    pub fn surface_m(&self, x: f64) -> f64 {
        self.surface_from(self.wet_cells(x), self.grid.bed_at(x))
    }

    /// Surface in every cell.
    pub fn surface_profile(&self) -> Vec<SurfacePoint> {
        let point = |cell: usize| {
            let depth_m = self.depth[cell];
            SurfacePoint { x_m: self.grid.centre_x[cell], surface_m: self.grid.bed[cell] + depth_m, depth_m }
        };
        (0..self.grid.cells()).map(point).collect()
    }

    /// Bed level z at the shoreline [m]: the first point from the left end where the depth falls to 1/1000 of the
    /// largest still water depth. The level is interpolated linearly between two cell centres.
    pub fn shore_level_m(&self) -> f64 {
        let deepest = self.grid.bed.iter().fold(0.0, |most, bed| f64::max(most, self.still_level_m - bed));
        let film = SHORE_FILM_SHARE * deepest;
        let (bed, depth) = (&self.grid.bed, &self.depth);
        match depth.iter().position(|h| *h < film) {
            None => bed[bed.len() - 1],
            Some(0) => bed[0],
            Some(dry) => {
                let share = (depth[dry - 1] - film) / (depth[dry - 1] - depth[dry]);
                bed[dry - 1] + share * (bed[dry] - bed[dry - 1])
            }
        }
    }

    /// Interpolation stencil over the wet cells around x [m].
    fn wet_cells(&self, x: f64) -> Stencil {
        Stencil::at(&self.grid.centre_x, x, |cell| self.depth[cell] > DRY_DEPTH_M)
    }

    /// Surface level from a stencil over wet cells [m], at least the bed level.
    fn surface_from(&self, cells: Stencil, bed_m: f64) -> f64 {
        if self.depth[cells.point()] > DRY_DEPTH_M {
            cells.apply(|cell| self.grid.bed[cell] + self.depth[cell]).max(bed_m)
        } else {
            bed_m
        }
    }

    /// Flow at x [m] at the time of the current depths; call it only between the two halves of a time step.
    pub fn column(&self, x: f64) -> Column {
        let k = self.layers;
        let (cells, bed_m) = (self.wet_cells(x), self.grid.bed_at(x));
        let faces = Stencil::at(&self.grid.face_x, x, |face| face == 0 || face == self.grid.cells() || self.open[face]);
        let at_n = |now: &[f64], earlier: &[f64], i: usize| 0.5 * (now[i] + earlier[i]);
        let u = (0..k).map(|m| faces.apply(|face| at_n(&self.u, &self.earlier_u, face * k + m))).collect();
        let middle: Vec<f64> =
            (0..k).map(|m| cells.apply(|cell| at_n(&self.w, &self.earlier_w, cell * k + m))).collect();
        Column {
            surface_m: self.surface_from(cells, bed_m),
            bed_m,
            u,
            w: at_interfaces(&middle, cells.apply(|cell| self.climb_along_bed(cell))),
        }
    }

    /// Vertical velocity w at the bed of a cell, u_0 dx z_b [m/s].
    fn climb_along_bed(&self, cell: usize) -> f64 {
        let (k, last) = (self.layers, self.grid.cells());
        let climb = |face: usize| {
            let inner = face.clamp(1, last - 1);
            let slope = (self.grid.bed[inner] - self.grid.bed[inner - 1]) / self.grid.spacing(inner);
            0.5 * (self.u[face * k] + self.earlier_u[face * k]) * slope
        };
        if self.depth[cell] > DRY_DEPTH_M { 0.5 * (climb(cell) + climb(cell + 1)) } else { 0.0 }
    }
}

/// w at the interfaces, from w in the middle of the layers and at the bed: the mean of two layers between them, and an
/// extrapolation at the surface.
fn at_interfaces(middle: &[f64], bed: f64) -> Vec<f64> {
    let mut w = vec![bed];
    w.extend(middle.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
    w.push(2.0 * middle[middle.len() - 1] - w[w.len() - 1]);
    w
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surface_value_is_extrapolated_from_the_top_layer() {
        let w = at_interfaces(&[0.2, 0.5, 0.9], 0.1);
        assert_eq!((w[0], w[1]), (0.1, 0.35));
        assert!((0.5 * (w[2] + w[3]) - 0.9).abs() < 1e-15);
    }
}
