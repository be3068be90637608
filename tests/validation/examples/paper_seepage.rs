//! The paper's section 6 at its own size: water through a bed of 1,000 spheres of 16 cells, and of 8.
//!
//! Adds one row per run to `golden/seepage/paper_size.csv` as it goes; runs that have a row are left out, so that it can be
//! cut off and started again. Some four hours on two cores.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example paper_seepage
//! ```

use std::error::Error;
use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt::run::{End, RunError};
use psmrt::scene::preset_changes;
use psmrt_reference::collision::Preset;
use psmrt_validation::cases::{BED_LAWS, Bench, CaseError, Study};

const TABLE: &str = "golden/seepage/paper_size.csv";

/// What stands at the head of the table when it is begun.
const HEAD: &str = "\
# Seepage through the bed of the paper's section 6 at its own size, 1,000 spheres of 16 cells (or 8) under a velocity inlet with free
# outflow: cargo run --release -p psmrt-validation --example paper_seepage
# paper.toml with other values, on the CPU engine in single precision. core: the spheres whose centres are at least 1.5 diameters above the lowest
# and 2 below the highest centre; core_solid_fraction by the volumes of the spheres between these planes. psi =
# F phi/V d eps3/(rho U2 (1 - eps)), F the mean force on a sphere of the core, V its volume, phi = 1 - eps, rho the mean density;
# Re = U d/(nu phi), U of the inlet; Re_wanted: with phi = 0.566. density: mean of the domain, kg/m3; max_speed: cells
# per step; density_change: mean density over the reference one, less 1. outcome: steady (the force on all grains within 1e-3 of
# its final value by the scene's criterion), not steady after 15 viscous times d2/(4 pi2 nu), or the guard's words.
engine,cells,collision,weighting,operator,tau,Re_wanted,outcome,Re,psi,psi_Re,over_Beetstra,over_Tang,core_spheres,core_solid_fraction,density,max_speed,lattice_velocity,steps,cell_updates,density_change
";

/// Diameter, m, and viscosity, m2/s, of the scene, and the solid fraction that `Re_wanted` is for.
const SI_DIAMETER: f64 = 1.6e-4;
const SI_VISCOSITY: f64 = 1e-6;
const FRACTION: f64 = 0.566;

/// Reynolds numbers, each with the relaxation time at which the pressure under the bed is that of 0.5 to 1 % of the density.
const STREAMS: [(f64, f64); 8] = [
    (10.0, 0.51),
    (30.0, 0.505),
    (1.0, 0.53),
    (2.0, 0.52),
    (0.1, 0.6),
    (5.0, 0.51),
    (0.3, 0.55),
    (20.0, 0.505),
];

/// Reynolds numbers of which only the end is asked for: whether the flow lives.
const LIVES: [(f64, f64); 3] = [(30.0, 0.505), (10.0, 0.51), (2.0, 0.52)];

/// How solids act on the fluid: operator and, where it has no weight of its own, weighting.
type Solids = (&'static str, Option<&'static str>);

const PAPER: Solids = ("bounce_back", Some("noble_torczynski"));
const FRACTION_WEIGHT: Solids = ("bounce_back", Some("solid_fraction"));
const GRADED: Solids = ("graded_viscosity", None);

fn main() -> Result<(), Box<dyn Error>> {
    if !Path::new(TABLE).exists() {
        fs::write(TABLE, HEAD)?;
    }
    let mut bench = Bench::new(Path::new("golden"), EngineName::CpuSingle, None, |_| {});
    // What tells most comes first: each collision and operator at one Reynolds number, then the others one by one.
    for solids in [PAPER, GRADED] {
        add(&mut bench, 8, Preset::DHumieres, solids, STREAMS[0])?;
    }
    for stream in STREAMS {
        add(&mut bench, 16, Preset::DHumieres, PAPER, stream)?;
        add(&mut bench, 16, Preset::Srt, PAPER, stream)?;
        add(&mut bench, 16, Preset::DHumieres, GRADED, stream)?;
    }
    for stream in LIVES {
        add(&mut bench, 16, Preset::DHumieres, FRACTION_WEIGHT, stream)?;
        add(&mut bench, 16, Preset::Srt, FRACTION_WEIGHT, stream)?;
    }
    Ok(())
}

