//! Bodies of any shape in scenes: flow about them against that about spheres, motion, bad input.

use std::path::Path;

use psmrt::engine::{EngineName, EngineStop, open};
use psmrt::scene::Scene;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use crate::cli::{Folder, psmrt_in, stderr};
use crate::common::Budget;
use crate::moving_bodies;
use crate::scenes::{saved, scene, water};
use crate::surfaces::{ascii, ball, binary};

/// A scene of a text whose files are in a folder.
fn load(folder: &Folder, text: &str) -> Result<Scene, String> {
    let place = folder.path("");
    Scene::from_bytes("scene.toml", text.as_bytes().to_vec(), Path::new(&place), &[])
        .map_err(|error| error.to_string())
}

/// A sphere of 10 cells in a periodic box of 20, as a sphere or as a ball of triangles in millimetres, with `motion`.
fn sphere(kind: &str, motion: &str, rest: &str) -> String {
    let body = match kind {
        "sphere" => "kind = \"sphere\"\ndiameter = 1e-3\n",
        _ => "kind = \"body\"\nbody = { shape = \"stl\", file = \"ball.stl\", scale = 1e-3 }\n",
    };
    let rest = format!(
        "[solid]\noperator = \"bounce_back\"\n[[grains]]\n{body}centre = [1e-3, 1.02e-3, 0.97e-3]\n{motion}{rest}"
    );
    water([20; 3], 1e-4, &rest)
}

/// The ball has the volume of a sphere of diameter 1, and is not about the origin of its file.
fn folder_with_ball(name: &str) -> Folder {
    let folder = Folder::new(name);
    let flat = ball(0.5, 4);
    let exact = std::f64::consts::PI / 6.0;
    let factor = (exact / flat.volume()).cbrt();
    folder.write(
        "ball.stl",
        binary(&flat.mapped(|v| v * factor + nalgebra::Vector3::new(3.0, -2.0, 1.0))),
    );
    folder
}

#[test]
fn an_stl_sphere_holds_back_the_flow_as_the_sphere_does() {
    let folder = folder_with_ball("stl_sphere");
    let force = "[body_force]\nacceleration = [1e-2, 0.0, 0.0]\n[stop]\nsteps = 400\n";
    let flux = |kind| {
        let mut engine =
            open(EngineName::Cpu, &load(&folder, &sphere(kind, "", force)).unwrap(), None, false)
                .unwrap();
        engine.step(400).unwrap();
        (engine.box_means().mass_flux.x, engine.loads()[0])
    };
    let ((exact, of_exact), (found, of_found)) = (flux("sphere"), flux("stl"));
    // 5120 triangles lie within 0.1 % of the radius of the sphere, and have its volume.
    assert!(
        (found / exact - 1.0).abs() < 2e-3,
        "flow past the STL sphere {found:e}, past the sphere {exact:e}"
    );
    let ratio = of_found.force.x / of_exact.force.x;
    assert!((ratio - 1.0).abs() < 1e-3, "force on the STL sphere over that on the sphere: {ratio}");
}

#[test]
fn a_turning_stl_sphere_has_the_torque_of_the_sphere() {
    let folder = folder_with_ball("turning_stl");
    let motion = "motion = \"prescribed\"\nspin = [0.0, 0.3, 0.4]\n";
    let torque = |kind| {
        let scene = load(&folder, &sphere(kind, motion, "[stop]\nsteps = 300\n")).unwrap();
        let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
        engine.step(300).unwrap();
        engine.loads()[0].torque
    };
    let (exact, found) = (torque("sphere"), torque("stl"));
    // It turns its triangles through the cells: the same surface to 0.1 % of its radius, of which the torque takes the cube.
    let off = (found - exact).norm() / exact.norm();
    assert!(off < 5e-3, "torque {found:?}, that of the sphere {exact:?}");
    assert!(exact.y < 0.0 && exact.z < 0.0, "the fluid holds it back: {exact:?}");
}

#[test]
fn bodies_move_and_turn_on_the_cpu_as_on_the_oracle() {
    // Double precision, and sums in another order.
    let mut budget = Budget::oracle(400_000);
    moving_bodies::bodies_move_and_turn_as_on_the_oracle(EngineName::Cpu, None, &mut budget, 1e-13);
}

