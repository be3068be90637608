//! The body force: Guo's source term, in velocity space and in moment space.
//!
//! Source: Guo, Zheng & Shi, Phys. Rev. E 65, 046308 (2002); for MRT, Premnath & Abraham, J. Comput.
//! Phys. 224, 539 (2007). The paper writes `G` in Eq. 1 and gives no scheme. The velocity in the
//! equilibrium and in the source is the one half-way through the collision, [`forced_velocity`].

use crate::directions::Q;
use crate::lattice::{Populations, Vec3, W, c};
use crate::moments::Moments;

/// Velocity half-way through a collision in which the body force `body_force` (per volume) acts.
pub fn forced_velocity(rho: f64, j: &Vec3, body_force: &Vec3) -> Vec3 {
    // u = (j + G/2)/ρ
    (j + 0.5 * body_force) / rho
}

/// Guo's source before it is scaled by the relaxation, in velocity space.
pub fn source(u: &Vec3, body_force: &Vec3) -> Populations {
    let mut source = [0.0; Q];
    for a in 0..Q {
        // F_a = w_a [3 (c_a - u) + 9 (c_a·u) c_a]·G
        let c = c(a);
        source[a] = W[a] * (3.0 * (c - u) + 9.0 * c.dot(u) * c).dot(body_force);
    }
    source
}

/// The same source in moment space: `M` times [`source`], written out.
pub fn source_moments(u: &Vec3, body_force: &Vec3) -> Moments {
    let (g, uxg) = (body_force, u.component_mul(body_force));
    let ug = u.dot(g);
    // The derivative of the equilibrium moments along (ρu → G):
    // 3 p_xx: 2 (2 u_x G_x - u_y G_y - u_z G_z),  p_ww: 2 (u_y G_y - u_z G_z)
    let three_pxx = 2.0 * (2.0 * uxg.x - uxg.y - uxg.z);
    let pww = 2.0 * (uxg.y - uxg.z);
    [
        0.0,
        38.0 * ug,
        -11.0 * ug,
        g.x,
        -2.0 / 3.0 * g.x,
        g.y,
        -2.0 / 3.0 * g.y,
        g.z,
        -2.0 / 3.0 * g.z,
        three_pxx,
        -0.5 * three_pxx,
        pww,
        -0.5 * pww,
        u.x * g.y + u.y * g.x,
        u.y * g.z + u.z * g.y,
        u.x * g.z + u.z * g.x,
        0.0,
        0.0,
        0.0,
    ]
}
