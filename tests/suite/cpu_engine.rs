//! The CPU engine: against the oracle over several runs of cells, and the same bits whatever computes them.

use psmrt::engine::{Block, CpuEngine, FluidEngine, Start};
use psmrt::lanes::Real;
use psmrt_reference::coupling::grips;
use psmrt_reference::directions::Q;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

use crate::common::Budget;
use crate::common::collisions::dhumieres;
use crate::common::random::Random;

/// More cells than a thread takes at a time, so that rows of several runs meet; a row is no multiple of a vector.
const CELLS: [usize; 3] = [37, 20, 30];

fn state(centre: Vec3) -> (f64, Vec3) {
    let [x, y, z] = (0.2 * centre).into();
    (1.0 + 0.01 * x.cos(), 0.02 * Vec3::new(y.sin(), z.cos(), (x + y).sin()))
}

/// From a state, with solids that are not free.
fn from<'a>(state: &'a dyn Fn(Vec3) -> (f64, Vec3)) -> Start<'a> {
    Start::State { state, is_free: false }
}

/// Every kind of face but two, a body force, spheres that stay, that move, that overlap, and one across faces.
fn scenes() -> Vec<(&'static str, Setup)> {
    let lid = Face::Wall { velocity: Vec3::new(0.03, -0.02, 0.0) };
    let inlet = Face::VelocityInlet { velocity: Vec3::new(0.02, 0.0, 0.01) };
    let end = Face::NonReflectingPressure { density: 1.0, memory: 40.0 };
    let through = Face::DevelopedPressure { density: 1.001 };
    let open = Faces { x: [inlet, end], y: [Face::FreeSlip, through], z: [Face::wall(), lid] };
    let still = Vec3::zeros();
    let sphere = |centre: [f64; 3], radius, velocity: Vec3, angular_velocity: Vec3| Solid {
        velocity,
        angular_velocity,
        ..Solid::fixed_sphere(Vec3::from(centre), radius)
    };
    let solids = vec![
        sphere([9.3, 9.2, 14.8], 6.2, Vec3::new(0.02, 0.0, -0.01), Vec3::new(0.0, 0.01, 0.0)),
        sphere([18.4, 10.6, 15.1], 4.0, Vec3::new(-0.02, 0.01, 0.0), still),
        sphere([30.1, 4.3, 8.2], 4.4, still, Vec3::new(0.01, -0.02, 0.01)),
        sphere([30.8, 18.9, 29.1], 2.7, still, still),
    ];
    let phase = SolidPhase { solids, ..SolidPhase::default() };
    let of = |faces| Setup::fluid(Domain::new(CELLS, faces).unwrap(), dhumieres(0.7));
    let g = Vec3::new(1e-5, -2e-5, 5e-6);
    vec![
        ("periodic", of(Faces::PERIODIC).with_solids(phase.clone()).with_body_force(g)),
        ("open", of(open).with_solids(phase)),
        ("no solids", of(open).with_body_force(g)),
    ]
}

/// Makes a step of the fluid and moves the solids.
fn step(engine: &mut dyn FluidEngine) {
    engine.advance(1, true).unwrap();
    let phase = engine.setup().solid_phase.as_ref();
    let mut solids = phase.map_or_else(Vec::new, |phase| phase.solids.clone());
    solids.iter_mut().for_each(|solid| solid.centre += solid.velocity);
    engine.place_solids(solids).unwrap();
}

/// All that an engine holds.
fn saved(engine: &dyn FluidEngine) -> Vec<u8> {
    let mut bytes = Vec::new();
    engine.save(&mut bytes).unwrap();
    bytes
}

/// The same, and the loads.
fn bits(engine: &dyn FluidEngine) -> Vec<u8> {
    let mut bytes = saved(engine);
    for load in engine.loads().unwrap() {
        let values = load.force.iter().chain(load.torque.iter());
        values.for_each(|value| bytes.extend(value.to_le_bytes()));
    }
    bytes
}

