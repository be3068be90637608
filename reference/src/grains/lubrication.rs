//! Lubrication: the part of the force between two close surfaces that a grid of cells does not resolve.
//!
//! Two spheres of radii `a₁`, `a₂` that approach at relative speed `U` across a gap `h` in a fluid of
//! viscosity `μ` resist with (Jeffrey & Onishi, J. Fluid Mech. 139, 261 (1984); `β = a₂/a₁`,
//! `ξ = 2 h/(a₁ + a₂)`)
//!
//! ```text
//!   F = 6π μ a₁ U (g₁/ξ + g₂ ln(1/ξ) + const),   g₁ = 2 β²/(1 + β)³,   g₂ = β (1 + 7 β + β²)/(5 (1 + β)³)
//! ```
//!
//! and a sphere and a plane with the limit `β → ∞`: `6π μ a U (a/h + (1/5) ln(a/h) + const)` (Brenner,
//! Chem. Eng. Sci. 16, 242 (1961)). The fluid's solver resolves the force down to some gap
//! `cutoff_gap`; what is added here is the difference to the force at that gap, in which the constant
//! drops out.

use std::f64::consts::PI;
use thiserror::Error;

/// Lubrication between grains and between grains and planes, along the line of centres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lubrication {
    /// Dynamic viscosity of the fluid, mass/(length · time).
    pub viscosity: f64,
    /// Gap from which the correction acts, length: what the fluid's grid resolves.
    pub cutoff_gap: f64,
    /// Gap below which the force grows no more, length: the roughness of the surfaces.
    pub smallest_gap: f64,
    /// Whether it stays there as long as the surfaces touch. A contact that lasts longer than a real one is damped by
    /// it: by `exp(-C t/m)`, `C` the coefficient at the smallest gap, in a contact of duration `t` of a mass `m`.
    pub while_touching: bool,
}

/// A correction that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LubricationError {
    /// The viscosity is not positive.
    #[error(
        "lubrication viscosity = {value} must be positive and finite; leave lubrication out where \
         there is no fluid"
    )]
    Viscosity {
        /// The value as given.
        value: f64,
    },
    /// The gaps are not in order.
    #[error(
        "lubrication smallest_gap = {smallest} and cutoff_gap = {cutoff}: it takes 0 < smallest_gap \
         < cutoff_gap; common are a thousandth of a radius and the spacing of the fluid's grid"
    )]
    Gaps {
        /// Smallest gap as given.
        smallest: f64,
        /// Cut-off as given.
        cutoff: f64,
    },
}

impl Lubrication {
    /// This correction if its values can be used.
    pub fn checked(self) -> Result<Self, LubricationError> {
        let Lubrication { viscosity, cutoff_gap: cutoff, smallest_gap: smallest, .. } = self;
        if !(viscosity > 0.0 && viscosity.is_finite()) {
            return Err(LubricationError::Viscosity { value: viscosity });
        }
        if !(smallest > 0.0 && smallest < cutoff && cutoff.is_finite()) {
            return Err(LubricationError::Gaps { smallest, cutoff });
        }
        Ok(self)
    }

    /// Force per speed of approach between two spheres at distance `gap`, force · time/length.
    pub fn between_spheres(&self, gap: f64, [a1, a2]: [f64; 2]) -> f64 {
        let beta = a2 / a1;
        let g1 = 2.0 * beta * beta / (1.0 + beta).powi(3);
        let g2 = beta * (1.0 + 7.0 * beta + beta * beta) / (5.0 * (1.0 + beta).powi(3));
        self.beyond_cutoff(gap, a1, 0.5 * (a1 + a2), g1, g2)
    }

    /// The same between a sphere of radius `a` and a plane.
    pub fn at_plane(&self, gap: f64, a: f64) -> f64 {
        self.beyond_cutoff(gap, a, a, 1.0, 0.2)
    }

    /// The largest of these coefficients for spheres of radius up to `a`, force · time/length.
    pub fn largest(&self, a: f64) -> f64 {
        self.at_plane(self.smallest_gap, a)
    }

    /// `6π μ a [g₁ (l/h - l/h_c) + g₂ ln(h_c/h)]`, `l` being the length by which gaps are divided.
    fn beyond_cutoff(&self, gap: f64, a: f64, l: f64, g1: f64, g2: f64) -> f64 {
        let (h, cutoff) = (gap.max(self.smallest_gap), self.cutoff_gap);
        let is_left_to_contact = gap < 0.0 && !self.while_touching;
        if h >= cutoff || is_left_to_contact {
            return 0.0;
        }
        6.0 * PI * self.viscosity * a * (g1 * (l / h - l / cutoff) + g2 * (cutoff / h).ln())
    }
}
