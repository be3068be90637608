//! Where the time of a run went, for `--profile`.

use std::time::Duration;

use serde_json::{Value, json};

use crate::engine::Profile;

/// The parts with their names, in the order of a step.
fn parts(profile: &Profile) -> [(&'static str, Duration); 5] {
    let times = profile.kernel;
    [
        ("fluid", times.fluid),
        ("forces", times.forces),
        ("grains", profile.grains),
        ("coverage", times.coverage),
        ("transfers", times.transfers),
    ]
}

fn seconds_per_step(profile: &Profile, part: Duration) -> f64 {
    part.as_secs_f64() / profile.steps.max(1) as f64
}

pub(super) fn to_text(profile: &Profile) -> String {
    let mut text = format!("seconds per step, mean of {} steps:", profile.steps);
    for (name, part) in parts(profile) {
        text += &format!("\n  {name:<10}{:.3e}", seconds_per_step(profile, part));
    }
    text
}

pub(super) fn to_json(profile: &Profile) -> Value {
    let mut all = json!({ "steps": profile.steps });
    for (name, part) in parts(profile) {
        all[format!("{name}_seconds_per_step")] = seconds_per_step(profile, part).into();
    }
    all
}
