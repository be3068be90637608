//! Equilibria: second order in the velocity, in velocity space and in moment space.
//!
//! Both forms are the same model (a test holds them together to round-off); the paper's SRT (Eq. 2)
//! and solid term (Eq. 5) use the first, its MRT (Eq. 3) the second.

use crate::directions::Q;
use crate::lattice::{Populations, Vec3, W, c};
use crate::moments::Moments;

/// Equilibrium populations `f_eq(rho, u)`. Source: Qian et al. (1992), the paper's reference 6.
pub fn equilibrium(rho: f64, u: &Vec3) -> Populations {
    let u2 = u.dot(u);
    let mut f_eq = [0.0; Q];
    for a in 0..Q {
        // f_a^eq = w_a ρ [1 + 3 c_a·u + 9/2 (c_a·u)² - 3/2 u²]
        let cu = c(a).dot(u);
        f_eq[a] = W[a] * rho * (1.0 + 3.0 * cu + 4.5 * cu * cu - 1.5 * u2);
    }
    f_eq
}

/// Equilibrium moments `m_eq(rho, u)`.
///
/// Source: d'Humières et al. (2002), with `j = rho u` and the constants
/// `(w_eps, w_epsj, w_xx) = (3, -11/2, -1/2)` with which `m_eq = M f_eq`. Their "optimised"
/// constants `(0, -475/63, 0)` are another model, and so is their constant density in `j²/rho_0`.
pub fn equilibrium_moments(rho: f64, u: &Vec3) -> Moments {
    let j = rho * u;
    let (jx, jy, jz) = (j.x, j.y, j.z);
    // 3 p_xx = (2 j_x² - j_y² - j_z²)/ρ,  p_ww = (j_y² - j_z²)/ρ
    let three_pxx = (2.0 * jx * jx - jy * jy - jz * jz) / rho;
    let pww = (jy * jy - jz * jz) / rho;
    let j2 = j.dot(&j) / rho;
    [
        rho,
        -11.0 * rho + 19.0 * j2,
        3.0 * rho - 5.5 * j2,
        jx,
        -2.0 / 3.0 * jx,
        jy,
        -2.0 / 3.0 * jy,
        jz,
        -2.0 / 3.0 * jz,
        three_pxx,
        -0.5 * three_pxx,
        pww,
        -0.5 * pww,
        jx * jy / rho,
        jy * jz / rho,
        jx * jz / rho,
        0.0,
        0.0,
        0.0,
    ]
}
