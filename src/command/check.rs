//! `psmrt check`: what a scene is, what it will cost and what may go wrong, before it runs.

use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::json;

use super::say::say;
use super::{CommandError, engine, kind_of};
use crate::advice::estimate::{calibrate, disk, models, numbers, warnings};
use crate::scene::Scene;

/// What `psmrt check` is asked for.
#[derive(Clone, Debug)]
pub struct CheckRequest {
    /// The scene file.
    pub scene: PathBuf,
    /// Changes `key=value`.
    pub set: Vec<String>,
    /// Whether to print one JSON object instead of text.
    pub json: bool,
}

/// How long the calibration takes.
const CALIBRATION: Duration = Duration::from_millis(500);

/// Checks a scene. Warnings are no errors.
pub fn check(request: &CheckRequest) -> Result<(), CommandError> {
    let scene = Scene::load(&request.scene, &request.set)?;
    let mut engine = engine(&scene, &request.scene, false)?;
    // What was left open is what a run would use.
    let scene = Scene { engine: kind_of(&engine), ..scene };
    let (numbers, models, mut warnings) = (numbers(&scene), models(&scene), warnings(&scene));
    // A run writes to a folder below this one, unless it is told otherwise.
    warnings.extend(disk::warnings(&scene, Path::new(".")));
    let speed = calibrate(&scene, &mut engine, CALIBRATION);
    if request.json {
        let updates = format!("{}_per_second", scene.update_name().replace(' ', "_"));
        let engines = speed.map(|pace| {
            json!([{
                "engine": engine.name(), updates: pace.updates_per_second,
                "seconds": pace.seconds[0], "seconds_as_busy_as_now": pace.seconds[1],
            }])
        });
        let all = json!({
            "numbers": numbers, "models": models, "warnings": warnings, "engines": engines,
        });
        say(&all.to_string());
        return Ok(());
    }
    if !scene.title.is_empty() {
        say(&format!("{}\n", crate::quote::lines(&scene.title)));
    }
    for number in &numbers {
        let value = format!("{} {}", figure(number.value), number.unit);
        say(format!("  {:<20}{value:<18}{}", number.name, number.note).trim_end());
    }
    match speed {
        Some(pace) => say(&format!(
            "  {:<20}{:<17} engine {}, {:.2} million {} a second alone on this machine",
            "time, at most",
            range(pace.seconds),
            engine.name(),
            pace.updates_per_second / 1e6,
            scene.update_name()
        )),
        None => say("  the first steps of the calibration failed: run it to see why"),
    }
    say("\nmodels that are on (what is absent costs nothing)");
    for model in &models {
        say(&format!("  {model}"));
    }
    for warning in &warnings {
        say(&format!("\nwarning: {}\n   help: {}", warning.reason, warning.remedy));
    }
    if warnings.is_empty() {
        say("\nno warnings");
    }
    Ok(())
}

/// The time that a scene takes alone on the machine, and as busy as that is now if it makes a difference.
fn range([alone, now]: [f64; 2]) -> String {
    if now < 1.3 * alone {
        return duration(now);
    }
    format!("{} to {}", duration(alone), duration(now))
}

/// A number with four figures.
fn figure(value: f64) -> String {
    if value == value.round() && value.abs() < 1e9 {
        format!("{value}")
    } else if (0.1..1e5).contains(&value.abs()) {
        format!("{value:.4}")
    } else {
        format!("{value:.4e}")
    }
}

/// Seconds in words.
pub(super) fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.1} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}
