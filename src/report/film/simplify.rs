//! Fewer triangles for a film.

use std::collections::HashMap;

use glam::Vec3;

/// A mesh of triangles with values at its points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Points [m].
    pub points: Vec<[f32; 3]>,
    /// Indices of the three corner points of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Values at each point, one list per field.
    pub values: Vec<Vec<f32>>,
}

impl Mesh {
    /// Keeps the triangles for which `is_kept` returns true, and their points in the same order.
    pub fn filtered(&self, is_kept: impl Fn(&[[f32; 3]; 3]) -> bool) -> Self {
        let corners = |triangle: &[u32; 3]| triangle.map(|corner| self.points[corner as usize]);
        let triangles: Vec<[u32; 3]> =
            self.triangles.iter().copied().filter(|triangle| is_kept(&corners(triangle))).collect();
        let mut is_used = vec![false; self.points.len()];
        triangles.iter().flatten().for_each(|corner| is_used[*corner as usize] = true);
        let used: Vec<usize> = (0..self.points.len()).filter(|point| is_used[*point]).collect();
        let mut number = vec![0; self.points.len()];
        used.iter().zip(0..).for_each(|(point, new)| number[*point] = new);
        Self {
            points: used.iter().map(|point| self.points[*point]).collect(),
            triangles: triangles.iter().map(|triangle| triangle.map(|corner| number[corner as usize])).collect(),
            values: self.values.iter().map(|list| used.iter().map(|point| list[*point]).collect()).collect(),
        }
    }

    /// Appends a mesh with the same fields.
    pub fn append(&mut self, other: &Self) {
        let first = self.points.len() as u32;
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|corner| first + corner)));
        self.points.extend(&other.points);
        self.values.iter_mut().zip(&other.values).for_each(|(list, values)| list.extend(values));
    }

    /// Returns the unit normal at each point: the mean over its triangles, weighted with their areas.
    pub fn normals(&self) -> Vec<[f32; 3]> {
        let mut normals = vec![Vec3::ZERO; self.points.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|corner| Vec3::from_array(self.points[corner as usize]));
            triangle.iter().for_each(|corner| normals[*corner as usize] += (b - a).cross(c - a));
        }
        normals.into_iter().map(|normal| normal.normalize_or(Vec3::Z).to_array()).collect()
    }

    /// Merges the points of each cell of a grid into their mean, and drops the triangles that thus lose their area
    /// (vertex clustering: Rossignac & Borrel 1993). `cell` is the edge length of a cell [m].
    pub fn clustered(&self, cell: f32) -> Self {
        let mut number_of: HashMap<[i32; 3], u32> = HashMap::new();
        let mut members: Vec<f32> = Vec::new();
        let mut merged = Self { values: vec![Vec::new(); self.values.len()], ..Self::default() };
        let mut number = Vec::with_capacity(self.points.len());
        for (index, point) in self.points.iter().enumerate() {
            let key = point.map(|coordinate| (coordinate / cell).floor() as i32);
            let new = *number_of.entry(key).or_insert_with(|| {
                members.push(0.0);
                merged.points.push([0.0; 3]);
                merged.values.iter_mut().for_each(|list| list.push(0.0));
                members.len() as u32 - 1
            });
            let place = new as usize;
            members[place] += 1.0;
            // A running mean keeps the precision of single numbers.
            let share = 1.0 / members[place];
            for (mean, coordinate) in merged.points[place].iter_mut().zip(point) {
                *mean += share * (coordinate - *mean);
            }
            for (list, values) in merged.values.iter_mut().zip(&self.values) {
                list[place] += share * (values[index] - list[place]);
            }
            number.push(new);
        }
        let corners = self.triangles.iter().map(|triangle| triangle.map(|corner| number[corner as usize]));
        merged.triangles = corners.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        merged
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat square of 1 m with `count` cells of two triangles in each direction; the value of a point is its x.
    fn square(count: u32) -> Mesh {
        let side = count + 1;
        let points: Vec<[f32; 3]> = (0..side * side)
            .map(|i| [(i % side) as f32 / count as f32 - 0.001, (i / side) as f32 / count as f32 - 0.001, 0.5])
            .collect();
        let cell = |i: u32| i / count * side + i % count;
        let triangles = (0..count * count)
            .flat_map(|i| [[cell(i), cell(i) + 1, cell(i) + side], [cell(i) + 1, cell(i) + side + 1, cell(i) + side]]);
        Mesh { values: vec![points.iter().map(|p| p[0]).collect()], triangles: triangles.collect(), points }
    }

    fn area(mesh: &Mesh) -> f32 {
        let corners = |t: &[u32; 3]| t.map(|corner| glam::Vec3::from_array(mesh.points[corner as usize]));
        mesh.triangles.iter().map(corners).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum()
    }

    #[test]
    fn clusters_have_fewer_triangles_and_nearly_the_same_area() {
        let fine = square(40);
        let coarse = fine.clustered(0.1);
        assert!(coarse.triangles.len() < fine.triangles.len() / 10, "{}", coarse.triangles.len());
        // The outer points move inwards by about half a cell, which costs 10 % of each length.
        assert!((0.75..1.0).contains(&(area(&coarse) / area(&fine))), "{}", area(&coarse));
        assert!(coarse.points.iter().zip(&coarse.values[0]).all(|(point, value)| (point[0] - value).abs() < 1e-6));
    }

    #[test]
    fn a_filter_keeps_points_of_kept_triangles_only() {
        let left = square(10).filtered(|corners| corners.iter().all(|corner| corner[0] < 0.45));
        assert_eq!((left.triangles.len(), left.points.len()), (2 * 4 * 10, 5 * 11));
        assert!((area(&left) - 0.4).abs() < 1e-6);
        assert_eq!(left.values[0].len(), left.points.len());
    }
}
