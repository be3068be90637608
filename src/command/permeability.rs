//! `psmrt permeability`: the permeability of a scene's bed along an axis or as a tensor, with the error that is
//! predicted of its grid, and by finer grids what an infinitely fine one would give.

use std::io::Write;
use std::path::PathBuf;

use serde_json::{Value as Json, json};

use super::conclusions::{in_words, laws_in_words, predicted, to_json};
use super::execute::{carried_out, held};
use super::permeability_runs::{
    Done, Grid, NAMES, Tensor, force_of_tensor, grids, same_grains, tensor, text,
};
use super::say::{say, tell};
use super::{CommandError, engine, kind_of, write};
use crate::convergence::{Convergence, convergence};
use crate::output::atomic;
use crate::output::folder::{RunFolder, scene_name};
use crate::output::records::{box_row, seepage_now};
use crate::run::End;
use crate::scene::check::permeability::through_bed;
use crate::scene::{Scene, What};

/// What `psmrt permeability` is asked for.
#[derive(Clone, Debug)]
pub struct PermeabilityRequest {
    /// The scene file.
    pub scene: PathBuf,
    /// Changes `key=value`.
    pub set: Vec<String>,
    /// Where the runs go.
    pub out: Option<PathBuf>,
    /// Whether the tensor is wanted.
    pub tensor: bool,
    /// How many times as fine the finest grid is.
    pub refine: Option<usize>,
    /// Whether to print one JSON object instead of text.
    pub json: bool,
}

/// Name of the file with the results.
const RESULTS: &str = "permeability.json";

/// Runs the scene along its axes and on its grids, and says how permeable its bed is.
pub fn permeability(request: &PermeabilityRequest) -> Result<(), CommandError> {
    let scene = Scene::load(&request.scene, &request.set)?;
    let refused = |why: String| {
        CommandError::Usage(format!("{}: no permeability: {why}", request.scene.display()))
    };
    let si_force = request.tensor.then(|| force_of_tensor(&scene)).transpose().map_err(refused)?;
    let axes = match si_force {
        Some(_) => vec![0, 1, 2],
        None => vec![axis_of(&scene).map_err(refused)?],
    };
    let all_grids = grids(scene.setup.domain.cells(), request.refine)?;
    // All are read before one is run.
    let mut scenes = Vec::new();
    for grid in &all_grids {
        for &axis in &axes {
            scenes.push((*grid, axis, one(request, &scene, (grid, axis), si_force)?));
        }
    }
    let name = format!("{}-permeability", scene_name(&request.scene));
    let folder = held(RunFolder::make(request.out.as_deref(), &name)?);
    let mut done = Vec::new();
    for (grid, axis, scene) in scenes {
        done.push(run(request, &folder, (grid, axis), scene)?);
    }
    let found = Found::of(&done, &axes, request.tensor);
    let facts = found.to_json(&done, &folder.path().display().to_string());
    write(&folder.path().join(RESULTS), |path| {
        atomic::write(path, |out| out.write_all(format!("{facts:#}\n").as_bytes()))
    })?;
    if request.json {
        say(&facts.to_string());
    } else {
        say(&found.to_text(&done));
        say(&format!("results in {}", folder.path().display()));
    }
    match done.iter().all(|run| run.is_steady) {
        true => Ok(()),
        false => Err(CommandError::NotSteady),
    }
}

/// The axis of the flow: that of a record of permeability, or the only one along which fluid flows.
fn axis_of(scene: &Scene) -> Result<usize, String> {
    let named = scene.records.iter().find_map(|record| match record.what {
        What::Permeability { axis, .. } => Some(axis),
        _ => None,
    });
    match named {
        Some(axis) => Ok(axis),
        None => match through_bed(&scene.setup, scene.free.as_ref(), &scene.units) {
            Ok((axis, _)) => Ok(axis),
            Err(trouble) => Err(format!("{}; {}", trouble.problem, trouble.remedy)),
        },
    }
}

