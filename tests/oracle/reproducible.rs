//! The same bits for any number of threads.

use crate::common;

use common::Budget;
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::{Load, Solid};
use psmrt_reference::solver::Solver;

fn result_on(threads: usize) -> (Vec<Populations>, Vec<Load>) {
    // 18 x 16 x 17 cells: more than are worked on serially, and not a multiple of anything.
    let lid = Face::Wall { velocity: Vec3::new(0.03, 0.0, 0.0) };
    let open = Face::NonReflectingPressure { density: 1.0, memory: 20.0 };
    let faces = Faces { x: [open; 2], z: [Face::wall(), lid], ..Faces::PERIODIC };
    let sphere = |x: f64, radius| Solid {
        velocity: Vec3::new(0.02, 0.01, -0.01),
        angular_velocity: Vec3::new(0.0, 0.01, 0.0),
        ..Solid::fixed_sphere(Vec3::new(x, 0.7 * x, 8.3), radius)
    };
    let phase =
        SolidPhase { solids: vec![sphere(3.0, 3.7), sphere(8.0, 3.1)], ..SolidPhase::default() };
    let collision = Collision::Mrt { rates: Rates::dhumieres(0.6).unwrap() };
    let setup = Setup::fluid(Domain::new([18, 16, 17], faces).unwrap(), collision)
        .with_solids(phase)
        .with_body_force(Vec3::new(1e-5, 2e-5, 0.0));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut solver = Solver::new(setup).unwrap();
        Budget::oracle(500_000).run(&mut solver, 30);
        (solver.populations().to_vec(), solver.loads().to_vec())
    })
}

#[test]
fn one_two_and_seven_threads_give_the_same_bits() {
    let (f, loads) = result_on(1);
    for threads in [2, 7] {
        let (other_f, other_loads) = result_on(threads);
        assert!(f == other_f, "populations differ on {threads} threads");
        assert_eq!(loads, other_loads, "loads differ on {threads} threads");
    }
}

#[test]
fn coverage_of_moved_solids_is_what_a_fresh_list_has() {
    use psmrt_reference::coverage::{Coverage, CoverageRule};
    let domain = Domain::new([9, 8, 7], Faces::PERIODIC).unwrap();
    let mut random = common::random::Random(1);
    let mut solids: Vec<Solid> = (0..6)
        .map(|i| {
            let centre = random.vector(6.0);
            let velocity = if i % 2 == 0 { random.vector(0.4) } else { Vec3::zeros() };
            Solid { velocity, ..Solid::fixed_sphere(centre, random.between(0.5, 4.9)) }
        })
        .collect();
    let mut coverage = Coverage::new(&domain, &solids, CoverageRule::Exact);
    for _ in 0..20 {
        for solid in &mut solids {
            solid.centre += solid.velocity;
        }
        coverage.update(&domain, &solids, CoverageRule::Exact);
        let fresh = Coverage::new(&domain, &solids, CoverageRule::Exact);
        for cell in 0..domain.cell_count() {
            assert_eq!(coverage.shares(cell), fresh.shares(cell));
        }
    }
}
