//! Permeability: the record's values against geometry, Darcy's law and each other, and what it refuses.

use std::f64::consts::PI;
use std::path::Path;

use crate::common::Budget;
use crate::scenes::{changed, water};
use psmrt::advice::estimate::numbers;
use psmrt::engine::{EngineName, open};
use psmrt::output::records::{box_row, seepage_now};
use psmrt::scene::columns::PERMEABILITY_COLUMNS;
use psmrt::scene::{Scene, What};
use psmrt::seepage::laws::BED_LAWS;
use psmrt::seepage::permeability::Seepage;
use psmrt::table::Table;

#[test]
fn laws_of_beds_give_what_was_computed_apart_from_them() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/seepage/literature.csv");
    let table = Table::read(Path::new(path)).unwrap();
    let [phi, re] = ["solid_fraction", "Re"].map(|name| table.numbers(name).unwrap());
    for law in &BED_LAWS {
        for (i, expected) in table.numbers(law.column).unwrap().into_iter().enumerate() {
            if re[i] > 0.0 {
                let found = (law.psi_re)(phi[i], re[i]);
                // Six printed digits of psi Re, and four of Re.
                let error = (found / expected - 1.0).abs();
                let (name, phi, re) = (law.name, phi[i], re[i]);
                assert!(error < 1e-4, "{name}: {found} at {phi}, {re}: {expected}");
            }
        }
    }
}

#[test]
fn laws_of_beds_go_on_to_no_flow_at_all() {
    // Kozeny and Carman: k/d² = ε³/(180 (1 - ε)²), at 0.4 by hand 0.064/64.8.
    assert!((BED_LAWS[2].permeability(0.4, 0.0) / (0.064 / 64.8) - 1.0).abs() < 1e-12);
    // Beetstra's and Tang's share F₀ = 10 φ/(1-φ)² + (1-φ)² (1 + 1.5 √φ) there, at 0.6 by hand 37.5 + 0.3459.
    let drag = 37.5 + 0.16 * (1.0 + 1.5 * 0.6_f64.sqrt());
    // k/d² = ε/(18 φ F₀) with F₀ the drag without the pressure gradient's part, over ε once more.
    let by_hand = 0.4 * 0.4 / (18.0 * 0.6 * drag) / 0.4;
    for law in [&BED_LAWS[3], &BED_LAWS[4]] {
        let found = law.permeability(0.4, 0.0);
        assert!((found / by_hand - 1.0).abs() < 1e-6, "{}: {found}, {by_hand}", law.name);
    }
}

/// Spheres of 7 cells in simple cubic order, 8 cells apart: `layers` of them along z, with `clear` cells of water below
/// and above; `more` drives the water.
fn column(layers: usize, clear: usize, more: &str) -> String {
    let grains: Vec<String> = (0..layers)
        .map(|layer| {
            let z = (clear as f64 + 8.0 * layer as f64 + 4.0) * 1e-5;
            format!("{{ kind = \"sphere\", centre = [4e-5, 4e-5, {z:e}], diameter = 7e-5 }}")
        })
        .collect();
    let grains = grains.join(", ");
    format!(
        "grains = [{grains}]\n{}[[records]]\nname = \"k\"\nkind = \"permeability\"\n",
        water([8, 8, 8 * layers + 2 * clear], 1e-5, more)
    )
}

const FORCE: &str = "[body_force]\nacceleration = [0.0, 0.0, 1.0]\n[stop]\nsteps = 1\n";

const FACES: &str = "[faces]\nz_low = { kind = \"pressure\", pressure = 0.5 }\n\
                     z_high = { kind = \"pressure\", pressure = 0.0 }\n[stop]\nsteps = 1\n";

fn after(text: &str, steps: u64, name: EngineName, budget: &mut Budget) -> (Scene, Seepage, f64) {
    let scene = changed(text, &[]);
    let mut engine = open(name, &scene, None, false).unwrap();
    budget.spend(steps * scene.setup.domain.cell_count() as u64);
    engine.step(steps).unwrap();
    let What::Permeability { axis, si_gravity } = scene.records[0].what else { panic!() };
    assert_eq!(axis, 2, "the only axis of the flow is found");
    let found = seepage_now(&scene, &engine, (axis, si_gravity));
    let [_, _, _, flux, _] = box_row(&scene, &engine);
    (scene, found, flux)
}

