//! Contacts that hold: the default stiffness follows weight and impacts whatever the time step, a grain that is
//! not held stops the run with cause and remedy, and keys of `[contact]` out of all proportion are blamed.

use std::path::Path;
use std::sync::LazyLock;

use crate::cli::{Folder, psmrt, stderr};
use crate::common::Budget;
use crate::scenes::{BOX, FLOOR_AND_LID, GRAVITY, free_sphere, read, scene, water};
use psmrt::advice::estimate::{numbers, warnings};
use psmrt::engine::{EngineName, open};
use psmrt_reference::grains::grain::sphere_volume;
use psmrt_reference::grains::hold::deepest_of;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

/// Sixty grains of sand that have settled under water, contacts by default.
static BED: LazyLock<String> = LazyLock::new(|| {
    let grains = r#"
[[grains]]
kind = "bed"
diameter = 6e-4
count = 60
density = 2650.0
motion = "free"
[stop]
steps = 10
"#;
    water([32, 32, 40], 1e-4, &format!("{FLOOR_AND_LID}{GRAVITY}{grains}"))
});

/// A ball of steel (1 mm) above a grain (0.2 mm) on the floor, contacts by default.
static BALL: LazyLock<String> = LazyLock::new(|| {
    let ball = free_sphere("[6e-4, 6e-4, 0.0009]", "0.001", "7800.0");
    let grain = free_sphere("[6e-4, 6e-4, 0.000101]", "0.0002", "2500.0");
    let rest = r#"
[[records]]
name = "means"
kind = "grain_means"
every_steps = 5
[stop]
steps = 60
"#;
    water([12, 12, 24], 1e-4, &format!("{BOX}{GRAVITY}{ball}{grain}{rest}"))
        .replace("tau = 0.8", "dt = 0.0002")
});

/// A heavy grain on a floor that is too soft for it.
static SOFT: LazyLock<String> = LazyLock::new(|| {
    let grain = free_sphere("[5e-4, 5e-4, 3e-4]", "6e-4", "2650.0");
    let rest = r#"
[contact]
stiffness = 1e-3
[[records]]
name = "g"
kind = "loads"
every_steps = 20
[stop]
steps = 400
"#;
    water([10, 10, 10], 1e-4, &format!("{FLOOR_AND_LID}{GRAVITY}{grain}{rest}"))
        .replace("tau = 0.8", "dt = 2e-4")
});

/// The number that follows `words` in a message.
fn number_after(message: &str, words: &str) -> f64 {
    let rest = message.split(words).nth(1).unwrap_or_else(|| panic!("{words}: {message}"));
    let end = rest.find([' ', ',', '\n', ':', ';']).unwrap_or(rest.len());
    rest[..end].parse().unwrap_or_else(|error| panic!("{error}: {rest}"))
}

/// Speed, m/s, of the steady fall of a sphere in water by the drag of Schiller & Naumann: the equation solved
/// for `v`, again and again.
fn settling_speed(si_weight: f64, d: f64) -> f64 {
    let mut v = 0.0_f64;
    for _ in 0..500 {
        let drag = 1.0 + 0.15 * (v * d / 1e-6).powf(0.687);
        v = 0.5 * (v + si_weight / (3.0 * std::f64::consts::PI * 1e-3 * d * drag));
    }
    v
}

#[test]
fn the_default_stiffness_is_what_weight_and_impacts_ask_for_at_any_time_step() {
    // SI: a grain, its weight in water, the pressure of sixty of them on the floor.
    let (d, volume) = (6e-4, sphere_volume(3e-4));
    let (mass, weight) = (2650.0 * volume, 1650.0 * volume * 9.81);
    let pressure = 60.0 * weight / (3.2e-3 * 3.2e-3);
    let bed = pressure * d / 0.003;
    let dropped = (2.0 * weight / mass * 4e-3).sqrt();
    let speed = settling_speed(weight, d).min(dropped);
    let impact = mass * speed * speed / (0.05 * d).powi(2);
    let wanted = bed.max(impact).max(weight / (0.01 * d));
    for tau in ["0.6", "0.8", "0.9"] {
        let scene = scene(&BED.replace("tau = 0.8", &format!("tau = {tau}")));
        let found = numbers(&scene).into_iter().find(|number| number.name == "stiffness").unwrap();
        // The speed is found to a thousandth, and the stiffness goes as its square.
        assert!(
            (found.value / wanted - 1.0).abs() < 3e-3,
            "tau {tau}: {} N/m, not {wanted}",
            found.value
        );
    }
    // With a short time step ten steps are shorter than that: then contacts last ten steps, as ever.
    let short = scene(&BED.replace("tau = 0.8", "tau = 0.505"));
    let law = *short.free.as_ref().unwrap().setup.law.linear().unwrap();
    let pair = 0.5 * short.free.as_ref().unwrap().grains[0].mass;
    assert!((law.duration(pair) - 10.0).abs() < 1e-9, "{}", law.duration(pair));
}

