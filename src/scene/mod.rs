//! From a scene file to something that can be run.
//!
//! | file | what it does |
//! |---|---|
//! | `source.rs`, `path.rs` | the text, and where each key stands |
//! | `changes.rs` | `--set` |
//! | `edit.rs` | changes of the text that the program makes |
//! | `format.rs`, `format_grains.rs`, `format_bodies.rs`, `format_free.rs`, `format_initial.rs`, `format_lists.rs`, `format_run.rs`, `format_time.rs`, `format_voxels.rs` | the keys: names, types, and what they mean |
//! | `check/` | values that make sense, in lattice units |
//! | `initial.rs` | how the fluid starts |
//! | `shape.rs` | sections, keys and types as the schema has them |
//! | `strongest.rs` | values that change in time, at their largest |
//! | `hints.rs`, `synonyms.rs` | what to write instead |
//! | `trouble.rs` | the one message about what is wrong |
//! | `schema.rs` | the JSON schema |

mod changes;
pub mod check;
pub mod columns;
pub(crate) mod edit;
pub mod format;
pub mod format_bodies;
pub mod format_free;
pub mod format_grains;
pub mod format_initial;
pub mod format_lists;
pub mod format_run;
pub mod format_time;
pub mod format_voxels;
mod hints;
pub mod initial;
pub mod names;
mod path;
pub mod schema;
mod shape;
mod source;
mod strongest;
mod synonyms;
mod triple;
pub mod trouble;

use std::path::Path;

use psmrt_reference::lattice::viscosity;
use psmrt_reference::setup::Setup;

pub use changes::{differ, preset_changes};
pub use check::attachment::Attachment;
pub use check::checkpoint::Interval;
pub use check::free::FreePart;
pub use check::record_kinds::What;
pub use check::records::{OutputInterval, Record};
pub use check::stop::{Steady, Stop};
pub use format_run::{EngineKind, Precision};
pub use trouble::{SceneError, Trouble};

use crate::bodies::moving::MovingBody;
use crate::exact::PlanePoiseuille;
use crate::in_time::Drives;
use crate::units::Units;
use crate::{input, quote};
use check::hardness::Around;
use format_grains::OperatorName;
use initial::{CellsAtStart, Initial};
use source::Source;

/// Bytes that a scene file may have: grains by the million stand in lists beside it.
const LARGEST: u64 = 16 * input::MIB;

/// A scene that has been checked: what to compute, record and compare.
#[derive(Clone, Debug)]
pub struct Scene {
    /// One line that says what it shows; empty if there is none.
    pub title: String,
    /// Its text, with the changes of `--set`: what a run repeats it from.
    pub text: String,
    /// The files that it names.
    pub attachments: Vec<Attachment>,
    /// The scales.
    pub units: Units,
    /// The domain, the fluid and the solids in lattice units; free grains too, where they start.
    pub setup: Setup,
    /// Whether there is no fluid: the collision of the set-up is then one that nobody asks for.
    pub is_dry: bool,
    /// Whether `solid.operator` was not named, so that it was chosen.
    pub operator_is_chosen: bool,
    /// How the grains move, if some are free.
    pub free: Option<FreePart>,
    /// Bodies that move as prescribed.
    pub moving_bodies: Vec<MovingBody>,
    /// What changes in time, if anything does; the set-up and `free` have the values of the first step.
    pub drives: Option<Drives>,
    /// How the fluid starts.
    pub initial: Initial,
    /// `time.reference_velocity`, if it is given, m/s.
    pub si_reference_velocity: Option<f64>,
    /// When to save the state.
    pub checkpoint: Interval,
    /// Whether the last state is kept.
    pub keeps_last_state: bool,
    /// What to record.
    pub records: Vec<Record>,
    /// When to stop.
    pub stop: Stop,
    /// The exact solution to compare with.
    pub exact: Option<PlanePoiseuille>,
    /// What is to compute it.
    pub engine: EngineKind,
    /// The precision that is asked for, if one is.
    pub precision: Option<Precision>,
    /// A part of the name of the adapter that is to be used, if one is named.
    pub adapter: Option<String>,
}

/// The value of a key of a document, if it is there.
pub fn find_mut<'a>(root: &'a mut toml_edit::Item, key: &str) -> Option<&'a mut toml_edit::Item> {
    path::Path::parse(key)?.walk_mut(root)
}

impl Scene {
    /// Reads and checks a scene file, after the changes `key=value` of `--set`.
    pub fn load(path: &Path, changes: &[String]) -> Result<Self, Box<SceneError>> {
        let name = quote::path(path);
        let bytes = input::read(path, LARGEST).map_err(|error| {
            let remedy = "give the name of a scene file, for example golden/poiseuille/scene.toml";
            SceneError::whole_file(&name, error.to_string(), remedy)
        })?;
        Self::from_bytes(&name, bytes, path.parent().unwrap_or(Path::new("")), changes)
    }

    /// The same from a file's contents; `name` is what messages call it, and the files that it
    /// names are looked for in `folder`.
    pub fn from_bytes(
        name: &str,
        bytes: Vec<u8>,
        folder: &Path,
        changes: &[String],
    ) -> Result<Self, Box<SceneError>> {
        let source = Source::new(name, bytes, changes)?;
        let file = source.read()?;
        let scene = check::scene(&file, folder).map_err(|trouble| source.error(trouble))?;
        Ok(Scene { text: source.text, ..scene })
    }

    /// What is around the grains.
    pub(crate) fn around(&self) -> Around {
        match self.is_dry {
            true => Around::Nothing,
            false => Around::Fluid { nu: viscosity(self.setup.collision.tau()) },
        }
    }

    /// What a step computes anew: the cells of the fluid, or the grains where there is none.
    pub fn updates_per_step(&self) -> u64 {
        match &self.free {
            Some(part) if self.is_dry => part.grains.len() as u64,
            _ => self.setup.domain.cell_count() as u64,
        }
    }

    /// What such an update is called.
    pub fn update_name(&self) -> &'static str {
        if self.is_dry { "grain steps" } else { "cell updates" }
    }

    /// The same scene as a run keeps it, so that it goes on with the same: its text names the copies of its
    /// files ([`Attachment`]), and the `engine` that computes it where that was left open.
    pub fn as_run(self, engine: EngineKind) -> Result<Self, Box<SceneError>> {
        let copy = |file: &Attachment| format!("{}=\"{}\"", file.key, file.file_name);
        let mut changes: Vec<String> = self.attachments.iter().map(copy).collect();
        if let Some(phase) = self.setup.solid_phase.as_ref().filter(|_| self.operator_is_chosen) {
            // Named in what is kept, so that the run goes on with it whatever is chosen later.
            changes.push(format!("solid.operator=\"{}\"", OperatorName::of(phase.operator).word()));
        }
        if let Initial::Run(folder) | Initial::Cells(CellsAtStart { run: Some(folder), .. }) =
            &self.initial
        {
            let folder = toml_edit::Value::from(folder.display().to_string());
            changes.push(format!("initial.from={folder}"));
        }
        if self.engine != engine {
            changes.push(format!("engine.kind=\"{}\"", engine.word()));
        }
        let source = Source::new("scene.toml", self.text.into_bytes(), &changes)?;
        Ok(Scene { text: source.text, engine, ..self })
    }
}
