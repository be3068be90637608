//! Whether a value has become steady, judged by time: how far it still is from where it is going.
//!
//! The elapsed time `t` is divided, not the rows: `e1` is how far the value has moved to and fro in the last
//! quarter of it, `e2` in the quarter before. An exponential approach falls by the same factor `r = e1/e2` over
//! equal times, so that `e1 (r + r² + ...) = e1 r/(1 - r)` is still to come (Aitken 1926). The same sum bounds a
//! swing that dies down. The same is asked of sixteenths of the elapsed time, in which a slow approach shows
//! sooner behind a fast one; the larger answer counts.

use crate::checkpoint::SteadyWatch;
use crate::engine::Coupled;
use crate::output::records::{Recorder, watched_row};
use crate::scene::{OutputInterval, Scene, Steady};

/// Samples that are kept at most. With twice as many rows every other one is a sample, and so on: a criterion
/// looks at 128 to 256 times of a long run, however close its rows are.
const MOST_SAMPLES: usize = 256;

/// The elapsed time is compared over this many equal parts: coarse, and fine.
const PARTS: [usize; 2] = [4, 16];

/// What is to go must stay within the tolerance for this share of the time at which it first did.
const HOLD: u64 = 8;

/// One time: the value, and the least and the largest one since the time before.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    value: f64,
    least: f64,
    most: f64,
}

impl Sample {
    fn at(value: f64) -> Self {
        Sample { value, least: value, most: value }
    }

    /// This one and `next` as one.
    fn before(self, next: Sample) -> Self {
        let (least, most) = (self.least.min(next.least), self.most.max(next.most));
        Sample { value: next.value, least, most }
    }
}

/// A value over time, from equally spaced rows.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Rows seen.
    rows: u64,
    /// Rows from one sample to the next.
    stride: u64,
    samples: Vec<Sample>,
    /// The rows since the last sample.
    pending: Option<Sample>,
}

impl Default for History {
    fn default() -> Self {
        History { rows: 0, stride: 1, samples: Vec::new(), pending: None }
    }
}

impl History {
    /// The history of a column.
    pub fn of(values: &[f64]) -> Self {
        let mut history = History::default();
        values.iter().for_each(|&value| history.add(value));
        history
    }

    /// Takes the next row; the first is that of the start.
    pub fn add(&mut self, value: f64) {
        let row = Sample::at(value);
        let sample = self.pending.take().map_or(row, |pending| pending.before(row));
        if !self.rows.is_multiple_of(self.stride) {
            self.pending = Some(sample);
        } else {
            self.samples.push(sample);
        }
        self.rows += 1;
        if self.samples.len() > MOST_SAMPLES {
            self.thin();
        }
    }

    /// Makes one sample of each two. The one of the start stays by itself.
    fn thin(&mut self) {
        let mut thinned = vec![self.samples[0]];
        thinned.extend(self.samples[1..].chunks_exact(2).map(|pair| pair[0].before(pair[1])));
        self.samples = thinned;
        self.stride *= 2;
    }

    /// Whether the last row was a sample: only then is there something new to be told.
    fn is_fresh(&self) -> bool {
        self.pending.is_none()
    }

    /// What is still to go at the last sample, relative to the value: infinite if the changes do not slow
    /// down. `None` of fewer than four rows after the first, and of a value that is exactly zero: then the flow
    /// has not begun, or has no such component.
    pub fn left(&self) -> Option<f64> {
        let value = self.samples.last()?.value;
        let intervals = self.samples.len() - 1;
        let windows = PARTS.map(|parts| intervals / parts).into_iter().filter(|&n| n > 0);
        let left = windows.map(|window| self.left_by(window)).reduce(f64::max)?;
        (value != 0.0).then(|| left / value.abs())
    }

    /// The same from the last two windows of that many samples, not relative.
    fn left_by(&self, window: usize) -> f64 {
        let end = self.samples.len() - 1;
        let [(e1, d1), (e2, d2)] = [end, end - window].map(|to| self.moved(to - window, to));
        // Noise and swings go to and fro and get nowhere: what they may still do is what they did.
        let is_one_way = d1 * d2 > 0.0 && 2.0 * d1.abs() >= e1 && 2.0 * d2.abs() >= e2;
        if !is_one_way {
            return e1;
        }
        let ratio = e1 / e2;
        if ratio < 1.0 { e1 * ratio / (1.0 - ratio) } else { f64::INFINITY }
    }