#[test]
fn a_turning_body_fills_the_cells_that_it_fills_when_put_down_turned() {
    // Half a turn a second about an axis askew, beside a swinging one about the same: after 0.1 s of 100 steps both are known.
    let (axis, half_turn) = (Vec3::new(1.0, 2.0, 2.0) / 3.0, std::f64::consts::PI);
    let spin =
        |rate: f64| format!("[{:e}, {:e}, {:e}]", rate * axis.x, rate * axis.y, rate * axis.z);
    let steady = format!("spin = {}", spin(half_turn));
    let swinging = format!("spin = {{ amplitude = {}, period = 0.25 }}", spin(half_turn));
    // ∫ A sin(2π t/P) dt = A P/(2π) (1 - cos(2π t/P))
    let swung = half_turn * 0.25 / (2.0 * half_turn) * (1.0 - (2.0 * half_turn * 0.4).cos());
    for (name, motion, degrees) in
        [("steady", steady, 18.0), ("swinging", swinging, swung.to_degrees())]
    {
        let text = |motion: &str, turn: &str| {
            let rest = format!(
                "[[grains]]\nkind = \"body\"\ncentre = [5.2e-4, 4.9e-4, 5.1e-4]\n{motion}\n\
                 body = {{ shape = \"box\", size = [3e-4, 2e-4, 5e-4]{turn} }}\n[stop]\nsteps = 100\n"
            );
            water([10; 3], 1e-4, &rest)
        };
        let moving = scene(&text(&format!("motion = \"prescribed\"\n{motion}"), ""));
        let mut engine = open(EngineName::Cpu, &moving, None, false).unwrap();
        engine.step(100).unwrap();
        let put_down =
            scene(&text("", &format!(", turn = {{ axis = [1, 2, 2], degrees = {degrees:e} }}")));
        let cells = |solid: &Solid| {
            let Shape::Cells { fractions, .. } = &solid.shape else { panic!("{name}: {solid:?}") };
            let mut cells = vec![0.0; 1000];
            fractions.iter().for_each(|&(cell, share)| cells[cell] = share);
            cells
        };
        let expected = cells(&put_down.setup.solid_phase.as_ref().unwrap().solids[0]);
        let off = cells(&engine.solids()[0])
            .iter()
            .zip(&expected)
            .map(|(a, b)| f64::abs(a - b))
            .fold(0.0, f64::max);
        // The trapezium rule over 100 steps is off by (2π h/P)²/12 of the angle, 2e-5, of which the farthest corner, 3 cells away, makes
        // a share of a cell.
        assert!(off < 3e-4, "{name}: after {degrees} degrees a share differs by {off:e}");
    }
}

#[test]
fn a_large_body_does_not_swallow_a_small_one() {
    // 1 % of the small one, whichever of the two moves or stands first in the list.
    let large = "body = { shape = \"box\", size = [10e-4, 10e-4, 10e-4] }\n";
    let small = "body = { shape = \"box\", size = [2e-4, 2e-4, 2e-4] }\n";
    let [at_large, at_small] = ["[6e-4, 8e-4, 8e-4]", "[14e-4, 8e-4, 8e-4]"];
    let body = |centre: &str, motion: &str, body: &str| {
        format!("[[grains]]\nkind = \"body\"\ncentre = {centre}\n{motion}{body}")
    };
    let [on, back] = ["1e-2", "-1e-2"]
        .map(|speed| format!("motion = \"prescribed\"\nvelocity = [{speed}, 0.0, 0.0]\n"));
    for (first, second) in [
        (body(at_large, &on, large), body(at_small, "", small)),
        (body(at_small, "", small), body(at_large, &on, large)),
        (body(at_large, "", large), body(at_small, &back, small)),
        (body(at_small, &back, small), body(at_large, "", large)),
        (
            body(at_small, &back, small),
            body(at_large, "motion = \"prescribed\"\nspin = [0, 0, 0]\n", large),
        ),
    ] {
        let scene =
            scene(&water([18, 16, 16], 1e-4, &format!("{first}{second}[stop]\nsteps = 60\n")));
        let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
        let stop = engine.step(60).unwrap_err().to_string();
        // 2 cells at 0.1 a step, and 1 % of 2 more.
        assert!(stop.contains("run into solid"), "{stop}");
        assert!((20..=22).contains(&engine.steps()), "step {}: {stop}", engine.steps());
    }
}

