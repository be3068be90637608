//! `psmrt sweep`: a scene with each combination of some values, a run each, and one table of what they have shown.
//!
//! A sweep that was interrupted is given again: runs that have finished are read from their folders, others go on. With
//! more values it grows.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value as Json, json};

use super::beginning::with_fluid_of_run;
use super::conclusions::conclusions;
use super::execute::{carried_out, held};
use super::go_on::keep_origin;
use super::resume::{finished, where_it_goes_on};
use super::say::{say, tell};
use super::sweep_plan::{Axis, Planned, combinations};
use super::{CommandError, engine, kind_of, write};
use crate::output::atomic;
use crate::output::folder::{RunFolder, scene_name};
use crate::scene::names::SCENE;
use crate::scene::{self, Attachment, EngineKind, Scene};
use crate::table::Table;

/// What `psmrt sweep` is asked for.
#[derive(Clone, Debug)]
pub struct SweepRequest {
    /// The scene file.
    pub scene: PathBuf,
    /// Changes `key=value` of all runs.
    pub set: Vec<String>,
    /// What varies, each `key=value,value,...`.
    pub over: Vec<String>,
    /// Where the runs go; a sweep that lies there goes on.
    pub out: Option<PathBuf>,
    /// Whether to print one JSON object instead of text.
    pub json: bool,
}

/// The table of all runs; a folder that has one is that of a sweep.
const TABLE: &str = "sweep.csv";

/// Columns that every run has, after the keys that vary.
const FIRST: [&str; 5] = ["state", "trouble", "steps", "time (s)", "computing (s)"];

/// Runs the scene with all combinations of the values.
pub fn sweep(request: &SweepRequest) -> Result<(), CommandError> {
    let axes = request.over.iter().map(|text| Axis::parse(text)).collect::<Result<Vec<_>, _>>()?;
    let all = combinations(&axes)?;
    let given: Vec<String> = axes.iter().map(|axis| format!("{}=", axis.key)).collect();
    scene::differ(&[&request.set[..], &given].concat())?;
    // All are read, and those that are there looked at, before one is run or the table is touched.
    for planned in &all {
        let scene = load(request, planned, &axes)?;
        let path = request.out.as_ref().map(|out| out.join(&planned.name));
        if let Some(path) = path.filter(|path| path.join(SCENE).is_file()) {
            check_is_of(&path, &scene, &request.scene)?;
        }
    }
    let folder = held(match &request.out {
        Some(out) if out.join(TABLE).is_file() => RunFolder::open(out)?,
        out => RunFolder::make(out.as_deref(), &format!("{}-sweep", scene_name(&request.scene)))?,
    });
    let mut done: Vec<Done> = Vec::new();
    if !folder.path().join(TABLE).exists() {
        write_table(&folder, &axes, &done)?;
    }
    for (number, planned) in all.iter().enumerate() {
        if !request.json {
            let changes = planned.changes(&axes).join(", ");
            tell(&format!("run {} of {}: {changes}", number + 1, all.len()));
        }
        let run = match one(request, &axes, planned, &folder) {
            Ok(run) => run,
            // What a run finds out about itself is a result of the sweep.
            Err(CommandError::Run(error)) => {
                tell(&format!("{}: {error}", planned.name));
                Done {
                    facts: json!({ "state": "failed" }),
                    trouble: error.to_string(),
                    ..Done::of(planned)
                }
            }
            Err(CommandError::Interrupted { .. }) => {
                return Err(CommandError::SweepInterrupted {
                    folder: folder.path().display().to_string(),
                });
            }
            Err(error) => return Err(error),
        };
        done.push(run);
        write_table(&folder, &axes, &done)?;
    }
    let failed = done.iter().filter(|run| run.facts["finished"] != true).count();
    let table = folder.path().join(TABLE).display().to_string();
    if request.json {
        let runs: Vec<Json> = done.iter().map(|run| run.to_json(&axes)).collect();
        say(
            &json!({ "folder": folder.path().display().to_string(), "table": table, "runs": runs })
                .to_string(),
        );
    } else {
        say(&format!("{} runs, {failed} of them failed; table in {table}", done.len()));
    }
    match failed {
        0 => Ok(()),
        _ => Err(CommandError::SweepFailed { failed, of: done.len() }),
    }
}

/// The scene of one run.
fn load(request: &SweepRequest, planned: &Planned, axes: &[Axis]) -> Result<Scene, CommandError> {
    Ok(Scene::load(&request.scene, &[&request.set[..], &planned.changes(axes)].concat())?)
}

/// A run that has ended.
struct Done {
    name: String,
    values: Vec<String>,
    /// What its `run.json` says.
    facts: Json,
    trouble: String,
}

impl Done {
    fn of(planned: &Planned) -> Self {
        let Planned { name, values } = planned.clone();
        Done { name, values, facts: Json::Null, trouble: String::new() }
    }

    fn to_json(&self, axes: &[Axis]) -> Json {
        let keys = axes.iter().map(|axis| axis.key.clone());
        let changes: Map<String, Json> =
            keys.zip(self.values.iter().map(|value| json!(value))).collect();
        json!({ "folder": self.name, "changes": changes, "trouble": self.trouble, "run": self.facts })
    }

    /// What the run has shown, number by number, each called after what it belongs to.
    fn found(&self) -> Vec<(String, String)> {
        let mut found = Vec::new();
        for conclusion in self.facts["conclusions"].as_array().into_iter().flatten() {
            let what = conclusion["what"].as_str().unwrap_or_default();
            gather(what, conclusion, &mut found);
        }
        gather("", &self.facts["results"], &mut found);
        found
    }
}

