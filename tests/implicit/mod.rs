//! Free grains under full bounce-back, which every engine must move as the oracle does and go on with bit for bit.

#![allow(dead_code, reason = "each test binary is a crate of its own and uses a part of this")]

use std::path::Path;
use std::sync::Arc;

use psmrt::engine::{Block, Coupled, EngineName, open};
use psmrt::kernel::Gpu;
use psmrt::scene::{Scene, SceneError};
use psmrt_reference::directions::Q;

use crate::common::Budget;

/// Halves of three grains that share cells at a mirror plane, two of which touch, in balanced gravity.
pub const PERIODIC: &str = r#"
[domain]
cells = [18, 14, 20]
dx = 4e-5
[fluid]
density = 1000.0
kinematic_viscosity = 1e-5
[time]
tau = 0.8
[faces]
x_low.kind = "free_slip"
x_high.kind = "free_slip"
[solid]
operator = "full_bounce_back"
[[grains]]
kind = "sphere"
centre = [0.0, 2.4e-4, 4.2e-4]
diameter = 2.4e-4
density = 1000.0
motion = "free"
velocity = [0.0, 0.01, -0.02]
[[grains]]
kind = "sphere"
centre = [0.0, 3.28e-4, 2.08e-4]
diameter = 2.1e-4
density = 2500.0
motion = "free"
spin = [20.0, 0.0, 0.0]
[[grains]]
kind = "sphere"
centre = [0.0, 1.96e-4, 6.36e-4]
diameter = 2.0e-4
density = 1200.0
motion = "free"
velocity = [0.0, 0.01, -0.03]
[gravity]
acceleration = [0.0, 0.0, -9.81]
balance = true
[stop]
steps = 60
"#;

/// A grain that falls onto a fixed one and past a prescribed one.
pub const CLOSED: &str = r#"
[domain]
cells = [20, 12, 16]
dx = 4e-5
[fluid]
density = 1000.0
kinematic_viscosity = 1e-5
[time]
tau = 0.8
[faces]
y_low.kind = "free_slip"
y_high.kind = "pressure"
y_high.pressure = 0.0
z_low.kind = "wall"
z_high = { kind = "wall", velocity = [1e-2, 0.0, 0.0] }
[solid]
operator = "full_bounce_back"
[[grains]]
kind = "sphere"
centre = [3.4e-4, 2.4e-4, 2.2e-4]
diameter = 2e-4
density = 2500.0
motion = "free"
velocity = [0.0, 0.0, -0.02]
spin = [20.0, -30.0, 10.0]
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
[gravity]
acceleration = [0.0, 0.0, -9.81]
[contact]
duration = 2e-4
[engine]
kind = "cpu"
[stop]
steps = 60
"#;

pub fn read(text: &str) -> Result<Scene, Box<SceneError>> {
    Scene::from_bytes("scene.toml", text.as_bytes().to_vec(), Path::new("."), &[])
}

pub fn scene(text: &str) -> Scene {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

/// Steps of [`grains_move_as_in_the_oracle`].
pub const STEPS: u64 = 24;

/// Populations and velocities of grains are the oracle's, but for a bound of each engine.
pub fn grains_move_as_in_the_oracle(
    engines: &[(EngineName, f64)],
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
) {
    for (scene_name, text) in [("periodic", PERIODIC), ("closed", CLOSED)] {
        let scene = scene(text);
        let run = |engine| {
            let mut engine = open(engine, &scene, gpu, false).unwrap();
            engine.step(STEPS).unwrap();
            engine
        };
        budget.spend(STEPS * scene.setup.domain.cell_count() as u64);
        let oracle = run(EngineName::Reference);
        let all = Block::whole(&scene.setup.domain);
        let expected = oracle.populations(all);
        for &(name, bound) in engines {
            let (what, found) = (format!("{scene_name}, {name:?}"), run(name));
            let cells = found.populations(all);
            let pairs = cells.iter().zip(&expected);
            let off =
                pairs.flat_map(|(f, e)| (0..Q).map(|a| (f[a] - e[a]).abs())).fold(0.0, f64::max);
            println!("{what}: populations {off:.1e} apart, allowed {bound:.1e}");
            assert!(off < bound, "{what}: {off:e} apart, rounding explains {bound:e}");
            for (solid, expected) in found.solids().iter().zip(oracle.solids()) {
                let off = (solid.velocity - expected.velocity).norm()
                    + (solid.angular_velocity - expected.angular_velocity).norm();
                assert!(off < bound, "{what}: {off:e} apart: {solid:?} and {expected:?}");
            }
        }
    }
}

/// What is saved during a contact goes on with the same bits.
pub fn a_contact_goes_on_bit_for_bit(
    name: EngineName,
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
) {
    let scene = scene(CLOSED);
    let bytes = |engine: &Coupled| {
        let mut bytes = Vec::new();
        engine.save(&mut bytes).unwrap();
        bytes
    };
    let new = || open(name, &scene, gpu, false).unwrap();
    let (mut whole, mut first, mut second) = (new(), new(), new());
    budget.spend(2 * 40 * scene.setup.domain.cell_count() as u64);
    whole.step(40).unwrap();
    first.step(16).unwrap();
    let state = first.free_grains().unwrap().state();
    assert!(!state.pair_contacts.is_empty(), "no contact");
    let saved = bytes(&first);
    second.load(&mut saved.as_slice()).unwrap();
    assert!(saved == bytes(&second), "what is read is what was written");
    second.step(24).unwrap();
    assert!(bytes(&whole) == bytes(&second), "{name:?}");
}
