//! The faces of the domain: which population enters a cell along a direction that comes from outside.
//!
//! All rules act on single links, from post-collision populations `f*`, and put the boundary
//! half-way between the outermost node and its neighbour outside. With `a` the direction that enters
//! cell `x` and `s = x - c_a` the place outside that it comes from:
//!
//! | face | rule | source |
//! |---|---|---|
//! | periodic | `f*_a` at the wrapped `s` | |
//! | wall | half-way bounce-back, also moving | Ladd 1994, the paper's reference 7 |
//! | velocity inlet | the same with the inlet's velocity | Ladd 1994; Krüger et al. 2017, ch. 5 |
//! | pressure | anti-bounce-back | Ginzburg, Verhaeghe & d'Humières 2008; Krüger ch. 5 |
//! | developed pressure | non-equilibrium extrapolation | Guo, Zheng & Shi, Chinese Phys. 11, 366 (2002) |
//! | non-reflecting pressure | the same, the density following the wave that arrives | [`crate::non_reflecting`] |
//! | free slip | specular reflection, half-way | Krüger et al. 2017, ch. 5 |
//! | free outflow | `f*_a` of the outermost cell: zero gradient | Krüger et al. 2017, ch. 5 |
//!
//! **Edges and corners.** A link that crosses a wall or an inlet is bounced back, whatever else it
//! crosses, with the sum of the velocities of the walls and inlets that it crosses: so every face
//! cell, at an edge too, lets in exactly `rho u_n` and a moving wall creates no mass. Failing that, a
//! link that crosses a face of given pressure obeys it, and then one that crosses a developed or non-reflecting one,
//! or two of them, at the mean of their densities. Else each crossed face in turn wraps, mirrors or clamps the place that the link comes from. Bounce-back acts on the node itself, so a mirror
//! plane that meets a wall or an inlet gives exactly the flow of the whole, unmirrored domain.

use crate::directions::{C, OPPOSITE, number_of};
use crate::domain::{Domain, Face};
use crate::lattice::{CS2, Populations, Vec3, W, c, density, momentum};
use crate::non_reflecting::SlowMeans;

/// The population that enters cell `x` along direction `a` when `x - c_a` lies outside the domain.
pub fn entering(
    domain: &Domain,
    slow_means: &SlowMeans,
    post: &[Populations],
    x: [usize; 3],
    a: usize,
) -> f64 {
    let here = &post[domain.index(x)];
    let mut wall_velocity: Option<Vec3> = None;
    let mut face_density: Option<f64> = None;
    // Axis and side of the faces that the flow inside is carried over.
    let mut carried: [Option<(usize, usize)>; 3] = [None; 3];
    let mut from = x;
    let mut direction = C[a];
    for axis in 0..3 {
        let last = domain.cells()[axis] - 1;
        let side = match C[a][axis] {
            1 if x[axis] == 0 => 0,
            -1 if x[axis] == last => 1,
            along => {
                from[axis] = x[axis].wrapping_add_signed(-along as isize);
                continue;
            }
        };
        match domain.faces().axis(axis)[side] {
            Face::Periodic => from[axis] = last - x[axis],
            Face::FreeSlip => direction[axis] = -direction[axis],
            Face::FreeOutflow => {}
            Face::Wall { velocity } | Face::VelocityInlet { velocity } => {
                wall_velocity = Some(wall_velocity.unwrap_or_else(Vec3::zeros) + velocity);
            }
            Face::Pressure { density } => face_density = Some(density),
            Face::DevelopedPressure { .. } | Face::NonReflectingPressure { .. } => {
                carried[axis] = Some((axis, side));
            }
        }
    }
    match (wall_velocity, face_density) {
        (Some(velocity), _) => bounce_back(here, a, &velocity),
        (None, Some(density)) => anti_bounce_back(here, a, density),
        (None, None) => {
            let (inside, a) = (&post[domain.index(from)], number_of(direction));
            let densities = carried.iter().flatten().filter_map(|&(axis, side)| {
                match domain.faces().axis(axis)[side] {
                    Face::NonReflectingPressure { density, .. } => {
                        Some(slow_means.face_density(domain, (axis, side), density, from, inside))
                    }
                    face => face.held_density(),
                }
            });
            let (sum, count) = densities.fold((0.0, 0.0), |(sum, n), rho| (sum + rho, n + 1.0));
            if count > 0.0 { carried_over(inside, a, sum / count) } else { inside[a] }
        }
    }
}

/// Half-way bounce-back at a wall (or inlet) that moves with `u_w`.
///
/// The density in the wall term is that of the cell: with a constant one a Couette flow of any other
/// density would be wrong in proportion.
pub fn bounce_back(post: &Populations, a: usize, u_w: &Vec3) -> f64 {
    // f_a(x, t+1) = f*_-a(x, t) + 2 w_a ρ (c_a·u_w)/c_s²
    let wall =
        if *u_w == Vec3::zeros() { 0.0 } else { 2.0 * W[a] * density(post) * c(a).dot(u_w) / CS2 };
    post[OPPOSITE[a]] + wall
}

/// Anti-bounce-back at a face of density `rho_w`; the velocity there is taken from the cell.
///
/// On diagonal links it also lets no shear stress through: the face is like the mouth of a jet. In a
/// channel the streamlines spread there and each end counts a twentieth of the width less
/// (`tests/oracle/boundaries.rs`).
pub fn anti_bounce_back(post: &Populations, a: usize, rho_w: f64) -> f64 {
    let u = momentum(post) / density(post);
    let cu = c(a).dot(&u);
    // f_a(x, t+1) = -f*_-a(x, t) + 2 w_a ρ_w [1 + 9/2 (c_a·u)² - 3/2 u²]
    -post[OPPOSITE[a]] + 2.0 * W[a] * rho_w * (1.0 + 4.5 * cu * cu - 1.5 * u.dot(&u))
}

/// What a cell would send in from outside a face of density `rho_w` half a cell away if the flow did not change
/// along the normal: its own populations at the density that is as far beyond the face's as its own is
/// on this side of it. `post` is the outermost cell that the link would come from, clamped into the domain.
///
/// Velocity and stress are those of that cell, so that Poiseuille flow passes as it is
/// (`tests/oracle/boundaries.rs`).
pub fn carried_over(post: &Populations, a: usize, rho_w: f64) -> f64 {
    let rho = density(post);
    let u = momentum(post) / rho;
    let cu = c(a).dot(&u);
    // f_a(x, t+1) = f*_a(x') + f_a^eq(2 ρ_w - ρ', u') - f_a^eq(ρ', u')
    let f_eq_of_one = W[a] * (1.0 + 3.0 * cu + 4.5 * cu * cu - 1.5 * u.dot(&u));
    post[a] + 2.0 * (rho_w - rho) * f_eq_of_one
}
