//! Scenes with free grains: what the keys become, what holds grains back, what a checkpoint keeps.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::common::Budget;
use crate::scenes::{saved, scene, three_grains};
use psmrt::engine::{EngineName, open};
use psmrt::output::grain_means;
use psmrt::scene::{FreePart, Scene};
use psmrt_reference::coupling::{Gravity, InternalFluid};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::motion::Substeps;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;

/// Three grains, of which one is held and one is led, in a box of all kinds of faces.
static SCENE: LazyLock<String> = LazyLock::new(|| {
    three_grains(
        r#"
[contact]
duration = 2e-4
restitution = 0.7
friction = 0.3
tangential_ratio = 0.25
rolling_resistance = 0.1
[coupling]
average_loads = true
"#,
    )
});

fn part(text: &str) -> (Scene, FreePart) {
    let scene = scene(text);
    let part = scene.free.clone().unwrap();
    (scene, part)
}

/// Equal up to round-off of a few operations.
fn assert_close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-12 * wanted.abs(), "{found} instead of {wanted}");
}

#[test]
fn keys_in_si_units_become_the_law_that_they_describe() {
    let (scene, part) = part(&SCENE);
    let units = &scene.units;
    // Mass of the free grain, kg, and what two of them and a wall must do.
    let mass = 2500.0 * PI / 6.0 * 2e-4_f64.powi(3);
    assert_close(part.grains[0].mass * units.si_mass(), mass);
    let law = *part.setup.law.linear().unwrap();
    let (pair, one) = (0.5 * part.grains[0].mass, part.grains[0].mass);
    assert_close(law.duration(pair) * units.si_dt, 2e-4);
    assert_close(law.restitution(pair), 0.7);
    let wall = part.planes.iter().find(|plane| plane.normal.z == 1.0).unwrap().law;
    let wall = *wall.linear().unwrap();
    assert_close(wall.stiffness, law.stiffness);
    assert_close(wall.restitution(one), 0.7);
    let friction = law.friction.unwrap();
    assert_close(friction.coefficient, 0.3);
    assert_close(friction.stiffness, 0.25 * law.stiffness);
    assert_close(law.rolling.unwrap().coefficient, 0.1);
    let Some(Gravity::Reduced { acceleration }) = part.settings.gravity else { panic!() };
    assert_close(acceleration.z * units.si_acceleration(), -9.81);
    assert!(part.settings.average_loads);
    assert_eq!(part.settings.internal_fluid, InternalFluid::Lagged);
    assert_eq!(scene.setup.body_force, None);
    // Stiffness by itself: N/m.
    let direct =
        SCENE.replace("duration = 2e-4\nrestitution = 0.7", "stiffness = 3.0\ndamping = 1e-6");
    let law = *self::part(&direct).1.setup.law.linear().unwrap();
    assert_close(law.stiffness * units.si_stiffness(), 3.0);
    assert_close(law.damping * units.si_damping(), 1e-6);
}

#[test]
fn without_a_contact_section_contacts_last_ten_steps() {
    let start = SCENE.find("[contact]").unwrap();
    let end = SCENE.find("[stop]").unwrap();
    let (_, part) = part(&format!("{}{}", &SCENE[..start], &SCENE[end..]));
    let law = *part.setup.law.linear().unwrap();
    let pair = 0.5 * part.grains[0].mass;
    assert_close(law.duration(pair), 10.0);
    assert_close(law.restitution(pair), 0.5);
    assert_close(law.friction.unwrap().coefficient, 0.5);
    assert_eq!((law.rolling, part.setup.lubrication), (None, None));
    assert_eq!(part.setup.substeps, Substeps::Automatic);
    assert!(!part.settings.average_loads);
}

#[test]
fn gravity_as_a_body_force_acts_on_the_fluid_too() {
    let text = SCENE.replace("-9.81]", "-9.81]\nform = \"body_force\"");
    let driven = text.clone() + "[body_force]\nacceleration = [1.0, 0.0, 0.0]\n";
    for (text, along_x) in [(text, 0.0), (driven, 1.0)] {
        let (scene, part) = part(&text);
        let force = scene.setup.body_force.unwrap() * scene.units.si_acceleration();
        assert!((force - Vec3::new(along_x, 0.0, -9.81)).norm() < 1e-12, "{force}");
        assert!(matches!(part.settings.gravity, Some(Gravity::OnFluidToo { .. })));
    }
}

