//! Extremes that both engines are put through: scenes at the edge of what makes sense, by the command line.
//! (Runs on either side of the frontiers of stability: `tests/validation/tests/edges`.)

#![allow(dead_code, reason = "the tests of each engine use a part of this")]

mod vtk;

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::cli::{Folder, stderr, stdout};
use crate::scenes::water;

/// A record of every kind, 20 steps.
const REST: &str = r#"
[[records]]
name = "box"
kind = "box"
every_steps = 5
[[records]]
name = "line"
kind = "profile"
axis = "x"
[[records]]
name = "plane"
kind = "slice"
axis = "z"
[[records]]
name = "fields"
kind = "fields"
formats = ["vti", "npy"]
[stop]
steps = 20
"#;

/// The steps of such a scene.
pub const STEPS: u64 = 20;

/// A box of so many cells with faces, forces, grains as `more` says.
pub fn scene(cells: [usize; 3], more: &str) -> String {
    water(cells, 1e-5, &format!("{REST}{more}"))
}

/// Every number in every table, array and picture below `folder` is finite.
pub fn assert_all_finite(folder: &Path) {
    let mut files = 0;
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = entry.display();
        if entry.is_dir() {
            assert_all_finite(&entry);
            continue;
        }
        let bytes = fs::read(&entry).unwrap();
        match entry.extension().and_then(|ending| ending.to_str()) {
            Some("csv") => {
                for line in String::from_utf8(bytes).unwrap().lines().skip(1) {
                    for cell in line.split(',') {
                        let value: f64 = cell
                            .parse()
                            .unwrap_or_else(|_| panic!("{name} has {cell:?} in the line {line}"));
                        assert!(
                            value.is_finite(),
                            "{name} has a value that is not finite in the line {line}"
                        );
                    }
                }
            }
            Some("npy") => {
                let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
                for value in bytes[start..].chunks_exact(8) {
                    let value = f64::from_le_bytes(value.try_into().unwrap());
                    assert!(
                        value.is_finite(),
                        "{name} holds the value {value}, which is not finite",
                    );
                }
            }
            Some("vti" | "vtp") => vtk::assert_finite(&bytes, &name.to_string()),
            Some("svg" | "json") => {
                let text = String::from_utf8(bytes).unwrap();
                assert!(!text.contains("NaN") && !text.contains(">inf"), "{name}");
            }
            _ => continue,
        }
        files += 1;
    }
    println!("{}: {files} files are finite", folder.display());
}

/// A row of a table, by the name of the column (its unit left out).
pub fn last_value(table: &Path, column: &str) -> f64 {
    let text = fs::read_to_string(table).unwrap();
    let mut lines = text.lines();
    let names = lines.next().unwrap().split(',').map(|name| name.split(" (").next().unwrap());
    let number = names.into_iter().position(|name| name == column).unwrap();
    lines.last().unwrap().split(',').nth(number).unwrap().parse().unwrap()
}

/// Runs a scene on an engine by the command line, in a folder of its own.
pub fn run(engine: &str, folder: &Folder, text: &str) -> Output {
    let file = folder.write("scene.toml", text);
    let out = folder.path("out");
    crate::cli::psmrt(&[
        "run",
        file.to_str().unwrap(),
        "--engine",
        engine,
        "--out",
        out.to_str().unwrap(),
    ])
}

/// Runs a scene that is to come to its end, with finite results; returns the last row of its record `box`
/// as a function of the column.
pub fn ends(engine: &str, name: &str, text: &str) -> impl Fn(&str) -> f64 + use<> {
    let folder = Folder::new(&format!("{name}_{engine}"));
    let output = run(engine, &folder, text);
    // Not steady at its limit is an end too, where the scene asks for it.
    let code = if text.contains("[stop.steady]") { 3 } else { 0 };
    assert_eq!(output.status.code(), Some(code), "{}{}", stdout(&output), stderr(&output));
    assert_all_finite(&folder.path("out"));
    let table = folder.path("out/box.csv");
    move |column| {
        let _ = &folder; // kept as long as its table is read
        last_value(&table, column)
    }
}

/// A scene that is to break: the run must say so, exit with 1, and leave nothing that is not finite.
pub fn breaks(engine: &str, name: &str, text: &str, cause: &str) {
    let folder = Folder::new(&format!("{name}_{engine}"));
    let output = run(engine, &folder, text);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{name}: {}{said}", stdout(&output));
    assert!(said.contains("stopped before step") && said.contains(cause), "{name}: {said}");
    println!("{name}: {said}");
    assert_all_finite(&folder.path("out"));
    // A state that the guard takes for broken is not recorded either: the limit is half a cell per step,
    // 0.5 m/s here, of the bare momentum; a twentieth is for the half step of the force.
    let fastest = last_value(&folder.path("out/box.csv"), "max_speed");
    assert!(fastest < 0.6, "{name}: a row with {fastest} m/s was written");
}

