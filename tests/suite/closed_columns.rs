//! Water between closed ends that a weight or a force presses together: what `psmrt check` tells of its density and of
//! the swing after a sudden start, held to runs.

use crate::scene_open_faces::{said, warned};
use crate::scenes::{changed, scene};
use psmrt::engine::{Block, EngineName, open};
use psmrt::scene::Scene;

/// Grains of 4 cells, a tenth of a column that is long and narrow; sound takes 443 steps up and down.
const COLUMN: &str = r#"
[domain]
cells = [12, 12, 128]
dx = 4e-5
[fluid]
density = 1000.0
kinematic_viscosity = 1e-5
[time]
tau = 2.0
[faces]
z_low.kind = "wall"
z_high.kind = "wall"
[gravity]
acceleration = [0.0, 0.0, -9.81]
[solid]
operator = "full_bounce_back"
[[grains]]
kind = "random"
count = 55
diameter = 1.6e-4
density = 2500.0
motion = "free"
[stop]
steps = 450
"#;

const RAMP: &str = "{ from = [0.0, 0.0, 0.0], to = [0.0, 0.0, -9.81], end = 0.071 }";

fn with_ramp() -> Scene {
    scene(&COLUMN.replace("[0.0, 0.0, -9.81]", RAMP))
}

/// The largest mean velocity of the grains in `steps` steps, downwards, m/s.
fn fastest(scene: &Scene, steps: u64) -> f64 {
    let mut engine = open(EngineName::CpuSingle, scene, None, false).unwrap();
    let mut fastest: f64 = 0.0;
    for _ in 0..steps / 10 {
        engine.step(10).unwrap();
        let solids = engine.solids();
        let sum: f64 = solids.iter().map(|solid| -solid.velocity.z).sum();
        fastest = fastest.max(sum / solids.len() as f64 * scene.units.si_velocity());
    }
    fastest
}

#[test]
fn swing_of_a_sudden_start_is_warned_of_with_its_velocity_and_a_ramp_removes_it() {
    let sudden = scene(COLUMN);
    let due = warned(&sudden, "swing together").expect("a swing is warned of");
    let swing = said(&due.reason, "at up to ", " m/s");
    let found = fastest(&sudden, 450);
    println!(
        "a swing of {swing:.2e} m/s is said, grains fall at up to {found:.2e} m/s in the mean"
    );
    // The waves of both ends meet half-way, when the velocity falls evenly from there to the ends: the mean over the column
    // is half of the largest. In the water, grains fall at up to a third of that (Stokes' velocity is a sixth of the
    // swing); viscosity takes some percent of it.
    let mean = 0.5 * swing;
    assert!((0.85 * mean..1.4 * mean).contains(&found), "{found:e}, half the swing is {mean:e}");
    let ramped = with_ramp();
    assert_eq!(warned(&ramped, "swing together"), None, "the remedy must be one");
    // While it grows, and in a period after that, nothing is faster than the grains themselves would be.
    let stokes = said(&due.reason, "m/s, ", " times");
    let found = fastest(&ramped, 1330);
    assert!(
        found < 1.3 * swing / stokes,
        "{found:e} m/s with a ramp; Stokes' velocity is {:e}",
        swing / stokes
    );
}

#[test]
fn water_that_a_weight_presses_together_is_warned_of_and_denser_at_the_floor_by_as_much() {
    let (sudden, ramped) = (scene(COLUMN), with_ramp());
    let due = warned(&sudden, "press the water together").expect("the density is warned of");
    assert_eq!(
        Some(&due),
        warned(&ramped, "press the water together").as_ref(),
        "of the full weight"
    );
    let compression = said(&due.reason, "differs by ", " %") / 100.0;
    // Solid fraction times 1.5 g L over c_s² = (dx/dt)²/3, from the scene's own numbers.
    let dt = 1.5 * 4e-5_f64.powi(2) / (3.0 * 1e-5);
    let fraction = 55.0 * std::f64::consts::PI / 6.0 * 64.0 / (144.0 * 128.0);
    let expected = fraction * 1.5 * 9.81 * 128.0 * 4e-5 * 3.0 * (dt / 4e-5).powi(2);
    assert!((compression / expected - 1.0).abs() < 0.01, "{compression}, expected {expected}");
    // As long as the grains are spread over the whole column, the water is denser at the floor by as much.
    let mut engine = open(EngineName::Cpu, &ramped, None, false).unwrap();
    engine.step(1330).unwrap();
    let density = |z: usize| {
        let block = Block { low: [0, 0, z], size: [12, 12, 1] };
        let cells = engine.cells(block);
        cells.iter().map(|cell| cell.density).sum::<f64>() / cells.len() as f64
    };
    let found = density(0) - density(127);
    println!("denser at the floor by {found:.4}, {compression:.4} is said");
    // In 0.1 s the grains fall a diameter or two of 32: what has reached the floor no longer hangs in the water.
    assert!((0.8..1.05).contains(&(found / compression)), "{found}, {compression} is said");
}

#[test]
fn columns_that_hold_still_or_let_sound_out_are_not_warned_of() {
    for (what, changes) in [
        ("a short time step", ["time.tau=0.52"].as_slice()),
        ("grains as dense as the water", &["grains[0].density=1000.0"]),
        ("an open lid", &["faces.z_high={ kind = \"pressure\", pressure = 0.0 }"]),
    ] {
        let scene = changed(COLUMN, changes);
        for part in ["swing together", "press the water together"] {
            assert_eq!(warned(&scene, part), None, "{what}");
        }
    }
}