#[test]
fn a_body_goes_on_from_where_it_is_when_it_is_stopped_or_set_in_motion() {
    let text = |velocity: &str, spin: &str| {
        let rest = format!(
            "[[grains]]\nkind = \"body\"\ncentre = [5e-4, 5e-4, 5e-4]\nmotion = \"prescribed\"\nvelocity = {velocity}\nspin = {spin}\n\
             body = {{ shape = \"box\", size = [3e-4, 2e-4, 4e-4] }}\n[stop]\nsteps = 20\n"
        );
        scene(&water([12, 10, 10], 1e-4, &rest))
    };
    let (moving, still) = (text("[5e-3, 0, 0]", "[0, 0, 5]"), text("[0, 0, 0]", "[0, 0, 0]"));
    let opened = |scene| open(EngineName::Cpu, scene, None, false).unwrap();
    let mut first = opened(&moving);
    first.step(20).unwrap();
    let mut stopped = opened(&still);
    stopped.load_with_changes(&mut &saved(&first)[..]).unwrap();
    stopped.step(20).unwrap();
    let (then, now) = (&first.solids()[0], &stopped.solids()[0]);
    assert_eq!(now.centre, then.centre, "a body that was stopped stays where it was");
    let shares = |solid: &Solid| match &solid.shape {
        Shape::Cells { fractions, .. } => fractions.clone(),
        Shape::Sphere { .. } => panic!("{solid:?}"),
    };
    assert_eq!(shares(now), shares(then), "and as it was turned");
    let mut again = opened(&moving);
    again.load_with_changes(&mut &saved(&stopped)[..]).unwrap();
    again.step(20).unwrap();
    let mut whole = opened(&moving);
    whole.step(40).unwrap();
    let off = (again.solids()[0].centre - whole.solids()[0].centre).norm();
    assert!(off < 1e-12, "set in motion again it goes on by the same way: {off:e} cells off");
    assert_eq!(shares(&again.solids()[0]).len(), shares(&whole.solids()[0]).len());
}

#[test]
fn a_body_that_leaves_the_domain_or_runs_into_another_stops_the_run() {
    let towed = |velocity: &str, other: &str| {
        let rest = format!(
            "[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n[[grains]]\nkind = \"body\"\ncentre = [5e-4, 6e-4, 5e-4]\n\
             motion = \"prescribed\"\nvelocity = {velocity}\nbody = {{ shape = \"box\", size = [4e-4, 4e-4, 4e-4] }}\n{other}\
             [stop]\nsteps = 1000\n"
        );
        let scene = scene(&water([20, 12, 10], 1e-4, &rest));
        let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
        let stop = engine.step(1000).unwrap_err();
        assert!(matches!(stop, EngineStop::Body(_)), "{stop}");
        (engine.steps(), stop.to_string())
    };
    // A step is 1 ms and 5e-3 m/s are 0.05 cells a step: 3 cells to the wall, and 1 % of 4 cells more: 60.8 steps.
    let (step, said) = towed("[0.0, 0.0, 5e-3]", "");
    assert_eq!(step, 61, "{said}");
    assert!(said.contains("grains[0]") && said.contains("left the domain"), "{said}");
    let other = "[[grains]]\nkind = \"sphere\"\ncentre = [14e-4, 6e-4, 5e-4]\ndiameter = 4e-4\n";
    let (step, said) = towed("[5e-3, 0.0, 0.0]", other);
    // 5 cells to the sphere, whose cap of 1 % of the box's 64 cells is 0.37 cells high; cells are shared a little before.
    assert!((95..=108).contains(&step), "step {step}: {said}");
    assert!(said.contains("run into solid 0"), "{said}");
}

