//! Values of single grains, laws and contacts against the textbook's formulas, with numbers at which no two
//! terms are alike: radii, masses and times other than 1.

use psmrt_reference::grains::contact::{Geometry, Motion, Relative, contact_force};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::law::{ContactLaw, damping_ratio};
use psmrt_reference::grains::lubrication::Lubrication;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::random::SplitMix64;
use psmrt_reference::grains::setup::PeriodicBox;
use psmrt_reference::lattice::Vec3;
use std::f64::consts::PI;

/// Errors of a few operations in double precision, relative.
const ROUNDING: f64 = 1e-15;

/// Asserts that two numbers agree to rounding.
fn assert_same(what: &str, found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 8.0 * ROUNDING * expected.abs(),
        "{what}: {found}, where the formula gives {expected}"
    );
}

#[test]
fn a_sphere_has_the_volume_mass_inertia_and_energy_of_the_textbook() {
    // R = 3, ρ = 2: V = 4/3 π 27 = 36 π, m = 72 π, I = 2/5 m 9
    assert_same("volume of a sphere of radius 3", sphere_volume(3.0), 36.0 * PI);
    let sphere = Grain::sphere(Vec3::zeros(), 3.0, 2.0)
        .moving(Vec3::new(0.0, 3.0, 4.0))
        .spinning(Vec3::new(2.0, 0.0, 0.0));
    assert_same("its mass at density 2", sphere.mass, 72.0 * PI);
    assert_same("its moment of inertia", sphere.inertia, 259.2 * PI);
    // (m 25 + I 4)/2
    assert_same("its kinetic energy", sphere.kinetic_energy(), (900.0 + 518.4) * PI);
}

#[test]
fn friction_and_rolling_have_two_sevenths_and_two_fifths_of_stiffness_and_damping() {
    let law = ContactLaw::new(21.0, 35.0).unwrap().with_friction(0.3).unwrap();
    let friction = law.friction.unwrap();
    assert_same("tangential stiffness", friction.stiffness, 6.0);
    assert_same("tangential damping", friction.damping, 10.0);
    let rolling = law.with_rolling(0.1).unwrap().rolling.unwrap();
    assert_same("rolling stiffness", rolling.stiffness, 8.4);
    assert_same("rolling damping", rolling.damping, 14.0);
}

#[test]
fn the_shortest_time_is_that_of_the_fastest_spring_or_dashpot() {
    let (mass, stiff) = (3.0, 7.0);
    let undamped = ContactLaw::new(stiff, 0.0).unwrap();
    // t_c = π √(m/k)
    assert_same("undamped contact", undamped.shortest_time(mass), PI * (mass / stiff).sqrt());
    let with =
        |stiffness: f64, damping: f64| {
            let law = undamped.with_friction(0.5).unwrap().with_rolling(0.1).unwrap();
            let mut friction = law;
            friction.rolling = None;
            friction.friction = friction
                .friction
                .map(|it| psmrt_reference::grains::law::Friction { stiffness, damping, ..it });
            let mut rolling = law;
            rolling.friction = None;
            rolling.rolling = rolling.rolling.map(|it| psmrt_reference::grains::law::Rolling {
                stiffness,
                damping,
                ..it
            });
            [friction.shortest_time(mass), rolling.shortest_time(mass)]
        };
    // A tangential spring a hundred times as stiff: π √((2/7) m/k); rolling: π √((2/5) m/k).
    let [tangential, rolling] = with(100.0 * stiff, 0.0);
    assert_same("stiff tangential spring", tangential, PI * (2.0 * mass / 7.0 / 700.0).sqrt());
    assert_same("stiff rolling spring", rolling, PI * (0.4 * mass / 700.0).sqrt());
    // Dashpots that stop a body in m/γ: five times that, with 2/7 and 2/5 of the mass.
    let [tangential, rolling] = with(0.01, 100.0);
    assert_same("strong tangential dashpot", tangential, 5.0 * 2.0 * mass / 7.0 / 100.0);
    assert_same("strong rolling dashpot", rolling, 5.0 * 0.4 * mass / 100.0);
}

