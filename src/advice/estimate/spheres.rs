//! The spheres of a scene, and how much of each the domain holds.

use psmrt_reference::domain::Face;
use psmrt_reference::solids::{Shape, Solid};

use crate::scene::Scene;

/// The spheres: solid, radius in cells, and the share of it that lies inside mirror planes.
pub(crate) fn spheres(scene: &Scene) -> Vec<(&Solid, f64, f64)> {
    let domain = &scene.setup.domain;
    let share = |solid: &Solid| {
        let cuts = (0..3).flat_map(|axis| [(axis, 0, 0.0), (axis, 1, domain.cells()[axis] as f64)]);
        let is_cut = |&(axis, side, plane): &(usize, usize, f64)| {
            let mirror = domain.faces().axis(axis)[side] == Face::FreeSlip;
            mirror && (solid.centre[axis] - plane).abs() < 1e-6
        };
        0.5_f64.powi(i32::try_from(cuts.filter(is_cut).count()).unwrap_or(0))
    };
    let solids = scene.setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    let sphere = |solid: &'_ Solid| match solid.shape {
        Shape::Sphere { radius } => Some(radius),
        Shape::Cells { .. } => None,
    };
    solids.filter_map(|solid| Some((solid, sphere(solid)?, share(solid)))).collect()
}

/// Volume of the spheres over that of the domain.
pub(crate) fn solid_fraction(scene: &Scene) -> f64 {
    let volume: f64 = spheres(scene)
        .iter()
        .map(|&(_, radius, share)| share * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3))
        .sum();
    volume / scene.setup.domain.cell_count() as f64
}
