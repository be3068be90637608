//! What `psmrt check` tells of inlets and pressure faces: the size of what they do to the flow, held to runs.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::common::Budget;
use crate::scenes::{saved, scene, water};
use psmrt::advice::estimate::{Warning, warnings};
use psmrt::engine::{Block, EngineName, open};
use psmrt::scene::Scene;
use psmrt_reference::domain::Face;
use psmrt_reference::lattice::CS2;

/// The warning that says `part`, if there is one.
pub(super) fn warned(scene: &Scene, part: &str) -> Option<Warning> {
    warnings(scene).into_iter().find(|warning| warning.reason.contains(part))
}

/// The number that stands before `unit` after `words`.
pub(super) fn said(reason: &str, words: &str, unit: &str) -> f64 {
    let rest = &reason[reason.find(words).unwrap_or_else(|| panic!("{words:?} in: {reason}"))..];
    let number = rest[words.len()..].split(unit).next().unwrap_or_default().trim();
    number.parse().unwrap_or_else(|_| panic!("a number after {words:?} in: {reason}"))
}

fn channel(length: usize, width: usize) -> String {
    let rest = r#"
[faces]
x_low = { kind = "pressure", pressure = 5e-5 }
x_high = { kind = "pressure", pressure = -5e-5 }
y_low.kind = "wall"
y_high.kind = "wall"
[stop]
steps = 10
"#;
    water([length, width, 1], 1e-4, rest)
}

#[test]
fn channel_between_pressure_faces_is_warned_of_with_the_measured_excess_of_its_flow() {
    // Measured from outside (length, width, flow over the exact one), in a public issue about these faces; a
    // fitted rule for all lengths should meet them to 3 % of the flow.
    for (length, width, measured) in [(16, 16, 1.117), (32, 32, 1.115), (16, 32, 1.274)] {
        let text = channel(length, width);
        let due = warned(&scene(&text), "shear stress")
            .unwrap_or_else(|| panic!("no warning at {length} x {width}"));
        let excess = said(&due.reason, "a flow that is ", "%") / 100.0;
        assert!(
            (1.0 + excess - measured).abs() < 0.03,
            "{length} x {width}: {excess} is said, {measured} times exact was measured"
        );
        assert!(due.remedy.contains("[body_force]"), "{due:?}");
        assert!(due.remedy.contains("developed = true"), "{due:?}");
        let remedied = text.replace("e-5 }", "e-5, developed = true }");
        assert_eq!(warned(&scene(&remedied), "shear stress"), None, "the remedy must be one");
    }
    // A mirror plane shows half of the channel: the same width, the same words.
    let whole = channel(32, 16);
    let half = channel(32, 8).replace("y_high.kind = \"wall\"", "y_high.kind = \"free_slip\"");
    assert_eq!(warned(&scene(&half), "shear stress"), warned(&scene(&whole), "shear stress"));
    // A long channel and one without walls are not worth a word.
    assert_eq!(warned(&scene(&channel(200, 16)), "shear stress"), None);
    let free = whole.replace("\"wall\"", "\"free_slip\"");
    assert_eq!(warned(&scene(&free), "shear stress"), None);
}

/// A plug of 32 cells at tau = 1 and 0.01 cells per step.
static PLUG: LazyLock<String> = LazyLock::new(|| {
    let rest = r#"
[collision]
model = "srt"
[faces]
x_low = { kind = "velocity_inlet", velocity = [6e-5, 0.0, 0.0] }
x_high = { kind = "pressure", pressure = 0.0 }
[stop]
steps = 2500
"#;
    water([32, 1, 1], 1e-3, rest).replace("tau = 0.8", "tau = 1.0")
});

