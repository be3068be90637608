//! The error of the mean velocity in a rectangular duct, N cells across its short side.
//!
//! Along a duct only five populations of each kind count, and their steady equations can be expanded in the
//! cell size exactly. With `L` of the wall (`exact.rs`) and `M = (τ - 1/2)(1/s_m - 1/2)`, to second order,
//!
//! ```text
//!   ν (∇²u + (1 - 6 M)/3 ∂²y∂²z u dx²) = -G          in the fluid
//!   u = (16 L - 3) G dx²/(24 ν)                       at the walls
//!   mean over the nodes = mean of the flow + G dx²/(24 ν)
//! ```
//!
//! The walls shift the flow as plates do (Ginzburg & d'Humières 2003); the term in the fluid vanishes between
//! plates and not in a duct, at `L = 3/16` as little as elsewhere. By Green's theorem it changes the mean by
//! `(1 - 6 M)/3 <(∂y∂z u)²>`, so that with `m` the mean velocity in units of `G a²/ν`, `a` the short side, and
//! `b` the long one over it,
//!
//! ```text
//!   error = {(16 L - 2)/(24 m) + (1 - 6 M) I}/N²,   I = 64/(3 m π⁴ b²) Σ 1/(j² + k²/b²)²   (j, k odd)
//!   m = 1/12 - 16/(π⁵ b) Σ tanh(k π b/2)/k⁵                                                (k odd)
//! ```
//!
//! What is left out is of the next order, which the grids of `golden/duct/expected.csv` show.

use std::f64::consts::PI;

use psmrt_reference::collision::Collision;
use psmrt_reference::rates::Rates;

use crate::exact::magic_parameter;

/// A rectangular duct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duct {
    /// `m`
    pub mean: f64,
    /// `I`
    pub bulk: f64,
}

/// The next order over the sum of both terms without their signs, times N²: at most 2.8 in
/// golden/duct/expected.csv, where square ducts of 8 to 16 cells stand.
const NEXT_ORDER: f64 = 4.0;

/// Terms of the series; what is left out is a part in 1e5 of the slower one.
const TERMS: u32 = 200;

impl Duct {
    /// A duct whose long side is `ratio` times its short one.
    pub fn new(ratio: f64) -> Self {
        let odd = || (0..TERMS).map(|i| f64::from(2 * i + 1));
        let tanh: f64 = odd().map(|k| (0.5 * k * PI * ratio).tanh() / k.powi(5)).sum();
        let mean = 1.0 / 12.0 - 16.0 / (PI.powi(5) * ratio) * tanh;
        let row = |j: f64| odd().map(move |k| (j * j + (k / ratio).powi(2)).powi(-2)).sum::<f64>();
        let squares: f64 = odd().map(row).sum();
        Duct { mean, bulk: 64.0 / (3.0 * mean * PI.powi(4) * ratio * ratio) * squares }
    }

    /// Relative error of the mean velocity, `cells` across the short side, and what it lies between.
    pub fn error(&self, collision: &Collision, cells: f64) -> (f64, [f64; 2]) {
        let inner = match collision {
            Collision::Srt { tau } => (tau - 0.5).powi(2),
            Collision::Mrt { rates } => product(rates),
        };
        let squared = cells * cells;
        let wall = (16.0 * magic_parameter(collision) - 2.0) / (24.0 * self.mean) / squared;
        let fluid = (1.0 - 6.0 * inner) * self.bulk / squared;
        let next = NEXT_ORDER / squared * (wall.abs() + fluid.abs());
        let error = wall + fluid;
        (error, [error - next, error + next])
    }
}

/// `(τ - 1/2)(1/s_m - 1/2)`
fn product(rates: &Rates) -> f64 {
    (1.0 / rates.nu - 0.5) * (1.0 / rates.m - 0.5)
}
