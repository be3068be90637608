//! `stop.steady`: a run ends when its value is within the tolerance of the final one, however often rows are
//! taken.

use std::f64::consts::PI;

use crate::cli::runs::Until;
use crate::common::Budget;
use crate::scenes::{scene, water};
use psmrt::checkpoint;
use psmrt::engine::{EngineName, open};
use psmrt::output::folder::RunFolder;
use psmrt::run::steady::History;
use psmrt::run::{End, Watcher, run};
use psmrt::scene::{Interval, Scene};

/// Cells from plate to plate.
const GAP: f64 = 8.0;

/// Flow between plates from rest, driven by a body force, a row every `every` steps. The rates are those that
/// put the walls exactly half-way, so that the final flow is known to round-off.
fn channel(every: u64, tolerance: f64) -> Scene {
    let rest = format!(
        r#"
[collision]
rates = "magic"
magic = 0.1875
[faces]
y_low.kind = "wall"
y_high.kind = "wall"
[body_force]
acceleration = [0.02, 0.0, 0.0]
[[records]]
name = "b"
kind = "box"
every_steps = {every}
[stop]
steps = 20000
steady = {{ record = "b", column = "superficial_velocity_x", tolerance = {tolerance:e} }}
"#
    );
    scene(&water([1, 8, 1], 1e-4, &rest).replace("tau = 0.8", "tau = 0.6"))
}

struct GoOn;

impl Watcher for GoOn {
    fn watch(&mut self, _: u64, _: Option<f64>) -> bool {
        true
    }
}

/// Share of the mean velocity between plates that is missing `steps` after the start from rest:
/// `96/π⁴ Σ exp(-n² π² ν t/H²)/n⁴`, n odd (Batchelor 1967, section 4.3, integrated over the gap).
fn missing(steps: f64, nu: f64) -> f64 {
    let term = |n: f64| (-n * n * PI * PI * nu * steps / (GAP * GAP)).exp() / n.powi(4);
    96.0 / PI.powi(4) * (0..40).map(|i| term(f64::from(2 * i + 1))).sum::<f64>()
}

#[test]
fn a_channel_is_steady_within_the_tolerance_of_its_exact_flow_at_any_spacing_of_rows() {
    let mut budget = Budget::oracle(200_000);
    for tolerance in [1e-2, 1e-3, 1e-5] {
        for every in [1, 10, 100] {
            let scene = channel(every, tolerance);
            let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
            let folder = tempfile::tempdir().unwrap();
            let held = RunFolder::open(folder.path()).unwrap();
            let end = run(&scene, &mut engine, &held, None, &mut GoOn).unwrap();
            budget.spend(8 * engine.steps());
            let what = format!("tolerance {tolerance:e}, a row every {every} steps");
            assert!(matches!(end, End::Steady { .. }), "{what}: {end:?}");
            // Mean of G/(2ν) y (H - y) over the nodes y = 1/2, 3/2, ...: G/(2ν) (H²/6 + 1/12).
            let (nu, force) = (0.1 / 3.0, scene.setup.body_force.unwrap().x);
            let exact = force / (2.0 * nu) * (GAP * GAP / 6.0 + 1.0 / 12.0);
            let off = 1.0 - engine.box_means().mass_flux.x / exact;
            // Once: the estimate of an exponential approach is its rest, and it has to hold for a while.
            assert!(off.abs() <= tolerance, "{what}: {off:e} of the exact flow are missing");
            // And no run is much longer than it takes: one row to see it, an eighth of the time and a row to hold.
            let steps = engine.steps() as f64;
            let due = steps / (9.0 / 8.0) - 2.0 * every as f64 - 0.02 * steps;
            let was = missing(due, nu);
            assert!(
                was > tolerance,
                "{what}: {steps} steps; after {due} only {was:e} were missing"
            );
        }
    }
}

