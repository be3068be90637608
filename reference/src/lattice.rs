//! D3Q19 in numbers: weights, speed of sound, and the density and momentum of a set of populations.
//!
//! Source: Qian, d'Humières & Lallemand, Europhys. Lett. 17, 479 (1992), the paper's reference 6.
//! Lattice units throughout: the grid spacing and the time step are 1.

use crate::directions::{C, Q};

/// A vector in lattice units, components x, y, z.
pub type Vec3 = nalgebra::Vector3<f64>;

/// Populations `f_a` of one cell, in the order [`crate::directions::ORDER`].
pub type Populations = [f64; Q];

/// Weights `w_a`: 1/3 at rest, 1/18 for the six faces, 1/36 for the twelve edges.
pub const W: [f64; Q] = {
    const REST: f64 = 1.0 / 3.0;
    const FACE: f64 = 1.0 / 18.0;
    const EDGE: f64 = 1.0 / 36.0;
    [
        REST, FACE, FACE, FACE, FACE, FACE, FACE, EDGE, EDGE, EDGE, EDGE, EDGE, EDGE, EDGE, EDGE,
        EDGE, EDGE, EDGE, EDGE,
    ]
};

/// Square of the speed of sound, `c_s² = 1/3`.
pub const CS2: f64 = 1.0 / 3.0;

/// Direction `c_a` as a vector of floating-point numbers.
pub fn c(a: usize) -> Vec3 {
    Vec3::new(f64::from(C[a][0]), f64::from(C[a][1]), f64::from(C[a][2]))
}

/// Density, the zeroth moment.
pub fn density(f: &Populations) -> f64 {
    // ρ = Σ_a f_a
    f.iter().sum()
}

/// Momentum, the first moment (bare: no part of a body force is added).
pub fn momentum(f: &Populations) -> Vec3 {
    // j = Σ_a c_a f_a, summed along each axis in the order of the directions
    let mut j = [0.0; 3];
    for a in 0..Q {
        for (component, &c) in j.iter_mut().zip(&C[a]) {
            *component += f64::from(c) * f[a];
        }
    }
    Vec3::from(j)
}

/// Kinematic viscosity of relaxation time `tau` (section 2 of the paper).
pub fn viscosity(tau: f64) -> f64 {
    // ν = c_s² (τ - 1/2)
    CS2 * (tau - 0.5)
}

/// Relaxation time of kinematic viscosity `nu`: the inverse of [`viscosity`].
pub fn relaxation_time(nu: f64) -> f64 {
    nu / CS2 + 0.5
}