#[test]
fn grips_agree_with_the_oracle_in_any_vectors_and_asking_for_them_changes_nothing() {
    let mut budget = Budget::oracle(134_000);
    for (name, mut setup) in scenes() {
        let Some(phase) = &mut setup.solid_phase else { continue };
        phase.operator = SolidOperator::FullBounceBack;
        let mut oracle = Solver::starting_from(setup.clone(), state).unwrap();
        let mut asked = CpuEngine::<f64>::start(setup.clone(), &from(&state));
        let mut left_alone = CpuEngine::<f64>::start(setup.clone(), &from(&state));
        let mut scalar = CpuEngine::<f64>::start(setup.clone(), &from(&state));
        scalar.fluid_mut().do_without_vectors();
        let wanted = [0, 1, 2, 3];
        for _ in 0..3 {
            let found = asked.grips(&wanted).unwrap();
            assert_eq!(found, asked.grips(&wanted).unwrap(), "{name}: asked again");
            assert_eq!(found, scalar.grips(&wanted).unwrap(), "{name}: cell by cell");
            for (number, (found, expected)) in found.iter().zip(grips(&oracle)).enumerate() {
                // Sums of up to 2 · 1,000 terms, the moments with arms of up to 6 cells once or twice, of densities near 1
                // and weights that are a few 1e-14 off (below).
                let off = [
                    (found.impulse - expected.impulse).norm(),
                    (found.moment - expected.moment).norm() / 6.0,
                    (found.mass - expected.mass).abs(),
                    (found.mass_arm - expected.mass_arm).norm() / 6.0,
                    (found.inertia - expected.inertia).norm() / 36.0,
                    (found.displaced - expected.displaced).abs(),
                ];
                let off = off.into_iter().fold(0.0, f64::max);
                assert!(
                    off < 1e-10,
                    "{name}, solid {number}: {found:?}, the oracle's {expected:?}"
                );
            }
            budget.spend(setup.domain.cell_count() as u64);
            oracle.step().unwrap();
            step(&mut asked);
            step(&mut left_alone);
            step(&mut scalar);
            assert!(saved(&asked) == saved(&left_alone), "{name}: asking has left a trace");
            // What is known of the grips need not be added up again: other sums of the same terms, as above.
            let loads = asked.loads().unwrap().into_iter().zip(left_alone.loads().unwrap());
            for (number, (by_grips, added_up)) in loads.enumerate() {
                let force = (by_grips.force - added_up.force).norm();
                let torque = (by_grips.torque - added_up.torque).norm() / 6.0;
                assert!(
                    force.max(torque) < 1e-10,
                    "{name}, solid {number}: {by_grips:?}, added up {added_up:?}"
                );
            }
        }
    }
}

#[test]
fn grips_that_are_known_serve_the_velocities_of_the_collision_and_no_other_places() {
    for (name, mut setup) in scenes() {
        let Some(phase) = &mut setup.solid_phase else { continue };
        phase.operator = SolidOperator::FullBounceBack;
        let solids = phase.solids.clone();
        let moved = |by: f64, faster: f64| -> Vec<Solid> {
            let mut solids = solids.clone();
            for solid in &mut solids {
                solid.centre.x += by;
                solid.velocity *= faster;
            }
            solids
        };
        for (what, by, faster) in [("elsewhere", 0.3, 1.0), ("faster", 0.0, 1.5)] {
            let mut asked = CpuEngine::<f64>::start(setup.clone(), &from(&state));
            let mut left_alone = CpuEngine::<f64>::start(setup.clone(), &from(&state));
            let wanted: Vec<usize> = (0..solids.len()).collect();
            asked.grips(&wanted).unwrap();
            for engine in [&mut asked, &mut left_alone] {
                engine.place_solids(moved(by, faster)).unwrap();
                engine.advance(1, true).unwrap();
            }
            assert!(saved(&asked) == saved(&left_alone), "{name}, {what}: the fluid");
            let loads = asked.loads().unwrap().into_iter().zip(left_alone.loads().unwrap());
            for (number, (known, added_up)) in loads.enumerate() {
                // Elsewhere the old grips say nothing: the very same sums. Faster: round-off, as above.
                let off = (known.force - added_up.force).norm();
                let most = if by == 0.0 { 1e-10 } else { 0.0 };
                assert!(off <= most, "{name}, {what}, solid {number}: {known:?}, {added_up:?}");
            }
        }
    }
}

