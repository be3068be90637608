//! The full form of the sphere in a stream: grids and widths extrapolated.

use crate::cases::twins::{twins_claim, without_twins};
use crate::cases::{CaseError, Claim, Stream, steadiness};
use psmrt::table::Table;
use psmrt_reference::collision::Preset;

/// What tells a run from all others.
const RUN: &[&str] = Stream::COLUMNS.split_at(6).0;

/// A Reynolds number whose box was varied.
pub struct Varied {
    /// Reynolds number, as the study spells it.
    pub reynolds: &'static str,
    /// Relaxation time.
    pub tau: &'static str,
    /// Cells per diameter in the boxes of other widths.
    pub cells: &'static str,
    /// C_D, all extrapolated, over that in open water: what is allowed, and why.
    pub end: ([f64; 2], &'static str),
    /// What the choice of the widths may change of that, and why.
    pub choice: (f64, &'static str),
}

/// Why the choice of the widths matters little where they lie on one power law.
const ONE_POWER: &str = "the widths lie on one power law (exponents 0.95, 2.1 to 2.2, 2.35 to 2.45 at Re 0.1, 10, 100 \
                         whichever are taken): 0.1 % was found, and twice that is allowed";

/// All of them.
pub const VARIED: [Varied; 4] = [
    Varied {
        reynolds: "0.1",
        tau: "0.7",
        cells: "4",
        end: (
            [0.97, 0.995],
            "boxes of up to 10 diameters are no wider than d/Re and see nothing of inertia, which is 1.72 % of the drag \
             in open water: 240/244.21 = 0.9828, not 1; 1.25 % to either side for the two extrapolations. The two claims \
             above allow more: 1 % of the drag in the box, 0.7 % of this, and 4 % of 1 - 1/K, 1.15 % of this",
        ),
        choice: (0.002, ONE_POWER),
    },
    Varied {
        reynolds: "1",
        tau: "0.7",
        cells: "4",
        end: (
            [0.98, 1.02],
            "what the box adds falls as 1/W in boxes narrower than d/Re and faster in wider ones, so only the four \
             widest, 8 to 16 diameters, are extrapolated. That choice makes most of what is allowed: without the widest \
             the result is 1.2 % less (claim below), with all seven 1.7 % less, with three 0.1 % more; the next coarser \
             pair of grids gives 0.3 % more",
        ),
        choice: (
            0.015,
            "these boxes, 6 to 16 diameters, are as wide as 6 to 16 d/Re: the exponent rises with the width (1.35 through all \
             seven, 1.75 through the widest three), and a power law \
             through four sees part of the bend. 1.2 % without the widest, 0.5 % with five; three quarters of \
             what the claim above allows, so that its closeness to 1 is in part luck",
        ),
    },
    Varied {
        reynolds: "10",
        tau: "0.6",
        cells: "4",
        end: (
            [0.98, 1.02],
            "computed to 0.1 %; the next coarser pair of grids gives 0.7 % more, spheres of 6 cells in the boxes of \
             other widths (three of them) 0.4 % less",
        ),
        choice: (0.002, ONE_POWER),
    },
    Varied {
        reynolds: "100",
        tau: "0.515",
        cells: "6",
        end: (
            [0.98, 1.03],
            "the boundary layer, d/sqrt(Re), has 1.6 cells at 16 cells per diameter: the drag falls faster than second \
             order takes into account, so that what is extrapolated is still too large, by less the finer the grids: 1.086 \
             from 6 and 8 cells, 1.021 from 8 and 12, 1.007 from 12 and 16",
        ),
        choice: (0.002, ONE_POWER),
    },
];

/// The rows of runs that became steady, with d'Humieres' rates; the oracle's where both engines made one.
pub fn steady(study: &Table) -> Result<Table, CaseError> {
    Ok(without_twins(study, RUN)
        .with(&[("outcome", "steady"), ("collision", Preset::DHumieres.word())])?)
}

/// Each Reynolds number's relaxation time on all grids.
pub const TAUS: [(&str, &str); 7] = [
    ("0.1", "0.7"),
    ("1", "0.7"),
    ("10", "0.6"),
    ("30", "0.54"),
    ("50", "0.53"),
    ("100", "0.515"),
    ("150", "0.51"),
];

/// The rows at the relaxation times of [`TAUS`].
pub fn main_taus(rows: &Table) -> Result<Table, CaseError> {
    let mut found = Table::default();
    for (reynolds, tau) in TAUS {
        found.append(rows.with(&[("Re", reynolds), ("tau", tau)])?);
    }
    Ok(found)
}

impl Varied {
    /// C_D against cells per diameter in the paper's box.
    pub fn grids(&self, study: &Table) -> Result<Vec<(f64, f64)>, CaseError> {
        grids(study, self.reynolds, self.tau)
    }

    /// C_D against the width of the box in diameters.
    pub fn widths(&self, study: &Table) -> Result<Vec<(f64, f64)>, CaseError> {
        let fixed = ("cells_per_diameter", self.cells);
        curve(study, (self.reynolds, self.tau), fixed, "width_d")
    }
}

/// C_D against cells per diameter in the paper's box.
pub fn grids(study: &Table, reynolds: &str, tau: &str) -> Result<Vec<(f64, f64)>, CaseError> {
    curve(study, (reynolds, tau), ("width_d", "5"), "cells_per_diameter")
}

/// C_D against cells per diameter in the paper's box, at the relaxation time of all grids of a Reynolds number. Errors if
/// there is no such number.
pub fn drag_by_grid(study: &Table, reynolds: &str) -> Result<Vec<(f64, f64)>, CaseError> {
    let of = TAUS.iter().find(|(re, _)| *re == reynolds);
    let (_, tau) = of.ok_or_else(|| CaseError::table(format!("study.csv: no Re {reynolds}")))?;
    grids(study, reynolds, tau)
}

/// C_D in open water where it is `drag` in the paper's box. Errors if the box was not varied at this Reynolds number.
pub fn in_open_water(study: &Table, reynolds: &str, drag: f64) -> Result<f64, CaseError> {
    let varied = VARIED.iter().find(|varied| varied.reynolds == reynolds);
    let blockage = varied.map(|varied| varied.widths(study)).transpose()?;
    let blockage = blockage.and_then(|widths| Blockage::of(&widths));
    let missing = || CaseError::table(format!("study.csv: no widths at Re {reynolds}"));
    Ok(blockage.ok_or_else(missing)?.taken_off(drag))
}

fn curve(
    study: &Table,
    (reynolds, tau): (&str, &str),
    fixed: (&str, &str),
    x: &str,
) -> Result<Vec<(f64, f64)>, CaseError> {
    let own = steady(study)?.with(&[("Re", reynolds), ("tau", tau), fixed])?;
    let mut points = own.points(x, "CD")?;
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(points)
}

/// What the finest two grids give at spacing 0 if the error is of second order.
pub fn without_grid(grids: &[(f64, f64)]) -> Option<f64> {
    let [.., coarse, fine] = grids else { return None };
    let ratio = (fine.0 / coarse.0).powi(2);
    Some((ratio * fine.1 - coarse.1) / (ratio - 1.0))
}

/// How C_D depends on the width `W` of the box, in diameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blockage {
    /// C_D in open water.
    pub open: f64,
    /// C_D in the paper's box, 5 diameters wide.
    pub paper: f64,
    /// Size and exponent of what the box adds.
    pub law: (f64, f64),
}

/// The boxes from which open water is extrapolated: the widest ones.
const WIDEST: usize = 4;

impl Blockage {
    /// The law `1/C_D = (1 - b W^-p)/C_open` that comes closest to the points of the widest boxes, by least
    /// squares for each of many exponents. For Re → 0 it is exact to leading order, with p = 1 (Hasimoto); a
    /// wake, whose disturbance is that of a source, has p = 2 to 3.
    pub fn of(widths: &[(f64, f64)]) -> Option<Self> {
        Self::of_widest(widths, WIDEST)
    }

