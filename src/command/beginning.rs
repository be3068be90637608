//! A scene that starts from the state in which another run has ended: the fluid of that state, cell by cell.

use std::path::Path;

use serde_json::{Value, json};

use super::{CommandError, engine};
use crate::checkpoint;
use crate::engine::{Block, Coupled};
use crate::output::folder::RunFolder;
use crate::scene::check::initial::slow_enough;
use crate::scene::initial::{CellsAtStart, Initial};
use crate::scene::names::SCENE;
use crate::scene::{Scene, SceneError};
use crate::units::Units;

const KEY: &str = "initial.from";

/// The scene with the fluid of the run that it starts from, and what is to be said of that run; or as it is, if it starts
/// from none.
pub(super) fn with_fluid_of_run(
    scene: Scene,
    file: &Path,
) -> Result<(Scene, Option<Value>), CommandError> {
    let Initial::Run(folder) = &scene.initial else { return Ok((scene, None)) };
    let refused = |problem: String, remedy: &str| -> CommandError {
        let problem = format!("{KEY} = {}: {problem}", folder.display());
        SceneError::whole_file(&file.display().to_string(), problem, remedy).into()
    };
    let other_file = folder.join(SCENE);
    if !other_file.is_file() {
        let problem = format!("it is no folder of a run: it has no {SCENE}");
        return Err(refused(problem, "give the folder that `psmrt run` has named"));
    }
    let other = Scene::load(&other_file, &[])?;
    if other.is_dry {
        let problem = "that run had no fluid".to_owned();
        let remedy = "start from its grains: `file = \".../grains_at_end.csv\"` in [[grains]]";
        return Err(refused(problem, remedy));
    }
    let (own_cells, cells) = (scene.setup.domain.cells(), other.setup.domain.cells());
    let ratio = scene.units.si_dx / other.units.si_dx;
    if own_cells != cells || (ratio - 1.0).abs() > 1e-9 {
        let said = |[x, y, z]: [usize; 3], units: &Units| {
            format!("{x} x {y} x {z} cells of {:.6e} m", units.si_dx)
        };
        let problem = format!(
            "its domain has {}, this one {}",
            said(cells, &other.units),
            said(own_cells, &scene.units)
        );
        return Err(refused(problem, "give this scene the same `domain`"));
    }
    let run = RunFolder::open(folder)?;
    let states = checkpoint::list(folder)
        .map_err(|error| CommandError::Checkpoint { error, older: String::new() })?;
    let Some(state) = states.last() else {
        let problem = "it has no saved state".to_owned();
        return Err(refused(problem, "run that scene again without `checkpoint.at_end = false`"));
    };
    let mut engine = engine(&other, &other_file, false)?;
    checkpoint::load(state, &run, &other, &mut engine)
        .map_err(|error| CommandError::Checkpoint { error, older: String::new() })?;
    let origin = json!({
        "folder": folder.display().to_string(), "run": run.id(), "step": engine.steps(), "taken": "the fluid",
    });
    let cells = fluid_of(&engine, &other.units, &scene.units, folder);
    let start = Initial::Cells(cells);
    slow_enough(KEY, start.top_speed(), "the largest speed of that state", &scene.units)
        .map_err(|trouble| refused(trouble.problem, &trouble.remedy))?;
    Ok((Scene { initial: start, ..scene }, Some(origin)))
}

/// The fluid of an engine, from one set of lattice units to another.
fn fluid_of(engine: &Coupled, from: &Units, to: &Units, run: &Path) -> CellsAtStart {
    let domain = &engine.setup().domain;
    let (mut densities, mut velocities) = (Vec::new(), Vec::new());
    for z in 0..domain.cells()[2] {
        for cell in engine.cells(Block::plane(domain, z)) {
            densities.push(to.density_at(from.si_gauge_pressure(cell.density)));
            velocities.push(cell.velocity * (from.si_velocity() / to.si_velocity()));
        }
    }
    CellsAtStart {
        cells: domain.cells(),
        densities: Some(densities.into()),
        velocities: velocities.into(),
        run: Some(run.to_owned()),
    }
}
