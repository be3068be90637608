//! Where the time of a run went, for `--profile`.

use serde_json::{Value, json};

use crate::engine::Profile;
use crate::machine::Spent;

/// Seconds per step on the clock, and of the processor.
fn seconds_per_step(profile: &Profile, part: Spent) -> [f64; 2] {
    [part.clock, part.processor].map(|time| time.as_secs_f64() / profile.steps.max(1) as f64)
}

pub(super) fn to_text(profile: &Profile) -> String {
    let mut text = format!("seconds per step, mean of {} steps:\n", profile.steps);
    text += "  part      on the clock  of the processor, all threads";
    let mut sums = [0.0; 2];
    for &(name, part) in &profile.parts {
        let [clock, processor] = seconds_per_step(profile, part);
        sums = [sums[0] + clock, sums[1] + processor];
        text += &format!("\n  {name:<10}{clock:<14.3e}{processor:.3e}");
    }
    text + &format!("\n  {:<10}{:<14.3e}{:.3e}", "all", sums[0], sums[1])
}

pub(super) fn to_json(profile: &Profile) -> Value {
    let mut all = json!({ "steps": profile.steps });
    for &(name, part) in &profile.parts {
        let [clock, processor] = seconds_per_step(profile, part);
        all[format!("{name}_seconds_per_step")] = clock.into();
        all[format!("{name}_processor_seconds_per_step")] = processor.into();
    }
    all
}