    /// How far the value has moved to and fro from one sample to another, and how far it has got.
    fn moved(&self, from: usize, to: usize) -> (f64, f64) {
        let start = Sample::at(self.samples[from].value);
        let all = self.samples[from + 1..=to].iter().fold(start, |all, &next| all.before(next));
        (all.most - all.least, all.value - start.value)
    }
}

/// Watches the criterion of a scene.
pub(super) struct Watch {
    steady: Steady,
    /// Rows before which nothing is called steady.
    least_rows: u64,
    history: History,
    /// The row since which what is to go has been within the tolerance.
    since: Option<u64>,
    left: Option<f64>,
}

impl Watch {
    /// From the start, or from where a checkpoint was made.
    pub(super) fn begin(scene: &Scene, saved: Option<&SteadyWatch>) -> Option<Self> {
        let steady = scene.stop.steady.clone()?;
        let interval = match scene.records[steady.record].interval {
            OutputInterval::Every(interval) => interval,
            OutputInterval::AtEnd => 1,
        };
        let least_rows = steps_of_sound(scene).div_ceil(interval);
        let (history, since) = saved.map_or_else(Default::default, unpacked);
        let left = history.left();
        Some(Watch { steady, least_rows, history, since, left })
    }

    /// Looks at the row that the recorder of its record has just taken, if it was due.
    pub(super) fn look(&mut self, recorders: &[Recorder], steps: u64) {
        let recorder = &recorders[self.steady.record];
        if let Some(row) =
            recorder.watched.as_ref().filter(|_| recorder.record.interval.is_due(steps))
        {
            self.take(row[self.steady.column]);
        }
    }

    /// Takes the next row.
    fn take(&mut self, value: f64) {
        self.history.add(value);
        if !self.history.is_fresh() {
            return;
        }
        self.left = self.history.left();
        let row = self.history.rows - 1;
        let is_within = self.left.is_some_and(|left| left <= self.steady.tolerance);
        self.since = (is_within && row >= self.least_rows).then(|| self.since.unwrap_or(row));
    }

    pub(super) fn is_met(&self) -> bool {
        // The first row is that of the start, at time 0.
        let row = self.history.rows.saturating_sub(1);
        self.since.is_some_and(|since| row > since && row >= since + since / HOLD)
    }

    /// What is still to go, see [`History::left`].
    pub(super) fn left(&self) -> Option<f64> {
        self.left
    }

    pub(super) fn save(&self) -> SteadyWatch {
        let History { rows, stride, samples, pending } = &self.history;
        let bits = |s: &Sample| [s.value, s.least, s.most].map(f64::to_bits);
        SteadyWatch {
            rows: *rows,
            stride: *stride,
            samples: samples.iter().map(bits).collect(),
            pending: pending.as_ref().map(bits),
            since: self.since,
        }
    }
}

/// What a criterion looks at, now; not a number for a record that has no such column.
pub(crate) fn value_of(scene: &Scene, engine: &Coupled, steady: &Steady) -> f64 {
    let row = watched_row(&scene.records[steady.record].what, scene, engine);
    row.and_then(|row| row.get(steady.column).copied()).unwrap_or(f64::NAN)
}

/// Steps in which sound passes the longest side of the box to and fro twice: sooner no flow knows of its ends.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "far below 2^53")]
fn steps_of_sound(scene: &Scene) -> u64 {
    let longest = scene.setup.domain.cells().into_iter().max().unwrap_or(1);
    (4.0 * longest as f64 * 3.0_f64.sqrt()).ceil() as u64
}

/// The history that a checkpoint has, and the row since which the value is within the tolerance.
fn unpacked(saved: &SteadyWatch) -> (History, Option<u64>) {
    let sample = |bits: &[u64; 3]| {
        let [value, least, most] = bits.map(f64::from_bits);
        Sample { value, least, most }
    };
    let history = History {
        rows: saved.rows,
        stride: saved.stride.max(1),
        samples: saved.samples.iter().map(sample).collect(),
        pending: saved.pending.as_ref().map(sample),
    };
    (history, saved.since)
}
