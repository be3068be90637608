//! What records say: where a value is taken, what the first row holds, how often rows come, how much is written.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use crate::cli::{Folder, psmrt, stderr, stdout};
use crate::common::Budget;
use crate::scenes::{changed, water};
use psmrt::advice::estimate::{disk, warnings};
use psmrt::engine::{Coupled, EngineName, open, starting_from};
use psmrt::output::records::{box_row, profile_rows};
use psmrt::output::slice;
use psmrt::scene::format_run::Quantity;
use psmrt::scene::{Scene, What};
use psmrt_reference::lattice::Vec3;

static COUETTE: LazyLock<String> = LazyLock::new(|| {
    let rest = r#"
[collision]
model = "srt"
[faces]
y_low.kind = "wall"
y_high = { kind = "wall", velocity = [0.01, 0.0, 0.0] }
[[records]]
name = "line"
kind = "profile"
axis = "x"
[[records]]
name = "cut"
kind = "slice"
axis = "y"
quantity = "velocity_x"
range = [0.0, 0.01]
[stop]
steps = 2000
"#;
    water([4, 8, 2], 1e-4, rest)
});

#[test]
fn couette_flow_half_way_between_the_plates_has_half_the_velocity_on_an_even_grid() {
    let mut budget = Budget::oracle(200_000);
    let folder = Folder::new("couette_middle");
    let file = folder.write("scene.toml", &*COUETTE);
    let out = folder.path("out");
    budget.spend(2000 * 64);
    let output = psmrt(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    let mut table = csv::Reader::from_path(out.join("line.csv")).unwrap();
    let names = table.headers().unwrap().clone();
    let column = |name: &str| names.iter().position(|other| other == name).unwrap();
    let number = |row: &csv::StringRecord, name: &str| row[column(name)].parse::<f64>().unwrap();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 4);
    for row in &rows {
        // After 30 times H²/(π² ν) of 65 steps; what is left, e⁻³⁰, is rounding.
        let found = number(row, "velocity_x (m/s)");
        assert!((found / 0.005 - 1.0).abs() < 1e-10, "{found} m/s in the middle, 0.005 is right");
        // And the table says where: in the middle of 0.8 mm by 0.2 mm.
        let (y, z) = (number(row, "y (m)"), number(row, "z (m)"));
        assert!((y - 4e-4).abs() < 1e-12 && (z - 1e-4).abs() < 1e-12, "{y}, {z}");
        assert_eq!(number(row, "x (m)"), number(row, "position (m)"));
    }
    let plot = fs::read_to_string(out.join("line.svg")).unwrap();
    assert!(plot.contains("y = 0.4000 mm") && plot.contains("z = 0.1000 mm"), "{plot}");
    let picture = fs::read_to_string(out.join("cut/cut_000000002000.svg")).unwrap();
    assert!(picture.contains("plane y = 0.4000 mm") && picture.contains("fixed range"));
}

/// A fluid whose velocity is linear in the place, `u_x = 1e-3 (1 + x + 2 y + 3 z)` in cells.
fn linear(faces: &str) -> (Scene, Coupled) {
    let scene = changed(&COUETTE.replace("4, 8, 2", "4, 5, 6"), &[&format!("faces={faces}")]);
    let state =
        |at: Vec3| (1.0, Vec3::new(1e-3 * (1.0 + at.x + 2.0 * at.y + 3.0 * at.z), 0.0, 0.0));
    let engine = starting_from(EngineName::Reference, &scene.setup, None, None, state).unwrap();
    (scene, engine)
}

const WALLS: &str = "{ x_low.kind = \"wall\", x_high.kind = \"wall\", y_low.kind = \"wall\", \
                     y_high.kind = \"wall\", z_low.kind = \"wall\", z_high.kind = \"wall\" }";

#[test]
fn a_linear_field_is_exact_on_every_line_and_plane_up_to_the_walls() {
    let (scene, engine) = linear(WALLS);
    let unit = scene.units.si_velocity();
    // Centres, faces between cells, places off both, and the walls themselves.
    for (y, z) in [(2.5, 0.5), (2.0, 3.0), (1.3, 4.9), (0.2, 5.8), (0.0, 6.0), (5.0, 0.0)] {
        for (i, row) in profile_rows(&scene, &engine, 0, [9.0, y, z]).iter().enumerate() {
            let exact = 1e-3 * (1.0 + (i as f64 + 0.5) + 2.0 * y + 3.0 * z);
            let found = row[2] / unit;
            // Rounding of populations near 0.3, some of them added up.
            assert!((found - exact).abs() < 1e-14, "cell {i} at y {y}, z {z}: {found}, {exact}");
        }
        let map = slice::map(&scene, &engine, (1, y), Quantity::VelocityX, None);
        let corner = map.values[0].unwrap() / 1e3 / unit;
        let exact = 1e-3 * (1.0 + 0.5 + 2.0 * y + 3.0 * 0.5);
        assert!((corner - exact).abs() < 1e-14, "plane y = {y}: {corner}, {exact} is right");
    }
}

