//! Friction and rolling under gravity, against the exact mechanics of a solid sphere on a plane: a
//! sliding sphere starts to roll; slopes on which it rolls, slips or stays; belts and pistons.

use crate::common;

use common::golden_rows;
use psmrt_reference::grains::contact::{Geometry, Motion, Relative, contact_force};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::GrainSetup;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;

/// Radius, gravity and (about) mass are 1; the weight presses a resting sphere in by this much, which
/// is also the relative error of the closed forms, whose sphere is rigid.
const PRESSED: f64 = 1e-6;

fn constant(name: &str) -> f64 {
    let rows = golden_rows("dem/exact_constants.csv");
    rows.iter().find(|row| &row[0] == name).unwrap()[1].parse().unwrap()
}

/// A law under which the resting sphere is pressed in by [`PRESSED`].
fn law(friction: f64) -> ContactLaw {
    let mass = Grain::sphere(Vec3::zeros(), 1.0, 1.0).mass;
    let law = ContactLaw::from_stiffness_and_restitution(mass / PRESSED, 0.5, mass);
    law.unwrap().with_friction(friction).unwrap()
}

/// A sphere at rest on a floor that slopes down along x; `law` is the floor's.
fn on_slope(tangent: f64, law: ContactLaw, belt: Vec3) -> GrainSystem {
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let gravity = cosine * Vec3::new(tangent, 0.0, -1.0);
    let sphere = Grain::sphere(Vec3::new(0.0, 0.0, 1.0 - cosine * PRESSED), 1.0, 1.0);
    let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law).moving(belt);
    let setup = GrainSetup { gravity, ..GrainSetup::new(law) };
    GrainSystem::new(setup, vec![sphere], vec![floor]).unwrap()
}

fn sphere(system: &GrainSystem) -> Grain {
    system.grains()[0]
}

/// Velocity of the sphere's surface where it touches the floor, along x.
fn slip(system: &GrainSystem) -> f64 {
    let Grain { velocity, angular_velocity, position, .. } = sphere(system);
    velocity.x - angular_velocity.y * position.z
}

#[test]
fn a_sliding_sphere_rolls_in_the_end_at_five_sevenths_of_its_speed() {
    let (mu, v0) = (0.3, 2.0);
    let mut system = on_slope(0.0, law(mu), Vec3::zeros());
    system.edit(|grains, _| grains[0].velocity.x = v0).unwrap();
    let time = constant("sliding_to_rolling_time_times_mu_g_over_v0") * v0 / mu;
    let distance = constant("sliding_to_rolling_distance_times_mu_g_over_v0sq") * v0 * v0 / mu;
    let v_end = constant("sliding_to_rolling_v_final_over_v0") * v0;

    // Until then it is braked by μ g. The spring is drawn to the cone in some 1e-6 of way and the
    // weight rings for some 1e-3 of time: the speed is off by less than 1e-5.
    for part in [0.25, 0.5, 0.75, 0.99] {
        system.step(part * time - elapsed(&system, v0, mu), &[]).unwrap();
        let braked = v0 - mu * part * time;
        assert!(
            (sphere(&system).velocity.x - braked).abs() < 1e-4,
            "a sliding sphere after {part} of the time to roll: its velocity is not v - μ g t"
        );
        // ω = (5/2) μ g t/R
        assert!(
            (sphere(&system).angular_velocity.y - 2.5 * mu * part * time).abs() < 1e-4,
            "a sliding sphere after {part} of the time to roll: its angular velocity is not 5/2 μ g t/a"
        );
    }
    // Well after it, it rolls, and has come as far as the closed form says.
    let before = sphere(&system).position.x;
    let expected = distance - (v0 * 0.99 * time - 0.5 * mu * (0.99 * time).powi(2));
    system.step(0.01 * time + 1.0, &[]).unwrap();
    let rolled = sphere(&system).position.x - before;
    assert!(
        (rolled - (expected + v_end)).abs() < 1e-4,
        "a sliding sphere has come {rolled} far, not as far as the closed form"
    );
    // v + (2/5) ω R is kept exactly (angular momentum about the contact); R is short by 1e-6.
    assert!(
        (sphere(&system).velocity.x / v_end - 1.0).abs() < PRESSED,
        "a sphere that has stopped sliding does not roll at 5/7 of its first velocity"
    );
    assert!(slip(&system).abs() < 1e-9, "a sphere that ought to roll slips at {}", slip(&system));
}

/// Time since the start of the sliding sphere, from its way: x = v₀ t - μ g t²/2.
fn elapsed(system: &GrainSystem, v0: f64, mu: f64) -> f64 {
    let x = sphere(system).position.x;
    (v0 - (v0 * v0 - 2.0 * mu * x).sqrt()) / mu
}

