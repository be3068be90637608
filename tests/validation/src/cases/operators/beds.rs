//! Regular and random beds: creeping in full, and at Reynolds numbers up to 100.

use std::path::Path;

use psmrt_reference::collision::Preset;

use super::set::Set;
use super::{OPERATORS, WEIGHTS};
use crate::cases::CaseError;
use crate::tradeoff::measure::Runner;
use crate::tradeoff::parameters::{Flow, Parameters};
use crate::tradeoff::record::SweepLog;
use crate::tradeoff::row::Row;

/// A bed in which inertia counts.
pub struct Bed {
    /// The flow, and the solid fraction as the literature spells it.
    pub problem: (Flow, &'static str),
    /// Reynolds numbers `U d/nu` that the force would drive without inertia.
    pub forces: &'static [f64],
    /// Cells along the edge: the first two at all relaxation times, the others at the first alone.
    pub grids: &'static [u32],
}

/// All of them.
pub const BEDS: [Bed; 3] = [
    Bed {
        problem: (Flow::Fcc, "0.6"),
        forces: &[1.0, 12.0, 45.0, 250.0],
        grids: &[16, 24, 32, 48],
    },
    Bed { problem: (Flow::Sc, "0.343"), forces: &[1.0, 12.0], grids: &[12, 16, 24] },
    Bed { problem: (Flow::Random, "0.45"), forces: &[1.0, 12.0], grids: &[16, 24] },
];

/// Relaxation times at each of the forces.
pub const TAUS: [[f64; 3]; 4] =
    [[0.55, 0.6, 1.0], [0.55, 0.52, 0.6], [0.51, 0.505, 0.52], [0.505, 0.503, 0.51]];

pub(super) const AT_REYNOLDS: Set = Set {
    name: "beds",
    about: &[
        "Beds with each operator where inertia counts. Columns as in golden/tradeoff/operators.csv; lattice_velocity: what",
        "the force would drive without inertia, so that lattice_velocity (1 + error) is the superficial velocity that was",
        "reached, and error no error but what inertia takes.",
    ],
    make: |golden, file, tell| runs(&AT_REYNOLDS, at_reynolds(), golden, file, tell),
};

pub(super) const CREEPING: Set = Set {
    name: "arrays",
    about: &[
        "Creeping flow through regular arrays with each operator, and several grids of two of them. Columns as in",
        "golden/tradeoff/operators.csv: error of the superficial velocity under a given force, against the computed drag",
        "(golden/sphere_arrays/literature.csv).",
    ],
    make: |golden, file, tell| runs(&CREEPING, creeping(), golden, file, tell),
};

fn runs(
    set: &Set,
    wanted: Vec<Parameters>,
    golden: &Path,
    file: &Path,
    tell: &dyn Fn(&str),
) -> Result<(), CaseError> {
    let mut runner = Runner::new(golden, None)?;
    let mut log = SweepLog::open(file, &set.head())?;
    for parameters in wanted {
        if !log.holds(&parameters) {
            let row: Row = runner.measure(&parameters)?;
            tell(row.to_line().trim_end());
            log.add(row)?;
        }
    }
    Ok(())
}

/// The runs with each operator, on the CPU engine.
pub(super) fn with(
    (flow, geometry): (Flow, &str),
    cells: u32,
    tau: f64,
    collision: Preset,
) -> impl Iterator<Item = Parameters> {
    let one = Parameters::new(flow, geometry, cells, tau, collision);
    OPERATORS.into_iter().zip(WEIGHTS).map(move |(operator, weight)| Parameters {
        operator: operator.to_owned(),
        weight: weight.to_owned(),
        engine: "cpu".to_owned(),
        ..one.clone()
    })
}

/// Superficial velocity for a Reynolds number, to three digits.
fn velocity(run: &Parameters, reynolds: f64) -> f64 {
    let d = run.cells_per_diameter().unwrap_or(f64::NAN);
    let velocity = reynolds * (run.tau - 0.5) / 3.0 / d;
    format!("{velocity:.2e}").parse().unwrap_or(velocity)
}

fn at_reynolds() -> Vec<Parameters> {
    let mut runs = Vec::new();
    for Bed { problem, forces, grids } in BEDS {
        for (level, &cells) in grids.iter().enumerate() {
            for (taus, &force) in TAUS.iter().zip(forces) {
                let taus = if level < 2 { &taus[..] } else { &taus[..1] };
                let of_tau = |&tau| with(problem, cells, tau, Preset::DHumieres);
                let mut own: Vec<_> = taus.iter().flat_map(of_tau).collect();
                if level == 1 {
                    own.extend(with(problem, cells, taus[0], Preset::Srt));
                }
                own.iter_mut().for_each(|run| run.lattice_velocity = velocity(run, force));
                runs.extend(own);
            }
        }
    }
    runs
}

/// The fractions that each lattice can hold, of those that the literature has in steps of a tenth.
const FRACTIONS: [(Flow, &[&str]); 3] = [
    (Flow::Sc, &["0.1", "0.2", "0.3", "0.4", "0.5"]),
    (Flow::Bcc, &["0.1", "0.2", "0.3", "0.4", "0.5", "0.6"]),
    (Flow::Fcc, &["0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"]),
];

/// The arrays whose grids show the order.
pub const ORDERS: [(Flow, &str); 2] = [(Flow::Sc, "0.343"), (Flow::Fcc, "0.6")];

fn creeping() -> Vec<Parameters> {
    let mut runs = Vec::new();
    for cells in [16, 24] {
        for (flow, fractions) in FRACTIONS {
            for geometry in fractions {
                for tau in [0.55, 0.6, 1.0] {
                    runs.extend(with((flow, geometry), cells, tau, Preset::DHumieres));
                }
            }
        }
    }
    for cells in [12, 16, 24, 32, 48] {
        for bed in ORDERS {
            for tau in [0.6, 1.0] {
                runs.extend(with(bed, cells, tau, Preset::DHumieres));
            }
        }
    }
    runs
}
