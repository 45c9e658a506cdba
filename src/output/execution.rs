//! How long a run took, and on which machine.

use serde::{Deserialize, Serialize};
use sysinfo::{CpuRefreshKind, System};

/// Time and machine: the keys in which two runs of one case may differ.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Execution {
    /// Wall clock [s], all sessions of a resumed run together.
    pub wall_s: f64,
    /// Time steps a second of wall clock [1/s].
    pub steps_per_s: f64,
    /// Threads.
    pub threads: usize,
    /// What computed the water; none in runs without water.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// The processor that the run ended on; none if the system does not tell, or in older files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub processor: Option<String>,
}

impl Execution {
    /// Of `steps` in `wall` [s] on this machine, with the threads at hand; `device` is what computed the water.
    pub fn here(wall: f64, steps: f64, device: Option<&str>) -> Self {
        Self {
            wall_s: wall,
            steps_per_s: steps / wall.max(1e-9),
            threads: rayon::current_num_threads(),
            device: device.map(str::to_owned),
            processor: processor(),
        }
    }
}

/// Name of this machine's processor as the system says it, and how many of it (hardware threads) there are.
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
    fn a_run_says_how_fast_it_was_and_where() {
        let execution = Execution::here(4.0, 10.0, Some("CPU"));
        assert_eq!((execution.wall_s, execution.steps_per_s, execution.device.as_deref()), (4.0, 2.5, Some("CPU")));
        assert_eq!(execution.threads, rayon::current_num_threads());
        // Not every system names its processor; one that is named is counted.
        assert!(execution.processor.is_none_or(|name| name.ends_with(')') && name.len() > 3));
    }

    #[test]
    fn nothing_was_computed_in_no_time() {
        assert_eq!(Execution::here(0.0, 0.0, None).steps_per_s, 0.0);
    }
}
