//! A free grain that is as heavy as the fluid, lighter or heavier.
//!
//! It starts with a velocity, in a fluid at rest but for the part that it covers, which moves with it;
//! there is no gravity and no wall. The total momentum stays, so that in the end all moves at
//!
//! ```text
//!   v = Q/(ρ V + m_s - m_f),    Q the momentum of fluid and grain at the start
//! ```
//!
//! and at no time the grain is faster than at the start. It gets there in some viscous times of the box,
//! `L²/(4π² ν)`, and some times in which drag stops a mass against the fluid's, `m_r/(6π ν a)`.

use std::f64::consts::{PI, TAU};

use psmrt_reference::collision::Preset;
use psmrt_reference::coupling::{CouplingSettings, InternalFluid};
use psmrt_reference::domain::Faces;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;

use super::lab::{Lab, go_on};
use super::{Flow, Found, LabError, Line, Search};
use psmrt::engine::{Block, Coupled, EngineName};
use psmrt::scene::FreePart;

const SIDE: usize = 12;
const RADIUS: f64 = 3.0;
const SPEED: f64 = 0.05;
const STEPS: u64 = 600;
/// Steps between two looks.
const EVERY: u64 = 10;

/// Of the velocity at the start. Single precision and the half steps between load and motion leave far
/// less; a grain that swings or is driven by its own inertia is beyond.
const ALLOWED: f64 = 0.02;

pub(super) const FLOW: Flow = Flow {
    name: "movers",
    about: &[
        "A free grain of 6 cells in a periodic box of 12^3 cells starts at 0.05 cells per step, with the fluid that it",
        "covers; the rest of the fluid is at rest; 600 steps. variant: the inertia of the fluid inside is given back a step",
        "later (lagged) or not (kept). Right within 2 % of the velocity at the start: the grain is never faster than at the",
        "start, the momentum of fluid and grain stays, and after five times L^2/(4 pi^2 nu) + m_r/(6 pi nu a), m_r the reduced",
        "mass of grain and fluid, the grain moves at momentum over mass. error: the worst of these over that velocity.",
    ],
    parameter: "density of the grain over that of the fluid",
    values: &[10.0, 5.0, 2.65, 1.5, 1.1, 1.01, 1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.05],
    search: Search::All,
    also: |_| None,
    lines: |engine| {
        let mut all = Vec::new();
        let is_kernel = engine == EngineName::Wgpu;
        for variant in if is_kernel { vec!["lagged"] } else { vec!["lagged", "kept"] } {
            all.extend([0.501, 0.51, 0.55, 0.6, 0.8, 1.0, 2.0, 5.0].map(|tau| Line {
                engine,
                model: Preset::DHumieres,
                weighting: Some(Weighting::NobleTorczynski),
                variant,
                tau,
            }));
        }
        all
    },
    run,
};

fn run(lab: &Lab, line: &Line, ratio: f64) -> Result<Found, LabError> {
    let is_lagged = line.variant == "lagged";
    let velocity = Vec3::new(SPEED, 0.0, 0.0);
    // Off the symmetry of the grid.
    let centre = Vec3::repeat(0.5 * SIDE as f64) + Vec3::new(0.31, 0.23, 0.11);
    let grain = Grain::sphere(centre, RADIUS, ratio).moving(velocity);
    let fluid_mass = grain.mass / ratio;
    let setup = Lab::setup(line, [SIDE; 3], Faces::PERIODIC)?;
    let setup = with_grains(setup, line, std::slice::from_ref(&grain));
    let sides = PeriodicBox::all([SIDE as f64; 3]);
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, 0.5 * grain.mass)?;
    let free = FreePart {
        setup: GrainSetup { sides, ..GrainSetup::new(law) },
        grains: vec![grain],
        solids: vec![0],
        planes: Vec::new(),
        settings: CouplingSettings {
            internal_fluid: if is_lagged { InternalFluid::Lagged } else { InternalFluid::Kept },
            ..CouplingSettings::default()
        },
    };
    let state =
        |x: Vec3| (1.0, if (x - centre).norm() < RADIUS { velocity } else { Vec3::zeros() });
    let mut engine = lab.engine(line, &setup, Some(&free), state)?;
    let (all, count) = (Block::whole(&setup.domain), setup.domain.cell_count() as f64);
    let momentum = |engine: &Coupled, now: Vec3, before: Vec3| -> Vec3 {
        let fluid: Vec3 = engine.cells(all).iter().map(|cell| cell.density * cell.velocity).sum();
        // Σ j + m_s v_n - m_f v_(n-1), the last where it is given back (`coupling`)
        fluid + grain.mass * now - if is_lagged { fluid_mass * before } else { Vec3::zeros() }
    };
    let at_start = momentum(&engine, velocity, velocity);
    let nu = viscosity(line.tau);
    let masses = [grain.mass, count];
    let reduced = masses[0] * masses[1] / (masses[0] + masses[1]);
    let settling = (SIDE as f64 / TAU).powi(2) / nu + reduced / (6.0 * PI * nu * RADIUS);
    let mut error = 0.0_f64;
    while engine.steps() < STEPS {
        let next = engine.steps() + EVERY;
        go_on(&mut engine, next - 1)?;
        let before = velocity_of(&engine);
        go_on(&mut engine, next)?;
        let now = velocity_of(&engine);
        let gone = (momentum(&engine, now, before) - at_start).norm() / grain.mass;
        error = error.max(gone / SPEED).max(now.norm() / SPEED - 1.0);
        if next as f64 > 5.0 * settling {
            let mass = count + grain.mass - if is_lagged { fluid_mass } else { 0.0 };
            error = error.max((now - at_start / mass).norm() / SPEED);
        }
    }
    Ok(Found::judged(STEPS, error, ALLOWED))
}

fn velocity_of(engine: &Coupled) -> Vec3 {
    engine.solids().first().map_or_else(Vec3::zeros, |solid| solid.velocity)
}

/// The set-up with grains as its solids.
pub(super) fn with_grains(setup: Setup, line: &Line, grains: &[Grain]) -> Setup {
    let solid = |grain: &Grain| Solid {
        velocity: grain.velocity,
        angular_velocity: grain.angular_velocity,
        ..Solid::fixed_sphere(grain.position, grain.radius)
    };
    setup.with_solids(SolidPhase {
        solids: grains.iter().map(solid).collect(),
        weighting: line.weighting.unwrap_or_default(),
        ..SolidPhase::default()
    })
}
