//! How long a scene takes, measured on its first steps.
//!
//! The clock of a busy machine tells what the others leave. Alone on it a scene needs at most the processor
//! time of its threads, and no longer than its fastest try took; the slowest answer is what all tries
//! together took on the clock now. A device works while the processor waits: there only the tries count.

use std::time::{Duration, Instant};

use crate::engine::Coupled;
use crate::machine::processor_time;
use crate::scene::Scene;

/// A few steps that were timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Try {
    /// Their number.
    pub steps: u64,
    /// Time on the clock.
    pub clock: Duration,
    /// Processor time of all threads, where that is known and counts.
    pub processor: Option<Duration>,
}

/// How fast a scene is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Seconds per step alone on the machine, and with what else it does now.
    pub seconds_per_step: [f64; 2],
    /// Cell updates per second, alone on the machine; steps of a grain without fluid.
    pub updates_per_second: f64,
    /// Seconds that all steps would take, alone and now.
    pub seconds: [f64; 2],
}

/// A try is at least so long: shorter ones measure the clock.
const SHORTEST: Duration = Duration::from_millis(10);

/// Measures how long the scene takes, by running its first steps for `budget`. `None` if they fail.
pub fn calibrate(scene: &Scene, engine: &mut Coupled, budget: Duration) -> Option<Pace> {
    // Shaders compile and memory is touched first at their first use, and a device still works when `step`
    // has returned: only what it is asked for then waits for it.
    let is_on_device = engine.adapter().is_some();
    if scene.stop.steps > 2 {
        engine.step(2).ok()?;
        if !scene.is_dry {
            engine.box_means();
        }
    }
    let (start, mut batch, mut tries) = (Instant::now(), 1, Vec::new());
    while (tries.is_empty() || start.elapsed() < budget) && engine.steps() < scene.stop.steps {
        let steps = batch.min(scene.stop.steps - engine.steps());
        let (clock, before) = (Instant::now(), processor_time());
        engine.step(steps).ok()?;
        if is_on_device {
            engine.box_means();
        }
        let clock = clock.elapsed();
        let after = if is_on_device { None } else { processor_time() };
        let processor = after.zip(before).map(|(after, before)| after.saturating_sub(before));
        tries.push(Try { steps, clock, processor });
        if clock < SHORTEST {
            batch *= 2;
        }
    }
    let seconds_per_step = seconds_per_step(&tries)?;
    let updates = scene.updates_per_step() as f64;
    Some(Pace {
        seconds_per_step,
        updates_per_second: updates / seconds_per_step[0],
        seconds: seconds_per_step.map(|seconds| seconds * scene.stop.steps as f64),
    })
}

/// Seconds per step alone on the machine and now, by tries; `None` without any.
pub fn seconds_per_step(tries: &[Try]) -> Option<[f64; 2]> {
    let all: f64 = tries.iter().map(|one| one.steps as f64).sum();
    let now = tries.iter().map(|one| one.clock.as_secs_f64()).sum::<f64>() / all;
    let processor: Option<Duration> = tries.iter().map(|one| one.processor).sum();
    // Tries below the shortest may have met a clock that did not move.
    let long = tries.iter().filter(|one| one.clock >= SHORTEST);
    let best = long.map(|one| one.clock.as_secs_f64() / one.steps as f64).reduce(f64::min);
    let alone = best.unwrap_or(now).min(processor.map_or(now, |time| time.as_secs_f64() / all));
    // A processor time of nothing is one that was not counted.
    (all > 0.0 && now > 0.0).then_some([if alone > 0.0 { alone } else { now }, now])
}
