//! The cause that free grains give: the guard of the fluid sees neither their densities nor gravity.

use psmrt_reference::coupling::{FreeGrains, Gravity};
use psmrt_reference::domain::Face;
use psmrt_reference::grains::grain::{Grain, sphere_volume};

use super::Cause;

/// Grains of less than this many times the density of the fluid did not live: 0.8 did, 0.5 did not
/// (`golden/stability/movers.csv`).
const LIGHT: f64 = 0.8;

/// Slower than this, in cells per step, a grain has not broken anything.
const SLOW: f64 = 0.1;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The cause that they give, if there is evidence of one. With implicit coupling light grains are stable.
pub(super) fn cause(
    grains: &FreeGrains,
    solids: &[usize],
    steps: u64,
    is_implicit: bool,
) -> Option<Cause> {
    let light = if is_implicit { None } else { light_grain(grains, solids) };
    light.or_else(|| endless_fall(grains, steps))
}

/// The lightest of the free grains that are fast (or no longer at a finite speed), if it is too light.
fn light_grain(grains: &FreeGrains, solids: &[usize]) -> Option<Cause> {
    let fluid_density = grains.settings().fluid_density;
    let ratio = |grain: &Grain| grain.mass / (fluid_density * sphere_volume(grain.radius));
    let is_slow = |grain: &Grain| {
        grain.velocity.norm() <= SLOW && grain.radius * grain.angular_velocity.norm() <= SLOW
    };
    let all = grains.system().grains().iter().enumerate();
    let fast = all.filter(|(_, grain)| !grain.held && !is_slow(grain));
    let ratios = fast.map(|(number, grain)| (solids[number], ratio(grain)));
    let (solid, ratio) = ratios.min_by(|a, b| a.1.total_cmp(&b.1))?;
    (ratio < LIGHT).then_some(Cause::LightGrain { solid, ratio })
}

/// A fall along an axis along which nothing takes momentum from fluid and grains, if they have indeed
/// fallen as freely as that.
fn endless_fall(free: &FreeGrains, steps: u64) -> Option<Cause> {
    let faces = free.domain().faces();
    let lets_slip = |face: Face| matches!(face, Face::Periodic | Face::FreeSlip);
    let grains = free.system().grains();
    let all_slip = (0..3).all(|axis| faces.axis(axis).into_iter().all(lets_slip));
    if !all_slip || grains.iter().any(|grain| grain.held) {
        return None;
    }
    let density = free.settings().fluid_density;
    let fluid_mass = |grain: &Grain| density * sphere_volume(grain.radius);
    let excess: f64 = grains.iter().map(|grain| grain.mass - fluid_mass(grain)).sum();
    let total = density * free.domain().cell_count() as f64 + excess;
    // The acceleration of all mass together.
    let gain = match free.settings().gravity? {
        Gravity::Reduced { acceleration } => excess / total * acceleration,
        Gravity::OnFluidToo { acceleration } => acceleration,
        Gravity::Balanced { .. } => return None,
    };
    (0..3).filter(|&axis| free.domain().is_periodic(axis)).find_map(|axis| {
        let free_fall = gain[axis] * steps as f64;
        let sum: f64 = grains.iter().map(|grain| grain.velocity[axis]).sum();
        let mean = sum / grains.len() as f64;
        let falls = free_fall.abs() > SLOW && mean / free_fall > 0.5;
        falls.then_some(Cause::EndlessFall { axis: AXES[axis], speed: mean })
    })
}
