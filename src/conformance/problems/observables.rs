//! Stage 8: what the acceptance cases observe, at small size, and the paper's formulas.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Vec3, relaxation_time};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

use super::super::problem::Problem;
use super::super::task::{Formulas, Scene, Task, Wanted};
use super::MakeError;

pub(super) fn problems() -> Result<Vec<Problem>, MakeError> {
    let observable = |id, title, notes, equation, flags, task| Problem {
        id,
        stage: 8,
        title,
        notes,
        equation,
        flags,
        task,
    };
    let wave = "The viscosity is given, not tau. Report -ln(a/A)/(k^2 steps), a being the amplitude \
                at the end: 2/n sum u_x sin(k (y + 1/2)), k = 2 pi/n_y.";
    Ok(vec![
        observable(
            "shear_wave_srt",
            "viscosity of a decaying shear wave, SRT",
            wave,
            "nu = (tau - 1/2)/3 and Eq. 2",
            &["srt", "viscosity"],
            shear_wave(false)?,
        ),
        observable(
            "shear_wave_mrt",
            "viscosity of a decaying shear wave, MRT",
            wave,
            "nu = (tau - 1/2)/3, s9 = 1/tau and Eq. 3",
            &["mrt", "viscosity"],
            shear_wave(true)?,
        ),
        observable(
            "poiseuille",
            "profile of plane Poiseuille flow, driven by a body force from rest",
            "Report (j + G/2)/rho along x. With these rates (Lambda = 3/16) the steady profile is the \
             parabola of walls half-way between nodes to round-off.",
            "Eqs. 1 and 3; half-way bounce-back",
            &["mrt", "body_force", "wall", "steady"],
            poiseuille()?,
        ),
        observable(
            "couette",
            "profile of plane Couette flow between a resting and a moving wall, from rest",
            "Report j/rho along x.",
            "Eq. 2; half-way bounce-back with a moving wall",
            &["srt", "wall", "moving_wall", "steady"],
            couette()?,
        ),
        observable(
            "sphere_array",
            "drag and mean velocity in a simple-cubic array of spheres, from rest",
            "Drag is the force on the sphere along x in the last step; the mean velocity is \
             (j + G/2)/rho, averaged over all cells. Not steady yet.",
            "Eqs. 5 and 6",
            &["mrt", "solid", "body_force"],
            sphere_array()?,
        ),
        observable(
            "formulas",
            "formulas and sizes that the paper states",
            "White's drag law, C_D = 24/Re + 6/(1 + sqrt(Re)) + 0.4; Reynolds number of a settling \
             grain; third side of a bed of spheres of given porosity.",
            "sections 5, 6 and 7",
            &["formulas"],
            Task::Formulas(Formulas {
                reynolds: vec![0.1, 1.0, 10.0, 100.0, 150.0],
                settling: [1.6e-4, 2.1e-3, 1e-5],
                bed: [1000.0, 16.0, 0.4, 128.0, 128.0],
            }),
        ),
    ])
}

/// A scene from the equilibrium of `velocity` at density 1.
fn from_equilibrium(
    setup: Setup,
    steps: u64,
    wanted: Wanted,
    velocity: impl Fn(Vec3) -> Vec3,
) -> Result<Scene, MakeError> {
    let solver = Solver::starting_from(setup.clone(), |centre| (1.0, velocity(centre)))?;
    let populations = solver.populations().to_vec();
    Ok(Scene { setup, populations, steps, wanted: vec![wanted], viscosity_given: false })
}

fn shear_wave(mrt: bool) -> Result<Task, MakeError> {
    let (amplitude, n) = (0.05, 12);
    let domain = Domain::new([1, n, 1], Faces::PERIODIC)?;
    let tau = relaxation_time(0.07);
    let collision =
        if mrt { Collision::Mrt { rates: Rates::dhumieres(tau)? } } else { Collision::Srt { tau } };
    let k = std::f64::consts::TAU / n as f64;
    let scene = from_equilibrium(
        Setup::fluid(domain, collision),
        30,
        Wanted::ShearViscosity { amplitude },
        |centre| Vec3::new(amplitude * (k * centre.y).sin(), 0.0, 0.0),
    )?;
    Ok(Task::Scene(Box::new(Scene { viscosity_given: true, ..scene })))
}

fn poiseuille() -> Result<Task, MakeError> {
    let faces = Faces { y: [Face::wall(); 2], ..Faces::PERIODIC };
    let domain = Domain::new([1, 4, 1], faces)?;
    let collision = Collision::Mrt { rates: Rates::magic(1.4, 3.0 / 16.0)? };
    let setup = Setup::fluid(domain, collision).with_body_force(Vec3::new(4e-3, 0.0, 0.0));
    let scene = from_equilibrium(setup, 150, Wanted::Profile, |_| Vec3::zeros())?;
    Ok(Task::Scene(Box::new(scene)))
}

fn couette() -> Result<Task, MakeError> {
    let moving = Face::Wall { velocity: Vec3::new(0.1, 0.0, 0.0) };
    let faces = Faces { y: [Face::wall(), moving], ..Faces::PERIODIC };
    let domain = Domain::new([1, 4, 1], faces)?;
    let setup = Setup::fluid(domain, Collision::Srt { tau: 1.4 });
    let scene = from_equilibrium(setup, 150, Wanted::Profile, |_| Vec3::zeros())?;
    Ok(Task::Scene(Box::new(scene)))
}

fn sphere_array() -> Result<Task, MakeError> {
    let domain = Domain::new([8; 3], Faces::PERIODIC)?;
    let solids = vec![Solid::fixed_sphere(Vec3::repeat(4.0), 3.0)];
    let collision = Collision::Mrt { rates: Rates::dhumieres(0.8)? };
    let setup = Setup::fluid(domain, collision)
        .with_body_force(Vec3::new(1e-3, 0.0, 0.0))
        .with_solids(SolidPhase { solids, ..SolidPhase::default() });
    let scene = from_equilibrium(setup, 24, Wanted::Drag, |_| Vec3::zeros())?;
    Ok(Task::Scene(Box::new(scene)))
}
