//! Forces on a domain that nothing holds up: what a scene is warned of, what `gravity.balance` makes of it,
//! and that the columns of loads add up to the driving force.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::common::Budget;
use crate::scenes::{GRAVITY, free_sphere, read, scene, water};
use psmrt::advice::estimate::warnings;
use psmrt::engine::{EngineName, open};
use psmrt::output::loads::load_rows;
use psmrt_reference::coupling::Gravity;
use psmrt_reference::lattice::Vec3;

/// A grain in a cube that is periodic in all directions.
static FALLING: LazyLock<String> = LazyLock::new(|| {
    let grain = free_sphere("[8e-5, 8e-5, 8e-5]", "8e-5", "2650.0");
    water([16, 16, 16], 1e-5, &format!("{GRAVITY}{grain}[stop]\nsteps = 100\n"))
});

/// A simple-cubic array of fixed spheres that a body force drives.
static ARRAY: LazyLock<String> = LazyLock::new(|| {
    let rest = r#"
[body_force]
acceleration = [0.1, 0.0, 0.0]
[[grains]]
kind = "array"
lattice = "sc"
diameter = 6e-5
[stop]
steps = 100
"#;
    water([8, 8, 8], 1e-5, rest)
});

fn balanced() -> String {
    FALLING.replace("-9.81]", "-9.81]\nbalance = true")
}

#[test]
fn endless_falls_are_warned_of_and_others_are_not() {
    let without_grains =
        ARRAY.split("[[grains]]").next().unwrap().to_owned() + "[stop]\nsteps = 1\n";
    let sideways = FALLING.replace("[0.0, 0.0, -9.81]", "[0.0, 0.0, 0.0]");
    let walls = "[faces]\nx_low.kind = \"wall\"\nx_high.kind = \"wall\"\n";
    let mirrors = "[faces]\nz_low.kind = \"free_slip\"\nz_high.kind = \"free_slip\"\n";
    let fixed = "[[grains]]\nkind = \"sphere\"\ncentre = [8e-5, 8e-5, 2e-5]\ndiameter = 3e-5\n";
    let neutral = FALLING.replace("2650.0", "1000.0");
    for (what, text, falls) in [
        ("gravity on a grain", FALLING.to_owned(), true),
        ("a body force on fluid alone", without_grains, true),
        ("balanced gravity", balanced(), false),
        ("no gravity", sideways, false),
        ("a grain as dense as the fluid", neutral, false),
        ("walls along gravity", FALLING.to_owned() + walls, false),
        ("mirrors across gravity", FALLING.to_owned() + mirrors, false),
        ("a fixed grain", FALLING.to_owned() + fixed, false),
        ("an array of fixed grains", ARRAY.to_owned(), false),
    ] {
        let said: Vec<String> = warnings(&scene(&text))
            .into_iter()
            .filter(|warning| warning.reason.contains("no steady state"))
            .map(|warning| format!("{}; {}", warning.reason, warning.remedy))
            .collect();
        assert_eq!(!said.is_empty(), falls, "{what}: {said:?}");
        if what == "gravity on a grain" {
            assert!(said[0].contains("along z") && said[0].contains("balance = true"), "{said:?}");
        }
    }
}

#[test]
fn balance_is_a_body_force_of_the_net_weight_over_the_volume() {
    let scene = scene(&balanced());
    let part = scene.free.as_ref().unwrap();
    assert!(matches!(part.settings.gravity, Some(Gravity::Balanced { .. })));
    // (ρ_s/ρ_f - 1) times the solid fraction of a sphere half as wide as the cube, π/48, against gravity.
    let expected = Vec3::new(0.0, 0.0, 1.65 * PI / 48.0 * 9.81);
    let found = scene.setup.body_force.unwrap() * scene.units.si_acceleration();
    assert!((found - expected).norm() < 1e-12 * expected.norm(), "{found}, expected {expected}");
}

#[test]
fn balance_where_something_holds_up_the_grains_is_refused_with_a_remedy() {
    let walls = "[faces]\nx_low.kind = \"wall\"\nx_high.kind = \"wall\"\n";
    let mirrors = "[faces]\nz_low.kind = \"free_slip\"\nz_high.kind = \"free_slip\"\n";
    let fixed = "[[grains]]\nkind = \"sphere\"\ncentre = [8e-5, 8e-5, 2e-5]\ndiameter = 3e-5\n";
    let push = "[body_force]\nacceleration = [0.1, 0.0, 0.0]\n";
    for (text, words) in [
        (balanced() + walls, "-x"),
        (balanced() + mirrors, "-z"),
        (balanced() + fixed, "grains[1]"),
        (balanced() + push, "[body_force]"),
        (balanced().replace("balance", "form = \"body_force\"\nbalance"), "reduced"),
    ] {
        let message = read(&text).unwrap_err();
        assert!(message.contains("gravity.balance"), "{message}");
        assert!(message.contains(words) && message.contains("remove"), "{message}");
    }
    // Across gravity mirrors hold nothing up.
    let sides = "[faces]\nx_low.kind = \"free_slip\"\nx_high.kind = \"free_slip\"\n";
    assert!(read(&(balanced() + sides)).is_ok());
}

#[test]
fn force_and_displaced_force_of_a_record_of_loads_add_up_to_the_driving_force() {
    let mut budget = Budget::oracle(600_000);
    let scene = scene(&ARRAY);
    let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
    budget.spend(1000 * 512);
    engine.step(1000).unwrap();
    let rows = load_rows(&scene, &engine);
    let [force, displaced] = [11, 17].map(|column| rows.iter().map(|row| row[column]).sum::<f64>());
    // ρ a V of the whole domain, N
    let driving = 1000.0 * 0.1 * (8e-5_f64).powi(3);
    println!("force {force:.5e} N, displaced {displaced:.5e} N, driving {driving:.5e} N");
    // Steady to round-off after 60 times L²/(4 π² ν) (tests/oracle/momentum_balance.rs).
    assert!(((force + displaced) / driving - 1.0).abs() < 1e-9, "{force} + {displaced}: {driving}");
    assert!(displaced > 0.1 * driving && rows[0][18] == 0.0 && rows[0][19] == 0.0, "{rows:?}");
}
