//! A bed under a velocity inlet with free outflow, the paper's drive: how fast the water can enter.

use crate::cases::{BED_LAWS, CaseError, Claim};
use psmrt::table::Table;
use psmrt_reference::collision::Preset;

/// Height of the bed of `inlet.toml`, cells, and of the paper's; diameters, cells.
pub const SMALL: (f64, f64) = (31.0, 8.0);
pub const PAPER: (f64, f64) = (218.0, 16.0);

/// Change of psi of the paper's bed in 100 steps when its run was ended.
const STILL: f64 = 3e-3;
const WHY_STILL: &str = "successive changes fall by a fifth from row to row, so that four times the last one is still to go: \
                         1.2 % at most";

/// Solid fraction of both.
const FRACTION: f64 = 0.6;

/// Re at which the pressure that drives water through `length` cells of a bed of spheres of `d` cells is that of
/// a density twice the reference one: `Δp = c_s² Δρ` with `Δρ = 1`; `above` is tau - 1/2.
pub fn doubling(above: f64, (length, d): (f64, f64)) -> f64 {
    let (nu, phi) = (above / 3.0, FRACTION);
    // Δp = L psi U² φ/(d ε³), U = Re ν φ/d:  1/3 = A Re (psi Re), psi of Beetstra et al.
    let a = length * nu * nu * phi.powi(3) / (d.powi(3) * (1.0 - phi).powi(3));
    let pressure = |re: f64| a * re * (BED_LAWS[3].psi_re)(phi, re);
    // It rises with Re: halve the interval, of six decades, until nothing of it is left.
    let (mut low, mut high) = (1e-3_f64, 1e3_f64);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if pressure(middle) > 1.0 / 3.0 { high = middle } else { low = middle }
    }
    low
}

/// The largest Re that lived, against tau - 1/2.
pub fn limits(inlet: &Table, engine: &str, collision: &str) -> Result<Vec<(f64, f64)>, CaseError> {
    let own = inlet.with(&[("engine", engine), ("collision", collision)])?;
    let mut points = Vec::new();
    for tau in own.values("tau")? {
        let all = own.with(&[("tau", &tau)])?;
        let lived = all.words("Re", "outcome")?.into_iter();
        let lived = lived.filter(|(_, outcome)| ["steady", "drifts"].contains(outcome));
        let largest = lived.filter_map(|(re, _)| re.parse().ok()).fold(0.0, f64::max);
        points.push((tau.parse().map_or(f64::NAN, |tau: f64| tau - 0.5), largest));
    }
    Ok(points)
}

/// The claims: both collisions end where the arithmetic says; `paper` is the course of the paper's bed.
pub fn claims(inlet: &Table, paper: &Table) -> Result<Vec<Claim>, CaseError> {
    let ratios = paper.numbers("over_Beetstra")?;
    let &[.., before, last] = &ratios[..] else {
        return Err(CaseError::table("paper.csv has too few rows".to_owned()));
    };
    let mut claims = vec![
        Claim {
            what: "paper.csv: the paper's 1,000 spheres by its inlet at 8 cells per diameter, Re = 10.6: psi over \
                   Beetstra et al."
                .to_owned(),
            measured: last,
            allowed: 0.9..=1.1,
            why: "a settled bed, which real beds' scatter of 10 to 15 % bounds; beds of 31 spheres have 0.90 to 1.05 at this \
                  Re and grid. Tang's law is 17 % above Beetstra's here: the next claim",
        },
        Claim {
            what: "paper.csv: psi over Tang et al.".to_owned(),
            measured: *paper.numbers("over_Tang")?.last().unwrap_or(&f64::NAN),
            allowed: 0.75..=1.0,
            why: "Tang's law is 15 % above Beetstra's at this Re and solid fraction: the same 10 % to either side of 1/1.15",
        },
        Claim {
            what: "paper.csv: change of psi in its last 100 steps".to_owned(),
            measured: (last / before - 1.0).abs(),
            allowed: 0.0..=STILL,
            why: WHY_STILL,
        },
    ];
    for collision in [Preset::Srt.word(), Preset::DHumieres.word()] {
        let found = limits(inlet, "wgpu", collision)?.into_iter();
        // Nearer to 1/2 the speed of sound comes first.
        let slow = found.filter(|&(above, _)| above > 0.03);
        let ratios: Vec<_> =
            slow.map(|(above, largest)| largest / doubling(above, SMALL)).collect();
        for (name, value) in [
            ("smallest", ratios.iter().copied().fold(f64::NAN, f64::min)),
            ("largest", ratios.iter().copied().fold(f64::NAN, f64::max)),
        ] {
            claims.push(Claim {
                what: format!(
                    "inlet: last stable Re with {collision} over that at which the bed needs twice the density, \
                     tau 0.6 and 0.55, {name}"
                ),
                measured: value,
                allowed: 0.5..=2.0,
                why: "Re goes by factors of 2; the guard stops a run whose mean density has doubled (the pressure under the \
                      bed does so before) or whose pores are faster than half a cell per step, at tau = 0.55 at the same Re",
            });
        }
    }
    for collision in [Preset::Srt.word(), Preset::DHumieres.word()] {
        let at_0_6 = |engine: &str| {
            let found = limits(inlet, engine, collision)?;
            let own = found.into_iter().find(|(above, _)| (above - 0.1).abs() < 1e-9);
            Ok::<_, CaseError>(own.map_or(f64::NAN, |(_, largest)| largest))
        };
        claims.push(Claim {
            what: format!("inlet: last stable Re with {collision} at tau 0.6, kernel over oracle"),
            measured: at_0_6("wgpu")? / at_0_6("reference")?,
            allowed: 1.0..=1.0,
            why: "the same runs in single precision, which does not make a pressure",
        });
    }
    Ok(claims)
}
