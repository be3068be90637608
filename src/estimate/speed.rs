//! How long a scene takes, measured on its first steps.

use std::time::{Duration, Instant};

use crate::engine::Engine;
use crate::scene::Scene;

/// Measures how long the scene takes, by running its first steps for `budget`: cell updates per
/// second, and the seconds that all steps would take.
pub fn calibrate(scene: &Scene, engine: &mut dyn Engine, budget: Duration) -> Option<[f64; 2]> {
    // Shaders compile at their first use, and a device still works when `step` has returned: only what
    // it is asked for then waits for it.
    let is_on_device = engine.adapter().is_some();
    if is_on_device && scene.stop.steps > 2 {
        engine.step(2).ok()?;
        engine.box_means();
    }
    let (start, first) = (Instant::now(), engine.steps());
    let mut batch = 1;
    while start.elapsed() < budget && engine.steps() < scene.stop.steps {
        engine.step(batch).ok()?;
        if is_on_device {
            engine.box_means();
        }
        batch = (2 * batch).min(scene.stop.steps - engine.steps()).max(1);
    }
    let per_second = (engine.steps() - first) as f64 / start.elapsed().as_secs_f64().max(1e-9);
    let cells = scene.setup.domain.cell_count() as f64;
    Some([per_second * cells, scene.stop.steps as f64 / per_second])
}
