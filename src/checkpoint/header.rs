//! What a checkpoint says about itself: which run, what that has read, how far it has come.

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use crate::engine::Coupled;
use crate::output::csv::Mark;
use crate::output::folder::RunFolder;
use crate::scene::{Scene, names};

/// What a checkpoint says about itself, and what the time loop needs to go on.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Header {
    /// Version of psmrt that wrote it.
    pub version: String,
    /// Engine that wrote it.
    pub engine: String,
    /// [`RunFolder::id`] of its run.
    pub run: String,
    /// What the run has read.
    pub inputs: Vec<InputFile>,
    /// XXH3 of what psmrt has made of that: grains that it generates, defaults.
    pub made: u64,
    /// Steps made.
    pub steps: u64,
    /// The time loop's own state.
    pub progress: Progress,
}

/// A file that a run has read.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct InputFile {
    /// Its name in the folder of the run.
    pub name: String,
    /// XXH3 of its bytes.
    pub hash: u64,
}

/// The time loop's own state.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Progress {
    /// What each record's table holds.
    pub tables: Vec<Mark>,
    /// What each record has summed since its last row (of averaged loads; of others nothing).
    #[serde(default)]
    pub sums: Vec<Vec<u64>>,
    /// What the steady-state criterion has seen, if there is one.
    pub steady: Option<SteadyWatch>,
}

impl Header {
    pub(super) fn new(
        folder: &RunFolder,
        scene: &Scene,
        engine: &Coupled,
        progress: Progress,
    ) -> Self {
        Header {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            engine: engine.name().to_owned(),
            run: folder.id().to_owned(),
            inputs: inputs(scene),
            made: made(scene),
            steps: engine.steps(),
            progress,
        }
    }

    /// What keeps a scene from going on from here, if something does.
    pub(super) fn obstacle(
        &self,
        folder: &RunFolder,
        scene: &Scene,
        engine: &Coupled,
    ) -> Option<String> {
        let again = "put it back as it was, or start a new run";
        for input in inputs(scene) {
            match self.inputs.iter().find(|known| known.name == input.name) {
                Some(known) if known.hash == input.hash => {}
                Some(_) => {
                    return Some(format!(
                        "does not fit: {} has been changed since it was written; {again}",
                        folder.path().join(&input.name).display()
                    ));
                }
                None => {
                    return Some(format!(
                        "does not fit: its run has read no {}; {again}",
                        folder.path().join(&input.name).display()
                    ));
                }
            }
        }
        if self.run != folder.id() {
            return Some(format!(
                "belongs to another run of this scene, whose tables are not in {}: resume it in its own \
                 folder",
                folder.path().display()
            ));
        }
        if self.engine != engine.name() {
            return Some(format!(
                "was written by the engine `{}`, and `{}` is to go on: set engine.kind = \"{}\" again",
                self.engine,
                engine.name(),
                self.engine
            ));
        }
        (self.made != made(scene)).then(|| {
            format!(
                "was written by psmrt {}, which made other grains or defaults of this scene than this \
                 psmrt ({}): resume with that one",
                self.version,
                env!("CARGO_PKG_VERSION")
            )
        })
    }
}

/// What a scene was read from.
fn inputs(scene: &Scene) -> Vec<InputFile> {
    let input = |name: String, bytes: &[u8]| InputFile { name, hash: xxh3_64(bytes) };
    let lists = scene.attachments.iter().map(|list| input(list.file_name.clone(), &list.bytes));
    lists.chain([input(names::SCENE.to_owned(), scene.text.as_bytes())]).collect()
}

/// A sum of what has been made of a scene, to the last bit of each number.
fn made(scene: &Scene) -> u64 {
    let Scene { setup, free, initial, records, stop, .. } = scene;
    let mut made = format!("{setup:?} {free:?} {initial:?} {records:?} {stop:?}");
    if let Some(drives) = &scene.drives {
        made.push_str(&format!(" {drives:?}"));
    }
    xxh3_64(made.as_bytes())
}

/// What a run knows of a value that is to become steady (`run/steady.rs`); values as their bits.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct SteadyWatch {
    /// Rows seen.
    pub rows: u64,
    /// Rows from one sample to the next.
    pub stride: u64,
    /// Value, least and most of each sample.
    pub samples: Vec<[u64; 3]>,
    /// The rows since the last sample.
    pub pending: Option<[u64; 3]>,
    /// Since which row the value has been within the tolerance.
    pub since: Option<u64>,
}
