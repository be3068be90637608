//! Newton's third law, momentum and angular momentum, for random clusters and laws.

use crate::common;

use common::random::Random;
use proptest::prelude::*;
use psmrt_reference::grains::contact::{Geometry, Motion, Relative, contact_force};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::{ContactLaw, Friction, Rolling};
use psmrt_reference::grains::lubrication::Lubrication;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;

const STEPS: u32 = 30;
const SUBSTEP: f64 = 0.02;

prop_compose! {
    fn any_law()(
        stiffness in 0.5..5.0_f64, damping in 0.0..1.0_f64,
        friction in prop::option::of((0.0..2.0_f64, 0.1..3.0_f64, 0.0..0.5_f64)),
        rolling in prop::option::of((0.0..0.5_f64, 0.1..2.0_f64, 0.0..0.3_f64)),
    ) -> ContactLaw {
        ContactLaw {
            stiffness,
            damping,
            friction: friction
                .map(|(coefficient, stiffness, damping)| Friction { coefficient, stiffness, damping }),
            rolling: rolling
                .map(|(coefficient, stiffness, damping)| Rolling { coefficient, stiffness, damping }),
        }
    }
}

/// Overlapping spheres of different sizes and densities, moving and spinning at random.
fn cluster(count: usize, seed: u64) -> Vec<Grain> {
    let mut random = Random(seed);
    let grains = (0..count).map(|_| {
        let (radius, density) = (random.between(0.3, 0.7), random.between(1.0, 3.0));
        Grain::sphere(random.vector(1.5), radius, density)
            .moving(random.vector(2.0))
            .spinning(random.vector(4.0))
    });
    grains.collect()
}

fn config() -> ProptestConfig {
    ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() }
}

fn momentum(grains: &[Grain]) -> Vec3 {
    grains.iter().map(|grain| grain.mass * grain.velocity).sum()
}

/// About the origin: of the centres' motion and of the spins.
fn angular_momentum(grains: &[Grain]) -> Vec3 {
    let of = |g: &Grain| g.mass * g.position.cross(&g.velocity) + g.inertia * g.angular_velocity;
    grains.iter().map(of).sum()
}

