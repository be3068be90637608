//! Scenes whose values change in time, on each engine.

use std::sync::{Arc, LazyLock};

use psmrt::engine::{Block, Coupled, EngineName, open};
use psmrt::kernel::Gpu;
use psmrt::scene::Scene;

use crate::common::Budget;
use crate::scenes::{saved, scene, thick, water};

/// All that can change, with a free grain beside a prescribed one; 60 steps of 1.6e-5 s. A velocity of 1 is 2.5 m/s.
static ALL: LazyLock<String> = LazyLock::new(|| {
    let rest = r#"
[faces]
z_low = { kind = "wall", velocity = { amplitude = [0.05, 0.02, 0.0], period = 5e-4 } }
z_high = { kind = "pressure", pressure = { table = [[0.0, 0.0], [3e-4, 20.0], [3e-4, 5.0], [8e-4, 0.0]] } }
[body_force]
acceleration = { from = [0.0, 0.0, 0.0], to = [20.0, 5.0, 0.0], start = 1e-4, end = 7e-4 }
[gravity]
acceleration = { mean = [0.0, 0.0, -9.81], amplitude = [3.0, 0.0, 2.0], period = 4e-4, phase = 1.0 }
form = "body_force"
[[grains]]
kind = "sphere"
centre = [1.7e-4, 2.4e-4, 2.2e-4]
diameter = 2e-4
density = 2500.0
motion = "free"
[[grains]]
kind = "sphere"
centre = [4.1e-4, 2.4e-4, 4e-4]
diameter = 1.4e-4
motion = "prescribed"
velocity = { amplitude = [0.0, 0.05, 0.02], period = 6e-4 }
spin = { from = [0.0, 0.0, 0.0], to = [0.0, 200.0, 0.0], end = 5e-4 }
[stop]
steps = 60
"#;
    thick(&water([14, 12, 16], 4e-5, rest))
});

const CELLS: u64 = 14 * 12 * 16;

/// The same with each value as it is at the start, and as a table of that value.
fn constant(as_table: bool) -> String {
    let value = |plain: &str| match as_table {
        false => plain.to_owned(),
        true => format!("{{ table = [[0.0, {}]] }}", plain.trim_matches(['[', ']'])),
    };
    let (wall, pressure) = (value("[0.05, 0.02, 0.0]"), value("20.0"));
    let (force, gravity) = (value("[20.0, 5.0, 0.0]"), value("[3.0, 0.0, -9.81]"));
    let (velocity, spin) = (value("[0.0, 0.05, 0.02]"), value("[0.0, 200.0, 0.0]"));
    let rest = format!(
        "[faces]\nz_low = {{ kind = \"wall\", velocity = {wall} }}\n\
         z_high = {{ kind = \"pressure\", pressure = {pressure} }}\n\
         [body_force]\nacceleration = {force}\n[gravity]\nacceleration = {gravity}\nform = \"body_force\"\n\
         [[grains]]\nkind = \"sphere\"\ncentre = [1.7e-4, 2.4e-4, 2.2e-4]\ndiameter = 2e-4\ndensity = 2500.0\n\
         motion = \"free\"\n[[grains]]\nkind = \"sphere\"\ncentre = [4.1e-4, 2.4e-4, 4e-4]\ndiameter = 1.4e-4\n\
         motion = \"prescribed\"\nvelocity = {velocity}\nspin = {spin}\n[stop]\nsteps = 60\n"
    );
    thick(&water([14, 12, 16], 4e-5, &rest))
}

fn opened(scene: &Scene, engine: EngineName, gpu: Option<&Arc<Gpu>>) -> Coupled {
    open(engine, scene, gpu, false).unwrap()
}

/// What all of them do in each step is what they do in the oracle.
pub fn values_that_change_in_time_act_as_in_the_oracle(
    engine: EngineName,
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
) {
    let scene = scene(&ALL);
    let mut oracle = opened(&scene, EngineName::Reference, None);
    let mut other = opened(&scene, engine, gpu);
    // Single precision of shifted populations, added up over the steps: 60 times 19 roundings of a speed of 0.03.
    let allowed = 60.0 * 19.0 * 1.2e-7 * 0.03;
    for step in 1..=60 {
        budget.spend(2 * CELLS);
        oracle.step(1).unwrap();
        other.step(1).unwrap();
        if step % 7 != 0 {
            continue;
        }
        let all = Block::whole(&scene.setup.domain);
        let states = oracle.cells(all).into_iter().zip(other.cells(all));
        let off = states.map(|(a, b)| (a.velocity - b.velocity).norm()).fold(0.0, f64::max);
        assert!(off < allowed, "step {step}: a velocity is off by {off:e}, {allowed:e} is allowed");
        for (a, b) in oracle.solids().iter().zip(other.solids()) {
            let off = (a.centre - b.centre).norm().max((a.velocity - b.velocity).norm());
            assert!(
                off < allowed,
                "step {step}: a grain is off by {off:e}, {allowed:e} is allowed"
            );
            assert!(
                (a.angular_velocity - b.angular_velocity).norm() < allowed,
                "step {step}: spin"
            );
        }
    }
}

pub fn a_run_with_values_that_change_goes_on_from_any_step_with_the_same_bits(
    engine: EngineName,
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
) {
    let scene = scene(&ALL);
    let mut whole = opened(&scene, engine, gpu);
    // Before the jump of the pressure at step 18.75, after it, and after the end of the ramp at step 43.75.
    for step in [18, 24, 44] {
        budget.spend((step - whole.steps() + 12) * CELLS);
        whole.step(step - whole.steps()).unwrap();
        let state = saved(&whole);
        let mut resumed = opened(&scene, engine, gpu);
        resumed.load(&mut state.as_slice()).unwrap();
        assert!(saved(&resumed) == state, "a state that was read back is another");
        let mut straight = opened(&scene, engine, gpu);
        straight.load(&mut state.as_slice()).unwrap();
        resumed.step(4).unwrap();
        whole.step(4).unwrap();
        assert!(saved(&resumed) == saved(&whole), "from step {step} on it is another run");
        (0..4).for_each(|_| straight.step(1).unwrap());
        assert!(saved(&straight) == saved(&whole), "four steps are not four times one");
    }
}

pub fn a_table_of_one_value_gives_the_bits_of_the_value(
    engine: EngineName,
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
) {
    let [plain, table] = [false, true].map(|as_table| {
        let scene = scene(&constant(as_table));
        assert_eq!(scene.drives.is_some(), as_table);
        let mut engine = opened(&scene, engine, gpu);
        budget.spend(40 * CELLS);
        engine.step(40).unwrap();
        saved(&engine)
    });
    assert!(plain == table, "the state after 40 steps is another");
}
