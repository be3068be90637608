//! Limits in which one model must become another.

use crate::common;

use approx::assert_abs_diff_eq;
use common::random::{Random, largest_difference};
use common::solid_rules::{GRADED, SUMS, WEIGHTINGS, operators, solid_rules};
use psmrt_reference::cell_collision::CellCollision;
use psmrt_reference::collision::{Collision, CollisionOperator, Preset};
use psmrt_reference::coverage::{Coverage, CoverageRule};
use psmrt_reference::directions::{OPPOSITE, Q};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::equilibrium::equilibrium;
use psmrt_reference::lattice::{Populations, Vec3, momentum, relaxation_time, viscosity};
use psmrt_reference::partial_saturation::{BeforeCollision, SolidOperator, Weighting};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

fn one_cell() -> Domain {
    Domain::new([1, 1, 1], Faces::PERIODIC).unwrap()
}

/// Post-collision populations of one cell in which each of `solids` has the given solid fraction
/// and velocity.
fn collide(
    f: &Populations,
    collision: Collision,
    body_force: Option<Vec3>,
    phase: SolidPhase,
) -> Populations {
    let mut setup = Setup::fluid(one_cell(), collision).with_solids(phase);
    setup.body_force = body_force;
    let operator = CollisionOperator::new(&collision);
    let phase = setup.solid_phase.as_ref().unwrap();
    let coverage = Coverage::new(&setup.domain, &phase.solids, phase.coverage);
    CellCollision::new(&setup, &operator, Some(&coverage)).collide(0, f, &mut Vec::new())
}

fn solid(epsilon: f64, velocity: Vec3) -> Solid {
    Solid { velocity, ..Solid::fixed_cells(vec![(0, epsilon)]) }
}

fn mrt(tau: f64) -> Collision {
    Collision::Mrt { rates: Rates::dhumieres(tau).unwrap() }
}

#[test]
fn vanishing_solid_leaves_the_fluids_collision_to_the_last_bit() {
    let mut random = Random(1);
    let g = Some(random.vector(1e-3));
    for collision in [Collision::Srt { tau: 0.7 }, mrt(0.7)] {
        for operator in SUMS {
            for weighting in WEIGHTINGS {
                let f = random.populations();
                let fluid = collide(&f, collision, g, SolidPhase::default());
                // A weight of 1e-300 runs the whole PS code and lies below the last bit.
                let solids = vec![solid(1e-300, random.vector(0.1))];
                let phase = SolidPhase { solids, weighting, operator, ..SolidPhase::default() };
                assert_eq!(
                    collide(&f, collision, g, phase),
                    fluid,
                    "{collision:?} {operator:?}: a solid of weight 1e-300 changes the collision of the fluid"
                );
            }
        }
    }
}

#[test]
fn mrt_with_equal_rates_is_srt() {
    let mut random = Random(2);
    for tau in [0.505, 0.8, 1.0, 3.0] {
        let equal = Collision::Mrt { rates: Rates::srt(tau).unwrap() };
        for g in [None, Some(random.vector(1e-2))] {
            let f = random.populations();
            let phase =
                || SolidPhase { solids: vec![solid(0.3, Vec3::zeros())], ..SolidPhase::default() };
            let srt = Collision::Srt { tau };
            // Two products with 19 x 19 matrices of order one on populations below 0.4; M's rows
            // reach 2394 in norm but M⁻¹ undoes that.
            assert!(
                largest_difference(&collide(&f, equal, g, phase()), &collide(&f, srt, g, phase()))
                    < 1e-14
            );
            let bare = || SolidPhase::default();
            assert!(
                largest_difference(&collide(&f, equal, g, bare()), &collide(&f, srt, g, bare()))
                    < 1e-14
            );
        }
    }
}

/// Those that leave a full cell with the momentum of the solid.
const STOPPING: [SolidOperator; 2] =
    [SolidOperator::NonEquilibriumBounceBack, SolidOperator::Superposition];

