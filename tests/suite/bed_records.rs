//! Records of a bed: its layers, the forces on its walls, its contacts.

use std::f64::consts::PI;
use std::fs;

use crate::cli::{Folder, psmrt, stderr};
use crate::common::Budget;
use crate::scenes::{FLOOR_AND_LID, GRAVITY, free_sphere, scene, water};
use psmrt::engine::{Coupled, EngineName, open};
use psmrt::output::layers::{self, share};
use psmrt::output::records::box_row;
use psmrt::output::{contacts, walls};
use psmrt::scene::Scene;
use psmrt_reference::lattice::Vec3;

/// After so many steps on the oracle.
fn run(text: &str, steps: u64, budget: &mut Budget) -> (Scene, Coupled) {
    run_on(EngineName::Reference, text, steps, budget)
}

fn run_on(engine: EngineName, text: &str, steps: u64, budget: &mut Budget) -> (Scene, Coupled) {
    let scene = scene(text);
    let mut engine = open(engine, &scene, None, false).unwrap();
    budget.spend(steps * scene.setup.domain.cell_count() as u64);
    engine.step(steps).unwrap();
    (scene, engine)
}

const DX: f64 = 1e-4;
/// Diameter of a grain, and its weight less its buoyancy: 1000 kg/m³ more than water.
const D: f64 = 8.0 * DX;
const WEIGHT: f64 = 1000.0 * 9.81 * PI / 6.0 * D * D * D;
const GRAINS: usize = 4;
/// Cells along each side of the column's domain, and its area.
const SIDE: usize = 10;
const AREA: f64 = (SIDE * SIDE) as f64 * DX * DX;
/// So stiff that a weight makes an overlap of a ten-thousandth of a diameter.
const STIFFNESS: f64 = WEIGHT / (1e-4 * D);

/// Grains on top of one another, each pressed into what is below by the weight of those above, in still water.
fn column() -> String {
    let mut text = format!(
        "{FLOOR_AND_LID}{GRAVITY}[contact]\nstiffness = {STIFFNESS:e}\n\
         [[records]]\nname = \"layers\"\nkind = \"layers\"\naxis = \"z\"\nlayers = 5\n\
         [[records]]\nname = \"walls\"\nkind = \"walls\"\n[[records]]\nname = \"means\"\nkind = \"contact_means\"\n\
         [[records]]\nname = \"contacts\"\nkind = \"contacts\"\n[stop]\nsteps = 2\n"
    );
    let mut height = 0.0;
    for below in 0..GRAINS {
        let overlap = (GRAINS - below) as f64 * WEIGHT / STIFFNESS;
        height += if below == 0 { 0.5 * D } else { D } - overlap;
        let middle = 0.5 * SIDE as f64 * DX;
        let centre = format!("[{middle:e}, {middle:e}, {height:e}]");
        text += &free_sphere(&centre, &format!("{D:e}"), "2000.0");
    }
    water([SIDE, SIDE, 40], DX, &text)
}

#[test]
fn effective_stress_of_a_column_at_rest_is_the_weight_above_over_the_area() {
    let mut budget = Budget::oracle(45_000);
    let (scene, engine) = run(&column(), 10, &mut budget);
    // In a layer as high as a grain the contact at its middle bears those above and this one over its lower half, those above over
    // its upper one: the mean of n + 1 and n weights.
    for (layer, row) in layers::rows(&scene, &engine, 2, 5).iter().enumerate() {
        let above = GRAINS as f64 - layer as f64 - 0.5;
        let expected = if above > 0.0 { above * WEIGHT / AREA } else { 0.0 };
        let [.., x, y, z] = *row;
        // Overlaps move the contacts by up to a thousandth of a layer; in 10 steps the pores give way by less.
        assert!(
            (z - expected).abs() < 5e-3 * WEIGHT / AREA,
            "layer {layer}: {z} Pa along the column, {expected} is right"
        );
        assert!(x.abs().max(y.abs()) < 1e-9 * WEIGHT / AREA, "layer {layer}: {x}, {y} across it");
        let (grains, coordination) = (row[8], row[9]);
        let expected = match layer {
            4 => (0.0, 0.0),
            3 => (1.0, 1.0),
            _ => (1.0, 2.0),
        };
        assert_eq!((grains, coordination), expected, "layer {layer}: grains, contacts of each");
    }
}

