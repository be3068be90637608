//! Populations of a flow at its start, with the part that is out of equilibrium.
//!
//! Without it the stress is zero at first and, near τ = 1/2, swings about its value for ever: each collision
//! turns its distance from there around, and the velocity swings by `|k|²/6` from step to step. (A mean of two
//! successive steps would take the swing out of what is observed, near τ = 1/2 only, but not out of the flow.)

use nalgebra::Matrix3;
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::equilibrium::equilibrium;
use psmrt_reference::lattice::{Populations, Vec3, W, c};
use psmrt_reference::moments::{CellMatrix, Moments, inverse_moment_matrix, moment_matrix};
use psmrt_reference::rates::Rates;

use super::LabError;
use super::spectral::gradient;

/// The populations of every cell of a periodic box with these densities and velocities, x fastest. Errors
/// if the collision's rates cannot be used.
pub(super) fn populations(
    collision: &Collision,
    cells: [usize; 3],
    states: &[(f64, Vec3)],
) -> Result<Vec<Populations>, LabError> {
    let rates: Moments = match collision {
        Collision::Srt { tau } => Rates::srt(*tau)?,
        Collision::Mrt { rates } => *rates,
    }
    .diagonal();
    let to_moments = CellMatrix::from_faer(&moment_matrix());
    let back = CellMatrix::from_faer(&inverse_moment_matrix());
    let velocities: Vec<Vec3> = states.iter().map(|(_, u)| *u).collect();
    let slopes = gradient(&velocities, cells);
    let cell = |((rho, u), slope): (&(f64, Vec3), &Matrix3<f64>)| {
        // What streaming brings out of equilibrium in a step, to first order in the gradient:
        // D_a = 3 w_a ρ (c_aα c_aβ - δ_αβ/3) ∂_α u_β          (Krüger et al. 2017, Eq. 5.35)
        let brought: Populations = std::array::from_fn(|a| {
            let c = c(a);
            3.0 * W[a] * rho * (c.dot(&(slope * c)) - slope.trace() / 3.0)
        });
        // It takes away as much in a collision where f - f_eq = -M⁻¹ Ŝ⁻¹ M D; what is conserved has none.
        let moments = to_moments.times(&brought);
        let left: Moments =
            std::array::from_fn(|i| if rates[i] == 0.0 { 0.0 } else { -moments[i] / rates[i] });
        let (at_rest, moving) = (equilibrium(*rho, u), back.times(&left));
        std::array::from_fn::<f64, Q, _>(|a| at_rest[a] + moving[a])
    };
    Ok(states.iter().zip(&slopes).map(cell).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use psmrt_reference::collision::Preset;
    use psmrt_reference::domain::{Domain, Faces};
    use psmrt_reference::setup::Setup;
    use psmrt_reference::solver::Solver;

    /// A shear wave `u_x = 0.01 sin(2π y/16)` goes on falling as it fell in its first two steps, by the
    /// viscosity, at any relaxation time; from equilibrium it swings instead.
    #[test]
    fn a_flow_that_starts_with_its_stress_does_not_swing() {
        const N: usize = 16;
        let k = std::f64::consts::TAU / N as f64;
        for model in Preset::ALL {
            for tau in [0.500_1, 0.6, 1.0, 2.0] {
                let collision = model.collision(tau).unwrap();
                let domain = Domain::new([1, N, 1], Faces::PERIODIC).unwrap();
                let states: Vec<(f64, Vec3)> = (0..N)
                    .map(|y| (1.0, Vec3::new(0.01 * (k * (y as f64 + 0.5)).sin(), 0.0, 0.0)))
                    .collect();
                let setup = Setup::fluid(domain, collision);
                let f = populations(&collision, [1, N, 1], &states).unwrap();
                let swing = |mut solver: Solver| {
                    let mut energies = vec![];
                    for _ in 0..3 {
                        let u = solver.velocity_field();
                        energies.push(u.iter().map(Vec3::norm_squared).sum::<f64>());
                        solver.step().unwrap();
                    }
                    (energies[0] - 2.0 * energies[1] + energies[2]).abs() / energies[0]
                };
                let with = swing(Solver::from_populations(setup.clone(), f).unwrap());
                let without = swing(
                    Solver::starting_from(setup, |x| {
                        (1.0, Vec3::new(0.01 * (k * x.y).sin(), 0.0, 0.0))
                    })
                    .unwrap(),
                );
                println!("{model:?} {tau}: {with:.2e}, from equilibrium {without:.2e}");
                // A wave that falls evenly bends by (2 ν k²)², and the start lacks terms of order k⁴.
                let nu = (tau - 0.5) / 3.0;
                let even = (2.0 * nu * k * k).powi(2) + k.powi(4);
                assert!(with < even, "{model:?} {tau}: {with:e} against {even:e}");
                // k²/3 of the velocity, turned around in a second step.
                let swings = tau < 0.9;
                assert!(!swings || without > 0.2 * k * k, "{model:?} {tau}: {without:e}");
            }
        }
    }
}
