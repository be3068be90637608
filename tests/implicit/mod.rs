//! Free grains under full bounce-back, which every engine must move as the oracle does and go on with bit for bit.

#![allow(dead_code, reason = "each test binary is a crate of its own and uses a part of this")]

use std::sync::{Arc, LazyLock};

use psmrt::engine::{Block, EngineName, open};
use psmrt::kernel::Gpu;
use psmrt_reference::directions::Q;

use crate::common::Budget;
use crate::scenes::{GRAVITY, free_sphere, saved, scene, thick, three_grains, water};

const OPERATOR: &str = "[solid]\noperator = \"full_bounce_back\"\n";

/// Halves of three grains that share cells at a mirror plane, two of which touch, in balanced gravity.
pub static PERIODIC: LazyLock<String> = LazyLock::new(|| {
    let faces = "[faces]\nx_low.kind = \"free_slip\"\nx_high.kind = \"free_slip\"\n";
    let grains = [
        ("[0.0, 2.4e-4, 4.2e-4]", "2.4e-4", "1000.0", "velocity = [0.0, 0.01, -0.02]"),
        ("[0.0, 3.28e-4, 2.08e-4]", "2.1e-4", "2500.0", "spin = [20.0, 0.0, 0.0]"),
        ("[0.0, 1.96e-4, 6.36e-4]", "2.0e-4", "1200.0", "velocity = [0.0, 0.01, -0.03]"),
    ];
    let grains: String = grains
        .into_iter()
        .map(|(centre, d, density, motion)| free_sphere(centre, d, density) + motion + "\n")
        .collect();
    let rest = format!("{faces}{OPERATOR}{grains}{GRAVITY}balance = true\n[stop]\nsteps = 60\n");
    thick(&water([18, 14, 20], 4e-5, &rest))
});

/// A grain that falls onto a fixed one and past a prescribed one.
pub static CLOSED: LazyLock<String> = LazyLock::new(|| {
    let more = format!("{OPERATOR}[contact]\nduration = 2e-4\n[engine]\nkind = \"cpu\"\n");
    let falls = "velocity = [0.0, 0.0, -0.02]";
    three_grains(&more).replace(falls, &format!("{falls}\nspin = [20.0, -30.0, 10.0]"))
});

/// Steps of [`grains_move_as_in_the_oracle`].
pub const STEPS: u64 = 24;

/// Populations and velocities of grains are the oracle's, but for a bound of each engine.
pub fn grains_move_as_in_the_oracle(
    engines: &[(EngineName, f64)],
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
) {
    for (scene_name, text) in [("periodic", &PERIODIC), ("closed", &CLOSED)] {
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
    let scene = scene(&CLOSED);
    let new = || open(name, &scene, gpu, false).unwrap();
    let (mut whole, mut first, mut second) = (new(), new(), new());
    budget.spend(2 * 40 * scene.setup.domain.cell_count() as u64);
    whole.step(40).unwrap();
    first.step(16).unwrap();
    let state = first.free_grains().unwrap().state();
    assert!(!state.pair_contacts.is_empty(), "no contact");
    let state = saved(&first);
    second.load(&mut state.as_slice()).unwrap();
    assert!(state == saved(&second), "what is read is what was written");
    second.step(24).unwrap();
    assert!(saved(&whole) == saved(&second), "{name:?}");
}
