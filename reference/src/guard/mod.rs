//! The guard: stops a run whose state is broken. Here is when it looks and what it takes for broken; why a
//! run broke, in words, is in `stopped.rs`.

mod stopped;

use crate::lattice::{Populations, density, momentum};
use crate::setup::Setup;

pub use stopped::{Cause, Failure, Stopped};

/// When the guard looks and what it takes for broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuardSettings {
    /// Steps between looks. One look costs about a fifteenth of a step (`cargo bench`), so looking
    /// every 16 steps costs half a percent; what breaks in between is found at the next look.
    pub interval: u64,
    /// Largest speed of the fluid in lattice units. The speed of sound is 0.577; the default 0.5 is
    /// a Mach number of 0.87, far beyond what is accurate but still short of what always fails.
    pub max_speed: f64,
}

impl Default for GuardSettings {
    fn default() -> Self {
        GuardSettings { interval: 16, max_speed: 0.5 }
    }
}

/// A mean density beyond this factor of its first value is itself broken: the fluid is meant to be
/// nearly incompressible.
const MAX_DENSITY_FACTOR: f64 = 2.0;

/// What a look at all cells sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Mean density.
    pub mean_density: f64,
    /// Largest speed `|j|/rho`.
    pub max_speed: f64,
    /// The first broken cell and what is wrong with it.
    pub broken: Option<(usize, Failure)>,
}

/// What a guard has seen so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Mean density at the first look, if there was one.
    pub first_mean_density: Option<f64>,
    /// Mean density at the last look.
    pub last_mean_density: f64,
    /// Largest speed at the last look.
    pub last_max_speed: f64,
}

/// Keeps what it saw when all was well, as evidence for when it is not.
#[derive(Clone, Debug)]
pub struct Guard {
    settings: GuardSettings,
    first_mean_density: Option<f64>,
    last_mean_density: f64,
    last_max_speed: f64,
}

impl Guard {
    /// A guard that has seen nothing yet.
    pub fn new(settings: GuardSettings) -> Self {
        Guard { settings, first_mean_density: None, last_mean_density: 1.0, last_max_speed: 0.0 }
    }

    /// Looks if it is time to.
    pub fn look(&mut self, setup: &Setup, f: &[Populations], step: u64) -> Result<(), Stopped> {
        if self.is_due(step) { self.look_now(setup, f, step) } else { Ok(()) }
    }

    /// Whether it is time for a look before step `step`.
    pub fn is_due(&self, step: u64) -> bool {
        step.is_multiple_of(self.settings.interval.max(1))
    }

    /// Looks at every cell. Errors at the first that is broken.
    pub fn look_now(&mut self, setup: &Setup, f: &[Populations], step: u64) -> Result<(), Stopped> {
        let sight = self.sight(f);
        self.judge(setup, step, &sight)
    }

    /// What a look at every cell sees, up to the first that is broken.
    pub fn sight(&self, f: &[Populations]) -> Sight {
        let (mut mass, mut max_speed) = (0.0, 0.0_f64);
        let mut broken = None;
        for (cell, f) in f.iter().enumerate() {
            mass += density(f);
            max_speed = max_speed.max(momentum(f).norm() / density(f));
            if let Some(failure) = self.failure(f) {
                broken = Some((cell, failure));
                break;
            }
        }
        Sight { mean_density: mass / f.len() as f64, max_speed, broken }
    }

    /// What is wrong with a cell, if anything is.
    pub fn failure(&self, f: &Populations) -> Option<Failure> {
        let rho = density(f);
        let speed = momentum(f).norm() / rho;
        if !(rho.is_finite() && speed.is_finite()) {
            Some(Failure::NotFinite)
        } else if rho <= 0.0 {
            Some(Failure::NoDensity(rho))
        } else {
            (speed > self.settings.max_speed).then_some(Failure::TooFast(speed))
        }
    }

    /// Judges what a look at all cells before step `step` has seen, whoever has looked. Errors if a cell
    /// is broken or the mean density is.
    pub fn judge(&mut self, setup: &Setup, step: u64, sight: &Sight) -> Result<(), Stopped> {
        if let Some((cell, failure)) = sight.broken {
            let cause = stopped::probable_cause(self, setup, step);
            return Err(Stopped { step, cell: setup.domain.coordinates(cell), failure, cause });
        }
        self.last_mean_density = sight.mean_density;
        self.first_mean_density.get_or_insert(self.last_mean_density);
        self.last_max_speed = sight.max_speed;
        let ratio = self.density_drift();
        if (1.0 / MAX_DENSITY_FACTOR..=MAX_DENSITY_FACTOR).contains(&ratio) {
            return Ok(());
        }
        let (failure, cause) =
            (Failure::MeanDensity(ratio), stopped::probable_cause(self, setup, step));
        Err(Stopped { step, cell: [0, 0, 0], failure, cause })
    }

    /// The evidence so far, for a run that is to go on later.
    pub fn evidence(&self) -> Evidence {
        Evidence {
            first_mean_density: self.first_mean_density,
            last_mean_density: self.last_mean_density,
            last_max_speed: self.last_max_speed,
        }
    }

    /// A guard that goes on from the evidence of an earlier one.
    pub fn going_on_from(settings: GuardSettings, evidence: Evidence) -> Self {
        let Evidence { first_mean_density, last_mean_density, last_max_speed } = evidence;
        Guard { settings, first_mean_density, last_mean_density, last_max_speed }
    }

    /// Mean density at the last look over mean density at the first.
    pub fn density_drift(&self) -> f64 {
        self.first_mean_density.map_or(1.0, |first| self.last_mean_density / first)
    }
}
