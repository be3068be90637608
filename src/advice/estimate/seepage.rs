//! What can be told beforehand of a scene in which fluid seeps through a bed: how steep the gradient is, beside that at
//! which the bed is lifted, how fast the fluid will be, and when it is steady.

use std::f64::consts::PI;

use psmrt_reference::domain::Face;
use psmrt_reference::grains::grain::sphere_volume;
use psmrt_reference::lattice::{CS2, viscosity};

use super::grains::free;
use super::number::{Number, number};
use crate::scene::check::permeability::through_bed;
use crate::scene::{Scene, What};
use crate::seepage::bed::{DENSE, Layer, layer};
use crate::seepage::laws::{BED_LAWS, BedLaw};
use crate::seepage::surface::sauter;

/// The law that velocities are foretold by; others differ from it by up to 17 %.
const LAW: BedLaw = BED_LAWS[3];

/// How often the Reynolds number is put into the law again.
const REPEATS: usize = 60;

/// Steady: this share of the slowest mode that is known is still to go. Pockets behind narrow throats fill more slowly, so
/// that some 1e-3 of the flow is.
const LEFT: f64 = 1e-4;

/// A bed, what drives fluid through it and what becomes of it; lattice units.
struct Expected {
    axis: usize,
    si_gravity: f64,
    bed: Layer,
    diameter: f64,
    /// Superficial velocity along the axis.
    velocity: f64,
    /// What drives it per length.
    gradient: f64,
    /// Whether the velocity was given, and the gradient follows from the law.
    is_velocity_given: bool,
}

/// The flow that is expected; `None` of a scene without a bed that fluid is driven through along an axis.
fn expected(scene: &Scene) -> Option<Expected> {
    let setup = &scene.setup;
    let recorded = scene.records.iter().find_map(|record| match record.what {
        What::Permeability { axis, si_gravity } => Some((axis, si_gravity)),
        _ => None,
    });
    let found = || through_bed(setup, scene.free.as_ref(), &scene.units).ok();
    let (axis, si_gravity) = recorded.or_else(found)?;
    let bed = layer(setup, axis);
    if bed.fraction < DENSE {
        return None;
    }
    let nu = viscosity(setup.collision.tau());
    let diameter = sauter(setup);
    let by_law = |velocity: f64| {
        let re = velocity.abs() * diameter / nu / bed.fraction;
        LAW.permeability(1.0 - bed.fraction, re) * diameter * diameter
    };
    let [low, high] = setup.domain.faces().axis(axis);
    let inlet = [low, high].into_iter().find_map(|face| match face {
        Face::VelocityInlet { velocity } => Some(velocity[axis]),
        _ => None,
    });
    let force = setup.body_force.map_or(0.0, |force| force[axis]);
    let cells = setup.domain.cells()[axis] as f64;
    let length = bed.reach[1] - bed.reach[0];
    if let Some(velocity) = inlet {
        // dP/L = ν U/k
        let gradient = nu * velocity / by_law(velocity);
        let is_velocity_given = true;
        return Some(Expected {
            axis,
            si_gravity,
            bed,
            diameter,
            velocity,
            gradient,
            is_velocity_given,
        });
    }
    let drop = match (low.held_density(), high.held_density()) {
        (Some(low), Some(high)) => CS2 * (low - high),
        _ => 0.0,
    };
    let gradient = (drop + force * cells) / length;
    // U = k(U) dP/L/ν; k falls with U, so that the mean of two guesses contracts.
    let mut velocity = 0.0;
    for _ in 0..REPEATS {
        velocity = 0.5 * (velocity + by_law(velocity) * gradient / nu);
    }
    Some(Expected { axis, si_gravity, bed, diameter, velocity, gradient, is_velocity_given: false })
}

/// The superficial velocity that the law foretells, cells per step.
pub(crate) fn velocity_by_law(scene: &Scene) -> Option<(f64, String)> {
    let found = expected(scene).filter(|found| !found.is_velocity_given)?;
    let source = "what drives the fluid through the solids, by the law of Beetstra et al. for spheres of its volume and surface";
    Some((found.velocity.abs(), source.to_owned()))
}