#[test]
fn a_bed_at_rest_overlaps_by_less_than_one_percent_of_a_diameter_at_any_tau() {
    for tau in ["0.55", "0.8", "0.9"] {
        let scene = scene(&BED.replace("tau = 0.8", &format!("tau = {tau}")));
        let part = scene.free.as_ref().unwrap();
        let g = 9.81 / scene.units.si_acceleration();
        let mut system =
            GrainSystem::new(part.setup, part.grains.clone(), part.planes.clone()).unwrap();
        // Weight less buoyancy, and a medium that stops a grain in a tenth of the time in which it would
        // fall by its diameter: the contacts alone hold the bed, the fluid is not needed.
        let calm = 10.0 / (6.0 / g).sqrt();
        let substep = system.shortest_time() / 15.0;
        let mut loads = vec![Load::default(); part.grains.len()];
        let mut time = 0.0;
        while time < 20.0 * (6.0 / g).sqrt() {
            for (load, grain) in loads.iter_mut().zip(system.grains()) {
                let weight = (grain.mass - sphere_volume(grain.radius)) * g;
                load.force = -calm * grain.mass * grain.velocity - weight * Vec3::z();
                load.torque = -calm * grain.inertia * grain.angular_velocity;
            }
            system.substep(substep, &loads).unwrap();
            time += substep;
        }
        let depth = |grain| deepest_of(&system, grain).map_or(0.0, |sunk| sunk.depth());
        let deepest = (0..60).map(depth).fold(0.0, f64::max);
        // Over the radius: 1 % of a diameter is 0.02. Were there no contact at all, it would be negative.
        assert!(deepest > 1e-4 && deepest < 0.02, "tau {tau}: {deepest} of a radius");
    }
}

#[test]
fn a_steel_ball_that_falls_on_a_small_grain_overlaps_it_by_less_than_five_percent() {
    let mut budget = Budget::oracle(210_000);
    let scene = scene(&BALL);
    let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
    let mut deepest = 0.0_f64;
    budget.spend(60 * scene.setup.domain.cell_count() as u64);
    for _ in 0..60 {
        engine.step(1).unwrap_or_else(|stop| panic!("step {}: {stop}", engine.steps()));
        let sunk = deepest_of(engine.free_grains().unwrap(), 1).unwrap();
        deepest = deepest.max(sunk.depth());
    }
    // 5 % of the small diameter is a tenth of its radius; it falls 0.2 mm and does touch.
    assert!(deepest > 0.0 && deepest < 0.1, "{deepest} of a radius");
}

