//! Scenes that tests vary: the text that many of them have alike, and the way from a text to a scene.
//!
//! A test writes the sections that it is about itself, and changes single values by `replace` or, as `--set` does, by
//! [`changed`]. (Not in `tests/common`, which knows the oracle only.)

#![allow(dead_code, reason = "each test binary is a crate of its own and uses a part of this")]

use std::path::Path;

use psmrt::engine::Coupled;
use psmrt::scene::Scene;

/// Water in `cells` periodic cells of `dx` metres, tau = 0.8, and the sections `more`. A time step takes `dx²/1e-5` s.
pub fn water(cells: [usize; 3], dx: f64, more: &str) -> String {
    format!(
        "[domain]\ncells = {cells:?}\ndx = {dx:e}\n[fluid]\ndensity = 1000.0\n\
         kinematic_viscosity = 1e-6\n[time]\ntau = 0.8\n{more}"
    )
}

/// A domain of `cells` of 1 mm and steps of 0.1 ms, without fluid.
pub fn dry(cells: [usize; 3], more: &str) -> String {
    format!(
        "[domain]\ncells = {cells:?}\ndx = 1e-3\n[time]\ndt = 1e-4\n{more}[stop]\nsteps = 100\n"
    )
}

/// Walls at the bottom and the top.
pub const FLOOR_AND_LID: &str = "[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n";

/// Walls on all sides.
pub const BOX: &str = "[faces]\nx_low.kind = \"wall\"\nx_high.kind = \"wall\"\ny_low.kind = \"wall\"\n\
                       y_high.kind = \"wall\"\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n";

pub const GRAVITY: &str = "[gravity]\nacceleration = [0.0, 0.0, -9.81]\n";

/// A free grain, its values as they are written in a scene (m, kg/m³). Its other keys may follow.
pub fn free_sphere(centre: &str, diameter: &str, density: &str) -> String {
    format!(
        "[[grains]]\nkind = \"sphere\"\ncentre = {centre}\ndiameter = {diameter}\n\
         density = {density}\nmotion = \"free\"\n"
    )
}

/// A grain that falls onto a fixed one and past a prescribed one, in a box of all kinds of faces; 60 steps. What the
/// contacts are and how grains and fluid are coupled, `more` says.
pub fn three_grains(more: &str) -> String {
    let rest = r#"
[faces]
y_low.kind = "free_slip"
y_high.kind = "pressure"
y_high.pressure = 0.0
z_low.kind = "wall"
z_high = { kind = "wall", velocity = [1e-2, 0.0, 0.0] }
[[grains]]
kind = "sphere"
centre = [3.4e-4, 2.4e-4, 2.2e-4]
diameter = 2e-4
density = 2500.0
motion = "free"
velocity = [0.0, 0.0, -0.02]
[[grains]]
kind = "sphere"
centre = [3.2e-4, 2.4e-4, 0.6e-4]
diameter = 1.2e-4
[[grains]]
kind = "sphere"
centre = [6.4e-4, 2.4e-4, 4e-4]
diameter = 1.2e-4
motion = "prescribed"
velocity = [0.0, 0.01, 0.0]
"#;
    let stop = "[stop]\nsteps = 60\n";
    thick(&water([20, 12, 16], 4e-5, &format!("{rest}{GRAVITY}{more}{stop}")))
}

/// The scene in a fluid ten times as viscous.
pub fn thick(text: &str) -> String {
    text.replace("kinematic_viscosity = 1e-6", "kinematic_viscosity = 1e-5")
}

/// The scene of a text, or what is wrong with it.
pub fn read(text: &str) -> Result<Scene, String> {
    read_changed(text, &[])
}

/// The scene of a text.
pub fn scene(text: &str) -> Scene {
    changed(text, &[])
}

/// The scene of a text after changes like those of `--set`.
pub fn changed(text: &str, changes: &[&str]) -> Scene {
    read_changed(text, changes).unwrap_or_else(|error| panic!("{error}"))
}

fn read_changed(text: &str, changes: &[&str]) -> Result<Scene, String> {
    let changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    Scene::from_bytes("scene.toml", text.as_bytes().to_vec(), Path::new("."), &changes)
        .map_err(|error| error.to_string())
}

/// The bytes that an engine saves: equal for equal states.
pub fn saved(engine: &Coupled) -> Vec<u8> {
    let mut bytes = Vec::new();
    engine.save(&mut bytes).unwrap();
    bytes
}
