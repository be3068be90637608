//! Parameters become a scene of `golden/tradeoff/` with changes, and the exact answer beside it.

use std::f64::consts::PI;

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::lattice::viscosity;

use crate::cases::{Bench, CaseError};
use crate::tradeoff::parameters::{Flow, Parameters, Storage};
use psmrt::scene::preset_changes;
use psmrt::table::Table;

/// Viscosity of all scenes, m2/s.
const SI_VISCOSITY: f64 = 1e-6;

/// Edge of a cell of the arrays, m: a power of two, so that centres lie on mirror planes to the last bit.
const SI_DX: f64 = 1.0 / 65536.0;

/// Diameter of the grain that settles, m, and its density over that of the fluid.
const SI_GRAIN: f64 = 5e-5;
const DENSITY_RATIO: f64 = 2.0;

/// Height of the shaft in diameters.
const SHAFT_HEIGHT: u32 = 8;

/// A run that can be made.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The scene, relative to the folder `golden`.
    pub scene: String,
    /// Its changes, as `--set` takes them.
    pub changes: Vec<String>,
    /// Drag over Stokes' drag by the literature; 1 between plates.
    pub drag: f64,
}

/// The literature that the settings need: files of the folder `golden`, as tables.
#[derive(Clone, Debug)]
pub struct Literature {
    /// `sphere_arrays/literature.csv`.
    pub arrays: Table,
    /// `stokes_settling/literature.csv`.
    pub shafts: Table,
    /// `tradeoff/literature.csv`.
    pub ducts: Table,
    /// `tradeoff/random.csv`: where the spheres of random beds are.
    pub random: Table,
    /// `tradeoff/random_drag.csv`: their drag, by our own finest grids.
    pub random_drag: Table,
}

impl Literature {
    /// What the folder of a bench has. Errors if a file cannot be read.
    pub fn of(bench: &Bench) -> Result<Self, CaseError> {
        Ok(Literature {
            arrays: bench.literature("sphere_arrays", "literature.csv")?,
            shafts: bench.literature("stokes_settling", "literature.csv")?,
            ducts: bench.literature("tradeoff", "literature.csv")?,
            random: bench.literature("tradeoff", "random.csv")?,
            random_drag: bench.literature("tradeoff", "random_drag.csv")?,
        })
    }
}

impl Setting {
    /// The scene and the truth for some parameters. Errors if the literature does not know the geometry.
    pub fn new(parameters: &Parameters, literature: &Literature) -> Result<Self, CaseError> {
        let (flow, drag) = match parameters.flow {
            Flow::Poiseuille => (poiseuille(parameters), 1.0),
            Flow::Settling => {
                let wanted = [("section", "square"), ("a_over_halfwidth", &*parameters.geometry)];
                let drag =
                    literature.shafts.with(&wanted)?.number("K1_translating_in_still_fluid")?;
                (settling(parameters)?, drag)
            }
            Flow::SphereDrag => {
                let own = literature.ducts.with(&[("solid_fraction", &parameters.geometry)])?;
                let drag = own.number("K")?;
                (array(parameters, drag, &[])?, drag)
            }
            Flow::Random => {
                let wanted = [("solid_fraction", &*parameters.geometry)];
                let drag = literature.random_drag.with(&wanted)?.number("K")?;
                let places = literature.random.with(&wanted)?;
                let [x, y, z] = ["x", "y", "z"].map(|axis| places.numbers(axis));
                let (x, y, z) = (x?, y?, z?);
                let sites: Vec<[f64; 3]> = (0..x.len()).map(|i| [x[i], y[i], z[i]]).collect();
                (array(parameters, drag, &sites)?, drag)
            }
            Flow::Sc | Flow::Bcc | Flow::Fcc | Flow::Seepage => {
                let lattice = parameters.flow.lattice().map_or("", |(name, _)| name);
                let wanted = [("lattice", lattice), ("solid_fraction_c", &*parameters.geometry)];
                let drag = literature.arrays.with(&wanted)?.number("K_computed")?;
                (array(parameters, drag, &[])?, drag)
            }
        };
        let (scene, mut changes) = flow;
        changes.push(format!("time.tau={}", parameters.tau));
        changes.extend(preset_changes(parameters.collision));
        if parameters.flow != Flow::Poiseuille {
            match &*parameters.weight {
                "eps" => changes.push("solid.weighting=\"solid_fraction\"".to_owned()),
                "NT" => changes.push("solid.weighting=\"noble_torczynski\"".to_owned()),
                // The operator's own.
                _ => {}
            }
            changes.push(format!("solid.operator=\"{}\"", parameters.operator));
            match parameters.coverage {
                CoverageRule::Exact => {}
                CoverageRule::Linear => changes.push("solid.coverage=\"linear\"".to_owned()),
                CoverageRule::Sampled { n } => {
                    changes.push("solid.coverage=\"sampled\"".to_owned());
                    changes.push(format!("solid.samples={n}"));
                }
            }
        }
        Ok(Setting { scene: format!("tradeoff/{scene}.toml"), changes, drag })
    }
}

