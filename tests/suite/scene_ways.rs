//! Prescribed spheres go straight on: what they run into is known beforehand and stops the run there.

use std::path::Path;
use std::sync::LazyLock;

use crate::cli::{Folder, psmrt, stderr, stdout};
use crate::common::Budget;
use crate::common::random::Random;
use crate::scenes::{scene, water};
use psmrt::courses::{Lookout, Meeting, Obstacle, leavings};
use psmrt::engine::{EngineName, open};

/// A towed sphere of 8 cells, 2 cells before the end of a box of 16.
static TOWED: LazyLock<String> = LazyLock::new(|| {
    let rest = r#"
[faces]
x_low.kind = "wall"
x_high.kind = "wall"
[[grains]]
kind = "sphere"
centre = [1e-4, 6e-5, 6e-5]
diameter = 8e-5
motion = "prescribed"
velocity = [0.03, 0.0, 0.0]
[[records]]
name = "g"
kind = "loads"
every_steps = 20
[stop]
steps = 90
"#;
    water([16, 12, 12], 1e-5, rest)
});

fn meeting(text: &str) -> Option<Meeting> {
    let scene = scene(text);
    Lookout::from_start(&scene).meeting_until(scene.stop.steps, u64::MAX)
}

/// A time step is 0.1 dx²/ν = 1e-5 s, in which the sphere moves by 0.03 cells: the gap of 2 cells and the 1 % of
/// its 8 cells that may overlap take 2.08/0.03 = 69.3 steps.
const STEP: u64 = 70;