/// The scene of one run.
fn one(
    request: &PermeabilityRequest,
    scene: &Scene,
    (grid, axis): (&Grid, usize),
    si_force: Option<f64>,
) -> Result<Scene, CommandError> {
    let text = text(scene, grid, axis, si_force)
        .map_err(|error| CommandError::Usage(format!("{}: {error}", request.scene.display())))?;
    let place = request.scene.parent().unwrap_or(std::path::Path::new(""));
    let name = request.scene.display().to_string();
    let made = Scene::from_bytes(&name, text.into_bytes(), place, &[])?;
    if !same_grains(scene, &made) {
        return Err(CommandError::Usage(format!(
            "{name}: on a grid {:.3} times as fine its grains lie elsewhere, so that grids cannot be compared; write them \
             down once with `psmrt pack` and read them as a list, or leave out --refine",
            grid.finer
        )));
    }
    Ok(made)
}

fn run(
    request: &PermeabilityRequest,
    folder: &RunFolder,
    (grid, axis): (Grid, usize),
    scene: Scene,
) -> Result<Done, CommandError> {
    let mut engine = engine(&scene, &request.scene, false)?;
    let scene = scene.as_run(kind_of(&engine))?;
    let label = format!("{}_{:.4}", NAMES[axis], grid.finer);
    let label = label.trim_end_matches('0').trim_end_matches('.').replace('.', "p");
    let own = held(RunFolder::make(Some(&folder.path().join(label)), "")?);
    write(own.path(), |_| own.keep(&scene))?;
    if !request.json {
        let [nx, ny, nz] = grid.cells;
        tell(&format!("along {} on {nx} x {ny} x {nz} cells", NAMES[axis]));
    }
    let end = carried_out(&scene, &mut engine, &own, None, request.json)?.end;
    let What::Permeability { axis, si_gravity } = scene.records[0].what else {
        return Err(CommandError::Usage("the record of permeability is missing".to_owned()));
    };
    let [_, x, y, z, _] = box_row(&scene, &engine);
    Ok(Done {
        axis,
        grid,
        seepage: seepage_now(&scene, &engine, (axis, si_gravity)),
        si_velocity: [x, y, z],
        is_steady: matches!(end, End::Steady { .. }),
        predicted: predicted(&scene),
        steps: engine.steps(),
        si_dx: scene.units.si_dx,
        folder: own.path().display().to_string(),
    })
}

/// What the runs have shown.
struct Found {
    /// The finest run of each axis, and how its grids converge.
    axes: Vec<(Done, Option<Convergence>)>,
    tensor: Option<Tensor>,
}

impl Found {
    fn of(done: &[Done], axes: &[usize], is_tensor: bool) -> Self {
        let of_axis = |&axis: &usize| {
            let own: Vec<&Done> = done.iter().filter(|run| run.axis == axis).collect();
            let grids: Vec<(f64, f64)> =
                own.iter().map(|run| (run.grid.finer, run.seepage.si_permeability())).collect();
            Some(((*own.last()?).clone(), convergence(&grids)))
        };
        let axes: Vec<_> = axes.iter().filter_map(of_axis).collect();
        let tensor = match &axes[..] {
            [x, y, z] if is_tensor => Some(tensor([&x.0, &y.0, &z.0])),
            _ => None,
        };
        Found { axes, tensor }
    }

