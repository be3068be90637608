//! The contacts of a set of grains as they are now, for whoever looks at it: networks of forces, stresses.
//!
//! Forces are worked out anew from places, velocities and springs, and nothing changes: what is seen after a checkpoint has
//! been read is what was seen when it was written. Lubrication is left out: it is the fluid's.

use crate::grains::contact::{Geometry, Motion, Relative};
use crate::grains::grain::Grain;
use crate::grains::interaction::moving_masses;
use crate::grains::system::GrainSystem;
use crate::lattice::Vec3;

/// What a grain touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touched {
    /// The grain of that number, or its image beyond a periodic side.
    Grain(usize),
    /// The plane of that number.
    Plane(usize),
}

/// A contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touching {
    /// Number of the grain; of two the smaller one.
    pub grain: usize,
    /// What it touches.
    pub other: Touched,
    /// From the centre of the grain to that of the other, or to the plane along its normal, length.
    pub branch: Vec3,
    /// Unit normal, along the branch.
    pub normal: Vec3,
    /// Force of spring and dashpot on the grain; on the other acts its opposite.
    pub force: Vec3,
}

/// All contacts: of pairs in the order of the list, then at planes by grain and plane.
pub fn touching(system: &GrainSystem) -> Vec<Touching> {
    let (setup, grains) = (system.setup(), system.grains());
    let pairs = system.pairs().iter().filter_map(|pair| {
        let (one, two) = (pair.candidate.first as usize, pair.candidate.second as usize);
        let (first, second) = (&grains[one], &grains[two]);
        let branch = setup.sides.offset(&first.position, &second.position, pair.candidate.image);
        let geometry = Geometry::of_spheres(&branch, [first.radius, second.radius]);
        let relative = Relative::new(&geometry, [&motion(first), &motion(second)]);
        let (masses, mut memory) = (moving_masses([first, second]), Some(pair.memory?));
        let now = [&relative, &relative];
        let force = setup.law.force(masses, &geometry, now, 0.0, &mut memory)?.force;
        let other = Touched::Grain(two);
        Some(Touching { grain: one, other, branch, normal: geometry.normal, force })
    });
    let planes = system.plane_contacts().into_iter().filter_map(|contact| {
        let (grain, plane) = (&grains[contact.grain], &system.planes()[contact.plane]);
        let height = plane.height(&grain.position);
        let geometry = Geometry::on_plane(height, &plane.normal, grain.radius);
        let of_plane = Motion { velocity: plane.velocity, angular_velocity: Vec3::zeros() };
        let relative = Relative::new(&geometry, [&motion(grain), &of_plane]);
        let (masses, mut memory) = ([grain.mass, f64::INFINITY], Some(contact.memory));
        let now = [&relative, &relative];
        let force = plane.law.force(masses, &geometry, now, 0.0, &mut memory)?.force;
        let (branch, normal) = (geometry.normal * height, geometry.normal);
        let other = Touched::Plane(contact.plane);
        Some(Touching { grain: contact.grain, other, branch, normal, force })
    });
    pairs.chain(planes).collect()
}

fn motion(grain: &Grain) -> Motion {
    Motion { velocity: grain.velocity, angular_velocity: grain.angular_velocity }
}