#[test]
fn full_cell_of_a_resting_solid_keeps_no_momentum_or_turns_all_of_it_back() {
    let mut random = Random(3);
    for collision in [Collision::Srt { tau: 0.6 }, mrt(0.6), mrt(2.0)] {
        for operator in STOPPING {
            let f = random.populations();
            for g in [None, Some(Vec3::new(1e-3, 0.0, 0.0))] {
                let solids = vec![solid(1.0, Vec3::zeros())];
                let phase = SolidPhase { solids, operator, ..SolidPhase::default() };
                // Momentum is a sum of 18 populations below 0.1.
                let left = momentum(&collide(&f, collision, g, phase)).norm();
                assert!(
                    left < 1e-15,
                    "{operator:?}: a full cell at rest leaves the momentum {left:e}"
                );
            }
        }
        let whole = (SolidOperator::FullBounceBack, Weighting::default());
        // f + (f_-a - f_a) rounds twice; two products with matrices that M reaches 2394 in and M⁻¹ undoes.
        for ((operator, weighting), bound) in [(whole, 1e-16), (GRADED, 1e-14)] {
            let f = random.populations();
            let solids = vec![solid(1.0, Vec3::zeros())];
            let phase = SolidPhase { solids, operator, weighting, ..SolidPhase::default() };
            let turned = collide(&f, collision, Some(Vec3::new(1e-3, 0.0, 0.0)), phase);
            let expected = std::array::from_fn(|a| f[OPPOSITE[a]]);
            assert!(
                largest_difference(&turned, &expected) < bound,
                "{collision:?}, {operator:?}: {turned:?}, not {expected:?}"
            );
        }
    }
}

#[test]
fn full_cell_leaves_with_the_momentum_of_the_solid_or_turned_about_it() {
    let mut random = Random(4);
    for (operator, weighting) in operators() {
        let (f, u_p) = (random.populations(), random.vector(0.1));
        let rho: f64 = f.iter().sum();
        let solids = vec![solid(1.0, u_p)];
        let phase = SolidPhase { solids, operator, weighting, ..SolidPhase::default() };
        let expected = match operator {
            SolidOperator::NonEquilibriumBounceBack | SolidOperator::Superposition => rho * u_p,
            SolidOperator::FullBounceBack | SolidOperator::GradedViscosity => {
                2.0 * rho * u_p - momentum(&f)
            }
        };
        // As above, twice over.
        let left = momentum(&collide(&f, mrt(0.8), None, phase));
        assert_abs_diff_eq!(left, expected, epsilon = 2e-15);
    }
}

#[test]
fn two_solids_that_half_fill_a_cell_weigh_as_one_that_fills_it() {
    let mut random = Random(5);
    for (operator, weighting) in solid_rules() {
        for tau in [0.5 + 1e-6, 0.6, 1.5] {
            let (f, u_p) = (random.populations(), random.vector(0.1));
            let with = |solids| SolidPhase { solids, weighting, operator, ..SolidPhase::default() };
            let one = collide(&f, mrt(tau), None, with(vec![solid(1.0, u_p)]));
            let two = collide(&f, mrt(tau), None, with(vec![solid(0.5, u_p), solid(0.5, u_p)]));
            let four = collide(&f, mrt(tau), None, with(vec![solid(0.9, u_p); 4]));
            // Sums of two and four products of populations below 0.4.
            assert!(largest_difference(&one, &two) < 1e-15);
            assert!(largest_difference(&one, &four) < 1e-15, "overfull cells count as full");
        }
    }
}

#[test]
fn every_solid_in_a_cell_acts_with_its_own_velocity_in_proportion_to_its_fraction() {
    let mut random = Random(6);
    let (f, first, second) = (random.populations(), random.vector(0.1), random.vector(0.1));
    let rho: f64 = f.iter().sum();
    let solids = vec![solid(0.75, first), solid(0.25, second)];
    let post = collide(&f, mrt(0.8), None, SolidPhase { solids, ..SolidPhase::default() });
    // Full cell: momentum of the mean velocity, weighted 3 : 1.
    assert!((momentum(&post) - rho * (0.75 * first + 0.25 * second)).norm() < 2e-15);
}

