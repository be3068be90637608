//! What no step may create or lose, for random states: mass, and momentum of fluid plus impulse on
//! solids.

use crate::common;

use common::random::Random;
use common::solid_rules::solid_rules;
use proptest::prelude::*;
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::guard::GuardSettings;
use psmrt_reference::lattice::{Populations, Vec3, density, momentum};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

const CELLS: [usize; 3] = [5, 4, 6];
/// At most 64 cases of 8 steps of 120 cells in each property: 2e5 cell updates in all.
const STEPS: usize = 8;

fn config() -> ProptestConfig {
    ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() }
}

prop_compose! {
    fn any_collision()(
        srt in any::<bool>(),
        tau in 0.51..3.0_f64,
        free in prop::array::uniform5(0.05..1.95_f64),
    ) -> Collision {
        let [e, eps, q, pi, m] = free;
        let rates = Rates { e, eps, q, nu: 1.0 / tau, pi, m };
        if srt { Collision::Srt { tau } } else { Collision::Mrt { rates } }
    }
}

prop_compose! {
    fn any_solids()(
        seed in any::<u64>(),
        count in 0_usize..5,
        (operator, weighting) in prop::sample::select(solid_rules()),
    ) -> SolidPhase {
        let mut random = Random(seed);
        let solids = (0..count).map(|_| {
            let centre = Vec3::from_fn(|axis, _| random.between(0.0, CELLS[axis] as f64));
            Solid {
                velocity: random.vector(0.05),
                angular_velocity: random.vector(0.02),
                ..Solid::fixed_sphere(centre, random.between(0.4, 2.4))
            }
        }).collect();
        SolidPhase { solids, weighting, operator, ..SolidPhase::default() }
    }
}

fn solver(faces: Faces, collision: Collision, phase: SolidPhase, g: Vec3, seed: u64) -> Solver {
    let mut setup = Setup::fluid(Domain::new(CELLS, faces).unwrap(), collision)
        .with_solids(phase)
        .with_body_force(g);
    // Random rates may amplify speeds for a while; conservation holds all the same.
    setup.guard = GuardSettings { max_speed: 1e6, ..GuardSettings::default() };
    let mut random = Random(seed);
    let cells = setup.domain.cell_count();
    Solver::from_populations(setup, (0..cells).map(|_| random.populations()).collect()).unwrap()
}

/// Sum of all |f|, the gauge of round-off in sums over the box.
fn gauge(f: &[Populations]) -> f64 {
    f.iter().flatten().map(|value| value.abs()).sum()
}

fn mass(solver: &Solver) -> f64 {
    solver.density_field().iter().sum()
}

fn total_momentum(solver: &Solver) -> Vec3 {
    solver.populations().iter().map(momentum).sum()
}

/// Each step rounds every population a few dozen times (two 19 x 19 products with entries that
/// cancel by up to 30): 64 eps of the sum of absolute values a step bounds what is seen, 10 eps, with
/// room.
fn round_off(gauge: f64) -> f64 {
    64.0 * f64::EPSILON * gauge
}

/// Fails unless every step keeps the mass, to round-off.
fn keeps_its_mass(mut solver: Solver) -> Result<(), TestCaseError> {
    for _ in 0..STEPS {
        let before = mass(&solver);
        let bound = round_off(gauge(solver.populations()));
        solver.step().unwrap();
        let off = (mass(&solver) - before).abs();
        let bound = bound.max(round_off(gauge(solver.populations())));
        prop_assert!(
            off < bound,
            "the mass of the box has changed in a step by {off:e}, more than its round-off {bound:e}"
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn mass_is_conserved_in_a_periodic_box(
        collision in any_collision(), phase in any_solids(), seed in any::<u64>(),
    ) {
        let g = Vec3::new(1e-3, 2e-3, -1e-3);
        keeps_its_mass(solver(Faces::PERIODIC, collision, phase, g, seed))?;
    }

    #[test]
    fn mass_is_conserved_in_a_closed_box_with_moving_walls(
        collision in any_collision(), phase in any_solids(), seed in any::<u64>(),
        walls in prop::array::uniform6(-0.1..0.1_f64), slip in 0_usize..4,
    ) {
        let [a, b, c, d, e, f] = walls;
        let wall = |x, y, z| Face::Wall { velocity: Vec3::new(x, y, z) };
        let mut faces = Faces {
            x: [wall(0.0, a, b), wall(0.0, b, c)],
            y: [wall(c, 0.0, d), wall(d, 0.0, e)],
            z: [wall(e, f, 0.0), wall(f, a, 0.0)],
        };
        match slip {
            0 => faces.x = [Face::FreeSlip; 2],
            1 => faces.y[0] = Face::FreeSlip,
            2 => faces.z = [Face::Periodic; 2],
            _ => {}
        }
        let g = Vec3::new(1e-3, 2e-3, -1e-3);
        keeps_its_mass(solver(faces, collision, phase, g, seed))?;
    }

    #[test]
    fn momentum_of_the_fluid_plus_impulse_on_the_solids_is_what_the_body_force_gave(
        collision in any_collision(), phase in any_solids(), seed in any::<u64>(),
        g in prop::array::uniform3(-1e-2..1e-2_f64),
    ) {
        let g = Vec3::from(g);
        let (weighting, tau) = (phase.weighting, collision.tau());
        let mut solver = solver(Faces::PERIODIC, collision, phase, g, seed);
        for _ in 0..STEPS {
            let before = total_momentum(&solver);
            // What the body force gives: sum over cells of (1 - B) G.
            let coverage = solver.coverage().unwrap();
            let open: f64 = (0..solver.domain().cell_count())
                .map(|cell| 1.0 - weighting.weight(coverage.solid_fraction(cell), tau))
                .sum();
            let bound = round_off(gauge(solver.populations()));
            solver.step().unwrap();
            let on_solids: Vec3 = solver.loads().iter().map(|load| load.force).sum();
            let off = (total_momentum(&solver) - before + on_solids - open * g).norm();
            prop_assert!(
                off < bound.max(round_off(gauge(solver.populations()))),
                "the momentum of the fluid plus the impulse on the solids has changed in a \
                 step by {off:e}, more than its round-off {bound:e}"
            );
        }
    }
}

#[test]
fn every_inlet_cell_lets_in_exactly_rho_u_also_at_edges() {
    // One step from rest: the mass of the box grows by the flux through the inlet, every face cell
    // counted, less nothing: the pressure outlet at rest lets nothing out in the first step.
    let u = 0.05;
    let inlet = Face::VelocityInlet { velocity: Vec3::new(u, 0.0, 0.0) };
    let sides = [Face::wall(), Face::FreeSlip];
    let faces = Faces { x: [inlet, Face::Pressure { density: 1.0 }], y: sides, z: sides };
    let setup = Setup::fluid(Domain::new([4, 3, 5], faces).unwrap(), Collision::Srt { tau: 0.8 });
    let mut solver = Solver::new(setup).unwrap();
    solver.step().unwrap();
    let gained = mass(&solver) - 60.0;
    // Round-off of a sum of 60 densities.
    assert!(
        (gained - 15.0 * u).abs() < 1e-13,
        "mass gained through the inlet: {gained}, not the flux 15 u that its faces let in"
    );
    assert!(solver.populations().iter().all(|f| density(f) > 0.0));
}
