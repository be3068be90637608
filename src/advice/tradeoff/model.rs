//! Error models: what the physics says with free numbers, fitted to runs with known answers, with bands. The numbers
//! stand in `src/advice/coefficients.csv`; the fits are in `tests/validation/src/tradeoff/fitting.rs`.
//!
//! **Grains.** Each full cell lets a flux through in proportion to the pressure gradient
//! (`tests/oracle/leakage.rs`): a body of permeability ν/2. The velocity under a given force is therefore too
//! large by a share that falls as `d²`, grows with `τ - 1/2` and with the drag `K` over Stokes' drag. What
//! remains comes from cells that are covered in part, and falls faster:
//!
//! ```text
//!   error = K^m [a (τ - 1/2)/d² + b/d^p]
//! ```
//!
//! The superposition operator has its own numbers in the same form. The weight `B = ε` errs in two ways of
//! opposite sign (`model_eps.rs`), and so do the operators that let no fluid through (`model_tight.rs`).
//!
//! **Plates.** Half-way bounce-back slips by an amount that is known in closed form; the rest is of second
//! order in the lattice velocity (d'Humières' rates treat the third-order moments as if the flow stood
//! still):
//!
//! ```text
//!   error = s |16 L - 3|/(3 H²)/sqrt(8/15) + c u²,   L = (τ - 1/2)[(1/s_q - 1/2) + 3 (1/s_m - 1/2)]/4
//! ```
//!
//! Bands hold 95 % of what is to be expected: 1.96 times the scatter of the logarithms, where the scatter is
//! that of geometries that the model has not seen (each is left out in turn).

use psmrt_reference::collision::{Collision, Preset};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;

use crate::advice::coefficients::numbers;
use crate::exact::magic_parameter;
use crate::scene::format_grains::OperatorName;
use crate::table::TableError;

/// Below this the models say nothing: errors are then as large as what the place of a grain on the grid
/// does (0.3 %), and may have either sign.
pub const LEAST_ERROR: f64 = 0.01;

/// Quantile of the normal distribution that leaves 2.5 % at either end.
pub const QUANTILE: f64 = 1.96;

/// Below this relaxation time what remains beside the leak counts most, and has either sign: there
/// `model_low.rs` speaks.
pub const LEAST_TAU: f64 = 0.6;

/// How cells collide that are solid in part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidMethod {
    /// Noble and Torczynski's weight, bounce-back operator.
    Usual,
    /// The superposition operator.
    Superposition,
    /// The weight `B = ε`.
    SolidFraction,
    /// Full bounce-back, with Noble and Torczynski's weight.
    FullBounceBack,
    /// Graded viscosity, with its own weight.
    Graded,
}

impl SolidMethod {
    /// All of them.
    pub const ALL: [SolidMethod; 5] = [
        SolidMethod::Usual,
        SolidMethod::Superposition,
        SolidMethod::SolidFraction,
        SolidMethod::FullBounceBack,
        SolidMethod::Graded,
    ];

    /// As tables spell it.
    pub fn word(self) -> &'static str {
        match self {
            SolidMethod::Usual => "NT",
            SolidMethod::Superposition => "superposition",
            SolidMethod::SolidFraction => "eps",
            SolidMethod::FullBounceBack => "full_bounce_back",
            SolidMethod::Graded => "graded",
        }
    }

    /// That of a weight and an operator; `None` for two that no run of the evidence has together.
    pub fn of(weighting: Weighting, operator: SolidOperator) -> Option<Self> {
        match (weighting, operator) {
            (Weighting::NobleTorczynski, SolidOperator::NonEquilibriumBounceBack) => {
                Some(SolidMethod::Usual)
            }
            (Weighting::NobleTorczynski, SolidOperator::Superposition) => {
                Some(SolidMethod::Superposition)
            }
            (Weighting::NobleTorczynski, SolidOperator::FullBounceBack) => {
                Some(SolidMethod::FullBounceBack)
            }
            (Weighting::SolidFraction, SolidOperator::NonEquilibriumBounceBack) => {
                Some(SolidMethod::SolidFraction)
            }
            (Weighting::Graded, SolidOperator::GradedViscosity) => Some(SolidMethod::Graded),
            (Weighting::SolidFraction | Weighting::Graded, _)
            | (_, SolidOperator::GradedViscosity) => None,
        }
    }

    /// Its weight.
    pub fn weighting(self) -> Weighting {
        match self {
            SolidMethod::Usual | SolidMethod::Superposition | SolidMethod::FullBounceBack => {
                Weighting::NobleTorczynski
            }
            SolidMethod::SolidFraction => Weighting::SolidFraction,
            SolidMethod::Graded => Weighting::Graded,
        }
    }

    /// Its operator, as the scene key `solid.operator` has it.
    pub fn operator(self) -> OperatorName {
        match self {
            SolidMethod::Usual | SolidMethod::SolidFraction => OperatorName::BounceBack,
            SolidMethod::Superposition => OperatorName::Superposition,
            SolidMethod::FullBounceBack => OperatorName::FullBounceBack,
            SolidMethod::Graded => OperatorName::GradedViscosity,
        }
    }

    /// In words, as documents have it.
    pub fn title(self) -> &'static str {
        match self {
            SolidMethod::Usual => "non-equilibrium bounce-back",
            SolidMethod::Superposition => "superposition",
            SolidMethod::SolidFraction => "the weight B = epsilon",
            SolidMethod::FullBounceBack => "full bounce-back",
            SolidMethod::Graded => "graded viscosity",
        }
    }

    /// What a word of a table stands for.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.word() == word)
    }
}