#[test]
fn floor_bears_the_submerged_weight_of_the_column_and_contacts_are_its_branches() {
    let mut budget = Budget::oracle(45_000);
    let (scene, engine) = run(&column(), 10, &mut budget);
    let forces = walls::forces(&scene, &engine);
    assert_eq!(forces.iter().map(|f| f.face).collect::<Vec<_>>(), ["z_low", "z_high"]);
    let floor = forces[0].grains[2];
    assert!(
        (floor / WEIGHT + GRAINS as f64).abs() < 5e-3,
        "{floor} N on the floor, -4 weights of {WEIGHT} N are right"
    );
    assert_eq!(forces[1].grains, [0.0; 3], "nothing touches the lid");
    let row = contacts::row(&scene, &engine);
    let (count, coordination, normal) = (row[0], row[1], row[2]);
    // Three contacts of two and one with the floor: 7 ends of 4 grains; 1, 2 and 3 weights.
    assert_eq!((count, coordination), (3.0, 1.75));
    assert!((normal / WEIGHT - 2.0).abs() < 5e-3, "{normal} N, mean of 1 to 3 times {WEIGHT} N");
    assert_eq!(&row[3..9], &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], "all normals are vertical");
    // Of the whole domain, 5 d high: Σ F l = W (4/2 + 3 + 2 + 1) d.
    let expected = 8.0 * WEIGHT * D / (AREA * 5.0 * D);
    assert!((row[11] / expected - 1.0).abs() < 5e-3, "{} Pa, {expected} Pa is right", row[11]);
}

#[test]
fn branches_are_shared_among_the_layers_that_they_cross() {
    assert_eq!(share([1.0, 4.0], [0.0, 2.0], None), 1.0 / 3.0);
    assert_eq!(share([4.0, 1.0], [2.0, 9.0], None), 2.0 / 3.0);
    // Across a periodic side, either way.
    assert_eq!(share([9.0, 11.0], [0.0, 5.0], Some(10.0)), 0.5);
    assert_eq!(share([1.0, -3.0], [5.0, 10.0], Some(10.0)), 0.75);
}

#[test]
fn layers_of_an_array_have_its_porosity_its_gradient_and_the_velocity_of_its_pores() {
    let mut budget = Budget::kernel(1_200_000);
    let rest = "[body_force]\nacceleration = [0.0, 0.0, 0.01]\n[initial]\nvelocity = [0.0, 0.0, 1e-3]\n\
                [[grains]]\nkind = \"sphere\"\ncentre = [5e-4, 5e-4, 5e-4]\ndiameter = 6.8e-4\n\
                [solid]\noperator = \"bounce_back\"\n[stop]\nsteps = 2\n";
    let (scene, engine) =
        run_on(EngineName::Cpu, &water([10, 10, 10], DX, rest), 1000, &mut budget);
    let superficial = box_row(&scene, &engine)[3];
    assert!(superficial > 1e-5, "{superficial} m/s: it flows");
    let [row] = layers::rows(&scene, &engine, 2, 1)[..] else { panic!("one layer") };
    let porosity = 1.0 - PI / 6.0 * (6.8_f64 / 10.0).powi(3);
    assert!((row[2] - porosity).abs() < 1e-12, "porosity {}, {porosity} is exact", row[2]);
    assert!((row[4] - 0.01 / 9.81).abs() < 1e-14, "gradient {}, G/(rho g) is right", row[4]);
    // What flows in cut cells is told apart from what the grain holds back by their shares alone: they are a third of the cells, and
    // slow; what the full cells started with does not count.
    let found = row[7] * porosity / superficial;
    assert!((found - 1.0).abs() < 0.1, "velocity times porosity is {found} of the superficial one");
    assert!(row[5].abs().max(row[6].abs()) < 1e-9 * superficial, "nothing flows across");
    // By symmetry the first layer is as the last.
    let rows = layers::rows(&scene, &engine, 2, 5);
    assert!((rows[0][7] / rows[4][7] - 1.0).abs() < 1e-2, "{} and {} m/s", rows[0][7], rows[4][7]);
}

