//! Whether contacts hold: no free grain has gone through what should hold it back.
//!
//! A linear spring lets everything pass that is heavy or fast enough, and beyond the middle of a grain it
//! pushes to the other side. So a set of grains is looked at after each step of the fluid: a free grain that
//! lies deeper in another grain or behind a plane than [`DEEPEST`] has not been held. What is said here is
//! the failure; causes and remedies are for whoever knows the scales.

use crate::grains::grain::Grain;
use crate::grains::system::GrainSystem;

pub use crate::grains::sunk::{DEEPEST, Sunk, SunkInto};

/// The free grain that lies deepest in an obstacle, if it is too deep.
pub fn deepest(system: &GrainSystem) -> Option<Sunk> {
    let found = at_planes(system).chain(among_grains(system));
    let too_deep = found.filter(|sunk| sunk.depth() > DEEPEST);
    too_deep.max_by(|one, two| one.depth().total_cmp(&two.depth()))
}

/// Where a grain lies deepest, however deep, if anything is near it.
pub fn deepest_of(system: &GrainSystem, grain: usize) -> Option<Sunk> {
    let found = at_planes(system).chain(among_grains(system));
    let own = found.filter(|sunk| sunk.grain == grain || sunk.obstacle == SunkInto::Grain(grain));
    own.max_by(|one, two| one.depth().total_cmp(&two.depth()))
}

/// All free grains at all planes, however far.
fn at_planes(system: &GrainSystem) -> impl Iterator<Item = Sunk> {
    let free = system.grains().iter().enumerate().filter(|(_, grain)| !grain.held);
    free.flat_map(move |(number, grain)| {
        system.planes().iter().enumerate().map(move |(plane, it)| Sunk {
            grain: number,
            obstacle: SunkInto::Plane(plane),
            // δ = R - height
            overlap: grain.radius - it.height(&grain.position),
            radius: grain.radius,
            approach: (it.velocity - grain.velocity).dot(&it.normal),
        })
    })
}

/// All listed pairs of which one is free, however far.
fn among_grains(system: &GrainSystem) -> impl Iterator<Item = Sunk> {
    let grains = system.grains();
    let listed = system.pairs().iter().map(|pair| pair.candidate);
    let numbered = listed.map(|pair| (pair, [pair.first as usize, pair.second as usize]));
    let pairs = numbered.filter(|(_, both)| both.iter().any(|&number| !grains[number].held));
    pairs.map(|(pair, [first, second])| {
        let (one, two): (&Grain, &Grain) = (&grains[first], &grains[second]);
        let offset = system.setup().sides.offset(&one.position, &two.position, pair.image);
        let distance = offset.norm();
        // The one to name: the free one, and of two free ones the smaller.
        let names_second = one.held || (!two.held && two.radius < one.radius);
        let (grain, other) = if names_second { (second, first) } else { (first, second) };
        Sunk {
            grain,
            obstacle: SunkInto::Grain(other),
            // δ = R₁ + R₂ - |x₂ - x₁|
            overlap: one.radius + two.radius - distance,
            radius: one.radius.min(two.radius),
            approach: (one.velocity - two.velocity).dot(&offset) / distance,
        }
    })
}