#[test]
fn noble_torczynski_weight_runs_from_zero_to_one_and_equals_the_fraction_where_it_must() {
    let weight = |epsilon, tau| Weighting::NobleTorczynski.weight(epsilon, tau);
    for tau in [0.5 + 1e-9, 0.6, 1.0, 100.0] {
        assert_eq!(weight(0.0, tau), 0.0);
        assert_eq!(weight(1.0, tau), 1.0);
        for step in 0..100 {
            let epsilon = f64::from(step) / 100.0;
            assert!(weight(epsilon + 0.01, tau) > weight(epsilon, tau));
            assert!(weight(epsilon, tau) <= epsilon);
        }
    }
    // tau -> infinity: B -> epsilon, with an error epsilon (1 - epsilon)/(tau - 1/2).
    assert!((weight(0.5, 1e6) - 0.5).abs() < 1e-6);
    // Worked by hand: epsilon = 1/2, tau = 1: (1/2 · 1/2)/(1/2 + 1/2) = 1/4, exactly.
    assert_eq!(weight(0.5, 1.0), 0.25);
}

#[test]
fn fluid_that_moves_with_the_solid_feels_nothing() {
    let mut random = Random(7);
    for operator in SUMS {
        for collision in [Collision::Srt { tau: 0.6 }, mrt(0.6)] {
            let (rho, u) = (random.between(0.9, 1.1), random.vector(0.2));
            let f = equilibrium(rho, &u);
            let prepared = operator
                .prepare(&BeforeCollision { f: &f, rho, u }, &CollisionOperator::new(&collision));
            let lambda = prepared.unwrap().lambda(&u);
            // Each entry is a difference of equal numbers below 0.4; M⁻¹ S (m - m_eq) adds
            // the round-off of two matrix products.
            assert!(
                largest_difference(&lambda, &[0.0; Q]) < 1e-15,
                "{operator:?}: the solid part changes an equilibrium that moves with the solid"
            );
        }
    }
}

#[test]
fn sphere_that_drifts_with_a_uniform_stream_leaves_it_uniform() {
    let u = Vec3::new(0.05, -0.03, 0.02);
    let sphere = Solid { velocity: u, ..Solid::fixed_sphere(Vec3::new(4.3, 3.9, 4.1), 2.5) };
    let domain = Domain::new([8, 8, 8], Faces::PERIODIC).unwrap();
    for (operator, weighting) in operators() {
        let solids = vec![sphere.clone()];
        let phase = SolidPhase { solids, operator, weighting, ..SolidPhase::default() };
        let setup = Setup::fluid(domain.clone(), mrt(0.6)).with_solids(phase);
        let mut solver = Solver::starting_from(setup, |_| (1.0, u)).unwrap();
        common::Budget::oracle(100_000).run(&mut solver, 80);
        // A uniform stream is a fixed point of every part of the step: what remains is round-off,
        // 1e-16 a step in each of 8^3 cells.
        let largest = solver.velocity_field().iter().map(|v| (v - u).norm()).fold(0.0, f64::max);
        assert!(
            largest < 1e-13,
            "{operator:?}: a sphere that drifts with a uniform stream disturbs it by {largest:e}"
        );
        assert!(solver.loads()[0].force.norm() < 1e-12);
    }
}

/// Newton's second law for a fluid without walls; a start that takes half a step's force with the wrong
/// sign is a whole step ahead.
#[test]
fn uniform_fluid_under_a_body_force_has_its_first_velocity_and_gains_g_over_rho_a_step() {
    let (rho, u) = (1.1, Vec3::new(0.01, -0.02, 0.005));
    let g = Vec3::new(1e-4, 2e-4, -3e-4);
    for collision in
        [Collision::Srt { tau: 0.7 }, Collision::Mrt { rates: Rates::dhumieres(0.7).unwrap() }]
    {
        let setup = Setup::fluid(one_cell(), collision).with_body_force(g);
        let mut solver = Solver::starting_from(setup, |_| (rho, u)).unwrap();
        for step in 0..20 {
            let expected = u + g * (f64::from(step) / rho);
            // Round-off of twenty steps.
            assert_abs_diff_eq!(solver.velocity_field()[0], expected, epsilon = 1e-14);
            solver.run(1).unwrap();
        }
    }
}

