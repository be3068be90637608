//! Free grains summed up: where they are on the mean, how they move, how they touch.

use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::system::{GrainState, GrainSystem};
use psmrt_reference::lattice::Vec3;

use crate::engine::Coupled;
use crate::scene::Scene;

/// Means over the free grains; zeros if there are none.
pub fn row(scene: &Scene, engine: &Coupled) -> [f64; 10] {
    let Some(system) = engine.free_grains() else { return [0.0; 10] };
    let units = &scene.units;
    let free = || system.grains().iter().filter(|grain| !grain.held);
    let n = free().count().max(1) as f64;
    let mean = |vector: fn(&Grain) -> Vec3| free().map(vector).sum::<Vec3>() / n;
    let place = mean(|grain| grain.position) * units.si_dx;
    let velocity = mean(|grain| grain.velocity) * units.si_velocity();
    let fastest = free().map(|grain| grain.velocity.norm()).fold(0.0, f64::max);
    let energy: f64 = free().map(Grain::kinetic_energy).sum();
    // The springs, not the forces: these are there right after a checkpoint is read, too.
    let state = system.state();
    let contacts = state.pair_contacts.len() + state.plane_contacts.len();
    [
        place.x,
        place.y,
        place.z,
        velocity.x,
        velocity.y,
        velocity.z,
        fastest * units.si_velocity(),
        energy * units.si_force() * units.si_dx,
        contacts as f64,
        largest_overlap(system, &state),
    ]
}

/// The largest overlap of two grains over their mean diameter, or of a grain and a face over its
/// diameter; 0 if there is none.
pub fn largest_overlap(system: &GrainSystem, state: &GrainState) -> f64 {
    let (grains, planes) = (system.grains(), system.planes());
    let pairs = state.pair_contacts.iter().map(|contact| {
        let (one, two) =
            (&grains[contact.pair.first as usize], &grains[contact.pair.second as usize]);
        let apart =
            system.setup().sides.offset(&one.position, &two.position, contact.pair.image).norm();
        1.0 - apart / (one.radius + two.radius)
    });
    let faces = state.plane_contacts.iter().map(|contact| {
        let grain = &grains[contact.grain];
        0.5 * (1.0 - planes[contact.plane].height(&grain.position) / grain.radius)
    });
    pairs.chain(faces).fold(0.0, f64::max)
}

/// How many others, faces too, each grain touches.
pub fn contacts_of_each(state: &GrainState) -> Vec<u32> {
    let mut counts = vec![0; state.grains.len()];
    for contact in &state.pair_contacts {
        counts[contact.pair.first as usize] += 1;
        counts[contact.pair.second as usize] += 1;
    }
    for contact in &state.plane_contacts {
        counts[contact.grain] += 1;
    }
    counts
}