/// Time step for an edge of a cell, s.
fn si_dt(parameters: &Parameters, si_dx: f64) -> f64 {
    viscosity(parameters.tau) * si_dx * si_dx / SI_VISCOSITY
}

fn poiseuille(parameters: &Parameters) -> (&'static str, Vec<String>) {
    let (n, nu) = (f64::from(parameters.cells), viscosity(parameters.tau));
    let si_dx = 1e-3 / n;
    // u = G H²/(8 ν)
    let force = 8.0 * nu * parameters.lattice_velocity / (n * n);
    let si_force = force * si_dx / si_dt(parameters, si_dx).powi(2);
    // The slowest disturbance takes H²/(π² ν) steps to fall to 1/e; rows come every fifth of it.
    let rows = (0.2 * n * n / (PI * PI * nu)).ceil() + 8.0;
    let changes = vec![
        format!("domain.dx={si_dx:e}"),
        format!("domain.size=[{si_dx:e}, 1e-3, {si_dx:e}]"),
        format!("body_force.acceleration=[{si_force:e}, 0.0, 0.0]"),
        format!("records[0].every_steps={rows}"),
        format!("stop.steps={}", 200.0 * rows),
        format!("stop.steady.tolerance={:e}", steady_tolerance(parameters, 1e-8)),
    ];
    ("poiseuille", changes)
}

/// Reynolds number above which inertia counts.
const FAST: f64 = 0.5;

/// What may still be to go, relative, when a run is steady; single precision has noise above 1e-6, and
/// emulated storage never becomes steady: it runs to its limit.
fn steady_tolerance(parameters: &Parameters, wanted: f64) -> f64 {
    match parameters.storage {
        _ if parameters.is_emulated() => 1e-9,
        // Where inertia counts, full cells gather mass (reference/ERRATA.md) and the flow creeps on.
        _ if parameters.reynolds() > FAST => wanted.max(2e-4),
        Storage::F64 => wanted,
        _ => wanted.max(1e-5),
    }
}

