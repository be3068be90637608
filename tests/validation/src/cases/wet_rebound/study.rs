//! The committed falls: what is claimed of them.

use super::fall::{Between, Liquid, WetRebound};
use super::{measured, measured_restitution};
use crate::cases::{Bench, CaseError, Claim};
use psmrt::table::Table;

/// Why restitutions may differ by 0.1.
pub const SCATTER: &str = "fixed before: measured restitutions scatter by about 0.1 round a common curve (Joseph et al., J. Fluid Mech. 433, \
     329 (2001); Gondret et al. 2002)";

/// Smallest gap over the radius. The measurements name no roughness; of 0.001, 0.003 and 0.01 the middle one is taken.
pub const SMALLEST: f64 = 3e-3;

/// What the falls of the study have alike, and that of which single values are changed.
pub const BASE: WetRebound = WetRebound {
    stokes: "27",
    cells: 12,
    between: Between::WhileApart,
    cutoff: 1.0,
    smallest: SMALLEST,
    contact: 20.0,
    shaft: [3, 7, 4],
    after: 2.0,
};

/// The falls that are held to measurements: at the Stokes numbers of literature.csv, and what of the bounce they take.
pub const MAIN: [WetRebound; 4] = [
    WetRebound { cells: 16, after: 4.5, ..BASE },
    WetRebound { stokes: "100", cells: 16, ..BASE },
    WetRebound { stokes: "152", cells: 16, after: 18.0, ..BASE },
    WetRebound { stokes: "742", cells: 16, ..BASE },
];

/// The base and what differs from it: how a restitution depends on each value.
pub const TRADE: [(&str, WetRebound); 10] = [
    ("as it is", BASE),
    ("16 cells", MAIN[0]),
    ("8 cells", WetRebound { cells: 8, ..BASE }),
    ("contact of 10 steps", WetRebound { contact: 10.0, ..BASE }),
    ("contact of 40 steps", WetRebound { contact: 40.0, ..BASE }),
    ("cut-off of 2 cells", WetRebound { cutoff: 2.0, ..BASE }),
    ("roughness 0.001 a", WetRebound { smallest: 1e-3, ..BASE }),
    ("roughness 0.01 a", WetRebound { smallest: 1e-2, ..BASE }),
    ("no lubrication", WetRebound { between: Between::Nothing, ..BASE }),
    ("lubrication in contact", WetRebound { between: Between::Always, ..BASE }),
];

/// More of them, which are only shown.
pub const MORE: [WetRebound; 5] = [
    WetRebound { smallest: 1e-4, ..BASE },
    WetRebound { between: Between::Always, contact: 0.1, ..BASE },
    WetRebound { between: Between::Nothing, contact: 0.1, ..BASE },
    WetRebound { stokes: "152", between: Between::Nothing, ..BASE },
    WetRebound { stokes: "152", ..BASE },
];

/// Every so manieth row of a course is kept.
const KEPT: usize = 16;

impl WetRebound {
    /// Its row of the study, and the rows of its course. Errors if it cannot be run.
    pub fn rows(&self, bench: &mut Bench) -> Result<[String; 2], CaseError> {
        let literature = bench.literature(super::CASE.name, "literature.csv")?;
        let fall = self.run(bench, &literature)?;
        let start = self.start();
        let row = format!(
            "{start},{},{:.4},{:.2},{:.4},{:.4},{:.3}",
            bench.engine_name().word(),
            fall.incoming,
            fall.stokes,
            fall.restitution,
            fall.peak,
            fall.duration
        );
        let course = fall.course.iter().step_by(KEPT);
        let course =
            course.map(|[time, gap, velocity]| format!("{start},{time:.4},{gap:.4},{velocity:.4}"));
        Ok([row, course.collect::<Vec<_>>().join("\n")])
    }
}

/// The rows of a table of this fall.
pub fn of(table: &Table, fall: &WetRebound) -> Result<Table, CaseError> {
    let words = fall.start();
    let names = [
        "St",
        "cells_per_diameter",
        "lubrication",
        "cutoff_cells",
        "smallest_over_radius",
        "contact_steps",
    ];
    let wanted: Vec<_> = names.into_iter().zip(words.split(',')).collect();
    Ok(table.with(&wanted)?)
}

/// Restitution over the dry one.
pub fn restitution(study: &Table, fall: &WetRebound) -> Result<f64, CaseError> {
    Ok(of(study, fall)?.number("restitution")?)
}

