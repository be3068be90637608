//! The spheres of a scene or a set-up, and how much of each the domain holds.

use psmrt_reference::domain::Face;
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Shape, Solid};

use crate::scene::Scene;

/// The spheres among the solids, which stand before all others: solid, radius in cells, and the share of it that lies inside
/// mirror planes (where two of them cut it, as if each did so at every height).
pub(crate) fn spheres(scene: &Scene) -> Vec<(&Solid, f64, f64)> {
    spheres_of(&scene.setup)
}

/// The same of a set-up, whose grains may have moved.
pub(crate) fn spheres_of(setup: &Setup) -> Vec<(&Solid, f64, f64)> {
    let domain = &setup.domain;
    let share = |solid: &Solid| {
        let along = |axis: usize| {
            let [low, high] = domain.faces().axis(axis).map(|face| face == Face::FreeSlip);
            let low = if low { 0.0 } else { f64::NEG_INFINITY };
            let high = if high { domain.cells()[axis] as f64 } else { f64::INFINITY };
            share_of(0.5 * solid.diameter(), solid.centre[axis], [low, high])
        };
        (0..3).map(along).product()
    };
    let solids = setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    let spheres = solids.filter(|solid| !is_of_cells(solid));
    spheres.map(|solid| (solid, 0.5 * solid.diameter(), share(solid))).collect()
}

/// Share of a sphere between two planes.
pub(crate) fn share_of(radius: f64, centre: f64, [low, high]: [f64; 2]) -> f64 {
    let below = |plane: f64| {
        // Height h of the cap over the diameter:  V(h)/V = h² (3 - 2 h)
        let height = ((plane - centre) / (2.0 * radius) + 0.5).clamp(0.0, 1.0);
        height * height * (3.0 - 2.0 * height)
    };
    below(high) - below(low)
}

/// Volume of the solids, cells.
pub(crate) fn volume(setup: &Setup) -> f64 {
    let spheres: f64 =
        spheres_of(setup).iter().map(|&(solid, _, share)| share * solid.volume()).sum();
    // Given cells lie in the domain, all of them.
    let solids = setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    spheres + solids.filter(|solid| is_of_cells(solid)).map(Solid::volume).sum::<f64>()
}

/// Volume of the solids over that of the domain.
pub(crate) fn solid_fraction(scene: &Scene) -> f64 {
    volume(&scene.setup) / scene.setup.domain.cell_count() as f64
}

/// Diameters of the spheres in cells, smallest and largest, if there are any.
pub(crate) fn diameters(scene: &Scene) -> Option<(f64, f64)> {
    let solids = &scene.setup.solid_phase.as_ref()?.solids;
    let all = solids.iter().filter(|solid| !is_of_cells(solid)).map(Solid::diameter);
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(l, h), d| (l.min(d), h.max(d)));
    (high > 0.0).then_some((low, high))
}

/// Whether a solid is given cell by cell: an image, or a body that is no sphere.
pub(crate) fn is_of_cells(solid: &Solid) -> bool {
    match solid.shape {
        Shape::Cells { .. } => true,
        Shape::Sphere { .. } => false,
    }
}

/// Whether one of the solids of a set-up is.
pub(crate) fn has_image(setup: &Setup) -> bool {
    setup.solid_phase.iter().any(|phase| phase.solids.iter().any(is_of_cells))
}
