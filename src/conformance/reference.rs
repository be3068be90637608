//! The oracle's own answers: the expected values of the kit.

use psmrt_reference::cell_collision::CellCollision;
use psmrt_reference::collision::CollisionOperator;
use psmrt_reference::coverage::{Coverage, CoverageRule};
use psmrt_reference::directions::{C, OPPOSITE, Q};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::equilibrium::{equilibrium, equilibrium_moments};
use psmrt_reference::grains::contact::{Relative, contact_force};
use psmrt_reference::lattice::{Vec3, W, density, momentum, relaxation_time};
use psmrt_reference::moments::{CellMatrix, moment_matrix};
use psmrt_reference::non_reflecting::SlowMeans;
use psmrt_reference::partial_saturation::{Weighting, share_weight};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;
use psmrt_reference::streaming::stream;

use super::array::{Answers, Array};
use super::candidate::Candidate;
use super::task::{
    CollidingCell, Collisions, Constants, Contacts, Formulas, Scene, SceneOutcome, SharedCells,
    SolidCells, Spheres, States, Streaming, direction_array,
};

/// The oracle as a candidate.
#[derive(Clone, Copy, Debug, Default)]
pub struct Oracle;

impl Candidate for Oracle {
    fn name(&self) -> String {
        "psmrt-reference".to_owned()
    }

    fn constants(&mut self, problem: &Constants) -> Option<Answers> {
        let matrix = moment_matrix();
        let rows = (0..Q).flat_map(|row| (0..Q).map(move |a| (row, a)));
        let answers = Answers::new()
            .with("directions", direction_array(&C))
            .with("weights", Array::list(W.to_vec()))
            .with("opposites", Array::list(OPPOSITE.iter().map(|&a| a as f64).collect()))
            .with("moment_matrix", Array::new([Q, Q], rows.map(|at| matrix[at]).collect()))
            .with("s_hat", Array::list(problem.rates.diagonal().to_vec()));
        let tau = problem.viscosities.iter().map(|&nu| relaxation_time(nu)).collect();
        Some(answers.with("relaxation_time", Array::list(tau)))
    }

    fn moments(&mut self, problem: &States) -> Option<Answers> {
        let matrix = CellMatrix::from_faer(&moment_matrix());
        let cells = |of: &dyn Fn(&[f64; Q]) -> [f64; Q]| {
            Array::cells(&problem.f.iter().map(of).collect::<Vec<_>>())
        };
        let states = |of: &dyn Fn(&(f64, Vec3)) -> [f64; Q]| {
            Array::cells(&problem.at.iter().map(of).collect::<Vec<_>>())
        };
        let momenta: Vec<Vec3> = problem.f.iter().map(momentum).collect();
        Some(
            Answers::new()
                .with("density", Array::list(problem.f.iter().map(density).collect()))
                .with("momentum", Array::vectors(&momenta))
                .with("moments", cells(&|f| matrix.times(f)))
                .with("equilibrium", states(&|(rho, u)| equilibrium(*rho, u)))
                .with("equilibrium_moments", states(&|(rho, u)| equilibrium_moments(*rho, u))),
        )
    }

    fn collisions(&mut self, problem: &Collisions) -> Option<Answers> {
        let (mut post, mut forces) = (Vec::new(), Vec::new());
        for cell in &problem.cells {
            let (after, force) = collide(problem, cell)?;
            post.push(after);
            forces.push(force);
        }
        let answers = Answers::new().with("post", Array::cells(&post));
        let solid = problem.cells.iter().any(|cell| cell.solid.is_some());
        Some(if solid { answers.with("force", Array::vectors(&forces)) } else { answers })
    }

    fn solid_fractions(&mut self, problem: &Spheres) -> Option<Answers> {
        let fraction =
            |(offset, radius): &(Vec3, f64)| CoverageRule::Exact.fraction(offset, *radius);
        let fractions = problem.spheres.iter().map(fraction).collect();
        Some(Answers::new().with("solid_fraction", Array::list(fractions)))
    }

    fn weights(&mut self, problem: &SolidCells) -> Option<Answers> {
        let weight = |&(epsilon, tau): &(f64, f64)| Weighting::NobleTorczynski.weight(epsilon, tau);
        Some(Answers::new().with("weight", Array::list(problem.cells.iter().map(weight).collect())))
    }