#[test]
fn pressure_falls_by_the_same_gradient_in_every_layer_of_a_channel_between_two_heads() {
    let mut budget = Budget::kernel(1_000_000);
    // 1e-3 Pa over 2 mm, developed at both ends.
    let rest = "[faces]\ny_low.kind = \"wall\"\ny_high.kind = \"wall\"\nz_low = { kind = \"pressure\", pressure = 1e-3, developed = true }\n\
                z_high = { kind = \"pressure\", pressure = 0.0, developed = true }\n[stop]\nsteps = 2\n";
    let (scene, engine) = run_on(EngineName::Cpu, &water([2, 6, 20], DX, rest), 4000, &mut budget);
    let expected = 1e-3 / 2e-3 / (1000.0 * 9.81);
    for (layer, row) in layers::rows(&scene, &engine, 2, 5).iter().enumerate() {
        let found = row[4] / expected;
        // A drop of 3e-10 of the reference pressure: the error is the flow's way to steadiness.
        assert!(
            (found - 1.0).abs() < 1e-3,
            "layer {layer}: {found} of the gradient between the heads"
        );
    }
}

#[test]
fn walls_of_a_channel_bear_the_force_that_drives_it() {
    let mut budget = Budget::kernel(250_000);
    let rest = format!(
        "{FLOOR_AND_LID}[body_force]\nacceleration = [0.01, 0.0, 0.0]\n[stop]\nsteps = 2\n"
    );
    let (scene, engine) = run_on(EngineName::Cpu, &water([4, 3, 8], DX, &rest), 2000, &mut budget);
    // G V: half of it at each wall.
    let driving = 1000.0 * 0.01 * 96.0 * DX * DX * DX;
    for forces in walls::forces(&scene, &engine) {
        let found = forces.fluid[0] / driving;
        assert!((found - 0.5).abs() < 1e-9, "{}: {found} of the driving force", forces.face);
        assert!(forces.fluid[1].abs() < 1e-12 * driving);
    }
}

#[test]
fn plates_of_a_couette_flow_are_dragged_by_its_shear_stress() {
    let mut budget = Budget::kernel(250_000);
    let rest = "[faces]\nz_low.kind = \"wall\"\nz_high = { kind = \"wall\", velocity = [1e-3, 0.0, 0.0] }\n\
                [stop]\nsteps = 2\n";
    let (scene, engine) = run_on(EngineName::Cpu, &water([4, 3, 8], DX, rest), 2000, &mut budget);
    // μ U/H A: forwards on the plate at rest, backwards on the other
    let drag = 1e-3 * 1e-3 / (8.0 * DX) * 12.0 * DX * DX;
    let [low, high] = walls::forces(&scene, &engine)[..] else { panic!("two walls") };
    for (face, found, expected) in [("still", low.fluid[0], drag), ("moving", high.fluid[0], -drag)]
    {
        // The plate moves by U = 0.01 cells a step: compressibility changes it by a share of U² = 1e-4.
        assert!(
            (found / expected - 1.0).abs() < 1e-5,
            "{face} plate: {found} N, {expected} N is exact for a linear profile"
        );
    }
    for forces in [low, high] {
        assert!(forces.fluid[2].abs() < 1e-3 * drag, "no more pressure than the reference's");
    }
}

