//! Warnings of a start whose sound does not decay: a velocity inlet accelerates fluid that starts with another
//! velocity, and the wave travels back and forth between it and a pressure face; or a non-reflecting face lets it out,
//! but holds its pressure again only after its memory.

use std::f64::consts::PI;

use nalgebra::Complex;
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{FACE_NAMES, Face};
use psmrt_reference::lattice::{CS2, Vec3, viscosity};

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;
use crate::scene::initial::Initial;
use crate::seepage::spheres::{solid_fraction, spheres};

/// A start that misses the inlet's velocity by less than this part of it is not worth a word.
const SMALL: f64 = 0.01;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let faces = scene.setup.domain.faces();
    let is_pressure = |face: &Face| face.held_density().is_some();
    if !(0..3).any(|axis| faces.axis(axis).iter().any(is_pressure)) {
        return Vec::new();
    }
    let all = (0..3).flat_map(|axis| [0, 1].map(|side| (axis, side)));
    let inlets = all.filter_map(|(axis, side)| match faces.axis(axis)[side] {
        Face::VelocityInlet { velocity } => start(scene, axis, side, &velocity),
        _ => None,
    });
    inlets.collect()
}

/// What the start of a stream through one inlet brings, if its sound is still there when the run ends.
fn start(scene: &Scene, axis: usize, side: usize, velocity: &Vec3) -> Option<Warning> {
    if let Initial::Run(_) = scene.initial {
        return None;
    }
    // In the middle of the face.
    let mut middle = Vec3::from(scene.setup.domain.cells().map(|n| (n / 2) as f64 + 0.5));
    middle[axis] = if side == 0 { 0.5 } else { scene.setup.domain.cells()[axis] as f64 - 0.5 };
    let (_, start) = scene.initial.at(middle);
    let missed = (velocity[axis] - start[axis]).abs();
    if missed <= SMALL * velocity[axis].abs() {
        return None;
    }
    let faces = scene.setup.domain.faces();
    let [x, y, z] = velocity.map(|u| u * scene.units.si_velocity()).into();
    let remedy = format!(
        "start the fluid with the inlet's velocity: `initial.velocity = [{x:?}, {y:?}, {z:?}]`"
    );
    if let Face::NonReflectingPressure { memory, .. } = faces.axis(axis)[1 - side] {
        let cells = scene.setup.domain.cells()[axis] as f64;
        let left = left_before_open_face(memory, cells, scene.stop.steps as f64);
        let reason = format!(
            "the inlet at face {} accelerates fluid that does not start with its velocity: that raises the \
             density by {:.1} %, until the non-reflecting face {} holds its pressure again, over a memory of {:.2e} s; \
             {:.0} % of the rise is left when the run ends",
            FACE_NAMES[axis][side],
            100.0 * missed / CS2.sqrt(),
            FACE_NAMES[axis][1 - side],
            memory * scene.units.si_dt,
            100.0 * left
        );
        return (left >= SMALL).then(|| warning(reason, remedy + ", or let the run last longer"));
    }
    // A quarter of a wave long.
    let k = PI / (2.0 * scene.setup.domain.cells()[axis] as f64);
    let left = decay(scene, axis, k)?.powf(scene.stop.steps as f64);
    if left < SMALL {
        return None;
    }
    let reason = format!(
        "the inlet at face {} accelerates fluid that does not start with its velocity: the sound of that start \
         travels back and forth between the inlet and the pressure face; the velocity oscillates by up to {:.0} % of \
         the inlet's to either side, the density by {:.1} %, and {:.0} % of that is left when the run ends",
        FACE_NAMES[axis][side],
        100.0 * missed / velocity[axis].abs(),
        // δρ/ρ = u/c_s
        100.0 * missed / CS2.sqrt(),
        100.0 * left
    );
    Some(warning(
        reason,
        remedy + ", or let the sound out: `non_reflecting = true` at the pressure face",
    ))
}

/// What is left, after so many steps, of the rise of the mean density with which a stream of `cells` cells starts from
/// rest between an inlet and a non-reflecting face.
fn left_before_open_face(memory: f64, cells: f64, steps: f64) -> f64 {
    // The inlet sends sound back as it came, the face with r = -1/(1 + 2sT): a mode exp(st) of a domain of L cells has
    // 1 + θz + exp(-z) = 0 with z = 2 s L/c_s, θ = T c_s/L. The slowest, by Newton's method.
    let theta = memory * CS2.sqrt() / cells;
    let swings = theta < 3.6;
    let mut z =
        if swings { Complex::new(-0.1, PI / (1.0 + theta)) } else { Complex::new(0.0, 0.0) };
    for _ in 0..60 {
        let back = (-z).exp();
        z -= (1.0 + theta * z + back) / (theta - back);
    }
    // Its part in the start, by Laplace's transform: 4 exp(-z) sinh(z/2)/(z² (θ - exp(-z))), and its conjugate.
    let part = 4.0 * (-z).exp() * (0.5 * z).sinh() / (z * z * (theta - (-z).exp()));
    let both = if swings { 2.0 } else { 1.0 };
    (both * part.norm() * (0.5 * z.re * steps * CS2.sqrt() / cells).exp()).min(1.0)
}

/// What a step leaves of a standing wave along `axis` of the wave number `k`, in which free grains swing along with the
/// water. `None` if friction lets nothing swing.
pub(super) fn decay(scene: &Scene, axis: usize, k: f64) -> Option<f64> {
    let (domain, collision) = (&scene.setup.domain, &scene.setup.collision);
    let nu = viscosity(collision.tau());
    let s_e = match collision {
        Collision::Srt { tau } => 1.0 / tau,
        Collision::Mrt { rates } => rates.e,
    };
    // ζ = 2/9 (1/s_e - 1/2)                            (d'Humières et al. 2002, with c_s² = 1/3)
    let bulk = 2.0 / 9.0 * (1.0 / s_e - 0.5);
    let omega = CS2.sqrt() * k;
    // d²p/dt² + 2 β dp/dt + ω² p = 0,  2 β = (4/3 ν + ζ) k² + friction
    let mut twice_beta = (4.0 / 3.0 * nu + bulk) * k * k;
    for across in (0..3).filter(|&other| other != axis) {
        let width = domain.cells()[across] as f64;
        let faces = domain.faces().axis(across);
        let walls = faces.iter().filter(|face| matches!(face, Face::Wall { .. })).count() as f64;
        // Of a wall's boundary layer (Kirchhoff 1868), or of Poiseuille flow where that fills the channel: the larger one is
        // the right one on either side of the width, six layers, at which they are equal.
        let layer = (0.5 * nu * omega).sqrt() / width;
        twice_beta += walls * layer.max(6.0 * nu / (width * width));
    }
    let porosity = 1.0 - solid_fraction(scene);
    let mut stays = vec![true; spheres(scene).len()];
    if let Some(part) = &scene.free {
        let free = part.solids.iter().zip(&part.grains).filter(|(_, grain)| !grain.held);
        free.for_each(|(&solid, _)| stays[solid] = false);
    }
    let staying = spheres(scene).into_iter().zip(stays).filter(|(_, stays)| *stays);
    for ((_, radius, share), _) in staying {
        // Stokes drag, in a bed larger by ε^-3.7            (Wen & Yu 1966)
        let drag = 6.0 * PI * nu * radius * porosity.powf(-3.7);
        twice_beta += share * drag / domain.cell_count() as f64;
    }
    (0.5 * twice_beta < omega).then(|| (-0.5 * twice_beta).exp())
}