#[test]
fn a_run_keeps_the_stl_file_and_goes_on_with_it() {
    let folder = folder_with_ball("kept_stl");
    let motion = "motion = \"prescribed\"\nspin = [0.0, 0.0, 1.0]\n";
    let rest =
        "[[records]]\nname = \"loads\"\nkind = \"loads\"\nevery_steps = 10\n[stop]\nsteps = 20\n";
    folder.write("scene.toml", sphere("stl", motion, rest));
    let run = |arguments: &[&str]| {
        let done = psmrt_in(&folder.path(""), arguments);
        assert!(done.status.success(), "{arguments:?}: {}", stderr(&done));
    };
    run(&["run", "scene.toml", "--engine", "cpu", "--out", "whole"]);
    run(&["run", "scene.toml", "--engine", "cpu", "--out", "half", "--set", "stop.steps=10"]);
    std::fs::remove_file(folder.path("ball.stl")).unwrap();
    run(&["resume", "half", "--set", "stop.steps=20", "--out", "on"]);
    let last = |name: &str| {
        let table = std::fs::read_to_string(folder.path(name).join("loads.csv")).unwrap();
        table.lines().last().unwrap_or_default().to_owned()
    };
    assert_eq!(
        last("on"),
        last("whole"),
        "loads of the run that was resumed, and of the one in one go"
    );
    assert!(last("on").contains(",20,"), "{}", last("on"));
}

#[test]
fn bad_bodies_are_told_with_the_key_and_a_way_out() {
    let folder = folder_with_ball("bad_bodies");
    folder.write("text.stl", "solid nothing");
    let mut open_ball = ascii(&ball(0.5, 1));
    let facet = open_ball.find("facet").unwrap();
    open_ball.replace_range(facet..open_ball.find("endfacet\n").unwrap() + 9, "");
    folder.write("open.stl", open_ball);
    let stl = "shape = \"stl\", file = \"ball.stl\", scale = 1e-3";
    let cube = "shape = \"box\", size = [3e-4, 3e-4, 3e-4]";
    let rod = "shape = \"cylinder\", diameter = 4e-4, length = 5e-4, axis = [0, 0, 1]";
    let whole = |centre: &str, more: &str, body: &str| {
        let rest = format!(
            "[[grains]]\nkind = \"body\"\n{centre}{more}body = {{ {body} }}\n[stop]\nsteps = 1\n"
        );
        water([20; 3], 1e-4, &rest)
    };
    let middle = "centre = [1e-3, 1e-3, 1e-3]\n";
    let cases = [
        (whole(middle, "", "shape = \"stl\", scale = 1e-3"), "body.file", "needs it"),
        (
            whole(middle, "", "shape = \"stl\", file = \"ball.stl\""),
            "body.scale",
            "1e-3` for millimetres",
        ),
        (
            whole(middle, "", "shape = \"stl\", file = \"none.stl\", scale = 1.0"),
            "body.file",
            "relative to the scene",
        ),
        (
            whole(middle, "", "shape = \"stl\", file = \"text.stl\", scale = 1.0"),
            "body.file",
            "no STL file",
        ),
        (
            whole(middle, "", "shape = \"stl\", file = \"open.stl\", scale = 1e-3"),
            "body.file",
            "hole",
        ),
        (
            whole(middle, "", "shape = \"stl\", file = \"ball.stl\", scale = -1.0"),
            "body.scale",
            "above 0",
        ),
        (whole(middle, "", &format!("{stl}, origin = [nan, 0, 0]")), "body.origin", "finite"),
        (whole(middle, "", &format!("{stl}, size = [1, 1, 1]")), "body.size", "shape `box` only"),
        (whole(middle, "", "shape = \"box\""), "body.size", "needs it"),
        (whole(middle, "", "shape = \"box\", size = [1e-4, 0.0, 1e-4]"), "body.size", "above 0"),
        (whole(middle, "", "shape = \"ball\""), "body.shape", "known"),
        (
            whole(middle, "", &format!("{cube}, turn = {{ axis = [0, 0, 0], degrees = 3 }}")),
            "body.turn.axis",
            "cannot be 0",
        ),
        (
            whole(middle, "", &format!("{cube}, turn = {{ axis = [0, 0, 1], degrees = inf }}")),
            "body.turn.degrees",
            "finite",
        ),
        (whole(middle, "", "shape = \"cylinder\", axis = [0, 0, 1]"), "body.diameter", "needs it"),
        (whole(middle, "", "shape = \"cylinder\", diameter = 4e-4"), "body.axis", "direction"),
        (whole(middle, "", &format!("{rod}, wall = 1e-4")), "body.wall", "shape `pipe` only"),
        (whole(middle, "", "shape = \"half_space\""), "body.normal", "direction"),
        (whole(middle, "", "shape = \"half_space\", normal = [0, 0, 1]"), "body", "periodic face"),
        (
            whole(middle, "", "shape = \"cylinder\", diameter = 4e-4, axis = [0, 1, 1]"),
            "body",
            "periodic face",
        ),
        (whole("centre = [1e-4, 1e-3, 1e-3]\n", "", cube), "body", "periodic face along x"),
        (whole("", "", cube), "centre", "needs it"),
        (whole("centre = [1.0, 1e-3, 1e-3]\n", "", cube), "body", "periodic face"),
        (whole(middle, "motion = \"free\"\n", cube), "motion", "only spheres"),
        (whole(middle, "motion = \"prescribed\"\n", cube), "motion", "`velocity`"),
        (
            whole(middle, "motion = \"prescribed\"\nspin = [0, 0, 1e4]\n", cube),
            "spin",
            "surface moves",
        ),
        (whole(middle, "diameter = 1e-4\n", cube), "diameter", "stands in `body`"),
        (whole(middle, "file = \"ball.stl\"\n", cube), "file", "body.file"),
        (whole(middle, "density = 2650.0\n", cube), "density", "free"),
        (
            whole(middle, "", cube)
                + "[[grains]]\nkind = \"sphere\"\ncentre = [1e-3, 1e-3, 1e-3]\ndiameter = 4e-4\n",
            "body",
            "in common",
        ),
        (
            whole(middle, "", cube)
                + "[[grains]]\nkind = \"body\"\ncentre = [1.1e-3, 1e-3, 1e-3]\nbody = { shape = \"box\", size = [3e-4, 3e-4, 3e-4] }\n",
            "body",
            "in common",
        ),
    ];
    for (text, key, told) in cases {
        let said = load(&folder, &text).expect_err(&text);
        assert!(
            said.contains(&format!("].{key}")) && said.contains(told) && said.contains("help: "),
            "{text}: no `{key}`, {told:?} or remedy in\n{said}"
        );
    }
    let walls = crate::scenes::BOX;
    let outside = whole("centre = [1.0, 1e-3, 1e-3]\n", "", cube) + walls;
    assert!(
        load(&folder, &outside).unwrap_err().contains("nothing of the body lies in the domain")
    );
    let full = whole(middle, "", "shape = \"box\", size = [1.0, 1.0, 1.0]") + walls;
    assert!(load(&folder, &full).unwrap_err().contains("no fluid is left"));
    let endless = whole(
        middle,
        "motion = \"prescribed\"\nspin = [0, 0, 1]\n",
        "shape = \"cylinder\", diameter = 4e-4, axis = [0, 0, 1]",
    );
    assert!(load(&folder, &endless).unwrap_err().contains("without end cannot move"));
    let half_out =
        whole("centre = [1e-4, 1e-3, 1e-3]\n", "motion = \"prescribed\"\nspin = [0, 0, 1]\n", cube)
            + walls;
    assert!(load(&folder, &half_out).unwrap_err().contains("outside of the domain"));
}

