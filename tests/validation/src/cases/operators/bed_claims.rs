//! What is claimed of beds and arrays.

use psmrt_reference::collision::Preset;
use psmrt_report::PowerLaw;

use super::beds::ORDERS;
use super::yardstick::levels;
use super::{BOUNCE_BACK, GRADED};
use crate::cases::{CaseError, Claim};
use crate::tradeoff::operators::drag_error;
use crate::tradeoff::row::Row;

/// What graded viscosity may be worse by than the paper's operator.
pub const TAIL: f64 = 0.015;

/// Why.
pub const TAIL_WHY: &str = "its drag in cut cells adds an error of first order, 1 to 1.5 % of the drag in creeping flow \
                        (golden/tradeoff/operators.csv); where the paper's own error happens to be small it may be worse by that";

/// The largest of some values; NaN of none.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(f64::NAN, f64::max)
}

/// A run of graded viscosity in a bed: cells per diameter, `U dx/nu`, the size of its error and of that with the paper's operator.
struct Pair {
    reynolds: f64,
    of_cell: f64,
    graded: f64,
    usual: f64,
}

fn pairs(rows: &[Row]) -> Vec<Pair> {
    let mut found = Vec::new();
    for level in levels() {
        let Some(end) = level.yardstick(rows) else { continue };
        for tau in level.taus {
            let errors = |operator| {
                let grids = level.grids(rows, operator, tau).into_iter();
                grids.map(move |(cells, v)| (cells, (end.mean / v - 1.0).abs()))
            };
            for (cells, graded) in errors(GRADED) {
                if let Some((_, usual)) = errors(BOUNCE_BACK).find(|usual| usual.0 == cells) {
                    let (reynolds, of_cell) =
                        (level.force * end.mean, level.of_cell(cells, end.mean));
                    found.push(Pair { reynolds, of_cell, graded, usual });
                }
            }
        }
    }
    found
}

/// Solid fraction of the densest array; spheres touch at 0.74.
const DENSEST: &str = "0.7";

/// Cell Reynolds number up to which graded viscosity is the better one.
const SLOW: f64 = 2.0;

/// Where inertia counts.
pub fn of_beds(rows: &[Row]) -> Vec<Claim> {
    let all = pairs(rows);
    let slow = || all.iter().filter(|pair| pair.of_cell <= SLOW);
    let fast = all.iter().filter(|pair| pair.of_cell > SLOW && pair.reynolds > 20.0);
    vec![
        Claim {
            what: format!(
                "beds at Re 1 to 130, runs of graded viscosity with U dx/nu up to {SLOW} ({}): size of the drag's error less \
                 that with the paper's, at most",
                slow().count()
            ),
            measured: largest(slow().map(|pair| pair.graded - pair.usual)),
            allowed: -1.0..=TAIL,
            why: TAIL_WHY,
        },
        Claim {
            what: "the same where U dx/nu is larger: graded viscosity is the worse one, by at most"
                .to_owned(),
            measured: largest(fast.map(|pair| pair.graded - pair.usual)),
            allowed: 0.0..=0.15,
            why: "cut cells hold the fluid by their viscosity alone, nu/(1 - epsilon), and let it in where the flow through a \
                  cell is fast: grains seem up to half a cell smaller, 12 % of the drag at 10.5 cells. That this is so is no \
                  aim but a finding; 0.15 when the table had been seen",
        },
    ]
}

/// Relaxation times at which graded viscosity bears as much as the paper's operator.
const BORNE: f64 = 0.505;

/// How fast the flow may be.
pub fn of_limits(rows: &[Row]) -> Claim {
    let reached = |operator: &str, tau: f64| {
        let own = rows.iter().filter(|row| {
            let run = &row.parameters;
            run.operator == operator && run.tau == tau && run.collision == Preset::DHumieres
        });
        let lived =
            own.filter_map(|row| Some(row.parameters.lattice_velocity * (1.0 + row.error?)));
        lived.fold(0.0, f64::max)
    };
    let mut taus: Vec<f64> = rows.iter().map(|row| row.parameters.tau).collect();
    taus.retain(|tau| *tau >= BORNE);
    let ratios = taus.into_iter().map(|tau| reached(GRADED, tau) / reached(BOUNCE_BACK, tau));
    Claim {
        what: format!(
            "face-centred cubic at 0.6, a force that rises by half each time, tau {BORNE} to 0.55: largest velocity that graded \
             viscosity survives over that of the paper's, least"
        ),
        measured: ratios.fold(f64::INFINITY, f64::min),
        allowed: 0.65..=1.5,
        why: "the same force or the one before, which is two thirds of it. Nearer to 1/2 graded viscosity bears less: a third of \
              the velocity at 0.501 (case stability)",
    }
}

