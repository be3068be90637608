//! Makes runs: on either engine, until the end or until the guard stops them.

use std::sync::Arc;

use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::grains::setup::GrainError;
use psmrt_reference::guard::{Failure, GuardSettings};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::Setup;

use super::start::populations;
use super::{LabError, Line};
use psmrt::engine::{Coupled, EngineStop, StartError, from_populations, starting_from};
use psmrt::kernel::Gpu;
use psmrt::scene::FreePart;

/// Where runs are made.
pub struct Lab {
    /// The device, if there is one.
    pub gpu: Option<Arc<Gpu>>,
}

/// The guard of the maps. It looks as often as that of scenes, but lets the fluid be as fast as one cell
/// per step: a run that only exceeds the 0.5 of scenes is not broken yet, and some live on.
const GUARD: GuardSettings = GuardSettings { interval: 16, max_speed: 1.0 };

impl Lab {
    /// The set-up of a line: a box with its collision.
    pub fn setup(line: &Line, cells: [usize; 3], faces: Faces) -> Result<Setup, LabError> {
        let domain = Domain::new(cells, faces)?;
        let setup = Setup::fluid(domain, line.model.collision(line.tau)?);
        Ok(Setup { guard: GUARD, ..setup })
    }

    /// The set-up at its start on the engine of the line.
    pub fn engine(
        &self,
        line: &Line,
        setup: &Setup,
        free: Option<&FreePart>,
        state: impl Fn(Vec3) -> (f64, Vec3),
    ) -> Result<Coupled, LabError> {
        Ok(starting_from(line.engine, setup, free, self.gpu(line)?, state)?)
    }

    /// A fluid without solids in a periodic box at its start, with the stress of its velocity field.
    pub(super) fn flowing(
        &self,
        line: &Line,
        setup: &Setup,
        state: impl Fn(Vec3) -> (f64, Vec3),
    ) -> Result<Coupled, LabError> {
        let domain = &setup.domain;
        let centre = |cell| domain.centre(domain.coordinates(cell));
        let states: Vec<_> = (0..domain.cell_count()).map(|cell| state(centre(cell))).collect();
        let f = populations(&setup.collision, domain.cells(), &states)?;
        Ok(from_populations(line.engine, setup, self.gpu(line)?, &f)?)
    }

    /// The device, for an engine that needs one.
    fn gpu(&self, line: &Line) -> Result<Option<&Arc<Gpu>>, LabError> {
        if line.engine.needs_device() && self.gpu.is_none() {
            return Err(LabError::NoDevice);
        }
        Ok(self.gpu.as_ref())
    }
}

/// Goes on to step `end`. Errors with [`LabError::Stopped`] if the guard stops it or its grains cannot be
/// moved, and otherwise if the set-up is refused or the device fails.
pub(super) fn go_on(engine: &mut Coupled, end: u64) -> Result<(), LabError> {
    let left = end.saturating_sub(engine.steps());
    match engine.step(left).and_then(|()| engine.check()) {
        Ok(()) => Ok(()),
        Err(EngineStop::Broken(diagnosis)) => {
            let how = match diagnosis.stopped.failure {
                Failure::NotFinite => "not_finite",
                Failure::NoDensity(_) => "no_density",
                Failure::TooFast(_) => "too_fast",
                Failure::MeanDensity(_) => "mean_density",
            };
            Err(LabError::Stopped { steps: diagnosis.stopped.step, how })
        }
        Err(EngineStop::Grains(error @ GrainError::Substep(_))) => {
            Err(LabError::Start(StartError::Grains(error)))
        }
        Err(EngineStop::Grains(_)) => {
            Err(LabError::Stopped { steps: engine.steps(), how: "grains" })
        }
        Err(error) => Err(error.into()),
    }
}