#[test]
fn double_precision_agrees_with_the_oracle_to_round_off_where_runs_of_cells_meet() {
    let mut budget = Budget::oracle(799_200);
    for (name, setup) in scenes() {
        let mut oracle = Solver::starting_from(setup.clone(), state).unwrap();
        let mut cpu = CpuEngine::<f64>::start(setup.clone(), &from(&state));
        for _ in 0..12 {
            oracle.step().unwrap();
            step(&mut cpu);
        }
        budget.spend(12 * setup.domain.cell_count() as u64);
        // Each of twelve steps rounds a population, of up to 1/3, a few tens of times in either. The solid fractions of
        // the largest ball are each a few (1 + radius³) 1e-16 off, the weights up to (τ + 1/2)/(τ - 1/2) = 6 times as
        // much; they weigh changes of up to 0.05.
        let of_fractions = 3.0 * (1.0 + 6.2_f64.powi(3)) * 1e-16 * 6.0 * 0.05;
        let bound = 12.0 * (16.0 * f64::EPSILON / 3.0 + of_fractions);
        let all = cpu.populations(Block::whole(&setup.domain)).unwrap();
        for (cell, expected) in oracle.populations().iter().enumerate() {
            let found = all[cell];
            for a in 0..Q {
                let error = (found[a] - expected[a]).abs();
                assert!(
                    error < bound,
                    "{name}: population {a} of cell {:?} is {} after 12 steps, the oracle's {}: {error:e} apart, \
                     {bound:e} is round-off",
                    setup.domain.coordinates(cell),
                    found[a],
                    expected[a],
                );
            }
        }
        // A force is a sum over up to 1,000 cells of differences of populations.
        let bound = 1000.0 * bound;
        for (number, (found, expected)) in
            cpu.loads().unwrap().iter().zip(oracle.loads()).enumerate()
        {
            let error = (found.force - expected.force).norm()
                + (found.torque - expected.torque).norm() / 10.0;
            assert!(
                error < bound,
                "{name}: load of solid {number}: {found:?}, the oracle's {expected:?}"
            );
        }
        for (found, expected) in cpu.displaced().unwrap().iter().zip(oracle.displaced()) {
            assert!(
                (found - expected).abs() < 1e-10,
                "{name}: Σ B_s is {found}, the oracle's {expected}"
            );
        }
        let coverage = oracle.coverage();
        for (number, found) in cpu.cells(Block::whole(&setup.domain)).unwrap().iter().enumerate() {
            let expected = coverage.map_or(0.0, |coverage| coverage.solid_fraction(number));
            // (1 + radius³) 1e-16 and the same again for the oracle's.
            assert!(
                (found.solid_fraction - expected).abs() < 1e-12,
                "{name}: solid fraction {} of cell {number}, the oracle's {expected}",
                found.solid_fraction,
            );
        }
        let expected =
            oracle.mass_flux_field().iter().sum::<Vec3>() / setup.domain.cell_count() as f64;
        let found = cpu.means().unwrap().mass_flux;
        assert!(
            (found - expected).norm() < 1e-15,
            "{name}: mean mass flux {found:?}, the oracle's {expected:?}"
        );
    }
}

#[test]
fn cells_that_a_tight_solid_fills_are_left_out_and_the_flow_stays_the_same() {
    // Rows of 64 cells, so that some of the sphere's are whole sixteens: x from 16 to 31.
    let (centre, radius) = (Vec3::new(24.3, 12.2, 11.8), 11.0);
    let solids = SolidPhase {
        solids: vec![Solid::fixed_sphere(centre, radius)],
        operator: SolidOperator::GradedViscosity,
        weighting: Weighting::Graded,
        ..SolidPhase::default()
    };
    let domain = Domain::new([64, 24, 24], Faces::PERIODIC).unwrap();
    let setup = Setup::fluid(domain.clone(), dhumieres(0.7))
        .with_solids(solids)
        .with_body_force(Vec3::new(1e-5, 2e-5, 0.0));
    let run = |with_loads: bool| {
        let mut cpu = CpuEngine::<f64>::start(setup.clone(), &from(&state));
        for _ in 0..20 {
            cpu.advance(1, with_loads).unwrap();
        }
        cpu.populations(Block::whole(&domain)).unwrap()
    };
    // Loads are sums over all cells, so nothing can be left out.
    let (all, some) = (run(true), run(false));
    assert_ne!(all, some, "something was left out");
    // Each of twenty steps rounds a population, of up to 1/3, a few tens of times in either.
    let bound = 20.0 * 16.0 * f64::EPSILON / 3.0;
    for cell in 0..domain.cell_count() {
        for a in 0..Q {
            let error = (all[cell][a] - some[cell][a]).abs();
            assert!(
                error < bound,
                "population {a} of cell {:?} is {error:e} off if filled cells are left out, {bound:e} is round-off",
                domain.coordinates(cell)
            );
        }
    }
}