/// The numbers in a value, called `name` and after their keys in it.
fn gather(name: &str, value: &Json, found: &mut Vec<(String, String)>) {
    let inner = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}.{key}") };
    match value {
        Json::Object(all) => all.iter().for_each(|(key, value)| gather(&inner(key), value, found)),
        Json::Array(all) => {
            all.iter()
                .enumerate()
                .for_each(|(i, value)| gather(&inner(&i.to_string()), value, found));
        }
        Json::Number(number) => found.push((name.to_owned(), number.to_string())),
        Json::Null | Json::Bool(_) | Json::String(_) => {}
    }
}

/// Makes one run, or goes on with it, or reads what it has found if it has ended.
fn one(
    request: &SweepRequest,
    axes: &[Axis],
    planned: &Planned,
    sweep: &RunFolder,
) -> Result<Done, CommandError> {
    let path = sweep.path().join(&planned.name);
    let scene = load(request, planned, axes)?;
    let is_there = path.join(SCENE).is_file();
    if let Some(facts) = if is_there { finished(&path)? } else { None } {
        if !request.json {
            tell(&format!("{} has finished before", path.display()));
        }
        return Ok(Done { facts, ..Done::of(planned) });
    }
    let (scene, mut engine, own, progress) = if is_there {
        let scene = Scene::load(&path.join(SCENE), &[])?;
        let own = held(RunFolder::open(&path)?);
        let mut engine = engine(&scene, &request.scene, false)?;
        let progress = where_it_goes_on(None, &own, &scene, &mut engine)?;
        (scene, engine, own, progress)
    } else {
        let (scene, origin) = with_fluid_of_run(scene, &request.scene)?;
        let engine = engine(&scene, &request.scene, false)?;
        let scene = scene.as_run(kind_of(&engine))?;
        let own = held(RunFolder::make(Some(&path), "")?);
        if let Some(origin) = &origin {
            keep_origin(&own, origin)?;
        }
        write(own.path(), |_| own.keep(&scene))?;
        (scene, engine, own, None)
    };
    let ended = carried_out(&scene, &mut engine, &own, progress.as_ref(), request.json)?;
    if !request.json {
        say(&format!(
            "{} after {} steps",
            ended.facts["state"].as_str().unwrap_or("ended"),
            engine.steps()
        ));
        for found in conclusions(&scene, &engine, ended.end) {
            say(&found.text);
        }
    }
    // As they will be read when the sweep is given again.
    let facts = finished(&path)?.unwrap_or(ended.facts);
    Ok(Done { facts, ..Done::of(planned) })
}

/// Errors if the folder of a run holds that of another scene.
fn check_is_of(path: &Path, scene: &Scene, file: &Path) -> Result<(), CommandError> {
    if is_of(path, scene)? {
        return Ok(());
    }
    Err(CommandError::Usage(format!(
        "{} holds a run of another scene than {} is now: give another folder by --out, or remove it",
        path.display(),
        file.display()
    )))
}

/// Whether the folder of a run has kept this scene, with the same files.
fn is_of(path: &Path, scene: &Scene) -> Result<bool, CommandError> {
    let kept = Scene::load(&path.join(SCENE), &[])?;
    if scene.engine != kept.engine && scene.engine != EngineKind::Auto {
        return Ok(false);
    }
    let scene = scene.clone().as_run(kept.engine)?;
    let is_same = |(one, other): (&Attachment, &Attachment)| one.bytes == other.bytes;
    let files = scene.attachments.iter().zip(&kept.attachments);
    Ok(scene.text == kept.text
        && scene.attachments.len() == kept.attachments.len()
        && files.into_iter().all(is_same))
}

/// The table of the runs so far. A run has what it has shown; the rest of its row is empty.
fn write_table(folder: &RunFolder, axes: &[Axis], done: &[Done]) -> Result<(), CommandError> {
    let mut names: Vec<String> = Vec::new();
    let found: Vec<Vec<(String, String)>> = done.iter().map(Done::found).collect();
    for (name, _) in found.iter().flatten() {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    let keys = axes.iter().map(|axis| axis.key.clone());
    let first = FIRST.map(str::to_owned);
    let columns = keys.chain(["folder".to_owned()]).chain(first).chain(names.iter().cloned());
    let mut table = Table { columns: columns.collect(), rows: Vec::new() };
    for (run, found) in done.iter().zip(&found) {
        let number = |key: &str| match &run.facts[key] {
            Json::Number(number) => number.to_string(),
            _ => String::new(),
        };
        let time = run.facts["steps"].as_f64().zip(run.facts["dt_s"].as_f64());
        let mut row: Vec<String> =
            run.values.iter().map(|value| value.trim_matches('"').to_owned()).collect();
        row.extend([
            run.name.clone(),
            run.facts["state"].as_str().unwrap_or_default().to_owned(),
            run.trouble.replace('\n', " "),
            number("steps"),
            time.map_or_else(String::new, |(steps, dt)| format!("{:.9e}", steps * dt)),
            number("wall_seconds"),
        ]);
        let value = |name: &String| found.iter().find(|(known, _)| known == name);
        row.extend(
            names.iter().map(|name| value(name).map_or_else(String::new, |(_, v)| v.clone())),
        );
        table.add(row);
    }
    write(&folder.path().join(TABLE), |path| {
        atomic::write(path, |out| out.write_all(table.to_csv().as_bytes()))
    })
}
