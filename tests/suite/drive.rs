//! The oracle with a drive that changes from step to step, by way of the library; the kernel in
//! `tests/device/drive.rs`. And drives that no set-up can take.

use crate::common::Budget;
use crate::common::collisions::srt;
use crate::driven;
use psmrt::engine::{EngineName, StartError, starting_from};
use psmrt_reference::domain::{Domain, DomainError, Face, Faces};
use psmrt_reference::drive::{Drive, DriveError, FaceValue};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::{Setup, SetupError};

#[test]
fn a_force_that_oscillates_gives_womersleys_flow() {
    let mut budget = Budget::oracle(50_000);
    driven::a_force_that_oscillates_gives_womersleys_flow(EngineName::Reference, None, &mut budget);
}

#[test]
fn a_plate_that_oscillates_gives_the_flow_of_stokes_second_problem() {
    let mut budget = Budget::oracle(50_000);
    driven::a_plate_that_oscillates_gives_the_flow_of_stokes_second_problem(
        EngineName::Reference,
        None,
        &mut budget,
    );
}

#[test]
fn the_error_of_an_oscillating_flow_is_of_second_order() {
    let mut budget = Budget::oracle(200_000);
    driven::the_error_of_an_oscillating_flow_is_of_second_order(
        EngineName::Reference,
        None,
        &mut budget,
    );
}

#[test]
fn fluid_that_nothing_holds_back_has_the_momentum_that_a_changing_force_gave() {
    let mut budget = Budget::oracle(4_000);
    driven::fluid_that_nothing_holds_back_has_the_momentum_that_a_changing_force_gave(
        EngineName::Reference,
        None,
        &mut budget,
    );
}

/// A channel with a wall at -y, an inlet at -x and a face of given pressure at +x.
fn channel() -> Setup {
    let inlet = Face::VelocityInlet { velocity: Vec3::new(0.01, 0.0, 0.0) };
    let (outlet, slip) = (Face::Pressure { density: 1.0 }, Face::FreeSlip);
    let faces = Faces { x: [inlet, outlet], y: [Face::wall(), slip], z: [Face::Periodic; 2] };
    Setup::fluid(Domain::new([4, 3, 2], faces).unwrap(), srt(0.8))
}

#[test]
fn a_drive_that_the_set_up_cannot_take_is_refused_and_changes_nothing() {
    let given = channel();
    let mut engine =
        starting_from(EngineName::Reference, &given, None, None, |_| (1.0, Vec3::zeros())).unwrap();
    let drive = given.drive();
    let with = |axis: usize, side: usize, value| {
        let mut changed = drive.clone();
        changed.faces[axis][side] = value;
        changed
    };
    let velocity = |x, y| FaceValue::Velocity(Vec3::new(x, y, 0.0));
    let mut refused = |drive: &Drive| match engine.set_drive(drive) {
        Err(StartError::Drive(error)) => {
            assert_eq!(*engine.setup(), given, "{error}");
            error
        }
        other => panic!("{drive:?} was not refused: {other:?}"),
    };
    let force = Drive { body_force: Some(Vec3::zeros()), ..drive.clone() };
    assert_eq!(refused(&force), DriveError::ForceAppears);
    let other = |face, holds, given| DriveError::OtherValue { face, holds, given };
    assert_eq!(refused(&with(0, 1, velocity(0.0, 0.0))), other("+x", "a density", "a velocity"));
    assert_eq!(refused(&with(1, 1, FaceValue::Density(1.0))), other("+y", "no value", "a density"));
    assert_eq!(refused(&with(1, 0, FaceValue::None)), other("-y", "a velocity", "no value"));
    let through = DomainError::WallThroughItself { face: "-y", normal: 0.01 };
    assert_eq!(
        refused(&with(1, 0, velocity(0.0, 0.01))),
        DriveError::Value(SetupError::Domain(through))
    );
    for value in [FaceValue::Density(-1.0), FaceValue::Density(f64::NAN)] {
        assert!(matches!(refused(&with(0, 1, value)), DriveError::Value(_)), "{value:?}");
    }
    let mut forced = given.clone().with_body_force(Vec3::zeros());
    assert_eq!(forced.set_drive(&drive), Err(DriveError::ForceVanishes));
    let broken = Drive { body_force: Some(Vec3::repeat(f64::INFINITY)), ..drive };
    assert!(matches!(forced.set_drive(&broken), Err(DriveError::Value(_))));
}
