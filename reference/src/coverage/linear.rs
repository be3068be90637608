//! Solid fraction of a sphere in a unit cell from the distance between the two centres: the cheapest alternative.

use crate::lattice::Vec3;

/// The smallest radius, in cells, for which [`linear_fraction`] is meant: a smaller sphere hardly fills a cell.
pub const SMALLEST_LINEAR_RADIUS: f64 = 1.0;

/// Solid fraction of a sphere of `radius` cells (at least [`SMALLEST_LINEAR_RADIUS`]) whose centre lies at `centre` from
/// the centre of the cell, as if the surface were a plane across an axis of the cell, wherever it cuts it.
///
/// The form is that of Jones & Williams, Eng. Comput. 34, 1204 (2017). The shift of the surface by `1/(12 a)` follows
/// from the volume: over all positions of the sphere, the mean of the sum over cells is `4π ∫ ε(d) d² dd`, and this is
/// `4/3 π a³` if `α³ + α/4 = a³`. At 8 cells per diameter a fraction is off by 0.02 (rms over cut cells).
pub fn linear_fraction(centre: &Vec3, radius: f64) -> f64 {
    // α = a - 1/(12 a), the root of α³ + α/4 = a³ but for terms of order a⁻⁵
    let alpha = radius - 1.0 / (12.0 * radius);
    // ε = min(1, max(0, α + 1/2 - d))
    (alpha + 0.5 - centre.norm()).clamp(0.0, 1.0)
}
