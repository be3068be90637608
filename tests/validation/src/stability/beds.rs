//! An ordered bed as dense as a packed one: a body-centred cubic array that fills 0.6 of the box, the
//! porosity 0.4 of the paper's section 6, with 13.3 cells per diameter (the paper has 16).
//!
//! Creeping flow through it has an exact drag (`golden/sphere_arrays/literature.csv`). The Reynolds number
//! is the paper's, `Re = U d/(ν (1 - ε))` with the superficial velocity `U` and the porosity `ε`.

use std::f64::consts::PI;

use psmrt_reference::collision::Preset;
use psmrt_reference::domain::{Face, Faces};
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::Solid;

use super::lab::{Lab, go_on};
use super::{Flow, Found, LabError, Line, Search};
use psmrt::engine::{Block, Coupled, EngineName};

/// Edge of the cubic cell of the array.
const SIDE: usize = 16;

/// Solid fraction.
const FRACTION: f64 = 0.6;

/// `K = F/(6π μ a U)` of the array, BCC at 0.6: `golden/sphere_arrays/literature.csv`.
const K_EXACT: f64 = 88.873_361_81;

/// Superficial velocities, cells per step.
const SPEEDS: &[f64] =
    &[1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 5e-3, 0.01, 0.015, 0.02, 0.03, 0.05, 0.07, 0.1, 0.14, 0.2];

/// The same at an inlet, where the limits of SRT are lower.
const INLET_SPEEDS: &[f64] = &[
    1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 5e-3, 0.01, 0.015, 0.02, 0.03, 0.05, 0.07, 0.1,
    0.14, 0.2,
];

/// Relaxation times of the maps of beds.
const TAUS: [f64; 9] = [0.500_01, 0.500_1, 0.501, 0.51, 0.55, 0.6, 0.8, 1.0, 2.0];

/// The same at an inlet: dense where MRT leaves SRT behind.
const INLET_TAUS: [f64; 7] = [0.500_1, 0.500_2, 0.500_5, 0.501, 0.51, 0.6, 1.0];

/// How far the drag may be off: beds of real grains scatter by 10 to 15 % about the laws for them, and
/// an error of the method that is larger than that of the law is of no use. Added is what 13 cells per
/// diameter cost at best.
const DRAG: f64 = 0.2;

/// Creeping flow: at this Reynolds number Ergun's inertial term is 1 % of the viscous one.
const CREEPING: f64 = 1.0;

/// A flow whose flux still changes by more than this in the last quarter is not judged.
const STEADY: f64 = 0.01;

pub(super) const BY_FORCE: Flow = Flow {
    name: "bed_force",
    about: &[
        "A body force drives the fluid through a BCC array of spheres, solid fraction 0.6, 13.3 cells per diameter,",
        "in a periodic box of 16^3 cells, off the symmetry of the grid. The force is that which drives the superficial",
        "velocity `value` by the exact drag, K = 88.8734, times 1 + 1.75/150 Re (Ergun's inertia); it starts with that",
        "velocity everywhere; 10/value steps, at least 400 and at most 1000. Re = U d/(nu (1 - porosity)), as in the",
        "paper's section 6; column reynolds: that reached. Judged below Re = 1 if steady within 1 % in the last",
        "quarter: right within 20 % of the exact drag; each line has a run at Re = 1/2 for that. error: of K.",
    ],
    parameter: "superficial velocity that the force would drive",
    values: SPEEDS,
    search: Search::Frontiers,
    also: creeping,
    lines,
    run: by_force,
};

