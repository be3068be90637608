//! The permeability of a bed, by the flow that a gradient drives through it: Darcy's law read from right to left.

use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::{CS2, viscosity};
use psmrt_reference::setup::Setup;

use super::bed::{Layer, layer};
use super::laws::{BED_LAWS, BedLaw, SI_DARCY};
use super::spheres::{has_image, spheres_of};
use super::surface::sauter;
use crate::engine::{Block, Coupled};
use crate::scene::Scene;
use crate::scene::columns::PERMEABILITY_COLUMNS;

/// Laws that stand beside a measured permeability: Kozeny and Carman's with 180, Beetstra's and Tang's.
pub const BESIDE: [BedLaw; 3] = [BED_LAWS[2], BED_LAWS[3], BED_LAWS[4]];

/// A bed that fluid seeps through along an axis; SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seepage {
    /// Superficial velocity along the axis, m/s.
    pub si_velocity: f64,
    /// What drives the fluid through the bed, Pa/m: positive along the axis.
    pub si_gradient: f64,
    /// Gravity that heads and the hydraulic conductivity are taken with, m/s2.
    pub si_gravity: f64,
    /// Density of the fluid, kg/m3.
    pub si_density: f64,
    /// Kinematic viscosity, m2/s.
    pub si_viscosity: f64,
    /// Where the bed begins and ends along the axis, m.
    pub si_reach: [f64; 2],
    /// Its porosity.
    pub porosity: f64,
    /// Mean diameter of its grains, `Σd³/Σd²` (Sauter), m; of an image six times its volume over its surface.
    pub si_diameter: f64,
}

impl Seepage {
    /// k, m2.
    pub fn si_permeability(&self) -> f64 {
        // k = μ U/(dP/L)
        self.si_density * self.si_viscosity * self.si_velocity / self.si_gradient
    }

    /// K, m/s.
    pub fn si_conductivity(&self) -> f64 {
        // K = k g/ν
        self.si_permeability() * self.si_gravity / self.si_viscosity
    }

    /// i: head that is lost per length.
    pub fn hydraulic_gradient(&self) -> f64 {
        // i = (dP/L)/(ρ g)
        self.si_gradient / (self.si_density * self.si_gravity)
    }

    /// Re.
    pub fn reynolds(&self) -> f64 {
        // Re = U d/(ν (1 - ε))
        self.si_velocity.abs() * self.si_diameter / self.si_viscosity / (1.0 - self.porosity)
    }

    /// psi.
    pub fn psi(&self) -> f64 {
        // psi = (dP/L) d ε³/(ρ U² (1 - ε))
        let inertia = self.si_density * self.si_velocity * self.si_velocity;
        self.si_gradient.abs() * self.si_diameter * self.porosity.powi(3)
            / (inertia * (1.0 - self.porosity))
    }

    /// What a law gives at its porosity and Re, m2.
    pub fn si_by(&self, law: &BedLaw) -> f64 {
        law.permeability(self.porosity, self.reynolds()) * self.si_diameter * self.si_diameter
    }

    /// The values of [`PERMEABILITY_COLUMNS`].
    pub fn row(&self) -> [f64; PERMEABILITY_COLUMNS.len()] {
        let k = self.si_permeability();
        let [kozeny, beetstra, tang] = BESIDE.map(|law| self.si_by(&law));
        [
            self.si_velocity,
            self.si_gradient,
            self.hydraulic_gradient(),
            k,
            k / SI_DARCY,
            self.si_conductivity(),
            k / (self.si_diameter * self.si_diameter),
            self.porosity,
            self.si_reach[0],
            self.si_reach[1],
            self.si_diameter,
            self.reynolds(),
            self.psi(),
            kozeny,
            beetstra,
            tang,
        ]
    }
}

/// The bed of a scene as it is now, and the flow of `si_velocity` (superficial, m/s) through it along `axis`; heads are
/// taken with `si_gravity`.
pub fn seepage(
    scene: &Scene,
    engine: &Coupled,
    (axis, si_gravity): (usize, f64),
    si_velocity: f64,
) -> Seepage {
    let (setup, units) = (engine.setup(), &scene.units);
    let bed = layer(setup, axis);
    let gradient = gradient(engine, &bed, axis);
    Seepage {
        si_velocity,
        si_gradient: gradient * units.si_pressure() / units.si_dx,
        si_gravity,
        si_density: units.si_density,
        si_viscosity: viscosity(setup.collision.tau()) * units.si_viscosity(),
        si_reach: bed.reach.map(|place| place * units.si_dx),
        porosity: 1.0 - bed.fraction,
        si_diameter: sauter(setup) * units.si_dx,
    }
}

/// What drives the fluid through the bed per length, `(p₁ - p₂ + G (x₂ - x₁))/L`, lattice units; `L` is how much of the
/// bed lies between the planes.
fn gradient(engine: &Coupled, bed: &Layer, axis: usize) -> f64 {
    let setup = engine.setup();
    let force = setup.body_force.map_or(0.0, |force| force[axis]);
    let length = setup.domain.cells()[axis] as f64;
    let [low, high] = bed.reach;
    if setup.domain.is_periodic(axis) {
        // The pressure is the same a period on.
        return force * length / (high - low);
    }
    let planes = planes(setup, bed, axis);
    let [x1, x2] = planes.map(|plane| plane as f64 + 0.5);
    let [p1, p2] = planes.map(|plane| CS2 * mean_density(engine, &setup.domain, (axis, plane)));
    let between = high.min(x2) - low.max(x1);
    (p1 - p2 + force * (x2 - x1)) / between
}

/// The planes of cells between which the drop is taken: half a grain away from the ends of the bed, where the pressure is
/// even; where the domain ends sooner, its first and last.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells from 0 to n")]
fn planes(setup: &Setup, bed: &Layer, axis: usize) -> [usize; 2] {
    let last = setup.domain.cells()[axis] as f64 - 1.0;
    let of_image = if has_image(setup) { 0.5 * sauter(setup) } else { 0.0 };
    let away = spheres_of(setup).iter().map(|sphere| sphere.1).fold(of_image, f64::max);
    let [low, high] = bed.reach;
    [(low - away).floor(), (high + away).floor()].map(|plane| plane.clamp(0.0, last) as usize)
}

/// Mean density of the fluid in a plane of cells.
fn mean_density(engine: &Coupled, domain: &Domain, (axis, plane): (usize, usize)) -> f64 {
    let mut block = Block::whole(domain);
    (block.low[axis], block.size[axis]) = (plane, 1);
    let sums = engine.cells(block).iter().fold([0.0; 2], |[sum, weight], cell| {
        let fluid = 1.0 - cell.solid_fraction;
        [sum + fluid * cell.density, weight + fluid]
    });
    sums[0] / sums[1]
}