#[test]
fn a_line_in_a_periodic_face_has_the_mean_of_both_sides() {
    let (scene, engine) = linear("{}");
    let unit = scene.units.si_velocity();
    // Along y the velocity is 1e-3 (1 + x + z) + 1e-3 and 9e-3 in the first and last of 5 cells: 5e-3 between.
    for y in [0.0, 5.0] {
        let found = profile_rows(&scene, &engine, 0, [0.0, y, 2.5])[0][2] / unit;
        let exact = 1e-3 * (1.0 + 0.5 + 7.5) + 5e-3;
        assert!((found - exact).abs() < 1e-14, "y = {y}: {found}, {exact} is right");
    }
}

#[test]
fn colours_of_a_fixed_range_do_not_depend_on_the_values() {
    let (scene, engine) = linear(WALLS);
    let [What::Slice { si_range, .. }] = [&scene.records[1].what] else { panic!("no slice") };
    let scale =
        |at, range| slice::map(&scene, &engine, (1, at), Quantity::VelocityX, range).value.range;
    assert_eq!(scale(1.5, *si_range), Some((0.0, 10.0)), "mm/s");
    assert_eq!(scale(4.5, *si_range), Some((0.0, 10.0)), "mm/s");
    assert_eq!(scale(1.5, None), None, "each picture has its own");
}

#[test]
fn a_fluid_at_rest_has_no_velocity_in_the_first_row_whatever_drives_it() {
    let rest = r#"
[body_force]
acceleration = [1000.0, 0.0, 0.0]
# With an operator that turns populations back covered cells start with their solid, not as they are told.
[solid]
operator = "bounce_back"
[[grains]]
kind = "sphere"
centre = [4e-5, 4e-5, 4e-5]
diameter = 6e-5
[[records]]
name = "box"
kind = "box"
every_steps = 1
[stop]
steps = 1
"#;
    let text = water([8, 8, 8], 1e-5, rest).replace("tau = 0.8", "tau = 0.9");
    // Half a step of the force gives g dt/2 = 6.7e-4 m/s; a sum of 19 populations rounds to 1e-16 of sound.
    let start = |changes: &[&str]| {
        let scene = changed(&text, changes);
        let engine = open(EngineName::Reference, &scene, None, false).unwrap();
        (box_row(&scene, &engine), scene.units.si_velocity())
    };
    let (row, unit) = start(&[]);
    for (value, name) in row[1..].iter().zip(["x", "y", "z", "largest speed"]) {
        assert!(value.abs() < 1e-15 * unit, "{name}: {value:e} m/s of a fluid at rest");
    }
    // A fluid that moves moves as it is told, in fluid and covered cells.
    let (row, unit) = start(&["initial={ velocity = [0.01, 0.0, 0.0] }"]);
    assert!((row[1] - 0.01).abs() < 1e-14 * unit, "{} m/s, 0.01 is set", row[1]);
}

#[test]
fn a_relaxation_time_reaches_the_engine_as_it_is_written() {
    for tau in [0.9, 0.55, 0.7, 1.1, 0.50001, 3.3] {
        for dx in [1e-4, 3.125e-5, 7e-6] {
            let changes =
                ["faces={}".into(), format!("time.tau={tau}"), format!("domain.dx={dx:e}")];
            let scene = changed(&COUETTE, &changes.each_ref().map(String::as_str));
            assert_eq!(
                scene.setup.collision.tau().to_bits(),
                f64::to_bits(tau),
                "tau {tau}, dx {dx}"
            );
        }
    }
}

#[test]
fn an_interval_that_is_no_whole_number_of_steps_is_told() {
    // dt = (0.8 - 1/2)/3 dx²/ν = 1.5e-6 s with dx = 3.873e-6 m: 10 microseconds are 6.67 steps.
    let told = |every: &str| {
        let changes = [
            format!("records[0].every={every}"),
            "time={ dt = 1.5e-6 }".to_owned(),
            "domain.dx=3.873e-6".to_owned(),
        ];
        let changes: Vec<&str> = changes.iter().map(String::as_str).chain(["faces={}"]).collect();
        let scene = changed(&COUETTE, &changes);
        let all = warnings(&scene).into_iter().map(|warning| warning.reason);
        all.filter(|reason| reason.contains("`every`")).collect::<Vec<_>>()
    };
    let [reason] = &told("1e-5")[..] else { panic!("{:?}", told("1e-5")) };
    for part in ["record line", "1e-5 s is 6.67 time steps", "every 7, 1.0500e-5 s"] {
        assert!(reason.contains(part), "{part}: {reason}");
    }
    assert_eq!(told("1.5e-5"), [""; 0], "ten steps");
}

