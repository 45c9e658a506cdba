//! Computing time of a run, and the machine that made the run.

use serde::{Deserialize, Serialize};
use sysinfo::{CpuRefreshKind, System};

/// Computing time and machine. If a case is run twice, the two summaries differ only in these keys.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Execution {
    /// Wall-clock time of all sessions of the run [s]; in a dry test, of the last session only.
    pub wall_s: f64,
    /// Part of `wall_s` in which the run computed, copied or waited for tables, snapshots and checkpoints [s]; another
    /// thread writes the files meanwhile. `None` in runs that do not measure it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outputs_s: Option<f64>,
    /// Time steps per second of wall-clock time [1/s].
    pub steps_per_s: f64,
    /// Number of threads of the solver.
    pub threads: usize,
    /// Device that computed the water; `None` in runs without water.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// Processor of the last session; `None` in older files, or if the system does not report the processor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub processor: Option<String>,
}

impl Execution {
    /// Creates the record of a run on this machine with `steps` time steps in `wall` seconds; `device` computed the
    /// water.
    pub fn here(wall: f64, steps: f64, device: Option<&str>) -> Self {
        Self {
            wall_s: wall,
            outputs_s: None,
            steps_per_s: steps / wall.max(1e-9),
            threads: rayon::current_num_threads(),
            device: device.map(str::to_owned),
            processor: processor(),
        }
    }
}

/// Returns the name of the processor that the system reports, with the number of hardware threads in brackets.
fn processor() -> Option<String> {
    let mut system = System::new();
    system.refresh_cpu_list(CpuRefreshKind::nothing());
    let (name, count) = (system.cpus().first()?.brand().trim(), system.cpus().len());
    (!name.is_empty()).then(|| format!("{name} ({count})"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn execution_records_speed_device_and_processor() {
        let execution = Execution::here(4.0, 10.0, Some("CPU"));
        assert_eq!((execution.wall_s, execution.steps_per_s, execution.device.as_deref()), (4.0, 2.5, Some("CPU")));
        assert_eq!(execution.threads, rayon::current_num_threads());
        // Not every system reports its processor. A reported name ends with the thread count in brackets.
        assert!(execution.processor.is_none_or(|name| name.ends_with(')') && name.len() > 3));
    }

    #[test]
    fn a_run_without_steps_has_zero_speed() {
        assert_eq!(Execution::here(0.0, 0.0, None).steps_per_s, 0.0);
    }
}
