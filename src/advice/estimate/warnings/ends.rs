//! Warnings of what pressure faces do to the flow between them.

use psmrt_reference::domain::{FACE_NAMES, Face};
use psmrt_reference::lattice::CS2;

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;
use crate::seepage::spheres::solid_fraction;

/// How much shorter a channel is at each pressure face, in widths: fitted. Plane channels of 1 to 4 widths at 8
/// to 32 cells per width give 0.051 where the walls are placed exactly, whatever tau (`tests/oracle/boundaries.rs`),
/// 0.055 at half a width, and with other rates about an eighth of a cell less (0.034 at 8 cells, 0.043 at 16); a
/// square duct gives 0.042.
const SHORTER: f64 = 0.051;

/// More inertia than this share of the domain's is worth a word.
const SLOW: f64 = 0.1;

/// A change of the flow smaller than this is not worth a word.
const SMALL: f64 = 0.01;

/// Where grains fill more than this, they and not the walls hold the fluid back.
const FEW: f64 = 0.05;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let domain = &scene.setup.domain;
    let holds = |face: &Face| face.held_density().is_some();
    let between = |axis: &usize| domain.faces().axis(*axis).iter().all(holds);
    let axes: Vec<usize> = (0..3).filter(between).collect();
    let slow = axes.iter().filter_map(|&axis| inertia(scene, axis));
    let few = solid_fraction(scene) <= FEW;
    let short = axes.iter().filter(|_| few).filter_map(|&axis| ends(scene, axis));
    slow.chain(short).collect()
}

/// What non-reflecting faces at the ends of `axis` do to a flow that changes.
fn inertia(scene: &Scene, axis: usize) -> Option<Warning> {
    let domain = &scene.setup.domain;
    // ρ_w - ρ_0 = ρ/c_s (u_n - m) = (ρ T/c_s) dm/dt: each acts like c_s T more cells.
    let cells_more = domain.faces().axis(axis).map(|face| match face {
        Face::NonReflectingPressure { memory, .. } => CS2.sqrt() * memory,
        _ => 0.0,
    });
    let share = cells_more.iter().sum::<f64>() / domain.cells()[axis] as f64;
    if share < SLOW {
        return None;
    }
    let [low, high] = FACE_NAMES[axis];
    let reason = format!(
        "non-reflecting faces give way to a change of the flow: the pressure difference between {low} and {high} \
         accelerates the fluid as if the domain were {:.1} times as long; the steady flow is that of the pressures given",
        1.0 + share
    );
    let remedy = "if the start or a change of the flow matters give the faces a shorter `memory`, or say \
                  `developed = true` instead of `non_reflecting = true`";
    Some(warning(reason, remedy))
}

/// What the ends along `axis` do to the flow.
fn ends(scene: &Scene, axis: usize) -> Option<Warning> {
    let domain = &scene.setup.domain;
    let narrowest = (0..3).filter(|&other| other != axis).filter_map(|other| {
        let faces = domain.faces().axis(other);
        let walls = faces.iter().filter(|face| matches!(face, Face::Wall { .. })).count();
        // A mirror plane opposite the wall shows half of the channel.
        let width = if faces.contains(&Face::FreeSlip) { 2 } else { 1 } * domain.cells()[other];
        (walls > 0).then_some(width)
    });
    let (width, length) = (narrowest.min()? as f64, domain.cells()[axis] as f64);
    let is_mouth = |face: &&Face| matches!(face, Face::Pressure { .. });
    let faces = domain.faces().axis(axis);
    let mouths = faces.iter().filter(is_mouth).count() as f64;
    let lost = mouths * SHORTER * width / length;
    if lost < SMALL {
        return None;
    }
    let size = if lost < 0.5 {
        format!("flow that is {:.0} % too fast", 100.0 * (1.0 / (1.0 - lost) - 1.0))
    } else {
        "flow that is more than twice as fast as it should be".to_owned()
    };
    let [low, high] = FACE_NAMES[axis];
    let reason = format!(
        "the pressure faces {low} and {high} transmit no shear stress, as at the mouth of a jet: each makes the \
         channel effectively shorter by about {SHORTER} of its width, which here means a {size} for the pressures given"
    );
    let remedy = format!(
        "write `developed = true` at both faces, which is exact where the flow does not change along the channel, or \
         make the ends periodic and drive the flow by [body_force] (pressure difference over density and \
         length), or make the channel at least {:.0} cells long",
        (mouths * SHORTER * width / SMALL).ceil()
    );
    Some(warning(reason, remedy))
}
