//! Measures in turns: what is compared is measured again and again, one after the other, and each time with the
//! bandwidth of the moment, since both change within seconds where a machine is shared.

use std::time::Instant;

use rayon::ThreadPool;
use rayon::prelude::*;

/// Bytes that a loop over memory moves in a second: each number of an array larger than the caches is read, changed and
/// written, in place, on all threads of the pool.
pub struct Stream {
    values: Vec<f32>,
}

impl Stream {
    /// Over `bytes` bytes.
    pub fn new(bytes: usize) -> Self {
        Stream { values: vec![1.0; bytes / 4] }
    }

    /// Bytes per second, both ways.
    pub fn bandwidth(&mut self, pool: &ThreadPool) -> f64 {
        let bytes = 8.0 * self.values.len() as f64;
        let seconds = seconds_of(|| {
            pool.install(|| {
                self.values.par_chunks_mut(16_384).for_each(|chunk| {
                    chunk.iter_mut().for_each(|value| *value = *value * 0.999 + 0.001);
                });
            });
        });
        bytes / seconds
    }
}

/// Seconds on the clock.
pub fn seconds_of(work: impl FnOnce()) -> f64 {
    let since = Instant::now();
    work();
    since.elapsed().as_secs_f64()
}

/// Median, smallest and largest of some numbers; NaN of none.
pub fn spread(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    let at = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
    [at(values.len() / 2), at(0), at(values.len().saturating_sub(1))]
}
