//! Free grains under full bounce-back: the CPU engine against the oracle, saved states, and who cannot do it.

use std::sync::LazyLock;

use crate::common::Budget;
use crate::scenes::{GRAVITY, free_sphere, read, saved, scene, thick, three_grains, water};
use psmrt::engine::{Block, EngineName, StartError, open};
use psmrt_reference::directions::Q;

const OPERATOR: &str = "[solid]\noperator = \"full_bounce_back\"\n";

/// Halves of three grains that share cells at a mirror plane, two of which touch, in balanced gravity.
static PERIODIC: LazyLock<String> = LazyLock::new(|| {
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
static CLOSED: LazyLock<String> = LazyLock::new(|| {
    let more = format!("{OPERATOR}[contact]\nduration = 2e-4\n[engine]\nkind = \"cpu\"\n");
    let falls = "velocity = [0.0, 0.0, -0.02]";
    three_grains(&more).replace(falls, &format!("{falls}\nspin = [20.0, -30.0, 10.0]"))
});

#[test]
fn the_cpu_engine_moves_grains_as_the_oracle_does_to_round_off() {
    const STEPS: u64 = 24;
    let mut budget = Budget::oracle(214_000);
    for (name, text) in [("periodic", &PERIODIC), ("closed", &CLOSED)] {
        let scene = scene(text);
        let run = |engine| {
            let mut engine = open(engine, &scene, None, false).unwrap();
            engine.step(STEPS).unwrap();
            engine
        };
        budget.spend(STEPS * scene.setup.domain.cell_count() as u64);
        let oracle = run(EngineName::Reference);
        // Each of 24 steps rounds a population, of up to 1/3, a few tens of times in either, and the weights of cut cells
        // are some 1e-14 off (cpu_engine.rs), of changes of up to 0.05. Grains sum up some 200 cells and divide by masses
        // of 100; what they then do goes into the populations again.
        let double = 24.0 * (16.0 * f64::EPSILON / 3.0 + 1e-14 * 0.05) * 10.0;
        // In single precision, of populations less their weights: up to 0.03.
        let single = 24.0 * 0.03 * f64::from(f32::EPSILON) * 10.0;
        for (engine, bound) in [(EngineName::Cpu, double), (EngineName::CpuSingle, single)] {
            let cpu = run(engine);
            let all = Block::whole(&scene.setup.domain);
            let (found, expected) = (cpu.populations(all), oracle.populations(all));
            let cells = found.iter().zip(&expected);
            let off = cells.flat_map(|(f, e)| (0..Q).map(|a| (f[a] - e[a]).abs()));
            let off = off.fold(0.0, f64::max);
            println!("{name}, {engine:?}: populations {off:.1e} apart");
            assert!(off < bound, "{name}, {engine:?}: {off:e} apart, {bound:e} is round-off");
            for (solid, expected) in cpu.solids().iter().zip(oracle.solids()) {
                let off = (solid.velocity - expected.velocity).norm()
                    + (solid.angular_velocity - expected.angular_velocity).norm();
                assert!(off < bound, "{name}, {engine:?}: {solid:?} and {expected:?}");
            }
        }
    }
}

#[test]
fn engines_go_on_bit_for_bit_from_what_they_saved_during_contacts() {
    let mut budget = Budget::oracle(308_000);
    let scene = scene(&CLOSED);
    for name in [EngineName::Reference, EngineName::Cpu, EngineName::CpuSingle] {
        let new = || open(name, &scene, None, false).unwrap();
        let (mut whole, mut first, mut second) = (new(), new(), new());
        if name == EngineName::Reference {
            budget.spend(2 * 40 * scene.setup.domain.cell_count() as u64);
        }
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
}

#[test]
fn the_kernel_and_averaged_loads_are_refused_with_a_way_out() {
    let gpu = read(&CLOSED.replace("\"cpu\"", "\"wgpu\"")).unwrap_err();
    for word in ["engine.kind", "full_bounce_back", "kind = \"cpu\"", "\"bounce_back\""] {
        assert!(gpu.contains(word), "{word} is missing: {gpu}");
    }
    let averaged = CLOSED.replace("[engine]", "[coupling]\naverage_loads = true\n[engine]");
    let averaged = read(&averaged).unwrap_err();
    for word in ["coupling.average_loads", "full_bounce_back", "remove the key"] {
        assert!(averaged.contains(word), "{word} is missing: {averaged}");
    }
    // The ways out.
    for (from, to) in
        [("\"cpu\"", "\"wgpu\""), ("[engine]", "[coupling]\naverage_loads = true\n[engine]")]
    {
        scene(&CLOSED.replace("\"full_bounce_back\"", "\"bounce_back\"").replace(from, to));
    }
    let graded = read(&CLOSED.replace("\"full_bounce_back\"", "\"graded_viscosity\"")).unwrap_err();
    assert!(graded.contains("solid.operator"), "{graded}");
    // A scene that is opened on another engine than its own; no device is asked for.
    assert!(matches!(
        open(EngineName::Wgpu, &scene(&CLOSED), None, false),
        Err(StartError::NoImplicitCoupling(_))
    ));
}
