//! The rest of the sphere's study: Reynolds numbers in the paper's box alone, and SRT beside MRT.

use psmrt_reference::collision::Preset;
use psmrt_report::PowerLaw;

use super::study::{Blockage, TAUS, VARIED, Varied, grids, steady, without_grid};
use crate::cases::{CaseError, Claim};
use psmrt::table::Table;

/// Those whose box was not varied.
const UNVARIED: [&str; 3] = ["30", "50", "150"];

/// The relaxation time of a Reynolds number.
fn tau_of(reynolds: &str) -> &'static str {
    TAUS.iter().find(|(re, _)| *re == reynolds).map_or("", |(_, tau)| tau)
}

/// What is learnt where the box was varied.
pub(super) struct Neighbours {
    /// Logarithm of the Reynolds number, and C_D in the paper's box over that in open water.
    boxed: [(f64, f64); 2],
    /// What extrapolated grids leave at Re = 100, relative, against the cells in the boundary layer, `d/sqrt(Re)`,
    /// on the finer of the two.
    left: PowerLaw,
}

impl Neighbours {
    /// Of the study; `open` is C_D in open water.
    pub fn of(
        study: &Table,
        open: impl Fn(&str) -> Result<f64, CaseError>,
    ) -> Result<Self, CaseError> {
        let missing = || CaseError::table("study.csv lacks the boxes of Re 10 or 100".to_owned());
        let varied = |reynolds: &str| -> Result<(&Varied, Blockage), CaseError> {
            let varied = VARIED.iter().find(|v| v.reynolds == reynolds).ok_or_else(missing)?;
            Ok((varied, Blockage::of(&varied.widths(study)?).ok_or_else(missing)?))
        };
        let share = |reynolds: &str| -> Result<f64, CaseError> {
            Ok(1.0 / (1.0 - open(reynolds)? * varied(reynolds)?.1.inverse()))
        };
        let (fast, law) = varied("100")?;
        let fast = fast.grids(study)?;
        let mut left = Vec::new();
        for pair in fast.windows(2) {
            let found = without_grid(pair).ok_or_else(missing)?;
            // √100 boundary layers to the diameter
            left.push((pair[1].0 / 10.0, law.taken_off(found) / open("100")? - 1.0));
        }
        let boxed = [(10_f64.ln(), share("10")?), (100_f64.ln(), share("100")?)];
        Ok(Neighbours { boxed, left: PowerLaw::fit(&left)? })
    }

    /// C_D in the paper's box over that in open water: between the two by the logarithm of Re, beyond
    /// as at the second.
    pub fn share(&self, reynolds: f64) -> f64 {
        let [(x0, y0), (x1, y1)] = self.boxed;
        y0 + (y1 - y0) * ((reynolds.ln() - x0) / (x1 - x0)).min(1.0)
    }
}

/// The claims; `open` is C_D in open water.
pub fn claims(
    study: &Table,
    open: impl Fn(&str) -> Result<f64, CaseError>,
) -> Result<Vec<Claim>, CaseError> {
    let neighbours = Neighbours::of(study, &open)?;
    let mut claims = Vec::new();
    for reynolds in UNVARIED {
        let missing = || CaseError::table(format!("study.csv lacks grids of Re {reynolds}"));
        let re: f64 = reynolds.parse().unwrap_or(f64::NAN);
        let grids = grids(study, reynolds, tau_of(reynolds))?;
        let found = without_grid(&grids).ok_or_else(missing)?;
        let cells = grids.last().ok_or_else(missing)?.0;
        let left = neighbours.left.at(cells / re.sqrt());
        let boxed = neighbours.share(re);
        claims.push(Claim {
            what: format!(
                "study: Re {reynolds}, grids up to {cells} cells extrapolated, less the box's share ({:.1} %) and what such \
                 grids leave ({:.1} %): C_D over that in open water",
                100.0 * (boxed - 1.0),
                100.0 * left
            ),
            measured: found / boxed / (1.0 + left) / open(reynolds)?,
            allowed: 0.98..=1.02,
            why: "computed to 0.1 % (0.3 % at Re 150). The box adds 7.6 % at Re 10 and 4.2 % at Re 100; half of the difference, \
                  1.7 %, for taking a line in log Re between them. Second-order extrapolation leaves too much where the \
                  boundary layer is thin: at Re 100 8.6, 2.1 and 0.7 % with 0.8, 1.2 and 1.6 cells in it, a power law \
                  that holds 1.5, 1.1 and 1.0 cells at Re 30, 50 and 150 to a fifth of 1.0, 2.5 and 4.2 %",
        });
    }
    claims.push(srt_claim(study)?);
    Ok(claims)
}

/// SRT beside MRT on 6 cells, wherever both became steady.
fn srt_claim(study: &Table) -> Result<Claim, CaseError> {
    let wanted = [("width_d", "5"), ("cells_per_diameter", "6")];
    let single =
        study.with(&[("outcome", "steady"), ("collision", Preset::Srt.word())])?.with(&wanted)?;
    let multiple = steady(study)?.with(&wanted)?;
    let mut off = f64::NAN;
    let mut compared = Vec::new();
    for (reynolds, tau) in TAUS {
        let here = [("Re", reynolds), ("tau", tau)];
        let single = single.with(&here)?;
        if !single.rows.is_empty() {
            let ratio = single.number("CD")? / multiple.with(&here)?.number("CD")?;
            off = off.max((ratio - 1.0).abs());
            compared.push(reynolds);
        }
    }
    Ok(Claim {
        what: format!(
            "study: C_D with SRT over that with MRT, 6 cells, Re {}: largest relative difference",
            compared.join(", ")
        ),
        measured: off,
        allowed: 0.0..=0.015,
        why: "the paper finds no remarkable difference (section 5). Only the surface's error can differ: MRT's drag is 4.9 % low \
              at Re 0.1 on this grid, SRT's 5.8 %; on 4 cells SRT is 1.4 % lower (tau = 0.7, same file), which finer grids \
              may not exceed. At Re 100 and 150 SRT has no steady drag to compare",
    })
}
