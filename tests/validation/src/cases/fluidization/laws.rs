//! What laws say of a bed that water lifts: the velocity at which it does, and that at which it has a porosity.

use super::{CaseError, Golden};
use psmrt::seepage::laws::BedLaw;
use psmrt::table::Table;

/// Grains of one size, by `literature.csv`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grains {
    /// Ar = (ρ_s/ρ_f - 1) g d³/ν².
    pub archimedes: f64,
    /// Re of one that settles alone.
    pub re_terminal: f64,
    /// Exponents of Richardson & Zaki and of Garside & Al-Dibouni.
    pub exponents: [f64; 2],
    /// Re at the onset by Wen & Yu.
    pub wen_yu: f64,
}

impl Grains {
    /// Those of a diameter, as tables spell it.
    pub(super) fn of(golden: &Golden, diameter_mm: &str) -> Result<Self, CaseError> {
        Self::from(&golden.table("literature.csv")?.with(&[("diameter_mm", diameter_mm)])?)
    }

    fn from(row: &Table) -> Result<Self, CaseError> {
        Ok(Grains {
            archimedes: row.number("archimedes")?,
            re_terminal: row.number("re_terminal")?,
            exponents: [row.number("n_richardson_zaki")?, row.number("n_garside")?],
            wen_yu: row.number("wen_yu")?,
        })
    }

    /// Superficial velocities over that of one grain alone at a porosity, `ε^n` with either exponent.
    pub(super) fn settling(&self, porosity: f64) -> [f64; 2] {
        self.exponents.map(|n| porosity.powf(n))
    }

    /// `Re = U d/ν` with which water just carries a bed of fixed grains, by a law of its resistance.
    pub(super) fn carried(&self, law: &BedLaw, porosity: f64) -> f64 {
        let phi = 1.0 - porosity;
        // dP/L = psi Re' ρ ν U φ²/(d² ε³) with Re' = Re/φ is (ρ_s - ρ_f) g φ, so that psi Re' Re = Ar ε³/φ.
        let wanted = self.archimedes * porosity.powi(3) / phi;
        let (mut low, mut high) = (1e-6 * wanted.min(1.0), wanted);
        for _ in 0..200 {
            let middle = (low * high).sqrt();
            let found = middle * (law.psi_re)(phi, middle / phi);
            if found < wanted { low = middle } else { high = middle }
        }
        low
    }
}
