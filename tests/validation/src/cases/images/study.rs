//! Single runs of the images: what the scenes are changed to, and the permeability that comes out.

use crate::cases::{Bench, CaseError};

/// Edge of a voxel of the three bodies, m, their lengths along the flow in voxels without the clear ends, and across.
const SI_VOXEL: f64 = 5e-6;
const LENGTH: f64 = 32.0;

/// Viscosity of the water, m2/s, its density, kg/m3, and the pressure difference, Pa.
const SI_VISCOSITY: f64 = 1e-6;
const SI_DENSITY: f64 = 1000.0;
const SI_DROP: f64 = 1.0;

/// One of the three bodies on a grid.
#[derive(Clone, Copy, Debug)]
pub struct PorousImage {
    /// Its file, without ending.
    pub image: &'static str,
    /// Cells along each edge of a voxel.
    pub cells: u32,
    /// The operator of the solid, as scenes spell it.
    pub operator: &'static str,
    /// Relaxation time.
    pub tau: f64,
}

impl PorousImage {
    /// Runs it until it is steady; its permeability, squares of a voxel.
    pub fn run(&self, bench: &mut Bench) -> Result<f64, CaseError> {
        let changes = [
            format!("grains[0].image.file=\"{}.npy\"", self.image),
            format!("domain.dx={:e}", SI_VOXEL / f64::from(self.cells)),
            format!("time.tau={:?}", self.tau),
            format!("solid.operator=\"{}\"", self.operator),
            format!("records[0].every_steps={}", 20 * self.cells * self.cells),
        ];
        let run = bench.steady("images/scene.toml", &changes)?;
        let si_velocity = run.record("permeability")?.numbers("superficial_velocity (m/s)")?;
        let si_velocity = si_velocity.last().copied().unwrap_or(f64::NAN);
        // k = ν U L/(Δp/ρ). The mean velocity is that of the whole domain: the same flux goes through every section.
        let k = SI_VISCOSITY * si_velocity * LENGTH * SI_VOXEL * SI_DENSITY / SI_DROP;
        Ok(k / SI_VOXEL.powi(2))
    }
}

/// The array of spheres as an image on a grid.
#[derive(Clone, Copy, Debug)]
pub struct BallImage {
    /// Cells along each edge of the cube.
    pub cells: u32,
    /// Whether the image has as many voxels as the grid has cells, each solid or not; else 48.
    pub is_binary: bool,
    /// The operator of the solid, as scenes spell it.
    pub operator: &'static str,
}

/// Edge of the cube, m.
const SI_EDGE: f64 = 1e-4;

impl BallImage {
    /// Runs it until it is steady; its permeability, squares of the cube's edge.
    pub fn run(&self, bench: &mut Bench) -> Result<f64, CaseError> {
        let voxels = if self.is_binary { self.cells } else { 48 };
        let changes = [
            format!("grains[0].image.file=\"ball_{voxels}.npy\""),
            format!("grains[0].image.voxel={:?}", SI_EDGE / f64::from(voxels)),
            format!("domain.dx={:?}", SI_EDGE / f64::from(self.cells)),
            format!("solid.operator=\"{}\"", self.operator),
        ];
        let run = bench.steady("images/array.toml", &changes)?;
        let si_k = run.record("permeability")?.numbers("permeability (m2)")?;
        Ok(si_k.last().copied().unwrap_or(f64::NAN) / SI_EDGE.powi(2))
    }
}
