//! What both engines are put through by their set-ups: nothing solid, any units, and runs on either side of the
//! frontiers that `golden/stability` holds.

use std::path::Path;

use psmrt::engine::EngineName;
use psmrt::scene::Scene;
use psmrt_reference::collision::Preset;
use psmrt_reference::domain::Faces;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::setup::SolidPhase;
use psmrt_validation::stability::{FLOWS, Found, Lab, Line, Outcome};

use crate::common::Budget;

/// A run close to a frontier, and whether it is to survive.
pub struct Near {
    pub flow: &'static str,
    pub model: Preset,
    pub weighting: Option<Weighting>,
    pub variant: &'static str,
    pub tau: f64,
    pub value: f64,
    pub lives: bool,
}

/// Runs on either side of frontiers: the values tried next to them (`golden/stability`), so that small
/// changes of the rounding do not matter, with the cells of their flow.
pub fn near_frontiers() -> Vec<(Near, u64)> {
    let mut all = Vec::new();
    let mut both = |flow, cells, model, weighting, variant, tau, [inside, outside]: [f64; 2]| {
        for (value, lives) in [(inside, true), (outside, false)] {
            all.push((Near { flow, model, weighting, variant, tau, value, lives }, cells));
        }
    };
    let nt = Some(Weighting::NobleTorczynski);
    both("shear_layer", 2304, Preset::Srt, None, "", 0.501, [0.1, 0.28]);
    both("shear_layer", 2304, Preset::DHumieres, None, "", 0.501, [0.28, 0.5]);
    both("abc", 4096, Preset::Srt, None, "", 0.500_001, [0.28, 0.5]);
    both("taylor_green", 4096, Preset::Srt, None, "", 0.51, [0.28, 0.5]);
    both("bed_force", 4096, Preset::Srt, nt, "", 0.501, [0.005, 0.02]);
    both("bed_force", 4096, Preset::DHumieres, nt, "", 0.501, [0.03, 0.07]);
    both("bed_force", 4096, Preset::Srt, nt, "", 0.6, [0.03, 0.07]);
    both("movers", 1728, Preset::DHumieres, nt, "lagged", 0.6, [0.8, 0.2]);
    // So light that it is thrown beyond all bounds before the guard looks.
    both("movers", 1728, Preset::DHumieres, nt, "lagged", 0.51, [1.0, 0.05]);
    all
}

/// Makes the run and holds it to what it should be; a run that is to break must be stopped by the guard,
/// at a step that is one of its looks.
pub fn assert_near(
    (near, cells): &(Near, u64),
    engine: EngineName,
    lab: &Lab,
    budget: &mut Budget,
) {
    let Near { flow, model, weighting, variant, tau, value, lives } = *near;
    let line = Line { engine, model, weighting, variant, tau };
    let flow = FLOWS.iter().find(|known| known.name == flow).unwrap();
    let found = (flow.run)(lab, &line, value).or_else(Found::of).unwrap();
    budget.spend(found.steps * cells);
    println!("{} {line:?} {value}: {found:?}", flow.name);
    if lives {
        assert!(
            found.outcome.lived(),
            "{} on this side of the frontier ({line:?} at {value}) ought to survive: {found:?}",
            flow.name,
        );
    } else {
        assert_eq!(
            found.outcome,
            Outcome::Stopped,
            "{} beyond the frontier ({line:?} at {value}) ought to be stopped",
            flow.name,
        );
        assert!(found.how.is_some());
    }
}

/// Eight grains whose centres share a cell live and close their balance; contacts as brief as a thirtieth of a
/// step are right with the sub-steps that they need, and refused with too few.
pub fn in_one_cell_and_too_hard(engine: EngineName, lab: &Lab, budget: &mut Budget) {
    let nt = Some(Weighting::NobleTorczynski);
    for (flow, cells, variant, tau, value, expected) in [
        ("crowd", 1728, "cluster", 0.501, 8.0, Outcome::Right),
        ("contact", 1200, "10", 0.6, 0.03, Outcome::Right),
        ("contact", 1200, "5", 0.6, 0.03, Outcome::Refused),
    ] {
        let line = Line { engine, model: Preset::DHumieres, weighting: nt, variant, tau };
        let flow = FLOWS.iter().find(|known| known.name == flow).unwrap();
        let found = (flow.run)(lab, &line, value).or_else(Found::of).unwrap();
        budget.spend(found.steps * cells);
        assert_eq!(
            found.outcome, expected,
            "{} near the frontier ({line:?} at {value}) ends otherwise than the map says: \
             {found:?}",
            flow.name,
        );
    }
}

