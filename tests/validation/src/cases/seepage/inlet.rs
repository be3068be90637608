//! A bed under a velocity inlet with free outflow, the paper's drive: how fast the water can enter.

use crate::cases::{BED_LAWS, CaseError, Claim};
use psmrt::table::Table;
use psmrt_reference::collision::Preset;

/// Height of the bed of `inlet.toml`, cells, and of the paper's; diameters, cells.
pub const SMALL: (f64, f64) = (31.0, 8.0);
pub const PAPER: (f64, f64) = (218.0, 16.0);

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

/// The claims: both collisions end where the arithmetic says.
pub fn claims(inlet: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
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