/// A box of one cell gains in each step what the force gives, and nothing else happens to it.
pub fn one_cell(engine: &str, tolerance: f64) {
    let force = "[body_force]\nacceleration = [1.0, 0.0, 0.0]\n";
    let last = ends(engine, "one_cell", &scene([1, 1, 1], force));
    // dt = (0.8 - 1/2)/3 dx²/ν = 1e-5 s; u = a n dt
    let expected = STEPS as f64 * 1e-5;
    let found = last("superficial_velocity_x");
    assert!((found / expected - 1.0).abs() < tolerance, "{found} m/s, {expected} are right");
}

/// A channel of one column of cells is the channel of nine: nothing varies along it.
pub fn one_column(engine: &str, tolerance: f64) {
    let more = "[body_force]\nacceleration = [1.0, 0.5, 0.0]\n[faces]\nz_low.kind = \"wall\"\n\
                z_high.kind = \"wall\"\n";
    let narrow = ends(engine, "one_column", &scene([1, 1, 8], more));
    let wide = ends(engine, "nine_columns", &scene([3, 3, 8], more));
    for column in ["superficial_velocity_x", "superficial_velocity_y", "max_speed"] {
        let (narrow, wide) = (narrow(column), wide(column));
        assert!(
            wide > 1e-5 && (narrow / wide - 1.0).abs() < tolerance,
            "velocity in a box of one column {narrow}, in a wide one {wide} m/s: they ought to \
             be equal",
        );
    }
}

/// A box that is all solid, held still, stops the fluid in one step and keeps it stopped.
pub fn all_solid(engine: &str, tolerance: f64) {
    let mirrors = ["x_low", "x_high", "y_low", "y_high", "z_low", "z_high"];
    let mut more = "[initial]\nvelocity = [1e-3, 0.0, 0.0]\n[body_force]\n\
                    acceleration = [1.0, 0.0, 0.0]\n[[grains]]\nkind = \"sphere\"\n\
                    centre = [0.0, 0.0, 0.0]\ndiameter = 1.6e-4\n[faces]\n"
        .to_owned();
    mirrors.iter().for_each(|face| more += &format!("{face}.kind = \"free_slip\"\n"));
    let last = ends(engine, "all_solid", &scene([4, 4, 4], &more));
    let found = last("superficial_velocity_x").abs();
    assert!(found < tolerance * 1e-3, "{found} m/s of 1e-3 m/s are left");
}

/// What is at rest stays at rest, and a steady-state criterion does not take "no flow yet" for steady.
pub fn at_rest(engine: &str) {
    let more = "[[grains]]\nkind = \"sphere\"\ncentre = [4e-5, 4e-5, 4e-5]\ndiameter = 4e-5\n\
                [stop.steady]\nrecord = \"box\"\ncolumn = \"superficial_velocity_x\"\n\
                tolerance = 1e-3\n";
    let last = ends(engine, "at_rest", &scene([8, 8, 8], more));
    // The weights 1/18 and 1/36 add up to a residue of some epsilons times the speed of sound, 1 m/s here.
    assert!(
        last("max_speed") < 1e-14,
        "fluid at rest has come to move at {} m/s",
        last("max_speed"),
    );
    assert_eq!(last("step"), STEPS as f64);
}

/// A bed that is driven far too hard, and grains far too light for the lagged inertia of the fluid inside:
/// both stop at a record, long before they would be over, and no record holds what is not finite. Every
/// record is taken at every step.
pub fn broken_scenes(engine: &str) {
    let hard = r#"
[collision]
model = "srt"
[body_force]
acceleration = [1.5e4, 0.0, 0.0]
[[grains]]
kind = "array"
lattice = "bcc"
solid_fraction = 0.6
"#;
    breaks(engine, "hard_bed", &often(&scene([16, 16, 16], hard)), "body force");
    let light = r#"
[coupling]
internal_fluid = "lagged"
[[grains]]
kind = "sphere"
centre = [6.3e-5, 6.2e-5, 6.1e-5]
diameter = 6e-5
motion = "free"
density = 50.0
velocity = [0.05, 0.0, 0.0]
[[records]]
name = "loads"
kind = "loads"
[[records]]
name = "means"
kind = "grain_means"
[[records]]
name = "grains"
kind = "grains"
"#;
    breaks(
        engine,
        "light_grain",
        &often(&scene([12, 12, 12], light)),
        "times the density of the fluid",
    );
}

/// The scene with every record taken at every step, and 200 steps.
fn often(text: &str) -> String {
    let text = text.replace("every_steps = 5\n", "").replace("steps = 20", "steps = 200");
    let text = text.replace("[[records]]\n", "[[records]]\nevery_steps = 1\n");
    format!("{text}[checkpoint]\nevery_steps = 1\n")
}
