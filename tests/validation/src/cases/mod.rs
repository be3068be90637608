//! The acceptance cases: one table drives the tests, the golden files, the figures and the verdicts.
//!
//! A case runs its scene files, at a quick scale, on an engine ([`Case::measure`]); what it measured
//! becomes rows, and rows beside literature become claims ([`Case::judge`]) and figures
//! ([`Case::draw`]). `golden/<case>/expected.csv` keeps the rows of the oracle, reviewed, against drift.
//! Full-scale results are committed beside it with the command that made them.

mod bench;
mod boiling;
mod cloud_settling;
mod conformance;
mod cost;
mod cpu_speed;
mod drift;
mod duct;
mod fluidization;
mod found;
pub mod images;
mod kernel_parity;
mod kernel_speed;
pub mod operators;
mod oscillating;
mod permeability;
mod poiseuille;
mod seepage;
mod sphere_arrays;
mod sphere_drag;
mod spring_column;
mod stability;
mod steadiness;
mod stokes_settling;
mod study;
mod suspension;
mod ten_cate;
mod tradeoff;
mod twins;
pub mod viscosity;
mod wet_rebound;

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::io;
use std::ops::RangeInclusive;
use std::path::PathBuf;

use psmrt_report::Figure;
use thiserror::Error;

use psmrt::checkpoint::CheckpointError;
use psmrt::engine::{EngineStop, StartError};
use psmrt::kernel::KernelError;
use psmrt::output::folder::FolderError;
use psmrt::run::RunError;
use psmrt::scene::SceneError;
use psmrt::table::{Table, TableError};

pub use bench::{Bench, Finished, WatcherOf};
pub use drift::{DRIFT_WORDS, Drift, drifts};
pub use fluidization::bed::{
    FluidizedBed, RUNS as FLUIDIZED_BEDS, Records as BedRecords, rows_of as rows_of_bed,
};
pub use fluidization::onsets;
pub use found::drawn;
pub use oscillating::OscillatingSphere;
pub use permeability::beds::{BedOfSpheres, RANDOM as PERMEABILITY_BED};
pub use psmrt::seepage::laws::{BED_LAWS, BedLaw};
pub use seepage::bed::{BedRun, Packing};
pub use sphere_drag::stream::Stream;
pub use sphere_drag::study::{drag_by_grid, in_open_water};
pub use steadiness::{Settled, steadiness};
pub use study::Study;
pub use wet_rebound::{WetRebound, wet_rebounds, wet_restitutions};

/// A case of the acceptance suite.
pub struct Case {
    /// Its name: that of its folder under `golden/`.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What it shows and how, a paragraph each.
    pub about: &'static [&'static str],
    /// Its scene files, in its folder.
    pub scenes: &'static [&'static str],
    /// The files in its folder with what it is held to: cited, exact or computed by others, entered by hand
    /// and never written by a run. None where a case compares psmrt with itself.
    pub literature: &'static [&'static str],
    /// The file in its folder with reviewed rows: the oracle's at the quick scale, or, without scenes,
    /// those of the full form or of another program.
    pub rows: &'static str,
    /// The other tables, made by runs or of another case, that its claims and figures rest on: it opens none besides
    /// these, its literature and its rows.
    pub studies: &'static [&'static str],
    /// The units of its rows, column by column where they differ.
    pub units: &'static str,
    /// How its full form is made and what it holds, in words.
    pub full: &'static str,
    /// Runs its scenes, at the quick scale or at the bench's full one. Errors if one cannot be run or
    /// does not become steady.
    pub measure: fn(&mut Bench) -> Result<Table, CaseError>,
    /// What is claimed of the rows that were measured, all engines' together.
    pub judge: fn(&Golden, &Table) -> Result<Vec<Claim>, CaseError>,
    /// The figures.
    pub draw: fn(&Golden, &Table) -> Result<Vec<Figure>, CaseError>,
}

/// All cases, in the order of the report.
pub const CASES: &[Case] = &[
    poiseuille::CASE,
    duct::CASE,
    oscillating::CASE,
    sphere_arrays::CASE,
    sphere_drag::CASE,
    seepage::CASE,
    permeability::CASE,
    images::CASE,
    boiling::CASE,
    spring_column::CASE,
    fluidization::CASE,
    stokes_settling::CASE,
    ten_cate::CASE,
    wet_rebound::CASE,
    suspension::CASE,
    viscosity::CASE,
    cloud_settling::CASE,
    conformance::CASE,
    tradeoff::CASE,
    operators::CASE,
    kernel_parity::CASE,
    kernel_speed::CASE,
    cpu_speed::CASE,
    stability::CASE,
    cost::CASE,
];

