//! What each shape answers for, against what is known of it.

use std::f64::consts::PI;

use crate::common::random::Random;
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Solid;

fn domain() -> Domain {
    Domain::new([16, 15, 14], Faces::PERIODIC).unwrap()
}

/// A sphere in the middle of the domain, and the same cell by cell.
fn twins(random: &mut Random) -> [Solid; 2] {
    let sphere =
        Solid::fixed_sphere(Vec3::repeat(7.2) + random.vector(0.6), random.between(0.6, 5.0));
    let covered = sphere.covered(&domain(), CoverageRule::Exact);
    let fractions = covered.iter().map(|at| (at.cell, at.epsilon)).collect();
    let cells = Solid { centre: sphere.centre, ..Solid::fixed_cells(fractions) };
    [sphere, cells]
}

#[test]
fn a_sphere_cell_by_cell_has_volume_and_diameter_of_the_sphere() {
    let mut random = Random(1);
    for _ in 0..20 {
        let [sphere, cells] = twins(&mut random);
        let exact = PI / 6.0 * sphere.diameter().powi(3);
        // Solid fractions are exact to 1e-12 each, of some hundred cells.
        for (found, of) in [(sphere.volume(), "the sphere"), (cells.volume(), "its cells")] {
            assert!((found / exact - 1.0).abs() < 1e-9, "volume of {of} {found}, exact {exact}");
        }
        let [one, two] = [sphere.diameter(), cells.diameter()];
        assert!((one - two).abs() < 1e-8, "diameters {one} and {two}");
    }
}

#[test]
fn bounds_hold_a_sphere_tightly_and_its_cells_to_whole_cells() {
    let mut random = Random(2);
    for _ in 0..20 {
        let [sphere, cells] = twins(&mut random);
        let [low, high] = sphere.bounds(&domain()).unwrap();
        let radius = 0.5 * sphere.diameter();
        assert!((low - sphere.centre).add_scalar(radius).norm() < 1e-12, "{low:?}");
        assert!((high - sphere.centre).add_scalar(-radius).norm() < 1e-12, "{high:?}");
        let [first, last] = cells.bounds(&domain()).unwrap();
        assert_eq!([first, last], [low.map(f64::floor), high.map(f64::ceil)]);
    }
    let empty = Solid::fixed_cells(vec![(3, 0.0)]);
    assert_eq!(empty.bounds(&domain()), None, "nothing of it is there");
}

#[test]
fn top_speed_is_that_of_the_fastest_cell() {
    let at = |x: usize, y: usize| (domain().index([x, y, 3]), 0.4);
    let centre = Vec3::new(5.5, 5.5, 3.5);
    let spin = Vec3::new(0.0, 0.0, 0.01);
    let bar =
        Solid { centre, angular_velocity: spin, ..Solid::fixed_cells(vec![at(5, 5), at(9, 5)]) };
    assert!((bar.top_speed(&domain()) - 0.04).abs() < 1e-15, "four cells from the axis");
    // ω × r points along +y at the far cell.
    let along = Solid { velocity: Vec3::new(0.0, 0.02, 0.0), ..bar.clone() };
    assert!((along.top_speed(&domain()) - 0.06).abs() < 1e-15);
    let against = Solid { velocity: Vec3::new(0.0, -0.02, 0.0), ..bar };
    assert!((against.top_speed(&domain()) - 0.02).abs() < 1e-15);
    let ball = Solid {
        velocity: Vec3::new(0.03, 0.0, 0.0),
        angular_velocity: spin,
        ..Solid::fixed_sphere(centre, 2.0)
    };
    assert!((ball.top_speed(&domain()) - 0.05).abs() < 1e-15);
}

#[test]
fn no_solid_touches_more_cells_than_it_says() {
    let mut random = Random(3);
    for _ in 0..50 {
        for solid in twins(&mut random) {
            let count = solid.covered(&domain(), CoverageRule::Exact).len() as f64;
            assert!(count <= solid.most_cells(), "{count} cells of {}", solid.most_cells());
        }
    }
}
