//! Where cases run their scenes: on one engine, with cell updates counted; in folders that vanish, or,
//! at the full scale, in folders that are kept, so that a run can be cut off and goes on next time.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tempfile::TempDir;

use super::{Case, CaseError, Settled};
use psmrt::checkpoint;
use psmrt::engine::{self, Coupled, EngineName};
use psmrt::kernel::Gpu;
use psmrt::output::folder::RunFolder;
use psmrt::run::{End, Watcher, run, set_aside};
use psmrt::scene::Scene;
use psmrt::table::Table;

/// Runs scenes for cases.
pub struct Bench {
    golden: PathBuf,
    engine: EngineName,
    gpu: Option<Arc<Gpu>>,
    /// Told which scene runs, with its changes.
    tell: fn(&str),
    watcher: WatcherOf,
    /// Where runs are kept at the full scale.
    kept: Option<PathBuf>,
    cell_updates: u64,
    settled: Vec<Settled>,
    read: RefCell<BTreeSet<String>>,
}

/// Makes who watches a run of a scene.
pub type WatcherOf = Box<dyn Fn(&Scene) -> Box<dyn Watcher>>;

/// A scene that has been run to its end.
pub struct Finished {
    /// The scene.
    pub scene: Scene,
    /// The engine at the end.
    pub engine: Coupled,
    /// How steady it was, if it was run until it was.
    pub settled: Option<Settled>,
    folder: PathBuf,
    /// Removes the folder when it is dropped, unless runs are kept.
    _vanishing: Option<TempDir>,
}

impl Bench {
    /// On `engine`, with the device `gpu` where that needs one, and the files of the folder `golden`.
    pub fn new(golden: &Path, engine: EngineName, gpu: Option<Arc<Gpu>>, tell: fn(&str)) -> Self {
        Bench {
            golden: golden.to_owned(),
            engine,
            gpu,
            tell,
            watcher: Box::new(|_| Box::new(GoOn)),
            kept: None,
            cell_updates: 0,
            settled: Vec::new(),
            read: RefCell::default(),
        }
    }

    /// With each run watched by what `watcher` makes for its scene.
    #[must_use]
    pub fn watched(mut self, watcher: WatcherOf) -> Self {
        self.watcher = watcher;
        self
    }

    /// At the full scale, with the runs kept in `folder`: one that was cut off goes on from its newest
    /// checkpoint.
    #[must_use]
    pub fn at_full_scale(mut self, folder: &Path) -> Self {
        self.kept = Some(folder.join(self.engine_name().word()));
        self
    }

    /// Whether cases should run at their full scale.
    pub fn is_full(&self) -> bool {
        self.kept.is_some()
    }

    /// The engine.
    pub fn engine_name(&self) -> EngineName {
        self.engine
    }

    /// Cell updates so far.
    pub fn cell_updates(&self) -> u64 {
        self.cell_updates
    }

    /// The runs that have become steady, since they were last asked for.
    pub fn settled(&mut self) -> Vec<Settled> {
        std::mem::take(&mut self.settled)
    }

    /// A table of the folder of a case. Errors if it cannot be read.
    pub fn literature(&self, case: &str, file: &str) -> Result<Table, CaseError> {
        self.read.borrow_mut().insert(file.to_owned());
        Ok(Table::read(&self.golden.join(case).join(file))?)
    }

    /// The tables of a case's folder that were read, since they were last asked for.
    pub fn tables_read(&mut self) -> BTreeSet<String> {
        self.read.take()
    }

    /// Measures a case. Errors as [`Case::measure`] does.
    pub fn measure(&mut self, case: &Case) -> Result<Table, CaseError> {
        (case.measure)(self)
    }

    /// Runs a scene of `golden/`, with changes as `--set` takes them, until it is steady. Errors if it
    /// cannot be run or reaches its limit of time first.
    pub fn steady(&mut self, scene: &str, changes: &[String]) -> Result<Finished, CaseError> {
        let (mut finished, end) = self.run(scene, changes)?;
        let name = format!("{scene} {}", changes.join(" "));
        if matches!(end, End::Steady { .. }) {
            let settled = Settled::of(name, &finished)?;
            self.settled.push(settled.clone());
            finished.settled = Some(settled);
            return Ok(finished);
        }
        let left = if let End::NotSteady { left } = end { left } else { None };
        Err(not_steady(name, &finished, changes, left))
    }