#[test]
fn a_run_that_is_cut_off_becomes_steady_at_the_same_step_with_the_same_rows() {
    let mut budget = Budget::oracle(40_000);
    // Rows at every third step: samples have been merged when it is cut off, and some rows wait to be.
    let mut scene = channel(3, 1e-3);
    // Sooner than a batch of steps.
    scene.checkpoint = Interval::Steps(100);
    let whole = |cuts: &[u64], budget: &mut Budget| {
        let folder = tempfile::tempdir().unwrap();
        for cut in cuts.iter().chain([&u64::MAX]) {
            let held = RunFolder::open(folder.path()).unwrap();
            let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
            let newest = checkpoint::list(folder.path()).unwrap().pop();
            let resumed =
                newest.map(|file| checkpoint::load(&file, &held, &scene, &mut engine).unwrap());
            let first = engine.steps();
            let end = run(&scene, &mut engine, &held, resumed.as_ref(), &mut Until(*cut)).unwrap();
            budget.spend(8 * (engine.steps() - first));
            if end != End::Interrupted {
                assert_eq!(*cut, u64::MAX, "steady too soon: {end:?}");
                let rows = std::fs::read(folder.path().join("b.csv")).unwrap();
                return (end, engine.steps(), rows);
            }
        }
        unreachable!("the last part is not cut off")
    };
    let uncut = whole(&[], &mut budget);
    assert!(uncut.1 > 1250, "{}: nothing has been merged", uncut.1);
    assert_eq!(whole(&[400, 1000, 1240], &mut budget), uncut, "cut off three times");
}

/// Values at `rows` equal steps of the time `end`.
fn values(rows: u32, end: f64, value: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=rows).map(|i| value(end * f64::from(i) / f64::from(rows))).collect()
}

#[test]
fn an_exponential_approach_has_its_rest_to_go() {
    for rows in [4, 31, 256, 257, 10_000] {
        for end in [0.1_f64, 1.0, 8.0] {
            let history = History::of(&values(rows, end, |t| 1.0 - (-t).exp()));
            let rest = (-end).exp() / (1.0 - (-end).exp());
            // Rows that make no new sample are not looked at: of 10,000 the last 16, 0.2 % of the time.
            let late = if rows > 256 { 128.0 / f64::from(rows) * end } else { 0.0 };
            let left = history.left().unwrap();
            let allowed = rest * (1.0 - 1e-9)..=rest * (2.0 * late).exp() * (1.0 + 1e-9);
            assert!(
                allowed.contains(&left),
                "{rows} rows to t = {end}: {left:e}, {rest:e} is right"
            );
        }
    }
}

#[test]
fn a_slow_approach_is_seen_behind_a_fast_one() {
    // A tenth goes a hundred times slower: when the fast part has gone, the rest is as good as all of that.
    let history =
        |end| History::of(&values(1000, end, |t| 1.0 - (-t).exp() - 0.1 * (-t / 100.0).exp()));
    for end in [14.0_f64, 20.0, 50.0] {
        let rest = 0.1 * (-end / 100.0).exp();
        let left = history(end).left().unwrap();
        assert!(left > 0.5 * rest && left < 2.0 * rest, "t = {end}: {left:e} of {rest:e}");
    }
}

#[test]
fn what_does_not_slow_down_is_far_from_steady() {
    let left = |value: fn(f64) -> f64| History::of(&values(500, 1.0, value)).left();
    assert_eq!(left(|t| t), Some(f64::INFINITY));
    assert_eq!(left(|t| 1.0 + 1e-6 * t * t), Some(f64::INFINITY));
    assert!(left(|t| 1.0 + 1e-6 * t).unwrap() > 1.0);
    // Nothing there is no steady flow, and four rows after the start are the fewest.
    assert_eq!(left(|_| 0.0), None);
    assert_eq!(History::of(&[0.0, 1.0, 1.0, 1.0]).left(), None);
    assert_eq!(History::of(&[0.0, 1.0, 1.0, 1.0, 1.0]).left(), Some(0.0));
}

#[test]
fn a_swing_is_as_unsteady_as_it_is_wide_and_rounding_is_no_unrest() {
    // Sound: two hundred swings, by a hundredth either way. Rows may be as far apart as two of them and more:
    // then they see a part of each.
    for rows in [37, 1000, 100_000] {
        let history = History::of(&values(rows, 1.0, |t| 1.0 + 0.01 * (400.0 * PI * t).sin()));
        let left = history.left().unwrap();
        assert!(left > 0.01 && left < 0.021, "{rows} rows: {left}");
    }
    // One that dies down: within its swing of now, and no further than it was a quarter ago.
    let history = |end| History::of(&values(1000, end, |t| 1.0 + (-t).exp() * (40.0 * t).sin()));
    let left = history(8.0).left().unwrap();
    assert!(left > (-8.0_f64).exp() && left < 2.0 * (-6.0_f64).exp(), "{left}");
    // The last digit of a value that has arrived.
    let noise = |i: u32| 1.0 + f64::EPSILON * f64::from(i * i % 7);
    let left = History::of(&(0..5000).map(noise).collect::<Vec<_>>()).left().unwrap();
    assert!(left < 7.0 * f64::EPSILON, "{left:e}");
}
