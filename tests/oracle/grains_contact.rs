//! Normal contact: duration, restitution and overlap of a central impact against closed forms, the
//! conversion between them, momentum and energy.

use crate::common;

use common::{golden_rows, observed_order};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::{ContactLaw, LawError, damping_ratio, restitution};
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::GrainSetup;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;

/// Radius of all spheres; the overlaps are some 1e-6 of it, so that nothing but the law matters.
const R: f64 = 0.5;
const SPEED: f64 = 1e-6;

/// Two spheres that meet at `SPEED` along x, `gap` apart.
fn approaching(masses: [f64; 2], gap: f64) -> Vec<Grain> {
    let with = |mass: f64, x: f64, v: f64| Grain {
        mass,
        inertia: 0.4 * mass * R * R,
        ..Grain::sphere(Vec3::new(x, 0.0, 0.0), R, 1.0).moving(Vec3::new(v, 0.0, 0.0))
    };
    vec![with(masses[0], 0.0, 0.75 * SPEED), with(masses[1], 2.0 * R + gap, -0.25 * SPEED)]
}

/// What comes of an impact at speed 1.
struct Impact {
    restitution: f64,
    duration: f64,
    max_overlap: f64,
    strongest_pull: f64,
}

/// A central impact with sub-steps of `dt`, begun `phase` sub-steps before they touch.
fn impact(law: ContactLaw, masses: [f64; 2], dt: f64, phase: f64) -> Impact {
    let grains = approaching(masses, phase * dt * SPEED);
    let mut system = GrainSystem::new(GrainSetup::new(law), grains, Vec::new()).unwrap();
    let (mut touching, mut max_overlap, mut strongest_pull) = (0_u32, 0.0_f64, 0.0_f64);
    let mut seen = false;
    for _ in 0..100_000 {
        system.substep(dt, &[]).unwrap();
        let [one, two] = [system.grains()[0], system.grains()[1]];
        let overlap = 2.0 * R - (two.position.x - one.position.x);
        let force = system.contact_loads()[1].force.x;
        touching += u32::from(force > 0.0);
        seen |= overlap > 0.0;
        max_overlap = max_overlap.max(overlap);
        strongest_pull = strongest_pull.max(-force);
        if seen && overlap <= 0.0 {
            return Impact {
                restitution: (two.velocity.x - one.velocity.x) / SPEED,
                duration: f64::from(touching) * dt,
                max_overlap: max_overlap / SPEED,
                strongest_pull,
            };
        }
    }
    panic!("they do not part");
}

/// Rows of the table as numbers.
fn table() -> Vec<Vec<f64>> {
    let rows = golden_rows("dem/lsd_collision.csv");
    rows.iter().skip(1).map(|row| row.iter().map(|x| x.parse().unwrap()).collect()).collect()
}

#[test]
fn the_law_s_formulas_are_those_of_the_table() {
    for row in table() {
        let (zeta, e, duration) = (row[0], row[3], row[4]);
        // ω₀ = 1 for k = m = 1
        let law = ContactLaw::new(1.0, 2.0 * zeta).unwrap();
        // Half a unit of the table's eighth digit.
        let digits = |value: f64| 0.5e-7 * 10_f64.powf(value.log10().floor());
        assert!(
            (law.restitution(1.0) - e).abs() <= digits(e),
            "restitution of the law differs from the digits of the table: {row:?}"
        );
        assert!(
            (law.duration(1.0) - duration).abs() <= digits(duration),
            "duration of a contact differs from the digits of the table: {row:?}"
        );
        assert!(
            (law.restitution(1.0).sqrt() - row[5]).abs() <= digits(row[5]),
            "largest overlap differs from the digits of the table: {row:?}"
        );
        // Inverse: a table entry of 8 digits fixes ζ to some 1e-7.
        assert!(
            (damping_ratio(e) - zeta).abs() < 1e-6,
            "damping ratio for a restitution differs from the digits of the table: {row:?}"
        );
    }
}

#[test]
fn impacts_last_rebound_and_overlap_as_the_table_says() {
    // 400 sub-steps in the time 3/ω₀. Second order: 1/256 of the error at 25 per contact, 0.0027.
    let dt = 3.0 / 400.0;
    for row in table() {
        let law = ContactLaw::new(1.0, 2.0 * row[0]).unwrap();
        let found = impact(law, [2.0, 2.0], dt, 0.3);
        assert!(
            (found.restitution - row[3]).abs() < 2e-5,
            "computed restitution {} differs from that of {row:?}",
            found.restitution
        );
        // Ends are seen to a sub-step each.
        assert!(
            (found.duration - row[4]).abs() < 2.0 * dt,
            "computed duration of contact {} differs from that of {row:?} by two sub-steps or more",
            found.duration
        );
        assert!(
            (found.max_overlap - row[5]).abs() < 2e-5,
            "computed largest overlap {} differs from that of {row:?}",
            found.max_overlap
        );
        assert_eq!(found.strongest_pull, 0.0, "contacts never pull");
    }
}

