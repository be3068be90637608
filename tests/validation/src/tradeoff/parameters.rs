//! The parameters of one run, as the tables spell them.

use psmrt::table::TableError;
use psmrt_reference::collision::Preset;
use psmrt_reference::coverage::CoverageRule;

/// Names of the columns that a row of parameters has.
pub const COLUMNS: [&str; 11] = [
    "case",
    "geometry",
    "cells",
    "tau",
    "collision",
    "weight",
    "operator",
    "coverage",
    "engine",
    "storage",
    "lattice_velocity",
];

/// A flow with a known answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Between two plates; `cells` from plate to plate.
    Poiseuille,
    /// Through a simple cubic array; geometry: solid fraction, `cells`: edge of the unit cell.
    Sc,
    /// Through a body-centred cubic array, likewise.
    Bcc,
    /// Through a face-centred cubic array, likewise.
    Fcc,
    /// Past a sphere in a slip-sided duct five diameters wide, one every five diameters; geometry: its
    /// solid fraction, `cells`: width of the duct.
    SphereDrag,
    /// A grain that settles in a closed square shaft; geometry: diameter over width, `cells`: diameter.
    Settling,
    /// Through a bed: a face-centred array as dense as sand, like `Fcc`.
    Seepage,
    /// Through eight spheres at random places in a periodic box; geometry and `cells` as in arrays.
    Random,
}

impl Flow {
    /// All of them, in the order of the report.
    pub const ALL: [Flow; 8] = [
        Flow::Poiseuille,
        Flow::Sc,
        Flow::Bcc,
        Flow::Fcc,
        Flow::SphereDrag,
        Flow::Settling,
        Flow::Seepage,
        Flow::Random,
    ];

    /// As tables and the command line spell it.
    pub fn word(self) -> &'static str {
        match self {
            Flow::Poiseuille => "poiseuille",
            Flow::Sc => "sc",
            Flow::Bcc => "bcc",
            Flow::Fcc => "fcc",
            Flow::SphereDrag => "sphere_drag",
            Flow::Settling => "settling",
            Flow::Seepage => "seepage",
            Flow::Random => "random",
        }
    }

    /// The flow that a word stands for.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|flow| flow.word() == word)
    }

    /// The lattice of the literature, and the number of spheres in its unit cell, if it is an array.
    pub fn lattice(self) -> Option<(&'static str, u32)> {
        match self {
            Flow::Sc | Flow::SphereDrag => Some(("SC", 1)),
            Flow::Bcc => Some(("BCC", 2)),
            Flow::Fcc | Flow::Seepage => Some(("FCC", 4)),
            Flow::Random => Some(("random", 8)),
            Flow::Poiseuille | Flow::Settling => None,
        }
    }
}

/// In which numbers populations are kept from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Double precision.
    F64,
    /// Single precision, less the weights: what the kernel does.
    F32Shifted,
    /// Single precision, as they are.
    F32,
    /// Half precision, less the weights, times 2^14.
    F16Shifted,
}

impl Storage {
    /// All of them.
    pub const ALL: [Storage; 4] =
        [Storage::F64, Storage::F32Shifted, Storage::F32, Storage::F16Shifted];

    /// As tables spell it.
    pub fn word(self) -> &'static str {
        match self {
            Storage::F64 => "f64",
            Storage::F32Shifted => "f32_shifted",
            Storage::F32 => "f32_unshifted",
            Storage::F16Shifted => "f16_shifted",
        }
    }
}

/// One run: which flow, and how it is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// The flow.
    pub flow: Flow,
    /// Its geometry as the literature spells it; empty for plates.
    pub geometry: String,
    /// Cells along the length that [`Flow`] names.
    pub cells: u32,
    /// Relaxation time.
    pub tau: f64,
    /// Collision of the fluid.
    pub collision: Preset,
    /// Weight `B`: `NT`, `eps` or `viscous`.
    pub weight: String,
    /// Collision in the solid, as scenes spell it.
    pub operator: String,
    /// How the solid fraction of a cell is found.
    pub coverage: CoverageRule,
    /// Engine: `reference`, `cpu` or `wgpu`.
    pub engine: String,
    /// How populations are kept.
    pub storage: Storage,
    /// Velocity in cells per step: largest between plates, superficial in arrays, Stokes' of a grain.
    pub lattice_velocity: f64,
}

