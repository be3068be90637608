//! Warnings of faces that do not go together.

use psmrt_reference::domain::Face;

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;
use crate::scene::names::FACE_KEYS;

/// Solids that leave less than this between them and an inlet, cells, leave what enters there no way out.
const CLEAR: f64 = 1.0;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let faces = scene.setup.domain.faces();
    let has = |wanted: fn(&Face) -> bool| (0..3).any(|axis| faces.axis(axis).iter().any(wanted));
    let mut all = Vec::new();
    if has(|face| matches!(face, Face::VelocityInlet { .. }))
        && !has(|face| face.held_density().is_some())
    {
        all.push(warning(
            "a velocity inlet with a free outflow does not determine the mean density",
            "use a `pressure` outlet (sound leaves through it with `non_reflecting = true`), or watch the column density \
             of a record `box`",
        ));
    }
    for axis in 0..3 {
        for side in 0..2 {
            all.extend(blocked(scene, axis, side));
        }
    }
    all
}

/// Solids against a velocity inlet. Between a sphere and a plane that it touches the pressure that drives away what enters at
/// speed `U` is `12 μ U R³/r⁴` at distance `r` from the contact (lubrication): without bound.
fn blocked(scene: &Scene, axis: usize, side: usize) -> Option<Warning> {
    let (setup, name) = (&scene.setup, FACE_KEYS[axis][side]);
    let domain = &setup.domain;
    if !matches!(domain.faces().axis(axis)[side], Face::VelocityInlet { .. }) {
        return None;
    }
    let far = domain.cells()[axis] as f64;
    let solids = setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    let close = solids.filter_map(|solid| solid.bounds(domain)).filter(|[low, high]| {
        let gap = if side == 0 { low[axis] } else { far - high[axis] };
        gap < CLEAR
    });
    let count = close.count();
    if count == 0 {
        return None;
    }
    let reason = format!(
        "{count} of the solids leave less than a cell between them and the velocity inlet {name}: what enters there has no way out, \
         so that the density beneath them rises without bound, on finer grids the more, and with it the force on them"
    );
    let clear = "a diameter of clear fluid between inlet and solids (a bed: `floor`), or a `pressure` face instead of the inlet";
    Some(warning(reason, clear))
}
