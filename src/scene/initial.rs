//! How the fluid starts: density and velocity at a cell centre, lattice units.

use std::f64::consts::PI;
use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use psmrt_reference::lattice::{CS2, Vec3};

/// How the fluid starts, lattice units.
#[derive(Clone, PartialEq)]
pub enum Initial {
    /// With the same velocity everywhere.
    Uniform(Vec3),
    /// On a straight line between the velocities of two walls, so many cells apart.
    Shear {
        /// The axis from one wall to the other.
        across: usize,
        /// Their distance.
        length: f64,
        /// The walls' velocities.
        walls: [Vec3; 2],
    },
    /// A sine, of one wave.
    ShearWave {
        /// The axis along which it changes.
        across: usize,
        /// Its length.
        length: f64,
        /// The velocity where it is largest.
        crest: Vec3,
    },
    /// Vortices of Taylor and Green.
    TaylorGreen {
        /// The axes of their plane.
        axes: [usize; 2],
        /// The length of a wave along each.
        lengths: [f64; 2],
        /// The largest velocity along the first.
        speed: f64,
    },
    /// Cell by cell.
    Cells(CellsAtStart),
    /// As the run in this folder ended; put in by [`Self::Cells`] before an engine starts from it.
    Run(PathBuf),
}

/// Density and velocity of all cells, x fastest.
#[derive(Clone, PartialEq)]
pub struct CellsAtStart {
    /// Cells along x, y, z.
    pub cells: [usize; 3],
    /// Of each cell; 1 everywhere where there are none.
    pub densities: Option<Arc<[f64]>>,
    /// Of each cell.
    pub velocities: Arc<[Vec3]>,
    /// The run that they come from, if they do.
    pub run: Option<PathBuf>,
}

impl Initial {
    /// Density and velocity at a cell centre.
    pub fn at(&self, centre: Vec3) -> (f64, Vec3) {
        match self {
            Initial::Uniform(velocity) => (1.0, *velocity),
            Initial::Shear { across, length, walls: [low, high] } => {
                (1.0, low + (high - low) * (centre[*across] / length))
            }
            Initial::ShearWave { across, length, crest } => {
                (1.0, crest * (2.0 * PI * centre[*across] / length).sin())
            }
            Initial::TaylorGreen { axes, lengths, speed } => {
                taylor_green(*axes, *lengths, *speed, &centre)
            }
            Initial::Cells(of) => of.at(&centre),
            Initial::Run(_) => (1.0, Vec3::zeros()),
        }
    }

    /// The largest speed anywhere; of a run's state as long as it is unknown 0.
    pub fn top_speed(&self) -> f64 {
        match self {
            Initial::Uniform(velocity) => velocity.norm(),
            Initial::Shear { walls, .. } => walls[0].norm().max(walls[1].norm()),
            Initial::ShearWave { crest, .. } => crest.norm(),
            Initial::TaylorGreen { lengths: [r, s], speed, .. } => speed.abs() * (s / r).max(1.0),
            Initial::Cells(of) => of.velocities.iter().map(Vec3::norm).fold(0.0, f64::max),
            Initial::Run(_) => 0.0,
        }
    }
}

/// Density and velocity in vortices of Taylor and Green.
fn taylor_green(axes: [usize; 2], lengths: [f64; 2], speed: f64, centre: &Vec3) -> (f64, Vec3) {
    let [k_r, k_s] = lengths.map(|length| 2.0 * PI / length);
    let ([r, s], ratio) = (axes.map(|axis| centre[axis]), k_r / k_s);
    let mut velocity = Vec3::zeros();
    velocity[axes[0]] = speed * (k_r * r).sin() * (k_s * s).cos();
    velocity[axes[1]] = -speed * ratio * (k_r * r).cos() * (k_s * s).sin();
    // p = ρ U²/4 (cos 2 k_r r + (k_r/k_s)² cos 2 k_s s),  p = c_s² ρ
    let swing = (2.0 * k_r * r).cos() + ratio * ratio * (2.0 * k_s * s).cos();
    (1.0 + 0.25 * speed * speed * swing / CS2, velocity)
}

impl CellsAtStart {
    fn at(&self, centre: &Vec3) -> (f64, Vec3) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cell centres")]
        let [i, j, k] = [0, 1, 2].map(|axis| centre[axis] as usize);
        let [nx, ny, _] = self.cells;
        let cell = i + nx * (j + ny * k);
        let density = self.densities.as_ref().map_or(1.0, |densities| densities[cell]);
        (density, self.velocities[cell])
    }
}

/// What a checkpoint is bound to. Of cells: where they come from; their file is bound by its own sum.
impl fmt::Debug for Initial {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Initial::Uniform(velocity) => write!(out, "{velocity:?}"),
            Initial::Shear { across, length, walls } => {
                write!(out, "shear {across} {length} {walls:?}")
            }
            Initial::ShearWave { across, length, crest } => {
                write!(out, "shear wave {across} {length} {crest:?}")
            }
            Initial::TaylorGreen { axes, lengths, speed } => {
                write!(out, "Taylor-Green {axes:?} {lengths:?} {speed}")
            }
            Initial::Cells(CellsAtStart { run: None, .. }) => write!(out, "cells"),
            Initial::Cells(CellsAtStart { run: Some(folder), .. }) | Initial::Run(folder) => {
                write!(out, "the run {}", folder.display())
            }
        }
    }
}