    fn shared_weights(&mut self, problem: &SharedCells) -> Option<Answers> {
        let mut weights = Vec::new();
        for &(epsilons, tau) in &problem.cells {
            let rule = Weighting::NobleTorczynski;
            share_weight(rule, tau, epsilons.into_iter(), |_, weight| weights.push(weight));
        }
        Some(Answers::new().with("weight", Array::new([problem.cells.len(), 2], weights)))
    }

    fn streaming(&mut self, problem: &Streaming) -> Option<Answers> {
        let mut f = problem.post.clone();
        let slow_means = SlowMeans::starting_from(&problem.domain, &problem.post);
        stream(&problem.domain, &slow_means, &problem.post, &mut f);
        Some(Answers::new().with("populations", Array::populations(problem.domain.cells(), &f)))
    }

    fn scene(&mut self, problem: &Scene) -> Option<SceneOutcome> {
        let populations = problem.populations.clone();
        let mut solver = Solver::from_populations(problem.setup.clone(), populations).ok()?;
        solver.run(problem.steps).ok()?;
        Some(SceneOutcome {
            populations: Some(solver.populations().to_vec()),
            velocity: Some(solver.velocity_field()),
            loads: Some(solver.loads().to_vec()),
        })
    }

    fn contacts(&mut self, problem: &Contacts) -> Option<Answers> {
        let (mut forces, mut torques) = (Vec::new(), Vec::new());
        for pair in &problem.pairs {
            let geometry = pair.geometry(problem.plane);
            let relative = Relative::new(&geometry, [&pair.motions[0], &pair.motions[1]]);
            let mut memory = Some(pair.springs);
            let ways = [&relative, &relative];
            let force =
                contact_force(&pair.law, &geometry, ways, 0.0, &mut memory).unwrap_or_default();
            forces.push(force.force);
            torques.extend(force.torques.iter().flat_map(|torque| [torque.x, torque.y, torque.z]));
        }
        let torques = Array::new([problem.pairs.len(), 2, 3], torques);
        Some(Answers::new().with("force", Array::vectors(&forces)).with("torque", torques))
    }

    fn formulas(&mut self, problem: &Formulas) -> Option<Answers> {
        // C_D = 24/Re + 6/(1 + √Re) + 0.4 (White; the paper misprints the exponent)
        let drag = |re: &f64| 24.0 / re + 6.0 / (1.0 + re.sqrt()) + 0.4;
        let [d, v, nu] = problem.settling;
        let [count, diameter, porosity, x, y] = problem.bed;
        // N π d³/6 = (1 - n) x y L
        let volume = count * std::f64::consts::PI * diameter * diameter * diameter / 6.0;
        Some(
            Answers::new()
                .with("drag_coefficient", Array::list(problem.reynolds.iter().map(drag).collect()))
                .with("settling_reynolds", Array::number(d * v / nu))
                .with("bed_length", Array::number(volume / ((1.0 - porosity) * x * y))),
        )
    }
}

/// One cell by itself: populations after its collision, and the force on its solid.
fn collide(problem: &Collisions, cell: &CollidingCell) -> Option<([f64; Q], Vec3)> {
    let domain = Domain::new([1, 1, 1], Faces::PERIODIC).ok()?;
    let mut setup = Setup::fluid(domain, cell.collision);
    setup.body_force = cell.body_force;
    setup.solid_phase = cell.solid.map(|(epsilon, velocity)| SolidPhase {
        solids: vec![Solid { velocity, ..Solid::fixed_cells(vec![(0, epsilon)]) }],
        weighting: problem.weighting,
        operator: problem.operator,
        coverage: CoverageRule::Exact,
    });
    let operator = CollisionOperator::new(&cell.collision);
    let phase = setup.solid_phase.as_ref();
    let coverage = phase.map(|p| Coverage::new(&setup.domain, &p.solids, p.coverage));
    let mut impulses = Vec::new();
    let collision = CellCollision::new(&setup, &operator, coverage.as_ref());
    let post = collision.collide(0, &cell.f, &mut impulses);
    Some((post, impulses.iter().map(|impulse| impulse.force).sum()))
}