#[test]
fn porosity_is_that_of_the_bed_and_not_of_the_water_above_it() {
    let mut budget = Budget::kernel(10_000);
    // Six grains of 7 cells in 8 x 8 x 48 cells, by hand.
    let solid = 6.0 * PI / 6.0 * 343.0;
    for (clear, text) in [(0, column(6, 0, FORCE)), (8, column(6, 8, FORCE))] {
        let (scene, found, _) = after(&text, 1, EngineName::Cpu, &mut budget);
        let [low, high] = found.si_reach.map(|place| place / scene.units.si_dx);
        // The ends of an ordered bed are known to the gap between its layers, a cell.
        let bottom = clear as f64;
        assert!(
            (low - bottom).abs() <= 1.0 && (high - bottom - 48.0).abs() <= 1.0,
            "{low}, {high}"
        );
        let by_hand = 1.0 - solid / 64.0 / (high - low);
        assert!((found.porosity - by_hand).abs() < 1e-3, "{} and {by_hand}", found.porosity);
        assert!((found.si_diameter / 7e-5 - 1.0).abs() < 1e-12, "{}", found.si_diameter);
    }
    // A single sphere is no bed: the whole domain is.
    let (_, found, _) = after(&column(1, 8, FORCE), 1, EngineName::Cpu, &mut budget);
    assert_eq!(found.si_reach[0], 0.0);
    assert!((found.porosity - (1.0 - solid / 6.0 / 64.0 / 24.0)).abs() < 1e-12);
}

#[test]
fn permeability_is_one_number_whatever_drives_the_flow_and_however_much_water_lies_above() {
    let mut budget = Budget::kernel(22_000_000);
    let mut k = |text: &str, steps| {
        let (_, found, flux) = after(text, steps, EngineName::Cpu, &mut budget);
        // Darcy's law and the units, from the outside.
        let darcy = 1e-6 * 1000.0 * flux / found.si_gradient;
        assert!((found.si_permeability() / darcy - 1.0).abs() < 1e-12);
        let row = found.row();
        let value = |name: &str| {
            row[PERMEABILITY_COLUMNS.iter().position(|column| column.name == name).unwrap()]
        };
        assert!((value("permeability_darcy") * 9.869_233e-13 / darcy - 1.0).abs() < 1e-6);
        assert!((value("hydraulic_conductivity") / (darcy * 9.81e6) - 1.0).abs() < 1e-12);
        assert!((value("hydraulic_gradient") * 9810.0 / found.si_gradient - 1.0).abs() < 1e-12);
        let (d, phi) = (7e-5, 1.0 - found.porosity);
        assert!((value("k_over_d2") * d * d / darcy - 1.0).abs() < 1e-9);
        let re = flux * d / 1e-6 / phi;
        assert!((value("reynolds") / re - 1.0).abs() < 1e-9);
        // psi Re = d² ε³/(k φ²)
        let psi_re = d * d * found.porosity.powi(3) / darcy / phi / phi;
        assert!((value("psi") * value("reynolds") / psi_re - 1.0).abs() < 1e-9);
        darcy
    };
    let periodic = k(&column(6, 0, FORCE), 1500);
    let below_water = k(&column(6, 8, FORCE), 1500);
    let between_faces = k(&column(6, 8, FACES), 1500);
    let full = k(&column(6, 0, FACES), 1500);
    // The length of the bed is known to a cell at each end of 48, and the flow finds its way into the bed within a gap.
    let bound = 0.06;
    for (what, other) in [("water above", below_water), ("faces", between_faces), ("full", full)] {
        assert!((other / periodic - 1.0).abs() < bound, "{what}: {other:e}, periodic {periodic:e}");
    }
    // What drives the flow through the same bed under the same water is one thing: the two differ in what the water
    // outside loses, and in compressibility, a density of 4e-5 above the mean.
    assert!((between_faces / below_water - 1.0).abs() < 0.01, "{between_faces:e}, {below_water:e}");
}

#[test]
fn permeability_is_refused_where_nothing_flows_through_a_bed_at_rest() {
    let one = |faces: &str, force: &str, grain: &str, record: &str| {
        let grain = match grain {
            "" => String::new(),
            more => format!(
                "[[grains]]\nkind = \"sphere\"\ncentre = [4e-5, 4e-5, 4e-5]\ndiameter = 6e-5\n{more}\n"
            ),
        };
        water(
            [8, 8, 8],
            1e-5,
            &format!(
                "{faces}{force}{grain}[[records]]\nname = \"k\"\nkind = \"permeability\"\n{record}\n[stop]\nsteps = 1\n"
            ),
        )
    };
    let lid = "[faces]\nz_low.kind = \"wall\"\nz_high.kind = \"wall\"\n";
    let force = |to: &str| format!("[body_force]\nacceleration = [{to}]\n");
    let [along_x, along_z, both] = ["1.0, 0.0, 0.0", "0.0, 0.0, 1.0", "1.0, 0.0, 1.0"].map(force);
    let (fixed, free) = ("\n", "motion = \"free\"\ndensity = 2650.0");
    let cases = [
        (one("", &along_x, "", ""), "records[0].kind", "no grains"),
        (one("", "", fixed, ""), "records[0].kind", "no flow goes through the domain"),
        (one(lid, &along_z, fixed, ""), "records[0].kind", "faces.z_low lets no fluid through"),
        (one(lid, &along_x, fixed, "axis = \"z\""), "records[0].axis", "faces.z_low lets no fluid"),
        (
            one("", &along_x, fixed, "axis = \"y\""),
            "records[0].axis",
            "y is periodic and has no body",
        ),
        (one("", &both, fixed, ""), "records[0].axis", "driven along x and z"),
        (one("", &along_x, free, ""), "records[0].kind", "go with the flow"),
        (
            one("", &along_x, "motion = \"prescribed\"\nvelocity = [1e-4, 0.0, 0.0]", ""),
            "records[0].kind",
            "grain 0 moves as prescribed",
        ),
        (one("", &along_x, fixed, "point = [0.0, 0.0, 0.0]"), "records[0].point", "applies to"),
    ];
    for (text, key, said) in cases {
        let error = Scene::from_bytes("scene.toml", text.clone().into_bytes(), Path::new(""), &[]);
        let error = error.expect_err(&text);
        assert!(error.key == key && error.problem.contains(said), "{error}\n{text}");
    }
    let good = one(lid, &along_x, fixed, "");
    assert!(Scene::from_bytes("scene.toml", good.into_bytes(), Path::new(""), &[]).is_ok());
}

