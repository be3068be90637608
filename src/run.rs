//! The time loop: steps, records, checkpoints, and when to stop.

use std::io;
use std::path::Path;
use std::time::Instant;

use thiserror::Error;

use crate::checkpoint::{self, CheckpointError, Progress};
use crate::courses::Lookout;
use crate::engine::{Engine, EngineStop};
use crate::output::grain_means;
use crate::output::records::{Recorder, box_row, force_row};
use crate::scene::{Interval, Rhythm, Scene, Steady, What};
use crate::stopped_grain::{self, GrainStop};

/// A run that could not go on.
#[derive(Debug, Error)]
pub enum RunError {
    /// The guard has stopped it, a free grain cannot be moved, or the device has failed.
    #[error(transparent)]
    Stopped(#[from] EngineStop),
    /// A contact has not held a free grain, or a grain is nowhere.
    #[error(transparent)]
    Grain(#[from] Box<GrainStop>),
    /// The way of a prescribed sphere has ended.
    #[error("stopped: {said}\n  help: {remedy}")]
    Met {
        /// What it has run into.
        said: String,
        /// What to do.
        remedy: String,
    },
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
    /// It has made all the steps that the scene allows.
    Limit,
    /// It has become steady.
    Steady,
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
    /// `steps` have been made so far; `change` is the last relative change of the steady-state
    /// criterion, if there is one.
    fn watch(&mut self, steps: u64, change: Option<f64>) -> bool;
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
    let mut run = Run::begin(scene, folder, resumed, engine.steps())?;
    if resumed.is_none() {
        run.observe(engine)?;
    }
    let mut saved = Saved { step: engine.steps(), at: Instant::now() };
    let end = loop {
        let now = engine.steps();
        if run.quiet.as_ref().is_some_and(Quiet::is_met) {
            break End::Steady;
        }
        if now >= scene.stop.steps {
            break End::Limit;
        }
        let go_on = watcher.watch(now, run.quiet.as_ref().and_then(|quiet| quiet.change));
        if !go_on || saved.is_due(scene.checkpoint, now) {
            run.save(engine)?;
            saved = Saved { step: now, at: Instant::now() };
        }
        if !go_on {
            break End::Interrupted;
        }
        run.advance(engine)?;
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
    quiet: Option<Quiet>,
    lookout: Lookout,
}

impl<'a> Run<'a> {
    fn begin(
        scene: &'a Scene,
        folder: &'a Path,
        resumed: Option<&Progress>,
        start: u64,
    ) -> io::Result<Self> {
        let recorder = |(number, record)| match resumed {
            None => Recorder::create(record, folder),
            Some(progress) => {
                let length = progress.table_lengths.get(number).copied().unwrap_or(0);
                Recorder::reopen(record, folder, length)
            }
        };
        let recorders =
            scene.records.iter().enumerate().map(recorder).collect::<io::Result<Vec<_>>>()?;
        let quiet = scene.stop.steady.clone().map(|steady| Quiet::begin(steady, resumed));
        let lookout = Lookout::new(scene, start);
        Ok(Run { scene, folder, recorders, quiet, lookout })
    }

    /// Steps to the next event. Errors where the state breaks or a prescribed sphere's way ends: then
    /// nothing more is recorded.
    fn advance(&mut self, engine: &mut dyn Engine) -> Result<(), RunError> {
        let now = engine.steps();
        let event = self.next_event(now);
        let meeting = self.lookout.meeting_until(event, u64::MAX);
        let until = meeting.map_or(event, |meeting| meeting.step);
        if let Err(stop) = engine.step(until - now) {
            let grain = stopped_grain::explained(&stop, self.scene, engine);
            return Err(grain.map_or(RunError::Stopped(stop), |stop| Box::new(stop).into()));
        }
        match meeting {
            None => Ok(()),
            Some(meeting) => Err(RunError::Met {
                said: meeting.said(self.scene),
                remedy: meeting.remedy(self.scene),
            }),
        }
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
        if let Some(quiet) = &mut self.quiet {
            quiet.look(self.scene, engine);
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
            quiet_rows: self.quiet.as_ref().map_or(0, |quiet| quiet.rows),
            last_value_bits: self.quiet.as_ref().and_then(|q| Some(q.last?.to_bits())),
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

/// Rows in a row that must be quiet.
const QUIET_ROWS: u32 = 3;

/// Watches one column of one record.
struct Quiet {
    steady: Steady,
    last: Option<f64>,
    rows: u32,
    change: Option<f64>,
}

impl Quiet {
    fn begin(steady: Steady, resumed: Option<&Progress>) -> Self {
        let last = resumed.and_then(|progress| progress.last_value_bits).map(f64::from_bits);
        let rows = resumed.map_or(0, |progress| progress.quiet_rows);
        Quiet { steady, last, rows, change: None }
    }

    /// Looks at the column if its record is due.
    fn look(&mut self, scene: &Scene, engine: &dyn Engine) {
        if !scene.records[self.steady.record].rhythm.is_due(engine.steps()) {
            return;
        }
        let value = match scene.records[self.steady.record].what {
            What::GrainMeans => grain_means::row(scene, engine)[self.steady.column],
            What::Loads => force_row(scene, engine)[self.steady.column],
            _ => box_row(scene, engine)[self.steady.column],
        };
        // A value that is exactly zero says nothing: the flow has not begun, or has no such component.
        let change = |last: f64| (value != 0.0).then(|| (value - last).abs() / value.abs());
        self.change = self.last.and_then(change);
        let is_quiet = self.change.is_some_and(|change| change <= self.steady.tolerance);
        self.rows = if is_quiet { self.rows + 1 } else { 0 };
        self.last = Some(value);
    }

    fn is_met(&self) -> bool {
        self.rows >= QUIET_ROWS
    }
}
