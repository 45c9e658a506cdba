//! `_velx` file of DualSPHysics' one-dimensional multi-layer piston (Altomare et al. 2015). Line 1 is `px:;x;py:;y`,
//! line 2 is `time;pz_0;...;vel_0;...`. Each further line has a time, the heights and the velocities, separated by `;`.

use std::io::{self, BufRead, Write};

use thiserror::Error;

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

/// Errors when a `_velx` file is read.
#[derive(Debug, Error)]
pub enum VelxError {
    /// The file cannot be read.
    #[error("velx: {0}")]
    Io(#[from] io::Error),
    /// A line is wrong.
    #[error("velx: line {line}: {problem}")]
    Line {
        /// Line number, from 1.
        line: usize,
        /// The problem.
        problem: String,
    },
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

    /// Reads a file.
    pub fn read(input: impl BufRead) -> Result<Self, VelxError> {
        let mut velx = Self { position_m: [0.0; 2], times_s: vec![], heights_m: vec![], velocities_m_s: vec![] };
        let mut rows = 0;
        for (index, text) in input.lines().enumerate() {
            let text = text?;
            let error = |problem: String| VelxError::Line { line: index + 1, problem };
            let fields: Vec<&str> = text.trim().split(';').map(str::trim).collect();
            let number = |field: &str| field.parse::<f64>().map_err(|_| error(format!("`{field}` is not a number")));
            match index {
                0 if fields.len() >= 4 && fields[0] == "px:" && fields[2] == "py:" => {
                    velx.position_m = [number(fields[1])?, number(fields[3])?];
                }
                0 => return Err(error("expected `px:;<x>;py:;<y>`".to_owned())),
                1 => rows = fields.iter().filter(|name| name.starts_with("pz")).count(),
                _ if text.trim().is_empty() => {}
                _ if fields.len() != 1 + 2 * rows => {
                    let (found, expected) = (fields.len(), 1 + 2 * rows);
                    return Err(error(format!(
                        "{found} fields, expected {expected}: \
                         time, {rows} height(s) `pz`, {rows} velocity value(s) `vel`"
                    )));
                }
                _ => {
                    let values = fields.iter().map(|field| number(field)).collect::<Result<Vec<f64>, _>>()?;
                    velx.times_s.push(values[0]);
                    velx.heights_m.push(values[1..=rows].to_vec());
                    velx.velocities_m_s.push(values[rows + 1..].to_vec());
                }
            }
        }
        Ok(velx)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn velx() -> Velx {
        Velx {
            position_m: [36.5, 0.0],
            times_s: vec![0.0, 0.02],
            heights_m: vec![vec![0.6, 0.605]; 2],
            velocities_m_s: vec![vec![0.0, 0.1], vec![0.2, 1.0 / 3.0]],
        }
    }

    #[test]
    fn written_file_is_read_back_unchanged() {
        let mut file = Vec::new();
        velx().write(&mut file).unwrap();
        let text = String::from_utf8(file.clone()).unwrap();
        assert!(text.starts_with("px:;36.5;py:;0\ntime;pz_0;pz_1;vel_0;vel_1\n0;0.6;0.605;0;0.1\n"));
        assert_eq!(Velx::read(file.as_slice()).unwrap(), velx());
    }

    #[test]
    fn error_names_the_wrong_line() {
        let message = |text: &str| Velx::read(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(message("x;1"), "velx: line 1: expected `px:;<x>;py:;<y>`");
        let head = "px:;1;py:;0\ntime;pz_0;vel_0\n";
        assert_eq!(
            message(&format!("{head}0;0.1")),
            "velx: line 3: 2 fields, expected 3: time, 1 height(s) `pz`, 1 velocity value(s) `vel`"
        );
        assert_eq!(message(&format!("{head}0;0.1;fast")), "velx: line 3: `fast` is not a number");
    }
}
