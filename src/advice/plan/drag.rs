//! The drag of the grains of a scene, which tells how fast a force drives the fluid and how far full cells leak.

use psmrt_reference::domain::Face;

use crate::advice::coefficients::curve;
use crate::scene::Scene;
use crate::seepage::bed::{Bed, bed};
use crate::seepage::spheres::{solid_fraction, spheres};
use crate::table::TableError;

/// Drag over Stokes' drag, at no Reynolds number.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drag {
    /// The drag: that of a face-centred array as crowded, or of a shaft as narrow, whichever is larger.
    pub factor: f64,
    /// What it was taken from.
    pub because: String,
    /// Solid fraction where the grains lie densest.
    pub fraction: f64,
}

/// The drag of the grains of a scene.
pub(crate) fn drag(scene: &Scene) -> Result<Drag, TableError> {
    let domain = &scene.setup.domain;
    let whole = solid_fraction(scene);
    let bed = bed(scene);
    let fraction = bed.map_or(whole, |bed| bed.fraction);
    let crowd = interpolated(&curve("drag", "array")?, fraction);
    let largest = spheres(scene).iter().map(|s| s.1).fold(0.0, f64::max);
    // A mirror plane halves the shaft; a wall on one side only counts as one on both.
    let half = |axis: usize| {
        let faces = domain.faces().axis(axis);
        let walls = faces.iter().filter(|face| matches!(face, Face::Wall { .. })).count();
        let mirrors = faces.iter().filter(|face| **face == Face::FreeSlip).count();
        let length = domain.cells()[axis] as f64;
        match (walls, mirrors) {
            (0, _) => f64::INFINITY,
            (1, 1) => length,
            _ => 0.5 * length,
        }
    };
    let narrowest = (0..3).map(half).fold(f64::INFINITY, f64::min);
    let shaft = interpolated(&curve("drag", "shaft")?, largest / narrowest);
    let (factor, because) = if shaft > crowd {
        let width = narrowest / largest;
        (shaft, format!("a square shaft {width:.1} diameters wide, like the walls"))
    } else {
        let like = match bed {
            Some(Bed { reaches: [x, y, z], .. }) => format!(
                "the bed at cells {:.0} to {:.0}, {:.0} to {:.0}, {:.0} to {:.0} (the whole domain has {whole:.3})",
                x[0], x[1], y[0], y[1], z[0], z[1]
            ),
            None => "the grains".to_owned(),
        };
        (crowd, format!("a regular array of solid fraction {fraction:.3}, like {like}"))
    };
    Ok(Drag { factor, because, fraction })
}

/// A curve at a value: linear in the logarithm between points, from 1 at nothing up, and the last point's beyond.
fn interpolated(curve: &[(f64, f64)], at: f64) -> f64 {
    let mut before = (0.0, 1.0_f64);
    for &(x, y) in curve {
        if at <= x {
            // Both grow with the third root of the solid fraction, or with the width.
            let share = (at - before.0) / (x - before.0);
            return (before.1.ln() + share * (y.ln() - before.1.ln())).exp();
        }
        before = (x, y);
    }
    before.1
}