/// Spheres held in a periodic box: at `places` (edges of the box), or a quarter of an array between mirrors.
fn array(
    parameters: &Parameters,
    drag: f64,
    places: &[[f64; 3]],
) -> Result<(&'static str, Vec<String>), CaseError> {
    let (Some((lattice, count)), Some(d)) =
        (parameters.flow.lattice(), parameters.cells_per_diameter())
    else {
        return Err(CaseError::table(format!("{} is no array", parameters.flow.word())));
    };
    let (n, nu, u) = (parameters.cells, viscosity(parameters.tau), parameters.lattice_velocity);
    let volume = f64::from(n).powi(3);
    // G V = n 6π ν a K U
    let stokes = f64::from(count) * 3.0 * PI * nu * d;
    let force = stokes * drag * u / volume;
    let (si_dx, si_dt) = (SI_DX, si_dt(parameters, SI_DX));
    // The drag stops the fluid in V/(n 6π ν a K) steps, the slowest time; rows come every half of it.
    let rows = (0.5 * volume / (stokes * drag)).ceil() + 8.0;
    // The start takes the leak for known: x = 3 (τ - 1/2) K/d² (tests/oracle/sphere_arrays.rs).
    let start = u * (1.0 + 3.0 * (parameters.tau - 0.5) * drag / (d * d));
    // Scenes may start with no more than 0.2 cells per step; inertia stops a flow that the force would make so fast.
    let start = start.min(0.15);
    let (scene, sites) = if places.is_empty() { sites(lattice) } else { ("random", places) };
    let across = if places.is_empty() { n / 2 } else { n };
    let mut changes = vec![
        format!("domain.cells=[{n}, {across}, {across}]"),
        format!("domain.dx={si_dx:e}"),
        format!("body_force.acceleration=[{:e}, 0.0, 0.0]", force * si_dx / (si_dt * si_dt)),
        format!("initial.velocity=[{:e}, 0.0, 0.0]", start * si_dx / si_dt),
        format!("records[0].every_steps={rows}"),
        format!("stop.steps={}", if parameters.is_emulated() { 20.0 } else { 1600.0 } * rows),
        format!("stop.steady.tolerance={:e}", steady_tolerance(parameters, 2e-5)),
    ];
    for (i, site) in sites.iter().enumerate() {
        let [x, y, z] = site.map(|share| share * f64::from(n) * si_dx);
        changes.push(format!("grains[{i}].centre=[{x:e}, {y:e}, {z:e}]"));
        changes.push(format!("grains[{i}].diameter={:e}", d * si_dx));
    }
    Ok((scene, changes))
}

/// The scene of a lattice, and where its spheres are, in edges of the unit cell.
fn sites(lattice: &str) -> (&'static str, &'static [[f64; 3]]) {
    match lattice {
        "SC" => ("sc", &[[0.0; 3]]),
        "BCC" => ("bcc", &[[0.0; 3], [0.5; 3]]),
        _ => ("fcc", &[[0.0; 3], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]]),
    }
}

fn settling(parameters: &Parameters) -> Result<(&'static str, Vec<String>), CaseError> {
    let ratio: f64 = parameters.geometry.parse().unwrap_or(f64::NAN);
    let (d, nu) = (f64::from(parameters.cells), viscosity(parameters.tau));
    let half = 0.5 * d / ratio;
    if (half - half.round()).abs() > 1e-9 {
        let problem = format!("a shaft of half width {half} cells is no whole number of them");
        return Err(CaseError::table(problem));
    }
    let si_dx = SI_GRAIN / d;
    let si_velocity = parameters.lattice_velocity * si_dx / si_dt(parameters, si_dx);
    // g = 18 ν U/(d² (ρ_s/ρ_f - 1))
    let gravity = 18.0 * SI_VISCOSITY * si_velocity / (SI_GRAIN.powi(2) * (DENSITY_RATIO - 1.0));
    let height = SHAFT_HEIGHT * parameters.cells;
    // 0.3 cells above the middle, so that it does not stand on a node.
    let si_start = (0.5 * f64::from(height) + 0.3) * si_dx;
    // The slowest shear dies with 2 (π/(2 b))² ν, b the half width: a fiftieth of it is left, of which the
    // grain feels a small part. The sound of the release runs up and down the shaft as well, and at large
    // relaxation times outlasts that: the velocity still swings by a fifth after two periods of 2 H/c_s, and
    // by less than 1 % of its error after six.
    let sound = 6.0 * 2.0 * f64::from(height) * 3.0_f64.sqrt();
    let steps = (0.8 * half * half / nu).max(sound).ceil();
    let changes = vec![
        format!("domain.cells=[{half}, {half}, {height}]"),
        format!("domain.dx={si_dx:e}"),
        format!("gravity.acceleration=[0.0, 0.0, {:e}]", -gravity),
        format!("grains[0].centre=[0.0, 0.0, {si_start:e}]"),
        format!("grains[0].density={:e}", 1000.0 * DENSITY_RATIO),
        format!("records[0].every_steps={}", (steps / 10.0).ceil()),
        format!("stop.steps={steps}"),
    ];
    Ok(("settling", changes))
}
