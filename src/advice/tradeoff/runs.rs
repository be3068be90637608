//! Runs with grains of which the exact answer is known: those that the error models were fitted to.

use psmrt_reference::collision::Preset;

use super::model::SolidMethod;
use crate::advice::coefficients::runs;
use crate::table::{Table, TableError};

/// A run with grains.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainPoint {
    /// How its solid cells collide.
    pub solid: SolidMethod,
    /// The geometry: points of one geometry share its accidents.
    pub geometry: String,
    /// Where it stands.
    pub source: String,
    /// Collision of the fluid.
    pub collision: Preset,
    /// Cells per diameter.
    pub cells: f64,
    /// Relaxation time.
    pub tau: f64,
    /// Exact drag over Stokes' drag.
    pub drag: f64,
    /// Relative error of the velocity under a given force.
    pub error: f64,
}

/// Columns of the table of runs.
pub const COLUMNS: [&str; 8] =
    ["collision", "solid", "geometry", "cells", "tau", "drag", "error", "source"];

impl GrainPoint {
    /// The values of [`COLUMNS`].
    pub fn row(&self) -> Vec<String> {
        let numbers = [self.cells, self.tau, self.drag, self.error].map(|value| value.to_string());
        let words = [self.collision.word(), self.solid.word(), &self.geometry];
        let words = words.map(str::to_owned);
        words.into_iter().chain(numbers).chain([self.source.clone()]).collect()
    }

    /// The run of such a row; `None` if it is none.
    fn from_row(row: &[String]) -> Option<Self> {
        let [collision, solid, geometry, cells, tau, drag, error, source] = row else {
            return None;
        };
        Some(GrainPoint {
            collision: Preset::from_word(collision)?,
            solid: SolidMethod::from_word(solid)?,
            geometry: geometry.clone(),
            cells: cells.parse().ok()?,
            tau: tau.parse().ok()?,
            drag: drag.parse().ok()?,
            error: error.parse().ok()?,
            source: source.clone(),
        })
    }

    /// The runs of a table. Errors if a row is none.
    pub fn of_table(table: &Table) -> Result<Vec<Self>, TableError> {
        let point = |row: &Vec<String>| {
            GrainPoint::from_row(row).ok_or_else(|| TableError(format!("{row:?} is no run")))
        };
        table.rows.iter().map(point).collect()
    }
}

/// The committed runs.
pub fn committed() -> Result<Vec<GrainPoint>, TableError> {
    GrainPoint::of_table(&runs()?)
}
