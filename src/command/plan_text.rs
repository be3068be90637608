//! How `psmrt plan` says what it has found.

use serde_json::{Value, json};

use super::check::duration;
use super::say::say;
use crate::advice::estimate::subject;
use crate::advice::plan::facts::{Facts, Limit};
use crate::advice::plan::options::PlanOption;
use crate::advice::plan::predict::{Outside, percent};
use crate::scene::Scene;

/// An option in one line.
pub(super) fn words(option: &PlanOption) -> String {
    let [nx, ny, nz] = option.cells;
    format!(
        "{nx} x {ny} x {nz} cells ({:.1} across), tau {}, {}, engine {}",
        option.resolution,
        option.tau,
        option.collision.title(),
        option.engine.word()
    )
}

/// An option for scripts.
pub(super) fn to_json(option: &PlanOption) -> Value {
    json!({
        "cells": option.cells, "dx_m": option.si_dx, "resolution": option.resolution, "tau": option.tau,
        "collision": option.collision.word(), "engine": option.engine.word(), "lattice_velocity": option.velocity,
        "steps": option.steps, "error": option.error, "band": option.band, "seconds": option.seconds,
    })
}

/// Prints a plan with what is around it and behind it.
pub(super) fn print(
    scene: &Scene,
    facts: &Facts,
    wanted: f64,
    now: Result<&PlanOption, &Outside>,
    best: &PlanOption,
    alternatives: &[(String, Option<&PlanOption>)],
    evidence: &[String],
) {
    if !scene.title.is_empty() {
        say(&format!("{}\n", crate::quote::lines(&scene.title)));
    }
    let across = match facts.limit {
        Limit::Grains { .. } => "cells across a grain",
        Limit::Plates { .. } | Limit::Shear { .. } | Limit::Duct { .. } => "cells between walls",
    };
    say(&format!(
        "  {:<21}{across:>21}{:>7}  {:<16}{:<11}{:>10}  {:<20}{:>9}",
        "", "tau", "collision", "engine", "error", "95 % lie within", "time"
    ));
    let line = |what: &str, option: Option<&PlanOption>| match option {
        Some(option) => say(&format!(
            "  {what:<21}{:>21.1}{:>7}  {:<16}{:<11}{:>10}  {:<20}{:>9}",
            option.resolution,
            option.tau,
            option.collision.title(),
            option.engine.word(),
            percent(option.error),
            format!("{} to {}", percent(option.band[0]), percent(option.band[1])),
            duration(option.seconds)
        )),
        None => say(&format!("  {what:<21}none within the evidence")),
    };
    match now {
        Ok(now) => line("as it is", Some(now)),
        Err(outside) => say(&format!("  {:<21}{}", "as it is", outside.why)),
    }
    line(&format!("plan for {}", percent(wanted)), Some(best));
    for (what, option) in alternatives {
        line(what, *option);
    }
    let [nx, ny, nz] = best.cells;
    let operator = match facts.limit {
        Limit::Grains { .. } => format!(", solid.operator = {}", best.solid.operator().word()),
        Limit::Plates { .. } | Limit::Shear { .. } | Limit::Duct { .. } => String::new(),
    };
    say(&format!(
        "\nthe plan: dx = {:.4e} m, {nx} x {ny} x {nz} cells, tau = {}{operator}",
        best.si_dx, best.tau
    ));
    say(&format!("error: of {}; times are upper limits", subject(scene, &facts.limit)));
    say("\nthe evidence");
    for line in evidence {
        say(&format!("  {line}"));
    }
}
