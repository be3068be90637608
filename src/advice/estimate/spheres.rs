//! The spheres of a scene, and how much of each the domain holds.

use psmrt_reference::domain::Face;
use psmrt_reference::solids::{Shape, Solid};

use crate::scene::Scene;

/// The solids as spheres: solid, radius in cells (of the sphere of its volume, if it is of given cells), and the share
/// of it that lies inside mirror planes.
pub(crate) fn spheres(scene: &Scene) -> Vec<(&Solid, f64, f64)> {
    let domain = &scene.setup.domain;
    let share = |solid: &Solid| {
        let cuts = (0..3).flat_map(|axis| [(axis, 0, 0.0), (axis, 1, domain.cells()[axis] as f64)]);
        let is_cut = |&(axis, side, plane): &(usize, usize, f64)| {
            let mirror = domain.faces().axis(axis)[side] == Face::FreeSlip;
            mirror && is_sphere(solid) && (solid.centre[axis] - plane).abs() < 1e-6
        };
        0.5_f64.powi(i32::try_from(cuts.filter(is_cut).count()).unwrap_or(0))
    };
    let solids = scene.setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    solids.map(|solid| (solid, 0.5 * solid.diameter(), share(solid))).collect()
}

/// Given cells lie in the domain, all of them.
fn is_sphere(solid: &Solid) -> bool {
    matches!(solid.shape, Shape::Sphere { .. })
}

/// Volume of the solids over that of the domain.
pub(crate) fn solid_fraction(scene: &Scene) -> f64 {
    let volume: f64 = spheres(scene).iter().map(|&(solid, _, share)| share * solid.volume()).sum();
    volume / scene.setup.domain.cell_count() as f64
}

/// Diameters in cells, smallest and largest, if there are grains.
pub(crate) fn diameters(scene: &Scene) -> Option<(f64, f64)> {
    let solids = &scene.setup.solid_phase.as_ref()?.solids;
    let all = solids.iter().map(Solid::diameter);
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(l, h), d| (l.min(d), h.max(d)));
    (high > 0.0).then_some((low, high))
}
