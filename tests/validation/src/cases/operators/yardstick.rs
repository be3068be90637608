//! What the runs are held to where no exact value is known: what finer grids of all operators lead to.

use psmrt::table::Table;
use psmrt_reference::collision::Preset;

use super::beds::{BEDS, Bed, TAUS};
use super::{BOUNCE_BACK, FULL, GRADED, OPERATORS};
use crate::cases::CaseError;
use crate::cases::sphere_drag::study::{VARIED, without_grid};
use crate::tradeoff::parameters::{Flow, Parameters};
use crate::tradeoff::row::Row;

/// What the two finest grids of each operator lead to, errors falling as the square of the cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yardstick {
    /// The mean over the operators.
    pub mean: f64,
    /// The largest distance of one of them from it, relative.
    pub spread: f64,
}

impl Yardstick {
    /// Of the values of the grids of each operator; `None` where one has fewer than two.
    fn of(grids: &[Vec<(f64, f64)>]) -> Option<Self> {
        let ends: Vec<f64> = grids.iter().map(|own| without_grid(own)).collect::<Option<_>>()?;
        let mean = ends.iter().sum::<f64>() / ends.len() as f64;
        let spread = ends.iter().map(|end| (end / mean - 1.0).abs()).fold(0.0, f64::max);
        Some(Yardstick { mean, spread })
    }
}

/// Rows of the stream that became steady, of an operator, with d'Humières' rates, on an engine.
pub fn of_stream(
    stream: &Table,
    operator: &str,
    engine: &str,
    (reynolds, tau): (f64, f64),
) -> Result<Table, CaseError> {
    let (reynolds, tau) = (reynolds.to_string(), tau.to_string());
    Ok(stream.with(&[
        ("operator", operator),
        ("engine", engine),
        ("collision", Preset::DHumieres.word()),
        ("Re", &reynolds),
        ("tau", &tau),
        ("outcome", "steady"),
    ])?)
}

/// Reynolds number, relaxation time and C_D in the paper's box, as far as it is known: exact for Re → 0, else what the
/// paper's operator leads to on 12 and 16 cells per diameter (`golden/sphere_drag/study.csv`, whose claims hold that to
/// open water).
pub fn streams(study: &Table, duct: f64) -> Result<Vec<(f64, f64, f64)>, CaseError> {
    let mut found = Vec::new();
    for varied in VARIED {
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        let (reynolds, tau) = (number(varied.reynolds), number(varied.tau));
        let end = without_grid(&varied.grids(study)?).unwrap_or(f64::NAN);
        // C_D = 24 K/Re
        let known = if reynolds < 0.5 { 24.0 * duct / reynolds } else { end };
        found.push((reynolds, tau, known));
    }
    Ok(found)
}

/// K for Re → 0 in the paper's box, of golden/sphere_drag/duct.csv.
pub fn in_duct(duct: &Table) -> Result<f64, CaseError> {
    let own = duct.with(&[("period_length_over_d", "10")])?;
    Ok(own.number("K_total_force_superficial_U")?)
}

/// A Reynolds number in a bed: the runs with one force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// The bed.
    pub bed: (Flow, &'static str),
    /// `U d/nu` that the force would drive without inertia.
    pub force: f64,
    /// Relaxation times.
    pub taus: [f64; 3],
}

/// All of them.
pub fn levels() -> Vec<Level> {
    let of_bed = |Bed { problem, forces, .. }: Bed| {
        let levels = TAUS.into_iter().zip(forces);
        levels.map(move |(taus, &force)| Level { bed: problem, force, taus })
    };
    BEDS.into_iter().flat_map(of_bed).collect()
}

impl Level {
    /// Its steady runs with an operator and d'Humières' rates at a relaxation time: cells along the edge, and the
    /// superficial velocity over that without inertia; finer grids last.
    pub fn grids(&self, rows: &[Row], operator: &str, tau: f64) -> Vec<(f64, f64)> {
        let is_own = |row: &&Row| {
            let run = &row.parameters;
            (run.flow, run.geometry.as_str()) == self.bed
                && run.operator == operator
                && run.tau == tau
                && run.collision == Preset::DHumieres
                // Velocities are kept to three digits.
                && (run.reynolds() / self.force - 1.0).abs() < 0.01
        };
        let own = rows.iter().filter(is_own);
        let mut grids: Vec<(f64, f64)> = own
            .filter_map(|row| Some((f64::from(row.parameters.cells), 1.0 + row.error?)))
            .collect();
        grids.sort_by(|a, b| a.0.total_cmp(&b.0));
        grids
    }

    /// What its grids lead to; `None` where an operator has fewer than two. Exact in creeping flow; by what the same
    /// grids are off there the others are corrected.
    pub fn yardstick(&self, rows: &[Row]) -> Option<Yardstick> {
        let slow = Level { force: CREEPING, taus: TAUS[0], ..*self };
        let of = |level: &Level| {
            Yardstick::of(&OPERATORS.map(|operator| level.grids(rows, operator, level.taus[0])))
        };
        let (own, off) = (of(self)?, of(&slow)?.mean);
        Some(Yardstick { mean: own.mean / off, ..own })
    }

    /// Cell Reynolds number `U dx/nu` on a grid of so many cells along the edge, where `reached` is the velocity over
    /// that without inertia.
    pub fn of_cell(&self, cells: f64, reached: f64) -> f64 {
        let (flow, geometry) = self.bed;
        let one = Parameters::new(flow, geometry, 1, 1.0, Preset::DHumieres);
        self.force * reached / (cells * one.cells_per_diameter().unwrap_or(f64::NAN))
    }
}

/// The force, as a Reynolds number, at which inertia takes less than 0.1 %.
const CREEPING: f64 = 1.0;

/// How figures and claims name the operators.
pub fn name(operator: &str) -> &'static str {
    match operator {
        BOUNCE_BACK => "SC1, non-equilibrium bounce-back",
        FULL => "SC3, full bounce-back",
        GRADED => "graded viscosity",
        _ => "unknown",
    }
}
