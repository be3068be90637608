//! The full form of seepage: what its rows say of beds, grids, relaxation times and stability.

use super::seepage::over_law;
use super::{CaseError, Claim, Table};

/// The rows with Noble and Torczynski's weight that became steady.
pub fn steady(study: &Table, collision: &str) -> Result<Table, CaseError> {
    study.with(&[
        ("outcome", "steady"),
        ("collision", collision),
        ("weighting", "noble_torczynski"),
    ])
}

/// psi Re against cells per diameter at low Re, MRT.
pub fn grids(study: &Table, packing: &str, tau: &str) -> Result<Vec<(f64, f64)>, CaseError> {
    let wanted = [("packing", packing), ("tau", tau), ("Re_wanted", "1")];
    let mut points = steady(study, "mrt")?.with(&wanted)?.points("cells_per_diameter", "psi_Re")?;
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(points)
}

/// psi Re against tau at low Re: 31 spheres, 8 cells per diameter.
pub fn taus(study: &Table, collision: &str, weighting: &str) -> Result<Vec<(f64, f64)>, CaseError> {
    let wanted = [
        ("outcome", "steady"),
        ("collision", collision),
        ("weighting", weighting),
        ("packing", "random 3"),
        ("seed", "1"),
        ("Re_wanted", "1"),
        ("cells_per_diameter", "8.0000"),
    ];
    let mut points = study.with(&wanted)?.points("tau", "psi_Re")?;
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(points)
}

/// The largest Re at which a flow with these values was stable; 0 if none was.
pub fn largest_stable(stability: &Table, wanted: &[(&str, &str)]) -> Result<f64, CaseError> {
    let stable = stability.with(wanted)?.with(&[("outcome", "stable")])?;
    Ok(stable.numbers("Re")?.into_iter().fold(0.0, f64::max))
}

/// The claims of the study: `ordered` is psi Re of the ordered bed.
pub fn claims(study: &Table, stability: &Table, ordered: f64) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    let beds = steady(study, "mrt")?.with(&[("packing", "random 3"), ("tau", "0.51")])?;
    for reynolds in ["1", "10", "30"] {
        let wanted = [("Re_wanted", reynolds), ("cells_per_diameter", "8.0000")];
        let ratios = over_law(&beds.with(&wanted)?)?;
        let n = ratios.len();
        claims.push(Claim {
            what: format!(
                "study: Re about {reynolds}: psi over Beetstra et al., mean of {n} beds of 31 spheres"
            ),
            measured: ratios.iter().sum::<f64>() / n as f64,
            allowed: 0.9..=1.1,
            why: "particle-resolved laws differ among themselves by 5 % at low Re and 15 % at Re = 30, and hold for \
                  infinite beds; at 8 cells and tau = 0.51 the grid is worth 5 %",
        });
    }
    let slow = &[("Re_wanted", "1"), ("cells_per_diameter", "8.0000")];
    let ratios = over_law(&beds.with(slow)?)?;
    let (low, high) = ratios.iter().fold((f64::MAX, 0.0_f64), |(a, b), &x| (a.min(x), b.max(x)));
    claims.push(Claim {
        what: "study: Re about 1: spread of these beds, largest over smallest psi".to_owned(),
        measured: high / low,
        allowed: 1.0..=1.25,
        why: "small beds at one porosity; measured beds scatter by 10 to 15 % to either side",
    });
    for tau in ["0.52", "0.55"] {
        let grids = grids(study, "fcc", tau)?;
        let limit = super::sphere_drag_study::without_grid(&grids);
        claims.push(Claim {
            what: format!("study: ordered bed, tau {tau}, grids extrapolated: psi over the exact one"),
            measured: limit.map_or(f64::NAN, |limit| limit / ordered),
            allowed: 0.95..=1.05,
            why: "exact to eight digits; what second-order extrapolation from 10.5 and 16 cells leaves of an error of \
                  3 to 20 % on them",
        });
    }
    let limit = |collision: &str, tau: &str| {
        let wanted = [("engine", "reference"), ("collision", collision), ("tau", tau)];
        let own = stability.with(&wanted)?;
        largest_stable(&own, &[("weighting", "noble_torczynski")])
    };
    for collision in ["srt", "mrt"] {
        claims.push(Claim {
            what: format!("stability: largest stable Re with {collision} at tau 0.51"),
            measured: limit(collision, "0.51")?,
            allowed: 30.0..=300.0,
            why: "the paper reaches 30 with MRT and only 2 with SRT, at a tau that it does not tell; here both are as \
                  fast as a pore velocity of half a cell per step allows, so that its limit for SRT is not \
                  reproduced (reference/ERRATA.md)",
        });
    }
    claims.push(Claim {
        what: "stability (guard against drift): largest stable Re with MRT over that with SRT at tau 0.505"
            .to_owned(),
        measured: limit("mrt", "0.505")? / limit("srt", "0.505")?,
        allowed: 1.5..=20.0,
        why: "no theory and no paper gives this ratio: 2.0 was measured, with forces that double from try to try, and \
              one try less of MRT would be 1.0, so that a change of either collision shows. That MRT is the more \
              stable is the paper's claim; how right the flows are is what the claims on psi say",
    });
    Ok(claims)
}
