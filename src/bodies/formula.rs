//! Bodies that formulas give, as meshes about the origin: a box, a cylinder and a pipe along z, a half-space below z = 0.
//!
//! Round ones have flat sides, as many as [`SIDES`], and the circle's area: their sides are no further than `R (π/n)²/3` from the circle.

use std::f64::consts::PI;

use psmrt_reference::lattice::Vec3;

use super::mesh::Mesh;

/// Flat sides of what is round: they are within 5e-5 of the radius of it.
pub const SIDES: u32 = 256;

/// A box with these edges.
pub fn cuboid(edges: &Vec3) -> Mesh {
    let [x, y, z] = (0.5 * edges).into();
    let square = [[-x, -y], [x, -y], [x, y], [-x, y]];
    prism(&square, z)
}

/// A cylinder.
pub fn cylinder(radius: f64, length: f64) -> Mesh {
    prism(&circle(radius), 0.5 * length)
}

/// The wall of a pipe between two radii.
pub fn pipe(inner: f64, outer: f64, length: f64) -> Mesh {
    let z = 0.5 * length;
    let rings = [(inner, -z), (inner, z), (outer, -z), (outer, z)];
    let corners = rings
        .iter()
        .flat_map(|&(radius, z)| circle(radius).into_iter().map(move |[x, y]| Vec3::new(x, y, z)));
    let at = |ring: u32, side: u32| ring * SIDES + side % SIDES;
    let band = |side: u32, [low, high]: [u32; 2]| {
        let next = side + 1;
        [
            [at(low, side), at(low, next), at(high, next)],
            [at(low, side), at(high, next), at(high, side)],
        ]
    };
    // Seen from outside: outer wall, upper ring, inner wall, lower ring.
    let bands = [[2, 3], [3, 1], [1, 0], [0, 2]];
    let triangles =
        (0..SIDES).flat_map(|side| bands.into_iter().flat_map(move |both| band(side, both)));
    Mesh::known(corners.collect(), triangles.collect())
}

/// What lies below z = 0, as far as `reach`.
pub fn half_space(reach: f64) -> Mesh {
    cuboid(&Vec3::repeat(2.0 * reach)).mapped(|corner| corner - Vec3::z() * reach)
}

/// The corners of a polygon with the area of a circle.
fn circle(radius: f64) -> Vec<[f64; 2]> {
    // n/2 r² sin(2π/n) = π R²
    let angle = 2.0 * PI / f64::from(SIDES);
    let r = radius * (angle / angle.sin()).sqrt();
    (0..SIDES).map(|side| f64::from(side) * angle).map(|a| [r * a.cos(), r * a.sin()]).collect()
}

/// A prism over a convex polygon, from `-z` to `z`.
fn prism(polygon: &[[f64; 2]], z: f64) -> Mesh {
    let count = u32::try_from(polygon.len()).unwrap_or(u32::MAX);
    let corners =
        [-z, z].into_iter().flat_map(|z| polygon.iter().map(move |&[x, y]| Vec3::new(x, y, z)));
    let mut triangles = Vec::new();
    for side in 0..count {
        let next = (side + 1) % count;
        triangles.extend([[side, next, count + next], [side, count + next, count + side]]);
    }
    for side in 1..count - 1 {
        triangles.extend([[0, side + 1, side], [count, count + side, count + side + 1]]);
    }
    Mesh::known(corners.collect(), triangles)
}