#[test]
fn all_faces_but_periodic_ones_hold_free_grains_back() {
    let (_, part) = part(&SCENE);
    let normals: Vec<_> = part.planes.iter().map(|plane| <[f64; 3]>::from(plane.normal)).collect();
    let wanted = [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    assert_eq!(normals, wanted);
    assert_eq!(part.setup.sides.lengths, [Some(20.0), None, None]);
    // The mirror is smooth, the sieve and the walls are not, and one wall moves.
    let smooth: Vec<_> =
        part.planes.iter().map(|plane| plane.law.linear().unwrap().friction.is_none()).collect();
    assert_eq!(smooth, [true, false, false, false]);
    assert!(part.planes[3].velocity.x > 0.0 && part.planes[2].velocity.x == 0.0);
}

#[test]
fn a_mirror_plane_acts_on_a_grain_as_its_mirror_image_does() {
    // The pair is symmetric, so that both do the same operations up to factors of 2.
    mirror_plane_acts_as_the_image(&part(&SCENE).1, 1e-12);
}

/// A grain that spins falls onto the first plane, a mirror plane at y = 0, and onto its own image. `rounding`: by how much both may
/// differ.
pub(super) fn mirror_plane_acts_as_the_image(part: &FreePart, rounding: f64) {
    let grain = Grain { held: false, position: Vec3::new(8.0, 2.51, 8.0), ..part.grains[0] }
        .moving(Vec3::new(0.01, -0.03, 0.005))
        .spinning(Vec3::new(0.002, 0.0, -0.003));
    let image = Grain {
        position: Vec3::new(8.0, -2.51, 8.0),
        velocity: Vec3::new(0.01, 0.03, 0.005),
        angular_velocity: Vec3::new(-0.002, 0.0, 0.003),
        ..grain
    };
    let system = |grains, planes| GrainSystem::new(part.setup, grains, planes).unwrap();
    let mut mirrored = system(vec![grain], vec![part.planes[0]]);
    let mut paired = system(vec![grain, image], Vec::new());
    let mut touched = false;
    for _ in 0..200 {
        mirrored.substep(0.1, &[]).unwrap();
        paired.substep(0.1, &[]).unwrap();
        let (one, two) = (&mirrored.grains()[0], &paired.grains()[0]);
        touched |= mirrored.contact_loads()[0].force.norm() > 0.0;
        assert!((one.position - two.position).norm() < rounding);
        assert!((one.velocity - two.velocity).norm() < rounding);
        assert!((one.angular_velocity - two.angular_velocity).norm() < rounding);
    }
    assert!(touched && mirrored.grains()[0].velocity.y > 0.0, "it must have bounced");
    assert!(
        mirrored.grains()[0].angular_velocity.x.abs() < 0.002,
        "rolling resistance must have acted"
    );
}

#[test]
fn fixed_prescribed_and_free_grains_live_in_one_scene() {
    let mut budget = Budget::oracle(230_400);
    let scene = scene(&SCENE);
    let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
    budget.spend(60 * scene.setup.domain.cell_count() as u64);
    engine.step(60).unwrap();
    let start = &scene.setup.solid_phase.as_ref().unwrap().solids;
    let now = engine.solids();
    let moved = |i: usize| now[i].centre - start[i].centre;
    assert_eq!(moved(1), Vec3::zeros());
    // 60 steps of equal length, summed up with round-off of places of some 10 cells.
    assert!((moved(2) - 60.0 * start[2].velocity).norm() < 1e-12);
    assert!(moved(0).norm() > 0.02 && now[0].velocity != start[0].velocity);
    let solids = engine.free_grains().unwrap().grains().len();
    assert_eq!(solids, 3, "held grains are grains of the DEM too");
}

#[test]
fn without_free_grains_there_is_no_dem() {
    let text =
        SCENE.replace("density = 2500.0\nmotion = \"free\"\nvelocity = [0.0, 0.0, -0.02]", "");
    let start = text.find("[gravity]").unwrap();
    let end = text.find("[stop]").unwrap();
    let scene = scene(&format!("{}{}", &text[..start], &text[end..]));
    assert!(scene.free.is_none());
    assert!(open(EngineName::Reference, &scene, None, false).unwrap().free_grains().is_none());
}

#[test]
fn an_engine_goes_on_bit_for_bit_from_what_it_saved_during_contacts() {
    let mut budget = Budget::oracle(1_000_000);
    for (kept, averaged) in [("lagged", "true"), ("kept", "false")] {
        let coupling = format!("internal_fluid = \"{kept}\"\naverage_loads = {averaged}");
        let scene = scene(&SCENE.replace("average_loads = true", &coupling));
        let new = || open(EngineName::Reference, &scene, None, false).unwrap();
        let (mut whole, mut first, mut second) = (new(), new(), new());
        budget.spend(2 * 60 * scene.setup.domain.cell_count() as u64);
        whole.step(60).unwrap();
        first.step(16).unwrap();
        let state = first.free_grains().unwrap().state();
        assert!(state.pair_contacts.iter().any(|c| c.memory.spring != Vec3::zeros()), "contact");
        let saved_first = saved(&first);
        second.load(&mut saved_first.as_slice()).unwrap();
        assert!(saved_first == saved(&second), "what is read is what was written");
        second.step(44).unwrap();
        assert!(saved(&whole) == saved(&second), "{kept}, {averaged}");
    }
}

#[test]
fn a_saved_state_of_other_grains_is_refused() {
    let scene_of = |text: &str| open(EngineName::Reference, &scene(text), None, false).unwrap();
    let saved = saved(&scene_of(&SCENE));
    let fourth = "[[grains]]\nkind = \"sphere\"\ncentre = [6e-4, 2.4e-4, 1e-4]\ndiameter = 1e-4\n";
    let mut other = scene_of(&SCENE.replace("[gravity]", &format!("{fourth}[gravity]")));
    let said = other.load(&mut saved.as_slice()).unwrap_err().to_string();
    assert!(said.contains("3 grains, the scene 4"), "{said}");
    // Cut off, or with a contact of a grain that is not there.
    assert!(scene_of(&SCENE).load(&mut &saved[..saved.len() - 9]).is_err());
}

#[test]
fn means_over_the_free_grains_are_those_of_the_grains() {
    let mut budget = Budget::oracle(100_000);
    let scene = scene(&SCENE);
    let mut engine = open(EngineName::Reference, &scene, None, false).unwrap();
    budget.spend(20 * scene.setup.domain.cell_count() as u64);
    engine.step(20).unwrap();
    let units = &scene.units;
    let system = engine.free_grains().unwrap();
    let grain = &system.grains()[0];
    // One of three is free: the means are its own.
    let row = grain_means::row(&scene, &engine);
    for axis in 0..3 {
        assert_close(row[axis], grain.position[axis] * units.si_dx);
        assert_close(row[3 + axis], grain.velocity[axis] * units.si_velocity());
    }
    assert_close(row[6], grain.velocity.norm() * units.si_velocity());
    // m v²/2 + I ω²/2 with m = ρ V and I = 2/5 m a², SI.
    let (mass, a) = (2500.0 * PI / 6.0 * 2e-4_f64.powi(3), 1e-4);
    let (v, angular_velocity) =
        (row[6], grain.angular_velocity.norm() * units.si_angular_velocity());
    assert_close(
        row[7],
        0.5 * mass * v * v + 0.2 * mass * a * a * angular_velocity * angular_velocity,
    );
    // It lies on the fixed grain: one contact, whose overlap follows from the two places.
    let apart = (grain.position - system.grains()[1].position).norm() * units.si_dx;
    assert_eq!(row[8], 1.0);
    assert!((row[9] - (1.0 - apart / 1.6e-4)).abs() < 1e-12 && row[9] > 0.0, "{}", row[9]);
    assert_eq!(grain_means::contacts_of_each(&system.state()), [1, 1, 0]);
}