#[test]
fn torque_on_given_cells_is_taken_about_the_solids_centre() {
    let domain = Domain::new([4, 5, 6], Faces::PERIODIC).unwrap();
    let (place, centre) = ([3, 1, 4], Vec3::new(1.2, 2.9, 0.7));
    let fractions = vec![(domain.index(place), 0.7)];
    let solid = Solid { centre, ..Solid::fixed_cells(fractions) };
    let phase = SolidPhase { solids: vec![solid], ..SolidPhase::default() };
    let setup = Setup::fluid(domain, mrt(0.7)).with_solids(phase);
    let velocity = Vec3::new(0.01, -0.02, 0.03);
    let mut solver = Solver::starting_from(setup, |_| (1.0, velocity)).unwrap();
    solver.run(1).unwrap();
    let load = solver.loads()[0];
    // The one cell's force acts at its centre.
    let arm = Vec3::new(3.5, 1.5, 4.5) - centre;
    assert!(load.force.norm() > 1e-3);
    // Sums of a few products of numbers below 1.
    assert_abs_diff_eq!(load.torque, arm.cross(&load.force), epsilon = 1e-15);
}

#[test]
fn uniform_stream_has_the_mass_flux_rho_u_in_every_cell() {
    let domain = Domain::new([3, 4, 5], Faces::PERIODIC).unwrap();
    let (rho, u) = (1.02, Vec3::new(0.02, -0.01, 0.03));
    let solver = Solver::starting_from(Setup::fluid(domain, mrt(0.7)), |_| (rho, u)).unwrap();
    let flux = solver.mass_flux_field();
    assert_eq!(flux.len(), 60);
    for j in flux {
        // A collision leaves the momentum to rounding of numbers below 1.
        assert_abs_diff_eq!(j, rho * u, epsilon = 1e-15);
    }
}

#[test]
fn relaxation_time_is_what_the_viscosity_came_from() {
    // ν = (τ - 1/2)/3: by hand, water at τ = 0.8 has 0.1.
    assert_abs_diff_eq!(viscosity(0.8), 0.1, epsilon = 1e-16);
    assert_abs_diff_eq!(relaxation_time(0.1), 0.8, epsilon = 1e-15);
    for tau in [0.5001, 0.55, 1.0, 3.0] {
        assert_abs_diff_eq!(relaxation_time(viscosity(tau)), tau, epsilon = 1e-15);
    }
}

#[test]
fn a_cell_given_no_solid_costs_no_share() {
    let domain = Domain::new([2, 1, 1], Faces::PERIODIC).unwrap();
    let solid = Solid::fixed_cells(vec![(0, 0.0), (1, 0.25)]);
    let coverage = Coverage::new(&domain, &[solid], CoverageRule::Exact);
    assert!(coverage.shares(0).is_empty());
    assert_eq!(coverage.shares(1).len(), 1);
}

#[test]
fn presets_are_recognised_by_their_word_and_by_their_rates() {
    for preset in Preset::ALL {
        assert_eq!(Preset::from_word(preset.word()), Some(preset), "by its word");
        for tau in [0.51, 0.8, 1.5] {
            let collision = preset.collision(tau).unwrap();
            assert_eq!(Preset::of(&collision), Some(preset), "by its collision, tau = {tau}");
            // The same with its rates given as numbers, under MRT.
            let given = Collision::Mrt { rates: preset.rates(tau).unwrap() };
            assert_eq!(Preset::of(&given), Some(preset), "by its rates, tau = {tau}");
        }
    }
    let own = Rates::dhumieres(0.8).unwrap().with("e", 1.2).unwrap();
    assert_eq!(Preset::of(&Collision::Mrt { rates: own }), None, "a rate of the user's own");
}