#[test]
fn an_overdamped_impact_follows_the_continued_formula() {
    for zeta in [0.999, 1.0, 1.001, 1.5, 2.5] {
        let law = ContactLaw::new(1.0, 2.0 * zeta).unwrap();
        let found = impact(law, [2.0, 2.0], law.duration(1.0) / 2000.0, 0.3);
        // Second order: 1/6400 of the error at 25 per contact, and ten times that for its growth.
        assert!(
            (found.restitution - law.restitution(1.0)).abs() < 1e-5,
            "zeta {zeta}: the restitution of a computed impact differs from the closed form"
        );
        assert!(
            (found.max_overlap - law.restitution(1.0).sqrt()).abs() < 1e-5,
            "zeta {zeta}: the largest overlap of a computed impact differs from the closed form"
        );
    }
}

#[test]
fn the_textbook_conversion_from_restitution_would_miss_it() {
    // ζ from e = exp(-π ζ/√(1 - ζ²)), which holds for a contact that ends at zero overlap.
    let wanted: f64 = 0.5;
    let zeta = -wanted.ln() / (std::f64::consts::PI.powi(2) + wanted.ln().powi(2)).sqrt();
    let found = impact(ContactLaw::new(1.0, 2.0 * zeta).unwrap(), [2.0, 2.0], 0.01, 0.3);
    assert!(
        found.restitution > wanted + 0.04,
        "the textbook's conversion ought to miss the wanted restitution of 0.5 by 0.04 or more, and gives {}",
        found.restitution
    );
    // The conversion that is used does not.
    let law = ContactLaw::from_duration_and_restitution(3.0, wanted, 1.0).unwrap();
    let found = impact(law, [2.0, 2.0], 0.01, 0.3);
    assert!(
        (found.restitution - wanted).abs() < 2e-5,
        "restitution {} is not the one that was asked for",
        found.restitution
    );
}

#[test]
fn duration_and_restitution_come_back_from_the_law() {
    for mass in [1e-9, 0.5, 2e3] {
        for duration in [1e-6, 0.1, 40.0] {
            for e in [0.01, 0.1, (-2.0_f64).exp(), 0.5, 0.8, 0.99, 1.0] {
                let law = ContactLaw::from_duration_and_restitution(duration, e, mass).unwrap();
                // Near ζ = 0 the slope de/dζ is -π; acos near ζ = 1 loses half the digits of 1 - ζ.
                assert!(
                    (law.restitution(mass) - e).abs() < 1e-12,
                    "a law made for the restitution {e} has another one"
                );
                assert!(
                    (law.duration(mass) / duration - 1.0).abs() < 1e-11,
                    "a law made for a restitution of {e} has another duration of contact than it was made for"
                );
            }
        }
    }
    assert_eq!(restitution(0.0), 1.0);
}

#[test]
fn restitution_near_critical_damping_keeps_its_digits() {
    // exp(-2 ζ acos ζ/√(1 - ζ²)), continued beyond 1 by acosh, with 40 digits (mpmath).
    for (zeta, expected) in [
        (0.99991, 0.135_351_524_883_608_08),
        (0.99995, 0.135_344_306_024_927_1),
        (1.00005, 0.135_326_261_320_459),
        (1.00009, 0.135_319_044_415_418_03),
    ] {
        // The series used there leaves out 1e-13; its last term is 3e-10 of e at 1e-4 from 1.
        let off = restitution(zeta) - expected;
        assert!(off.abs() < 2e-13, "zeta {zeta}: restitution off by {off:e}");
    }
}

#[test]
fn friction_and_rolling_swing_as_long_as_the_contact_lasts() {
    let law = ContactLaw::from_duration_and_restitution(0.3, 1.0, 0.7).unwrap();
    for law in [law, law.with_friction(0.5).unwrap(), law.with_rolling(0.1).unwrap()] {
        assert!(
            (law.shortest_time(0.7) / 0.3 - 1.0).abs() < 1e-12,
            "friction or rolling swings faster than a contact lasts: {law:?}"
        );
    }
    let law = law.with_friction(0.5).unwrap();
    let equal = &golden_rows("dem/exact_constants.csv")[6];
    assert_eq!(&equal[0], "kt_over_kn_equal_half_periods");
    // Ten digits are printed.
    let ratio = law.friction.unwrap().stiffness / law.stiffness;
    assert!((ratio - equal[1].parse::<f64>().unwrap()).abs() < 1e-10);
}

