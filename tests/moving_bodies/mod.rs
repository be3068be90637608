//! Bodies of any shape that move as prescribed, on every engine.

#![allow(dead_code, reason = "each test binary is a crate of its own")]

use std::sync::Arc;

use psmrt::engine::{Block, Coupled, EngineName, open};
use psmrt::kernel::Gpu;

use crate::common::Budget;
use crate::scenes::{saved, scene, water};

const CELLS: [usize; 3] = [18, 14, 12];

/// A box that is towed and turned, and a cylinder whose spin swings, between a fixed pipe and a wall.
fn text() -> String {
    let rest = r#"
[faces]
z_low.kind = "wall"
z_high.kind = "wall"
[[grains]]
kind = "body"
centre = [6e-4, 7e-4, 6e-4]
motion = "prescribed"
velocity = [5e-3, 0.0, 0.0]
spin = [2.0, 0.0, 6.0]
body = { shape = "box", size = [4e-4, 2.5e-4, 3e-4], turn = { axis = [1, 1, 0], degrees = 20 } }
[[grains]]
kind = "body"
centre = [14e-4, 7e-4, 6e-4]
motion = "prescribed"
spin = { amplitude = [6.0, 0.0, 0.0], period = 0.03 }
body = { shape = "cylinder", diameter = 3e-4, length = 5e-4, axis = [0, 1, 0] }
[[grains]]
kind = "body"
centre = [9e-4, 2e-4, 6e-4]
body = { shape = "pipe", diameter = 1e-4, wall = 1e-4, length = 6e-4, axis = [1, 0, 0] }
[stop]
steps = 40
"#;
    water(CELLS, 1e-4, rest)
}

fn engine(name: EngineName, gpu: Option<&Arc<Gpu>>) -> Coupled {
    open(name, &scene(&text()), gpu, false).unwrap_or_else(|error| panic!("{error}"))
}

const STEPS: u64 = 40;

/// The flow about them and the loads are the oracle's, but for `rounding`; and a run that is saved in between goes on the same.
pub fn bodies_move_and_turn_as_on_the_oracle(
    name: EngineName,
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
    rounding: f64,
) {
    budget.spend(3 * STEPS * CELLS.iter().product::<usize>() as u64);
    let mut oracle = engine(EngineName::Reference, None);
    oracle.step(STEPS).unwrap();
    let mut own = engine(name, gpu);
    own.step(STEPS / 2).unwrap();
    let state = saved(&own);
    own.step(STEPS / 2).unwrap();

    let (block, solids) = (Block::whole(&own.setup().domain), own.solids());
    for (solid, expected) in solids.iter().zip(oracle.solids()) {
        assert_eq!(solid, &expected, "places, motion and cells are found by the same code");
    }
    // 40 steps of 1 ms.
    assert!(
        (solids[0].centre.x - 6.0 - 40.0 * 5e-3 / 1e-4 / 1000.0).abs() < 1e-9,
        "{:?}",
        solids[0].centre
    );
    let (found, expected) = (own.populations(block), oracle.populations(block));
    let both = found.as_flattened().iter().zip(expected.as_flattened());
    let off = both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(
        off < rounding,
        "populations differ by {off:e} from the oracle's, {rounding:e} is due to rounding"
    );
    // A load is a sum over some hundred cells.
    for (number, (load, expected)) in own.loads().iter().zip(oracle.loads()).enumerate() {
        let off = (load.force - expected.force).norm();
        assert!(
            off < 100.0 * rounding,
            "force on solid {number}: {:?}, the oracle's is {:?}",
            load.force,
            expected.force
        );
        let off = (load.torque - expected.torque).norm();
        assert!(
            off < 500.0 * rounding,
            "torque on solid {number}: {:?}, the oracle's is {:?}",
            load.torque,
            expected.torque
        );
    }
    let moved = own.loads()[0].force.norm();
    assert!(moved > 1e3 * rounding, "the box is held back by {moved:e} only");

    let mut resumed = engine(name, gpu);
    resumed.load(&mut &state[..]).unwrap();
    assert!(saved(&resumed) == state, "what is loaded is what was saved");
    resumed.step(STEPS / 2).unwrap();
    assert!(
        saved(&resumed) == saved(&own),
        "a run that goes on from a saved state goes another way"
    );
}
