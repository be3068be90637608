//! Scenes whose grains touch as elastic spheres (`contact.youngs_modulus`): what the keys become, what `check` tells of
//! them, checkpoints, warnings and stops.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::cli::{Folder, psmrt, stderr};
use crate::common::Budget;
use crate::scene_free::mirror_plane_acts_as_the_image;
use crate::scenes::{
    BOX, FLOOR_AND_LID, GRAVITY, free_sphere, read, saved, scene, three_grains, water,
};
use psmrt::advice::estimate::{models, numbers, warnings};
use psmrt::engine::{EngineName, open};
use psmrt::scene::{FreePart, Scene};
use psmrt_reference::lattice::Vec3;

/// Three grains, of which one is held and one is led, in a box of all kinds of faces.
static SCENE: LazyLock<String> = LazyLock::new(|| {
    three_grains(
        r#"
[contact]
youngs_modulus = 1e5
poisson_ratio = 0.25
restitution = 0.7
friction = 0.3
rolling_resistance = 0.1
"#,
    )
});

/// A grain of quartz in water in a closed box, 8 cells per diameter, without dashpots.
static QUARTZ: LazyLock<String> = LazyLock::new(|| {
    let grain = free_sphere("[1e-4, 1e-4, 2e-4]", "5e-5", "2650.0");
    let contact = "[contact]\nyoungs_modulus = 1e6\nrestitution = 1.0\n";
    water([32, 32, 64], 6.25e-6, &format!("{BOX}{GRAVITY}{contact}{grain}[stop]\nsteps = 10\n"))
});

fn part(text: &str) -> (Scene, FreePart) {
    let scene = scene(text);
    let part = scene.free.clone().unwrap();
    (scene, part)
}

/// Equal up to round-off of a few operations.
fn assert_close(what: &str, found: f64, wanted: f64) {
    assert!((found / wanted - 1.0).abs() <= 1e-12, "{what}: {found} instead of {wanted}");
}

/// The number that follows `words` in a message.
fn number_after(message: &str, words: &str) -> f64 {
    let rest = message.split(words).nth(1).unwrap_or_else(|| panic!("{words}: {message}"));
    let end = rest.find([' ', ',', '\n', ':', ';']).unwrap_or(rest.len());
    rest[..end].parse().unwrap_or_else(|error| panic!("{error}: {rest}"))
}

#[test]
fn modulus_and_ratio_in_si_units_become_the_law_that_they_describe() {
    let (scene, part) = part(&SCENE);
    let law = *part.setup.law.hertz().unwrap();
    // E* = E/(2 (1 - ν²)), G* = G/(2 (2 - ν)) with G = E/(2 (1 + ν)).
    let modulus = 1e5 / (2.0 * (1.0 - 0.0625));
    let shear = 1e5 / (2.0 * 1.25) / (2.0 * 1.75);
    let si = scene.units.si_pressure();
    assert_close("effective modulus", law.modulus * si, modulus);
    assert_close("effective shear modulus", law.shear_modulus * si, shear);
    assert_close("restitution", law.restitution(), 0.7);
    assert_eq!((law.friction, law.rolling.unwrap().coefficient), (Some(0.3), 0.1));
    // A wall and a sieve are of the same material; a mirror is the contact with the grain's own image: rigid and smooth.
    let [mirror, sieve, wall, lid] = [0, 1, 2, 3].map(|i| *part.planes[i].law.hertz().unwrap());
    assert_eq!([sieve, wall, lid], [law; 3]);
    assert_close("modulus at a mirror", mirror.modulus * si, 2.0 * modulus);
    assert_eq!(mirror.friction, None);
    // Defaults: Poisson's ratio 0.3, restitution 0.5, friction 0.5.
    let bare = SCENE.replace(
        "poisson_ratio = 0.25\nrestitution = 0.7\nfriction = 0.3\nrolling_resistance = 0.1\n",
        "",
    );
    let law = *self::part(&bare).1.setup.law.hertz().unwrap();
    assert_eq!((law.material.poisson_ratio, law.friction, law.rolling), (0.3, Some(0.5), None));
    assert_close("restitution where absent", law.restitution(), 0.5);
}

#[test]
fn a_mirror_plane_acts_on_an_elastic_grain_as_its_mirror_image_does() {
    // The pair is symmetric; roots and quotients are rounded apart, in 200 sub-steps.
    mirror_plane_acts_as_the_image(&part(&SCENE).1, 1e-11);
}

#[test]
fn engines_go_on_bit_for_bit_from_what_they_saved_during_elastic_contacts() {
    let mut oracle = Budget::oracle(123_000);
    let mut native = Budget::kernel(123_000);
    let scene = scene(&SCENE);
    for name in [EngineName::Reference, EngineName::cpu(None)] {
        let budget = if name == EngineName::Reference { &mut oracle } else { &mut native };
        let new = || open(name, &scene, None, false).unwrap();
        let (mut whole, mut first, mut second) = (new(), new(), new());
        budget.spend(2 * 16 * scene.setup.domain.cell_count() as u64);
        whole.step(16).unwrap();
        first.step(8).unwrap();
        let state = first.free_grains().unwrap().state();
        assert!(
            state.pair_contacts.iter().any(|c| c.memory.spring != Vec3::zeros()),
            "{name:?}: saved before the contact"
        );
        let saved_first = saved(&first);
        second.load(&mut saved_first.as_slice()).unwrap();
        assert!(saved_first == saved(&second), "{name:?}: what is read is what was written");
        second.step(8).unwrap();
        assert!(saved(&whole) == saved(&second), "{name:?}: stopped and resumed");
    }
}

