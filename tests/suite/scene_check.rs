//! What `psmrt check` tells of free grains: numbers against formulas in SI units, warnings where due.

use std::path::Path;
use std::sync::LazyLock;

use psmrt::advice::estimate::{models, numbers, warnings};
use psmrt::scene::EngineKind;
use psmrt::table::Table;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};

use crate::scenes::{BOX, GRAVITY, free_sphere, scene, water};

/// A grain of quartz in water in a closed box, 8 cells per diameter.
static SCENE: LazyLock<String> = LazyLock::new(|| {
    let grain = free_sphere("[1e-4, 1e-4, 2e-4]", "5e-5", "2650.0");
    let rest = r#"
[[records]]
name = "means"
kind = "grain_means"
[stop]
steps = 10
"#;
    let text = format!("{BOX}{GRAVITY}[contact]\nfriction = 0.3\n{grain}{rest}");
    water([32, 32, 64], 6.25e-6, &text)
});

#[test]
fn derived_numbers_of_grains_follow_from_the_scene_in_si_units() {
    let scene = scene(&SCENE);
    let found = numbers(&scene);
    let value = |name: &str| found.iter().find(|number| number.name == name).unwrap().value;
    let (d, dt) = (5e-5_f64, 0.1 * 6.25e-6_f64 * 6.25e-6 / 1e-6);
    let volume = std::f64::consts::PI / 6.0 * d.powi(3);
    // v = (ρ_s - ρ_f) g d²/(18 μ)
    let stokes = 1650.0 * 9.81 * d * d / (18.0 * 1e-3);
    let weight = 1650.0 * volume * 9.81;
    // Two grains touch for 10 steps: 2 s(ζ)/√(k/m) with m half a grain's mass and e = exp(-2 ζ s) = 1/2,
    // found by bisection apart from the code under test.
    let (zeta, s) = damping_of_a_half();
    let mass = 0.5 * 2650.0 * volume;
    let stiffness = mass * (2.0 * s / (10.0 * dt)).powi(2);
    for (name, wanted) in [
        ("free grains", 1.0),
        ("density ratio", 2.65),
        ("contact duration", 10.0 * dt),
        ("stiffness", stiffness),
        ("damping", 2.0 * zeta * (stiffness * mass).sqrt()),
        ("Stokes velocity", stokes),
        ("Mach number", 3.0_f64.sqrt() * value("velocity") * dt / 6.25e-6),
        ("Reynolds number", value("velocity") * d / 1e-6),
        ("overlap", weight / stiffness / d),
        // The weight of one grain on the floor of 32 x 32 cells: p d/k.
        ("overlap in a bed", weight / (32.0 * 6.25e-6_f64).powi(2) * d / stiffness),
    ] {
        let found = value(name);
        assert!((found / wanted - 1.0).abs() < 1e-9, "{name}: {found} instead of {wanted}");
    }
    // In a square shaft of four diameters the drag is K = 1.8227 times Stokes' (golden/stokes_settling/literature.csv),
    // and inertia adds F3 Re/2; F3 = 0.0673 + 0.212 c + 0.0232/(1 - c)^5 = 0.0918 at a solid fraction of 0.0041.
    let (re, fall) = (value("Reynolds number"), value("velocity"));
    let shaft = Table::read(Path::new("golden/stokes_settling/literature.csv")).unwrap();
    let shaft = shaft.with(&[("section", "square"), ("a_over_halfwidth", "0.25")]).unwrap();
    let drag = shaft.number("K1_translating_in_still_fluid").unwrap() + 0.0918 * re / 2.0;
    let force = 3.0 * std::f64::consts::PI * 1e-3 * d * fall * drag;
    // F3 is rounded to three digits, and is a part in a thousand here.
    assert!((force / weight - 1.0).abs() < 1e-5, "drag {force:e} N of the weight {weight:e} N");
    // 25 in the shortest contact. A lone grain meets walls only, with twice the reduced mass and the
    // same springs: its contacts last 10 √2 = 14.1 steps, and 25/14.1 makes 2.
    assert_eq!(value("sub-steps"), 2.0);
}

/// Damping ratio ζ and s(ζ) of a contact that returns half the speed, by bisection.
fn damping_of_a_half() -> (f64, f64) {
    let s = |zeta: f64| zeta.acos() / (1.0 - zeta * zeta).sqrt();
    let (mut low, mut high) = (0.0, 0.99);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (-2.0 * middle * s(middle)).exp() > 0.5 { low = middle } else { high = middle }
    }
    (low, s(low))
}

