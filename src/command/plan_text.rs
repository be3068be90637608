//! How `psmrt plan` says what it has found.

use serde_json::{Value, json};

use super::check::duration;
use super::say::say;
use crate::plan::facts::{Facts, Limit};
use crate::plan::options::Way;
use crate::plan::predict::{Outside, percent};
use crate::scene::Scene;

/// A way in one line.
pub(super) fn words(way: &Way) -> String {
    let [nx, ny, nz] = way.cells;
    format!(
        "{nx} x {ny} x {nz} cells ({:.1} across), tau {}, {}, engine {}",
        way.resolution,
        way.tau,
        way.collision.title(),
        way.engine
    )
}

/// A way for scripts.
pub(super) fn to_json(way: &Way) -> Value {
    json!({
        "cells": way.cells, "dx_m": way.si_dx, "resolution": way.resolution, "tau": way.tau,
        "collision": way.collision.word(), "engine": way.engine, "lattice_velocity": way.velocity,
        "steps": way.steps, "error": way.error, "band": way.band, "seconds": way.seconds,
    })
}

/// Prints a plan with what is around it and behind it.
pub(super) fn print(
    scene: &Scene,
    facts: &Facts,
    wanted: f64,
    now: Result<&Way, &Outside>,
    best: &Way,
    alternatives: &[(String, Option<&Way>)],
    evidence: &[String],
) {
    if !scene.title.is_empty() {
        say(&format!("{}\n", crate::quote::lines(&scene.title)));
    }
    let across = match facts.limit {
        Limit::Grains { .. } => "cells across a grain",
        Limit::Plates { .. } | Limit::Duct { .. } => "cells between walls",
    };
    say(&format!(
        "  {:<21}{across:>21}{:>7}  {:<16}{:<11}{:>10}  {:<20}{:>9}",
        "", "tau", "collision", "engine", "error", "95 % lie within", "time"
    ));
    let line = |what: &str, way: Option<&Way>| match way {
        Some(way) => say(&format!(
            "  {what:<21}{:>21.1}{:>7}  {:<16}{:<11}{:>10}  {:<20}{:>9}",
            way.resolution,
            way.tau,
            way.collision.title(),
            way.engine,
            percent(way.error),
            format!("{} to {}", percent(way.band[0]), percent(way.band[1])),
            duration(way.seconds)
        )),
        None => say(&format!("  {what:<21}none within the evidence")),
    };
    match now {
        Ok(now) => line("as it is", Some(now)),
        Err(outside) => say(&format!("  {:<21}{}", "as it is", outside.why)),
    }
    line(&format!("plan for {}", percent(wanted)), Some(best));
    for (what, way) in alternatives {
        line(what, *way);
    }
    let [nx, ny, nz] = best.cells;
    say(&format!(
        "\nthe plan: dx = {:.4e} m, {nx} x {ny} x {nz} cells, tau = {}",
        best.si_dx, best.tau
    ));
    say(match facts.limit {
        Limit::Grains { .. } => {
            "error: of the settling velocity, or of the flow that a given force drives; times are upper limits"
        }
        Limit::Plates { .. } => "error: of the profile (relative L2); times are upper limits",
        Limit::Duct { .. } => "error: of the mean velocity; times are upper limits",
    });
    say("\nthe evidence");
    for line in evidence {
        say(&format!("  {line}"));
    }
}
