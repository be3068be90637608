//! Warnings of a force that presses the water, grains and all, against a closed end: lattice Boltzmann water gives way a
//! little, so its density differs between the ends, and a force that comes all at once makes it swing between them.

use std::f64::consts::PI;

use psmrt_reference::coupling::Gravity;
use psmrt_reference::domain::{FACE_NAMES, Face};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::lattice::{CS2, Vec3};

use super::start::decay;
use crate::advice::estimate::grains::{free, stokes_velocity};
use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;
use crate::scene::initial::Initial;

/// A difference in density that is not worth a word: as much as the square of the largest Mach number that is
/// (`scales.rs`).
const SLIGHT: f64 = 0.03;

/// A swing that does not show: its velocity over that at which grains settle.
const UNSEEN: f64 = 0.5;

/// The column of water along an axis whose ends hold it.
struct Column {
    axis: usize,
    /// Cells from end to end.
    length: f64,
    /// Its density at one end less that at the other, over the mean: `f L/(ρ c_s²)`.
    compression: f64,
}

/// The densities at the ends that differ too much.
pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let force = hanging(scene) + scene.setup.body_force.unwrap_or_else(Vec3::zeros);
    let compressed = columns(scene, force).into_iter().filter(|column| column.compression > SLIGHT);
    let told = compressed.map(|column| {
        let [low, high] = FACE_NAMES[column.axis];
        let shorter = (SLIGHT / column.compression).sqrt() * scene.units.si_dt;
        warning(
            format!(
                "weight and body force press the water together: its density differs by {:.1} % between the faces {low} and \
                 {high}, as long as the grains hang in it, and so does the volume that a flow takes there",
                100.0 * column.compression
            ),
            format!(
                "a time step of at most {shorter:.2e} s (`time.dt`, or a smaller `time.tau`) makes it {:.0} %: it falls with \
                 the square",
                100.0 * SLIGHT
            ),
        )
    });
    told.collect()
}

/// The swing after a start at which the weight of grains comes all at once.
pub(super) fn swings(scene: &Scene) -> Vec<Warning> {
    let Some((settle, _)) = stokes_velocity(scene) else { return Vec::new() };
    if let Initial::Run(_) = scene.initial {
        return Vec::new();
    }
    // A balanced weight presses against nothing; gravity on the fluid too has a warning of its own.
    let reduced = scene.free.as_ref().and_then(|part| part.settings.gravity);
    let Some(Gravity::Reduced { .. }) = reduced else { return Vec::new() };
    let told = columns(scene, hanging(scene)).into_iter().filter_map(|column| {
        // Both ends send a wave of velocity f t/ρ into the column, which meet half-way after L/(2 c_s).
        let swing = 0.5 * column.compression * CS2.sqrt();
        let left = decay(scene, column.axis, PI / column.length)?;
        if swing < UNSEEN * settle {
            return None;
        }
        let units = &scene.units;
        let period = 2.0 * column.length / CS2.sqrt() * units.si_dt;
        let tenth = 0.1_f64.ln() / left.ln() * units.si_dt;
        let [low, high] = FACE_NAMES[column.axis];
        let pull = scene.free.as_ref()?.settings.gravity?.acceleration() * units.si_acceleration();
        Some(warning(
            format!(
                "the weight of the free grains comes all at once: water and grains swing together between the faces {low} \
                 and {high} at up to {:.2e} m/s, {:.1} times Stokes' velocity of the fastest grain, with a period of \
                 {period:.2e} s; after some {tenth:.1e} s a tenth of that is left",
                swing * units.si_velocity(),
                swing / settle,
            ),
            format!(
                "let the weight grow over two periods: `gravity.acceleration = {{ from = [0.0, 0.0, 0.0], to = [{:?}, {:?}, \
                 {:?}], end = {:.2e} }}`; or take a smaller `time.tau`, in proportion to which less 1/2 the swing falls",
                pull.x,
                pull.y,
                pull.z,
                2.0 * period
            ),
        ))
    });
    told.collect()
}

/// The weight of the free grains in the water per volume of the domain: as long as they hang in it, it carries them.
fn hanging(scene: &Scene) -> Vec3 {
    let Some(part) = &scene.free else { return Vec3::zeros() };
    let Some(gravity) = part.settings.gravity else { return Vec3::zeros() };
    let mass = |grain: &Grain| {
        let fluid = part.settings.fluid_density * sphere_volume(grain.radius);
        grain.mass - fluid
    };
    let volume = scene.setup.domain.cell_count() as f64;
    free(part).map(mass).sum::<f64>() / volume * gravity.acceleration()
}

/// The columns that a force per volume presses against an end.
fn columns(scene: &Scene, force: Vec3) -> Vec<Column> {
    let domain = &scene.setup.domain;
    let holds = |face: &Face| {
        matches!(face, Face::Wall { .. } | Face::FreeSlip | Face::VelocityInlet { .. })
    };
    let closed = (0..3).filter(|&axis| domain.faces().axis(axis).iter().all(holds));
    let column = |axis: usize| {
        let length = domain.cells()[axis] as f64;
        Column { axis, length, compression: force[axis].abs() * length / CS2 }
    };
    closed.map(column).collect()
}
