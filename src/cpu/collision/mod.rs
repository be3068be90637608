//! The collision of as many cells as a vector has lanes: relaxation of the moments (SRT is MRT with equal rates), body
//! force, and the partially saturated term.
//!
//! Opposite directions are taken together, so that a change is an even and an odd part for each pair. Populations are
//! shifted, `f_a - w_a`, as in the kernel: what is left is small, and single precision keeps its digits.
//!
//! | file | what it does |
//! |---|---|
//! | `rules.rs` | what the collision of every cell needs to know |
//! | `pairs.rs` | sums and differences of opposite populations |
//! | `relaxation.rs` | moments, their relaxation, body force |
//! | `saturation.rs` | cells that solids fill in part |
//! | `graded.rs` | the same as fluid of graded viscosity |

mod graded;
mod pairs;
mod relaxation;
mod rules;
mod saturation;

use psmrt_reference::directions::Q;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::Rates;

use self::pairs::Sums;
use self::rules::{EDGE, FACE, REST};
pub(super) use self::rules::{Rules, weight};
use crate::lanes::Lanes;

/// A vector times a number.
#[inline(always)]
fn scaled<V: Lanes>([x, y, z]: [V; 3], factor: V) -> [V; 3] {
    [x * factor, y * factor, z * factor]
}

/// The rules in vectors: rates over the squared lengths of the rows of `M`, and the numbers in the formulas.
#[derive(Clone, Copy)]
pub(super) struct Collider<V> {
    one: V,
    half: V,
    two: V,
    three: V,
    four: V,
    four_and_half: V,
    five_and_half: V,
    eight: V,
    eleven: V,
    twelve: V,
    nineteen: V,
    thirty: V,
    thirty_eight: V,
    two_thirds: V,
    tenth: V,
    face: V,
    edge: V,
    rest_drop: V,
    tiny: V,
    huge: V,
    /// `-s/|row|²` of e, eps, 3pxx, 3pixx, pww, piww, pxy, q, m
    relax: [V; 9],
    /// `(1 - s/2)/|row|²` of the same
    drive: [V; 9],
    /// `1/|row|²` of the same
    unit: [V; 9],
    force: Option<[V; 3]>,
    excess: V,
    graded_drag: V,
    odd_in_cut_cells: V,
    operator: SolidOperator,
    weighting: Weighting,
}

/// The squared lengths of the rows of `M` of e, eps, 3pxx, 3pixx, pww, piww, pxy, q, m.
const SQUARED_LENGTHS: [f64; 9] = [2394.0, 252.0, 36.0, 72.0, 12.0, 24.0, 4.0, 40.0, 8.0];

impl<V: Lanes> Collider<V> {
    #[inline(always)]
    pub(super) fn new(token: V::Token, rules: &Rules) -> Self {
        let all = |value: f64| V::splat(token, value);
        let Rates { e, eps, q, nu, pi, m } = rules.rates;
        let rates = [e, eps, nu, pi, nu, pi, nu, q, m];
        let per_row = |value: fn(f64) -> f64| -> [V; 9] {
            std::array::from_fn(|row| all(value(rates[row]) / SQUARED_LENGTHS[row]))
        };
        Collider {
            one: all(1.0),
            half: all(0.5),
            two: all(2.0),
            three: all(3.0),
            four: all(4.0),
            four_and_half: all(4.5),
            five_and_half: all(5.5),
            eight: all(8.0),
            eleven: all(11.0),
            twelve: all(12.0),
            nineteen: all(19.0),
            thirty: all(30.0),
            thirty_eight: all(38.0),
            two_thirds: all(2.0 / 3.0),
            tenth: all(0.1),
            face: all(FACE),
            edge: all(EDGE),
            rest_drop: all(-1.5 * REST),
            tiny: all(1e-30),
            huge: all(1e30),
            relax: per_row(|s| -s),
            drive: per_row(|s| 1.0 - 0.5 * s),
            unit: per_row(|_| 1.0),
            force: rules.body_force.map(|g| [all(g.x), all(g.y), all(g.z)]),
            excess: all(rules.rates.tau() - 0.5),
            graded_drag: all(rules.graded_drag()),
            odd_in_cut_cells: all(rules.odd_in_cut_cells()),
            operator: rules.operator,
            weighting: rules.weighting,
        }
    }

    /// Post-collision populations of cells full of fluid.
    #[inline(always)]
    pub(super) fn fluid(&self, f: &[V; Q]) -> [V; Q] {
        let cell = self.cell(f);
        self.back(&self.moments(&cell)).added_to(f)
    }

    /// Density less 1 and momentum.
    #[inline(always)]
    pub(super) fn sums(f: &[V; Q]) -> [V; 4] {
        let sums = Sums::of(f);
        let [jx, jy, jz] = sums.j;
        [sums.excess, jx, jy, jz]
    }

    #[inline(always)]
    fn cell(&self, f: &[V; Q]) -> Cell<V> {
        let sums = Sums::of(f);
        let rho = sums.excess + self.one;
        Cell { rho, inverse: self.one.over(rho), sums }
    }
}

/// A cell before its collision.
struct Cell<V> {
    sums: Sums<V>,
    rho: V,
    /// `1/ρ`
    inverse: V,
}
