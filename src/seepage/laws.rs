//! Laws for the resistance of beds of spheres, as psi Re against Re and the solid fraction.
//!
//! ```text
//!   psi = (dP/L) d ε³/(ρ U² (1 - ε)),   Re = U d/(ν (1 - ε)),   φ = 1 - ε
//! ```
//!
//! With the whole force per sphere `F_tot = F/(3π μ d U)`, that of the mean pressure gradient included,
//! `dP/L = 18 μ φ U F_tot/d²`, so that `psi Re = 18 ε³ F_tot/φ`. `golden/seepage/literature.csv` has values of
//! each law that were computed apart from this; a test holds the two together.

/// One darcy, m2: a fluid of 1 mPa s at 1 cm/s under 1 atm/cm, 101325 Pa.
pub const SI_DARCY: f64 = 1e-7 / 101_325.0;

/// A law of psi Re: its name, and itself as a function of the solid fraction and Re.
#[derive(Clone, Copy, Debug)]
pub struct BedLaw {
    /// As figures spell it.
    pub name: &'static str,
    /// Column of `golden/seepage/literature.csv`.
    pub column: &'static str,
    /// psi Re from the solid fraction and Re.
    pub psi_re: fn(f64, f64) -> f64,
}

/// The paper's two, Carman's constant of 180, and two from particle-resolved computations.
pub const BED_LAWS: [BedLaw; 5] = [
    BedLaw { name: "Blake-Kozeny, 150/Re", column: "psiRe_BlakeKozeny", psi_re: |_, _| 150.0 },
    BedLaw { name: "Ergun", column: "psiRe_Ergun", psi_re: |_, re| 150.0 + 1.75 * re },
    BedLaw { name: "Carman-Kozeny, 180/Re", column: "psiRe_CarmanKozeny180", psi_re: |_, _| 180.0 },
    BedLaw { name: "Beetstra 2007", column: "psiRe_Beetstra2007", psi_re: beetstra },
    BedLaw { name: "Tang 2015", column: "psiRe_Tang2015", psi_re: tang },
];

impl BedLaw {
    /// Permeability over the square of the diameter that it gives at a porosity and Re; at 0 the limit of slow flow.
    pub fn permeability(&self, porosity: f64, re: f64) -> f64 {
        // The laws have powers of Re below 0, whose products vanish with Re.
        let re = re.max(1e-9);
        // k/d² = ε³/((1 - ε)² psi Re)
        porosity.powi(3) / (1.0 - porosity).powi(2) / (self.psi_re)(1.0 - porosity, re)
    }
}

/// psi Re from the drag that is left of the whole force when the mean pressure gradient's part is taken off.
fn from_drag(phi: f64, drag: f64) -> f64 {
    let porosity = 1.0 - phi;
    // F_tot = F_d/ε
    18.0 * porosity.powi(3) / phi * drag / porosity
}

/// What both laws have at Re = 0: van der Hoef, Beetstra & Kuipers (2005).
fn creeping(phi: f64) -> f64 {
    // F₀ = 10 φ/(1 - φ)² + (1 - φ)² (1 + 1.5 √φ)
    10.0 * phi / (1.0 - phi).powi(2) + (1.0 - phi).powi(2) * (1.0 + 1.5 * phi.sqrt())
}

/// Beetstra, van der Hoef & Kuipers, AIChE Journal 53 (2007) 489, for equal spheres.
fn beetstra(phi: f64, re: f64) -> f64 {
    let eps = 1.0 - phi;
    let r = re * phi; // U d/ν
    // F = F₀ + 0.413 r/(24 ε²) [1/ε + 3 φ ε + 8.4 r^-0.343]/[1 + 10^(3φ) r^-(1 + 4φ)/2]
    let above = 1.0 / eps + 3.0 * phi * eps + 8.4 * r.powf(-0.343);
    let below = 1.0 + 10.0_f64.powf(3.0 * phi) * r.powf(-0.5 * (1.0 + 4.0 * phi));
    from_drag(phi, creeping(phi) + 0.413 * r / (24.0 * eps * eps) * above / below)
}

/// Tang, Peters, Kuipers, Kriebitzsch & van der Hoef, AIChE Journal 61 (2015) 688.
fn tang(phi: f64, re: f64) -> f64 {
    let eps = 1.0 - phi;
    let r = re * phi; // U d/ν
    // F = F₀ + [0.11 φ (1 + φ) - 0.00456/ε⁴ + (0.169 ε + 0.0644/ε⁴) r^-0.343] r
    let slow = 0.11 * phi * (1.0 + phi) - 0.00456 / eps.powi(4);
    let fast = (0.169 * eps + 0.0644 / eps.powi(4)) * r.powf(-0.343);
    from_drag(phi, creeping(phi) + (slow + fast) * r)
}
