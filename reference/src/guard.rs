//! The guard: stops a run whose state is broken. Here is when it checks and what it takes for broken; why a run
//! broke, and what to change, is for whoever runs it to say.

use crate::domain::Domain;
use crate::lattice::{Populations, density, momentum};
use std::fmt;
use thiserror::Error;

/// What is wrong with a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// A population is NaN or infinite.
    NotFinite,
    /// The density is zero or negative.
    NoDensity(f64),
    /// The fluid is faster than [`GuardSettings::max_speed`].
    TooFast(f64),
    /// The mean density of the domain is less than half or more than twice its initial value.
    MeanDensity(f64),
}

/// A run that was stopped.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub struct Stopped {
    /// The step before which the state was checked.
    pub step: u64,
    /// The first broken cell, `[x, y, z]`; `[0, 0, 0]` where all are.
    pub cell: [usize; 3],
    /// What is wrong there.
    pub failure: Failure,
    /// What the guard had seen until then.
    pub evidence: Evidence,
}

impl fmt::Display for Stopped {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stopped { step, cell, failure, .. } = self;
        write!(out, "stopped before step {step} ")?;
        match failure {
            Failure::MeanDensity(_) => write!(out, "on the mean over all cells: ")?,
            _ => write!(out, "at cell {cell:?}: ")?,
        }
        match failure {
            Failure::NotFinite => write!(out, "a population is not a finite number"),
            Failure::NoDensity(rho) => write!(out, "density = {rho:.3e} must be positive"),
            Failure::TooFast(speed) => write!(
                out,
                "speed = {speed:.3} lattice units exceeds the limit (the speed of sound is 0.577)"
            ),
            Failure::MeanDensity(ratio) => write!(
                out,
                "the mean density is {ratio:.3} times its initial value and must stay within 0.5 to 2"
            ),
        }
    }
}

/// When the guard checks and what it takes for broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuardSettings {
    /// Steps between checks. One check costs about a fifteenth of a step (`cargo bench`), so checking
    /// every 16 steps costs half a percent; what breaks in between is found at the next check.
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

/// What a check of all cells finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Findings {
    /// Mean density.
    pub mean_density: f64,
    /// Largest speed `|j|/rho`.
    pub max_speed: f64,
    /// The first broken cell and what is wrong with it.
    pub broken: Option<(usize, Failure)>,
}

/// What a guard has seen so far, in checks that found nothing broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Mean density at the first check, if there was one.
    pub first_mean_density: Option<f64>,
    /// Mean density at the last check.
    pub last_mean_density: f64,
    /// Largest speed at the last check.
    pub last_max_speed: f64,
}

impl Evidence {
    /// Mean density at the last check over mean density at the first.
    pub fn density_drift(&self) -> f64 {
        self.first_mean_density.map_or(1.0, |first| self.last_mean_density / first)
    }
}

/// Checks the state and keeps what it saw when all was well, as evidence for when it is not.
#[derive(Clone, Debug)]
pub struct Guard {
    settings: GuardSettings,
    evidence: Evidence,
}

impl Guard {
    /// A guard that has seen nothing yet.
    pub fn new(settings: GuardSettings) -> Self {
        let evidence =
            Evidence { first_mean_density: None, last_mean_density: 1.0, last_max_speed: 0.0 };
        Guard { settings, evidence }
    }

    /// A guard that goes on from the evidence of an earlier one.
    pub fn going_on_from(settings: GuardSettings, evidence: Evidence) -> Self {
        Guard { settings, evidence }
    }

    /// Checks every cell if it is time to. Errors as [`Self::check_now`].
    pub fn check(&mut self, domain: &Domain, f: &[Populations], step: u64) -> Result<(), Stopped> {
        if self.is_due(step) { self.check_now(domain, f, step) } else { Ok(()) }
    }

    /// Whether it is time for a check before step `step`.
    pub fn is_due(&self, step: u64) -> bool {
        step.is_multiple_of(self.settings.interval.max(1))
    }

    /// Checks every cell. Errors at the first that is broken.
    pub fn check_now(
        &mut self,
        domain: &Domain,
        f: &[Populations],
        step: u64,
    ) -> Result<(), Stopped> {
        let findings = self.findings(f);
        self.judge(domain, step, &findings)
    }

    /// What a check of every cell finds, up to the first that is broken.
    pub fn findings(&self, f: &[Populations]) -> Findings {
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
        Findings { mean_density: mass / f.len() as f64, max_speed, broken }
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

    /// Judges what a check of all cells before step `step` has found, whoever made it. Errors if a cell
    /// is broken or the mean density is.
    pub fn judge(
        &mut self,
        domain: &Domain,
        step: u64,
        findings: &Findings,
    ) -> Result<(), Stopped> {
        if let Some((cell, failure)) = findings.broken {
            let cell = domain.coordinates(cell);
            return Err(Stopped { step, cell, failure, evidence: self.evidence });
        }
        self.evidence.last_mean_density = findings.mean_density;
        self.evidence.first_mean_density.get_or_insert(findings.mean_density);
        self.evidence.last_max_speed = findings.max_speed;
        let ratio = self.evidence.density_drift();
        if (1.0 / MAX_DENSITY_FACTOR..=MAX_DENSITY_FACTOR).contains(&ratio) {
            return Ok(());
        }
        let failure = Failure::MeanDensity(ratio);
        Err(Stopped { step, cell: [0, 0, 0], failure, evidence: self.evidence })
    }

    /// The evidence so far, for a run that is to go on later.
    pub fn evidence(&self) -> Evidence {
        self.evidence
    }
}