#[test]
fn stream_started_from_rest_rings_as_long_as_check_says() {
    let at_rest = scene(&PLUG);
    let due = warned(&at_rest, "the sound of that start").expect("a start from rest is warned of");
    // δu = u and δρ/ρ = u/c_s = 0.01 √3, by linear acoustics.
    assert_eq!(said(&due.reason, "oscillates by up to ", "%"), 100.0, "{due:?}");
    assert_eq!(said(&due.reason, "the density by ", "%"), 1.7, "{due:?}");
    let left = said(&due.reason, "%, and ", "%") / 100.0;
    assert!(due.remedy.contains("initial.velocity = [6e-5, 0.0, 0.0]"), "{due:?}");

    // d'Alembert's square wave, of which the decay leaves the slowest mode: its mean over the box swings by 8/π² u.
    let (u, steps) = (0.01, 2500_u64);
    let mut engine = open(EngineName::Reference, &at_rest, None, false).unwrap();
    Budget::oracle(100_000).spend(32 * steps);
    let (mut largest, mut at) = (0.0_f64, 0);
    for step in 1..=steps {
        engine.step(1).unwrap();
        let off = (engine.box_means().mass_flux.x - u).abs();
        // The last half period of 4 L/c_s = 222 steps.
        if step + 111 > steps && off > largest {
            (largest, at) = (off, step);
        }
    }
    let expected = 8.0 / (PI * PI) * u * left.powf(at as f64 / steps as f64);
    // Why 4 %: the percentage is said without decimals, 1.4 % of 37; compression adds u/c_s = 1.7 %.
    assert!(
        (largest / expected - 1.0).abs() < 0.04,
        "the mean velocity swings by {largest:e} at step {at}, by what is said {expected:e}"
    );
    // With the inlet's velocity there is nothing to say; nor where the sound has died away by the end.
    let moving = scene(&(PLUG.to_owned() + "[initial]\nvelocity = [6e-5, 0.0, 0.0]\n"));
    assert_eq!(warned(&moving, "the sound of that start"), None);
    let long = scene(&PLUG.replace("2500", "20000"));
    assert_eq!(warned(&long, "the sound of that start"), None);
}

#[test]
fn stream_before_a_non_reflecting_outlet_has_left_of_its_start_what_check_says() {
    assert!(
        warned(&scene(&PLUG), "the sound of that start")
            .unwrap()
            .remedy
            .contains("non_reflecting = true")
    );
    let open = PLUG.replace("pressure = 0.0", "pressure = 0.0, non_reflecting = true");
    // Without a memory (222 steps of 1/6 s) and with a longer one the density falls back, with a shorter one it swings.
    for (memory, steps, swings) in
        [("", 550, false), (", memory = 83.33", 1000, false), (", memory = 9.237", 400, true)]
    {
        let text = open
            .replace("non_reflecting = true", &format!("non_reflecting = true{memory}"))
            .replace("2500", &steps.to_string());
        let scene = scene(&text);
        assert_eq!(warned(&scene, "the sound of that start"), None, "it does not ring");
        let due = warned(&scene, "holds its pressure again").unwrap_or_else(|| panic!("{text}"));
        let left = said(&due.reason, "s; ", "%") / 100.0;
        let mut engine = psmrt::engine::open(EngineName::Reference, &scene, None, false).unwrap();
        Budget::oracle(40_000).spend(32 * (steps + 111));
        let mut rise = || {
            engine.step(1).unwrap();
            (engine.box_means().density - 1.0) / (0.01 * 3.0_f64.sqrt())
        };
        let before: Vec<f64> = (0..steps).map(|_| rise()).collect();
        let measured = if swings {
            // A swing takes 4 to 8 L/c_s: its size at the end is between the largest before and after.
            let largest =
                |rises: &mut dyn Iterator<Item = f64>| rises.map(f64::abs).fold(0.0, f64::max);
            let (before, after) = (
                largest(&mut before.iter().rev().take(111).copied()),
                largest(&mut (0..111).map(|_| rise())),
            );
            (before * after).sqrt()
        } else {
            before.last().unwrap().abs()
        };
        println!("steps {steps}{memory}: {left} is said, {measured:.3} is left");
        // Why: percent without decimals, and 10 % for the faster modes, compression (1.7 %) and viscosity.
        assert!(
            (measured - left).abs() < 0.005 + 0.1 * left,
            "steps {steps}{memory}: {measured} of the rise is left, {left} is said"
        );
    }
    // Long enough, or started with the inlet's velocity: nothing to say.
    assert_eq!(warned(&scene(&open), "holds its pressure again"), None);
    let moving = open.replace("2500", "500") + "[initial]\nvelocity = [6e-5, 0.0, 0.0]\n";
    assert_eq!(warned(&scene(&moving), "holds its pressure again"), None);
}