    /// The same through another number of boxes.
    fn of_widest(widths: &[(f64, f64)], count: usize) -> Option<Self> {
        let paper = widths.iter().find(|point| point.0 == 5.0)?.1;
        let widest = widths.get(widths.len().checked_sub(count)?..)?;
        let n = widest.len() as f64;
        let fit = |p: f64| {
            let points: Vec<_> = widest.iter().map(|&(w, c)| (w.powf(-p), 1.0 / c)).collect();
            let [x, y] = [0, 1].map(|i| {
                points.iter().map(|q: &(f64, f64)| if i == 0 { q.0 } else { q.1 }).sum::<f64>() / n
            });
            let slope = points.iter().map(|q| (q.0 - x) * (q.1 - y)).sum::<f64>()
                / points.iter().map(|q| (q.0 - x).powi(2)).sum::<f64>();
            let start = y - slope * x;
            let off = points.iter().map(|q| (start + slope * q.0 - q.1).powi(2)).sum::<f64>();
            (off, Blockage { open: 1.0 / start, paper, law: (-slope / start, p) })
        };
        let exponents = (10..=80).map(|i| f64::from(i) / 20.0);
        exponents.map(fit).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, law)| law)
    }

    /// The laws that one could as well have taken: through three or five boxes, and without the widest.
    fn others(widths: &[(f64, f64)]) -> Vec<Self> {
        let without_widest = widths.split_last().map_or(widths, |(_, rest)| rest);
        let laws = [(widths, WIDEST - 1), (widths, WIDEST + 1), (without_widest, WIDEST)];
        laws.into_iter().filter_map(|(boxes, count)| Self::of_widest(boxes, count)).collect()
    }

    /// C_D in a box `width` diameters wide over that in open water, for the spheres it was found with.
    pub fn at(&self, width: f64) -> f64 {
        1.0 / (1.0 - self.law.0 * width.powf(-self.law.1))
    }

    /// `1/C_D` in open water less that in the paper's box. The box slows the stream at the sphere by what its
    /// images make, which goes with the force: so this does not depend on how well the sphere is resolved.
    pub fn inverse(&self) -> f64 {
        1.0 / self.open - 1.0 / self.paper
    }

    /// C_D in open water where it is `found` in the paper's box.
    pub fn taken_off(&self, found: f64) -> f64 {
        1.0 / (1.0 / found + self.inverse())
    }
}

