//! A coupled run goes on, bit for bit, from what the solver shows of its state.

use crate::common;

use common::Budget;
use common::collisions::dhumieres;
use common::random::Random;
use psmrt_reference::coupling::{CoupledSolver, CouplingSettings, Gravity, InternalFluid};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::SolidOperator;
use psmrt_reference::setup::{Setup, SolidPhase};

/// Eight grains that fall onto a floor that slides, across a periodic face, in a fluid.
fn falling(settings: CouplingSettings, operator: SolidOperator) -> CoupledSolver {
    let faces = Faces { z: [Face::wall(); 2], ..Faces::PERIODIC };
    let domain = Domain::new([10, 10, 12], faces).unwrap();
    let fluid = Setup::fluid(domain, dhumieres(0.7))
        .with_solids(SolidPhase { operator, ..SolidPhase::default() });
    let law = ContactLaw::from_duration_and_restitution(6.0, 0.5, 15.0).unwrap();
    let law = law.with_friction(0.4).unwrap().with_rolling(0.1).unwrap();
    let mut random = Random(3);
    let grains = (0..8)
        .map(|i| {
            let corner = [i % 2, i / 2 % 2, i / 4].map(f64::from);
            let place = Vec3::new(5.0 * corner[0], 5.0 * corner[1], 2.4 + 4.4 * corner[2]);
            Grain::sphere(place + random.vector(0.3), random.between(2.2, 2.4), 2.5)
                .moving(random.vector(0.05) - Vec3::new(0.0, 0.0, 0.05))
                .spinning(random.vector(0.03))
        })
        .collect();
    let mut planes = Plane::box_walls(Vec3::zeros(), Vec3::new(0.0, 0.0, 12.0), &[2], law);
    planes[0].velocity = Vec3::new(0.02, 0.0, 0.0);
    let sides = PeriodicBox { lengths: [Some(10.0), Some(10.0), None] };
    let setup = GrainSetup { sides, ..GrainSetup::new(law) };
    let start = |_| (1.0, Vec3::new(0.01, 0.0, 0.0));
    CoupledSolver::new(fluid, start, setup, grains, planes, settings).unwrap()
}

#[test]
fn going_on_from_a_saved_state_gives_the_bits_of_the_run_that_was_never_stopped() {
    let mut budget = Budget::oracle(1_100_000);
    let gravity = Some(Gravity::Reduced { acceleration: Vec3::new(0.0, 0.0, -4e-3) });
    let explicit = SolidOperator::NonEquilibriumBounceBack;
    for (operator, internal_fluid, both) in [
        (explicit, InternalFluid::Kept, &[false, true][..]),
        (explicit, InternalFluid::Lagged, &[false, true]),
        (SolidOperator::FullBounceBack, InternalFluid::Lagged, &[false]),
    ] {
        for &average_loads in both {
            let settings =
                CouplingSettings { internal_fluid, average_loads, gravity, ..Default::default() };
            let mut whole = falling(settings, operator);
            let run = |budget: &mut Budget, solver: &mut CoupledSolver, steps: u64| {
                budget.spend(steps * solver.fluid().domain().cell_count() as u64);
                solver.run(steps).unwrap();
            };
            run(&mut budget, &mut whole, 50);
            let fluid = whole.fluid();
            let saved = (fluid.setup().clone(), fluid.populations().to_vec(), fluid.memory());
            let grains = (*whole.grains().setup(), whole.grains().state());
            let springs = grains.1.pair_contacts.iter().filter(|c| c.memory.spring.norm() > 0.0);
            assert!(springs.count() >= 3 && !grains.1.plane_contacts.is_empty());
            let last = whole.last_steps().to_vec();
            assert_eq!(last.len(), 8, "the last step of each grain");
            let mut resumed =
                CoupledSolver::going_on_from(saved, grains, *whole.settings(), last).unwrap();
            run(&mut budget, &mut whole, 60);
            run(&mut budget, &mut resumed, 60);
            // Equal as numbers, none of which is zero of either sign or not a number: the same bits.
            assert!(whole.fluid().populations() == resumed.fluid().populations());
            assert!(whole.fluid().memory() == resumed.fluid().memory());
            assert!(whole.grains().state() == resumed.grains().state());
            assert!(whole.last_steps() == resumed.last_steps());
        }
    }
}
