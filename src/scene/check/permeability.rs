//! Whether fluid flows through a bed along an axis, so that the bed has a permeability there.

use psmrt_reference::domain::Face;
use psmrt_reference::setup::Setup;

use super::Trouble;
use super::free::FreePart;
use super::numbers::needed;
use crate::scene::format_run::AxisName;
use crate::units::Units;

/// Gravity that heads are taken with where a scene has none, m/s2.
const SI_GRAVITY: f64 = 9.81;

const NAMES: [&str; 3] = ["x", "y", "z"];

/// The axis of the flow and the gravity that heads are taken with, m/s2; `named` is the axis that the record names.
/// Errors if no fluid flows through grains there, or if they are carried along.
pub(super) fn flow(
    at: &impl Fn(&str) -> String,
    named: Option<AxisName>,
    setup: &Setup,
    free: Option<&FreePart>,
    units: &Units,
) -> Result<(usize, f64), Trouble> {
    let Some(phase) = &setup.solid_phase else {
        let problem = "the scene has no grains: there is no bed that is permeable";
        return Err(Trouble::new(at("kind"), problem, "add [[grains]], or remove this record"));
    };
    let is_prescribed = |&number: &usize| {
        phase.solids[number].has_velocity() && !free.is_some_and(|part| part.moves_solid(number))
    };
    if let Some(number) = (0..phase.solids.len()).find(is_prescribed) {
        let problem = format!(
            "grain {number} moves as prescribed, and permeability is that of grains at rest"
        );
        let remedy = "leave out `velocity` and `spin` of that grain, or remove this record";
        return Err(Trouble::new(at("kind"), problem, remedy));
    }
    let driven = driven_axes(setup);
    let axis = match (named.map(AxisName::index), &driven[..]) {
        (Some(axis), _) => axis,
        (None, &[axis]) => axis,
        (None, []) => {
            let why: Vec<String> = (0..3).filter_map(|axis| undriven(setup, axis)).collect();
            let problem = format!("no flow goes through the domain: {}", why.join("; "));
            return Err(Trouble::new(at("kind"), problem, DRIVE));
        }
        (None, several) => {
            let axes: Vec<_> = several.iter().map(|&axis| NAMES[axis]).collect();
            let because = format!("the fluid is driven along {}", axes.join(" and "));
            let remedy = "add `axis = \"x\"`, \"y\" or \"z\"";
            needed(&at("axis"), named, &because, remedy)?.index()
        }
    };
    if let Some(why) = undriven(setup, axis) {
        return Err(Trouble::new(at("axis"), format!("no flow goes there: {why}"), DRIVE));
    }
    let nothing_holds = free.is_some_and(|part| part.grains.iter().all(|grain| !grain.held));
    if nothing_holds && setup.domain.is_periodic(axis) {
        let problem = format!(
            "all grains are free and nothing along the periodic axis {} holds them: they go with the flow, and \
             permeability is that of grains at rest",
            NAMES[axis]
        );
        let remedy =
            "leave out `motion`, or let them lie on a face that the fluid passes (`pressure`)";
        return Err(Trouble::new(at("kind"), problem, remedy));
    }
    Ok((axis, si_gravity(free, units)))
}

/// Gravity that heads are taken with, m/s2: that of the scene, or the usual one where it has none.
pub fn si_gravity(free: Option<&FreePart>, units: &Units) -> f64 {
    let gravity = free.and_then(|part| part.settings.gravity);
    let own = gravity.map(|gravity| gravity.acceleration().norm() * units.si_acceleration());
    own.filter(|si_gravity| *si_gravity > 0.0).unwrap_or(SI_GRAVITY)
}

/// The same for a scene that names no axis. Errors if it has no such flow along just one axis.
pub(crate) fn through_bed(
    setup: &Setup,
    free: Option<&FreePart>,
    units: &Units,
) -> Result<(usize, f64), Trouble> {
    flow(&|key| key.to_owned(), None, setup, free, units)
}

const DRIVE: &str = "drive the fluid along a periodic axis by [body_force], or let it in at one face and out at the \
                     opposite one (`pressure`, `velocity_inlet`, `free_outflow`); or remove this record";

/// The axes along which the fluid is driven.
pub(crate) fn driven_axes(setup: &Setup) -> Vec<usize> {
    (0..3).filter(|&axis| undriven(setup, axis).is_none()).collect()
}

/// Why no flow goes along an axis; `None` if one does.
fn undriven(setup: &Setup, axis: usize) -> Option<String> {
    let name = NAMES[axis];
    if setup.domain.is_periodic(axis) {
        let is_driven = setup.body_force.is_some_and(|force| force[axis] != 0.0);
        let why = format!("{name} is periodic and has no body force along it");
        return (!is_driven).then_some(why);
    }
    let faces = setup.domain.faces().axis(axis);
    let closed = |face: &Face| matches!(face, Face::Wall { .. } | Face::FreeSlip);
    let side = faces.iter().position(closed)?;
    Some(format!("faces.{name}_{} lets no fluid through", ["low", "high"][side]))
}
