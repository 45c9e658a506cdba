//! Progress of a run on the terminal.

use std::{
    io::{IsTerminal, Write},
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressStyle};

/// Interval between progress lines if standard error is not a terminal.
const LINE_INTERVAL: Duration = Duration::from_secs(30);

/// Progress display on standard error: a bar on a terminal, otherwise one line every 30 s.
pub struct Progress {
    bar: Option<ProgressBar>,
    duration: f64,
    begun: Instant,
    begun_at: f64,
    begun_steps: u64,
    last_line: Instant,
}

impl Progress {
    /// Starts the display. `time` [s] is the current simulated time, and `duration` [s] the simulated time at the end
    /// of the run; `steps` is the number of time steps so far.
    pub fn new(duration: f64, time: f64, steps: u64, quiet: bool) -> Self {
        let style =
            ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}").unwrap_or(ProgressStyle::default_bar());
        let on_terminal = std::io::stderr().is_terminal() && !quiet;
        Self {
            bar: on_terminal.then(|| ProgressBar::new(1000).with_style(style)),
            duration,
            begun: Instant::now(),
            begun_at: time,
            begun_steps: steps,
            // In quiet mode, this time in the far future prevents all progress lines.
            last_line: if quiet { Instant::now() + Duration::from_secs(u64::from(u32::MAX)) } else { Instant::now() },
        }
    }

    /// Shows the progress of the run: simulated time [s], number of time steps, and details.
    pub fn update(&mut self, time: f64, steps: u64, details: impl FnOnce() -> String) {
        if self.bar.is_none() && self.last_line.elapsed() < LINE_INTERVAL {
            return;
        }
        let wall = self.begun.elapsed().as_secs_f64();
        let rate = (steps - self.begun_steps) as f64 / wall.max(1e-9);
        let speed = (time - self.begun_at) / wall.max(1e-9);
        let left = readable((self.duration - time) / speed.max(1e-12));
        let elapsed = simulated(time, self.duration);
        let message = format!("{elapsed}, {rate:.1} steps/s, {left} left, {}", details());
        match &self.bar {
            Some(bar) => {
                bar.set_position((1000.0 * time / self.duration) as u64);
                bar.set_message(message);
            }
            None => {
                print_line(&message);
                self.last_line = Instant::now();
            }
        }
    }

    /// Shows a warning, also in quiet mode.
    pub fn warn(&self, warning: &str) {
        let show = || print_line(&format!("warning: {warning}"));
        match &self.bar {
            Some(bar) => bar.suspend(show),
            None => show(),
        }
    }

    /// Returns the wall-clock time since this process started or resumed the run [s].
    pub fn wall(&self) -> f64 {
        self.begun.elapsed().as_secs_f64()
    }

    /// Removes the progress bar.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Prints a line to the standard error. A run does not end because its progress cannot be shown, so a failure, for
/// example on a full disk, is ignored.
pub fn print_line(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Formats the simulated time and the duration of the run [s]; in milliseconds if the duration is shorter than 0.1 s.
fn simulated(time: f64, duration: f64) -> String {
    if duration < 0.1 {
        format!("{:.3} of {:.3} ms", time * 1e3, duration * 1e3)
    } else {
        format!("{time:.2} of {duration:.2} s")
    }
}

/// Formats a duration [s] in seconds, minutes, hours or days, depending on its size.
pub fn readable(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() => "unknown time".to_owned(),
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}
