//! The lubrication correction against the exact force between spheres and at a wall, and the way in
//! which it stops a sphere.

use crate::common;

use common::golden_rows;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::lubrication::Lubrication;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::GrainSetup;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;
use std::f64::consts::PI;

const LAW: Lubrication =
    Lubrication { viscosity: 0.7, cutoff_gap: 0.2, smallest_gap: 1e-3, while_touching: true };

#[test]
fn force_resolved_at_the_cut_off_and_correction_together_are_the_exact_force() {
    let rows = golden_rows("dem/lubrication.csv");
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    // Radius 2: the table's gaps are over the radius. Cut-off at 0.1 radii, in row 7.
    let (a, cutoff_row) = (2.0, 7);
    assert_eq!(number(cutoff_row, 0) * a, LAW.cutoff_gap);
    let unit = 6.0 * PI * LAW.viscosity * a;
    for row in 1..cutoff_row {
        let gap = number(row, 0) * a;
        // The asymptotes leave out terms of order gap ln(1/gap): 0.027 at the cut-off for the wall
        // (the table's own asymptote there is 11.432, exact 11.459), 0.031 for spheres.
        let wall = LAW.at_plane(gap, a) / unit + number(cutoff_row, 1);
        assert!(
            (wall - number(row, 1)).abs() < 0.028,
            "gap {gap}: force resolved at the cut-off and correction towards a wall add up to \
             {wall}, not to the exact force within 0.028"
        );
        // Each at U: they approach at 2 U.
        let spheres = 2.0 * LAW.between_spheres(gap, [a, a]) / unit + number(cutoff_row, 2);
        assert!(
            (spheres - number(row, 2)).abs() < 0.032,
            "gap {gap}: force resolved at the cut-off and correction of two spheres add up to \
             {spheres}, not to the exact force within 0.032"
        );
    }
    // Beyond the cut-off nothing; below the smallest gap and in contact no more.
    assert_eq!(LAW.at_plane(0.2, a), 0.0);
    assert_eq!(LAW.between_spheres(0.3, [a, 1.0]), 0.0);
    assert_eq!(LAW.at_plane(-0.1, a), LAW.at_plane(1e-3, a));
    // Where contact is left to itself, the same up to the moment at which surfaces touch.
    let apart = Lubrication { while_touching: false, ..LAW };
    assert_eq!(apart.at_plane(0.0, a), LAW.at_plane(1e-3, a));
    assert_eq!([apart.at_plane(-1e-9, a), apart.between_spheres(-1e-9, [a, a])], [0.0, 0.0]);
}

#[test]
fn the_law_is_the_same_from_both_sides_and_a_huge_sphere_is_a_plane() {
    for gap in [1e-3, 0.01, 0.1] {
        let (one, two) =
            (LAW.between_spheres(gap, [1.0, 3.0]), LAW.between_spheres(gap, [3.0, 1.0]));
        // The same terms, differently rounded.
        assert!((one / two - 1.0).abs() < 1e-14);
        let plane = LAW.at_plane(gap, 1.0);
        let huge = LAW.between_spheres(gap, [1.0, 1e7]);
        assert!(
            (huge / plane - 1.0).abs() < 1e-5,
            "gap {gap}: a sphere ten million times as large resists by {huge}, a plane by {plane}"
        );
    }
}

