//! An engine that keeps populations in fewer digits from step to step, for what that alone does.
//!
//! The arithmetic stays the oracle's, in double precision: a lower bound of the error that a kernel
//! with such storage makes. psmrt's kernel stores shifted populations, `f - w`, in single precision.

use std::io::{self, Read, Write};

use psmrt_reference::coupling::CoupledStop;
use psmrt_reference::directions::{C, Q};
use psmrt_reference::forcing::forced_velocity;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::{Vec3, density, momentum};
use psmrt_reference::setup::SetupError;
use psmrt_reference::solids::{Load, Solid};
use psmrt_reference::solver::Solver;

use psmrt::engine::{BoxMeans, CellState, Engine, EngineStop};
use psmrt::scene::Scene;
use psmrt::tradeoff::parameters::Storage;

/// The oracle with populations rounded after every step; fluid and held grains only.
#[derive(Debug)]
pub struct RoundedEngine {
    solver: Solver,
    storage: Storage,
}

/// What half precision is scaled by, so that small deviations keep all their digits.
const HALF_SCALE: f64 = 16384.0; // 2^14

impl RoundedEngine {
    /// The scene at its start. Errors if the oracle refuses the set-up.
    pub fn new(scene: &Scene, storage: Storage) -> Result<Self, SetupError> {
        let velocity = scene.initial_velocity;
        let solver = Solver::starting_from(scene.setup.clone(), |_| (1.0, velocity))?;
        Ok(RoundedEngine { solver, storage })
    }

    fn body_force(&self) -> Vec3 {
        self.solver.setup().body_force.unwrap_or_else(Vec3::zeros)
    }
}

/// A population of direction `a` after it was kept.
fn kept(f: f64, a: usize, storage: Storage) -> f64 {
    let w = weight(a);
    match storage {
        Storage::F64 => f,
        #[expect(clippy::cast_possible_truncation, reason = "the rounding is what is wanted")]
        Storage::F32Shifted => f64::from((f - w) as f32) + w,
        #[expect(clippy::cast_possible_truncation, reason = "the rounding is what is wanted")]
        Storage::F32 => f64::from(f as f32),
        Storage::F16Shifted => half((f - w) * HALF_SCALE) / HALF_SCALE + w,
    }
}

/// Weight of direction `a` of D3Q19, by its length.
fn weight(a: usize) -> f64 {
    match C[a].iter().map(|c| c * c).sum() {
        0 => 1.0 / 3.0,
        1 => 1.0 / 18.0,
        _ => 1.0 / 36.0,
    }
}

/// The nearest number of IEEE half precision: 11 significant bits, multiples of 2^-24 at least, at most
/// 65504 (larger ones stay infinite, which the guard finds).
pub fn half(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    // Of numbers in [2^e, 2^(e+1)) those of half precision are 2^(e-10) apart.
    let spacing = (value.abs().log2().floor() - 10.0).max(-24.0).exp2();
    let rounded = (value / spacing).round_ties_even() * spacing;
    if rounded.abs() > 65504.0 { f64::INFINITY.copysign(value) } else { rounded }
}

impl Engine for RoundedEngine {
    fn name(&self) -> &'static str {
        "reference"
    }

    fn steps(&self) -> u64 {
        self.solver.steps()
    }

    fn step(&mut self, count: u64) -> Result<(), EngineStop> {
        for _ in 0..count {
            self.solver.advance_fluid().map_err(CoupledStop::from)?;
            let mut f = self.solver.populations().to_vec();
            for populations in &mut f {
                for a in 0..Q {
                    populations[a] = kept(populations[a], a, self.storage);
                }
            }
            let (setup, memory) = (self.solver.setup().clone(), self.solver.memory());
            self.solver = Solver::going_on_from(setup, f, memory)
                .unwrap_or_else(|error| unreachable!("the set-up ran before: {error}"));
        }
        Ok(())
    }

    fn look(&mut self) -> Result<(), EngineStop> {
        Ok(self.solver.check_now().map_err(CoupledStop::from)?)
    }

    fn box_means(&self) -> BoxMeans {
        let (f, g) = (self.solver.populations(), self.body_force());
        let n = f.len() as f64;
        let speed = |f| forced_velocity(density(f), &momentum(f), &g).norm();
        BoxMeans {
            density: f.iter().map(density).sum::<f64>() / n,
            mass_flux: self.solver.mass_flux_field().iter().sum::<Vec3>() / n,
            max_speed: f.iter().map(speed).fold(0.0, f64::max),
        }
    }

    fn cells(&self, numbers: &[usize]) -> Vec<CellState> {
        let g = self.body_force();
        let state = |&cell: &usize| {
            let f = &self.solver.populations()[cell];
            let velocity = forced_velocity(density(f), &momentum(f), &g);
            let coverage = self.solver.coverage();
            let solid_fraction = coverage.map_or(0.0, |coverage| coverage.solid_fraction(cell));
            CellState { density: density(f), velocity, solid_fraction }
        };
        numbers.iter().map(state).collect()
    }

    fn solids(&self) -> Vec<Solid> {
        self.solver.setup().solid_phase.as_ref().map_or_else(Vec::new, |p| p.solids.clone())
    }

    fn free_grains(&self) -> Option<&GrainSystem> {
        None
    }

    fn loads(&self) -> Vec<Load> {
        self.solver.loads().to_vec()
    }

    fn displaced(&self) -> Vec<f64> {
        self.solver.displaced()
    }

    fn save(&self, _: &mut dyn Write) -> io::Result<()> {
        Err(io::Error::other("runs of the trade-off study cannot be saved"))
    }

    fn load(&mut self, _: &mut dyn Read) -> io::Result<()> {
        Err(io::Error::other("runs of the trade-off study cannot be loaded"))
    }
}