#[test]
fn pressure_difference_between_non_reflecting_faces_accelerates_as_slowly_as_check_says() {
    // Without walls: the acceleration is that of the pressure difference on the mass between the faces.
    let inlet = PLUG.find("x_low").unwrap()..PLUG.find("x_high").unwrap();
    let mut text = PLUG.replace("pressure = 0.0", "pressure = 0.0, non_reflecting = true");
    text.replace_range(inlet, "x_low = { kind = \"pressure\", pressure = 1.2e-8, LOW }\n");
    for (low, times) in [("non_reflecting = true", 9.0), ("developed = true", 5.0)] {
        let scene = scene(&text.replace("LOW", low));
        let due = warned(&scene, "accelerates the fluid").expect("their inertia is warned of");
        assert_eq!(said(&due.reason, "as if the domain were ", "times"), times, "{due:?}");
        Budget::oracle(150_000).spend(32 * 4000);
        let mut engine = psmrt::engine::open(EngineName::Reference, &scene, None, false).unwrap();
        engine.step(2000).unwrap();
        let before = engine.box_means().mass_flux.x;
        engine.step(2000).unwrap();
        let gained = (engine.box_means().mass_flux.x - before) / 2000.0;
        let expected = 1.2e-8 / scene.units.si_pressure() / (32.0 * times);
        // Why 2 %: each face is known to half a cell of 32 and more.
        assert!(
            (gained / expected - 1.0).abs() < 0.02,
            "{low}: the fluid gains {gained:e} a step, as is said {expected:e}"
        );
    }
    let developed = text
        .replace("non_reflecting = true", "developed = true")
        .replace("LOW", "developed = true");
    assert_eq!(warned(&scene(&developed), "accelerates the fluid"), None);
}

/// A free grain before the outlet.
const GRAIN: &str = r#"
[gravity]
acceleration = [0.0, 0.0, -1e-4]
[[grains]]
kind = "sphere"
centre = [27e-3, 4e-3, 4e-3]
diameter = 5e-3
density = 1500.0
motion = "free"
"#;

#[test]
fn saved_state_before_a_non_reflecting_outlet_goes_on_bit_for_bit_on_the_oracle() {
    let open = PLUG.replace("pressure = 0.0", "pressure = 0.0, non_reflecting = true");
    let with_grain = open.replace("[32, 1, 1]", "[32, 8, 8]") + GRAIN;
    for text in [open, with_grain] {
        let scene = scene(&text);
        Budget::oracle(500_000).spend(200 * scene.setup.domain.cell_count() as u64);
        let mut straight = psmrt::engine::open(EngineName::Reference, &scene, None, false).unwrap();
        straight.step(70).unwrap();
        let state = saved(&straight);
        let mut resumed = psmrt::engine::open(EngineName::Reference, &scene, None, false).unwrap();
        resumed.load(&mut &state[..]).unwrap();
        assert!(saved(&resumed) == state, "what is loaded is what was saved");
        straight.step(65).unwrap();
        resumed.step(65).unwrap();
        assert!(saved(&straight) == saved(&resumed), "the resumed run goes another way");
    }
}

