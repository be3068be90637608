//! The time loop: steps, records, checkpoints, and when to stop.
//!
//! No record or checkpoint holds a broken state: the loop checks the state before it writes, and the guard does besides,
//! every 16 steps.

mod end;
pub mod steady;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::checkpoint::{self, Progress};
use crate::courses::Lookout;
use crate::engine::Coupled;
use crate::output::folder::RunFolder;
use crate::output::load_means::LoadSums;
use crate::output::records::Recorder;
use crate::scene::names;
use crate::scene::{Interval, OutputInterval, Scene};
use crate::stopped_grain;

pub use end::{End, RunError};

/// Sets aside the tables that a run cut off before its first checkpoint has left, so that it can start
/// again: `box.csv` becomes `box.csv.old`, or `box.csv.old-2` if there is one. Returns their new names.
pub fn set_aside(scene: &Scene, folder: &RunFolder) -> io::Result<Vec<PathBuf>> {
    let mut moved = Vec::new();
    for record in &scene.records {
        let table = folder.path().join(names::table(&record.name));
        if !table.exists() {
            continue;
        }
        let other = |number: u64| match number {
            1 => table.with_extension("csv.old"),
            _ => table.with_extension(format!("csv.old-{number}")),
        };
        let Some(free) = (1..).map(other).find(|path| !path.exists()) else { continue };
        fs::rename(&table, &free)?;
        moved.push(free);
    }
    Ok(moved)
}

/// Errors unless the tables of a run begin as they did when a checkpoint was written. Changes nothing.
pub fn check_tables(scene: &Scene, folder: &Path, progress: &Progress) -> Result<(), RunError> {
    reopen(scene, folder, progress).map(|_| ()).map_err(RunError::Table)
}

fn reopen(scene: &Scene, folder: &Path, progress: &Progress) -> io::Result<Vec<Recorder>> {
    let mark = |number: usize| progress.tables.get(number).copied().unwrap_or_default();
    let records = scene.records.iter().enumerate();
    records.map(|(number, record)| Recorder::reopen(record, folder, mark(number))).collect()
}

/// Who watches a run. Told after every batch of steps; answers whether to go on.
pub trait Watcher {
    /// `steps` have been made so far; `left` is what is still to go until the flow is steady, relative, if
    /// the scene has a criterion and that is known.
    fn watch(&mut self, steps: u64, left: Option<f64>) -> bool;
}

/// Steps between two calls of the watcher, at most: about so many cell updates, or sub-steps of a grain.
const BATCH_UPDATES: u64 = 200_000;