#[test]
fn on_a_slope_a_sphere_rolls_below_three_and_a_half_times_friction_and_slips_above() {
    let mu = 0.2;
    let limit = constant("incline_roll_without_slip_max_tan_over_mu") * mu;
    let rolling = constant("incline_rolling_acceleration_over_g_sin");
    let time = 1.0;
    for (tangent, rolls) in [(0.3 * limit, true), (0.99 * limit, true), (1.01 * limit, false)] {
        let mut system = on_slope(tangent, law(mu), Vec3::zeros());
        system.step(time, &[]).unwrap();
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        let (speed, slip) = (sphere(&system).velocity.x, slip(&system));
        if rolls {
            // a = (5/7) g sin; the start, when the spring is drawn, costs less than 1e-3 of time.
            let exact = rolling * cosine * tangent * time;
            assert!(
                (speed / exact - 1.0).abs() < 1e-3,
                "slope {tangent}: a sphere rolls down at {speed}, closed form {exact}"
            );
            assert!(
                slip.abs() < 1e-6,
                "slope {tangent}: a sphere that ought to roll slips at {slip}"
            );
        } else {
            // a = g (sin - μ cos), slip = g (sin - 3.5 μ cos) t
            let exact = cosine * (tangent - mu) * time;
            assert!(
                (speed / exact - 1.0).abs() < 1e-3,
                "slope {tangent}: a sphere slides down at {speed}, closed form {exact}"
            );
            let exact = cosine * (tangent - 3.5 * mu) * time;
            assert!(
                (slip / exact - 1.0).abs() < 0.1,
                "slope {tangent}: a sphere slips at {slip}, closed form {exact}"
            );
        }
    }
}

#[test]
fn a_sphere_that_cannot_roll_stays_below_the_angle_of_friction_and_slides_above() {
    let mu = 0.4;
    // Rolling resistance far above friction: it slides or stays, like a block.
    let block = law(mu).with_rolling(10.0).unwrap();
    for (tangent, stays) in [(0.5 * mu, true), (0.99 * mu, true), (1.05 * mu, false)] {
        let mut system = on_slope(tangent, block, Vec3::zeros());
        system.step(1.0, &[]).unwrap();
        let Grain { position, velocity, angular_velocity, .. } = sphere(&system);
        if stays {
            // The springs start undrawn and swing over: near the limit it slips a little at first.
            assert!(
                position.x < 1e-4,
                "slope {tangent}: a sphere that cannot roll ought to stay and has come to {position}"
            );
            assert!(
                velocity.norm() < 1e-12 && angular_velocity.norm() < 1e-12,
                "slope {tangent}: a sphere that cannot roll ought to be at rest, and moves at \
                 {velocity} and turns at {angular_velocity}"
            );
        } else {
            let exact = (tangent - mu) / (1.0 + tangent * tangent).sqrt();
            assert!(
                (velocity.x / exact - 1.0).abs() < 0.1,
                "slope {tangent}: a sphere that cannot roll slides at {velocity}, closed form {exact} along x"
            );
            assert!(
                angular_velocity.norm() < 1e-3,
                "slope {tangent}: a sphere that ought to slide without rolling turns at {angular_velocity}"
            );
        }
    }
}

#[test]
fn rolling_resistance_holds_a_sphere_up_to_its_slope_and_brakes_one_that_rolls() {
    let (mu, mu_r) = (0.5, 0.1);
    let resisting = law(mu).with_rolling(mu_r).unwrap();
    for (tangent, stays) in [(0.99 * mu_r, true), (1.05 * mu_r, false)] {
        let mut system = on_slope(tangent, resisting, Vec3::zeros());
        system.step(1.0, &[]).unwrap();
        let speed = sphere(&system).velocity.x;
        // Beyond: a = (5/7) g (sin - μ_r cos)
        let exact = 5.0 / 7.0 * (tangent - mu_r) / (1.0 + tangent * tangent).sqrt();
        let found = if stays { speed.abs() < 1e-12 } else { (speed / exact - 1.0).abs() < 0.1 };
        assert!(found, "slope {tangent}: a sphere slides down at {speed}, closed form {exact}");
    }
    // On the level: dv/dt = -(5/7) μ_r g
    let mut system = on_slope(0.0, resisting, Vec3::zeros());
    let rolling = |grain: &mut Grain| {
        grain.velocity.x = 1.0;
        grain.angular_velocity.y = 1.0;
    };
    system.edit(|grains, _| rolling(&mut grains[0])).unwrap();
    system.step(5.0, &[]).unwrap();
    let exact = 1.0 - 5.0 / 7.0 * mu_r * 5.0;
    assert!(
        (sphere(&system).velocity.x - exact).abs() < 1e-4,
        "a sphere that rolls against its resistance moves at {}, not by the closed form",
        sphere(&system).velocity.x
    );
    // It stops at 14 and does not roll back.
    system.step(15.0, &[]).unwrap();
    assert!(
        sphere(&system).velocity.norm() < 1e-9,
        "the sphere ought to have stopped and moves at {}",
        sphere(&system).velocity
    );
}

