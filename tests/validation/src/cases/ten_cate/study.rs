//! The committed falls of ten Cate's sphere: what is claimed of each column of study.csv.

use std::ops::RangeInclusive;

use super::EXPERIMENTS;
use crate::cases::sphere_drag::study::without_grid;
use crate::cases::{CaseError, Claim};
use psmrt::table::Table;

/// Why velocities may differ by so much on the way down.
pub const VELOCITY: &str =
    "0.02 for the digitising and 0.03 for the largest velocity, as the claim on that allows";

/// The experiment on which no code agrees with the measurement.
const SLOWEST: &str = "E1";

/// The experiment whose grids differ too little, by 0.5 % in all, for an order.
pub const WITHOUT_ORDER: &str = "E4";

/// Diameter, m.
const SI_DIAMETER: f64 = 0.015;

/// Published ratios of one experiment.
struct Published {
    /// Largest velocity measured, m/s.
    si_largest: f64,
    /// Error of the largest velocity that ten Cate et al. computed themselves.
    theirs: f64,
}

impl Published {
    fn of(published: &Table, case: &str) -> Result<Self, CaseError> {
        let own = published.with(&[("case", case)])?;
        let theirs = own.number("umax_LBM_over_uinf")? / own.number("umax_exp_over_uinf")? - 1.0;
        Ok(Published { si_largest: own.number("umax_exp_m_s")?, theirs })
    }
}

/// The value farthest from 0.
fn worst(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NAN, |a, b| if b.abs() <= a.abs() { a } else { b })
}

/// Order and limit of `error = limit + c cells^-order` through three grids.
pub fn order_and_limit(grids: &[(f64, f64)]) -> Option<(f64, f64)> {
    let &[a, b, c] = grids else { return None };
    let wanted = (a.1 - b.1) / (b.1 - c.1);
    // Grows with the order.
    let ratio = |p: f64| (a.0.powf(-p) - b.0.powf(-p)) / (b.0.powf(-p) - c.0.powf(-p));
    let (mut low, mut high) = (0.01, 8.0);
    if !(ratio(low)..ratio(high)).contains(&wanted) {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if ratio(middle) < wanted { low = middle } else { high = middle }
    }
    let size = (b.1 - c.1) / (b.0.powf(-low) - c.0.powf(-low));
    Some((low, c.1 - size * c.0.powf(-low)))
}

/// The claims: `published` is literature.csv.
pub fn claims(study: &Table, published: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for (case, reynolds) in EXPERIMENTS {
        let own = study.with(&[("case", case)])?;
        let published = Published::of(published, case)?;
        claims.extend(largest_claims(&own, case, reynolds, &published)?);
        claims.extend(course_claims(&own, case, published.si_largest)?);
    }
    Ok(claims)
}

/// What is claimed of the largest velocity of one experiment.
fn largest_claims(
    own: &Table,
    case: &str,
    reynolds: &str,
    published: &Published,
) -> Result<Vec<Claim>, CaseError> {
    let slowest = case == SLOWEST;
    let errors = own.points("cells_per_diameter", "error_of_largest")?;
    let mut claims = Vec::new();
    for (cells, error) in &errors {
        let what =
            format!("study: {case} (Re {reynolds}), {cells} cells: error of the largest velocity");
        claims.push(if slowest {
            Claim {
                what,
                measured: *error,
                allowed: published.theirs..=0.03,
                why: "not an agreement with the measurement: finer grids go away from it, towards ten Cate's own computation, \
                      5.6 % below it, which is the lower bound; 0.03 above, as in the other oils",
            }
        } else {
            Claim {
                what,
                measured: *error,
                allowed: -0.03..=0.03,
                why: "the peaks of the digitised curves lie 0.1 to 4.2 % above the published largest velocities, so these are \
                      known to about 2 %; the drag of a sphere of 8 cells at these relaxation times is within 3 %, and \
                      the velocity goes with a power of it of 1 at most: together, by squares, 3.6 %",
            }
        });
    }
    let limit = without_grid(&errors).unwrap_or(f64::NAN);
    claims.push(if slowest {
        Claim {
            what: format!("study: {case}, 12 and 16 cells extrapolated: error of the largest velocity, against ten Cate's own computation"),
            measured: limit,
            allowed: published.theirs - 0.02..=published.theirs + 0.02,
            why: "two lattice Boltzmann codes share this disagreement with the measurement; ours does not resolve it. Expected \
                  is their -5.6 %, on one grid, whose drag is known to some percent. At this Re the velocity goes nearly \
                  with 1/viscosity, so that an oil 5 % thinner than stated would do",
        }
    } else {
        Claim {
            what: format!("study: {case}, 12 and 16 cells extrapolated: error of the largest velocity"),
            measured: limit,
            allowed: -0.02..=0.02,
            why: "measured to about 2 % (peaks of the same curves as digitised); the grid's share is taken off",
        }
    });
    if case != WITHOUT_ORDER {
        claims.push(Claim {
            what: format!("study: {case}: order in which the largest velocity converges, 8, 12 and 16 cells"),
            measured: order_and_limit(&errors).map_or(f64::NAN, |found| found.0),
            allowed: 1.7..=2.3,
            why: "second order, as the drag of spheres (tests/oracle/sphere_arrays.rs, 0.3 either way as there); errors are kept to \
                  1e-4, of 23e-4 or more between the finest grids: 0.1 of the order",
        });
    }
    Ok(claims)
}

