//! Stages 0 to 2: constants, moments, and collisions of single cells.

use psmrt_reference::collision::Collision;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::rates::{RateError, Rates};

use super::super::problem::Problem;
use super::super::random::Random;
use super::super::task::{CollidingCell, Collisions, Constants, States, Task};
use super::MakeError;

/// Cells of each problem.
const CELLS: usize = 8;

/// The operator of graded viscosity.
const GRADED: &str = "F = (1 - B) G + 2 B (rho u_p - j), B = k epsilon/[(1 - epsilon) + k epsilon], \
                      k = (tau - 1/2)^2/(4 (tau - 1/2) + 0.4); MRT with this force, of even moments \
                      1/s - 1/2 = (tau - 1/2)/(1 - epsilon), of odd ones 1/s - 1/2 = 0.002 (1 - epsilon)/(tau - 1/2)";

pub(super) fn problems() -> Result<Vec<Problem>, MakeError> {
    let mut problems = vec![
        Problem {
            id: "constants",
            stage: 0,
            title: "weights, opposites, M, S-hat, relaxation times",
            notes: "Moments are in the order of moment_names, the rows of M as d'Humieres et al. \
                    (2002) print them. Opposites are numbers of directions, from 0.",
            equation: "D3Q19; M and S-hat of Eq. 3; nu = (tau - 1/2)/3",
            flags: &[],
            task: Task::Constants(Constants {
                rates: Rates::dhumieres(0.8)?,
                viscosities: vec![0.005, 0.05, 0.1, 1.0 / 6.0, 0.4],
            }),
        },
        Problem {
            id: "moments",
            stage: 1,
            title: "moments of populations; equilibria in both spaces",
            notes: "Momentum is bare: no part of a body force is in it. The equilibrium is of second \
                    order in the velocity, and M maps the one form on the other.",
            equation: "m = M f; f_eq = w rho (1 + 3 c.u + 9/2 (c.u)^2 - 3/2 u^2); m_eq = M f_eq",
            flags: &[],
            task: Task::Moments(states()),
        },
    ];
    let bounce = SolidOperator::NonEquilibriumBounceBack;
    let solid = Some((bounce, Weighting::NobleTorczynski));
    let superposed = Some((SolidOperator::Superposition, Weighting::NobleTorczynski));
    let whole = Some((SolidOperator::FullBounceBack, Weighting::NobleTorczynski));
    let graded = Some((SolidOperator::GradedViscosity, Weighting::Graded));
    for (seed, (id, title, equation, flags, parts)) in [
        ("srt", "SRT", "Eq. 2", &["srt"] as &[_], Parts::new(false, false, None)),
        ("mrt", "MRT", "Eq. 3", &["mrt"], Parts::new(true, false, None)),
        (
            "srt_force",
            "SRT with a body force",
            "Eqs. 1 and 2; Guo et al. (2002): u = (j + G/2)/rho, source (1 - 1/(2 tau)) F",
            &["srt", "body_force"],
            Parts::new(false, true, None),
        ),
        (
            "mrt_force",
            "MRT with a body force",
            "Eqs. 1 and 3; source M^-1 (I - S-hat/2) M F",
            &["mrt", "body_force"],
            Parts::new(true, true, None),
        ),
        (
            "ps_srt",
            "PS-SRT",
            "Eqs. 4 and 5, corrected",
            &["srt", "solid"],
            Parts::new(false, false, solid),
        ),
        (
            "ps_mrt",
            "PS-MRT",
            "Eqs. 6 and 5, corrected",
            &["mrt", "solid"],
            Parts::new(true, false, solid),
        ),
        (
            "ps_srt_force",
            "PS-SRT with a body force",
            "Eqs. 4 and 5; the force acts with weight 1 - B, inside Lambda the velocity is j/rho",
            &["srt", "solid", "body_force"],
            Parts::new(false, true, solid),
        ),
        (
            "ps_mrt_force",
            "PS-MRT with a body force",
            "Eqs. 6 and 5; the force acts with weight 1 - B, inside Lambda the velocity is j/rho",
            &["mrt", "solid", "body_force"],
            Parts::new(true, true, solid),
        ),
        (
            "ps_srt_superposition",
            "PS-SRT, superposition operator",
            "Lambda = f_eq(rho, u_p) - f_eq(rho, u) + Omega",
            &["srt", "solid", "superposition"],
            Parts::new(false, false, superposed),
        ),
        (
            "ps_mrt_superposition",
            "PS-MRT, superposition operator",
            "Lambda = f_eq(rho, u_p) - f_eq(rho, u) + Omega, Omega of Eq. 3",
            &["mrt", "solid", "superposition"],
            Parts::new(true, false, superposed),
        ),
        (
            "ps_srt_full_bounce_back",
            "PS-SRT, full bounce-back",
            "Lambda_a = f_-a - f_eq_-a(rho, u_p) + f_eq_a(rho, u_p) - f_a",
            &["srt", "solid", "full_bounce_back"],
            Parts::new(false, false, whole),
        ),
        (
            "ps_mrt_full_bounce_back",
            "PS-MRT with a body force, full bounce-back",
            "Lambda_a = f_-a - f_eq_-a(rho, u_p) + f_eq_a(rho, u_p) - f_a",
            &["mrt", "solid", "full_bounce_back", "body_force"],
            Parts::new(true, true, whole),
        ),
        (
            "ps_srt_graded_viscosity",
            "PS-SRT, graded viscosity, solids at rest",
            GRADED,
            &["srt", "solid", "graded_viscosity"],
            Parts::new(false, false, graded),
        ),
        (
            "ps_mrt_graded_viscosity",
            "PS-MRT with a body force, graded viscosity, solids at rest",
            GRADED,
            &["mrt", "solid", "graded_viscosity", "body_force"],
            Parts::new(true, true, graded),
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let (operator, weighting) = parts.solid.unwrap_or((bounce, Weighting::NobleTorczynski));
        let cells = cells(200 + seed as u64, &parts)?;
        problems.push(Problem {
            id,
            stage: 2,
            title,
            notes: if operator == SolidOperator::GradedViscosity {
                "Cut and full cells do not collide as the fluid does: of tau = 1/s_nu and epsilon alone follow \
                 their rates and the weight B of the drag. A cell without solid is fluid. Force is that of \
                 the fluid on the solid, -2 B (rho u_p - j)."
            } else if parts.solid.is_some() {
                "The weight is Noble and Torczynski's B(epsilon, tau) with tau = 1/s_nu; force is that \
                 of the fluid on the solid, -B sum_a Lambda_a c_a."
            } else {
                "Each cell has its own rates; tau = 1/s_nu."
            },
            equation,
            flags,
            task: Task::Collisions(Collisions { operator, weighting, cells }),
        });
    }
    Ok(problems)
}

fn states() -> States {
    let mut random = Random(100);
    let f = (0..CELLS).map(|_| random.populations()).collect();
    let at = (0..CELLS).map(|_| (random.between(0.8, 1.2), random.vector(0.1))).collect();
    States { f, at }
}

/// What takes part in a collision.
struct Parts {
    mrt: bool,
    force: bool,
    solid: Option<(SolidOperator, Weighting)>,
}

impl Parts {
    fn new(mrt: bool, force: bool, solid: Option<(SolidOperator, Weighting)>) -> Self {
        Parts { mrt, force, solid }
    }
}

fn cells(seed: u64, parts: &Parts) -> Result<Vec<CollidingCell>, RateError> {
    let mut random = Random(seed);
    let mut cells = Vec::new();
    for number in 0..CELLS {
        let f = random.populations();
        // From both sides of 1, at which a missing 1/tau would not show.
        let tau =
            if number % 2 == 0 { random.between(0.55, 0.85) } else { random.between(1.2, 2.0) };
        let collision = match (parts.mrt, number) {
            (false, _) => Collision::Srt { tau },
            (true, 0..2) => Collision::Mrt { rates: Rates::dhumieres(tau)? },
            (true, _) => Collision::Mrt { rates: rates(&mut random, tau)? },
        };
        let body_force = parts.force.then(|| random.vector(0.01));
        // A cell with no solid, one full of it, and some between.
        let epsilon = match number {
            0 => 0.0,
            1 => 1.0,
            _ => random.between(0.05, 0.95),
        };
        let at_rest = matches!(parts.solid, Some((SolidOperator::GradedViscosity, _)));
        let u_p = if at_rest { Vec3::zeros() } else { random.vector(0.05) };
        cells.push(CollidingCell {
            f,
            collision,
            body_force,
            solid: parts.solid.map(|_| (epsilon, u_p)),
        });
    }
    Ok(cells)
}

/// Rates that are all different.
pub(super) fn rates(random: &mut Random, tau: f64) -> Result<Rates, RateError> {
    Rates {
        e: random.between(0.7, 0.9),
        eps: random.between(1.0, 1.2),
        q: random.between(1.3, 1.5),
        nu: 1.0 / tau,
        pi: random.between(1.55, 1.7),
        m: random.between(1.8, 1.95),
    }
    .checked()
}