pub(super) const BY_INLET: Flow = Flow {
    name: "bed_inlet",
    about: &[
        "Fluid enters a bed with the superficial velocity `value`: two cubic cells of the BCC array of bed_force between",
        "8 free cells on either side, 48 x 8 x 8 cells with mirror planes through the spheres; the far face is a free",
        "outflow (variant free, as in the paper) or holds the pressure (variant pressure). It starts with that velocity",
        "everywhere; 30/value steps, at least 600 and at most 1500. Judged below Re = 1 if steady within 1 %: right if",
        "the difference of pressure over the bed is within 20 % of that of the exact drag. error: of that difference.",
    ],
    parameter: "superficial velocity at the inlet",
    values: INLET_SPEEDS,
    search: Search::Frontiers,
    also: creeping,
    lines: |engine| {
        let mut all = Vec::new();
        for (variant, weighting) in [
            ("free", Weighting::NobleTorczynski),
            ("free", Weighting::SolidFraction),
            ("pressure", Weighting::NobleTorczynski),
            ("free", Weighting::Graded),
        ] {
            for model in [Preset::Srt, Preset::DHumieres] {
                if weighting == Weighting::Graded && model == Preset::Srt {
                    continue;
                }
                let weighting = Some(weighting);
                all.extend(INLET_TAUS.map(|tau| Line { engine, model, weighting, variant, tau }));
            }
        }
        all
    },
    run: by_inlet,
};

fn lines(engine: EngineName) -> Vec<Line> {
    let mut all = Vec::new();
    for weighting in [Weighting::NobleTorczynski, Weighting::SolidFraction, Weighting::Graded] {
        for model in Preset::ALL {
            let weighting = Some(weighting);
            all.extend(TAUS.map(|tau| Line { engine, model, weighting, variant: "", tau }));
        }
    }
    // B = epsilon is no default: the paper's two collisions, at fewer relaxation times.
    all.retain(|line| match line.weighting {
        Some(Weighting::SolidFraction) => {
            line.model != Preset::Trt && ![0.500_01, 0.55, 0.8, 2.0].contains(&line.tau)
        }
        Some(Weighting::NobleTorczynski | Weighting::Graded) | None => true,
    });
    all
}

/// Radius of the spheres, cells.
fn radius() -> f64 {
    // 2 · 4/3 π a³ = φ L³
    SIDE as f64 * (3.0 * FRACTION / (8.0 * PI)).cbrt()
}

/// The velocity at Re = 1/2, where the flow has the time to become steady: it does so within some
/// permeability over viscosity, 0.2/ν steps here.
fn creeping(line: &Line) -> Option<f64> {
    let nu = viscosity(line.tau);
    (line.tau > 0.505).then(|| 0.5 * nu * FRACTION / (2.0 * radius()))
}

fn reynolds(speed: f64, nu: f64) -> f64 {
    speed * 2.0 * radius() / (nu * FRACTION)
}

/// Gradient of the pressure that drives `speed` by the exact drag and Ergun's inertia.
fn gradient(speed: f64, nu: f64) -> f64 {
    let volume = (SIDE as f64).powi(3);
    // G = n 6π ν a K U/V (1 + 1.75/150 Re)
    let inertia = 1.0 + 1.75 / 150.0 * reynolds(speed, nu);
    2.0 * 6.0 * PI * nu * radius() * K_EXACT * speed / volume * inertia
}

fn phase(line: &Line, centres: &[Vec3]) -> SolidPhase {
    let weighting = line.weighting.unwrap_or_default();
    let operator = match weighting {
        Weighting::Graded => SolidOperator::GradedViscosity,
        Weighting::NobleTorczynski | Weighting::SolidFraction => SolidOperator::default(),
    };
    let solids = centres.iter().map(|&centre| Solid::fixed_sphere(centre, radius())).collect();
    SolidPhase { solids, weighting, operator, ..SolidPhase::default() }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "kept within bounds")]
fn within(steps: f64, least: u64, most: u64) -> u64 {
    (steps as u64).clamp(least, most)
}