#[test]
fn still_water_exerts_nothing_on_the_faces_and_edges_of_a_box() {
    let faces = "[faces]\nx_low.kind = \"wall\"\nx_high.kind = \"free_slip\"\ny_low.kind = \"wall\"\n\
                 y_high.kind = \"wall\"\nz_low.kind = \"free_slip\"\nz_high.kind = \"pressure\"\nz_high.pressure = 0.0\n\
                 [stop]\nsteps = 2\n";
    let mut budget = Budget::oracle(2_000);
    let (scene, engine) = run(&water([5, 4, 3], DX, faces), 2, &mut budget);
    let forces = walls::forces(&scene, &engine);
    assert_eq!(forces.len(), 6);
    // Rounding of a few populations a cell, in units of the pressure of the reference density.
    let unit = scene.units.si_force();
    for f in &forces[..5] {
        let most = Vec3::from(f.fluid).amax() / unit;
        assert!(most < 1e-13, "{}: {most} at rest", f.face);
    }
    assert!(forces[5].fluid.iter().all(|f| f.is_nan()), "water flows through a pressure face");
}

#[test]
fn tables_and_the_network_of_contacts_are_written_and_the_scene_says_what_it_records() {
    let mut budget = Budget::oracle(9_000);
    let folder = Folder::new("bed_records");
    let file = folder.write("scene.toml", column());
    let out = folder.path("out");
    budget.spend(2 * (SIDE * SIDE * 40) as u64);
    let output = psmrt(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    assert_eq!(read("layers.csv").lines().count(), 1 + 5);
    let floor = read("walls.csv");
    let floor = floor.lines().nth(1).unwrap();
    assert_eq!(floor.split(',').nth(2), Some("z_low"), "{floor}");
    assert_eq!(read("means.csv").lines().count(), 2);
    assert!(read("layers.svg").contains("effective stress z"));
    let bytes = fs::read(out.join("contacts/contacts_000000000002.vtp")).unwrap();
    let head = String::from_utf8_lossy(&bytes);
    assert!(
        head.contains("NumberOfPoints=\"8\"") && head.contains("NumberOfLines=\"4\""),
        "{head:.300}"
    );
    assert!(read("contacts.pvd").contains("contacts_000000000002.vtp"));
}

#[test]
fn layers_and_walls_are_the_same_on_the_cpu_engine() {
    let mut budget = Budget::oracle(60_000);
    let text = stream_past_a_sphere();
    let (scene, oracle) = run(&text, 50, &mut budget);
    let mut engine = open(EngineName::Cpu, &scene, None, false).unwrap();
    engine.step(50).unwrap();
    let close = |found: f64, expected: f64, scale: f64, what: &str| {
        // Round-off of two programs over fifty steps.
        assert!((found - expected).abs() <= 1e-9 * scale, "{what}: cpu {found}, oracle {expected}");
    };
    for axis in 0..3 {
        let pairs = layers::rows(&scene, &engine, axis, 4).into_iter();
        for (found, expected) in pairs.zip(layers::rows(&scene, &oracle, axis, 4)) {
            close(found[3], expected[3], 0.1, "pressure");
            close(found[5], expected[5], 1e-3, "velocity");
        }
    }
    for (found, expected) in
        walls::forces(&scene, &engine).iter().zip(walls::forces(&scene, &oracle))
    {
        for (found, expected) in found.fluid.iter().zip(expected.fluid) {
            close(*found, expected, 1e-9, "force");
        }
    }
}

/// A sphere in a stream between a wall, a mirror plane and a lid.
fn stream_past_a_sphere() -> String {
    let rest = "[faces]\ny_low.kind = \"wall\"\ny_high.kind = \"free_slip\"\nz_low.kind = \"wall\"\n\
                z_high = { kind = \"wall\", velocity = [1e-3, 0.0, 0.0] }\n\
                [body_force]\nacceleration = [0.01, 0.0, 0.0]\n[[grains]]\nkind = \"sphere\"\n\
                centre = [5e-4, 4e-4, 5e-4]\ndiameter = 5e-4\n[solid]\noperator = \"bounce_back\"\n[stop]\nsteps = 2\n";
    water([10, 9, 10], DX, rest)
}
