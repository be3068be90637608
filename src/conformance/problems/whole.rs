//! Stage 7: small whole scenes, run for some steps.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;

use super::super::problem::Problem;
use super::super::random::Random;
use super::super::task::{Scene, Task, Wanted};
use super::MakeError;
use super::cells::rates;
use super::solids::sphere;

/// Steps of each scene.
const STEPS: u64 = 6;

/// What differs from scene to scene.
struct Parts {
    cells: [usize; 3],
    faces: Faces,
    mrt: bool,
    body_force: Option<Vec3>,
    solids: Vec<Solid>,
    operator: SolidOperator,
}

impl Default for Parts {
    fn default() -> Self {
        Parts {
            cells: [5, 4, 3],
            faces: Faces::PERIODIC,
            mrt: true,
            body_force: None,
            solids: Vec::new(),
            operator: SolidOperator::NonEquilibriumBounceBack,
        }
    }
}

pub(super) fn problems() -> Result<Vec<Problem>, MakeError> {
    let force = Some(Vec3::new(0.004, -0.002, 0.003));
    let still = [0.0; 3];
    let scenes: [(_, _, &[_], _); 9] = [
        ("box_srt", "periodic box, SRT", &["srt"], Parts { mrt: false, ..Parts::default() }),
        (
            "box_mrt",
            "periodic box, MRT with a body force",
            &["mrt", "body_force"],
            Parts { body_force: force, ..Parts::default() },
        ),
        (
            "channel",
            "channel between a resting and a moving wall, MRT with a body force",
            &["mrt", "body_force", "wall", "moving_wall"],
            Parts {
                faces: Faces {
                    z: [Face::wall(), Face::Wall { velocity: Vec3::new(0.05, 0.02, 0.0) }],
                    ..Faces::PERIODIC
                },
                cells: [3, 4, 5],
                body_force: force,
                ..Parts::default()
            },
        ),
        (
            "duct",
            "inlet, pressure outlet, free slip and walls, SRT",
            &["srt", "inlet", "pressure", "free_slip", "wall", "corners"],
            Parts {
                mrt: false,
                cells: [4, 5, 3],
                faces: Faces {
                    x: [Face::FreeSlip, Face::wall()],
                    y: [
                        Face::VelocityInlet { velocity: Vec3::new(0.0, 0.03, 0.0) },
                        Face::Pressure { density: 1.0 },
                    ],
                    z: [Face::wall(), Face::FreeSlip],
                },
                ..Parts::default()
            },
        ),
        (
            "bed_srt",
            "a sphere at rest in a periodic box, PS-SRT with a body force",
            &["srt", "solid", "body_force"],
            Parts {
                mrt: false,
                cells: [6, 5, 5],
                body_force: force,
                solids: vec![sphere([2.7, 2.4, 2.6], 1.6, still, still)],
                ..Parts::default()
            },
        ),
        (
            "bed_mrt",
            "two spinning spheres that share cells and cross a periodic face, PS-MRT",
            &["mrt", "solid", "spin", "periodic_image", "shared_cells", "body_force"],
            Parts {
                cells: [6, 6, 5],
                body_force: force,
                solids: vec![
                    sphere([0.3, 2.4, 2.6], 1.4, still, [0.02, 0.01, -0.03]),
                    sphere([2.8, 2.7, 2.3], 1.4, still, [-0.01, 0.03, 0.02]),
                ],
                ..Parts::default()
            },
        ),
        (
            "bed_superposition",
            "a spinning sphere beside a wall, PS-MRT, superposition operator",
            &["mrt", "solid", "spin", "wall", "superposition"],
            Parts {
                cells: [5, 6, 5],
                faces: Faces { y: [Face::wall(); 2], ..Faces::PERIODIC },
                solids: vec![sphere([2.6, 2.2, 2.4], 1.5, still, [0.02, 0.01, -0.03])],
                operator: SolidOperator::Superposition,
                ..Parts::default()
            },
        ),
        (
            "bed_graded_viscosity",
            "two spheres at rest that share cells and cross a periodic face, graded viscosity",
            &["mrt", "solid", "graded_viscosity", "periodic_image", "shared_cells", "body_force"],
            Parts {
                cells: [6, 6, 5],
                body_force: force,
                solids: vec![
                    sphere([0.4, 2.4, 2.6], 1.6, still, still),
                    sphere([3.3, 2.7, 2.3], 1.4, still, still),
                ],
                operator: SolidOperator::GradedViscosity,
                ..Parts::default()
            },
        ),
        (
            "moving_sphere",
            "a sphere that moves and spins through a periodic face, PS-MRT",
            &["mrt", "solid", "spin", "moving_solid", "exact_coverage", "periodic_image"],
            Parts {
                cells: [6, 5, 5],
                solids: vec![sphere(
                    [4.6, 2.4, 2.6],
                    1.5,
                    [0.06, -0.03, 0.02],
                    [0.02, 0.01, -0.03],
                )],
                ..Parts::default()
            },
        ),
    ];
    let mut problems = Vec::new();
    for (seed, (id, title, flags, parts)) in scenes.into_iter().enumerate() {
        problems.push(Problem {
            id,
            stage: 7,
            title,
            notes: "A step: collide every cell, stream with the faces, then move the solids by their \
                    velocity and cover the cells anew. Loads are those of the last step.",
            equation: "Eq. 1 with Eqs. 2 to 6",
            flags,
            task: scene(700 + seed as u64, parts)?,
        });
    }
    Ok(problems)
}

fn scene(seed: u64, parts: Parts) -> Result<Task, MakeError> {
    let mut random = Random(seed);
    let domain = Domain::new(parts.cells, parts.faces)?;
    let populations = (0..domain.cell_count()).map(|_| random.populations()).collect();
    let tau = 0.7;
    let collision = if parts.mrt {
        Collision::Mrt { rates: rates(&mut random, tau)? }
    } else {
        Collision::Srt { tau }
    };
    let mut setup = Setup::fluid(domain, collision);
    setup.body_force = parts.body_force;
    let mut wanted = vec![Wanted::Populations];
    if !parts.solids.is_empty() {
        wanted.push(Wanted::Loads);
        let (solids, operator) = (parts.solids, parts.operator);
        let weighting = match operator {
            SolidOperator::GradedViscosity => Weighting::Graded,
            _ => Weighting::NobleTorczynski,
        };
        let phase = SolidPhase { solids, operator, weighting, ..SolidPhase::default() };
        setup.solid_phase = Some(phase);
    }
    Ok(Task::Scene(Box::new(Scene {
        setup,
        populations,
        steps: STEPS,
        wanted,
        viscosity_given: false,
    })))
}
