//! What a sphere covers of cells, by each rule: for the engines. The oracle has its own code.
//!
//! | file | rule |
//! |---|---|
//! | `exact.rs` | in closed form, of one cell |
//! | `exact_rows.rs` | in closed form, of whole rows |
//! | `sampled.rs` | by sample points |
//! | `linear.rs` | linear in the distance of the centres |

mod exact;
mod exact_rows;
mod linear;
mod sampled;

pub use exact::solid_fraction;
pub use sampled::sampled_fraction;

use std::ops::RangeInclusive;

use psmrt_reference::coverage::CoverageRule;

/// The cells along each axis, by their lowest corners, among which are all that a ball touches.
pub fn cells_about(centre: [f64; 3], radius: f64) -> [RangeInclusive<i64>; 3] {
    centre.map(|c| floor(c - radius)..=floor(c + radius))
}

/// The cell of a coordinate.
#[expect(clippy::cast_possible_truncation, reason = "beyond 2^63 it saturates")]
fn floor(coordinate: f64) -> i64 {
    coordinate.floor() as i64
}

/// Tells the solid fraction of each of `cells` that a ball of `radius` about `centre` touches, by the cell's
/// lowest corner.
pub fn solid_fractions(
    rule: CoverageRule,
    centre: [f64; 3],
    radius: f64,
    cells: &[RangeInclusive<i64>; 3],
    mut tell: impl FnMut([i64; 3], f64),
) {
    rows_of_fractions(rule, centre, radius, cells, |[x, y, z], fractions| {
        for (i, fraction) in (x..).zip(fractions) {
            tell([i, y, z], *fraction);
        }
    });
}

/// Tells the solid fractions of those of `cells` that a ball of `radius` about `centre` touches, row by row, by the
/// lowest corner of the row's first.
pub fn rows_of_fractions(
    rule: CoverageRule,
    centre: [f64; 3],
    radius: f64,
    cells: &[RangeInclusive<i64>; 3],
    tell: impl FnMut([i64; 3], &[f64]),
) {
    if cells.iter().any(RangeInclusive::is_empty) {
        return;
    }
    match rule {
        CoverageRule::Exact => exact_rows::rows(centre, radius, cells, tell),
        CoverageRule::Sampled { n } => sampled::rows(centre, radius, n, cells, tell),
        CoverageRule::Linear => linear::rows(centre, radius, cells, tell),
    }
}