#[test]
fn numbers_of_elastic_contacts_follow_from_the_scene_in_si_units() {
    let scene = scene(&QUARTZ);
    let found = numbers(&scene);
    let value = |name: &str| found.iter().find(|number| number.name == name).unwrap().value;
    let (d, dt) = (5e-5_f64, 0.1 * 6.25e-6_f64 * 6.25e-6 / 1e-6);
    let volume = PI / 6.0 * d.powi(3);
    let (mass, weight) = (2650.0 * volume, 1650.0 * volume * 9.81);
    // Of two grains of diameter d: R* = d/4, K = (4/3) E* √R*.
    let k = 4.0 / 3.0 * 1e6 / (2.0 * 0.91) * (0.25 * d).sqrt();
    let pressure = weight / (32.0 * 6.25e-6_f64).powi(2);
    // Schiller & Naumann's steady fall, slower here than a fall without drag through the box.
    let mut speed = 0.0_f64;
    for _ in 0..500 {
        let drag = 1.0 + 0.15 * (speed * d / 1e-6).powf(0.687);
        speed = 0.5 * (speed + weight / (3.0 * PI * 1e-3 * d * drag));
    }
    let of_two = (1.25 * 0.5 * mass * speed * speed / k).powf(0.4);
    let shear = 1e6 / 2.6;
    let rayleigh = PI * 0.5 * d * (2650.0_f64 / shear).sqrt() / (0.1631 * 0.3 + 0.8766);
    for (name, wanted, tolerance) in [
        ("Young's modulus", 1e6, 1e-9),
        ("restitution", 1.0, 1e-9),
        ("overlap", (weight / k).powf(2.0 / 3.0) / d, 1e-9),
        ("overlap in a bed", (pressure * d * d / k).powf(2.0 / 3.0) / d, 1e-9),
        // The speed is found to a thousandth; the overlap goes as its power of 4/5, the duration as that of -1/5.
        ("overlap of impact", (1.25 * mass * speed * speed / k).powf(0.4) / d, 1e-3),
        ("contact duration", 2.943_275_1 * of_two / speed, 4e-4),
        ("sub-step", dt / value("sub-steps") / rayleigh, 1e-9),
    ] {
        let found = value(name);
        assert!((found / wanted - 1.0).abs() < tolerance, "{name}: {found} instead of {wanted}");
    }
    // With friction: 4 % of Rayleigh's time, which ceil() shortens; a tenth is where DEM begins to err.
    let share = value("sub-step");
    assert!(share > 0.01 && share < 0.1, "sub-steps of {share} of Rayleigh's time");
    let models = models(&scene);
    assert!(
        models.iter().any(|model| model.contains("elastic spheres (Hertz and Mindlin)")),
        "{models:?}"
    );
}

#[test]
fn a_soft_modulus_is_warned_of_and_the_modulus_that_is_named_is_hard_enough() {
    let soft = QUARTZ.replace("youngs_modulus = 1e6", "youngs_modulus = 5.0");
    let found = warnings(&scene(&soft));
    let warning =
        found.iter().find(|warning| warning.reason.contains("weight makes grains overlap"));
    let remedy = &warning.unwrap_or_else(|| panic!("{found:?}")).remedy;
    let modulus = number_after(remedy, "contact.youngs_modulus = ");
    let hard = QUARTZ.replace("youngs_modulus = 1e6", &format!("youngs_modulus = {modulus:e}"));
    let found = warnings(&scene(&hard));
    assert!(!found.iter().any(|warning| warning.reason.contains("overlap")), "{found:?}");
}

#[test]
fn moduli_out_of_all_proportion_are_refused_with_a_range_that_is_accepted() {
    for (absurd, unit) in
        [("1e300", "Pa or less"), ("1e-300", "Pa or more"), ("1e18", "Pa or less")]
    {
        let text = |modulus: &str| {
            QUARTZ.replace("youngs_modulus = 1e6", &format!("youngs_modulus = {modulus}"))
        };
        let said = read(&text(absurd)).expect_err(absurd);
        assert!(said.contains("error: contact.youngs_modulus") && said.contains(unit), "{said}");
        let limit = number_after(&said, "it must be ");
        let again = read(&text(&format!("{limit:e}")));
        assert!(again.is_ok(), "{absurd}, then {limit:e}: {:?}", again.err());
    }
}

#[test]
fn an_elastic_grain_that_sinks_through_the_floor_stops_the_run_and_the_remedy_works() {
    let mut budget = Budget::kernel(800_000);
    let grain = free_sphere("[5e-4, 5e-4, 3e-4]", "6e-4", "2650.0");
    let rest = "[contact]\nyoungs_modulus = 1.0\n[engine]\nkind = \"cpu\"\n[stop]\nsteps = 400\n";
    let text = water([10, 10, 10], 1e-4, &format!("{FLOOR_AND_LID}{GRAVITY}{grain}{rest}"))
        .replace("tau = 0.8", "dt = 2e-4");
    let folder = Folder::new("soft_elastic_floor");
    let path = folder.write("scene.toml", &text);
    let run = |more: &[&str], name: &str| {
        let out = folder.path(name);
        let paths = [path.to_str().unwrap(), "--out", out.to_str().unwrap()];
        psmrt(&[&["run"], &paths[..], more].concat())
    };
    budget.spend(400 * 1000);
    let output = run(&[], "out");
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in ["grain 0", "z_low", "too soft", "contact.youngs_modulus"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let harder =
        format!("contact.youngs_modulus={}", number_after(&said, "contact.youngs_modulus = "));
    budget.spend(400 * 1000);
    let output = run(&["--set", &harder], "again");
    assert!(output.status.success(), "{harder}: {}", stderr(&output));
}