    fn to_text(&self, done: &[Done]) -> String {
        let mut lines = vec![format!(
            "{:<6}{:<18}{:>10}{:>14}{:>11}{:>9}  ",
            "axis", "cells", "cells/d", "k (m2)", "Re", "steps"
        )];
        for run in done {
            let [nx, ny, nz] = run.grid.cells;
            let s = &run.seepage;
            lines.push(format!(
                "{:<6}{:<18}{:>10.2}{:>14.4e}{:>11.2e}{:>9}  {}",
                NAMES[run.axis],
                format!("{nx} x {ny} x {nz}"),
                run.cells_per_diameter(),
                s.si_permeability(),
                s.reynolds(),
                run.steps,
                if run.is_steady { "steady" } else { "NOT steady: let it run longer (stop.time)" }
            ));
        }
        for (run, convergence) in &self.axes {
            let s = &run.seepage;
            let k = s.si_permeability();
            lines.push(format!("\nalong {}: {}", NAMES[run.axis], in_words(s)));
            lines.push(format!(
                "  k/d2 = {:.4e}, porosity {:.4}, d = {:.4e} m, Re = {:.2e}",
                k / s.si_diameter.powi(2),
                s.porosity,
                s.si_diameter,
                s.reynolds()
            ));
            lines.push(format!("  laws: {}", laws_in_words(s)));
            lines.push(match run.predicted {
                Some([error, low, high]) => format!(
                    "  error predicted of this grid: {:+.1} % ({:+.1} to {:+.1} %): k between {:.3e} and {:.3e} m2",
                    100.0 * error,
                    100.0 * low,
                    100.0 * high,
                    k / (1.0 + high),
                    k / (1.0 + low)
                ),
                None => "  error of this grid: no prediction (psmrt plan says why)".to_owned(),
            });
            if let Some(found) = convergence {
                lines.push(format!(
                    "  three grids: observed order {:.2}, Richardson {:.4e} m2, GCI of the finest {:.2} %{}",
                    found.order,
                    found.extrapolated,
                    100.0 * found.gci,
                    if found.order < 1.0 {
                        "; an order below 1 is chance: trust the GCI rather than the extrapolation"
                    } else {
                        ""
                    }
                ));
            }
        }
        if let Some(tensor) = &self.tensor {
            lines.push("\ntensor (m2)".to_owned());
            for row in tensor.k.row_iter() {
                lines.push(format!("  {:>12.4e} {:>12.4e} {:>12.4e}", row[0], row[1], row[2]));
            }
            lines.push("principal values (m2) and their directions".to_owned());
            for (value, [x, y, z]) in tensor.principal {
                lines.push(format!("  {value:>12.4e}  ({x:+.3}, {y:+.3}, {z:+.3})"));
            }
            lines.push(format!("asymmetry {:.1e} of the largest", tensor.asymmetry));
        }
        lines.join("\n")
    }

    fn to_json(&self, done: &[Done], folder: &str) -> Json {
        let runs: Vec<Json> = done
            .iter()
            .map(|run| {
                let mut all = to_json(&run.seepage);
                all["axis"] = json!(NAMES[run.axis]);
                all["cells"] = json!(run.grid.cells);
                all["cells_per_diameter"] = json!(run.cells_per_diameter());
                all["steps"] = json!(run.steps);
                all["steady"] = json!(run.is_steady);
                all["predicted_error"] = json!(run.predicted);
                all["folder"] = json!(run.folder);
                all
            })
            .collect();
        let grids: Vec<Json> = self
            .axes
            .iter()
            .filter_map(|(run, found)| {
                let found = found.as_ref()?;
                Some(json!({
                    "axis": NAMES[run.axis], "order": found.order,
                    "richardson_m2": found.extrapolated, "gci": found.gci,
                }))
            })
            .collect();
        let tensor = self.tensor.as_ref().map(|tensor| {
            let rows: Vec<Vec<f64>> =
                tensor.k.row_iter().map(|row| row.iter().copied().collect()).collect();
            let principal: Vec<Json> = tensor
                .principal
                .iter()
                .map(|(value, direction)| json!({ "k_m2": value, "direction": direction }))
                .collect();
            json!({ "k_m2": rows, "principal": principal, "asymmetry": tensor.asymmetry })
        });
        json!({ "folder": folder, "runs": runs, "grids": grids, "tensor": tensor })
    }
}

/// Reads how many times as fine the finest grid is to be.
pub fn refinement(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(times) if (2..=8).contains(&times) => Ok(times),
        _ => Err(format!(
            "{} is no refinement: it must be a whole number from 2 to 8; 2 takes some 40 times as long as the scene's own grid",
            crate::quote::quoted(text)
        )),
    }
}
