//! `psmrt check` warns of scenes beyond what the maps of stability found to survive, and of no others; the
//! maps are read as they stand in `golden/stability`.

use std::path::Path;

use psmrt::advice::estimate::warnings;
use psmrt::advice::stability::limits::Measured;
use psmrt::scene::Scene;
use psmrt_reference::collision::Preset;
use psmrt_reference::partial_saturation::Weighting;

/// The warnings of a scene that speak of the maps.
fn warned(text: &str) -> Vec<(String, String)> {
    let text = format!("[domain]\ncells = [16, 16, 16]\ndx = 1e-5\n[stop]\nsteps = 1\n{text}");
    let scene = Scene::from_bytes("scene", text.into_bytes(), Path::new(""), &[]).unwrap();
    let all = warnings(&scene).into_iter();
    all.filter(|one| one.reason.contains("golden/stability"))
        .map(|w| (w.reason, w.remedy))
        .collect()
}

/// A fluid that starts with a velocity of cells per step, at a relaxation time.
fn flow(model: &str, tau: f64, speed: f64) -> String {
    // dt = (tau - 1/2)/3 dx²/ν
    let si_speed = speed * 3e-6 / ((tau - 0.5) * 1e-5);
    format!(
        "[fluid]\ndensity = 1000.0\nkinematic_viscosity = 1e-6\n[time]\ntau = {tau}\n[collision]\n\
         model = \"{model}\"\n[initial]\nvelocity = [{si_speed:e}, 0.0, 0.0]\n"
    )
}

#[test]
fn flows_beyond_the_map_are_warned_of_with_a_way_out() {
    // Srt at 0.5001 survives 0.03 and is right to 0.01; MRT is right to 0.28.
    let beyond = warned(&flow("srt", 0.5001, 0.15));
    let [(reason, remedy)] = &beyond[..] else { panic!("{beyond:?}") };
    assert!(reason.contains("was stable only up to 0.03"), "{reason}");
    assert!(remedy.contains("d'Humieres") && remedy.contains("0.28"), "{remedy}");
    let wrong = warned(&flow("srt", 0.5001, 0.03));
    assert!(wrong[0].0.contains("was accurate only up to 0.01"), "{wrong:?}");
    for (model, tau, speed) in [("mrt", 0.5001, 0.15), ("srt", 0.5001, 0.009), ("srt", 0.6, 0.1)] {
        assert_eq!(warned(&flow(model, tau, speed)), [], "{model} {tau} {speed}");
    }
}

#[test]
fn beds_driven_too_hard_are_warned_of() {
    let bed = |acceleration: f64| {
        format!(
            "[fluid]\ndensity = 1000.0\nkinematic_viscosity = 1e-6\n[time]\ntau = 0.8\n[[grains]]\n\
             kind = \"array\"\nlattice = \"bcc\"\nsolid_fraction = 0.6\n[body_force]\n\
             acceleration = [{acceleration:e}, 0.0, 0.0]\n"
        )
    };
    // With d = 13.3 cells and the porosity 0.4 Ergun's law gives 0.1 cells per step at a force of 0.06 per
    // step: (150 · 0.1 · 0.36/13.3² + 1.75 · 0.6 · 0.1/13.3) 0.1/0.064 = 0.06; so does the drag of a regular array
    // with its inertia, within a fifth.
    let beyond = warned(&bed(0.06 * 1e5));
    assert!(beyond.len() == 1 && beyond[0].0.contains("the body force"), "{beyond:?}");
    let told = beyond[0].0.split(" is ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    let told: f64 = told.parse().unwrap();
    assert!((told / 0.1 - 1.0).abs() < 0.2, "Ergun's law gives 0.1 cells per step: {beyond:?}");
    assert_eq!(warned(&bed(0.003 * 1e5)), []);
}

#[test]
fn grains_too_light_for_the_fluid_inside_are_warned_of() {
    let grain = |density: f64, inside: &str| {
        format!(
            "[fluid]\ndensity = 1000.0\nkinematic_viscosity = 1e-6\n[time]\ntau = 0.8\n[coupling]\n\
             internal_fluid = \"{inside}\"\n[[grains]]\nkind = \"sphere\"\ncentre = [8e-5, 8e-5, 8e-5]\n\
             diameter = 6e-5\nmotion = \"free\"\ndensity = {density}\n"
        )
    };
    let light = warned(&grain(500.0, "lagged"));
    // Kept, at tau = 0.51, a grain of 0.5 times was right; of 0.3 times none was.
    assert!(light.len() == 1 && light[0].1.contains("`time.tau` = 0.51"), "{light:?}");
    assert!(light[0].1.contains("internal_fluid = \"kept\""), "{light:?}");
    assert_eq!(warned(&grain(500.0, "kept")).len(), 1);
    let lightest = warned(&grain(300.0, "lagged"));
    assert!(lightest.len() == 1 && lightest[0].1.contains("denser"), "{lightest:?}");
    assert_eq!(warned(&grain(1000.0, "lagged")), []);
}

#[test]
fn limits_fall_towards_tau_one_half_and_mrt_goes_further_than_srt() {
    for measured in [Measured::Fluid, Measured::Bed(Weighting::NobleTorczynski)] {
        let mut last = 0.0;
        for tau in [0.5002, 0.505, 0.52, 0.6] {
            let srt = measured.limit_of(Preset::Srt, tau).unwrap().lives;
            let mrt = measured.limit_of(Preset::DHumieres, tau).unwrap().lives;
            assert!(srt >= last, "{measured:?} at {tau}: {srt} after {last}");
            // Two steps of the tried velocities where it matters; never less.
            let least = if tau < 0.501 { 2.0 } else { 1.0 };
            assert!(mrt >= least * srt, "{measured:?} at {tau}: MRT {mrt}, SRT {srt}");
            last = srt;
        }
    }
    // Where nothing was measured nothing is said.
    assert_eq!(Measured::Fluid.limit_of(Preset::Srt, 7.0), None);
}
