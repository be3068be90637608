//! What a run between two walls that move against each other says of the viscosity.

use psmrt::table::Table;

use crate::cli::{Folder, psmrt, stderr};
use crate::common::Budget;

#[test]
fn viscosity_of_a_mixture_is_the_stress_on_the_walls_over_the_shear_rate() {
    let mut budget = Budget::kernel(3_300_000);
    budget.spend(2 * 200 * 20 * 20 * 20);
    let folder = Folder::new("viscosity");
    let run = |name: &str, change: &str| {
        let out = folder.path(name);
        let asked = [
            "run",
            "golden/viscosity/scene.toml",
            "--json",
            "--set",
            "stop.steps=200",
            "--set",
            change,
            "--out",
            out.to_str().unwrap(),
        ];
        let output = psmrt(&asked);
        assert!(output.status.success(), "{}", stderr(&output));
        let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        found["run"]["conclusions"].as_array().unwrap().clone()
    };
    let concluded = run("sheared", "title=\"sheared\"");
    let found = concluded.iter().find(|found| found["what"] == "viscosity").unwrap();
    let number = |name: &str| found[name].as_f64().unwrap();
    let walls = Table::read(&folder.path("sheared/walls.csv")).unwrap();
    let last = |face: &str| {
        let forces = walls.with(&[("face", face)]).unwrap().numbers("fluid_force_x (N)").unwrap();
        *forces.last().unwrap()
    };
    // The scene: a cube of 2e-4 m, 1000 kg/m3, 1e-6 m2/s, 7.8125 1/s, a sphere of 8e-5 m that touches no wall.
    let stress = 0.5 * (last("z_low") - last("z_high")) / 2e-4_f64.powi(2);
    let relative = stress / (1000.0 * 1e-6 * 7.8125);
    let fraction = std::f64::consts::PI / 6.0 * 0.4_f64.powi(3);
    for (name, exact) in [
        ("relative_viscosity", relative),
        ("solid_fraction", fraction),
        ("intrinsic_viscosity", (relative - 1.0) / fraction),
        ("shear_rate_per_s", 7.8125),
        ("reynolds", 0.05),
    ] {
        // The table has fewer digits than the run.
        assert!((number(name) / exact - 1.0).abs() < 1e-6, "{name}: {}, {exact}", number(name));
    }
    // Walls that move together hold no shear.
    let concluded = run("dragged", "faces.z_low.velocity=[7.8125e-4, 0.0, 0.0]");
    assert!(concluded.iter().all(|found| found["what"] != "viscosity"), "{concluded:?}");
}