/// What is claimed of the course of one experiment's falls.
fn course_claims(own: &Table, case: &str, si_largest: f64) -> Result<Vec<Claim>, CaseError> {
    let slowest = case == SLOWEST;
    let delays: Vec<f64> =
        own.numbers("delay_s")?.iter().map(|delay| delay * si_largest / SI_DIAMETER).collect();
    let columns: [(&str, Vec<f64>, RangeInclusive<f64>, &'static str); 5] = [
        (
            "velocity above a gap of one diameter, rms of the difference over the largest",
            own.numbers("velocity_rms")?,
            0.0..=if slowest { 0.06 } else { 0.05 },
            if slowest {
                "the measured sphere starts 0.03 to 0.04 s late by this clock: 0.044 by itself, since with that shift the \
                 0.049 at 8 cells become 0.021; on finer grids the lower largest velocity besides, 0.037 (claims \
                 above): together, by squares, 0.058"
            } else {
                VELOCITY
            },
        ),
        (
            "gap less the measured one there, mean, diameters",
            own.numbers("gap_offset")?,
            -0.4..=0.0,
            "an offset of the measured curves: their first gaps are 8.13 to 8.18 where 8 was set (the data's own note), the \
             computed sphere's 8: 0.15; digitising 0.05; a velocity that errs by 0.03 over the mean fall of 3.5 \
             diameters 0.1; the late start at Re 1.5, 0.04 s, 0.1. All of one sign: the measured sphere lags",
        ),
        (
            "what is left of that without its mean, rms, diameters",
            own.numbers("gap_rms")?,
            0.0..=0.11,
            "digitising 0.05; a velocity that errs by 0.03 over a fall of 7 diameters has an rms of 0.06 about its mean",
        ),
        (
            "how much later the measured sphere brakes, diameters at the largest velocity",
            delays,
            0.0..=0.5,
            "the lag of the gap (0.4, claim above), seen at the bottom, where a velocity that errs by 0.03 has made 0.1 more of \
             it than on average. 0.03 to 0.18 s; at Re 1.5 it halves from 8 to 16 cells because the sphere becomes \
             slower, which the measured one is not",
        ),
        (
            "velocity at the bottom, rms of the difference over the largest",
            own.numbers("braking_rms")?,
            0.0..=0.05,
            "after that shift in time; digitised to 0.02, and a place digitised to 0.05 diameters is 0.05 of the velocity \
             where this falls to nothing within a diameter",
        ),
    ];
    let grids = own.values("cells_per_diameter")?.join(", ");
    let claim = |(what, values, allowed, why): (&str, Vec<f64>, _, _)| Claim {
        what: format!("study: {case}, {grids} cells, the worst: {what}"),
        measured: worst(&values),
        allowed,
        why,
    };
    Ok(columns.into_iter().map(claim).collect())
}
