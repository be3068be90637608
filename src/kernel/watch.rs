//! Where the time goes.

use std::cell::Cell;
use std::time::{Duration, Instant};

use super::device::Gpu;
use super::error::KernelError;

/// Where the time has gone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct KernelTimes {
    /// Streaming and collision.
    pub fluid: Duration,
    /// Listing what the solids cover.
    pub coverage: Duration,
    /// Loads on the solids.
    pub forces: Duration,
    /// Tables to the device and loads back.
    pub transfers: Duration,
}

/// Keeps the times, if it is on.
#[derive(Debug, Default)]
pub(super) struct Watch {
    pub(super) is_on: bool,
    pub(super) times: Cell<KernelTimes>,
}

impl Watch {
    /// Adds the time since `start` to one of the parts.
    pub(super) fn add(&self, start: Instant, part: impl Fn(&mut KernelTimes) -> &mut Duration) {
        if self.is_on {
            let mut times = self.times.get();
            *part(&mut times) += start.elapsed();
            self.times.set(times);
        }
    }

    /// Waits for what was submitted last and adds the time that it took to one of the parts.
    pub(super) fn wait(
        &self,
        gpu: &Gpu,
        part: impl Fn(&mut KernelTimes) -> &mut Duration,
    ) -> Result<(), KernelError> {
        if self.is_on {
            let start = Instant::now();
            gpu.wait()?;
            self.add(start, part);
        }
        Ok(())
    }
}