/// The claims.
pub fn claims(study: &Table, literature: &Table, bounces: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for fall in MAIN {
        let (liquid, own) = (Liquid::of(literature, fall.stokes)?, of(study, &fall)?);
        let (name, found) = (format!("study: St {}", fall.stokes), own.number("restitution")?);
        let course = measured(bounces, &liquid, fall.stokes).unwrap_or_default();
        if course.is_empty() {
            let [legendre, critical] = liquid.fits;
            claims.push(Claim {
                what: format!("{name}: restitution over the dry one"),
                measured: found,
                allowed: legendre - 0.1..=critical + 0.1,
                why: "between the two fits, exp(-35/St) and 1 - 10/St, and 0.1 beyond for the scatter of the measurements",
            });
            continue;
        }
        let expected = measured_restitution(&course, &liquid);
        claims.push(Claim {
            what: format!("{name}: restitution over the dry one, less the measured {expected:.3}"),
            measured: found - expected,
            allowed: -0.1..=0.1,
            why: SCATTER,
        });
        let peak = first_peak(&course);
        let (of_height, of_time) = if fall.stokes == "27" { (0.45, 0.25) } else { (0.25, 0.15) };
        claims.push(Claim {
            what: format!(
                "{name}: height of the rebound over the measured {:.3} diameters",
                peak.1
            ),
            measured: own.number("peak")? / peak.1,
            allowed: 1.0 - of_height..=1.0 + of_height,
            why: "fixed before: 0.1 of the restitution, twice as much of the height",
        });
        claims.push(Claim {
            what: format!("{name}: time until the second contact over the measured"),
            measured: own.number("duration")? / second_contact(&course, peak.0),
            allowed: 1.0 - of_time..=1.0 + of_time,
            why: "fixed before: 0.1 of the restitution, as much of the time",
        });
    }
    claims.extend(trade_claims(study)?);
    Ok(claims)
}

/// Time and height of the first rebound of a measured course.
fn first_peak(course: &[(f64, f64)]) -> (f64, f64) {
    let after = course.iter().filter(|point| point.0 > 0.0);
    after.fold((f64::NAN, 0.0), |best, &point| if point.1 > best.1 { point } else { best })
}

/// Time at which a measured sphere touches again after `peak`: where the straight line through the last two points before that, or
/// the least gap, meets 0.
fn second_contact(course: &[(f64, f64)], peak: f64) -> f64 {
    let falling: Vec<_> = course.iter().filter(|point| point.0 >= peak).collect();
    let last = falling.windows(2).position(|pair| pair[1].1 >= pair[0].1 && pair[0].1 < 0.3);
    let last = last.map_or(falling.len() - 1, |row| row);
    let [.., (t0, h0), (t1, h1)] = falling[..last] else { return f64::NAN };
    t1 + h1 * (t1 - t0) / (h0 - h1)
}

/// Why a restitution changes with the roughness.
const BETWEEN_GAPS: &str = "lubrication takes ln(3)/St = 0.04 of U between the two gaps, to leading order, on each way: 0.09; twice as much at most";

/// Half the scatter of the measurements.
const HALF: f64 = 0.05;

fn trade_claims(study: &Table) -> Result<Vec<Claim>, CaseError> {
    let base = restitution(study, &BASE)?;
    let mut claims = Vec::new();
    for (what, fall) in TRADE.into_iter().skip(1) {
        let change = restitution(study, &fall)? - base;
        let (allowed, why) = match fall.between {
            Between::Nothing => (
                0.1..=1.0,
                "fixed before: lubrication counts by more than the scatter of the measurements",
            ),
            Between::Always => {
                (-1.0..=-0.1, "as much: a contact of 20 steps is not one for lubrication to act in")
            }
            Between::WhileApart if fall.smallest > BASE.smallest => (0.0..=0.2, BETWEEN_GAPS),
            Between::WhileApart if fall.smallest < BASE.smallest => (-0.2..=0.0, BETWEEN_GAPS),
            Between::WhileApart => {
                (-HALF..=HALF, "fixed before: half the scatter of the measurements")
            }
        };
        claims.push(Claim {
            what: format!("study: St 27, 12 cells: change of the restitution with {what}"),
            measured: change,
            allowed,
            why,
        });
    }
    Ok(claims)
}

/// All falls of the study, the shortest first.
pub fn wet_rebounds() -> Vec<WetRebound> {
    let mut falls: Vec<_> = TRADE.into_iter().map(|(_, fall)| fall).chain(MORE).collect();
    falls.extend(MAIN);
    let cost = |fall: &WetRebound| f64::from(fall.cells).powi(4) * (5.0 + fall.after);
    falls.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    falls
}
