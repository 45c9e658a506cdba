//! Table of the velocity along x over height and time at one position, which every reader returns. Its checks detect
//! wrong units, gaps, and files of a different position.

use std::path::Path;

use super::error::ExternalError;
use super::numbers::as_text;

/// An interval between two times that is longer than this number of median intervals is a gap. One lost row makes an
/// interval of 2 medians; a restart without its first output makes an interval of a few medians.
const GAP: f64 = 5.0;

/// Largest plausible velocity divided by sqrt(g d), where d is the still water depth [-]. This ratio stays below 2 in
/// breaking crests. If the ratio exceeds 3, the unit in the file is wrong.
const FASTEST: f64 = 3.0;

/// Largest allowed distance of a level from the water, relative to the still water depth [-]. It is not zero because
/// cells at the surface are partly filled, and an overturning crest is higher than a surface level computed from the
/// volume of water.
const OUTSIDE: f64 = 0.1;

/// Velocity along x over height and time at one position, from another program.
#[derive(Debug, Clone, PartialEq)]
pub struct VelocityTable {
    /// Times [s], strictly increasing.
    pub times_s: Vec<f64>,
    /// Surface level z at each time [m]; `None` if the file has no surface levels.
    pub surface_z_m: Option<Vec<f64>>,
    /// Levels z of the velocities, from the bed upwards [m], one list per time.
    pub heights_m: Vec<Vec<f64>>,
    /// Velocities along x at the levels `heights_m` [m/s], one list per time.
    pub velocities_m_s: Vec<Vec<f64>>,
}

/// Bed, still water and gravity at the position of a table, and the number of levels that the table must have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Bed level z [m].
    pub bed_z_m: f64,
    /// Still water level z [m].
    pub still_water_z_m: f64,
    /// Gravitational acceleration [m/s2], above zero.
    pub gravity_m_s2: f64,
    /// Required number of levels with velocities.
    pub layers: Layers,
}

/// Required number of levels with velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layers {
    /// At least two levels at every time.
    AtLeastTwo,
    /// One level is enough: a depth-averaged velocity.
    DepthAveraged,
}

impl Place {
    /// Still water depth [m].
    pub fn depth_m(&self) -> f64 {
        self.still_water_z_m - self.bed_z_m
    }

    /// Returns true if all levels z between `lowest` and `highest` [m] can be in the water, under a surface at the
    /// level z `surface` [m].
    pub(super) fn is_water(&self, [lowest, highest]: [f64; 2], surface: f64) -> bool {
        let margin = OUTSIDE * self.depth_m();
        lowest >= self.bed_z_m - margin && highest <= surface + margin
    }

    /// Highest plausible velocity [m/s].
    pub(super) fn fastest_m_s(&self) -> f64 {
        FASTEST * (self.gravity_m_s2 * self.depth_m()).sqrt()
    }

    /// Highest plausible surface level z [m].
    pub(super) fn highest_surface_m(&self) -> f64 {
        self.still_water_z_m + self.depth_m()
    }
}

impl VelocityTable {
    /// Returns the table read from `file` if its values are plausible at the position. Every reader calls this last.
    ///
    /// # Errors
    /// If times do not increase or have a gap, a value is not finite, or the surface is below the bed or more than one
    /// depth above still water. Also if there are too few levels, levels do not increase or are outside the water, or
    /// a velocity is too high for the depth.
    ///
    /// # Panics
    /// If the lists differ in shape, or the position has no water.
    pub fn checked(self, file: &Path, place: &Place) -> Result<Self, ExternalError> {
        let times = self.times_s.len();
        assert!(place.depth_m() > 0.0 && place.gravity_m_s2 > 0.0, "depth and gravity are positive");
        assert!(self.heights_m.len() == times && self.velocities_m_s.len() == times, "one list per time");
        assert!(self.surface_z_m.as_ref().is_none_or(|levels| levels.len() == times), "one level per time");
        check_times(file, &self.times_s)?;
        for i in 0..times {
            self.check_surface(i, file, place)?;
            self.check_heights(i, file, place)?;
            self.check_velocities(i, file, place)?;
        }
        Ok(self)
    }

    /// Velocity along x [m/s] at level z [m] and time t [s]: linear in height and time, constant outside the table.
    pub fn velocity_m_s(&self, z: f64, t: f64) -> f64 {
        let velocity = |i: usize| linear(&self.heights_m[i], &self.velocities_m_s[i], z);
        let after = self.times_s.partition_point(|&time| time <= t);
        if after == 0 {
            return velocity(0);
        }
        if after == self.times_s.len() {
            return velocity(after - 1);
        }
        let (t0, t1) = (self.times_s[after - 1], self.times_s[after]);
        let (u0, u1) = (velocity(after - 1), velocity(after));
        u0 + (u1 - u0) * (t - t0) / (t1 - t0)
    }