/// The derived numbers.
pub(super) fn numbers(scene: &Scene) -> Vec<Number> {
    let Some(found) = expected(scene) else { return Vec::new() };
    let (units, nu) = (&scene.units, viscosity(scene.setup.collision.tau()));
    let Expected { axis, si_gravity, bed, diameter, velocity, gradient, is_velocity_given } = found;
    let name = ["x", "y", "z"][axis];
    let porosity = 1.0 - bed.fraction;
    let si_gradient = gradient * units.si_pressure() / units.si_dx;
    let i = si_gradient / (units.si_density * si_gravity);
    let law = format!("by Beetstra et al. at porosity {porosity:.3}");
    let why = if is_velocity_given { format!(", {law}") } else { String::new() };
    let mut numbers = vec![number(
        "hydraulic gradient",
        i,
        "",
        format!("along {name}, {si_gradient:.4e} Pa/m in the bed{why}; g = {si_gravity:.4} m/s2"),
    )];
    if let Some(critical) = critical_gradient(scene, axis, porosity, gradient) {
        let note = format!(
            "i_c = (rho_s/rho_f - 1)(1 - n) = {critical:.4} (Terzaghi); above 1 the flow lifts the bed"
        );
        numbers.push(number("i over i_c", i.abs() / critical, "", note));
    }
    let re = velocity.abs() * diameter / nu / bed.fraction;
    let source = if is_velocity_given { "given".to_owned() } else { law };
    let si_velocity = velocity * units.si_velocity();
    let note = format!("U d/(nu (1 - n)), U = {si_velocity:.4e} m/s, {source}");
    numbers.push(number("Re of the bed", re, "", note));
    let si_time = time_to_steadiness(scene, &found) * units.si_dt;
    let si_most = scene.stop.steps as f64 * units.si_dt;
    let verdict = if si_time > si_most { "MORE than" } else { "within" };
    let note =
        format!("expected, to some 1e-3 of the flow; {verdict} the {si_most:.4e} s of the run");
    numbers.push(number("time to steadiness", si_time, "s", note));
    numbers
}

/// Terzaghi's gradient, if the flow goes against gravity through grains that are free.
fn critical_gradient(scene: &Scene, axis: usize, porosity: f64, gradient: f64) -> Option<f64> {
    let part = scene.free.as_ref()?;
    let pull = part.settings.gravity?.acceleration();
    let is_against = pull[axis] * gradient < 0.0 && pull[axis].abs() > 0.99 * pull.norm();
    if !is_against {
        return None;
    }
    let sums = free(part).fold([0.0; 2], |[mass, volume], grain| {
        [mass + grain.mass, volume + sphere_volume(grain.radius)]
    });
    // i_c = (ρ_s/ρ_f - 1)(1 - n)
    Some((sums[0] / sums[1] / part.settings.fluid_density - 1.0) * (1.0 - porosity))
}

/// Steps until the flow is steady, about.
fn time_to_steadiness(scene: &Scene, found: &Expected) -> f64 {
    let setup = &scene.setup;
    let nu = viscosity(setup.collision.tau());
    let porosity = 1.0 - found.bed.fraction;
    // The slowest mode of a pipe as wide as the pores:  d_h = 2/3 d ε/(1 - ε),  t = d_h²/(4 · 5.783 ν)
    let pore = 2.0 / 3.0 * found.diameter * porosity / found.bed.fraction;
    let viscous = pore * pore / (4.0 * 5.783 * nu);
    let cells = setup.domain.cells()[found.axis] as f64;
    // The fluid is slightly compressible, so that pressure diffuses through the bed:  D = c_s² k/(ν ε)
    let k = nu * found.velocity / found.gradient;
    let length = found.bed.reach[1] - found.bed.reach[0];
    // In a periodic bed t = L²/(4 π² D), between two given pressures L²/(π² D). Where the velocity is given the pressure
    // before the bed has to build up, that of the water outside too: t = (4/π² L + L_w/ε) L/D.
    let ends = if setup.domain.is_periodic(found.axis) {
        length / (4.0 * PI * PI)
    } else if found.is_velocity_given {
        4.0 / PI / PI * length + (cells - length) / porosity
    } else {
        length / PI / PI
    };
    let pressure = ends * length * nu * porosity / (CS2 * k);
    // Sound goes to and fro twice.
    -LEFT.ln() * (viscous + pressure) + 4.0 * cells * 3.0_f64.sqrt()
}
