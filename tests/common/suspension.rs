//! Random suspensions that settle in a periodic box.

use super::collisions::dhumieres;
use super::random::Random;
use psmrt_reference::coupling::{CoupledSolver, CouplingSettings, Gravity};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::setup::{Setup, SolidPhase};
use std::f64::consts::PI;

/// Density of the grains over that of the fluid.
const RATIO: f64 = 2.0;

/// What a suspension is made of.
#[derive(Clone, Copy, Debug)]
pub struct Suspension {
    /// Solid fraction.
    pub solid_fraction: f64,
    /// Grains, about: the box is a cube of whole cells.
    pub grains: usize,
    /// Cells per diameter.
    pub cells: f64,
    /// Relaxation time.
    pub tau: f64,
    /// Reynolds number of one grain alone.
    pub reynolds: f64,
    /// Seed of the places.
    pub seed: u64,
}

/// A suspension that settles.
pub struct Settling {
    pub solver: CoupledSolver,
    /// Velocity of one grain alone in an unbounded fluid (Stokes), cells per step.
    pub alone: f64,
    /// Solid fraction as made.
    pub solid_fraction: f64,
}

impl Suspension {
    /// The suspension at rest, the grains at random places at least a tenth of a cell apart.
    ///
    /// Nothing holds the fluid: the box as a whole falls faster and faster. Seen from the falling box
    /// the grains' weight is less by what that takes, which is made up for, so that each grain pulls
    /// at the fluid with what Stokes' law needs for `alone`; and the fall of the volume is taken off in
    /// [`Settling::velocity`].
    pub fn at_rest(&self) -> Settling {
        let radius = 0.5 * self.cells;
        let wanted = (self.grains as f64 * sphere_volume(radius) / self.solid_fraction).cbrt();
        let side = wanted.round();
        let places = random_places(self.grains, side, self.cells + 0.1, self.seed);
        let nu = viscosity(self.tau);
        let alone = self.reynolds * nu / self.cells;
        let grains: Vec<Grain> =
            places.into_iter().map(|place| Grain::sphere(place, radius, RATIO)).collect();
        let solid_fraction = grains.len() as f64 * sphere_volume(radius) / side.powi(3);
        // 6π ν a U = (m_s - m_f) (g - dw/dt), and the box as a whole falls with
        // dw/dt = φ (ρ_s - ρ_f) g/(ρ_f + φ (ρ_s - ρ_f))
        let weight = 6.0 * PI * nu * radius * alone;
        let acceleration = weight / ((RATIO - 1.0) * sphere_volume(radius))
            * (1.0 + solid_fraction * (RATIO - 1.0));
        let law = ContactLaw::from_duration_and_restitution(5.0, 0.5, 0.5 * grains[0].mass);
        let n = whole(side);
        let setup =
            Setup::fluid(Domain::new([n; 3], Faces::PERIODIC).unwrap(), dhumieres(self.tau))
                .with_solids(SolidPhase::default());
        let solver = CoupledSolver::new(
            setup,
            |_| (1.0, Vec3::zeros()),
            GrainSetup { sides: PeriodicBox::all([side; 3]), ..GrainSetup::new(law.unwrap()) },
            grains,
            Vec::new(),
            CouplingSettings {
                gravity: Some(Gravity::Reduced {
                    acceleration: Vec3::new(0.0, 0.0, -acceleration),
                }),
                ..Default::default()
            },
        )
        .unwrap();
        Settling { solver, alone, solid_fraction }
    }
}

impl Settling {
    /// Steps until the flow is steady in all but 5 %: three times what the slowest disturbance, as
    /// long as the box, takes to fall by a factor of e. The grains, whose own flow is steady in d²/ν,
    /// feel a small part of the rest.
    pub fn steps_to_steady(&self) -> u64 {
        let fluid = self.solver.fluid();
        let side = fluid.domain().cells()[0] as f64;
        let nu = viscosity(fluid.setup().collision.tau());
        // 3 L²/(4 π² ν)
        whole(3.0 * side * side / (4.0 * PI * PI * nu)) as u64
    }

    /// Mean velocity of the grains downwards, relative to the volume of grains and fluid together,
    /// over that of a grain alone.
    pub fn velocity(&self) -> f64 {
        let grains = self.solver.grains().grains();
        let mean = grains.iter().map(|g| g.velocity.z).sum::<f64>() / grains.len() as f64;
        let flux = self.solver.fluid().mass_flux_field();
        let volume = flux.iter().map(|j| j.z).sum::<f64>() / flux.len() as f64;
        (volume - mean) / self.alone
    }
}

/// Places in a periodic cube of side `side`, at least `distance` apart: one after the other at random
/// (random sequential addition, which reaches solid fractions of 0.3 and more).
fn random_places(count: usize, side: f64, distance: f64, seed: u64) -> Vec<Vec3> {
    let mut random = Random(seed);
    let mut places: Vec<Vec3> = Vec::new();
    while places.len() < count {
        let place = Vec3::from_fn(|_, _| random.between(0.0, side));
        let free = |other: &Vec3| {
            let apart = (place - other).map(|x| x - side * (x / side).round());
            apart.norm() >= distance
        };
        if places.iter().all(free) {
            places.push(place);
        }
    }
    places
}

/// The nearest whole number of cells.
#[expect(clippy::cast_possible_truncation, reason = "boxes are small")]
#[expect(clippy::cast_sign_loss, reason = "lengths are positive")]
fn whole(length: f64) -> usize {
    length.round() as usize
}
