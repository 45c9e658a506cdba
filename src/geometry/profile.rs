//! Bed and mound as a polyline z(x), uniform across the flume.

/// A bed profile: points with increasing x, linear between the points, level beyond the ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    points: Vec<[f64; 2]>,
}

impl Profile {
    /// Creates the profile through `points` [x, z] in metres.
    ///
    /// # Panics
    /// If there are fewer than two points or x does not increase strictly. The case validation checks both conditions
    /// first.
    pub fn new(points: Vec<[f64; 2]>) -> Self {
        assert!(points.len() >= 2, "a profile needs at least two points");
        assert!(points.windows(2).all(|w| w[1][0] > w[0][0]), "x of a profile must increase");
        Self { points }
    }

    /// Points [x, z] in metres.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Bed level z [m] at x [m].
    pub fn z(&self, x: f64) -> f64 {
        let points = &self.points;
        let last = points.len() - 1;
        if x <= points[0][0] {
            return points[0][1];
        }
        if x >= points[last][0] {
            return points[last][1];
        }
        let right = points.partition_point(|p| p[0] <= x).clamp(1, last);
        let ([x0, z0], [x1, z1]) = (points[right - 1], points[right]);
        z0 + (z1 - z0) * (x - x0) / (x1 - x0)
    }

    /// Slope dz/dx at x [-]; at a profile point, the slope of the segment to the right.
    pub fn slope(&self, x: f64) -> f64 {
        let points = &self.points;
        let last = points.len() - 1;
        if x < points[0][0] || x >= points[last][0] {
            return 0.0;
        }
        let right = points.partition_point(|p| p[0] <= x).clamp(1, last);
        let ([x0, z0], [x1, z1]) = (points[right - 1], points[right]);
        (z1 - z0) / (x1 - x0)
    }

    /// Returns the bed with a trapezoidal mound, and x of the two toes of the mound [m]. The crest lies between the two
    /// `crest_x` [m] at the level `crest_z` [m]; `run_per_rise` is the horizontal run of each slope per unit of rise.
    /// `None` if the crest lies below the bed, or a slope does not meet the bed inside the profile.
    pub fn with_mound(&self, crest_x: [f64; 2], crest_z: f64, run_per_rise: [f64; 2]) -> Option<(Self, [f64; 2])> {
        if self.z(crest_x[0]) >= crest_z || self.z(crest_x[1]) >= crest_z {
            return None;
        }
        let toe_seaward = self.flank_meets_bed(crest_x[0], crest_z, -run_per_rise[0])?;
        let toe_lee = self.flank_meets_bed(crest_x[1], crest_z, run_per_rise[1])?;
        let mut points: Vec<[f64; 2]> = self.points.iter().copied().filter(|p| p[0] < toe_seaward[0]).collect();
        points.extend([toe_seaward, [crest_x[0], crest_z], [crest_x[1], crest_z], toe_lee]);
        points.extend(self.points.iter().copied().filter(|p| p[0] > toe_lee[0]));
        Some((Self::new(points), [toe_seaward[0], toe_lee[0]]))
    }

    /// First point [m] where a slope that starts at (x, z) meets the bed; `run` is the signed horizontal run of the
    /// slope per unit of fall [-].
    fn flank_meets_bed(&self, x: f64, z: f64, run: f64) -> Option<[f64; 2]> {
        let crossing = |[xa, za]: [f64; 2], [xb, zb]: [f64; 2]| {
            // Height of the slope above the bed, linear along the segment.
            let above = |px: f64, pz: f64| z - (px - x) / run - pz;
            let (a, b) = (above(xa, za), above(xb, zb));
            let outside = |px: f64| (px - x) * run.signum() < 0.0;
            if a * b > 0.0 || (outside(xa) && outside(xb)) {
                return None;
            }
            let t = a / (a - b);
            let hit = [xa + t * (xb - xa), za + t * (zb - za)];
            ((hit[0] - x) * run.signum() > 0.0).then_some(hit)
        };
        let mut hits: Vec<[f64; 2]> = self.points.windows(2).filter_map(|w| crossing(w[0], w[1])).collect();
        hits.sort_by(|a, b| (a[0] - x).abs().total_cmp(&(b[0] - x).abs()));
        hits.first().copied()
    }

    /// Lowest and highest bed level between two x [m].
    pub fn extremes_between(&self, [x0, x1]: [f64; 2]) -> (f64, f64) {
        let corners = self.points().iter().filter(|p| p[0] > x0 && p[0] < x1).map(|p| p[1]);
        let levels = corners.chain([self.z(x0), self.z(x1)]);
        levels.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_and_slope_are_linear_between_points() {
        let bed = Profile::new(vec![[0.0, 0.0], [19.0, 0.0], [55.0, 1.2]]);
        assert_eq!(bed.z(10.0), 0.0);
        assert!((bed.z(39.0) - 20.0 / 30.0).abs() < 1e-12);
        assert!((bed.slope(39.0) - 1.0 / 30.0).abs() < 1e-12);
    }

    #[test]
    fn mound_slopes_meet_the_sloping_bed() {
        let bed = Profile::new(vec![[0.0, 0.0], [19.0, 0.0], [55.0, 1.2]]);
        let (with, toes) = bed.with_mound([38.84, 39.16], 0.717, [2.0, 2.0]).unwrap();
        assert_eq!(with.z(39.0), 0.717);
        let toe = with.points()[2];
        assert_eq!(toes, [toe[0], with.points()[5][0]]);
        assert!((toe[1] - bed.z(toe[0])).abs() < 1e-12);
        assert!(((38.84 - toe[0]) / (0.717 - toe[1]) - 2.0).abs() < 1e-9);
        assert!(bed.with_mound([38.84, 39.16], 0.5, [2.0, 2.0]).is_none());
    }
}