/// A solid phase without solids is no solid phase: the same numbers, bit for bit.
pub fn no_grains(engine: EngineName, lab: &Lab, budget: &mut Budget) {
    let line = Line { engine, model: Preset::DHumieres, weighting: None, variant: "", tau: 0.8 };
    let bare = Lab::setup(&line, [6, 5, 4], Faces::PERIODIC).unwrap();
    let empty = bare.clone().with_solids(SolidPhase::default());
    let means = [bare, empty].map(|setup| {
        let start = |x: Vec3| (1.0, 0.01 * Vec3::new(x.y.sin(), x.z.cos(), x.x.sin()));
        let mut engine = lab.engine(&line, &setup, None, start).unwrap();
        budget.spend(120 * 10);
        engine.step(10).unwrap();
        assert!(engine.loads().is_empty() && engine.solids().is_empty());
        engine.box_means()
    });
    assert_eq!(means[0], means[1]);
    assert!(means[0].max_speed > 1e-3);
}

/// The same scene with cells from a nanometre to a metre, and fluids from thin to heavy: the same lattice
/// numbers, within the rounding of the units, and SI values in proportion.
pub fn any_units(engine: EngineName, lab: &Lab, budget: &mut Budget) {
    const MADE: u64 = 50;
    let mut first: Option<[f64; 3]> = None;
    for (si_dx, si_density) in [(1e-5, 1e3), (1e-9, 1e3), (1.0, 1e3), (1e-5, 1e-3), (1e-5, 1e6)] {
        // Of the lattice: tau = 0.8, a force of 1e-5 per step, a free grain 2.65 times as heavy as the
        // fluid that gains 1e-4 per step.
        let si_dt = 0.1 * si_dx * si_dx / 1e-6;
        let unit = si_dx / (si_dt * si_dt);
        let text = format!(
            "[domain]\ncells = [10, 10, 12]\ndx = {si_dx:e}\n[fluid]\ndensity = {si_density:e}\n\
             kinematic_viscosity = 1e-6\n[time]\ntau = 0.8\n[faces]\nz_low.kind = \"wall\"\n\
             z_high.kind = \"wall\"\n[body_force]\nacceleration = [{:e}, 0.0, 0.0]\n[gravity]\n\
             acceleration = [0.0, 0.0, {:e}]\n[[grains]]\nkind = \"sphere\"\nmotion = \"free\"\n\
             centre = [{:e}, {:e}, {:e}]\ndiameter = {:e}\ndensity = {:e}\n[stop]\nsteps = {MADE}\n",
            1e-5 * unit,
            -1e-4 * unit,
            5.3 * si_dx,
            5.2 * si_dx,
            6.1 * si_dx,
            6.0 * si_dx,
            2.65 * si_density,
        );
        let scene = Scene::from_bytes("units", text.into_bytes(), Path::new(""), &[])
            .unwrap_or_else(|error| panic!("dx = {si_dx}: {error}"));
        assert!(
            (scene.setup.collision.tau() - 0.8).abs() < 1e-12,
            "cells of dx = {si_dx} m: the relaxation time is not the 0.8 of the scene",
        );
        let line =
            Line { engine, model: Preset::DHumieres, weighting: None, variant: "", tau: 0.8 };
        let mut run =
            lab.engine(&line, &scene.setup, scene.free.as_ref(), |_| (1.0, Vec3::zeros())).unwrap();
        budget.spend(1200 * MADE);
        run.step(MADE).unwrap();
        let (flux, grain) = (run.box_means().mass_flux.x, &run.solids()[0]);
        let found = [flux, grain.velocity.z, grain.centre.z];
        let expected = *first.get_or_insert(found);
        // Converting to the lattice rounds some ten times: 1e-13 in the set-up of either engine, which the
        // kernel rounds to 6e-8.
        let allowed = if engine == EngineName::Reference { 1e-10 } else { 1e-4 };
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found / expected - 1.0).abs() < allowed,
                "dx = {si_dx}, density {si_density}: {found} and {expected}"
            );
        }
        assert!(flux > 1e-5 && grain.velocity.z < -1e-4, "nothing moves: {found:?}");
    }
}