#[test]
fn a_channel_between_half_spaces_is_a_channel_between_walls() {
    // 8 cells of fluid between two half-spaces, against walls in the same places: half a cell of both beyond.
    let drive = "[solid]\noperator = \"bounce_back\"\n[body_force]\nacceleration = [1e-2, 0.0, 0.0]\n[stop]\nsteps = 1500\n";
    let bodies = "[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n\
                  [[grains]]\nkind = \"body\"\ncentre = [0.0, 0.0, 4e-4]\nbody = { shape = \"half_space\", normal = [0, 0, 1] }\n\
                  [[grains]]\nkind = \"body\"\ncentre = [0.0, 0.0, 12e-4]\nbody = { shape = \"half_space\", normal = [0, 0, -1] }\n";
    let walls = "[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n";
    let flux = |cells: usize, faces: &str| {
        let scene = scene(&water(
            [1, 1, cells],
            1e-4,
            &format!(
                "{faces}{}",
                if faces == walls {
                    drive.replace("[solid]\noperator = \"bounce_back\"\n", "")
                } else {
                    drive.to_owned()
                }
            ),
        ));
        let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
        engine.step(1500).unwrap();
        engine.box_means().mass_flux.x * cells as f64
    };
    let ratio = flux(16, bodies) / flux(8, walls);
    // The paper's operator lets the surface slip by a few percent of a cell at tau = 0.8, of the 8 on either side (golden/duct).
    assert!(
        (ratio - 1.0).abs() < 0.06,
        "flow between half-spaces over that between walls: {ratio}"
    );
}
