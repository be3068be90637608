//! Flows in a periodic box without solids.
//!
//! The shear layer and the Taylor–Green vortex have no closed solution, but two exact statements hold for
//! any incompressible flow in a periodic box: the kinetic energy falls by what the viscosity takes,
//!
//! ```text
//!   E(0) - E(t) = ν ∫ <ω²> dt,    E = <u²>/2
//! ```
//!
//! and in two dimensions no vorticity exceeds the largest at the start. The ABC flow is its own exact
//! solution: `u(t) = u(0) exp(-ν k² t)`.

use std::f64::consts::TAU;

use psmrt_reference::collision::Preset;
use psmrt_reference::domain::Faces;
use psmrt_reference::lattice::{Vec3, viscosity};

use super::lab::{Lab, go_on};
use super::spectral::vorticity;
use super::{Flow, Found, LabError, Line, Search};
use psmrt::engine::{Block, Coupled, EngineName};

/// Largest velocities at the start, cells per step.
const SPEEDS: &[f64] = &[0.003, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4, 0.5];

/// Relaxation times of the maps of fluids alone.
const TAUS: [f64; 9] = [0.500_001, 0.500_1, 0.501, 0.51, 0.55, 0.6, 1.0, 2.0, 5.0];

/// How far the energy may be off its budget, of the energy at the start: flows that are resolved by
/// second-order schemes on such grids stay within a few percent.
const ENERGY: f64 = 0.05;

/// How far the largest vorticity of a plane flow may exceed that at the start: what the wiggles of a
/// layer that is two cells thick, differentiated exactly, reach while it is still right.
const VORTICITY: f64 = 0.2;

/// How far the ABC flow may be from its exact solution, root mean square over that of the exact one.
const DISTANCE: f64 = 0.1;

pub(super) const SHEAR_LAYER: Flow = Flow {
    name: "shear_layer",
    about: &[
        "Two shear layers roll up in a periodic box of 48 x 48 x 1 cells: u = U tanh(30 (1/4 - |y/L - 1/2|)),",
        "v = 0.05 U sin(2 pi (x/L + 1/4)) (Minion & Brown, J. Comput. Phys. 138, 734 (1997)), for the time L/U, at",
        "least 300 and at most 1600 steps. Right: kinetic energy within 5 % of its budget E(0) - nu int <w^2> dt, no",
        "vorticity above 1.2 times the largest at the start. error: the worst distance of the energy from its budget",
        "over E(0), or the excess of vorticity over 4 where that is larger. It starts with the stress of its velocity",
        "field (tests/validation/src/stability/start.rs).",
    ],
    parameter: "velocity",
    values: SPEEDS,
    search: Search::Frontiers,
    also: |_| None,
    lines,
    run: |lab, line, speed| {
        let cells = [48, 48, 1];
        let steps = within(48.0 / speed, 300, 1600);
        budget(lab, line, (cells, steps, speed), |x| {
            let [across, along] = [x.y / 48.0, x.x / 48.0];
            let u = (30.0 * (0.25 - (across - 0.5).abs())).tanh();
            let v = 0.05 * (TAU * (along + 0.25)).sin();
            (1.0, speed * Vec3::new(u, v, 0.0))
        })
    },
};

pub(super) const TAYLOR_GREEN: Flow = Flow {
    name: "taylor_green",
    about: &[
        "The three-dimensional Taylor-Green vortex in a periodic box of 16^3 cells, largest velocity U, for the time",
        "3 L/U, at least 300 and at most 800 steps. It has no closed solution. Right: kinetic energy within 5 % of its",
        "budget E(0) - nu int <w^2> dt. error: the worst distance of the energy from its budget over E(0).",
        "It starts with the stress of its velocity field (tests/validation/src/stability/start.rs): from equilibrium, near tau = 1/2, the",
        "velocity would swing by |k|^2/6 = 8 % from step to step.",
    ],
    parameter: "velocity",
    values: SPEEDS,
    search: Search::Frontiers,
    also: |_| None,
    lines,
    run: |lab, line, speed| {
        let steps = within(48.0 / speed, 300, 800);
        budget(lab, line, ([16; 3], steps, speed), |x| {
            let [x, y, z] = [x.x, x.y, x.z].map(|x| TAU * x / 16.0);
            let u = speed * Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0) * z.cos();
            let p = speed * speed / 16.0
                * ((2.0 * x).cos() + (2.0 * y).cos())
                * ((2.0 * z).cos() + 2.0);
            (1.0 + 3.0 * p, u)
        })
    },
};

