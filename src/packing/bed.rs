//! A settled bed: grains dropped as a loose column onto a floor, between walls or periodic sides.
//!
//! The floor is the plane `z = 0`; gravity points down. The grains fall slowly, in a viscous medium,
//! under a contact law with friction, and are taken when they have come to rest. Nothing here has a
//! scale but the mean diameter `d`: gravity and the density of the grains are 1.

use crate::packing::{Packing, PackingError, PackingReport, check_radii, contacts, slice_volume};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::random::SplitMix64;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

/// Depth, in `d`, to which the mean weight of the bed presses its lowest grains into each other.
/// Chains of force carry a few times the mean.
const PRESSED: f64 = 1e-3;

/// Time in which the medium stops a grain, in `√(d/g)`: grains fall at `√(g d)`.
const CALM: f64 = 1.0;

/// Kinetic energy per grain, over `m g d`, below which the bed is at rest.
const AT_REST: f64 = 1e-7;

/// Time in which a bed must have come to rest: this many `√(d/g)`, and as many for each layer.
const PATIENCE: f64 = 20.0;

/// What bounds a bed at the sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BedSides {
    /// Vertical walls at 0 and at the lengths of the domain, of the same law as the floor.
    Walls,
    /// Periodic along x and y.
    Periodic,
}

/// A settled bed that is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct SettledBed {
    /// Lengths of the domain along x and y.
    pub lengths: [f64; 2],
    /// What bounds it.
    pub sides: BedSides,
    /// Radius of each grain, length.
    pub radii: Vec<f64>,
    /// Coefficient of friction while settling: 0 packs dense, more leaves the bed looser.
    pub friction: f64,
    /// Seed of the places.
    pub seed: u64,
}

impl SettledBed {
    /// Makes the bed. Errors if a value makes no sense or the bed does not come to rest.
    pub fn make(&self) -> Result<Packing, PackingError> {
        self.check()?;
        let mut system = self.released()?;
        let unit_time = self.mean_diameter().sqrt();
        let substep = system.shortest_time() / 15.0;
        let weights: f64 = system.grains().iter().map(|grain| grain.mass).sum();
        let unit_energy = weights * self.mean_diameter();

        let (mut time, mut next_look, mut substeps) = (0.0, unit_time, 0);
        let mut loads = vec![Load::default(); self.radii.len()];
        while time < PATIENCE * (1.0 + self.layers()) * unit_time {
            for (load, grain) in loads.iter_mut().zip(system.grains()) {
                // Spin too: nothing else stops a grain that turns about the normal of its contact.
                load.force = -grain.mass / (CALM * unit_time) * grain.velocity;
                load.torque = -grain.inertia / (CALM * unit_time) * grain.angular_velocity;
            }
            system.substep(substep, &loads)?;
            (time, substeps) = (time + substep, substeps + 1);
            if time >= next_look {
                if system.kinetic_energy() < AT_REST * unit_energy {
                    return Ok(self.finished(&system));
                }
                next_look += unit_time;
            }
        }
        let energy = system.kinetic_energy() / unit_energy;
        Err(PackingError::Restless { energy, substeps })
    }

    /// Where the grains fall from: one above the other, each at a random place in a cell of its own, so that none touches
    /// another, a wall or the floor.
    pub fn column(&self) -> Vec<Grain> {
        let mut random = SplitMix64::new(self.seed);
        let side = 2.1 * self.largest_radius();
        let along = self.lengths.map(|length| (length / side).floor().max(1.0));
        let cell = Vec3::new(self.lengths[0] / along[0], self.lengths[1] / along[1], side);
        let corner = |place: usize| {
            let place = place as f64;
            let (x, y) = (place % along[0], (place / along[0]).floor() % along[1]);
            Vec3::new(x, y, (place / (along[0] * along[1])).floor()).component_mul(&cell)
        };
        // A random cell for each grain, so that a list sorted by size gives no sorted bed.
        let mut places: Vec<usize> = (0..self.radii.len()).collect();
        for last in (1..places.len()).rev() {
            places.swap(last, random.below(last + 1));
        }
        let grain = |(&radius, &place): (&f64, &usize)| {
            let room = cell.map(|length| length - 2.0 * radius);
            let within = room.map(|room| radius + room * random.unit());
            Grain::sphere(corner(place) + within, radius, 1.0)
        };
        self.radii.iter().zip(&places).map(grain).collect()
    }

