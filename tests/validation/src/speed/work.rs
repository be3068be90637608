//! What is computed when the speed of engines is compared.

use psmrt::engine::{Block, Coupled, EngineName, EngineStop, StartError, starting_from};
use psmrt::kernel::Gpu;
use psmrt_reference::collision::{Collision, Preset};
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{Domain, DomainError, Face, Faces};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use std::sync::Arc;

/// A scene, and what is done at each step besides the fluid.
#[derive(Clone, Debug)]
pub struct Work {
    /// For readers.
    pub name: &'static str,
    /// The scene.
    pub setup: Setup,
    /// What is done besides.
    pub besides: Besides,
}

/// What is done at each step besides the fluid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Besides {
    /// Nothing.
    Nothing,
    /// Forces on all solids are worked out.
    Forces,
}

/// Bytes that a cell update of an engine moves: populations are read and written, by an engine with two copies in
/// three turns, since the second is read before it is written.
pub fn bytes_per_update(engine: EngineName) -> usize {
    let turns = if engine.copies() == 1 { 2 } else { 3 };
    turns * 19 * usize::from(engine.bytes_of_number())
}

/// The engine with a fluid in uniform motion. Errors if it cannot take the set-up.
pub fn start(
    engine: EngineName,
    gpu: Option<&Arc<Gpu>>,
    setup: &Setup,
) -> Result<Coupled, StartError> {
    starting_from(engine, setup, None, gpu, |_| (1.0, Vec3::new(0.01, 0.0, 0.0)))
}

/// Makes `steps` steps of a work. Errors if the state breaks or the device fails.
pub fn advance(engine: &mut Coupled, work: &Work, steps: u64) -> Result<(), EngineStop> {
    match work.besides {
        Besides::Nothing => engine.step(steps)?,
        Besides::Forces => {
            for _ in 0..steps {
                engine.step(1)?;
            }
        }
    }
    // A device works on while it is not asked.
    engine.cells(Block::cell([0; 3]));
    engine.still_works()
}

/// The works in a cube of `side` cells. Errors if it cannot be.
pub fn works(side: usize) -> Result<Vec<Work>, DomainError> {
    let periodic = Domain::new([side; 3], Faces::PERIODIC)?;
    let lid = Face::Wall { velocity: Vec3::new(0.01, 0.0, 0.0) };
    let walls = Faces { x: [Face::wall(); 2], y: [Face::wall(); 2], z: [Face::wall(), lid] };
    let cavity = Domain::new([side; 3], walls)?;
    let collision = |preset: Preset| preset.collision(0.8).unwrap_or(Collision::Srt { tau: 0.8 });
    let (srt, mrt) = (collision(Preset::Srt), collision(Preset::DHumieres));
    let fluid = |collision| Setup::fluid(periodic.clone(), collision);
    let (still, velocity) = (Vec3::zeros(), Vec3::new(1e-3, 0.0, 0.0));
    let held = fluid(mrt).with_solids(bed(side, 16, 0.6, still));
    let moving = fluid(mrt).with_solids(bed(side, 16, 0.4, velocity));
    let small = fluid(mrt).with_solids(bed(side, 8, 0.13, velocity));
    let phase = SolidPhase {
        operator: SolidOperator::GradedViscosity,
        weighting: Weighting::Graded,
        ..bed(side, 16, 0.6, still)
    };
    let graded = fluid(mrt).with_solids(phase);
    let linear = |setup: &Setup| {
        let phase = setup.solid_phase.clone().unwrap_or_default();
        setup.clone().with_solids(SolidPhase { coverage: CoverageRule::Linear, ..phase })
    };
    let (moving_linear, small_linear) = (linear(&moving), linear(&small));
    let work = |name, setup, besides| Work { name, setup, besides };
    Ok(vec![
        work("MRT", fluid(mrt), Besides::Nothing),
        work("SRT", fluid(srt), Besides::Nothing),
        work("MRT, body force", fluid(mrt).with_body_force(1e-4 * velocity), Besides::Nothing),
        work("MRT, lid-driven cavity", Setup::fluid(cavity, mrt), Besides::Nothing),
        work("PS-MRT, fixed bed of 0.6", held.clone(), Besides::Nothing),
        work("PS-MRT, fixed bed of 0.6, graded viscosity", graded, Besides::Nothing),
        work("PS-MRT, fixed bed of 0.6, forces", held, Besides::Forces),
        work("PS-MRT, bed of 0.4 on the move, forces", moving, Besides::Forces),
        work(
            "PS-MRT, bed of 0.4 on the move, forces, linear coverage",
            moving_linear,
            Besides::Forces,
        ),
        work("PS-MRT, grains of 4 cells on the move, forces", small, Besides::Forces),
        work(
            "PS-MRT, grains of 4 cells on the move, forces, linear coverage",
            small_linear,
            Besides::Forces,
        ),
    ])
}

/// A body-centred array of spheres, two in each cube of `pitch` cells, that fills `solid_fraction` of a cube.
fn bed(side: usize, pitch: usize, solid_fraction: f64, velocity: Vec3) -> SolidPhase {
    // 2 · 4/3 π a³ = φ · pitch³
    let radius = pitch as f64 * (solid_fraction * 3.0 / (8.0 * std::f64::consts::PI)).cbrt();
    let cubes = side / pitch;
    let mut solids = Vec::new();
    for i in 0..cubes * cubes * cubes {
        let cube = [i % cubes, i / cubes % cubes, i / cubes / cubes];
        let corner = Vec3::from(cube.map(|c| (c * pitch) as f64)).add_scalar(0.3);
        for centre in [corner, corner.add_scalar(0.5 * pitch as f64)] {
            solids.push(Solid { velocity, ..Solid::fixed_sphere(centre, radius) });
        }
    }
    SolidPhase { solids, ..SolidPhase::default() }
}