/// A picture and a film of a case.
pub struct Media {
    /// The case.
    pub case: &'static str,
    /// A PNG in its folder.
    pub picture: &'static str,
    /// What the picture shows.
    pub caption: &'static str,
    /// A film in its folder that browsers play.
    pub film: &'static str,
    /// What the film shows.
    pub film_caption: &'static str,
}

/// All there are.
pub const MEDIA: [Media; 1] = [cloud_settling::MEDIA];

/// A claim about one number.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What is claimed, in words.
    pub what: String,
    /// The number that was measured.
    pub measured: f64,
    /// What it may be.
    pub allowed: RangeInclusive<f64>,
    /// Why so much is allowed, with the source of the expected value.
    pub why: &'static str,
}

impl Claim {
    /// Whether it holds; a measured NaN does not.
    pub fn holds(&self) -> bool {
        self.allowed.contains(&self.measured)
    }
}

/// The folder of golden files of one case, and which tables have been read through it.
#[derive(Clone, Debug)]
pub struct Golden {
    folder: PathBuf,
    read: RefCell<BTreeSet<String>>,
}

impl Golden {
    /// The folder `golden/<case>`.
    pub fn of(case: &Case, golden: &std::path::Path) -> Self {
        Golden { folder: golden.join(case.name), read: RefCell::default() }
    }

    /// A file of it.
    pub fn path(&self, file: &str) -> PathBuf {
        self.folder.join(file)
    }

    /// A table of it. Errors if it cannot be read.
    pub fn table(&self, file: &str) -> Result<Table, CaseError> {
        self.read.borrow_mut().insert(file.to_owned());
        Ok(Table::read(&self.path(file))?)
    }

    /// The tables that were read so far: what claims and figures rest on besides measured rows.
    pub fn tables_read(&self) -> BTreeSet<String> {
        self.read.borrow().clone()
    }
}

impl CaseError {
    /// Something that a case needs is not there, in words.
    pub fn table(problem: impl Into<String>) -> Self {
        CaseError::Table(TableError(problem.into()))
    }
}

/// Why a case could not be measured or judged.
#[derive(Debug, Error)]
pub enum CaseError {
    /// A scene is wrong.
    #[error(transparent)]
    Scene(#[from] Box<SceneError>),
    /// An engine cannot take a scene.
    #[error(transparent)]
    Open(#[from] StartError),
    /// The device cannot be had.
    #[error(transparent)]
    Device(#[from] KernelError),
    /// A run could not go on.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A step could not be made.
    #[error(transparent)]
    Step(#[from] EngineStop),
    /// A run ended at its limit of time: its result is not steady and cannot be judged.
    #[error(
        "{scene}: not steady after {steps} steps, which is all that {limit} allows: {column} {to_go}; steady is \
         {tolerance:e} of itself or less (stop.steady.tolerance). Raise {limit}; where what is to go no longer \
         falls, the flow does not settle or rounding holds it there, and only a larger tolerance ends the run"
    )]
    NotSteady {
        /// The scene, with its changes.
        scene: String,
        /// Steps made.
        steps: u64,
        /// What sets that number, in words.
        limit: String,
        /// The column that should have become steady.
        column: String,
        /// How far it still has to go, in words.
        to_go: String,
        /// The relative distance from the final value that is allowed.
        tolerance: f64,
    },
    /// A case asks for a steady state of a scene that has no criterion for one.
    #[error("{0} has no `stop.steady`: add that section, with `record`, `column` and `tolerance`")]
    NoCriterion(String),
    /// A table cannot be read or lacks something.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The user has stopped it.
    #[error(
        "interrupted; at the full scale the state is saved, and the same command goes on from it"
    )]
    Interrupted,
    /// The folder of a run cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A kept run cannot go on from its checkpoint.
    #[error("{0}; remove the run's folder to start it again")]
    Checkpoint(#[from] CheckpointError),
    /// A file.
    #[error(transparent)]
    File(#[from] io::Error),
    /// A figure.
    #[error(transparent)]
    Plot(#[from] psmrt_report::PlotError),
}
