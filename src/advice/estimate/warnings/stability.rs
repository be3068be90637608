//! Warnings of scenes beyond what the stability maps (`golden/stability`) found to be stable or accurate.

use psmrt_reference::collision::Preset;

use crate::advice::estimate::mapped::mapped;
use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;

/// What looks risky.
pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some((measured, flow, speed, source)) = mapped(scene) else { return Vec::new() };
    let (collision, tau) = (&scene.setup.collision, scene.setup.collision.tau());
    let Some(limit) = measured.limit(collision) else { return Vec::new() };
    let word = match limit.right.filter(|&right| speed > right && speed <= limit.lives) {
        _ if speed > limit.lives => format!("was stable only up to {}", limit.lives),
        Some(right) => {
            format!("was accurate only up to {right} (and stable up to {})", limit.lives)
        }
        None => return Vec::new(),
    };
    let reason = format!(
        "the velocity from {source} is {speed:.3} cells per time step; at tau = {tau:.4} {flow} with this \
         collision {word} (golden/stability)"
    );
    let other = measured.limit_of(Preset::DHumieres, tau).filter(|other| other.lives > limit.lives);
    let remedy = match other {
        Some(other) => format!(
            "use MRT with d'Humieres' rates (stable up to {}), a finer grid, or a smaller velocity",
            other.lives
        ),
        None => "use a finer grid, or a shorter time step with tau further from 1/2 (a higher viscosity), or \
                 a smaller velocity"
            .to_owned(),
    };
    vec![warning(reason, remedy)]
}