impl Parameters {
    /// The oracle with all defaults.
    pub fn new(flow: Flow, geometry: &str, cells: u32, tau: f64, collision: Preset) -> Self {
        let mut parameters = Parameters {
            flow,
            geometry: geometry.to_owned(),
            cells,
            tau,
            collision,
            weight: "NT".to_owned(),
            operator: "bounce_back".to_owned(),
            coverage: CoverageRule::Exact,
            engine: "reference".to_owned(),
            storage: Storage::F64,
            lattice_velocity: 0.0,
        };
        parameters.lattice_velocity = parameters.usual_velocity();
        parameters
    }

    /// Diameter of a grain in cells; `None` between plates. NaN if the geometry is no number.
    pub fn cells_per_diameter(&self) -> Option<f64> {
        let cells = f64::from(self.cells);
        let geometry = self.geometry.parse().unwrap_or(f64::NAN);
        match (self.flow, self.flow.lattice()) {
            (Flow::Poiseuille, _) => None,
            // n π d³/6 = φ L³
            (_, Some((_, n))) => {
                let part = 6.0 * geometry / (std::f64::consts::PI * f64::from(n));
                Some(cells * part.cbrt())
            }
            (_, None) => Some(cells),
        }
    }

    /// Reynolds number on the diameter, with the velocity of the parameter; 0 between plates.
    pub fn reynolds(&self) -> f64 {
        let nu = (self.tau - 0.5) / 3.0;
        self.cells_per_diameter().map_or(0.0, |d| self.lattice_velocity * d / nu)
    }

    /// Whether populations are kept in fewer digits than the engine computes with.
    pub fn is_emulated(&self) -> bool {
        self.engine == "reference" && self.storage != Storage::F64
    }

    /// A velocity so low that inertia and compressibility hardly count, to three digits.
    fn usual_velocity(&self) -> f64 {
        let nu = (self.tau - 0.5) / 3.0;
        let velocity = match (self.flow, self.cells_per_diameter()) {
            // Free grains should not creep over the grid for ever: Re = 0.05 before the walls slow them.
            (Flow::Settling, Some(d)) => 0.05 * nu / d,
            (_, Some(d)) => 0.005 * nu / d,
            (_, None) => 0.01,
        };
        format!("{velocity:.2e}").parse().unwrap_or(velocity)
    }

    /// The values of [`COLUMNS`].
    pub fn row(&self) -> Vec<String> {
        let coverage = match self.coverage {
            CoverageRule::Exact => "exact".to_owned(),
            CoverageRule::Sampled { n } => format!("sampled_{n}"),
            CoverageRule::Linear => "linear".to_owned(),
        };
        vec![
            self.flow.word().to_owned(),
            self.geometry.clone(),
            self.cells.to_string(),
            self.tau.to_string(),
            self.collision.word().to_owned(),
            self.weight.clone(),
            self.operator.clone(),
            coverage,
            self.engine.clone(),
            self.storage.word().to_owned(),
            format!("{:e}", self.lattice_velocity),
        ]
    }

    /// The parameters of a row of [`COLUMNS`]. Errors if a value is none of the words or no number.
    pub fn from_row(row: &[String]) -> Result<Self, TableError> {
        let wrong = |column: usize| {
            let (name, value) = (COLUMNS[column], row.get(column));
            TableError(format!("column {name} of a row of parameters holds {value:?}"))
        };
        let text = |column: usize| row.get(column).cloned().ok_or_else(|| wrong(column));
        let number = |column: usize| text(column)?.parse().map_err(|_| wrong(column));
        let coverage = match text(7)?.as_str() {
            "exact" => CoverageRule::Exact,
            "linear" => CoverageRule::Linear,
            word => {
                let count = word.strip_prefix("sampled_").and_then(|count| count.parse().ok());
                CoverageRule::Sampled { n: count.ok_or_else(|| wrong(7))? }
            }
        };
        let storage = text(9)?;
        let storage = Storage::ALL.into_iter().find(|kept| kept.word() == storage);
        Ok(Parameters {
            flow: Flow::from_word(&text(0)?).ok_or_else(|| wrong(0))?,
            geometry: text(1)?,
            cells: text(2)?.parse().map_err(|_| wrong(2))?,
            tau: number(3)?,
            collision: Preset::from_word(&text(4)?).ok_or_else(|| wrong(4))?,
            weight: text(5)?,
            operator: text(6)?,
            coverage,
            engine: text(8)?,
            storage: storage.ok_or_else(|| wrong(9))?,
            lattice_velocity: number(10)?,
        })
    }
}