    /// The column under its own weight, above the floor.
    fn released(&self) -> Result<GrainSystem, PackingError> {
        let grains = self.column();
        let mass = grains.iter().map(|grain| grain.mass).sum::<f64>() / grains.len() as f64;
        let stiffness = mass * (1.0 + self.layers()) / (PRESSED * self.mean_diameter());
        let law = ContactLaw::from_stiffness_and_restitution(stiffness, 0.5, 0.5 * mass)?
            .with_friction(self.friction)?;
        let gravity = Vec3::new(0.0, 0.0, -1.0);
        let setup = GrainSetup { gravity, sides: self.periodic(), ..GrainSetup::new(law) };
        Ok(GrainSystem::new(setup, grains, self.planes(law))?)
    }

    /// The grains where they have come to rest.
    fn finished(&self, system: &GrainSystem) -> Packing {
        let sides = self.periodic();
        let at_rest = |grain: &Grain| Grain::sphere(sides.wrap(&grain.position), grain.radius, 1.0);
        let grains: Vec<Grain> = system.grains().iter().map(at_rest).collect();
        let planes = system.planes().to_vec();
        let (coordination, largest_overlap) = contacts(&grains, &sides, &planes);
        let porosity = self.porosity_of_middle(&grains);
        let report = PackingReport { porosity, coordination, largest_overlap };
        Packing { grains, sides, planes, report }
    }

    /// Porosity of the middle half of the bed, between a quarter and three quarters of its height,
    /// the height being twice that of the centre of mass.
    fn porosity_of_middle(&self, grains: &[Grain]) -> f64 {
        let mass: f64 = grains.iter().map(|grain| grain.mass).sum();
        let middle = grains.iter().map(|g| g.mass * g.position.z).sum::<f64>() / mass;
        let (low, high) = (0.5 * middle, 1.5 * middle);
        let slice = |g: &Grain| slice_volume(g.radius, low - g.position.z, high - g.position.z);
        let solid: f64 = grains.iter().map(slice).sum();
        1.0 - solid / (self.lengths[0] * self.lengths[1] * (high - low))
    }

    fn periodic(&self) -> PeriodicBox {
        match self.sides {
            BedSides::Walls => PeriodicBox::default(),
            BedSides::Periodic => {
                let [x, y] = self.lengths;
                PeriodicBox { lengths: [Some(x), Some(y), None] }
            }
        }
    }

    /// The floor, and the walls if there are any.
    fn planes(&self, law: ContactLaw) -> Vec<Plane> {
        let mut planes = vec![Plane::fixed(Vec3::zeros(), Vec3::z(), law)];
        if self.sides == BedSides::Walls {
            let high = Vec3::new(self.lengths[0], self.lengths[1], 0.0);
            planes.extend(Plane::box_walls(Vec3::zeros(), high, &[0, 1], law));
        }
        planes
    }

    fn mean_diameter(&self) -> f64 {
        2.0 * self.radii.iter().sum::<f64>() / self.radii.len() as f64
    }

    fn largest_radius(&self) -> f64 {
        self.radii.iter().copied().fold(0.0, f64::max)
    }

    /// Height of the bed in mean diameters, about.
    fn layers(&self) -> f64 {
        let solid: f64 = self.radii.iter().map(|&radius| sphere_volume(radius)).sum();
        solid / (0.6 * self.lengths[0] * self.lengths[1] * self.mean_diameter())
    }

    fn check(&self) -> Result<(), PackingError> {
        let bad = |key, value, allowed| Err(PackingError::BadValue { key, value, allowed });
        check_radii(&self.radii)?;
        for length in self.lengths {
            if !(length > 2.0 * self.largest_radius() && length.is_finite()) {
                return bad("box length", length, "must be finite and exceed the largest diameter");
            }
        }
        Ok(())
    }
}