/// The bits after some steps on so many threads, with vectors or without.
fn computed<T: Real>(setup: &Setup, threads: usize, with_vectors: bool) -> Vec<u8> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut engine = CpuEngine::<T>::start(setup.clone(), &from(&state));
        if !with_vectors {
            engine.fluid_mut().do_without_vectors();
        }
        (0..5).for_each(|_| step(&mut engine));
        bits(&engine)
    })
}

#[test]
fn bits_are_the_same_for_any_number_of_threads_and_any_width_of_vectors() {
    fn same<T: Real>(name: &str, setup: &Setup) {
        let expected = computed::<T>(setup, 1, true);
        for threads in [2, 5] {
            assert!(
                computed::<T>(setup, threads, true) == expected,
                "{name}, {} precision: {threads} threads give other bits than one",
                T::PRECISION,
            );
        }
        assert!(
            computed::<T>(setup, 2, false) == expected,
            "{name}, {} precision: cell by cell other bits come out than in vectors",
            T::PRECISION,
        );
    }
    for (name, setup) in scenes() {
        same::<f32>(name, &setup);
        same::<f64>(name, &setup);
    }
}

#[test]
fn saved_state_goes_on_bit_for_bit_after_an_odd_and_an_even_number_of_steps() {
    fn resumes<T: Real>(name: &str, setup: &Setup) {
        for before in [3, 4] {
            let mut straight = CpuEngine::<T>::start(setup.clone(), &from(&state));
            (0..before).for_each(|_| step(&mut straight));
            let mut saved = Vec::new();
            straight.save(&mut saved).unwrap();
            let (solids, loads) = (
                straight.setup().solid_phase.as_ref().map_or_else(Vec::new, |p| p.solids.clone()),
                straight.loads().unwrap(),
            );
            let mut resumed =
                CpuEngine::<T>::start(setup.clone(), &from(&|_| (1.0, Vec3::zeros())));
            resumed.load(&mut &saved[..], solids, loads).unwrap();
            assert!(bits(&resumed) == bits(&straight), "{name}: what is loaded is what was saved");
            (0..3).for_each(|_| step(&mut straight));
            (0..3).for_each(|_| step(&mut resumed));
            assert!(
                bits(&resumed) == bits(&straight),
                "{name}, {} precision: resumed after {before} steps, other bits come out",
                T::PRECISION,
            );
        }
    }
    for (name, setup) in scenes() {
        resumes::<f32>(name, &setup);
        resumes::<f64>(name, &setup);
    }
}

#[test]
fn guard_sees_the_first_broken_cell_that_it_sees_on_the_oracle() {
    use psmrt_reference::guard::Guard;
    let domain = Domain::new(CELLS, Faces::PERIODIC).unwrap();
    let setup = Setup::fluid(domain.clone(), dhumieres(0.7));
    let guard = Guard::new(setup.guard);
    let rest: Populations = psmrt_reference::equilibrium::equilibrium(1.0, &Vec3::zeros());
    let mut random = Random(5);
    // Not a number, not finite, no positive density, all in order, and too fast: 2/3 of a cell per step.
    for broken in [f64::NAN, f64::INFINITY, -3.0, 0.6, 2.0] {
        let mut f = vec![rest; domain.cell_count()];
        for _ in 0..3 {
            let at = random.between(0.0, f.len() as f64).floor();
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a cell's number"
            )]
            let cell = at as usize;
            f[cell][1] = broken;
        }
        let mut cpu = CpuEngine::<f64>::start(setup.clone(), &Start::Populations(&f));
        let (found, expected) = (cpu.findings(&guard).unwrap(), guard.findings(&f));
        assert!(
            format!("{:?}", found.broken) == format!("{:?}", expected.broken),
            "with a population of {broken}: broken is {:?}, the guard finds {:?}",
            found.broken,
            expected.broken,
        );
    }
}
