//! The progress bar; plain lines where the output is not a terminal.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::say::tell;
use crate::run::Watcher;
use crate::scene::Scene;

/// Time between two lines where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// Shows how far a run is.
pub struct ProgressLine {
    bar: Option<ProgressBar>,
    quiet: bool,
    updates: u64,
    name: &'static str,
    limit: u64,
    start: Instant,
    start_steps: Option<u64>,
    last_line: Instant,
    interrupted: Arc<AtomicBool>,
}

impl ProgressLine {
    /// For a run of `scene`, saying nothing if `quiet`; `interrupted` becomes true when the user wants to stop it.
    pub fn new(scene: &Scene, quiet: bool, interrupted: Arc<AtomicBool>) -> Self {
        let limit = scene.stop.steps;
        let show = !quiet && std::io::stderr().is_terminal();
        let style = ProgressStyle::with_template(
            "{bar:30} {percent:>3} % of at most {len} steps  {msg}  {elapsed} so far, {eta} left",
        );
        let bar = style.ok().filter(|_| show).map(|style| {
            ProgressBar::with_draw_target(Some(limit), ProgressDrawTarget::stderr())
                .with_style(style)
        });
        let start = Instant::now();
        ProgressLine {
            bar,
            quiet,
            updates: scene.updates_per_step(),
            name: scene.update_name(),
            limit,
            start,
            start_steps: None,
            last_line: start,
            interrupted,
        }
    }
}

/// Takes the bar away.
impl Drop for ProgressLine {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Watcher for ProgressLine {
    fn watch(&mut self, steps: u64, left: Option<f64>) -> bool {
        let start_steps = *self.start_steps.get_or_insert(steps);
        let seconds = self.start.elapsed().as_secs_f64().max(1e-3);
        let rate = ((steps - start_steps) * self.updates) as f64 / seconds;
        let to_go = match left {
            Some(left) if left.is_finite() => format!(", {left:.1e} to go until steady"),
            Some(_) => ", not slowing down".to_owned(),
            None => String::new(),
        };
        let message = format!("{:.2} million {} a second{to_go}", rate / 1e6, self.name);
        if let Some(bar) = &self.bar {
            bar.set_position(steps);
            bar.set_message(message);
        } else if !self.quiet && self.last_line.elapsed() > LINE_EVERY {
            self.last_line = Instant::now();
            let left = ((self.limit - steps) * self.updates) as f64 / rate;
            tell(&format!(
                "step {steps} of at most {}: {message}, at most {left:.0} s left",
                self.limit
            ));
        }
        !self.interrupted.load(Ordering::Relaxed)
    }
}