#[test]
fn a_belt_drags_a_sphere_to_two_sevenths_of_its_speed_and_one_that_cannot_roll_all_the_way() {
    let (mu, belt) = (0.3, Vec3::new(1.0, 0.0, 0.0));
    let mut system = on_slope(0.0, law(mu), belt);
    system.step(0.1, &[]).unwrap();
    assert!(
        (sphere(&system).velocity.x - 0.1 * mu).abs() < 1e-4,
        "a belt ought to drag the sphere with μ g, and its velocity is another"
    );
    // Friction on the belt is the sphere's reversed.
    let (drag, weight) = (system.force_on_plane(0), sphere(&system).mass);
    assert!(
        (drag.x + mu * weight).abs() < 1e-4 * weight && (drag.z + weight).abs() < 1e-4 * weight
    );
    // In the belt's frame the sphere slides at -1 and ends rolling at -5/7, after 2/(7 μ g) = 0.95.
    system.step(1.5, &[]).unwrap();
    assert!((sphere(&system).velocity.x - 2.0 / 7.0).abs() < 2.0 * PRESSED);
    assert!((system.planes()[0].point.x - 1.6).abs() < 1e-12, "the belt has moved on");

    let block = law(mu).with_rolling(10.0).unwrap();
    let mut system = on_slope(0.0, block, belt);
    // 1/(μ g) = 3.3, and time to calm down.
    system.step(4.0, &[]).unwrap();
    assert!(
        (sphere(&system).velocity - belt).norm() < 1e-9,
        "a sphere that cannot roll ought to move with the belt and moves at {}",
        sphere(&system).velocity
    );
}

#[test]
fn a_piston_throws_a_sphere_forward_at_its_own_speed_and_the_rebound_s() {
    for e in [0.4, 1.0] {
        let mass = Grain::sphere(Vec3::zeros(), 1.0, 1.0).mass;
        let law = ContactLaw::from_duration_and_restitution(1e-3, e, mass).unwrap();
        let sphere = Grain::sphere(Vec3::new(1.001, 0.0, 0.0), 1.0, 1.0);
        let piston = Plane::fixed(Vec3::zeros(), Vec3::x(), law).moving(Vec3::new(0.5, 0.0, 0.0));
        let mut system =
            GrainSystem::new(GrainSetup::new(law), vec![sphere], vec![piston]).unwrap();
        system.step(0.01, &[]).unwrap();
        let speed = system.grains()[0].velocity.x;
        // v = (1 + e) V; e to the error of 25 sub-steps per contact (grains_motion.rs).
        assert!(
            (speed - 0.5 * (1.0 + e)).abs() < 0.5 * 2.7e-3,
            "restitution {e}: the piston throws the sphere at {speed}, not at (1 + e) times \
             its own velocity of 0.5"
        );
    }
}

#[test]
fn rolling_resistance_of_a_pair_is_limited_by_its_reduced_radius_and_twisting_is_free() {
    // Radii 1 and 3, pressed together by 0.1: R_r = 3/4, and couples are opposite.
    let geometry = Geometry::of_spheres(&Vec3::new(0.0, 0.0, 3.9), [1.0, 3.0]);
    let pair = ContactLaw::new(2.0, 0.0).unwrap().with_rolling(0.2).unwrap();
    let motion = |angular_velocity: Vec3| Motion { velocity: Vec3::zeros(), angular_velocity };
    let exert = |angular_velocity: Vec3| {
        let relative =
            Relative::new(&geometry, [&motion(angular_velocity), &motion(Vec3::zeros())]);
        let mut memory = None;
        let forces = contact_force(&pair, &geometry, [&relative; 2], 10.0, &mut memory).unwrap();
        (forces.torques, memory.unwrap().rolling)
    };
    let (torques, spring) = exert(Vec3::new(5.0, 0.0, 0.0));
    // μ_r R_r k δ against the angular velocity; couple per radian (2/5) k R_r²
    assert!(
        (torques[0] + Vec3::new(0.2 * 0.75 * 0.2, 0.0, 0.0)).norm() < 1e-15,
        "torques of rolling resistance {torques:?}: not the limit, friction of rolling times \
         reduced radius times force"
    );
    assert_eq!(torques[0], -torques[1]);
    assert!(
        (0.4 * 2.0 * 0.75 * 0.75 * spring.x - 0.2 * 0.75 * 0.2).abs() < 1e-15,
        "spring of rolling resistance {spring}: not where its torque is at its limit"
    );
    let (torques, spring) = exert(Vec3::new(0.0, 0.0, 5.0));
    assert_eq!((torques, spring), ([Vec3::zeros(); 2], Vec3::zeros()));

    // A sphere that spins like a top on the floor goes on spinning.
    let mut system = on_slope(0.0, law(0.5).with_rolling(0.3).unwrap(), Vec3::zeros());
    system.edit(|grains, _| grains[0].angular_velocity = Vec3::z()).unwrap();
    system.step(1.0, &[]).unwrap();
    assert_eq!(sphere(&system).angular_velocity, Vec3::z());
}
