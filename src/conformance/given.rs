//! The arrays that a problem gives, for candidates that read files. (Its parameters: `parameters.rs`.)

use psmrt_reference::collision::Collision;
use psmrt_reference::coverage::Coverage;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::rates::Rates;

use super::array::Array;
use super::spec::DIRECTION;
use super::task::{CollidingCell, Constants, Scene, Task, TouchingPair, kit_directions};

/// An array that a problem gives.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenArray {
    /// Its name, and that of its file.
    pub name: &'static str,
    /// Names of its axes.
    pub axes: Vec<&'static str>,
    /// What it is, with its unit.
    pub what: &'static str,
    /// Its values.
    pub array: Array,
}

fn input(
    name: &'static str,
    what: &'static str,
    axes: &[&'static str],
    array: Array,
) -> GivenArray {
    GivenArray { name, axes: axes.to_vec(), what, array }
}

/// The arrays that `task` gives.
pub fn inputs(task: &Task) -> Vec<GivenArray> {
    let vector = "component";
    match task {
        Task::Constants(Constants { viscosities, .. }) => vec![
            input(
                "directions",
                "the kit's order of directions",
                &[DIRECTION, vector],
                kit_directions(),
            ),
            input("viscosity", "cells^2/step", &["viscosity"], Array::list(viscosities.clone())),
        ],
        Task::Moments(states) => {
            let (rho, u): (Vec<f64>, Vec<Vec3>) = states.at.iter().copied().unzip();
            vec![
                input("f", "populations", &["cell", DIRECTION], Array::cells(&states.f)),
                input("rho", "density for the equilibria", &["state"], Array::list(rho)),
                input("u", "velocity for the equilibria", &["state", vector], Array::vectors(&u)),
            ]
        }
        Task::Collisions(task) => collision_inputs(&task.cells),
        Task::SolidFractions(task) => {
            let (centres, radii): (Vec<Vec3>, Vec<f64>) = task.spheres.iter().copied().unzip();
            let what = "from the centre of the cell to that of the sphere, cells";
            vec![
                input("offset", what, &["cell", vector], Array::vectors(&centres)),
                input("radius", "cells", &["cell"], Array::list(radii)),
            ]
        }
        Task::Weights(task) => {
            let (epsilon, tau): (Vec<f64>, Vec<f64>) = task.cells.iter().copied().unzip();
            vec![
                input("epsilon", "solid fraction", &["cell"], Array::list(epsilon)),
                input("tau", "relaxation time, steps", &["cell"], Array::list(tau)),
            ]
        }
        Task::SharedWeights(task) => {
            let epsilon: Vec<f64> = task.cells.iter().flat_map(|cell| cell.0).collect();
            let tau = task.cells.iter().map(|cell| cell.1).collect();
            let epsilon = Array::new([task.cells.len(), 2], epsilon);
            vec![
                input("epsilon", "solid fractions", &["cell", "solid"], epsilon),
                input("tau", "relaxation time, steps", &["cell"], Array::list(tau)),
            ]
        }
        Task::Streaming(task) => {
            let what = "populations after the collision";
            vec![box_input("post", what, &task.domain, &task.post)]
        }
        Task::Scene(scene) => scene_inputs(scene),
        Task::Contacts(task) => contact_inputs(&task.pairs),
        Task::Formulas(task) => {
            let what = "Reynolds numbers";
            vec![input("reynolds", what, &["reynolds"], Array::list(task.reynolds.clone()))]
        }
    }
}

fn box_input(
    name: &'static str,
    what: &'static str,
    domain: &Domain,
    f: &[Populations],
) -> GivenArray {
    input(name, what, &["z", "y", "x", DIRECTION], Array::populations(domain.cells(), f))
}

fn collision_inputs(cells: &[CollidingCell]) -> Vec<GivenArray> {
    let f: Vec<Populations> = cells.iter().map(|cell| cell.f).collect();
    let tau = cells.iter().map(|cell| cell.collision.tau()).collect();
    let mut inputs = vec![
        input("f", "populations before the collision", &["cell", DIRECTION], Array::cells(&f)),
        input("tau", "relaxation time, steps", &["cell"], Array::list(tau)),
    ];
    let rates: Vec<[f64; 6]> = cells.iter().filter_map(|cell| mrt_rates(&cell.collision)).collect();
    if !rates.is_empty() {
        let what = "relaxation rates s_e, s_eps, s_q, s_nu, s_pi, s_m (s1, s2, s4, s9, 11th, s16)";
        let values = rates.iter().flatten().copied().collect();
        inputs.push(input("rates", what, &["cell", "rate"], Array::new([rates.len(), 6], values)));
    }
    let forces: Vec<Vec3> = cells.iter().filter_map(|cell| cell.body_force).collect();
    if !forces.is_empty() {
        let what = "body force G per volume on the fluid";
        inputs.push(input("body_force", what, &["cell", "component"], Array::vectors(&forces)));
    }
    let (epsilon, u_p): (Vec<f64>, Vec<Vec3>) = cells.iter().filter_map(|cell| cell.solid).unzip();
    if !epsilon.is_empty() {
        inputs.push(input("epsilon", "solid fraction", &["cell"], Array::list(epsilon)));
        let what = "velocity of the solid, cells/step";
        inputs.push(input("u_p", what, &["cell", "component"], Array::vectors(&u_p)));
    }
    inputs
}

fn mrt_rates(collision: &Collision) -> Option<[f64; 6]> {
    match collision {
        Collision::Srt { .. } => None,
        Collision::Mrt { rates: Rates { e, eps, q, nu, pi, m } } => {
            Some([*e, *eps, *q, *nu, *pi, *m])
        }
    }
}

fn scene_inputs(scene: &Scene) -> Vec<GivenArray> {
    let domain = &scene.setup.domain;
    let what = "populations at the start, before the first collision";
    let mut inputs = vec![box_input("populations", what, domain, &scene.populations)];
    if let Some(phase) = &scene.setup.solid_phase {
        let coverage = Coverage::new(domain, &phase.solids, phase.coverage);
        let of = |solid| {
            let coverage = &coverage;
            (0..domain.cell_count()).map(move |cell| {
                coverage
                    .shares(cell)
                    .iter()
                    .filter(|s| s.solid == solid)
                    .map(|s| s.epsilon)
                    .sum::<f64>()
            })
        };
        let values = (0..phase.solids.len()).flat_map(of).collect();
        let [nx, ny, nz] = domain.cells();
        let array = Array::new([phase.solids.len(), nz, ny, nx], values);
        let what = "solid fraction of each solid in each cell at the start";
        inputs.push(input("solid_fraction", what, &["solid", "z", "y", "x"], array));
    }
    inputs
}

fn contact_inputs(pairs: &[TouchingPair]) -> Vec<GivenArray> {
    let vectors = |name, what, of: fn(&TouchingPair) -> Vec3| {
        let array = Array::vectors(&pairs.iter().map(of).collect::<Vec<_>>());
        input(name, what, &["pair", "component"], array)
    };
    let numbers = |name, what, of: fn(&TouchingPair) -> f64| {
        input(name, what, &["pair"], Array::list(pairs.iter().map(of).collect()))
    };
    let offset = "from the first centre to the second, or to the nearest point of the plane";
    let radii = Array::new([pairs.len(), 2], pairs.iter().flat_map(|pair| pair.radii).collect());
    let mut inputs = vec![
        input("radii", "radii of both; 0: a plane", &["pair", "body"], radii),
        vectors("offset", offset, |p| p.offset),
        vectors("velocity_first", "of the centre", |p| p.motions[0].velocity),
        vectors("velocity_second", "of the centre, or the plane", |p| p.motions[1].velocity),
        vectors("spin_first", "angular velocity", |p| p.motions[0].angular_velocity),
        vectors("spin_second", "angular velocity", |p| p.motions[1].angular_velocity),
        numbers("stiffness", "k, force/length", |p| p.law.stiffness),
        numbers("damping", "gamma, force time/length", |p| p.law.damping),
    ];
    if pairs.iter().any(|pair| pair.law.friction.is_some()) {
        inputs.extend([
            numbers("friction", "mu", |p| p.law.friction.map_or(0.0, |f| f.coefficient)),
            numbers("tangential_stiffness", "k_t", |p| p.law.friction.map_or(0.0, |f| f.stiffness)),
            numbers("tangential_damping", "gamma_t", |p| p.law.friction.map_or(0.0, |f| f.damping)),
            vectors("spring", "tangential spring xi", |p| p.springs.spring),
        ]);
    }
    if pairs.iter().any(|pair| pair.law.rolling.is_some()) {
        let stiffness = "k_r, force/length";
        inputs.extend([
            numbers("rolling_friction", "mu_r", |p| p.law.rolling.map_or(0.0, |r| r.coefficient)),
            numbers("rolling_stiffness", stiffness, |p| p.law.rolling.map_or(0.0, |r| r.stiffness)),
            numbers("rolling_damping", "gamma_r", |p| p.law.rolling.map_or(0.0, |r| r.damping)),
            vectors("rolling_spring", "theta, radians", |p| p.springs.rolling),
        ]);
    }
    inputs
}
