//! `_velx` file of DualSPHysics' one-dimensional multi-layer piston (Altomare et al. 2015). Line 1 is `px:;x;py:;y`,
//! line 2 is `time;pz_0;...;vel_0;...`. Each further line has a time, the heights and the velocities, separated by `;`.
//! [`crate::waves::external::velx`] reads such files.

use std::io::{self, Write};

/// Velocities of the rows of a piston over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Velx {
    /// Position of the piston, x and y [m].
    pub position_m: [f64; 2],
    /// Times [s].
    pub times_s: Vec<f64>,
    /// Heights of the rows [m], one list per time.
    pub heights_m: Vec<Vec<f64>>,
    /// Velocities of the rows [m/s], one list per time.
    pub velocities_m_s: Vec<Vec<f64>>,
}

impl Velx {
    /// Writes the file.
    pub fn write(&self, mut out: impl Write) -> io::Result<()> {
        let rows = self.heights_m.first().map_or(0, Vec::len);
        let numbered = |name: &str| (0..rows).map(|k| format!(";{name}_{k}")).collect::<String>();
        writeln!(out, "px:;{};py:;{}", self.position_m[0], self.position_m[1])?;
        writeln!(out, "time{}{}", numbered("pz"), numbered("vel"))?;
        for ((time, heights), velocities) in self.times_s.iter().zip(&self.heights_m).zip(&self.velocities_m_s) {
            let values: String = heights.iter().chain(velocities).map(|value| format!(";{value}")).collect();
            writeln!(out, "{time}{values}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_has_two_lines_of_names_and_one_line_per_time() {
        let velx = Velx {
            position_m: [36.5, 0.0],
            times_s: vec![0.0, 0.02],
            heights_m: vec![vec![0.6, 0.605]; 2],
            velocities_m_s: vec![vec![0.0, 0.1], vec![0.2, 0.25]],
        };
        let mut file = Vec::new();
        velx.write(&mut file).unwrap();
        assert_eq!(
            String::from_utf8(file).unwrap(),
            "px:;36.5;py:;0\ntime;pz_0;pz_1;vel_0;vel_1\n0;0.6;0.605;0;0.1\n0.02;0.6;0.605;0.2;0.25\n"
        );
    }
}