#[test]
fn a_sphere_that_drifts_to_a_wall_loses_the_speed_of_the_closed_form() {
    let law = ContactLaw::new(1e5, 0.0).unwrap();
    let wall = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
    let (start, v0) = (0.2, 20.0);
    let sphere = Grain::sphere(Vec3::new(0.0, 0.0, 1.0 + start), 1.0, 1.0);
    let sphere = sphere.moving(Vec3::new(0.0, 0.0, -v0));
    let setup = GrainSetup { lubrication: Some(LAW), ..GrainSetup::new(law) };
    let mut system = GrainSystem::new(setup, vec![sphere], vec![wall]).unwrap();
    // m dv/dt = -c(h) v with dh/dt = -v: v = v₀ - ∫ c dh/m, with
    // ∫_h^{h_c} c = 6π μ a [a ln(h_c/h) - (h_c - h) a/h_c + (1/5) (h_c - h - h ln(h_c/h))]
    let exact = |h: f64| {
        let (log, way) = ((start / h).ln(), start - h);
        let integral = log - way / start + 0.2 * (way - h * log);
        v0 - 6.0 * PI * LAW.viscosity * integral / sphere.mass
    };
    let dt = 1e-6;
    let mut next = 0.1;
    while next > 2e-3 {
        system.substep(dt, &[]).unwrap();
        let Grain { position, velocity, .. } = system.grains()[0];
        let gap = position.z - 1.0;
        if gap < next {
            // Second order in dt; over the last gap (2e-3) it moves 3e-3 of the gap in a sub-step.
            assert!(
                (-velocity.z - exact(gap)).abs() < 1e-3,
                "gap {gap}: a sphere that drifts to a wall moves at {velocity}, by the closed \
                 form at {} towards it",
                exact(gap)
            );
            next *= 0.5;
        }
    }
    // It acts along the normal alone.
    let sideways = Vec3::new(5.0, 0.0, 0.0);
    system.edit(|grains, _| grains[0].velocity = sideways).unwrap();
    system.step(1e-4, &[]).unwrap();
    assert_eq!(system.grains()[0].velocity, sideways);
    assert_eq!(system.grains()[0].angular_velocity, Vec3::zeros());
}

#[test]
fn it_holds_back_parting_spheres_as_much_as_meeting_ones_and_keeps_momentum() {
    let law = ContactLaw::new(1e4, 0.0).unwrap();
    let apart = |speed: f64| {
        let one = Grain::sphere(Vec3::zeros(), 1.0, 1.0).moving(Vec3::new(-speed, 0.0, 0.0));
        let two = Grain::sphere(Vec3::new(1.55, 0.0, 0.0), 0.5, 2.0);
        let setup = GrainSetup { lubrication: Some(LAW), ..GrainSetup::new(law) };
        let system = GrainSystem::new(setup, vec![one, two], Vec::new()).unwrap();
        assert_eq!(system.contact_loads()[0].force, -system.contact_loads()[1].force);
        system.contact_loads()[0].force.x
    };
    let coefficient = LAW.between_spheres(0.05, [1.0, 0.5]);
    assert!((apart(1.0) / coefficient - 1.0).abs() < 1e-12);
    assert_eq!(apart(-1.0), -apart(1.0));
}

#[test]
fn a_lubrication_that_makes_no_sense_is_refused() {
    let message = |law: Lubrication| law.checked().unwrap_err().to_string();
    assert!(
        message(Lubrication { viscosity: 0.0, ..LAW }).contains("viscosity = 0 must be positive")
    );
    for viscosity in [-1.0, f64::INFINITY, f64::NAN] {
        assert!(Lubrication { viscosity, ..LAW }.checked().is_err(), "viscosity {viscosity}");
    }
    let infinite = f64::INFINITY;
    for (smallest_gap, cutoff_gap) in
        [(0.3, 0.2), (0.2, 0.2), (0.0, 0.2), (-1e-3, 0.2), (1e-3, infinite), (f64::NAN, 0.2)]
    {
        let gaps = message(Lubrication { smallest_gap, cutoff_gap, ..LAW });
        assert!(gaps.contains("0 < smallest_gap < cutoff_gap"), "{gaps}");
    }
    assert_eq!(LAW.checked(), Ok(LAW));
}

#[test]
fn the_largest_coefficient_is_that_of_a_sphere_as_close_to_a_plane_as_counts() {
    let unit = 6.0 * PI * LAW.viscosity * 3.0;
    // l/h - l/h_c + (1/5) ln(h_c/h) with l = a = 3, h = 1e-3, h_c = 0.2
    let expected = unit * (3000.0 - 15.0 + 0.2 * 200.0_f64.ln());
    let largest = LAW.largest(3.0);
    assert!((largest / expected - 1.0).abs() < 1e-14, "{largest}, expected {expected}");
    for radius in [0.5, 3.0] {
        assert!(LAW.between_spheres(1e-3, [3.0, radius]) < largest);
    }
}