/// In creeping flow.
pub fn of_arrays(rows: &[Row]) -> Result<Vec<Claim>, CaseError> {
    let of =
        |operator: &'static str| rows.iter().filter(move |r| r.parameters.operator == operator);
    let is_enough = |row: &&Row| row.parameters.cells_per_diameter() >= Some(8.0);
    let size = |row: &Row| drag_error(row).map(f64::abs);
    let in_densest = |row: &&Row| row.parameters.geometry == DENSEST;
    let graded = || of(GRADED).filter(is_enough);
    let worse = graded().filter_map(|row| {
        let run = &row.parameters;
        let usual = of(BOUNCE_BACK).find(|usual| {
            let other = &usual.parameters;
            (other.flow, &other.geometry, other.cells) == (run.flow, &run.geometry, run.cells)
                && other.tau == run.tau
        });
        Some(size(row)? - size(usual?)?)
    });
    let mut claims = vec![
        Claim {
            what: "creeping flow through SC, BCC and FCC at 0.1 to 0.6, 8 and more cells per diameter, tau 0.55 to 1: largest \
                   error of the drag with graded viscosity"
                .to_owned(),
            measured: largest(graded().filter(|row| !in_densest(row)).filter_map(size)),
            allowed: 0.0..=0.07,
            why: "what `psmrt check` says of it",
        },
        Claim {
            what: "the same of FCC at 0.7, where spheres nearly touch".to_owned(),
            measured: largest(graded().filter(in_densest).filter_map(size)),
            allowed: 0.0..=0.12,
            why: "a finding, no aim: the gaps at 11 cells per diameter have less than a cell. The paper's operator is 32 to 65 % off",
        },
        Claim {
            what: "all of these: size of the drag's error with graded viscosity less that with the paper's, at most".to_owned(),
            measured: largest(worse),
            allowed: -1.0..=TAIL,
            why: TAIL_WHY,
        },
    ];
    for (flow, geometry) in ORDERS {
        let order = |operator, least: u32| {
            let own = of(operator).filter(|row| {
                let run = &row.parameters;
                let is_own = run.flow == flow && run.geometry == geometry && run.tau == 1.0;
                is_own && run.collision == Preset::DHumieres && run.cells >= least
            });
            let point = |row: &Row| Some((row.parameters.cells_per_diameter()?, row.error?.abs()));
            let points: Vec<(f64, f64)> = own.filter_map(point).collect();
            PowerLaw::fit(&points).map(|law| -law.order)
        };
        let name = format!("creeping flow, {} {geometry}, tau 1", flow.word().to_uppercase());
        claims.push(Claim {
            what: format!("{name}, 16 to 48 cells along the edge: order of the velocity's error with the paper's"),
            measured: order(BOUNCE_BACK, 16)?,
            allowed: 1.7..=2.5,
            why: "second order, by the leak (tests/oracle/sphere_arrays.rs, 0.3 either way as there); walls that lie 0.012 of a \
                  cell in the fluid at this tau (golden/ps_channel_wall), an error of first order and of the other sign, \
                  make it look 0.2 higher",
        });
        let left = of(GRADED).filter(|row| {
            let run = &row.parameters;
            (run.flow, run.geometry.as_str()) == (flow, geometry)
                && run.cells >= 24
                && run.tau == 1.0
        });
        claims.push(Claim {
            what: format!("{name}, 24 to 48 cells: largest error of the drag with graded viscosity"),
            measured: largest(left.filter_map(size)),
            allowed: 0.0..=0.03,
            why: "a finding: it does not fall at second order, since walls up to 0.06 cells in the fluid \
                  (golden/ps_channel_wall/graded.csv) are an error of first order, and it scatters with how surfaces cut the cells",
        });
    }
    Ok(claims)
}