#[test]
fn a_towed_sphere_stops_the_run_at_the_step_at_which_it_is_in_the_wall() {
    let mut budget = Budget::oracle(330_000);
    let folder = Folder::new("towed");
    let path = folder.write("scene.toml", &*TOWED);
    let out = folder.path("out");
    let run = |more: &[&str], out: &Path| {
        let paths = [path.to_str().unwrap(), "--out", out.to_str().unwrap()];
        psmrt(&[&["run"], &paths[..], more].concat())
    };
    budget.spend(STEP * 2304);
    let output = run(&[], &out);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in ["grain 0", "x_high (wall)", "after step 70", "stop.steps = 69"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let table = std::fs::read_to_string(out.join("g.csv")).unwrap();
    assert!(table.lines().last().unwrap().contains(",60,0,"), "{table}");
    // The same is told beforehand, and the remedy works.
    let checked = psmrt(&["check", path.to_str().unwrap()]);
    let told = stdout(&checked);
    assert!(told.contains("after step 70") && told.contains("the run stops there"), "{told}");
    budget.spend(69 * 2304);
    let output = run(&["--set", "stop.steps=69"], &folder.path("again"));
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn walls_mirrors_and_inlets_end_the_way_of_a_sphere_and_periodic_and_open_faces_do_not() {
    let high = "x_high.kind = \"wall\"";
    let inlet = "x_high = { kind = \"velocity_inlet\", velocity = [-1e-3, 0.0, 0.0] }\n";
    let open = "x_low = { kind = \"pressure\", pressure = 0.0 }";
    for (text, face) in [
        (TOWED.to_owned(), "x_high"),
        (TOWED.replace(high, "x_high.kind = \"free_slip\""), "x_high"),
        (TOWED.replace(high, inlet).replace("x_low.kind = \"wall\"", open), "x_high"),
        // As far from the lower wall: the mirror image of the first.
        (TOWED.replace("[1e-4,", "[6e-5,").replace("[0.03,", "[-0.03,"), "x_low"),
    ] {
        let Some(Meeting { step, grain: 0, obstacle: Obstacle::Face { name, .. } }) =
            meeting(&text)
        else {
            panic!("{text}")
        };
        assert_eq!((name, step), (face, STEP));
    }
    let periodic = TOWED.replace("x_low.kind = \"wall\"", "").replace(high, "");
    assert_eq!(meeting(&periodic), None, "it comes in again on the other side");
    assert_eq!(meeting(&TOWED.replace("steps = 90", "steps = 69")), None, "the run ends before");
    let outlet = TOWED.replace(high, "x_high = { kind = \"pressure\", pressure = 0.0 }");
    assert_eq!(meeting(&outlet), None);
    assert_eq!(leavings(&scene(&outlet)), [(0, "x_high", STEP)]);
}

#[test]
fn the_first_meeting_of_two_spheres_is_what_stepping_through_all_images_finds() {
    let mut random = Random(5);
    let (cells, steps, mut found_some) = ([30.0, 24.0, 20.0], 3000_u64, 0);
    for _ in 0..20 {
        // Places on a grid of 10 cells, with room between the spheres.
        let mut spheres = Vec::new();
        let mut text = TOWED.replace("cells = [16, 12, 12]", "cells = [30, 24, 20]");
        text = text.replace("x_low.kind = \"wall\"", "").replace("x_high.kind = \"wall\"", "");
        let (head, tail) = (text.find("[[grains]]").unwrap(), text.find("[[records]]").unwrap());
        let mut sections = String::new();
        for place in 0..5 {
            let (x, y) = (f64::from(place % 3) * 10.0 + 5.0, f64::from(place / 3) * 10.0 + 5.0);
            let (centre, d) = ([x, y, 10.0 + random.between(-2.0, 2.0)], random.between(2.5, 6.0));
            let speed = if place == 0 { 0.0 } else { 0.05 };
            let v = [(); 3].map(|()| speed * random.between(-1.0, 1.0));
            sections += &format!(
                "[[grains]]\nkind = \"sphere\"\ncentre = {:?}\ndiameter = {:e}\n{}\n",
                centre.map(|x: f64| x * 1e-5),
                d * 1e-5,
                match place {
                    0 => String::new(),
                    // One cell per step is 1 m/s.
                    _ => format!("motion = \"prescribed\"\nvelocity = {v:?}"),
                }
            );
            spheres.push((centre, d, v));
        }
        let text = format!("{}{sections}{}", &text[..head], &text[tail..]);
        let text = text.replace("steps = 90", "steps = 3000");
        let by_stepping = (1..=steps).find(|&n| {
            (0..5).any(|i| (0..i).any(|j| overlap(&spheres[i], &spheres[j], n as f64, cells) > 0.0))
        });
        found_some += usize::from(by_stepping.is_some());
        assert_eq!(meeting(&text).map(|meeting| meeting.step), by_stepping, "{text}");
    }
    assert!(found_some > 10, "most of them meet: {found_some}");
}

/// Overlap beyond 1 % of the smaller diameter after `n` steps, to the nearest image, cells.
fn overlap(
    one: &([f64; 3], f64, [f64; 3]),
    two: &([f64; 3], f64, [f64; 3]),
    n: f64,
    cells: [f64; 3],
) -> f64 {
    let along = |axis: usize| {
        let apart = (one.0[axis] + n * one.2[axis]) - (two.0[axis] + n * two.2[axis]);
        apart - cells[axis] * (apart / cells[axis]).round()
    };
    let distance = (0..3).map(|axis| along(axis).powi(2)).sum::<f64>().sqrt();
    0.5 * (one.1 + two.1) - 0.01 * one.1.min(two.1) - distance
}

#[test]
fn engine_moves_a_prescribed_sphere_by_its_velocity_each_step() {
    // dx = 1e-4 m and tau = 0.8 (nu = 0.1) with 1e-6 m2/s make steps of 1e-3 s: 0.01 m/s are 0.1 cells per step.
    let grain = r#"
[[grains]]
kind = "sphere"
centre = [5e-4, 6e-4, 6e-4]
diameter = 4e-4
motion = "prescribed"
velocity = [0.01, 0.0, -0.005]
[stop]
steps = 10
"#;
    let scene = scene(&water([16, 12, 12], 1e-4, grain));
    let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
    engine.step(10).unwrap();
    let centre = engine.solids()[0].centre;
    let expected = psmrt_reference::lattice::Vec3::new(6.0, 6.0, 5.5);
    assert!(
        (centre - expected).norm() < 1e-12,
        "after 10 steps of (0.1, 0, -0.05) from (5, 6, 6) it is at {centre:?}"
    );
}
