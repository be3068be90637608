//! The cause that the set-up of the fluid and what the guard had seen give evidence of.

use psmrt_reference::domain::{FACE_NAMES, Face};
use psmrt_reference::guard::Stopped;
use psmrt_reference::lattice::viscosity;
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::Solid;

use super::Cause;

/// Above this many cells' worth of advection per diffusion a flow cannot be resolved.
const MAX_GRID_REYNOLDS: f64 = 10.0;

/// A mean density this far from its initial value has drifted, if something else broke.
const MAX_DENSITY_DRIFT: f64 = 0.1;

/// The first cause for which there is evidence, the most certain kinds first.
pub(super) fn cause(stopped: &Stopped, setup: &Setup) -> Cause {
    let (evidence, limit) = (&stopped.evidence, setup.guard.max_speed);
    // A speed that is no number any more is no slow one.
    let is_fast = |&(_, speed): &(usize, f64)| speed.is_nan() || speed > 0.5 * limit;
    // First of all: the cells that a solid covers start with its motion.
    if let Some((solid, speed)) = fastest_solid(setup).filter(is_fast) {
        return Cause::SolidSpeed { solid, speed };
    }
    if evidence.first_mean_density.is_none() {
        return Cause::InitialState;
    }
    if let Some((face, speed)) = fastest_face(setup).filter(|&(_, speed)| speed > 0.5 * limit) {
        return Cause::FaceSpeed { face, speed };
    }
    if let Some(speed) = pressure_speed(setup).filter(|&speed| speed > 0.5 * limit) {
        return Cause::PressureDifference { speed };
    }
    if let Some(cause) = drift(setup, evidence.density_drift()) {
        return cause;
    }
    // A body force is to blame if, unopposed since the last check, it explains the speed.
    let acceleration = setup.body_force.map_or(0.0, |g| g.norm() / evidence.last_mean_density);
    let since = setup.guard.interval.min(stopped.step) as f64;
    if acceleration > 0.0 && evidence.last_max_speed + 2.0 * acceleration * since > limit {
        return Cause::BodyForce { acceleration };
    }
    let nu = viscosity(setup.collision.tau());
    let grid_reynolds = evidence.last_max_speed / nu;
    if grid_reynolds > MAX_GRID_REYNOLDS {
        return Cause::Unresolved { grid_reynolds };
    }
    Cause::Unknown
}

/// Sound of a start changes the mean density by no more than this many times its amplitude. Once by linear
/// theory, until it first comes back from the other end; the rest is room for waves that steepen.
const SOUND: f64 = 2.0;

/// Why the mean density is not what it was, if it is not.
fn drift(setup: &Setup, ratio: f64) -> Option<Cause> {
    if (ratio - 1.0).abs() <= MAX_DENSITY_DRIFT {
        return None;
    }
    let faces = setup.domain.faces();
    let has = |wanted: fn(&Face) -> bool| (0..3).any(|axis| faces.axis(axis).iter().any(wanted));
    let has_pressure = has(|face| face.held_density().is_some());
    match strongest_inlet(setup).filter(|_| has_pressure) {
        // δρ/ρ = u/c_s, c_s = 1/√3
        Some((face, speed)) if (ratio - 1.0).abs() <= SOUND * 3.0_f64.sqrt() * speed => {
            Some(Cause::ImpulsiveStart { face, speed, ratio })
        }
        Some((face, _)) if ratio > 1.0 => Some(Cause::ResistedInlet { face, ratio }),
        _ => (!has_pressure && has(|face| *face == Face::FreeOutflow))
            .then_some(Cause::DensityDrift { ratio }),
    }
}

/// The inlet that lets most fluid in or out per area, and its velocity along its normal.
fn strongest_inlet(setup: &Setup) -> Option<(&'static str, f64)> {
    let all = (0..3).flat_map(|axis| [0, 1].map(|side| (axis, side)));
    let inlets = all.filter_map(|(axis, side)| match setup.domain.faces().axis(axis)[side] {
        Face::VelocityInlet { velocity } => Some((FACE_NAMES[axis][side], velocity[axis].abs())),
        _ => None,
    });
    inlets.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The solid whose centre or surface is fastest, and its speed.
fn fastest_solid(setup: &Setup) -> Option<(usize, f64)> {
    let solids = &setup.solid_phase.as_ref()?.solids;
    let speed = |solid: &Solid| solid.top_speed(&setup.domain);
    solids.iter().map(speed).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The wall or inlet that is fastest, and its speed.
fn fastest_face(setup: &Setup) -> Option<(&'static str, f64)> {
    let faces = setup.domain.faces();
    let speeds =
        (0..3).flat_map(|axis| [0, 1].map(|side| (axis, side))).filter_map(|(axis, side)| {
            match faces.axis(axis)[side] {
                Face::Wall { velocity } | Face::VelocityInlet { velocity } => {
                    Some((FACE_NAMES[axis][side], velocity.norm()))
                }
                _ => None,
            }
        });
    speeds.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The speed that the pressures at the faces can drive, by Bernoulli.
fn pressure_speed(setup: &Setup) -> Option<f64> {
    let faces = setup.domain.faces();
    let all = (0..3).flat_map(|axis| faces.axis(axis));
    let densities = all.filter_map(|face| face.held_density());
    let (low, high) =
        densities.fold((f64::INFINITY, 0.0_f64), |(low, high), rho| (low.min(rho), high.max(rho)));
    // u = √(2 Δp/ρ),  p = ρ/3
    (high > 0.0).then(|| (2.0 / 3.0 * (high - low) / high).sqrt())
}
