//! Each engine with a drive that changes from step to step.

use crate::common::Budget;
use crate::common::collisions::dhumieres;
use crate::common::random::Random;
use crate::driven;
use crate::parity::{Both, CELLS, mixed_faces, random_state};
use crate::trials::{EngineClaim, device_of};
use psmrt::engine::EngineName;
use psmrt_reference::domain::Domain;
use psmrt_reference::drive::FaceValue;
use psmrt_reference::setup::Setup;

fn a_force_that_oscillates_gives_womersleys_flow(engine: EngineName) {
    let mut budget = Budget::kernel(50_000);
    let gpu = device_of(engine);
    driven::a_force_that_oscillates_gives_womersleys_flow(engine, gpu.as_ref(), &mut budget);
}

fn a_plate_that_oscillates_gives_the_flow_of_stokes_second_problem(engine: EngineName) {
    let mut budget = Budget::kernel(50_000);
    let gpu = device_of(engine);
    driven::a_plate_that_oscillates_gives_the_flow_of_stokes_second_problem(
        engine,
        gpu.as_ref(),
        &mut budget,
    );
}

fn fluid_that_nothing_holds_back_has_the_momentum_that_a_changing_force_gave(engine: EngineName) {
    let mut budget = Budget::kernel(4_000);
    let gpu = device_of(engine);
    driven::fluid_that_nothing_holds_back_has_the_momentum_that_a_changing_force_gave(
        engine,
        gpu.as_ref(),
        &mut budget,
    );
}

fn faces_and_a_force_that_change_each_step_act_in_the_step_in_which_they_do_in_the_oracle(
    engine: EngineName,
) {
    let mut budget = Budget::kernel(20_000);
    let mut random = Random(11);
    // Those hold every kind between them.
    for (case, faces) in mixed_faces().into_iter().enumerate().step_by(3) {
        let domain = Domain::new(CELLS, faces).unwrap();
        let setup = Setup::fluid(domain, dhumieres(0.9)).with_body_force(random.vector(1e-3));
        let start = random_state(&mut random, setup.domain.cell_count());
        let mut both = Both::new(engine, &setup, &start);
        // In the last step nothing changes: what is new then must have come in before.
        for step in 0..6 {
            let mut drive = setup.drive();
            if step < 5 {
                drive.body_force = Some(random.vector(1e-3));
                for (axis, values) in drive.faces.iter_mut().enumerate() {
                    for value in values {
                        *value = match *value {
                            FaceValue::None => FaceValue::None,
                            FaceValue::Velocity(_) => {
                                let mut velocity = random.vector(0.03);
                                velocity[axis] = 0.0;
                                FaceValue::Velocity(velocity)
                            }
                            FaceValue::Density(_) => FaceValue::Density(random.between(0.98, 1.02)),
                        };
                    }
                }
                both.oracle.set_drive(&drive).unwrap();
                both.engine.set_drive(&drive).unwrap();
            }
            both.run(&mut budget, 1);
            let error = both.errors().populations;
            println!("faces {case}, step {step}: {error:.2}");
            assert!(
                error < 1.0,
                "faces {case}, step {step}: populations are {error} times as far from the oracle's as round-off of \
                 single precision explains: with the values of which step did they come in?"
            );
        }
    }
}

/// What is claimed here.
pub const CLAIMS: &[EngineClaim] = &[
    (
        "a_force_that_oscillates_gives_womersleys_flow",
        a_force_that_oscillates_gives_womersleys_flow,
    ),
    (
        "a_plate_that_oscillates_gives_the_flow_of_stokes_second_problem",
        a_plate_that_oscillates_gives_the_flow_of_stokes_second_problem,
    ),
    (
        "fluid_that_nothing_holds_back_has_the_momentum_that_a_changing_force_gave",
        fluid_that_nothing_holds_back_has_the_momentum_that_a_changing_force_gave,
    ),
    (
        "faces_and_a_force_that_change_each_step_act_in_the_step_in_which_they_do_in_the_oracle",
        faces_and_a_force_that_change_each_step_act_in_the_step_in_which_they_do_in_the_oracle,
    ),
];
