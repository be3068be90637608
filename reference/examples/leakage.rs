//! What leaks through a slab of full cells, across and along it, against `tau`.
//!
//! ```text
//! cargo run --release -p psmrt-reference --example leakage > golden/leakage/expected.csv
//! ```

use psmrt_reference::collision::{Collision, Preset};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::guard::Stopped;
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::partial_saturation::SolidOperator;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;
use std::error::Error;

/// Layers of the slab, and cells of fluid beside it in the periodic column.
const LAYERS: usize = 8;
const FLUID: usize = 8;

/// Force on each fluid cell, so small that what is quadratic in the flow drops out.
const G: f64 = 1e-8;

/// Force on the slab per layer: the pressure gradient in it, or its share of the shear stress.
const PER_LAYER: f64 = G * FLUID as f64 / LAYERS as f64;

fn main() -> Result<(), Box<dyn Error>> {
    println!("# Leak through a slab of {LAYERS} layers with B = 1, lattice units.");
    println!("# Written by `cargo run --release -p psmrt-reference --example leakage`,");
    println!("# psmrt-reference {}.", env!("CARGO_PKG_VERSION"));
    println!(
        "# normal: mass flux across the slab over the pressure gradient in it; 1/2 by theory."
    );
    println!("# permeability: normal times nu, in cells squared (Darcy).");
    println!(
        "# along_1, along_2, along_4: mass flux along the slab in the first, second and fourth"
    );
    println!(
        "# layer from the surface, over the shear force per layer; their mean over all is 1/2."
    );
    println!("# Theory and proof: tests/oracle/leakage.rs.");
    println!("tau,collision,operator,normal,permeability,along_1,along_2,along_4");
    for tau in [0.51, 0.55, 0.6, 0.7, 0.8, 1.0, 1.2, 1.5, 2.0, 3.0] {
        for preset in Preset::ALL {
            let (name, collision) = (preset.word(), preset.collision(tau)?);
            // With full bounce-back nothing leaks: tests/oracle/tight_solids.rs.
            for (operator, word) in [
                (SolidOperator::NonEquilibriumBounceBack, "bounce_back"),
                (SolidOperator::Superposition, "superposition"),
            ] {
                let across = fluxes(collision, operator, 2)?;
                let along = fluxes(collision, operator, 0)?;
                println!(
                    "{tau},{name},{word},{:.6},{:.6},{:.5},{:.5},{:.5}",
                    across[0],
                    across[0] * viscosity(tau),
                    along[0],
                    along[1],
                    along[3]
                );
            }
        }
    }
    Ok(())
}

/// Steady mass flux of each layer under a force along `axis` (the slab lies across z), over the force
/// per layer.
fn fluxes(
    collision: Collision,
    operator: SolidOperator,
    axis: usize,
) -> Result<Vec<f64>, Box<dyn Error>> {
    let slab = Solid::fixed_cells((0..LAYERS).map(|z| (z, 1.0)).collect());
    let mut force = Vec3::zeros();
    force[axis] = G;
    let domain = Domain::new([1, 1, LAYERS + FLUID], Faces::PERIODIC)?;
    let phase = SolidPhase { solids: vec![slab], operator, ..SolidPhase::default() };
    let setup = Setup::fluid(domain, collision).with_body_force(force).with_solids(phase);
    let mut solver = Solver::new(setup)?;
    settle(&mut solver, collision.tau())?;
    Ok(solver.mass_flux_field()[..LAYERS].iter().map(|j| j[axis] / PER_LAYER).collect())
}

/// Runs for twelve times what viscosity needs to cross the fluid, and what a block needs to get going.
fn settle(solver: &mut Solver, tau: f64) -> Result<(), Stopped> {
    let across = (FLUID as f64).powi(2) / (9.87 * viscosity(tau));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few thousand")]
    solver.run((12.0 * (4.0 * across + 100.0)) as u64)
}