#[test]
fn memory_of_a_non_reflecting_face_is_four_crossings_of_sound_or_what_the_scene_says() {
    let memory = |keys: &str| {
        let scene = scene(&PLUG.replace("pressure = 0.0", &format!("pressure = 0.0, {keys}")));
        scene.setup.domain.faces().x[1]
    };
    let open = |memory| Face::NonReflectingPressure { density: 1.0, memory };
    assert_eq!(memory("non_reflecting = true"), open(4.0 * 32.0 / CS2.sqrt()));
    assert_eq!(memory("non_reflecting = true, developed = true"), open(4.0 * 32.0 / CS2.sqrt()));
    // A step is 1/6 s: nu dt/dx² = (tau - 1/2)/3.
    match memory("non_reflecting = true, memory = 5.0") {
        Face::NonReflectingPressure { memory, .. } => assert!((memory - 30.0).abs() < 1e-9),
        face => panic!("{face:?}"),
    }
    assert_eq!(memory("non_reflecting = false"), Face::Pressure { density: 1.0 });
}

#[test]
fn sphere_that_touches_the_inlet_is_warned_of_and_presses_the_fluid_beneath_it_together() {
    // A sphere of 16 cells, pressed into the inlet by a tenth of a cell, or a diameter clear of it.
    let text = |centre: f64| {
        let rest = format!(
            "[faces]\nz_low = {{ kind = \"velocity_inlet\", velocity = [0.0, 0.0, 0.0375] }}\n\
             z_high = {{ kind = \"pressure\", pressure = 0.0 }}\n\
             [initial]\nvelocity = [0.0, 0.0, 0.0375]\n\
             [solid]\noperator = \"bounce_back\"\n\
             [[grains]]\nkind = \"sphere\"\ndiameter = 1.6e-4\ncentre = [1.2e-4, 1.2e-4, {centre:e}]\n\
             [stop]\nsteps = 3000\n"
        );
        water([24, 24, 48], 1e-5, &rest).replace("tau = 0.8", "tau = 0.51")
    };
    let densest = |text: &str| {
        let scene = scene(text);
        let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
        engine.step(3000).unwrap();
        let cells = engine.cells(Block::whole(&scene.setup.domain));
        cells.iter().map(|cell| cell.density).fold(0.0, f64::max)
    };
    let (touching, clear) = (text(7.9e-5), text(2.4e-4));
    assert!(warned(&scene(&touching), "the velocity inlet z_low").is_some());
    assert_eq!(warned(&scene(&clear), "the velocity inlet z_low"), None);
    // Lubrication, a hundredth of the density at a cell from the contact, rising with the fourth power of the distance: more than
    // ten times the 1 % that a clear sphere's own drag and the stream's head make at most.
    let [touching, clear] = [touching, clear].map(|text| densest(&text) - 1.0);
    assert!(touching > 0.1, "beneath a sphere that touches, the density rises by {touching:e}");
    assert!(clear < 0.01, "with clear fluid above the inlet the density rises by {clear:e}");
}

#[test]
fn bed_on_a_sieve_is_the_same_bed_higher_up() {
    let text = |floor: &str| {
        let rest = format!(
            "[faces]\nz_low = {{ kind = \"velocity_inlet\", velocity = [0.0, 0.0, 1e-3] }}\nz_high = {{ kind = \"pressure\", pressure = 0.0 }}\n\
             [[grains]]\nkind = \"bed\"\ncount = 6\ndiameter = 8e-5\n{floor}[stop]\nsteps = 1\n"
        );
        water([16, 16, 40], 1e-5, &rest)
    };
    let (low, high) = (scene(&text("")), scene(&text("floor = 1.1e-4\n")));
    let solids = |scene: &Scene| scene.setup.solid_phase.clone().unwrap().solids;
    for (low, high) in solids(&low).iter().zip(&solids(&high)) {
        let moved = high.centre - low.centre;
        assert!(
            (moved.x, moved.y) == (0.0, 0.0) && (moved.z - 11.0).abs() < 1e-9,
            "moved by {moved:?} cells, 11 wanted"
        );
    }
    assert!(warned(&low, "the velocity inlet z_low").is_some());
    assert_eq!(warned(&high, "the velocity inlet z_low"), None);
    let error = crate::scenes::read(&text("floor = 3.9e-4\n")).unwrap_err();
    assert!(
        error.contains("grains[0].floor") && error.contains("higher than the domain"),
        "{error}"
    );
}