/// What the runs were that a model was fitted to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Scatter of the logarithm that the model is fitted to, in geometries left out of the fit.
    pub scatter: f64,
    /// Number of runs, and of geometries.
    pub counts: [usize; 2],
    /// Smallest and largest cells per diameter, relaxation time and drag among them.
    pub ranges: [[f64; 2]; 3],
}

impl Evidence {
    /// That of a row of coefficients, which has it after the parameters.
    pub(super) fn committed(of: &str) -> Result<Self, TableError> {
        let [scatter, runs, geometries, ranges @ ..] = numbers::<9>("grains: evidence", of)?;
        let [a, b, c, d, e, f] = ranges;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small counts")]
        let counts = [runs, geometries].map(|count| count as usize);
        Ok(Evidence { scatter, counts, ranges: [[a, b], [c, d], [e, f]] })
    }
}

/// The error of flows with grains, for one collision of the fluid and of solid cells.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainModel {
    /// The collision.
    pub collision: Preset,
    /// How solid cells collide.
    pub solid: SolidMethod,
    /// `ln a`, `ln b`, `m`, `p`
    pub parameters: [f64; 4],
    /// What they were fitted to; the scatter is that of the error.
    pub evidence: Evidence,
}

/// `error = K^m [a (τ - 1/2)/d² + b/d^p]`
pub fn grain_error(parameters: &[f64], d: f64, tau: f64, drag: f64) -> f64 {
    let [a, b, m, p] = [parameters[0].exp(), parameters[1].exp(), parameters[2], parameters[3]];
    drag.powf(m) * (a * (tau - 0.5) / (d * d) + b / d.powf(p))
}

impl GrainModel {
    /// Relative error of the velocity under a given force.
    pub fn error(&self, d: f64, tau: f64, drag: f64) -> f64 {
        grain_error(&self.parameters, d, tau, drag)
    }

    /// The factor by which the measured error may be larger or smaller.
    pub fn band(&self) -> f64 {
        (QUANTILE * self.evidence.scatter).exp()
    }
}

/// The error between plates, for one collision.
#[derive(Clone, Debug, PartialEq)]
pub struct WallModel {
    /// The collision.
    pub collision: Preset,
    /// `s` and `c`
    pub parameters: [f64; 2],
    /// Scatter of the logarithm of the error.
    pub scatter: f64,
    /// Number of runs.
    pub count: usize,
}

/// Relative L2 error that the known slip of the wall makes, `h` cells from plate to plate.
pub fn slip_error(collision: Preset, tau: f64, h: f64) -> f64 {
    // Slip over the largest velocity: (G/(24 ν))/(G H²/(8 ν)) (16 L - 3).
    let slip = (16.0 * parameter(collision, tau) - 3.0).abs() / (3.0 * h * h);
    // Mean square of the parabola 1 - ξ² at the middles of h cells: 8/15 + 7/(15 h⁴).
    slip / (8.0 / 15.0 + 7.0 / (15.0 * h.powi(4))).sqrt()
}

/// `L` of a collision.
pub fn parameter(collision: Preset, tau: f64) -> f64 {
    match collision {
        Preset::Srt => magic_parameter(&Collision::Srt { tau }),
        Preset::DHumieres => Rates::dhumieres(tau)
            .map_or(f64::NAN, |rates| magic_parameter(&Collision::Mrt { rates })),
        Preset::Trt => 3.0 / 16.0,
    }
}

impl WallModel {
    /// Relative L2 error of the profile, `h` cells from plate to plate, `velocity` cells per step.
    pub fn error(&self, h: f64, tau: f64, velocity: f64) -> f64 {
        let [s, c] = self.parameters;
        s * slip_error(self.collision, tau, h) + c * velocity * velocity
    }

    /// The factor by which the measured error may be larger or smaller: a closed form leaves next to no
    /// scatter, but the flows are steady to a share of 1e-8 a row only, and the error may be 1e-4.
    pub fn band(&self) -> f64 {
        (QUANTILE * self.scatter).exp().max(NARROWEST)
    }
}

/// The narrowest band between plates.
const NARROWEST: f64 = 1.02;

/// A predicted error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The error, signed.
    pub error: f64,
    /// What 95 % lie between.
    pub band: [f64; 2],
    /// Cells per diameter and relaxation times that the evidence has.
    pub ranges: [[f64; 2]; 2],
}

/// The combinations of collision and solid method that have a model in the form of [`GrainModel`].
pub const METHODS: [(Preset, SolidMethod); 4] = [
    (Preset::Srt, SolidMethod::Usual),
    (Preset::DHumieres, SolidMethod::Usual),
    (Preset::Trt, SolidMethod::Usual),
    (Preset::DHumieres, SolidMethod::Superposition),
];

/// What a row of coefficients of such a method is called.
pub fn method(collision: Preset, solid: SolidMethod) -> String {
    format!("{} {}", collision.word(), solid.word())
}