fn by_force(lab: &Lab, line: &Line, speed: f64) -> Result<Found, LabError> {
    let nu = viscosity(line.tau);
    let along = |speed: f64| Vec3::new(speed, 0.0, 0.0);
    let corner = Vec3::new(0.31, 0.23, 0.11);
    let setup = Lab::setup(line, [SIDE; 3], Faces::PERIODIC)?
        .with_body_force(along(gradient(speed, nu)))
        .with_solids(phase(line, &[corner, corner.add_scalar(0.5 * SIDE as f64)]));
    let mut engine = lab.engine(line, &setup, None, |_| (1.0, along(speed)))?;
    let flux = |engine: &Coupled| {
        let means = engine.box_means();
        means.mass_flux.x / means.density
    };
    let steps = within(10.0 / speed, 400, 1000);
    let [before, after] = ends(&mut engine, steps, flux)?;
    // K = G V/(n 6π ν a U)
    let is_judged = reynolds(speed, nu) <= CREEPING && is_steady(before, after);
    let found = Found::judged(steps, (speed / after - 1.0).abs(), DRAG).if_judged(is_judged);
    Ok(Found { reynolds: Some(reynolds(after, nu)), ..found })
}

fn by_inlet(lab: &Lab, line: &Line, speed: f64) -> Result<Found, LabError> {
    const LEAD: usize = 8;
    let (nu, half) = (viscosity(line.tau), SIDE / 2);
    let along = |speed: f64| Vec3::new(speed, 0.0, 0.0);
    let outlet = match line.variant {
        "free" => Face::FreeOutflow,
        _ => Face::Pressure { density: 1.0 },
    };
    let faces = Faces {
        x: [Face::VelocityInlet { velocity: along(speed) }, outlet],
        y: [Face::FreeSlip; 2],
        z: [Face::FreeSlip; 2],
    };
    let cells = [2 * LEAD + 2 * SIDE, half, half];
    // A quarter of the array between mirror planes: spheres centred on two opposite edges in turn.
    let place = |number: usize| {
        let x = LEAD as f64 + (number as f64 + 0.5) * half as f64;
        let across = if number.is_multiple_of(2) { 0.0 } else { half as f64 };
        Vec3::new(x, across, across)
    };
    let centres: Vec<Vec3> = (0..4).map(place).collect();
    let setup = Lab::setup(line, cells, faces)?.with_solids(phase(line, &centres));
    let mut engine = lab.engine(line, &setup, None, |_| (1.0, along(speed)))?;
    // Pressure in the planes in the middle of the free cells before and behind the bed.
    let plane = |x: usize| Block { low: [x, 0, 0], size: [1, half, half] };
    let planes = [LEAD / 2, cells[0] - LEAD / 2 - 1].map(plane);
    let drop = |engine: &Coupled| {
        let mean = |plane: Block| {
            let sum: f64 = engine.cells(plane).iter().map(|cell| cell.density).sum();
            sum / plane.cell_count() as f64
        };
        // p = ρ/3
        (mean(planes[0]) - mean(planes[1])) / 3.0
    };
    let steps = within(30.0 / speed, 600, 1500);
    let [before, after] = ends(&mut engine, steps, drop)?;
    let expected = gradient(speed, nu) * (2 * SIDE) as f64;
    let error = (after / expected - 1.0).abs();
    let is_judged = reynolds(speed, nu) <= CREEPING && is_steady(before, after);
    let found = Found::judged(steps, error, DRAG).if_judged(is_judged);
    Ok(Found { reynolds: Some(reynolds(speed, nu)), ..found })
}

/// What is observed after three quarters of the steps and after all.
fn ends(
    engine: &mut Coupled,
    steps: u64,
    observe: impl Fn(&Coupled) -> f64,
) -> Result<[f64; 2], LabError> {
    go_on(engine, steps * 3 / 4)?;
    let before = observe(engine);
    go_on(engine, steps)?;
    Ok([before, observe(engine)])
}

fn is_steady(before: f64, after: f64) -> bool {
    (before - after).abs() <= STEADY * after.abs()
}