#[test]
fn chung_and_ooi_3_spheres_leave_a_plane_with_the_restitution_asked_for() {
    let mut rows = 0;
    for row in golden_rows("dem/chung_ooi.csv").iter().filter(|row| &row[0] == "3") {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let (density, radius, speed, duration) = (number(3), number(6), number(7), number(8));
        for e in [0.2, 0.4, 0.6, 0.8, 1.0] {
            let down = Vec3::new(0.0, 0.0, -speed);
            let start = Vec3::new(0.0, 0.0, radius + 0.1 * duration * speed);
            let grain = Grain::sphere(start, radius, density).moving(down);
            let law = ContactLaw::from_duration_and_restitution(duration, e, grain.mass).unwrap();
            let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
            let setup = GrainSetup::new(law);
            let mut system = GrainSystem::new(setup, vec![grain], vec![floor]).unwrap();
            system.step(2.0 * duration, &[]).unwrap();
            let found = system.grains()[0].velocity.z / speed;
            // The error of 25 sub-steps per contact (grains_motion.rs).
            assert!(
                (found - e).abs() < 2.7e-3,
                "{}: restitution {found} of the computed impact, {e} in Chung & Ooi's test",
                &row[2]
            );
            rows += 1;
        }
    }
    assert_eq!(rows, 10);
}

#[test]
fn momentum_is_kept_to_round_off_and_energy_to_second_order_in_undamped_impacts() {
    let masses = [1.0, 3.0];
    let law = ContactLaw::new(1.0, 0.0).unwrap();
    let duration = law.duration(0.75);
    let energy_error = |per_contact: f64, phase: f64| {
        let dt = duration / per_contact;
        let grains = approaching(masses, phase * dt * SPEED);
        let momentum = |grains: &[Grain]| -> f64 {
            grains.iter().map(|grain| grain.mass * grain.velocity.x).sum()
        };
        let before = momentum(&grains);
        let mut system = GrainSystem::new(GrainSetup::new(law), grains, Vec::new()).unwrap();
        let energy = system.kinetic_energy();
        // Until well after the contact.
        for _ in (0_u32..).take_while(|&step| f64::from(step) < 2.0 * per_contact) {
            system.substep(dt, &[]).unwrap();
            // One rounding of each velocity per sub-step, gauge: sum of |m v|.
            let round_off = 4.0 * per_contact * f64::EPSILON * 2.0 * SPEED;
            assert!((momentum(system.grains()) - before).abs() <= round_off);
        }
        system.kinetic_energy() / energy - 1.0
    };
    // Over where in a sub-step the contact begins, and ends.
    let worst = |per_contact: f64| {
        let phases = (0..20).flat_map(|i| (0..8).map(move |j| [i, j].map(f64::from)));
        let error = |[i, j]: [f64; 2]| energy_error(per_contact + j / 8.0, i / 20.0).abs();
        phases.map(error).fold(0.0, f64::max)
    };
    let points = [20.0, 40.0, 80.0].map(|per_contact| (1.0 / per_contact, worst(per_contact)));
    let order = observed_order(&points);
    println!("energy errors {points:?}, order {order:.2}");
    // Verlet is of second order: within the contact it keeps a shadow energy, and where the contact
    // begins and ends it leaves an error. At 80 per contact, a tenth of that of e at 25, twice.
    assert!(
        (order - 2.0).abs() < 0.1 && points[2].1 < 4e-4,
        "errors {points:?} against the sub-step: not of second order, or too large"
    );
}

#[test]
fn laws_that_make_no_sense_are_refused_with_key_value_and_range() {
    let message = |result: Result<ContactLaw, LawError>| result.unwrap_err().to_string();
    let from = ContactLaw::from_duration_and_restitution;
    for (result, expected) in [
        (ContactLaw::new(-1.0, 0.0), "stiffness = -1 must be positive and finite"),
        (ContactLaw::new(1.0, -2.0), "damping = -2 must be finite and not negative"),
        (from(0.0, 0.5, 1.0), "contact duration = 0 must be positive and finite"),
        (from(1.0, 0.0, 1.0), "restitution = 0 must lie between 0.01 and 1"),
        (from(1.0, 1.2, 1.0), "restitution = 1.2 must lie between 0.01 and 1"),
        (from(1.0, 0.5, f64::NAN), "reduced mass = NaN must be positive and finite"),
        (
            ContactLaw::new(1.0, 0.0).unwrap().with_friction(-0.1),
            "friction coefficient = -0.1 must be finite and not negative; use 0 for none",
        ),
        (
            ContactLaw::new(1.0, 0.0).unwrap().with_rolling(f64::INFINITY),
            "rolling coefficient = inf must be finite and not negative; use 0 for none",
        ),
    ] {
        let message = message(result);
        assert!(message.contains(expected), "{message}");
    }
}
