//! How fast a bed's flow may be: the first velocity at which the guard stops it.

use std::path::Path;

use psmrt_reference::collision::Preset;

use super::beds::with;
use super::set::Set;
use crate::cases::CaseError;
use crate::tradeoff::measure::Runner;
use crate::tradeoff::parameters::Flow;
use crate::tradeoff::record::SweepLog;

/// The bed, and cells along its edge.
const BED: (Flow, &str, u32) = (Flow::Fcc, "0.6", 16);

/// Relaxation times where inertia is reached.
const TAUS: [f64; 5] = [0.501, 0.505, 0.51, 0.52, 0.55];

/// Superficial velocities that the force would drive without inertia.
const VELOCITIES: [f64; 16] = [
    0.01, 0.015, 0.022, 0.033, 0.05, 0.075, 0.11, 0.17, 0.25, 0.38, 0.57, 0.85, 1.3, 1.9, 2.9, 4.3,
];

pub(super) const SET: Set = Set {
    name: "limits",
    about: &[
        "A face-centred cubic array of solid fraction 0.6, 10.5 cells per diameter, with each operator and a force that rises until",
        "the guard stops the run (faster than 0.5 cells per step, or worse): the last row of each series. Columns as in",
        "golden/tradeoff/operators.csv; lattice_velocity (1 + error) is the superficial velocity that was reached.",
    ],
    make,
};

/// What the end of a run that the guard has stopped begins with.
pub const BROKEN: &str = "broken";

fn make(golden: &Path, file: &Path, tell: &dyn Fn(&str)) -> Result<(), CaseError> {
    let mut runner = Runner::new(golden, None)?;
    let mut log = SweepLog::open(file, &SET.head())?;
    let (flow, geometry, cells) = BED;
    for tau in TAUS {
        for collision in [Preset::DHumieres, Preset::Srt] {
            for mut run in with((flow, geometry), cells, tau, collision) {
                for velocity in VELOCITIES {
                    run.lattice_velocity = velocity;
                    if !log.holds(&run) {
                        let row = runner.measure(&run)?;
                        tell(row.to_line().trim_end());
                        log.add(row)?;
                    }
                    let made = log.rows.iter().find(|row| row.parameters == run);
                    if made.is_some_and(|row| row.end.starts_with(BROKEN)) {
                        break;
                    }
                }
            }
        }
    }
    Ok(())
}