fn add(
    bench: &mut Bench,
    cells: u32,
    collision: Preset,
    (operator, weighting): Solids,
    (reynolds, tau): (f64, f64),
) -> Result<(), Box<dyn Error>> {
    let mut row = format!(
        "{},{cells},{},{},{operator},{tau},{reynolds},",
        bench.engine_name().word(),
        collision.word(),
        weighting.unwrap_or("own")
    );
    let study = Study::new(TABLE);
    if study.row(&row)?.is_some() {
        return Ok(());
    }
    let (nu, d) = ((tau - 0.5) / 3.0, f64::from(cells));
    let [side, height] = [128, 272].map(|at_16| at_16 * cells / 16);
    let velocity = reynolds * SI_VISCOSITY * FRACTION / SI_DIAMETER;
    let vector = format!("[0.0, 0.0, {velocity:e}]");
    // A quarter of the time in which a disturbance as long as a sphere is wide dies down by a factor of e.
    let interval = (0.25 * d * d / (4.0 * PI * PI * nu)).ceil();
    let mut changes = vec![
        format!("domain.cells=[{side},{side},{height}]"),
        format!("domain.dx={:e}", SI_DIAMETER / d),
        format!("time.tau={tau}"),
        format!("faces.z_low.velocity={vector}"),
        format!("initial.velocity={vector}"),
        format!("solid.operator=\"{operator}\""),
        format!("records[0].every_steps={interval}"),
        format!("records[1].every_steps={interval}"),
        format!("stop.steps={}", 60.0 * interval),
    ];
    changes.extend(weighting.map(|word| format!("solid.weighting=\"{word}\"")));
    changes.extend(preset_changes(collision));
    let before = bench.cell_updates();
    row += &match bench.run("seepage/paper.toml", &changes) {
        Err(CaseError::Run(RunError::Stopped(why))) => {
            format!("{}{}", why.to_string().replace(',', ";"), ",0".repeat(13))
        }
        Err(error) => return Err(error.into()),
        Ok((run, end)) => {
            let loads = run.record("loads")?;
            let last = loads.values("step")?.pop().ok_or("no loads")?;
            let loads = loads.with(&[("step", &last)])?;
            let core = Core::of(
                &loads.numbers("z (m)")?,
                &loads.numbers("force_z (N)")?,
                run.scene.setup.domain.cells().map(|n| n as f64 * run.scene.units.si_dx),
            );
            let means = run.engine.box_means();
            let density = 1000.0 * means.density;
            let (phi, d) = (core.fraction, SI_DIAMETER);
            let re = velocity * d / (SI_VISCOSITY * phi);
            // psi = (dP/L) d ε³/(ρ U² (1 - ε)), the force of the fluid on the bed being the pressure gradient's
            let gradient = core.force * phi / (PI / 6.0 * d.powi(3));
            let psi = gradient * d * (1.0 - phi).powi(3) / (density * velocity * velocity * phi);
            let [beetstra, tang] =
                [3, 4].map(|law: usize| psi * re / (BED_LAWS[law].psi_re)(phi, re));
            let outcome = match end {
                End::Steady { .. } => "steady".to_owned(),
                End::NotSteady { left: Some(left) } => format!("not steady; {left:.0e} left"),
                _ => "not steady".to_owned(),
            };
            format!(
                "{outcome},{re:.4},{psi:.5},{:.3},{beetstra:.4},{tang:.4},{},{phi:.5},{:.2},{:.4},{:.5},{},{},{:.1e}",
                psi * re,
                core.spheres,
                density,
                means.max_speed,
                reynolds * nu * FRACTION / f64::from(cells),
                run.engine.steps(),
                bench.cell_updates() - before,
                // Of the density of the water in the domain, over the reference one.
                means.density - 1.0,
            )
        }
    };
    study.add(&row)?;
    Ok(())
}

/// The spheres of the bed that its ends do not touch.
struct Core {
    spheres: usize,
    /// Solid fraction between the planes that bound it.
    fraction: f64,
    /// Mean force on a sphere, N.
    force: f64,
}

impl Core {
    /// Those whose centres are at least 1.5 diameters above the lowest centre and 2 below the highest.
    fn of(heights: &[f64], forces: &[f64], [x, y, _]: [f64; 3]) -> Self {
        let d = SI_DIAMETER;
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min) + 1.5 * d;
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max) - 2.0 * d;
        let inside: Vec<f64> = heights
            .iter()
            .zip(forces)
            .filter(|(z, _)| (low..=high).contains(*z))
            .map(|(_, force)| *force)
            .collect();
        let volume: f64 =
            heights.iter().map(|z| volume_below(high - z) - volume_below(low - z)).sum();
        Core {
            spheres: inside.len(),
            fraction: volume / (x * y * (high - low)),
            force: inside.iter().sum::<f64>() / inside.len() as f64,
        }
    }
}

/// Volume of a sphere below a plane at height `h` above its centre.
fn volume_below(h: f64) -> f64 {
    let r = 0.5 * SI_DIAMETER;
    let h = h.clamp(-r, r);
    // π ∫ (r² - z²) dz from -r to h
    PI * (r * r * (h + r) - (h.powi(3) + r.powi(3)) / 3.0)
}
