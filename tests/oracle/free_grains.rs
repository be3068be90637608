//! What acts on a free grain besides contacts, term by term, for given loads of the fluid.

use psmrt_reference::coupling::{
    CouplingSettings, FreeGrains, Gravity, InternalFluid, balancing_force,
};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

const FIRST: Load = Load { force: Vec3::new(0.3, -0.2, 0.5), torque: Vec3::new(0.7, 0.4, -0.9) };
const SECOND: Load = Load { force: Vec3::new(-0.1, 0.6, 0.2), torque: Vec3::new(0.2, -0.8, 0.1) };

/// One grain of radius 2 and density 3, in a fluid of density 1.5, at `place`.
fn one_grain(faces: Faces, place: Vec3, settings: CouplingSettings) -> FreeGrains {
    let domain = Domain::new([20, 22, 24], faces).unwrap();
    let length = |axis: usize| domain.is_periodic(axis).then(|| domain.cells()[axis] as f64);
    let sides = PeriodicBox { lengths: [length(0), length(1), length(2)] };
    let setup = GrainSetup { sides, ..GrainSetup::new(ContactLaw::new(1.0, 0.0).unwrap()) };
    let settings = CouplingSettings { fluid_density: 1.5, ..settings };
    let grain = Grain::sphere(place, 2.0, 3.0).moving(Vec3::new(0.01, 0.02, 0.0));
    FreeGrains::new(&domain, setup, vec![grain], Vec::new(), settings).unwrap()
}

fn middle() -> Vec3 {
    Vec3::new(9.0, 10.0, 11.0)
}

/// Errors of a load against what it should be.
fn assert_load(found: &Load, expected: Load, what: &str) {
    let off = (found.force - expected.force).norm() + (found.torque - expected.torque).norm();
    // A few roundings of numbers below 100.
    assert!(off < 1e-13, "{what}: {found:?}, expected {expected:?}");
}

#[test]
fn averaged_loads_are_the_mean_of_the_last_two_forces_and_torques() {
    let kept = CouplingSettings { internal_fluid: InternalFluid::Kept, ..Default::default() };
    for (average_loads, share) in [(false, 0.0), (true, 0.5)] {
        let settings = CouplingSettings { average_loads, ..kept };
        let mut grains = one_grain(Faces::PERIODIC, middle(), settings);
        grains.step(&[FIRST]).unwrap();
        assert_eq!(grains.last_steps().len(), 1);
        assert_eq!(grains.last_steps()[0].load, FIRST);
        assert_eq!(grains.last_steps()[0].velocity, Vec3::new(0.01, 0.02, 0.0));
        let expected = Load {
            force: share * FIRST.force + (1.0 - share) * SECOND.force,
            torque: share * FIRST.torque + (1.0 - share) * SECOND.torque,
        };
        assert_load(&grains.outside_loads(&[SECOND])[0], expected, "the second load");
    }
}

#[test]
fn lagged_inertia_of_the_fluid_inside_is_its_mass_and_moment_times_the_last_change_of_motion() {
    let mut grains = one_grain(Faces::PERIODIC, middle(), CouplingSettings::default());
    assert_load(&grains.outside_loads(&[FIRST])[0], FIRST, "before the first step");
    grains.step(&[FIRST]).unwrap();
    // The step changes velocity and angular velocity by F/m_s and T/I_s; m_f/m_s = I_f/I_s is 1/2 of these loads.
    let expected = Load {
        force: SECOND.force + 0.5 * FIRST.force,
        torque: SECOND.torque + 0.5 * FIRST.torque,
    };
    assert_load(&grains.outside_loads(&[SECOND])[0], expected, "after a step under the first load");
}

#[test]
fn weight_is_less_the_buoyancy_unless_the_fluid_carries_gravity_too() {
    let acceleration = Vec3::new(0.0, 1e-3, -2e-3);
    let volume = sphere_volume(2.0);
    for (gravity, density) in [
        (Gravity::Reduced { acceleration }, 3.0 - 1.5),
        (Gravity::Balanced { acceleration }, 3.0 - 1.5),
        (Gravity::OnFluidToo { acceleration }, 3.0),
    ] {
        let settings = CouplingSettings { gravity: Some(gravity), ..Default::default() };
        let grains = one_grain(Faces::PERIODIC, middle(), settings);
        let expected = Load { force: FIRST.force + density * volume * acceleration, ..FIRST };
        assert_load(&grains.outside_loads(&[FIRST])[0], expected, &format!("{gravity:?}"));
        assert_eq!(gravity.acceleration(), acceleration);
    }
}

#[test]
fn a_mirror_plane_through_the_centre_adds_the_load_of_the_other_half() {
    let slip = [Face::FreeSlip; 2];
    // Across x on the upper side, across y on the lower one, both, and a mirror that is elsewhere.
    let (x, y) = (Faces { x: slip, ..Faces::PERIODIC }, Faces { y: slip, ..Faces::PERIODIC });
    let both = Faces { x: slip, y: slip, ..Faces::PERIODIC };
    let Load { force: f, torque: t } = FIRST;
    for (faces, place, force, torque) in [
        (
            x,
            Vec3::new(20.0, 10.0, 11.0),
            Vec3::new(0.0, 2.0 * f.y, 2.0 * f.z),
            2.0 * t.x * Vec3::x(),
        ),
        (y, Vec3::new(9.0, 0.0, 11.0), Vec3::new(2.0 * f.x, 0.0, 2.0 * f.z), 2.0 * t.y * Vec3::y()),
        (both, Vec3::new(0.0, 22.0, 11.0), Vec3::new(0.0, 0.0, 4.0 * f.z), Vec3::zeros()),
        (x, middle(), f, t),
        // On the face of a periodic axis nothing is mirrored.
        (x, Vec3::new(9.0, 0.0, 11.0), f, t),
    ] {
        let grains = one_grain(faces, place, CouplingSettings::default());
        let what = format!("at {place}");
        assert_load(&grains.outside_loads(&[FIRST])[0], Load { force, torque }, &what);
    }
}

#[test]
fn balancing_force_counts_the_parts_of_grains_that_the_domain_holds() {
    let acceleration = Vec3::new(0.0, 0.0, -1e-2);
    let slip = [Face::FreeSlip; 2];
    let faces = Faces { x: slip, y: slip, ..Faces::PERIODIC };
    let domain = Domain::new([10, 12, 14], faces).unwrap();
    let grain = |x: f64, y: f64, density: f64| Grain::sphere(Vec3::new(x, y, 5.0), 1.5, density);
    // A whole one, a half, and a quarter; lighter ones are pulled up.
    let grains = [grain(4.0, 6.0, 3.0), grain(10.0, 6.0, 0.5), grain(0.0, 12.0, 7.0)];
    let found = balancing_force(&domain, &grains, 2.0, acceleration);
    let net_mass = sphere_volume(1.5) * (1.0 - 0.5 * 1.5 + 0.25 * 5.0);
    let expected = -net_mass / 1680.0 * acceleration;
    assert!((found - expected).norm() < 1e-16, "{found}, expected {expected}");
}