/// Bytes of all files below a folder whose name ends with one of `endings`.
fn size(folder: &Path, endings: &[&str]) -> u64 {
    let of = |path: &Path| match path.is_dir() {
        true => size(path, endings),
        false if endings.iter().any(|ending| path.to_str().unwrap().ends_with(ending)) => {
            path.metadata().unwrap().len()
        }
        false => 0,
    };
    fs::read_dir(folder).unwrap().map(|entry| of(&entry.unwrap().path())).sum()
}

#[test]
fn a_run_writes_no_more_than_its_estimate_and_not_much_less() {
    let rest = r#"
[body_force]
acceleration = [50.0, 20.0, 0.0]
[[grains]]
kind = "sphere"
centre = [6.1e-5, 5.9e-5, 7e-5]
diameter = 6e-5
[checkpoint]
every_steps = 20
[stop]
steps = 100
"#;
    let text = water([12, 16, 20], 1e-5, rest);
    let mut budget = Budget::oracle(2_700_000);
    for (kind, more, endings, least) in [
        ("box", "every_steps = 1", &["r.csv", "r.svg"][..], 0.5),
        ("permeability", "axis = \"x\"\nevery_steps = 1", &["r.csv", "r.svg"], 0.5),
        ("profile", "axis = \"x\"\nevery_steps = 5", &["r.csv", "r.svg"], 0.5),
        ("loads", "every_steps = 1", &["r.csv", "r.svg"], 0.3),
        ("fields", "formats = [\"vti\", \"npy\"]\nevery_steps = 50", &[".vti", ".npy"], 0.9),
        ("grains", "every_steps = 5", &[".vtp"], 0.3),
        ("slice", "axis = \"z\"\nevery_steps = 20", &["r_000000000100.svg", "0.svg"], 0.3),
    ] {
        let folder = Folder::new(&format!("size_{kind}"));
        let text = format!("{text}[[records]]\nname = \"r\"\nkind = \"{kind}\"\n{more}\n");
        let file = folder.write("scene.toml", &text);
        let out = folder.path("out");
        budget.spend(100 * 12 * 16 * 20);
        let output = psmrt(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
        assert!(output.status.success(), "{kind}: {}", stderr(&output));
        let scene = Scene::load(&file, &[]).unwrap();
        let without = Scene { records: Vec::new(), ..scene.clone() };
        let (all, kept) = (disk::bytes(&scene), disk::bytes(&without));
        let (found, saved) = (size(&out, endings) as f64, size(&out, &[".checkpoint"]) as f64);
        println!("{kind}: {found} of {}, checkpoints {saved} of {kept}", all - kept);
        // Text is shorter where digits are few (a fixed grain has zeros), and a picture where neighbours have one
        // colour.
        let share = found / (all - kept);
        assert!(share > least && share <= 1.0, "{kind}: {found} bytes, {} estimated", all - kept);
        // Of the three that may be there at a time the last state stays.
        assert!(
            saved > 0.3 * kept && saved <= kept,
            "checkpoints: {saved} bytes, {kept} estimated"
        );
    }
}

#[test]
fn a_scene_that_fills_a_disk_is_told_how_much_it_writes() {
    let folder = Folder::new("huge_output");
    let text =
        COUETTE.replace("4, 8, 2", "100, 100, 100").replace("steps = 2000", "steps = 1000000");
    let text = format!(
        "{text}[[records]]\nname = \"all\"\nkind = \"fields\"\nevery_steps = 1\nformats = [\"npy\"]\n"
    );
    let file = folder.write("scene.toml", text);
    let output = psmrt(&["check", file.to_str().unwrap()]);
    let said = stdout(&output);
    // 1e6 cells, four numbers of 8 bytes, a million times and once: 32 TB.
    assert!(
        said.contains("warning: the run may write 32.0 TB, 32.0 TB of it by the record all"),
        "{said}"
    );
    let scene = Scene::load(&file, &[]).unwrap();
    assert!((disk::bytes(&scene) / 3.2e13 - 1.0).abs() < 1e-3);
    let few = Scene { stop: psmrt::scene::Stop { steps: 10, steady: None }, ..scene };
    assert_eq!(disk::warnings(&few, Path::new(".")), [], "300 MB");
}