#[test]
fn couple_of_a_new_rolling_contact_is_spring_and_dashpot_times_the_square_of_the_radius() {
    // Radii 2 and 6: R_r = 12/8 = 1.5. Centres 7.5 apart: overlap 0.5. They approach at 4 during 0.25: of the
    // sub-step half has passed since they touched (0.5/1), so the dashpots act with weight 1/2 + 1/2 = 1 and the
    // springs turn for 0.125; with 8 instead of 4 it is a quarter, weight 0.75 and 0.0625.
    for (speed, elapsed, weight) in [(4.0, 0.125, 1.0), (8.0, 0.0625, 0.75)] {
        let law = ContactLaw::new(1000.0, 5.0).unwrap().with_rolling(1e6).unwrap();
        let rolling = law.rolling.unwrap();
        let geometry = Geometry::of_spheres(&Vec3::new(7.5, 0.0, 0.0), [2.0, 6.0]);
        let turn = Vec3::new(0.0, 0.3, -0.2);
        let still = Motion { velocity: Vec3::zeros(), angular_velocity: Vec3::zeros() };
        let moving = Motion { velocity: Vec3::new(speed, 0.0, 0.0), angular_velocity: turn };
        let relative = Relative::new(&geometry, [&moving, &still]);
        let pair = contact_force(&law, &geometry, [&relative, &relative], 0.25, &mut None).unwrap();
        // M = -R_r² (k_r θ + γ_r ω w), and the arms turn nothing, since the force is along the normal
        let couple = -2.25 * (rolling.stiffness * elapsed + rolling.damping * weight) * turn;
        assert!(
            (pair.torques[0] - couple).norm() < 1e-12 * couple.norm(),
            "approach at {speed}: couple {:?}, where R² (k θ + γ ω w) is {couple:?}",
            pair.torques[0]
        );
        // F_n = k δ + γ u w
        let force = 1000.0 * 0.5 + 5.0 * weight * speed;
        assert_same("normal force", -pair.force.x, force);
    }
}

#[test]
fn restitution_1_is_no_damping_at_all() {
    assert_eq!(damping_ratio(1.0), 0.0, "damping ratio of an elastic impact");
}

#[test]
fn lubrication_between_unequal_spheres_is_jeffrey_s_whichever_is_first() {
    // Jeffrey & Onishi, J. Fluid Mech. 139, 261 (1984), with both radii written out; the leading term is that of
    // Derjaguin's radius a₁ a₂/(a₁ + a₂):
    //   F/u = 6π μ [(a₁ a₂/(a₁ + a₂))² (1/h - 1/h_c) + a₁ a₂ (a₁² + 7 a₁ a₂ + a₂²)/(5 (a₁ + a₂)³) ln(h_c/h)]
    let law =
        Lubrication { viscosity: 0.7, cutoff_gap: 0.5, smallest_gap: 0.01, while_touching: true }
            .checked()
            .unwrap();
    let (a1, a2, h) = (1.5_f64, 4.0_f64, 0.125_f64);
    let (product, sum) = (a1 * a2, a1 + a2);
    let squeezed = (product / sum).powi(2) * (1.0 / h - 1.0 / 0.5);
    let logarithmic =
        product * (a1 * a1 + 7.0 * product + a2 * a2) / (5.0 * sum.powi(3)) * 4.0_f64.ln();
    let expected = 6.0 * PI * 0.7 * (squeezed + logarithmic);
    assert_same("radii 1.5 and 4", law.between_spheres(h, [a1, a2]), expected);
    assert_same("radii 4 and 1.5", law.between_spheres(h, [a2, a1]), expected);
}

#[test]
fn walls_of_a_domain_face_inwards_two_for_each_axis_asked_for() {
    let law = ContactLaw::new(1.0, 0.0).unwrap();
    let (low, high) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(5.0, 7.0, 9.0));
    let walls = Plane::box_walls(low, high, &[0, 2], law);
    let inside = Vec3::new(1.5, 4.0, 5.0);
    // Distances of a point inside: 1.5 - 1, 5 - 1.5, 5 - 3, 9 - 5.
    let heights: Vec<f64> = walls.iter().map(|wall| wall.height(&inside)).collect();
    assert_eq!(heights, [0.5, 3.5, 2.0, 4.0], "distances from the walls across x and z");
}

#[test]
fn random_numbers_are_those_of_the_published_generator() {
    // The sequence of seed 1234567 that implementations of SplitMix64 are compared by (Vigna's splitmix64.c).
    let known: [u64; 5] = [
        6_457_827_717_110_365_317,
        3_203_168_211_198_807_973,
        9_817_491_932_198_370_423,
        4_593_380_528_125_082_431,
        16_408_922_859_458_223_821,
    ];
    let sequence = || SplitMix64::new(1_234_567);
    let (mut bits, mut units, mut below) = (sequence(), sequence(), sequence());
    for (place, value) in known.into_iter().enumerate() {
        assert_eq!(bits.bits(), value, "bits of number {place}");
        // The upper 53 bits over 2^53, and the remainder.
        let unit = (value / 2048) as f64 / 9_007_199_254_740_992.0;
        assert_eq!(units.unit(), unit, "number {place} in 0..1");
        assert_eq!(below.below(1000) as u64, value % 1000, "number {place} below 1000");
    }
}

#[test]
fn a_place_is_wrapped_into_the_domain_along_periodic_axes_only() {
    let sides = PeriodicBox { lengths: [Some(4.0), None, Some(8.0)] };
    let wrapped = sides.wrap(&Vec3::new(-1.0, -1.0, 17.0));
    assert_eq!(
        wrapped,
        Vec3::new(3.0, -1.0, 1.0),
        "(-1, -1, 17) in a domain of 4 along x and 8 along z"
    );
}
