//! An engine that keeps populations in fewer digits from step to step, for what that alone does.
//!
//! The arithmetic stays the oracle's, in double precision: a lower bound of the error that a kernel
//! with such storage makes. psmrt's kernel stores shifted populations, `f - w`, in single precision.

use std::io::{self, Read, Write};

use psmrt_reference::directions::C;
use psmrt_reference::drive::Drive;
use psmrt_reference::guard::{Findings, Guard};
use psmrt_reference::lattice::Populations;
use psmrt_reference::setup::{Setup, SetupError};
use psmrt_reference::solids::{Grip, Load, Solid};

use crate::tradeoff::parameters::Storage;
use psmrt::engine::{
    Block, BoxMeans, CellState, Coupled, DeviceError, FluidEngine, ReferenceEngine, StartError,
};
use psmrt::scene::Scene;

/// The oracle with populations rounded after every step.
#[derive(Debug)]
struct RoundedEngine {
    inner: ReferenceEngine,
    storage: Storage,
}

/// The scene at its start with populations rounded after every step; its grains are held. Errors if the oracle
/// refuses the set-up.
pub fn rounded(scene: &Scene, storage: Storage) -> Result<Coupled, SetupError> {
    let inner = ReferenceEngine::new(scene)?;
    Ok(Coupled::of_fluid(Box::new(RoundedEngine { inner, storage })))
}

/// What half precision is scaled by, so that small deviations keep all their digits.
const HALF_SCALE: f64 = 16384.0; // 2^14

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

impl FluidEngine for RoundedEngine {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn setup(&self) -> &Setup {
        self.inner.setup()
    }

    fn set_drive(&mut self, drive: &Drive) -> Result<(), StartError> {
        self.inner.set_drive(drive)
    }

    fn place_solids(&mut self, solids: Vec<Solid>) -> Result<(), DeviceError> {
        self.inner.place_solids(solids)
    }

    fn advance(&mut self, steps: u64, with_loads: bool) -> Result<(), DeviceError> {
        for _ in 0..steps {
            self.inner.advance(1, with_loads)?;
            let changed = self.inner.change_populations(|f, a| kept(f, a, self.storage));
            changed.map_err(DeviceError::new)?;
        }
        Ok(())
    }

    fn loads(&self) -> Result<Vec<Load>, DeviceError> {
        self.inner.loads()
    }

    fn displaced(&self) -> Result<Vec<f64>, DeviceError> {
        self.inner.displaced()
    }

    fn grips(&mut self, wanted: &[usize]) -> Result<Vec<Grip>, DeviceError> {
        self.inner.grips(wanted)
    }

    fn means(&self) -> Result<BoxMeans, DeviceError> {
        self.inner.means()
    }

    fn findings(&mut self, guard: &Guard) -> Result<Findings, DeviceError> {
        self.inner.findings(guard)
    }

    fn cells(&self, block: Block) -> Result<Vec<CellState>, DeviceError> {
        self.inner.cells(block)
    }

    fn populations(&self, block: Block) -> Result<Vec<Populations>, DeviceError> {
        self.inner.populations(block)
    }

    fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        self.inner.save(out)
    }

    fn load(
        &mut self,
        from: &mut dyn Read,
        solids: Vec<Solid>,
        loads: Vec<Load>,
    ) -> io::Result<()> {
        self.inner.load(from, solids, loads)
    }
}
