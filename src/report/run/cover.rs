//! Map of the covered areas of a drawing. Faces behind covered areas are not drawn.

use super::window::{WIDTH, Window};

/// Size of a cell of the map [px], smaller than the finest visible detail.
const CELL: f64 = 0.5;

/// Map of the cells of a drawing, each covered or free.
pub struct Cover {
    columns: usize,
    rows: usize,
    covered: Vec<bool>,
}

impl Cover {
    /// Creates a map in which all cells are free.
    pub fn new(window: &Window) -> Self {
        let [columns, rows] = [WIDTH, window.height()].map(|length| (length / CELL).ceil() as usize);
        Self { columns, rows, covered: vec![false; columns * rows] }
    }

    /// Returns true if a triangle [px] is fully covered. A triangle that is too thin to be visible counts as covered.
    pub fn hides(&self, triangle: [[f64; 2]; 3]) -> bool {
        self.cells(triangle).all(|cell| self.covered[cell])
    }

    /// Marks all cells in the triangles [px] as covered.
    pub fn add(&mut self, triangles: impl IntoIterator<Item = [[f64; 2]; 3]>) {
        for triangle in triangles {
            let cells: Vec<usize> = self.cells(triangle).collect();
            cells.into_iter().for_each(|cell| self.covered[cell] = true);
        }
    }

    /// Returns the indices of the cells whose centre is in the triangle [px].
    fn cells(&self, triangle: [[f64; 2]; 3]) -> impl Iterator<Item = usize> {
        let corners = triangle.map(|corner| corner.map(|c| c / CELL - 0.5));
        let span = |axis: usize, end: usize| {
            let along = corners.map(|corner| corner[axis]);
            let (low, high) = (along.into_iter().fold(f64::MAX, f64::min), along.into_iter().fold(f64::MIN, f64::max));
            (low.ceil().max(0.0) as usize)..((high.floor() + 1.0).max(0.0) as usize).min(end)
        };
        let columns = self.columns;
        let columns_touched = span(0, self.columns);
        span(1, self.rows).flat_map(move |row| {
            let inside = move |column: &usize| contains(corners, [*column as f64, row as f64]);
            columns_touched.clone().filter(inside).map(move |column| row * columns + column)
        })
    }
}

/// Returns true if a point is in a triangle or on its edge. The order of the corners does not matter.
fn contains([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> bool {
    let side =
        |from: [f64; 2], to: [f64; 2]| (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_behind_are_hidden_and_protruding_ones_are_not() {
        let mut cover = Cover::new(&Window::new([0.0, 1.0], [0.0, 0.3]));
        let front = [[100.0, 100.0], [200.0, 100.0], [100.0, 200.0]];
        let behind = [[110.0, 110.0], [130.0, 110.0], [110.0, 130.0]];
        let protruding = [[190.0, 105.0], [230.0, 105.0], [190.0, 140.0]];
        assert!(!cover.hides(behind));
        cover.add([front]);
        assert!(cover.hides(front) && cover.hides(behind) && !cover.hides(protruding));
        // A triangle outside the drawing counts as covered.
        assert!(cover.hides([[-50.0, 10.0], [-10.0, 10.0], [-10.0, 40.0]]));
    }
}