#[test]
fn risky_scenes_of_grains_are_warned_of_with_a_remedy_and_a_sound_one_is_not() {
    assert!(warnings(&scene(&SCENE)).is_empty(), "{:?}", warnings(&scene(&SCENE)));
    for (from, to, reason, remedy) in [
        ("-9.81]", "-9.81]\nform = \"body_force\"", "58, 80 and 92 %", "reduced"),
        ("tau = 0.8", "tau = 1.6", "grains are predicted to settle", "time.tau"),
        ("dx = 6.25e-6", "dx = 1.25e-5", "4.0 cells across the smallest grain", "time.tau"),
        ("friction = 0.3", "duration = 2e-3", "of a diameter", "contact.stiffness"),
        ("friction = 0.3", "duration = 5e-7", "sub-steps in a time step", "contact.duration"),
        ("9.81", "9810.0", "Stokes' law for the fastest grain", "shorter time step"),
        (
            "[contact]",
            "[body_force]\nacceleration = [1.0, 0.0, 0.0]\n[contact]",
            "V grad p",
            "pressure",
        ),
    ] {
        let found = warnings(&scene(&SCENE.replace(from, to)));
        let due = found.iter().find(|warning| warning.reason.contains(reason));
        let due = due.unwrap_or_else(|| panic!("{to}: {found:?}"));
        assert!(due.remedy.contains(remedy), "{due:?}");
    }
}

#[test]
fn models_of_grains_are_listed_only_where_they_are_on() {
    let listed = |text: &str| models(&scene(text)).join("\n");
    let plain = listed(&SCENE);
    assert!(plain.contains("free grains: DEM") && plain.contains("friction 0.3"), "{plain}");
    assert!(
        !plain.contains("lubrication") && !plain.contains("rolling") && !plain.contains("sieve")
    );
    let more = SCENE
        .replace("friction = 0.3", "friction = 0.0\nrolling_resistance = 0.1\n[lubrication]")
        .replace("z_high.kind = \"wall\"", "z_high = { kind = \"pressure\", pressure = 0.0 }");
    let more = listed(&more);
    for part in
        ["smooth, rolling resistance 0.1", "lubrication: between", "face +z: holds grains back"]
    {
        assert!(more.contains(part), "{part}: {more}");
    }
    let held = SCENE.replace("density = 2650.0\nmotion = \"free\"", "");
    let held =
        held.replace("[gravity]\nacceleration = [0.0, 0.0, -9.81]\n[contact]\nfriction = 0.3", "");
    let held = listed(&held.replace("grain_means", "loads"));
    assert!(
        !held.contains("DEM") && !held.contains("contact") && !held.contains("gravity"),
        "{held}"
    );
}

#[test]
fn an_operator_that_is_not_named_is_chosen_by_what_moves_and_said() {
    let held = SCENE
        .replace("density = 2650.0\nmotion = \"free\"", "")
        .replace("[gravity]\nacceleration = [0.0, 0.0, -9.81]\n[contact]\nfriction = 0.3", "")
        .replace("grain_means", "loads");
    let moved = held.replace(
        "diameter = 5e-5",
        "diameter = 5e-5\nmotion = \"prescribed\"\nspin = [0.0, 0.0, 1.0]",
    );
    let with = |text: &str, keys: &str| format!("{text}[solid]\n{keys}\n");
    let (paper, graded) = (SolidOperator::NonEquilibriumBounceBack, SolidOperator::GradedViscosity);
    for (text, operator, weighting, said) in [
        (
            held.clone(),
            graded,
            Weighting::Graded,
            "graded_viscosity (chosen, since none is named and all grains are fixed",
        ),
        (
            moved,
            paper,
            Weighting::NobleTorczynski,
            "bounce_back (chosen, since none is named and grains move",
        ),
        (
            with(&held, "coverage = \"linear\""),
            graded,
            Weighting::Graded,
            "graded_viscosity (chosen",
        ),
        (
            SCENE.to_owned(),
            paper,
            Weighting::NobleTorczynski,
            "bounce_back (chosen, since none is named and grains move",
        ),
        (
            with(&held, "weighting = \"noble_torczynski\""),
            paper,
            Weighting::NobleTorczynski,
            "bounce_back (chosen, since none is named but a weighting is given",
        ),
        (
            with(&held, "weighting = \"solid_fraction\""),
            paper,
            Weighting::SolidFraction,
            "bounce_back (chosen",
        ),
        (
            with(&held, "operator = \"bounce_back\""),
            paper,
            Weighting::NobleTorczynski,
            "bounce_back (named",
        ),
    ] {
        let scene = scene(&text);
        let phase = scene.setup.solid_phase.as_ref().unwrap();
        assert_eq!((phase.operator, phase.weighting), (operator, weighting), "{text}");
        let all = models(&scene);
        let own = all.iter().find(|line| line.contains("solid.operator: "));
        let own = own.unwrap_or_else(|| panic!("no line of {all:?} names the operator"));
        assert!(own.contains(said), "{own:?} instead of {said:?}");
        // What a run keeps names it, so that a resumed run has the same.
        let kept = scene.clone().as_run(EngineKind::Cpu).unwrap();
        let kept = self::scene(&kept.text);
        assert!(!kept.operator_is_chosen, "{}", kept.text);
        assert_eq!(kept.setup.solid_phase.as_ref().unwrap().operator, operator, "{}", kept.text);
    }
}
