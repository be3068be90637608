//! Stage 3: solid fractions and weights; stage 5: force and torque on spheres.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::SolidOperator;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;

use super::super::problem::Problem;
use super::super::random::Random;
use super::super::task::{Scene, SharedCells, SolidCells, Spheres, Task, Wanted};
use super::MakeError;
use super::cells::rates;

pub(super) fn problems() -> Vec<Problem> {
    vec![
        Problem {
            id: "solid_fractions",
            stage: 3,
            title: "solid fraction of a sphere in a unit cell",
            notes: "Exact volumes. A code that samples will be off by more than round-off: leave this \
                    problem out and use the solid_fraction arrays that come with the scenes.",
            equation: "epsilon = volume of the sphere in the cell",
            flags: &["exact_coverage"],
            task: Task::SolidFractions(spheres()),
        },
        Problem {
            id: "weights",
            stage: 3,
            title: "weight B of a solid fraction",
            notes: "Noble and Torczynski's, not B = epsilon.",
            equation: "B = epsilon (tau - 1/2)/[(1 - epsilon) + (tau - 1/2)]",
            flags: &["solid"],
            task: Task::Weights(weights()),
        },
        Problem {
            id: "shared_weights",
            stage: 3,
            title: "weights of two solids in one cell",
            notes: "The cell is weighed once, with the sum of its solid fractions (at most 1), and the \
                    weight is shared out in proportion to them: B is not linear.",
            equation: "B_s = B(min(1, sum epsilon), tau) epsilon_s/sum epsilon",
            flags: &["solid"],
            task: Task::SharedWeights(shared()),
        },
    ]
}

fn spheres() -> Spheres {
    let mut random = Random(300);
    // Inside the cell, all around it, far from it; then cut in every way.
    let mut spheres = vec![
        (Vec3::new(0.1, -0.05, 0.02), 0.3),
        (Vec3::new(0.2, 0.1, -0.3), 1.5),
        (Vec3::new(3.0, 2.0, 1.0), 2.0),
        (Vec3::zeros(), 0.6),
    ];
    for number in 0..20 {
        let radius = [0.55, 1.0, 2.3, 4.0, 8.5][number % 5];
        // The surface passes within half a cell of the cell's centre.
        let direction = random.vector(1.0);
        let distance = radius + random.between(-0.5, 0.5);
        spheres.push((direction * (distance / direction.norm()), radius));
    }
    Spheres { spheres }
}

fn weights() -> SolidCells {
    let mut cells = Vec::new();
    for tau in [0.505, 0.6, 0.8, 1.3, 2.0] {
        for epsilon in [0.0, 0.1, 0.35, 0.7, 1.0] {
            cells.push((epsilon, tau));
        }
    }
    SolidCells { cells }
}

fn shared() -> SharedCells {
    let fractions = [[0.2, 0.3], [0.05, 0.9], [0.5, 0.5], [0.7, 0.6], [0.1, 0.1]];
    SharedCells { cells: fractions.map(|pair| (pair, 0.8)).to_vec() }
}

/// A domain with spheres, made a scene of one step that asks for the loads.
fn one_step(
    seed: u64,
    operator: SolidOperator,
    solids: Vec<Solid>,
    body_force: Option<Vec3>,
) -> Result<Task, MakeError> {
    let mut random = Random(seed);
    let domain = Domain::new([7, 6, 6], Faces::PERIODIC)?;
    let rates = rates(&mut random, 0.7)?;
    let populations = (0..domain.cell_count()).map(|_| random.populations()).collect();
    let phase = SolidPhase { solids, operator, ..SolidPhase::default() };
    let mut setup = Setup::fluid(domain, Collision::Mrt { rates }).with_solids(phase);
    setup.body_force = body_force;
    let wanted = vec![Wanted::Loads];
    Ok(Task::Scene(Box::new(Scene {
        setup,
        populations,
        steps: 1,
        wanted,
        viscosity_given: false,
    })))
}

/// A sphere that moves and spins.
pub(super) fn sphere(
    centre: [f64; 3],
    radius: f64,
    velocity: [f64; 3],
    angular_velocity: [f64; 3],
) -> Solid {
    Solid {
        velocity: velocity.into(),
        angular_velocity: angular_velocity.into(),
        ..Solid::fixed_sphere(centre.into(), radius)
    }
}

pub(super) fn loads() -> Result<Vec<Problem>, MakeError> {
    let bounce = SolidOperator::NonEquilibriumBounceBack;
    let load = |id, title, flags, task| Problem {
        id,
        stage: 5,
        title,
        notes: "One collision of a periodic box. Force and torque are those of the fluid on the \
                sphere, the torque about its centre; solid_fraction is the coverage at the start.",
        equation: "F = -sum B sum_a Lambda_a c_a, T = sum r x F, r from the nearest image of the centre; \
                   u_p = U + omega x r",
        flags,
        task,
    };
    let still = [0.0; 3];
    Ok(vec![
        load(
            "sphere_at_rest",
            "a sphere at rest",
            &["mrt", "solid"],
            one_step(500, bounce, vec![sphere([3.3, 2.9, 3.1], 1.7, still, still)], None)?,
        ),
        load(
            "sphere_in_motion",
            "a sphere that moves and spins",
            &["mrt", "solid", "spin"],
            one_step(
                501,
                bounce,
                vec![sphere([3.3, 2.9, 3.1], 1.7, [0.02, -0.03, 0.01], [0.02, 0.03, -0.01])],
                None,
            )?,
        ),
        load(
            "sphere_across_a_face",
            "a spinning sphere that crosses two periodic faces",
            &["mrt", "solid", "spin", "periodic_image"],
            one_step(
                502,
                bounce,
                vec![sphere([0.4, 5.8, 3.1], 1.7, [0.02, -0.03, 0.01], [0.02, 0.03, -0.01])],
                None,
            )?,
        ),
        load(
            "two_spheres",
            "two spheres that share cells, with a body force",
            &["mrt", "solid", "spin", "body_force", "shared_cells"],
            one_step(
                503,
                bounce,
                vec![
                    sphere([2.2, 2.9, 3.1], 1.5, [0.02, -0.03, 0.01], [0.02, 0.03, -0.01]),
                    sphere([4.9, 3.3, 2.8], 1.5, [-0.01, 0.02, 0.0], [0.0, -0.02, 0.03]),
                ],
                Some(Vec3::new(0.003, -0.002, 0.004)),
            )?,
        ),
        load(
            "sphere_superposition",
            "a sphere that moves and spins, superposition operator",
            &["mrt", "solid", "spin", "superposition"],
            one_step(
                504,
                SolidOperator::Superposition,
                vec![sphere([3.3, 2.9, 3.1], 1.7, [0.02, -0.03, 0.01], [0.02, 0.03, -0.01])],
                None,
            )?,
        ),
    ])
}