    /// Surface level z [m] at t [s], linear in time, constant outside the table; `None` if the file has no surface
    /// levels.
    pub fn surface_at_m(&self, t: f64) -> Option<f64> {
        self.surface_z_m.as_ref().map(|levels| linear(&self.times_s, levels, t))
    }

    /// Checks that the surface is above the bed and at most one depth above still water.
    fn check_surface(&self, i: usize, file: &Path, place: &Place) -> Result<(), ExternalError> {
        let Some(level) = self.surface_z_m.as_ref().map(|levels| levels[i]) else { return Ok(()) };
        let (bed, top) = (place.bed_z_m, place.highest_surface_m());
        if level > bed && level <= top {
            return Ok(());
        }
        Err(ExternalError::moment(
            file,
            self.times_s[i],
            format!(
                "the surface level z = {} m is not between the bed, {} m, and {} m",
                as_text(level),
                as_text(bed),
                as_text(top)
            ),
            "check the bed level, the still water level and the unit; the position must stay wet",
        ))
    }

    /// Checks that there are enough levels, and that the levels increase and are in the water.
    fn check_heights(&self, i: usize, file: &Path, place: &Place) -> Result<(), ExternalError> {
        let (t, heights) = (self.times_s[i], &self.heights_m[i]);
        let least = match place.layers {
            Layers::AtLeastTwo => 2,
            Layers::DepthAveraged => 1,
        };
        if heights.len() < least {
            return Err(ExternalError::TooFewLayers { file: file.to_owned(), time_s: t, layers: heights.len() });
        }
        if let Some(pair) = heights.windows(2).find(|pair| pair[1] <= pair[0]) {
            return Err(ExternalError::moment(
                file,
                t,
                format!("the level z = {} m is not above the previous level, {} m", as_text(pair[1]), as_text(pair[0])),
                "list every level once, from the bed upwards",
            ));
        }
        let surface = self.surface_z_m.as_ref().map_or(place.highest_surface_m(), |levels| levels[i]);
        match heights.iter().find(|&&z| !place.is_water([z, z], surface)) {
            None => Ok(()),
            Some(&z) => Err(ExternalError::moment(
                file,
                t,
                format!(
                    "the level z = {} m is not in the water, {} to {} m",
                    as_text(z),
                    as_text(place.bed_z_m),
                    as_text(surface)
                ),
                "check the origin of z (`origin_z_m`), the vertical axis and the unit; leave out samples in air",
            )),
        }
    }

    /// Checks that every level has a velocity that is plausible in this depth.
    fn check_velocities(&self, i: usize, file: &Path, place: &Place) -> Result<(), ExternalError> {
        let (t, heights, velocities) = (self.times_s[i], &self.heights_m[i], &self.velocities_m_s[i]);
        assert_eq!(heights.len(), velocities.len(), "one velocity per level");
        let (depth, limit) = (place.depth_m(), place.fastest_m_s());
        let Some((z, u)) = heights.iter().zip(velocities).find(|(_, u)| u.is_nan() || u.abs() > limit) else {
            return Ok(());
        };
        let problem = format!("the velocity at z = {} m is {}", as_text(*z), as_text(*u));
        Err(if u.is_finite() {
            ExternalError::moment(
                file,
                t,
                format!("{problem} m/s, above 3 sqrt(g d) = {} m/s in a depth of {} m", as_text(limit), as_text(depth)),
                "check the unit: velocities must be in m/s",
            )
        } else {
            let advice = "the run of the other program failed at this time; rerun it, or end the file before this time";
            ExternalError::moment(file, t, problem, advice)
        })
    }
}

/// Checks that there are at least two times, and that the times are finite, increasing and without gaps.
pub(super) fn check_times(file: &Path, times_s: &[f64]) -> Result<(), ExternalError> {
    if times_s.len() < 2 {
        return Err(ExternalError::file(
            file,
            format!("values at {} time(s); at least 2 are needed", times_s.len()),
            "write output for the whole duration of the run",
        ));
    }
    let mut intervals = Vec::with_capacity(times_s.len() - 1);
    for pair in times_s.windows(2) {
        let interval = pair[1] - pair[0];
        if !interval.is_finite() || interval <= 0.0 {
            return Err(ExternalError::file(
                file,
                format!("t = {} s follows t = {} s", as_text(pair[1]), as_text(pair[0])),
                "times must increase; write one position per file, and delete rows of an earlier run",
            ));
        }
        intervals.push(interval);
    }
    let median = median(&intervals);
    match intervals.iter().position(|&interval| interval > GAP * median) {
        None => Ok(()),
        Some(i) => Err(ExternalError::file(
            file,
            format!(
                "gap between t = {} s and {} s; the median interval is {} s",
                as_text(times_s[i]),
                as_text(times_s[i + 1]),
                as_text(median)
            ),
            "write the missing output, or end the file before the gap",
        )),
    }
}

