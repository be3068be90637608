//! The time loop: steps, records, checkpoints, and when to stop.

pub mod steady;

use std::io;
use std::path::Path;
use std::time::Instant;

use thiserror::Error;

use crate::checkpoint::{self, CheckpointError, Progress};
use crate::engine::{Engine, EngineStop};
use crate::output::records::Recorder;
use crate::scene::{Interval, Rhythm, Scene};

/// A run that could not go on.
#[derive(Debug, Error)]
pub enum RunError {
    /// The guard has stopped it, a free grain cannot be moved, or the device has failed.
    #[error(transparent)]
    Stopped(#[from] EngineStop),
    /// Its results cannot be written.
    #[error("results cannot be written: {0}; what was written before is whole")]
    Write(#[from] io::Error),
    /// Its state cannot be saved.
    #[error("the checkpoint cannot be written: {0}; what was written before is whole")]
    Checkpoint(#[from] CheckpointError),
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// It has made all the steps that the scene allows, and nothing more was asked of it.
    Limit,
    /// It has become steady.
    Steady {
        /// What is still to go, see [`steady::History::left`].
        left: Option<f64>,
    },
    /// It has made all the steps that the scene allows and has not become steady.
    NotSteady {
        /// The same.
        left: Option<f64>,
    },
    /// The user has interrupted it; its state is saved.
    Interrupted,
}

/// Removes the tables that a run cut off before its first checkpoint has left, so that it can start
/// again. Errors if one cannot be removed.
pub fn forget_records(scene: &Scene, folder: &Path) -> io::Result<()> {
    for record in &scene.records {
        let table = folder.join(format!("{}.csv", record.name));
        if table.exists() {
            std::fs::remove_file(table)?;
        }
    }
    Ok(())
}

/// Who watches a run. Told after every batch of steps; answers whether to go on.
pub trait Watcher {
    /// `steps` have been made so far; `left` is what is still to go until the flow is steady, relative, if
    /// the scene has a criterion and that is known.
    fn watch(&mut self, steps: u64, left: Option<f64>) -> bool;
}

/// Steps between two calls of the watcher, at most: about so many cell updates.
const BATCH_UPDATES: u64 = 200_000;

/// Runs a scene to its end, with its results in `folder`: from the start, or from where the engine
/// and `resumed` say.
pub fn run(
    scene: &Scene,
    engine: &mut dyn Engine,
    folder: &Path,
    resumed: Option<&Progress>,
    watcher: &mut dyn Watcher,
) -> Result<End, RunError> {
    let mut run = Run::begin(scene, folder, resumed)?;
    if resumed.is_none() {
        run.observe(engine)?;
    }
    let mut saved = Saved { step: engine.steps(), at: Instant::now() };
    let end = loop {
        let now = engine.steps();
        let left = run.steady.as_ref().and_then(steady::Watch::left);
        if run.steady.as_ref().is_some_and(steady::Watch::is_met) {
            break End::Steady { left };
        }
        if now >= scene.stop.steps {
            break if run.steady.is_some() { End::NotSteady { left } } else { End::Limit };
        }
        let go_on = watcher.watch(now, left);
        if !go_on || saved.is_due(scene.checkpoint, now) {
            run.save(engine)?;
            saved = Saved { step: now, at: Instant::now() };
        }
        if !go_on {
            break End::Interrupted;
        }
        engine.step(run.next_event(now) - now)?;
        run.observe(engine)?;
        engine.still_works()?;
    };
    if end != End::Interrupted {
        run.finish(engine)?;
        engine.still_works()?;
    }
    Ok(end)
}

/// When the state was saved last.
struct Saved {
    step: u64,
    at: Instant,
}

impl Saved {
    fn is_due(&self, interval: Interval, now: u64) -> bool {
        match interval {
            Interval::Steps(steps) => now > self.step && now.is_multiple_of(steps),
            Interval::Time(time) => self.at.elapsed() >= time,
        }
    }
}

/// What a run keeps besides the engine.
struct Run<'a> {
    scene: &'a Scene,
    folder: &'a Path,
    recorders: Vec<Recorder>,
    steady: Option<steady::Watch>,
}

impl<'a> Run<'a> {
    fn begin(scene: &'a Scene, folder: &'a Path, resumed: Option<&Progress>) -> io::Result<Self> {
        let recorder = |(number, record)| match resumed {
            None => Recorder::create(record, folder),
            Some(progress) => {
                let length = progress.table_lengths.get(number).copied().unwrap_or(0);
                Recorder::reopen(record, folder, length)
            }
        };
        let recorders =
            scene.records.iter().enumerate().map(recorder).collect::<io::Result<Vec<_>>>()?;
        let steady = steady::Watch::begin(scene, resumed.and_then(|p| p.steady.as_ref()));
        Ok(Run { scene, folder, recorders, steady })
    }

    /// Takes the records that are due now. Errors if the state is broken: it is not written.
    fn observe(&mut self, engine: &mut dyn Engine) -> Result<(), RunError> {
        let now = engine.steps();
        if self.recorders.iter().any(|recorder| recorder.record.rhythm.is_due(now)) {
            engine.look()?;
        }
        for recorder in self.recorders.iter_mut().filter(|r| r.record.rhythm.is_due(now)) {
            recorder.take(self.scene, engine)?;
        }
        if let Some(steady) = &mut self.steady {
            steady.look(self.scene, engine);
        }
        Ok(())
    }

    /// The step at which something is due next, or the watcher should be told.
    fn next_event(&self, now: u64) -> u64 {
        let after = |interval: u64| (now / interval + 1).saturating_mul(interval);
        let records = self.scene.records.iter().filter_map(|record| match record.rhythm {
            Rhythm::Every(interval) => Some(after(interval)),
            Rhythm::AtEnd => None,
        });
        let checkpoint = match self.scene.checkpoint {
            Interval::Steps(interval) => after(interval),
            Interval::Time(_) => u64::MAX,
        };
        let batch = (BATCH_UPDATES / self.scene.setup.domain.cell_count() as u64).max(1);
        records.fold(checkpoint.min(now + batch).min(self.scene.stop.steps), u64::min)
    }

    /// Saves the state. Errors if it is broken: then the last one that was not is kept.
    fn save(&mut self, engine: &mut dyn Engine) -> Result<(), RunError> {
        engine.look()?;
        let lengths = self.recorders.iter_mut().map(Recorder::sync).collect::<io::Result<_>>()?;
        let progress = Progress {
            table_lengths: lengths,
            steady: self.steady.as_ref().map(steady::Watch::save),
        };
        checkpoint::save(self.folder, self.scene, engine, progress)?;
        Ok(())
    }

    /// Takes the records that are due at the end. Errors if the state is broken.
    fn finish(&mut self, engine: &mut dyn Engine) -> Result<(), RunError> {
        engine.look()?;
        for recorder in &mut self.recorders {
            if recorder.record.rhythm == Rhythm::AtEnd {
                recorder.take(self.scene, engine)?;
            }
            recorder.sync()?;
        }
        Ok(())
    }
}
