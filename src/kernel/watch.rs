//! Where the time goes.

use std::cell::Cell;

use super::device::Gpu;
use super::error::KernelError;
use crate::machine::{Beginning, Spent};

/// Where the time has gone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct KernelTimes {
    /// Streaming and collision.
    pub fluid: Spent,
    /// Listing what the solids cover.
    pub coverage: Spent,
    /// Loads on the solids.
    pub forces: Spent,
    /// How free solids hold the fluid before a collision, and back with it.
    pub grips: Spent,
    /// Tables to the device and loads back.
    pub transfers: Spent,
}

/// Keeps the times, if it is on.
#[derive(Debug, Default)]
pub(super) struct Watch {
    pub(super) is_on: bool,
    pub(super) times: Cell<KernelTimes>,
}

impl Watch {
    /// Now, if times are kept.
    pub(super) fn begin(&self) -> Option<Beginning> {
        self.is_on.then(Beginning::now)
    }

    /// Adds the time since then to one of the parts.
    pub(super) fn add(
        &self,
        since: Option<Beginning>,
        part: impl Fn(&mut KernelTimes) -> &mut Spent,
    ) {
        if let Some(since) = since {
            let mut times = self.times.get();
            part(&mut times).add(since);
            self.times.set(times);
        }
    }

    /// Waits for what was submitted last and adds the time since then to one of the parts.
    pub(super) fn wait(
        &self,
        gpu: &Gpu,
        since: Option<Beginning>,
        part: impl Fn(&mut KernelTimes) -> &mut Spent,
    ) -> Result<(), KernelError> {
        if since.is_some() {
            gpu.wait()?;
            self.add(since, part);
        }
        Ok(())
    }
}