#[test]
fn a_grain_that_sinks_through_the_floor_stops_the_run_and_the_remedy_works() {
    let mut budget = Budget::oracle(800_000);
    let folder = Folder::new("soft_floor");
    let path = folder.write("scene.toml", &*SOFT);
    let out = folder.path("out");
    let run = |more: &[&str], out: &Path| {
        let paths = [path.to_str().unwrap(), "--out", out.to_str().unwrap()];
        psmrt(&[&["run"], &paths[..], more].concat())
    };
    budget.spend(400 * 1000);
    let output = run(&[], &out);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in ["after step ", "grain 0", "z_low", "too soft", "contact.stiffness"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    // The records are whole, and end before the step at which it stopped.
    let step = number_after(&said, "after step ");
    let table = std::fs::read_to_string(out.join("g.csv")).unwrap();
    assert!(table.ends_with('\n'), "{table}");
    let last = table.lines().last().unwrap().split(',').nth(1).unwrap().parse::<f64>().unwrap();
    assert!(last <= step && last + 20.0 > step, "last row {last}, stopped at {step}");
    // `check` has known it.
    let risky = warnings(&scene(&SOFT));
    assert!(risky.iter().any(|warning| warning.reason.contains("too soft for it")), "{risky:?}");
    // The remedy, followed.
    let harder = format!("contact.stiffness={}", number_after(&said, "contact.stiffness = "));
    budget.spend(400 * 1000);
    let output = run(&["--set", &harder], &folder.path("again"));
    assert!(output.status.success(), "{harder}: {}", stderr(&output));
}

#[test]
fn a_grain_that_an_overlap_at_the_start_throws_is_told_from_one_that_the_flow_drives() {
    let mut budget = Budget::oracle(20_000);
    let grains = ["[5e-4, 5e-4, 5e-4]", "[1.095e-3, 5e-4, 5e-4]"]
        .map(|centre| free_sphere(centre, "6e-4", "2650.0"))
        .concat();
    let rest = "[contact]\nstiffness = 500.0\n[stop]\nsteps = 10\n";
    let text = water([16, 10, 10], 1e-4, &format!("{grains}{rest}"));
    budget.spend(10 * 1600);
    let folder = Folder::new("thrown");
    let path = folder.write("scene.toml", text);
    let paths = [path.to_str().unwrap(), "--out"];
    let output = psmrt(&[&["run"], &paths[..], &[folder.path("out").to_str().unwrap()]].concat());
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    // They overlap by 5e-6 m.
    for part in ["grain 0", "5.00e-6 m at the start", "move the grains apart"] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// Keys out of all proportion: what the section says, the key to blame, and what is asked.
const ABSURD: [(&str, &str, &str); 9] = [
    ("[contact]\nstiffness = 1e300", "contact.stiffness", "N/m or less"),
    ("[contact]\nstiffness = 1e-300", "contact.stiffness", "N/m or more"),
    ("[contact]\nstiffness = 1.0\ndamping = 1.0", "contact.damping", "N s/m or less"),
    ("[contact]\nstiffness = 1.0\ndamping = 1e300", "contact.damping", "N s/m or less"),
    ("[contact]\nduration = 1e300", "contact.duration", "s or less"),
    ("[contact]\nduration = 1e-300", "contact.duration", "s or more"),
    ("[lubrication]\nsmallest_gap = 1e-300", "lubrication.smallest_gap", "m or more"),
    ("[lubrication]\ncutoff_gap = 1e300", "lubrication.cutoff_gap", "m or less"),
    (
        "[contact]\nstiffness = 1.0\ntangential_ratio = 9.0\ndamping = 3e-3",
        "contact.damping",
        "N s/m or less",
    ),
];

#[test]
fn absurd_contacts_blame_their_own_key_with_a_range_that_is_accepted() {
    for (section, key, unit) in ABSURD {
        let text = |section: &str| BALL.replace("[[records]]", &format!("{section}\n[[records]]"));
        let said = read(&text(section)).expect_err(section);
        assert!(said.contains(&format!("error: {key}")), "{section}: {said}");
        // "it must be 4.40e-3 N s/m or less": that value is accepted.
        assert!(said.contains(unit), "{section}: {said}");
        let limit = number_after(&said, "it must be ");
        let name = key.split('.').next_back().unwrap();
        let changed = section.lines().map(|line| match line.starts_with(&format!("{name} =")) {
            true => format!("{name} = {limit:e}\n"),
            false => format!("{line}\n"),
        });
        let changed: String = changed.collect();
        assert!(read(&text(&changed)).is_ok(), "{changed}: {:?}", read(&text(&changed)).err());
    }
    for ratio in ["1e300", "1e-300", "-1.0", "nan"] {
        let section = format!("[contact]\ntangential_ratio = {ratio}\n[[records]]");
        let said = read(&BALL.replace("[[records]]", &section)).expect_err(ratio);
        assert!(
            said.contains("contact.tangential_ratio") && said.contains("0.001 to 10"),
            "{said}"
        );
    }
}

#[test]
fn grains_that_need_too_many_substeps_are_refused_with_two_ways_out_that_work() {
    let text = BALL.replace("dt = 0.0002", "dt = 0.001");
    let said = read(&text).unwrap_err();
    assert!(said.contains("2500 is the limit") && said.contains("error: contact"), "{said}");
    let si_dt = number_after(&said, "shorten the time step to ");
    let shorter = BALL.replace("dt = 0.0002", &format!("dt = {si_dt:e}"));
    assert!(read(&shorter).is_ok(), "{:?}", read(&shorter).err());
    let stiffness = number_after(&said, "stiffness = ");
    let softer =
        text.replace("[[records]]", &format!("[contact]\nstiffness = {stiffness:e}\n[[records]]"));
    assert!(read(&softer).is_ok(), "{:?}", read(&softer).err());
}