fn told(scene: &Scene, name: &str) -> Option<f64> {
    numbers(scene).into_iter().find(|number| number.name == name).map(|number| number.value)
}

#[test]
fn check_foretells_gradient_reynolds_number_and_terzaghis_ratio_of_a_bed() {
    // Free grains on a face that lets water in from below, 10 Pa above the top: by hand i = 10/(ρ g L_bed).
    let text = column(6, 8, FACES)
        .replace("pressure = 0.5", "pressure = 10.0")
        .replace("diameter = 7e-5 }", "diameter = 7e-5, motion = \"free\", density = 2650.0 }");
    let text = format!("gravity = {{ acceleration = [0.0, 0.0, -9.81] }}\n{text}");
    let scene = changed(&text, &["time.tau=1.0"]);
    let layer = told(&scene, "hydraulic gradient").unwrap();
    let by_hand = 10.0 / (9810.0 * 48e-5);
    // The bed's length is known to a cell at each end of 48.
    assert!((layer / by_hand - 1.0).abs() < 0.05, "{layer}, {by_hand}");
    let solid = PI / 6.0 * 343.0 / 512.0;
    let critical = 1.65 * solid;
    let ratio = told(&scene, "i over i_c").unwrap();
    assert!((ratio / (layer / critical) - 1.0).abs() < 0.05, "{ratio}, {}", layer / critical);
    // With the flow nothing lifts the bed.
    let down = changed(&text, &["time.tau=1.0", "gravity.acceleration=[0.0, 0.0, 9.81]"]);
    assert_eq!(told(&down, "i over i_c"), None);
    // Periodic, slow: U = k a/ν, with k by the law, and Re = U d/(ν (1 - n)).
    let scene = changed(&column(6, 0, FORCE), &[]);
    let k = BED_LAWS[3].permeability(1.0 - solid, 0.0) * 49e-10;
    let re = k / 1e-6 * 7e-5 / 1e-6 / solid;
    let found = told(&scene, "Re of the bed").unwrap();
    // Inertia takes off a few per mille at Re of 0.1.
    assert!((found / re - 1.0).abs() < 0.02, "{found}, {re}");
    // No bed, no numbers.
    let scene = changed(&column(1, 16, FORCE), &[]);
    assert_eq!(told(&scene, "hydraulic gradient"), None);
}

#[test]
fn a_bed_is_steady_about_when_check_says() {
    let mut budget = Budget::kernel(20_000_000);
    for text in [column(6, 0, FORCE), column(6, 8, FACES)] {
        let text =
            text.replace("kind = \"permeability\"\n", "kind = \"permeability\"\nevery_steps = 5\n");
        let scene = changed(&text, &[]);
        let steps = told(&scene, "time to steadiness").unwrap() / scene.units.si_dt;
        let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
        let mut flux = |steps: f64| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "hundreds")]
            let steps = steps as u64;
            budget.spend(steps * scene.setup.domain.cell_count() as u64);
            engine.step(steps).unwrap();
            box_row(&scene, &engine)[3]
        };
        let [early, then, late] = [flux(0.1 * steps), flux(0.9 * steps), flux(steps)];
        // 1e-4 of the slowest known mode is left; a rate that is off by a factor of two leaves the root of that, 1e-2.
        assert!(
            (then / late - 1.0).abs() < 1e-2,
            "{then:e} after {steps} steps, {late:e} after twice"
        );
        // And not long before.
        assert!((early / late - 1.0).abs() > 1e-4, "{early:e} after a tenth of {steps}: {late:e}");
    }
}
