//! Where the method is stable and where it is right: maps over relaxation time, lattice velocity, density
//! ratio and contacts, on both engines.
//!
//! A [`Flow`] is run along [`Line`]s: one engine, one collision, one weight, one relaxation time, and a
//! parameter (usually the lattice velocity) that takes several values. Each run ends as an [`Outcome`]: a run
//! that is stable but wrong is told from one that is right. What "right" is held to stands with each flow:
//! an exact solution, an identity or a bound. Rows go to a file as they come ([`record`]), so that a map
//! that was cut off goes on where it was.
//!
//! | file | flows |
//! |---|---|
//! | `periodic.rs`, `start.rs` | shear layer, Taylor–Green vortex, ABC flow; how they start |
//! | `beds.rs` | ordered bed, by a body force and by an inlet |
//! | `movers.rs` | free grains at density ratios from 1 to 10, with the lagged and the kept inside |
//! | `touching.rs` | contacts that are hard or brief; grains that overlap; several grains in one cell |

mod beds;
pub mod frontier;
mod lab;
mod movers;
mod outcome;
mod periodic;
pub mod record;
mod search;
mod spectral;
mod start;
mod touching;

use psmrt_reference::collision::Preset;
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::rates::RateError;
use thiserror::Error;

use psmrt::engine::{EngineName, EngineStop, StartError};

pub use lab::Lab;
pub use outcome::Outcome;
pub use search::map;

/// All flows.
pub const FLOWS: &[Flow] = &[
    periodic::SHEAR_LAYER,
    periodic::TAYLOR_GREEN,
    periodic::ABC,
    beds::BY_FORCE,
    beds::BY_INLET,
    movers::FLOW,
    touching::CONTACT,
    touching::OVERLAP,
    touching::CROWD,
];

/// A flow that is run along lines.
pub struct Flow {
    /// Its name, and that of its file.
    pub name: &'static str,
    /// What it is and what it is held to, for the head of its file.
    pub about: &'static [&'static str],
    /// What varies along a line.
    pub parameter: &'static str,
    /// Its values, from the harmless to the harmful.
    pub values: &'static [f64],
    /// Whether all values are run, or only those that find the largest that survives and the largest
    /// that is right.
    pub search: Search,
    /// A value of a line's own that is run besides: where the truth is known.
    pub also: fn(&Line) -> Option<f64>,
    /// The lines, on an engine.
    pub lines: fn(EngineName) -> Vec<Line>,
    /// One run.
    pub run: fn(&Lab, &Line, f64) -> Result<Found, LabError>,
}

/// How a line is gone along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// Every value.
    All,
    /// By halving, twice: the last value that survives, the last that is right.
    Frontiers,
}

/// What stays the same along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The engine: double precision or single.
    pub engine: EngineName,
    /// The collision.
    pub model: Preset,
    /// The weight, where there are solids.
    pub weighting: Option<Weighting>,
    /// What else tells lines of a flow apart; empty if nothing does.
    pub variant: &'static str,
    /// The relaxation time.
    pub tau: f64,
}

impl Line {
    /// The weight as tables spell it.
    pub fn weight_word(&self) -> &'static str {
        match self.weighting {
            None => "none",
            Some(Weighting::NobleTorczynski) => "NT",
            Some(Weighting::SolidFraction) => "eps",
            Some(Weighting::Graded) => "graded",
        }
    }
}

/// What a run has shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// How it ended.
    pub outcome: Outcome,
    /// Steps made.
    pub steps: u64,
    /// Error against the truth of the flow, relative; `None` where nothing was judged.
    pub error: Option<f64>,
    /// Reynolds number that was reached, where the flow has one.
    pub reynolds: Option<f64>,
    /// What the guard saw, in a word, where it stopped the run.
    pub how: Option<&'static str>,
}

impl Found {
    /// A run that lived, judged by an error and what is allowed.
    pub fn judged(steps: u64, error: f64, allowed: f64) -> Self {
        let outcome = if error <= allowed { Outcome::Right } else { Outcome::Wrong };
        Found { outcome, steps, error: Some(error), reynolds: None, how: None }
    }

    /// The same, or with nothing judged.
    #[must_use]
    pub fn if_judged(self, is_judged: bool) -> Self {
        if is_judged { self } else { Found { outcome: Outcome::Unjudged, error: None, ..self } }
    }

    /// What a run that could not be made or ended early has shown. Errors if it shows nothing about the
    /// set-up: the device failed, say.
    pub fn of(error: LabError) -> Result<Self, LabError> {
        let found =
            |outcome, steps, how| Found { outcome, steps, error: None, reynolds: None, how };
        match error {
            LabError::Stopped { steps, how } => Ok(found(Outcome::Stopped, steps, Some(how))),
            LabError::Start(StartError::Grains(_)) => Ok(found(Outcome::Refused, 0, None)),
            error => Err(error),
        }
    }
}

/// Why a run ended early or could not be made at all.
#[derive(Debug, Error)]
pub enum LabError {
    /// The guard stopped it, or its grains cannot be moved: the run is made, and this is its result.
    #[error("stopped at step {steps}: {how}")]
    Stopped {
        /// Steps made.
        steps: u64,
        /// What the guard saw, in a word.
        how: &'static str,
    },
    /// The rates.
    #[error(transparent)]
    Rates(#[from] RateError),
    /// The box.
    #[error(transparent)]
    Domain(#[from] psmrt_reference::domain::DomainError),
    /// The contact law.
    #[error(transparent)]
    Law(#[from] psmrt_reference::grains::law::LawError),
    /// The engine cannot take the set-up.
    #[error(transparent)]
    Start(#[from] StartError),
    /// The device has failed.
    #[error(transparent)]
    Engine(#[from] EngineStop),
    /// There is no device.
    #[error("this line needs the kernel, and there is no adapter")]
    NoDevice,
    /// The file of the rows.
    #[error("{file}: {problem}")]
    RunLog {
        /// The file.
        file: String,
        /// What is wrong.
        problem: String,
    },
}
