//! Numbers that an independent source knows, and what psmrt finds for them on committed grids: for the page's first table
//! ([`front`]), and for how far psmrt is off, quantity by quantity ([`agreement`]).
//!
//! | file | numbers |
//! |---|---|
//! | `fixed.rs` | drag of fixed spheres, resistance of beds, flow in a duct |
//! | `moving.rs` | settling, torque, viscosity of a suspension, rebound, fluidization |

pub mod agreement;
mod fixed;
pub mod front;
mod moving;

use std::path::Path;

use crate::cases::CaseError;
use psmrt::table::Table;

/// What a number is a kind of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Velocity in a duct under a given force.
    Duct,
    /// Drag of fixed spheres, alone or in arrays.
    Drag,
    /// Resistance of random beds, one over their permeability.
    Resistance,
    /// Torque on a sphere that turns.
    Torque,
    /// Velocity of grains that settle.
    Settling,
    /// Velocity at which water lifts a bed.
    Fluidization,
    /// What spheres add to the viscosity of a suspension.
    Viscosity,
    /// Velocity after an impact in a liquid over that before.
    Rebound,
}

impl Quantity {
    /// All of them, in the order in which they are shown.
    pub const ALL: [Quantity; 8] = [
        Quantity::Duct,
        Quantity::Drag,
        Quantity::Resistance,
        Quantity::Torque,
        Quantity::Settling,
        Quantity::Fluidization,
        Quantity::Viscosity,
        Quantity::Rebound,
    ];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Quantity::Duct => "velocity in a duct",
            Quantity::Drag => "drag of spheres",
            Quantity::Resistance => "resistance of beds",
            Quantity::Torque => "torque",
            Quantity::Settling => "settling velocity",
            Quantity::Fluidization => "fluidization velocity",
            Quantity::Viscosity => "viscosity",
            Quantity::Rebound => "rebound",
        }
    }

    /// In one word, for an axis.
    pub fn word(self) -> &'static str {
        match self {
            Quantity::Duct => "duct",
            Quantity::Drag => "drag",
            Quantity::Resistance => "beds",
            Quantity::Torque => "torque",
            Quantity::Settling => "settling",
            Quantity::Fluidization => "lifting",
            Quantity::Viscosity => "viscosity",
            Quantity::Rebound => "rebound",
        }
    }
}

/// One number: what it should be, and psmrt's value on grids from coarse to fine.
#[derive(Clone, Debug)]
pub struct Number {
    /// What kind of number.
    pub kind: Quantity,
    /// Of which flow.
    pub of: String,
    /// The case that it is from: its place on the page.
    pub case: &'static str,
    /// Where the reference comes from.
    pub source: &'static str,
    /// What it should be.
    pub reference: f64,
    /// Relative uncertainty of the reference; 0 where it is exact.
    pub uncertainty: f64,
    /// Cells (across a grain, a duct or the cube of an array) and value, from coarse to fine.
    pub grids: Vec<(f64, f64)>,
    /// What the page's first table calls it, if it is there.
    pub on_front: Option<&'static str>,
}

impl Number {
    /// One whose grids may be in any order, and given twice.
    fn with_grids(mut self, mut grids: Vec<(f64, f64)>) -> Self {
        // Tables grow run by run.
        grids.sort_by(|a, b| a.0.total_cmp(&b.0));
        grids.dedup();
        self.grids = grids;
        self
    }

    /// Cells and value of the finest grid.
    pub fn finest(&self) -> (f64, f64) {
        self.grids.last().copied().unwrap_or((f64::NAN, f64::NAN))
    }

    /// What psmrt finds on the finest grid over the reference.
    pub fn ratio(&self) -> f64 {
        self.finest().1 / self.reference
    }
}

/// All of them, from the committed tables of `golden`. Errors if one of these lacks what is needed.
pub fn numbers(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let mut all = fixed::numbers(golden)?;
    all.extend(moving::numbers(golden)?);
    Ok(all)
}

/// The collision of all numbers.
const COLLISION: &str = "MRT_dHumieres";

/// The relaxation time at which fixed and falling grains are compared.
const TAU: &str = "0.6";

fn table(golden: &Path, file: &str) -> Result<Table, CaseError> {
    Ok(Table::read(&golden.join(file))?)
}

/// The rows of `tradeoff/operators.csv` with an operator, at the common relaxation time, and exact solid fractions.
fn of_operator(golden: &Path, operator: &str) -> Result<Table, CaseError> {
    let rows = table(golden, "tradeoff/operators.csv")?.with(&[
        ("tau", TAU),
        ("collision", COLLISION),
        ("operator", operator),
        ("coverage", "exact"),
    ])?;
    Ok(rows)
}
