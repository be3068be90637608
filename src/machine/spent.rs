//! What something has taken of the machine's time.

use std::time::{Duration, Instant};

use super::processor_time;

/// Time that something has taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spent {
    /// On the clock.
    pub clock: Duration,
    /// Of all threads of this program, with those of a software adapter; zero where it is not known.
    pub processor: Duration,
}

/// When something began.
#[derive(Clone, Copy, Debug)]
pub struct Beginning {
    clock: Instant,
    processor: Option<Duration>,
}

impl Beginning {
    /// Now.
    pub fn now() -> Self {
        Beginning { clock: Instant::now(), processor: processor_time() }
    }
}

impl Spent {
    /// Adds what has passed since.
    pub fn add(&mut self, since: Beginning) {
        self.clock += since.clock.elapsed();
        if let (Some(before), Some(now)) = (since.processor, processor_time()) {
            self.processor += now.saturating_sub(before);
        }
    }
}