/// What one sub-step rounds: the gauges of momentum and angular momentum, sums of absolute terms.
fn gauges(system: &GrainSystem) -> (f64, f64) {
    let (mut linear, mut angular) = (0.0, 0.0);
    for (grain, load) in system.grains().iter().zip(system.contact_loads()) {
        let p = grain.mass * grain.velocity.norm() + SUBSTEP * load.force.norm();
        linear += p;
        angular += p * grain.position.norm() + grain.inertia * grain.angular_velocity.norm();
    }
    // What a grain receives from several others may cancel in its load.
    for force in system.pairs().iter().filter_map(|pair| pair.force) {
        let impulse = SUBSTEP * force.force.norm();
        linear += 2.0 * impulse;
        angular += 4.0 * impulse + SUBSTEP * (force.torques[0].norm() + force.torques[1].norm());
    }
    (linear, angular)
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn momentum_and_angular_momentum_of_random_clusters_are_kept_to_round_off(
        law in any_law(), count in 2_usize..12, seed in any::<u64>(), wet in any::<bool>(),
    ) {
        // Angular momentum too: both forces of a contact act at one and the same point, and couples
        // of rolling resistance are opposite. That holds for any sub-step, here a coarse one.
        let lubrication =
            wet.then_some(Lubrication { viscosity: 0.05, cutoff_gap: 0.3, smallest_gap: 0.05, while_touching: true });
        let setup = GrainSetup { lubrication, ..GrainSetup::new(law) };
        let mut system = GrainSystem::new(setup, cluster(count, seed), Vec::new()).unwrap();
        let (p, l) = (momentum(system.grains()), angular_momentum(system.grains()));
        let (mut p_gauge, mut l_gauge) = gauges(&system);
        for _ in 0..STEPS {
            system.substep(SUBSTEP, &[]).unwrap();
            let (linear, angular) = gauges(&system);
            (p_gauge, l_gauge) = (p_gauge + linear, l_gauge + angular);
        }
        let off = (momentum(system.grains()) - p).norm();
        // A few roundings of each term per sub-step.
        prop_assert!(
            off <= 4.0 * f64::EPSILON * p_gauge,
            "contacts have changed the momentum of the grains by {off:e}, round-off is {:e}: \
             action is not reaction", f64::EPSILON * p_gauge
        );
        let off = (angular_momentum(system.grains()) - l).norm();
        prop_assert!(
            off <= 8.0 * f64::EPSILON * l_gauge,
            "contacts have changed the angular momentum of the grains by {off:e}, round-off is \
             {:e}", f64::EPSILON * l_gauge
        );
    }

    #[test]
    fn momentum_is_kept_in_a_periodic_box(
        law in any_law(), count in 2_usize..12, seed in any::<u64>(),
    ) {
        let sides = PeriodicBox::all([2.0, 2.2, 1.8]);
        let setup = GrainSetup { sides, ..GrainSetup::new(law) };
        let mut system = GrainSystem::new(setup, cluster(count, seed), Vec::new()).unwrap();
        let p = momentum(system.grains());
        let mut gauge = gauges(&system).0;
        for _ in 0..STEPS {
            system.substep(SUBSTEP, &[]).unwrap();
            gauge += gauges(&system).0;
        }
        let off = (momentum(system.grains()) - p).norm();
        prop_assert!(
            off <= 4.0 * f64::EPSILON * gauge,
            "contacts through periodic faces have changed the momentum of the grains by \
             {off:e}, round-off is {:e}", f64::EPSILON * gauge
        );
    }

    #[test]
    fn a_pair_seen_from_either_side_has_forces_opposite_to_the_last_bit(
        law in any_law(), seed in any::<u64>(), dt in 0.0..0.1_f64,
    ) {
        let mut random = Random(seed);
        let radii = [random.between(0.4, 0.6), random.between(0.4, 0.6)];
        let offset = random.vector(1.0).normalize() * random.between(0.5, 1.0);
        let mut motions = || [0; 2].map(|_| Motion {
            velocity: random.vector(1.0),
            angular_velocity: random.vector(1.0),
        });
        let (middle, end) = (motions(), motions());
        let seen = |flip: bool| {
            let order = if flip { [1, 0] } else { [0, 1] };
            let offset = if flip { -offset } else { offset };
            let geometry = Geometry::of_spheres(&offset, order.map(|i| radii[i]));
            let of = |motions: &[Motion; 2]| {
                Relative::new(&geometry, [&motions[order[0]], &motions[order[1]]])
            };
            let (middle, end) = (of(&middle), of(&end));
            let mut memory = None;
            // Twice: the second time with loaded springs.
            contact_force(&law, &geometry, [&middle, &end], dt, &mut memory);
            let force = contact_force(&law, &geometry, [&middle, &end], dt, &mut memory);
            (force, memory.map(|memory| (memory.spring, memory.rolling)))
        };
        let ((one, one_springs), (two, two_springs)) = (seen(false), seen(true));
        prop_assert_eq!(one.map(|f| f.force), two.map(|f| -f.force));
        prop_assert_eq!(one.map(|f| f.torques), two.map(|f| [f.torques[1], f.torques[0]]));
        prop_assert_eq!(one_springs, two_springs.map(|(spring, rolling)| (-spring, -rolling)));
    }
}

#[test]
fn force_and_counter_force_of_two_grains_and_of_a_plane_are_opposite_to_the_last_bit() {
    let law = ContactLaw::new(3.0, 0.2).unwrap().with_friction(0.4).unwrap();
    let mut grains = cluster(2, 4);
    grains[1].position = grains[0].position + Vec3::new(0.3, 0.4, -0.1);
    let mut system = GrainSystem::new(GrainSetup::new(law), grains, Vec::new()).unwrap();
    for _ in 0..10 {
        system.substep(SUBSTEP, &[]).unwrap();
        let [one, two] = [0, 1].map(|i| system.contact_loads()[i].force);
        assert!(one.norm() > 0.0);
        assert_eq!(one, -two);
    }
    let sphere =
        Grain::sphere(Vec3::new(0.0, 0.0, 0.45), 0.5, 1.0).moving(Vec3::new(1.0, 2.0, -1.0));
    let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
    let mut system = GrainSystem::new(GrainSetup::new(law), vec![sphere], vec![floor]).unwrap();
    system.substep(SUBSTEP, &[]).unwrap();
    assert!(system.contact_loads()[0].force.norm() > 0.0);
    assert_eq!(system.contact_loads()[0].force, -system.force_on_plane(0));
}