/// Runs a scene to its end, with its results in `folder`: from the start, or from where the engine
/// and `resumed` say.
pub fn run(
    scene: &Scene,
    engine: &mut Coupled,
    folder: &RunFolder,
    resumed: Option<&Progress>,
    watcher: &mut dyn Watcher,
) -> Result<End, RunError> {
    let mut run = Run::begin(scene, folder, resumed, engine)?;
    let end = match run.advance(engine, resumed.is_none(), watcher) {
        Err(error) if error.misses_a_file() => return Err(run.rescue(engine)),
        end => end?,
    };
    if end != End::Interrupted {
        if !folder.is_there() {
            return Err(run.rescue(engine));
        }
        // Before what is taken at the end: a run that is killed meanwhile takes it again.
        if scene.keeps_last_state {
            run.save(engine)?;
            checkpoint::keep_newest(folder)?;
        }
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
    folder: &'a RunFolder,
    recorders: Vec<Recorder>,
    steady: Option<steady::Watch>,
    lookout: Lookout,
    /// Steps between two calls of the watcher, at most.
    batch: u64,
}

impl<'a> Run<'a> {
    fn begin(
        scene: &'a Scene,
        folder: &'a RunFolder,
        resumed: Option<&Progress>,
        engine: &Coupled,
    ) -> Result<Self, RunError> {
        folder.prepare(scene)?;
        let path = folder.path();
        let recorders = match resumed {
            None => {
                let records = scene.records.iter();
                records.map(|record| Recorder::create(record, path)).collect::<io::Result<_>>()?
            }
            Some(progress) => {
                // All are looked at before one is changed.
                let mut recorders = reopen(scene, path, progress).map_err(RunError::Table)?;
                recorders.iter_mut().try_for_each(Recorder::go_on)?;
                for (recorder, saved) in recorders.iter_mut().zip(&progress.sums) {
                    recorder.sums = LoadSums::load(saved);
                }
                recorders
            }
        };
        let steady = steady::Watch::begin(scene, resumed.and_then(|p| p.steady.as_ref()));
        let lookout = Lookout::new(scene, engine.steps(), &engine.solids());
        // Without fluid it is the sub-steps of the grains that take the time.
        let substeps = match &scene.free {
            Some(part) if scene.is_dry => part.substeps().map_or(1, u64::from),
            _ => 1,
        };
        let batch = (BATCH_UPDATES / (scene.updates_per_step() * substeps).max(1)).max(1);
        Ok(Run { scene, folder, recorders, steady, lookout, batch })
    }

    /// Steps to the next event. Errors where the state breaks or a prescribed sphere's way ends: then
    /// nothing more is recorded.
    fn step_on(&mut self, engine: &mut Coupled) -> Result<(), RunError> {
        let now = engine.steps();
        let event = self.next_event(now);
        let meeting = self.lookout.meeting_until(event, u64::MAX);
        let until = meeting.map_or(event, |meeting| meeting.step);
        if let Err(stop) = engine.step(until - now) {
            let grain = stopped_grain::explained(&stop, self.scene, engine);
            return Err(grain.map_or(RunError::Stopped(stop), |stop| Box::new(stop).into()));
        }
        for recorder in self.recorders.iter_mut().filter(|recorder| recorder.record.averages) {
            recorder.sums.add(engine);
        }
        match meeting {
            None => Ok(()),
            Some(meeting) => Err(RunError::Met {
                said: meeting.said(self.scene),
                remedy: meeting.remedy(self.scene),
            }),
        }
    }

    /// Makes steps until the run has come to an end.
    fn advance(
        &mut self,
        engine: &mut Coupled,
        from_the_start: bool,
        watcher: &mut dyn Watcher,
    ) -> Result<End, RunError> {
        if from_the_start {
            self.observe(engine)?;
            // A run that goes on from another's state has no beginning of its own to start again from.
            if engine.steps() > 0 {
                self.save(engine)?;
            }
        }
        let mut saved = Saved { step: engine.steps(), at: Instant::now() };
        loop {
            let now = engine.steps();
            let left = self.steady.as_ref().and_then(steady::Watch::left);
            if self.steady.as_ref().is_some_and(steady::Watch::is_met) {
                return Ok(End::Steady { left });
            }
            if now >= self.scene.stop.steps {
                let is_missed = self.steady.is_some();
                return Ok(if is_missed { End::NotSteady { left } } else { End::Limit });
            }
            let go_on = watcher.watch(now, left);
            if !go_on || saved.is_due(self.scene.checkpoint, now) {
                self.save(engine)?;
                saved = Saved { step: now, at: Instant::now() };
            }
            if !go_on {
                return Ok(End::Interrupted);
            }
            self.step_on(engine)?;
            self.observe(engine)?;
            engine.still_works()?;
        }
    }

    /// Takes the records that are due now. Errors if the state is broken: it is not written. If one of
    /// them cannot be written the others are taken all the same, so that the state of this step can still
    /// be saved elsewhere.
    fn observe(&mut self, engine: &mut Coupled) -> Result<(), RunError> {
        let now = engine.steps();
        let mut written = Ok(());
        if self.recorders.iter().any(|recorder| recorder.record.interval.is_due(now)) {
            engine.check()?;
            if !self.folder.is_there() {
                written = Err(io::Error::from(io::ErrorKind::NotFound));
            }
        }
        for recorder in self.recorders.iter_mut().filter(|r| r.record.interval.is_due(now)) {
            written = written.and(recorder.take(self.scene, engine));
        }
        if let Some(steady) = &mut self.steady {
            steady.look(&self.recorders, now);
        }
        Ok(written?)
    }

    /// The step at which something is due next, or the watcher should be told.
    fn next_event(&self, now: u64) -> u64 {
        let after = |interval: u64| (now / interval + 1).saturating_mul(interval);
        let records = self.scene.records.iter().filter_map(|record| match record.interval {
            OutputInterval::Every(interval) => Some(after(interval)),
            OutputInterval::AtEnd => None,
        });
        let checkpoint = match self.scene.checkpoint {
            Interval::Steps(interval) => after(interval),
            Interval::Time(_) => u64::MAX,
        };
        if self.scene.records.iter().any(|record| record.averages) {
            // The loads of each step are summed.
            return now + 1;
        }
        records.fold(checkpoint.min(now + self.batch).min(self.scene.stop.steps), u64::min)
    }

    /// Saves the state. Errors if it is broken: then the last one that was not is kept.
    fn save(&mut self, engine: &mut Coupled) -> Result<(), RunError> {
        if !self.folder.is_there() {
            return Err(io::Error::from(io::ErrorKind::NotFound).into());
        }
        let folder = self.folder;
        self.save_into(folder, engine)
    }

    fn save_into(&mut self, folder: &RunFolder, engine: &mut Coupled) -> Result<(), RunError> {
        engine.check()?;
        let tables = self.recorders.iter_mut().map(Recorder::sync).collect::<io::Result<_>>()?;
        let sums = self.recorders.iter().map(|recorder| recorder.sums.save()).collect();
        let steady = self.steady.as_ref().map(steady::Watch::save);
        let progress = Progress { tables, sums, steady };
        checkpoint::save(folder, self.scene, engine, progress)?;
        Ok(())
    }

    /// Saves what can be saved of a run whose folder has gone: scene, lists, tables (they are still open)
    /// and state, in a fresh folder beside it.
    fn rescue(&mut self, engine: &mut Coupled) -> RunError {
        let rescue = match self.save_elsewhere(engine) {
            Ok(folder) => format!(
                "its state and its tables are saved: psmrt resume {} (pictures and fields written before \
                 are where the old folder is)",
                folder.path().display()
            ),
            Err(error) => format!("its state cannot be saved elsewhere either ({error})"),
        };
        RunError::Gone { path: self.folder.path().display().to_string(), rescue }
    }

    fn save_elsewhere(
        &mut self,
        engine: &mut Coupled,
    ) -> Result<RunFolder, Box<dyn std::error::Error>> {
        let folder = RunFolder::rescue_of(self.folder)?;
        folder.keep(self.scene)?;
        folder.prepare(self.scene)?;
        // Copies first: saving asks the open tables how long they are, copying ends them.
        self.save_into(&folder, engine)?;
        self.recorders.iter_mut().try_for_each(|recorder| recorder.copy_to(folder.path()))?;
        Ok(folder)
    }

    /// Takes the records that are due at the end. Errors if the state is broken.
    fn finish(&mut self, engine: &mut Coupled) -> Result<(), RunError> {
        engine.check()?;
        for recorder in &mut self.recorders {
            if recorder.record.interval == OutputInterval::AtEnd {
                recorder.take(self.scene, engine)?;
            }
            recorder.sync()?;
        }
        Ok(())
    }
}
