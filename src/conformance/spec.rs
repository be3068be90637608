//! The answers of each kind of problem: their names, shapes and axes.

use psmrt_reference::directions::Q;

use super::task::{Task, Wanted};

/// Name of the axis that runs over directions; the judge sorts it into the kit's order.
pub const DIRECTION: &str = "direction";

/// An answer that a problem asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct AnswerSpec {
    /// Its name, and that of its file.
    pub name: &'static str,
    /// Names of its axes.
    pub axes: Vec<&'static str>,
    /// Lengths of its axes.
    pub shape: Vec<usize>,
    /// What it is, with its unit.
    pub what: &'static str,
    /// Its values are numbers of directions, not quantities.
    pub numbers_directions: bool,
}

/// An answer with its axes and their lengths.
fn answer(name: &'static str, what: &'static str, axes: &[(&'static str, usize)]) -> AnswerSpec {
    let (axes, shape) = axes.iter().copied().unzip();
    AnswerSpec { name, axes, shape, what, numbers_directions: false }
}

/// The answers that `task` asks for.
pub fn answer_specs(task: &Task) -> Vec<AnswerSpec> {
    let (directions, vector) = ((DIRECTION, Q), ("component", 3));
    match task {
        Task::Constants(task) => vec![
            answer("directions", "the directions, cells/step", &[directions, vector]),
            answer("weights", "the weights w_a", &[directions]),
            AnswerSpec {
                numbers_directions: true,
                ..answer("opposites", "number of the opposite direction, from 0", &[directions])
            },
            answer("moment_matrix", "the matrix M", &[("moment", Q), directions]),
            answer("s_hat", "the diagonal of S-hat, 1/step", &[("moment", Q)]),
            answer(
                "relaxation_time",
                "tau of each given viscosity, steps",
                &[("viscosity", task.viscosities.len())],
            ),
        ],
        Task::Moments(task) => {
            let (given, at) = (("cell", task.f.len()), ("state", task.at.len()));
            vec![
                answer("density", "sum of the populations", &[given]),
                answer("momentum", "sum of c_a f_a, bare", &[given, vector]),
                answer("moments", "M f", &[given, ("moment", Q)]),
                answer("equilibrium", "f_eq(rho, u)", &[at, directions]),
                answer("equilibrium_moments", "m_eq(rho, u)", &[at, ("moment", Q)]),
            ]
        }
        Task::Collisions(task) => {
            let cells = ("cell", task.cells.len());
            let mut answers =
                vec![answer("post", "populations after the collision", &[cells, directions])];
            if task.cells.iter().any(|cell| cell.solid.is_some()) {
                let what = "force of the fluid on the solid, density cells^4/step^2";
                answers.push(answer("force", what, &[cells, vector]));
            }
            answers
        }
        Task::SolidFractions(task) => {
            let what = "volume of the sphere in the cell, 0 to 1";
            vec![answer("solid_fraction", what, &[("cell", task.spheres.len())])]
        }
        Task::Weights(task) => {
            vec![answer("weight", "weight B, 0 to 1", &[("cell", task.cells.len())])]
        }
        Task::SharedWeights(task) => {
            let what = "weight B of each solid, 0 to 1";
            vec![answer("weight", what, &[("cell", task.cells.len()), ("solid", 2)])]
        }
        Task::Streaming(task) => {
            let [nx, ny, nz] = task.domain.cells();
            let axes = [("z", nz), ("y", ny), ("x", nx), directions];
            vec![answer("populations", "populations before the next collision", &axes)]
        }
        Task::Scene(scene) => {
            let [nx, ny, nz] = scene.setup.domain.cells();
            let solids = scene.setup.solid_phase.as_ref().map_or(0, |phase| phase.solids.len());
            scene
                .wanted
                .iter()
                .flat_map(|wanted| wanted_answers(wanted, [nx, ny, nz], solids))
                .collect()
        }
        Task::Contacts(task) => {
            let pairs = ("pair", task.pairs.len());
            vec![
                answer("force", "force on the first body", &[pairs, vector]),
                answer("torque", "torques on both bodies", &[pairs, ("body", 2), vector]),
            ]
        }
        Task::Formulas(task) => vec![
            answer("drag_coefficient", "C_D of a sphere", &[("reynolds", task.reynolds.len())]),
            answer("settling_reynolds", "d v/nu", &[]),
            answer("bed_length", "third side of the bed, cells", &[]),
        ],
    }
}

fn wanted_answers(wanted: &Wanted, [nx, ny, nz]: [usize; 3], solids: usize) -> Vec<AnswerSpec> {
    let (solid, vector) = (("solid", solids), ("component", 3));
    match wanted {
        Wanted::Populations => {
            let axes = [("z", nz), ("y", ny), ("x", nx), (DIRECTION, Q)];
            vec![answer("populations", "populations before the next collision", &axes)]
        }
        Wanted::Loads => vec![
            answer("force", "force of the fluid on each solid", &[solid, vector]),
            answer(
                "torque",
                "torque of the fluid on each solid about its centre",
                &[solid, vector],
            ),
        ],
        Wanted::Profile => vec![answer("velocity_profile", "u_x at x = 0, z = 0", &[("y", ny)])],
        Wanted::ShearViscosity { .. } => vec![answer("viscosity", "cells^2/step", &[])],
        Wanted::Drag => vec![
            answer("drag", "force on all solids along x", &[]),
            answer("mean_velocity", "mean of u_x over all cells, cells/step", &[]),
        ],
    }
}
