//! Derivatives of periodic fields, exact for all waves that the grid holds.

use std::f64::consts::{PI, TAU};

use nalgebra::Matrix3;
use psmrt_reference::lattice::Vec3;

/// The matrix `D` with `(D f)_i = f'(x_i)` for a field of `n` points one apart.
///
/// Source: Trefethen, Spectral Methods in MATLAB (SIAM 2000), chapter 3, for even `n`.
fn matrix(n: usize) -> Vec<f64> {
    let mut entries = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..n {
            if i != j {
                let (apart, sign) =
                    (i as f64 - j as f64, if (i + j) % 2 == 0 { 1.0 } else { -1.0 });
                // D_ij = (2π/n) (-1)^(i-j)/2 cot((i - j) π/n)
                entries[i * n + j] = TAU / n as f64 * 0.5 * sign / (apart * PI / n as f64).tan();
            }
        }
    }
    entries
}

/// The gradient of a periodic velocity field, x fastest: entry (α, β) is `∂_α u_β`. The sides are even
/// numbers of cells, or 1.
pub(super) fn gradient(velocity: &[Vec3], cells: [usize; 3]) -> Vec<Matrix3<f64>> {
    let strides = [1, cells[0], cells[0] * cells[1]];
    let mut found = vec![Matrix3::zeros(); velocity.len()];
    for axis in 0..3 {
        let (n, stride) = (cells[axis], strides[axis]);
        if n == 1 {
            continue;
        }
        let derivative = matrix(n);
        for (cell, found) in found.iter_mut().enumerate() {
            let i = cell / stride % n;
            let start = cell - i * stride;
            let along: Vec3 =
                (0..n).map(|j| derivative[i * n + j] * velocity[start + j * stride]).sum();
            found.set_row(axis, &along.transpose());
        }
    }
    found
}

/// The vorticity of a periodic velocity field, likewise.
pub(super) fn vorticity(velocity: &[Vec3], cells: [usize; 3]) -> Vec<Vec3> {
    // ω_γ = ∂_α u_β - ∂_β u_α
    let turn = |d: Matrix3<f64>| {
        Vec3::new(d[(1, 2)] - d[(2, 1)], d[(2, 0)] - d[(0, 2)], d[(0, 1)] - d[(1, 0)])
    };
    gradient(velocity, cells).into_iter().map(turn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vorticity_of_a_beltrami_flow_is_k_times_its_velocity() {
        let n = 8;
        let k = TAU / n as f64;
        let velocity: Vec<Vec3> = (0..n * n * n)
            .map(|cell| [cell % n, cell / n % n, cell / n / n].map(|i| k * (i as f64 + 0.5)))
            .map(|[x, y, z]| Vec3::new(z.sin() + y.cos(), x.sin() + z.cos(), y.sin() + x.cos()))
            .collect();
        for (found, u) in vorticity(&velocity, [n; 3]).iter().zip(&velocity) {
            // 8 sums of 8 terms of size 1: some tens of epsilons.
            assert!((found - k * u).norm() < 1e-13);
        }
    }
}
