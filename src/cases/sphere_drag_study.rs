//! The full form of the sphere in a stream: grids and widths extrapolated.

use super::{CaseError, Claim, Table};

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
}

/// All of them.
pub const VARIED: [Varied; 4] = [
    Varied {
        reynolds: "0.1",
        tau: "0.7",
        cells: "4",
        end: (
            [0.965, 1.0],
            "boxes of up to 10 diameters are narrower than d/Re and see nothing of inertia, which is 1.75 % of the \
             drag in open water; 1.5 % more for the two extrapolations",
        ),
    },
    Varied {
        reynolds: "1",
        tau: "0.7",
        cells: "4",
        end: (
            [0.92, 1.03],
            "here what the box adds changes from 1/W to 1/W2 at the very widths that were computed (d/Re is one \
             diameter, and its effect is felt to ten): one power of W takes off up to 6 % too much",
        ),
    },
    Varied {
        reynolds: "10",
        tau: "0.6",
        cells: "4",
        end: ([0.97, 1.03], "computed to 0.1 %; two extrapolations of 1 to 2 % each"),
    },
    Varied {
        reynolds: "100",
        tau: "0.515",
        cells: "6",
        end: (
            [0.97, 1.12],
            "the boundary layer, d/sqrt(Re), has 0.8 of a cell on the finest grid here: the drag is still too large, \
             and falls faster than second order takes into account",
        ),
    },
];

/// The rows of runs that became steady, with d'Humieres' rates.
pub fn steady(study: &Table) -> Result<Table, CaseError> {
    study.with(&[("outcome", "steady"), ("collision", "mrt")])
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
        self.curve(study, ("width_d", "5"), "cells_per_diameter")
    }

    /// C_D against the width of the box in diameters.
    pub fn widths(&self, study: &Table) -> Result<Vec<(f64, f64)>, CaseError> {
        self.curve(study, ("cells_per_diameter", self.cells), "width_d")
    }

    fn curve(
        &self,
        study: &Table,
        fixed: (&str, &str),
        x: &str,
    ) -> Result<Vec<(f64, f64)>, CaseError> {
        let own = steady(study)?.with(&[("Re", self.reynolds), ("tau", self.tau), fixed])?;
        let mut points = own.points(x, "CD")?;
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(points)
    }
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
    /// Size and exponent of what the box adds.
    pub law: (f64, f64),
}

impl Blockage {
    /// The law `1/C_D = (1 - b W^-p)/C_open` that comes closest to the points, by least squares for each of
    /// many exponents. For Re → 0 it is exact to leading order, with p = 1 (Hasimoto); a wake, whose
    /// disturbance is that of a source, has p = 2 to 3.
    pub fn of(widths: &[(f64, f64)]) -> Option<Self> {
        let n = widths.len() as f64;
        if widths.len() < 3 {
            return None;
        }
        let fit = |p: f64| {
            let points: Vec<_> = widths.iter().map(|&(w, c)| (w.powf(-p), 1.0 / c)).collect();
            let [x, y] = [0, 1].map(|i| {
                points.iter().map(|q: &(f64, f64)| if i == 0 { q.0 } else { q.1 }).sum::<f64>() / n
            });
            let slope = points.iter().map(|q| (q.0 - x) * (q.1 - y)).sum::<f64>()
                / points.iter().map(|q| (q.0 - x).powi(2)).sum::<f64>();
            let start = y - slope * x;
            let off = points.iter().map(|q| (start + slope * q.0 - q.1).powi(2)).sum::<f64>();
            (off, Blockage { open: 1.0 / start, law: (-slope / start, p) })
        };
        let exponents = (10..=80).map(|i| f64::from(i) / 20.0);
        exponents.map(fit).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, law)| law)
    }

    /// C_D in a box `width` diameters wide over that in open water, for the spheres it was found with.
    pub fn at(&self, width: f64) -> f64 {
        1.0 / (1.0 - self.law.0 * width.powf(-self.law.1))
    }

    /// `1/C_D` in open water less that in the box. The box slows the stream at the sphere by what its images
    /// make, which goes with the force: so this does not depend on how well the sphere itself is resolved.
    pub fn inverse(&self, width: f64) -> f64 {
        self.law.0 * width.powf(-self.law.1) / self.open
    }
}

/// The claims of the study: `duct` is K for Re → 0 in the box, `open` C_D in open water.
pub fn claims(
    study: &Table,
    duct: f64,
    open: impl Fn(&str) -> Result<f64, CaseError>,
) -> Result<Vec<Claim>, CaseError> {
    let missing = |what: &str| CaseError::Table(format!("study.csv lacks {what}"));
    let mut claims = Vec::new();
    for varied in VARIED {
        let reynolds = varied.reynolds;
        let grids = varied.grids(study)?;
        let found = without_grid(&grids).ok_or_else(|| missing("grids"))?;
        let cells = grids.last().map_or(0.0, |grid| grid.0);
        let blockage = Blockage::of(&varied.widths(study)?).ok_or_else(|| missing("widths"))?;
        let re: f64 = reynolds.parse().unwrap_or(f64::NAN);
        if re < 0.5 {
            claims.push(Claim {
                what: format!("study: Re {reynolds}, grids up to {cells} cells, extrapolated: drag over the exact one of this box"),
                // C_D = 24 K/Re
                measured: found * re / 24.0 / duct,
                allowed: 0.985..=1.015,
                why: "exact for Re -> 0, and inertia adds below 0.1 % at Re = 0.1 in so narrow a box; second-order \
                      extrapolation from 6 and 8 cells leaves 1 %, a sixth of the error at 6",
            });
            claims.push(Claim {
                what: format!("study: Re {reynolds}: what the box takes off 1/K, by its widths, over the exact value"),
                measured: blockage.inverse(5.0) * 24.0 / re / (1.0 - 1.0 / duct),
                allowed: 0.95..=1.05,
                why: "exact: 1 - 1/K, as K is 1 in open water for Re -> 0; extrapolated as a power from widths of \
                      4 to 10 diameters, at 4 cells per diameter",
            });
        }
        let (allowed, why) = varied.end;
        claims.push(Claim {
            what: format!("study: Re {reynolds}, grids up to {cells} cells and widths extrapolated: C_D over that in open water"),
            measured: 1.0 / (1.0 / found + blockage.inverse(5.0)) / open(reynolds)?,
            allowed: allowed[0]..=allowed[1],
            why,
        });
    }
    Ok(claims)
}
