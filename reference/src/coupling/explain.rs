//! Why a fluid with free grains in it was stopped, where the grains are the cause: the guard of the fluid sees
//! neither their densities nor gravity.

use super::free_grains::{FreeGrains, Gravity};
use crate::domain::Face;
use crate::grains::grain::{Grain, sphere_volume};
use crate::guard::{Cause, Stopped};

/// Grains of less than this many times the density of the fluid did not live: 0.8 did, 0.5 did not
/// (`golden/stability/movers.csv`).
const LIGHT: f64 = 0.8;

/// Slower than this, in cells per step, a grain has not broken anything.
const SLOW: f64 = 0.1;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

impl FreeGrains {
    /// The same stop, with the cause that the grains give if there is evidence of one.
    #[must_use]
    pub fn explain(&self, stopped: Stopped) -> Stopped {
        if stopped.cause == Cause::InitialState {
            return stopped;
        }
        let found = self.light_grain().or_else(|| self.endless_fall(stopped.step));
        Stopped { cause: found.unwrap_or(stopped.cause), ..stopped }
    }

    /// The lightest of the free grains that are fast (or no longer at a finite speed), if it is too light.
    fn light_grain(&self) -> Option<Cause> {
        let fluid_density = self.settings().fluid_density;
        let ratio = |grain: &Grain| grain.mass / (fluid_density * sphere_volume(grain.radius));
        let is_slow = |grain: &Grain| {
            grain.velocity.norm() <= SLOW && grain.radius * grain.angular_velocity.norm() <= SLOW
        };
        let grains = self.system().grains().iter().enumerate();
        let fast = grains.filter(|(_, grain)| !grain.held && !is_slow(grain));
        let ratios = fast.map(|(solid, grain)| (solid, ratio(grain)));
        let (solid, ratio) = ratios.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (ratio < LIGHT).then_some(Cause::LightGrain { solid, ratio })
    }

    /// A fall along an axis along which nothing takes momentum from fluid and grains, if they have indeed
    /// fallen as freely as that.
    fn endless_fall(&self, steps: u64) -> Option<Cause> {
        let faces = self.domain().faces();
        let lets_slip = |face: Face| matches!(face, Face::Periodic | Face::FreeSlip);
        let grains = self.system().grains();
        let all_slip = (0..3).all(|axis| faces.axis(axis).into_iter().all(lets_slip));
        if !all_slip || grains.iter().any(|grain| grain.held) {
            return None;
        }
        let density = self.settings().fluid_density;
        let fluid_mass = |grain: &Grain| density * sphere_volume(grain.radius);
        let excess: f64 = grains.iter().map(|grain| grain.mass - fluid_mass(grain)).sum();
        let total = density * self.domain().cell_count() as f64 + excess;
        // The acceleration of all mass together.
        let gain = match self.settings().gravity? {
            Gravity::Reduced { acceleration } => excess / total * acceleration,
            Gravity::OnFluidToo { acceleration } => acceleration,
            Gravity::Balanced { .. } => return None,
        };
        (0..3).filter(|&axis| self.domain().is_periodic(axis)).find_map(|axis| {
            let free_fall = gain[axis] * steps as f64;
            let sum: f64 = grains.iter().map(|grain| grain.velocity[axis]).sum();
            let mean = sum / grains.len() as f64;
            let falls = free_fall.abs() > SLOW && mean / free_fall > 0.5;
            falls.then_some(Cause::EndlessFall { axis: AXES[axis], speed: mean })
        })
    }
}