pub(super) const ABC: Flow = Flow {
    name: "abc",
    about: &[
        "The ABC (Beltrami) flow, u = (sin kz + cos ky, sin kx + cos kz, sin ky + cos kx), largest velocity U, in a",
        "periodic box of 16^3 cells, for the time 3 L/U, at least 300 and at most 800 steps. Right: within 10 % (root",
        "mean square over that of the exact velocity) of its exact solution u(0) exp(-nu k^2 t) when it has decayed to",
        "1/e or at t = 3/(U k), whichever comes first: later the flow is itself unstable. error: that distance. It starts",
        "with the stress of its velocity field (tests/validation/src/stability/start.rs).",
    ],
    parameter: "velocity",
    values: SPEEDS,
    search: Search::Frontiers,
    also: |_| None,
    lines,
    run: abc,
};

fn lines(engine: EngineName) -> Vec<Line> {
    let line = |model, tau| Line { engine, model, weighting: None, variant: "", tau };
    Preset::ALL.into_iter().flat_map(|model| TAUS.map(|tau| line(model, tau))).collect()
}

/// A number of steps, rounded and kept within bounds.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "kept within bounds")]
fn within(steps: f64, least: u64, most: u64) -> u64 {
    (steps.round() as u64).clamp(least, most)
}

/// Runs a flow and holds it to its budget of energy, in two dimensions to the bound of vorticity too.
fn budget(
    lab: &Lab,
    line: &Line,
    (cells, steps, speed): ([usize; 3], u64, f64),
    state: impl Fn(Vec3) -> (f64, Vec3),
) -> Result<Found, LabError> {
    let setup = Lab::setup(line, cells, Faces::PERIODIC)?;
    let nu = viscosity(line.tau);
    let mut engine = lab.flowing(line, &setup, state)?;
    let all = Block::whole(&setup.domain);
    let look = |engine: &Coupled| {
        let u: Vec<Vec3> = engine.cells(all).iter().map(|cell| cell.velocity).collect();
        let n = u.len() as f64;
        let energy = u.iter().map(|u| 0.5 * u.norm_squared()).sum::<f64>() / n;
        let squares: Vec<f64> = vorticity(&u, cells).iter().map(|w| w.norm_squared()).collect();
        let largest = squares.iter().copied().fold(0.0, f64::max).sqrt();
        (energy, squares.iter().sum::<f64>() / n, largest)
    };
    let (first, mut enstrophy, sharpest) = look(&engine);
    // Often enough that the energy falls by less than a tenth from look to look, and that the flow
    // moves by less than a cell: E'/E = -2 ν Ω/(2 E).
    let rate = nu * enstrophy / first;
    let every = within((0.1 / rate).min(1.0 / speed), 1, 20);
    let (mut lost, mut error, mut now) = (0.0, 0.0_f64, 0);
    while now < steps {
        let end = (now + every).min(steps);
        go_on(&mut engine, end)?;
        let (energy, next, largest) = look(&engine);
        lost += nu * 0.5 * (enstrophy + next) * (end - now) as f64;
        (enstrophy, now) = (next, end);
        error = error.max((first - energy - lost).abs() / first);
        if cells[2] == 1 {
            error = error.max((largest / sharpest - 1.0) * ENERGY / VORTICITY);
        }
        if energy < 1e-6 * first {
            // What is left is at rest, and no round-off of it is judged.
            go_on(&mut engine, steps)?;
            return Ok(Found::judged(steps, error, ENERGY));
        }
    }
    Ok(Found::judged(steps, error, ENERGY))
}

fn abc(lab: &Lab, line: &Line, speed: f64) -> Result<Found, LabError> {
    const SIDE: usize = 16;
    let k = TAU / SIDE as f64;
    // The largest |u| of the flow with A = B = C = 1 is √6, where all sines and cosines agree.
    let scale = speed / 6.0_f64.sqrt();
    let field = |x: Vec3| {
        let [x, y, z] = [k * x.x, k * x.y, k * x.z];
        scale * Vec3::new(z.sin() + y.cos(), x.sin() + z.cos(), y.sin() + x.cos())
    };
    // p = -ρ (u² - <u²>)/2, ρ = 1 + 3 p; <u²> = 3 for A = B = C = 1
    let density = |u: &Vec3| 1.0 - 1.5 * (u.norm_squared() - 3.0 * scale * scale);
    let setup = Lab::setup(line, [SIDE; 3], Faces::PERIODIC)?;
    let mut engine = lab.flowing(line, &setup, |x| (density(&field(x)), field(x)))?;
    let rate = viscosity(line.tau) * k * k;
    let steps = within(48.0 / speed, 300, 800);
    let judged_at = within((1.0 / rate).min(3.0 / (speed * k)), 1, steps);
    go_on(&mut engine, judged_at)?;
    let all = Block::whole(&setup.domain);
    let left = (-rate * judged_at as f64).exp();
    let (mut off, mut whole) = (0.0, 0.0);
    for (number, cell) in engine.cells(all).iter().enumerate() {
        let exact = left * field(setup.domain.centre(setup.domain.coordinates(number)));
        off += (cell.velocity - exact).norm_squared();
        whole += exact.norm_squared();
    }
    go_on(&mut engine, steps)?;
    Ok(Found::judged(steps, (off / whole).sqrt(), DISTANCE))
}
