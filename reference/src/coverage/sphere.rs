//! Solid fraction of a sphere in a unit cell, exactly: the volume that the two have in common.
//!
//! Let O be the centre of the sphere and `a` its radius. The common volume is a sum of cones with
//! apex O over the faces of the cell. Where O is on the outer side of a face, its cone counts as
//! negative: what lies between O and the cell cancels. With F the foot of O on the plane of a face,
//! the face in turn is a sum of triangles with apex F over its edges, negative where F is on the
//! outer side of the edge. The surface of the sphere divides an edge into stretches `s..t`, measured
//! from the foot of O on the edge; the cone over one of them is
//!
//! - within the sphere: a tetrahedron ([`edge_volume`]), or
//! - beyond it: the sphere's sector less the cap that the face cuts off ([`far_cone`]).
//!
//! ```text
//!  the face, along its normal              the cone over a far stretch, from the side
//!
//!     --+-----s=======t-- edge                  ---..
//!       |    /   _.-'                             cap `-.
//!     e |   /_.-'   Δφ = angle s F t            F--------*---------+ edge
//!       | _/'                                   |         `.   _.-'
//!       F                                     d |        _.-*'
//!                                               |   _.-'  a: the sphere's surface
//!    ω = solid angle of s F t, from O           O-'
//! ```
//!
//! Each edge belongs to two faces, so twelve edges count twice each. All angles are those of one
//! stretch, hence small where the sphere is large: rounding errors add up to about `a² · 1e-16`,
//! where a sum over corners would leave `a³ · 1e-16`.
//!
//! Sources: Strobl, Formella & Pöschel, J. Comput. Phys. 311, 158 (2016), treat the same problem for
//! any hexahedron, in another way; the solid angle is that of van Oosterom & Strackee, IEEE Trans.
//! Biomed. Eng. 30, 125 (1983).

use crate::lattice::Vec3;

/// Solid fraction, in 0..=1, of a sphere of `radius` cells whose centre lies at `centre` from the
/// centre of the cell.
///
/// The 48 symmetries of the cube hold to the last bit. The absolute error is a few times
/// `(1 + radius²) · 1e-16`.
pub fn exact_fraction(centre: &Vec3, radius: f64) -> f64 {
    let centre = fold(centre);
    if let Some(fraction) = uncut_fraction(&centre, radius) {
        return fraction;
    }
    let mut volume = 0.0;
    for axis in 0..3 {
        // The four edges along this axis; the faces that meet in them lie across the other two.
        let (start, end) = (-0.5 - centre[axis], 0.5 - centre[axis]);
        for d in face_distances(centre[(axis + 1) % 3]) {
            for e in face_distances(centre[(axis + 2) % 3]) {
                volume += edge_volume(radius, d, e, start, end);
            }
        }
    }
    // The cell has the volume 1. Rounding must not carry the fraction out of 0..=1.
    volume.clamp(0.0, 1.0)
}

/// The position with `0 <= x <= y <= z` that a symmetry of the cube makes of `centre`.
pub(super) fn fold(centre: &Vec3) -> Vec3 {
    let mut folded = centre.abs();
    folded.as_mut_slice().sort_unstable_by(f64::total_cmp);
    folded
}

/// 0 or 1 where the sphere contains nothing or all of the cell. `centre` is folded.
pub(super) fn uncut_fraction(centre: &Vec3, radius: f64) -> Option<f64> {
    // Squares of the distances from the sphere's centre to the cell's nearest and farthest point.
    let nearest = centre.map(|c| (c - 0.5).max(0.0)).norm_squared();
    let farthest = centre.add_scalar(0.5).norm_squared();
    if nearest >= radius * radius {
        Some(0.0)
    } else if farthest <= radius * radius {
        Some(1.0)
    } else {
        None
    }
}

/// Distances of the sphere's centre, at `c`, from the upper and the lower face across one axis;
/// negative where it is on the outer side of the face.
fn face_distances(c: f64) -> [f64; 2] {
    [0.5 - c, 0.5 + c]
}

/// Volume of the cones over one edge from `start` to `end`, as part of the faces at the distances
/// `d` and `e` that meet there. The foot on the one is as far from the edge as O is from the other.
fn edge_volume(a: f64, d: f64, e: f64, start: f64, end: f64) -> f64 {
    // The edge is in the sphere where x² ≤ h² = a² - d² - e².
    let h = (a * a - d * d - e * e).max(0.0).sqrt();
    let (enter, leave) = ((-h).max(start).min(end), h.max(start).min(end));
    // V = 2 · d e (t - s) / 6 within the sphere
    let mut volume = d * e * (leave - enter) / 3.0;
    for (s, t) in [(start, enter), (leave, end)] {
        if s < t {
            // |r|² = d² + e² + x², the distance of O from x on the edge
            let r = [s, t].map(|x| (d * d + e * e + x * x).sqrt());
            volume += far_cone(a, d, e, [s, t], r) + far_cone(a, e, d, [s, t], r);
        }
    }
    volume
}

/// Volume, in the sphere, of the cone over the stretch `s..t` of an edge where it is beyond the
/// sphere; `d` from O to the face, `e` from F to the edge, `r` from O to `s` and `t`.
fn far_cone(a: f64, d: f64, e: f64, stretch: [f64; 2], r: [f64; 2]) -> f64 {
    // V = ± (ω a³ / 3 - κ Δφ), the sign that of d
    let sector = solid_angle(d.abs(), e, stretch, r) * a * a * a / 3.0;
    // A plane that passes the sphere by cuts off no cap: its angle, half of the work, is not needed.
    let cap = if d.abs() < a { cap_per_radian(a, d.abs()) * plane_angle(e, stretch) } else { 0.0 };
    d.signum() * (sector - cap)
}

/// Solid angle of the triangle s F t, seen from O; its sign is that of `e`.
fn solid_angle(d: f64, e: f64, [s, t]: [f64; 2], [r_s, r_t]: [f64; 2]) -> f64 {
    // With n the face's normal: n·r_s = n·r_t = d, n·(r_s × r_t) = e (t - s), r_s·r_t = d² + e² + st
    // tan(ω/2) = n·(r_s × r_t) / (|r_s| |r_t| + n·r_s |r_t| + n·r_t |r_s| + r_s·r_t)
    2.0 * (e * (t - s)).atan2((r_s + d) * (r_t + d) + e * e + s * t)
}

/// Angle at F of the triangle s F t; its sign is that of `e`.
fn plane_angle(e: f64, [s, t]: [f64; 2]) -> f64 {
    // tan Δφ = e (t - s) / (e² + s t)
    (e * (t - s)).atan2(e * e + s * t)
}

/// Volume, per radian about its axis, of the cap that a plane at distance `d` from 0 to `a` cuts off.
fn cap_per_radian(a: f64, d: f64) -> f64 {
    // κ = V_cap / 2π = h² (3a - h) / 6, h = a - d
    let height = a - d;
    height * height * (3.0 * a - height) / 6.0
}