    /// Runs a scene of `golden/` to whatever end it has. Errors if it cannot be run.
    pub fn run(&mut self, scene: &str, changes: &[String]) -> Result<(Finished, End), CaseError> {
        (self.tell)(&format!("{} on {}: {}", scene, self.engine_name().word(), changes.join(" ")));
        let scene = self.load(scene, changes)?;
        let engine = engine::open(self.engine_name(), &scene, self.gpu.as_ref(), false)?;
        self.run_on(scene, engine)
    }

    /// A scene of `golden/` with changes. Errors if it cannot be run.
    pub fn load(&self, scene: &str, changes: &[String]) -> Result<Scene, CaseError> {
        Ok(Scene::load(&self.golden.join(scene), changes)?)
    }

    /// Runs a scene on an engine of the caller's making to whatever end it has.
    pub fn run_on(
        &mut self,
        scene: Scene,
        mut engine: Coupled,
    ) -> Result<(Finished, End), CaseError> {
        let (folder, vanishing) = match &self.kept {
            Some(kept) => (kept.join(run_name(&scene)), None),
            None => {
                let folder = tempfile::tempdir()?;
                (folder.path().to_owned(), Some(folder))
            }
        };
        fs::create_dir_all(&folder)?;
        let held = RunFolder::open(&folder)?;
        let resumed = match checkpoint::list(&folder)?.last() {
            Some(newest) => Some(checkpoint::load(newest, &held, &scene, &mut engine)?),
            None => {
                set_aside(&scene, &held)?;
                None
            }
        };
        let first = engine.steps();
        let mut watcher = (self.watcher)(&scene);
        let end = run(&scene, &mut engine, &held, resumed.as_ref(), watcher.as_mut())?;
        if end == End::Interrupted {
            return Err(CaseError::Interrupted);
        }
        self.cell_updates += (engine.steps() - first) * scene.setup.domain.cell_count() as u64;
        let finished = Finished { scene, engine, settled: None, folder, _vanishing: vanishing };
        Ok((finished, end))
    }
}

impl Finished {
    /// The rows of one of its records.
    pub fn record(&self, name: &str) -> Result<Table, CaseError> {
        Ok(Table::read(&self.folder.join(format!("{name}.csv")))?)
    }
}

/// The error of a run that its limit has ended: what was still to go, and who sets the limit.
fn not_steady(
    scene: String,
    finished: &Finished,
    changes: &[String],
    left: Option<f64>,
) -> CaseError {
    let Some(steady) = &finished.scene.stop.steady else { return CaseError::NoCriterion(scene) };
    let key = limiting_key(&finished.scene);
    let is_ours = changes.iter().any(|change| change.starts_with(&format!("{key}=")));
    let whose = if is_ours {
        "that the case sets in its own code (tests/validation/src/cases)"
    } else {
        "of the scene file"
    };
    let limit = format!("the `{key}` {whose}");
    let to_go = match left {
        Some(left) if left.is_finite() => format!("has {left:.1e} of itself still to go"),
        Some(_) => "changes without slowing down".to_owned(),
        None => "has fewer than four rows after the first, or is zero".to_owned(),
    };
    CaseError::NotSteady {
        scene,
        steps: finished.engine.steps(),
        limit,
        column: steady.column_name(&finished.scene.records).to_owned(),
        to_go,
        tolerance: steady.tolerance,
    }
}

/// Which of the two limits of a scene, the smaller one, ends its run.
fn limiting_key(scene: &Scene) -> &'static str {
    let text: Option<toml_edit::DocumentMut> = scene.text.parse().ok();
    let steps = text.and_then(|text| text.get("stop")?.get("steps")?.as_integer());
    let is_steps = steps.and_then(|steps| u64::try_from(steps).ok()) == Some(scene.stop.steps);
    if is_steps { "stop.steps" } else { "stop.time" }
}

/// The folder of a run: the same for the same scene with the same changes.
fn run_name(scene: &Scene) -> String {
    format!("{:016x}", xxhash_rust::xxh3::xxh3_64(scene.text.as_bytes()))
}

/// Lets a run go on to its end.
struct GoOn;

impl Watcher for GoOn {
    fn watch(&mut self, _: u64, _: Option<f64>) -> bool {
        true
    }
}