/// The claims of the study: `duct` is K for Re → 0 in the box, `open` C_D in open water.
pub fn claims(
    study: &Table,
    duct: f64,
    open: impl Fn(&str) -> Result<f64, CaseError>,
) -> Result<Vec<Claim>, CaseError> {
    let missing = |what: &str| CaseError::table(format!("study.csv lacks {what}"));
    let mut claims = vec![twins_claim(study, RUN, "CD")?, steadiness::of_study(study)?];
    for varied in VARIED {
        let reynolds = varied.reynolds;
        let grids = varied.grids(study)?;
        let found = without_grid(&grids).ok_or_else(|| missing("grids"))?;
        let cells = grids.last().map_or(0.0, |grid| grid.0);
        let widths = varied.widths(study)?;
        let blockage = Blockage::of(&widths).ok_or_else(|| missing("widths"))?;
        let re: f64 = reynolds.parse().unwrap_or(f64::NAN);
        if re < 0.5 {
            claims.push(Claim {
                what: format!("study: Re {reynolds}, grids up to {cells} cells, extrapolated: drag over the exact one of this box"),
                // C_D = 24 K/Re
                measured: found * re / 24.0 / duct,
                allowed: 0.99..=1.01,
                why: "exact for Re -> 0, and inertia adds below 0.1 % at Re = 0.1 in so narrow a box; second-order \
                      extrapolation leaves an error of higher order: from 8 and 12 cells 0.4 %, a sixth of the error at 8",
            });
            claims.push(Claim {
                what: format!("study: Re {reynolds}: what the box takes off 1/K, by its widths, over the exact value"),
                measured: blockage.inverse() * 24.0 / re / (1.0 - 1.0 / duct),
                allowed: 0.96..=1.04,
                why: "exact: 1 - 1/K, as K is 1 in open water for Re -> 0; extrapolated as a power from widths of \
                      5 to 10 diameters, at 4 cells per diameter, whose own drag is 12 % low",
            });
        }
        let (allowed, why) = varied.end;
        let end = blockage.taken_off(found);
        claims.push(Claim {
            what: format!("study: Re {reynolds}, grids up to {cells} cells and widths extrapolated: C_D over that in open water"),
            measured: end / open(reynolds)?,
            allowed: allowed[0]..=allowed[1],
            why,
        });
        let others = Blockage::others(&widths).into_iter().map(|law| law.taken_off(found) / end);
        let (most, why) = varied.choice;
        claims.push(Claim {
            what: format!(
                "study: Re {reynolds}: the most that other widths (three or five of them, or without the widest) change of that"
            ),
            measured: others.map(|ratio| (ratio - 1.0).abs()).fold(f64::NAN, f64::max),
            allowed: 0.0..=most,
            why,
        });
    }
    Ok(claims)
}