/// Median of at least one value; the lower of the two middle values if their number is even.
pub(super) fn median(values: &[f64]) -> f64 {
    *values.to_vec().select_nth_unstable_by((values.len() - 1) / 2, f64::total_cmp).1
}

/// Value at x from `values` at increasing `xs`: linear between points, constant outside.
pub(super) fn linear(xs: &[f64], values: &[f64], x: f64) -> f64 {
    let right = xs.partition_point(|&p| p <= x);
    if right == 0 {
        return values[0];
    }
    if right == xs.len() {
        return values[right - 1];
    }
    let share = (x - xs[right - 1]) / (xs[right] - xs[right - 1]);
    values[right - 1] + share * (values[right] - values[right - 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACE: Place = Place { bed_z_m: 0.0, still_water_z_m: 1.0, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };

    /// Velocities at two levels, every 0.25 s.
    fn table(times: usize) -> VelocityTable {
        VelocityTable {
            times_s: (0..times).map(|i| 0.25 * i as f64).collect(),
            surface_z_m: None,
            heights_m: vec![vec![0.25, 0.75]; times],
            velocities_m_s: (0..times).map(|i| vec![0.1 * i as f64, 0.3 * i as f64]).collect(),
        }
    }

    fn message(table: VelocityTable) -> String {
        table.checked(Path::new("u.tbl"), &PLACE).unwrap_err().to_string()
    }

    #[test]
    fn velocity_is_linear_in_height_and_time_and_constant_beyond() {
        let table = table(5).checked(Path::new("u.tbl"), &PLACE).unwrap();
        assert!((table.velocity_m_s(0.5, 0.375) - 0.3).abs() < 1e-12);
        assert!((table.velocity_m_s(0.0, 0.375) - 0.15).abs() < 1e-12);
        assert!((table.velocity_m_s(2.0, 9.0) - 1.2).abs() < 1e-12);
        assert_eq!(table.velocity_m_s(0.25, -1.0), 0.0);
        assert_eq!(table.surface_at_m(0.25), None);
    }

    #[test]
    fn times_must_increase_without_gaps() {
        let mut gap = table(9);
        gap.times_s[8] = 3.25;
        assert_eq!(
            message(gap),
            "u.tbl: gap between t = 1.75 s and 3.25 s; the median interval is 0.25 s; write the missing output, \
             or end the file before the gap"
        );
        let mut back = table(4);
        back.times_s[2] = 0.125;
        assert_eq!(
            message(back),
            "u.tbl: t = 0.125 s follows t = 0.25 s; times must increase; write one position per file, and delete \
             rows of an earlier run"
        );
        assert!(message(table(1)).starts_with("u.tbl: values at 1 time(s); at least 2 are needed"));
    }

    #[test]
    fn velocities_must_be_in_metres_per_second() {
        let mut fast = table(4);
        fast.velocities_m_s[3][1] = 300.0;
        assert_eq!(
            message(fast),
            "u.tbl: at t = 0.75 s: the velocity at z = 0.75 m is 300 m/s, above 3 sqrt(g d) = 9.39628 m/s \
             in a depth of 1 m; check the unit: velocities must be in m/s"
        );
        let mut broken = table(4);
        broken.velocities_m_s[1][0] = f64::NAN;
        assert!(message(broken).starts_with("u.tbl: at t = 0.25 s: the velocity at z = 0.25 m is NaN; the run"));
    }

    #[test]
    fn levels_must_be_at_least_two_increasing_and_in_the_water() {
        let mut thin = table(4);
        (thin.heights_m[2], thin.velocities_m_s[2]) = (vec![0.5], vec![0.1]);
        assert_eq!(
            thin.clone().checked(Path::new("u.tbl"), &PLACE).unwrap_err(),
            ExternalError::TooFewLayers { file: "u.tbl".into(), time_s: 0.5, layers: 1 }
        );
        assert!(thin.checked(Path::new("u.tbl"), &Place { layers: Layers::DepthAveraged, ..PLACE }).is_ok());
        let mut air = table(4);
        air.surface_z_m = Some(vec![0.6; 4]);
        assert!(message(air).contains("the level z = 0.75 m is not in the water, 0 to 0.6 m; check the origin"));
        let mut twice = table(4);
        twice.heights_m[0] = vec![0.5, 0.5];
        assert!(message(twice).contains("the level z = 0.5 m is not above the previous level, 0.5 m"));
        let mut dry = table(4);
        dry.surface_z_m = Some(vec![1.0, -98.0, 1.0, 1.0]);
        assert!(message(dry).contains("the surface level z = -98 m is not between the bed, 0 m, and 2 m"));
    }
}
