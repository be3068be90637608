//! Hertz's contact of elastic spheres, with the tangential spring of Mindlin, dashpots, Coulomb's limit and
//! an optional rolling resistance.
//!
//! Two bodies `i` of Young's modulus `E_i`, Poisson's ratio `ν_i` and shear modulus `G_i = E_i/(2 (1 + ν_i))` act
//! through (Johnson, Contact Mechanics (1985), sections 4.2 and 7.3; a rigid body, or a plane, leaves its term out)
//!
//! ```text
//!   1/E* = Σ (1 - ν_i²)/E_i,   1/G* = Σ (2 - ν_i)/G_i,   1/R* = Σ 1/R_i,   1/m = Σ 1/m_i
//!   radius of the contact   a   = √(R* δ)
//!   normal spring           F_n = (4/3) E* a δ,    dF_n/dδ   = S_n = 2 E* a
//!   tangential spring       dF_t = S_t dξ,         S_t = 8 G* a                  (no slip: Mindlin, 1949)
//!   dashpots                2 √(5/6) ζ √(m S) u,   with S_n along the normal and S_t across it
//! ```
//!
//! The dashpots are those of Tsuji, Tanaka & Ishida, Powder Technol. 71, 239 (1992), with the factor of Antypov &
//! Elliott, EPL 94, 50004 (2011). With `y = δ^(5/4)` the relation of speed to overlap in an impact,
//!
//! ```text
//!   m p dp/dδ + 2 √(5/6) ζ √(m S_n) p + F_n = 0,   p = dδ/dt
//!   (5/4) m p dp/dy + 2 ζ √((5/4) m K) p + K y = 0,   K = (4/3) E* √R*
//! ```
//!
//! is that of a linear spring `K` and dashpot of damping ratio `ζ` which carry the mass `(5/4) m`. So restitution and
//! overlap have closed forms, at whatever speed `v` the bodies meet, and those of [`super::law`] for a contact that ends
//! at zero force hold to the letter, with `ω₀ = √(K/(5 m/4))`:
//!
//! ```text
//!   restitution  e     = exp(-2 ζ s(ζ))
//!   overlap      δ_max = ((v/ω₀) √e)^(4/5)
//!   duration     t_c   = (4/5) (v/ω₀)^(-1/5)/ω₀ ∫ f^(-1/5) dθ from 0 to 2 s(ζ),   f = exp(-ζ θ) sin(√(1 - ζ²) θ)/√(1 - ζ²)
//! ```
//!
//! Without damping the integral is `√π Γ(2/5)/Γ(9/10)`, and `t_c = 2.943 δ_max/v`.
//!
//! *What becomes of the tangential spring when the overlap changes.* While the overlap grows the force of the spring
//! stays and is added to with the stiffness of the moment: the new rim of the contact is not sheared. While it shrinks the
//! force falls as the stiffness does: what the lost rim carried is gone. This is the incremental form "Mindlin with
//! rescaling" of Walton & Braun, J. Rheol. 30, 949 (1986), and Thornton, Cummins & Cleary, Powder Technol. 233, 30 (2013)
//! (`mindlin_rescale/force` of LAMMPS). Both ways a spring only loses energy. The form that keeps the force while the
//! overlap shrinks makes energy from nothing, and so does the displacement form `F_t = S_t ξ` (the "H-MDns" of
//! Di Renzo & Di Maio, Chem. Eng. Sci. 59, 525 (2004), and the default of LIGGGHTS) while the overlap grows.

use std::f64::consts::PI;

use crate::grains::contact::{ContactMemory, Relative, in_plane};
use crate::grains::law::{
    ContactLaw, Friction, LawError, Rolling, checked_damping_ratio, not_negative, phase_per_sine,
    positive, restitution,
};

/// Deepest overlap that sub-steps resolve, in radii of the smaller body: contacts get stiffer with depth. Deeper ones
/// are computed, less accurately: at half a radius, where [`crate::grains::hold`] ends, they are 1.5 times as fast.
pub const RESOLVED_OVERLAP: f64 = 0.1;

/// An elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus `E`, force/length².
    pub youngs_modulus: f64,
    /// Poisson's ratio `ν`, 0 to 0.5.
    pub poisson_ratio: f64,
}

impl Elastic {
    /// Shear modulus `G`, force/length².
    pub fn shear_modulus(&self) -> f64 {
        // G = E/(2 (1 + ν))
        self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// Time in which a Rayleigh wave runs half round a sphere of `radius` and `density` (mass/length³).
    pub fn rayleigh_time(&self, radius: f64, density: f64) -> f64 {
        // T_R = π R √(ρ/G)/(0.1631 ν + 0.8766): Thornton & Randall, Micromechanics of Granular Materials (1988)
        let slowness = (density / self.shear_modulus()).sqrt();
        PI * radius * slowness / (0.1631 * self.poisson_ratio + 0.8766)
    }

    /// Errors unless the material can be used.
    fn checked(&self) -> Result<(), LawError> {
        positive("Young's modulus", self.youngs_modulus)?;
        let value = self.poisson_ratio;
        if (0.0..=0.5).contains(&value) {
            return Ok(());
        }
        let allowed = "must lie between 0 and 0.5; most solids have 0.2 to 0.4";
        Err(LawError::BadValue { key: "Poisson's ratio", value, allowed })
    }

    /// `(1 - ν²)/E` and `(2 - ν)/G`.
    fn compliances(&self) -> [f64; 2] {
        let Elastic { youngs_modulus, poisson_ratio } = *self;
        let across = (2.0 - poisson_ratio) / self.shear_modulus();
        [(1.0 - poisson_ratio * poisson_ratio) / youngs_modulus, across]
    }
}

/// How two elastic surfaces act on each other, in any consistent units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzLaw {
    /// The softer of the two materials, or the only one: what [`Elastic::rayleigh_time`] is asked of.
    pub material: Elastic,
    /// `E*`, force/length².
    pub modulus: f64,
    /// `G*`, force/length².
    pub shear_modulus: f64,
    /// Damping ratio `ζ` of all dashpots.
    pub damping_ratio: f64,
    /// Coulomb's coefficient `μ`; `None`: perfectly smooth.
    pub friction: Option<f64>,
    /// Rolling resistance; `None`: grains roll freely.
    pub rolling: Option<RollingShare>,
}

/// Rolling resistance as [`Rolling`], its stiffness and damping in proportion to the normal ones of the moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingShare {
    /// Coefficient `μ_r`.
    pub coefficient: f64,
    /// Its stiffness over `F_n/δ`, and its damping over the normal one.
    pub share: f64,
}

impl HertzLaw {
    /// A law without friction between two materials, under which bodies part at `restitution` times the speed at which
    /// they met. Errors unless both materials are elastic and the restitution lies in `0.01..=1`.
    pub fn between([one, two]: [Elastic; 2], restitution: f64) -> Result<Self, LawError> {
        one.checked()?;
        two.checked()?;
        let [near, far] = [one.compliances(), two.compliances()];
        let softer = if two.youngs_modulus < one.youngs_modulus { two } else { one };
        Self::of(softer, [near[0] + far[0], near[1] + far[1]], restitution)
    }

    /// The same between a material and a rigid one.
    pub fn on_rigid(material: Elastic, restitution: f64) -> Result<Self, LawError> {
        Self::of(material, material.compliances(), restitution)
    }

    fn of(material: Elastic, [normal, across]: [f64; 2], e: f64) -> Result<Self, LawError> {
        material.checked()?;
        let (modulus, shear_modulus) = (1.0 / normal, 1.0 / across);
        let damping_ratio = checked_damping_ratio(e)?;
        let (friction, rolling) = (None, None);
        HertzLaw { material, modulus, shear_modulus, damping_ratio, friction, rolling }.checked()
    }

    /// The same with friction of `coefficient`. Errors if it is negative or not finite.
    pub fn with_friction(self, coefficient: f64) -> Result<Self, LawError> {
        HertzLaw { friction: Some(coefficient), ..self }.checked()
    }

    /// The same with rolling resistance of `coefficient`, in proportion 2/5 to the normal spring as in
    /// [`ContactLaw::with_rolling`]. Errors if it is negative or not finite.
    pub fn with_rolling(self, coefficient: f64) -> Result<Self, LawError> {
        HertzLaw { rolling: Some(RollingShare { coefficient, share: 0.4 }), ..self }.checked()
    }

    /// This law if its values can be used, else an error that names the first that cannot.
    pub fn checked(self) -> Result<Self, LawError> {
        self.material.checked()?;
        positive("effective modulus", self.modulus)?;
        positive("effective shear modulus", self.shear_modulus)?;
        not_negative("damping ratio", self.damping_ratio)?;
        not_negative("friction coefficient", self.friction.unwrap_or(0.0))?;
        if let Some(RollingShare { coefficient, share }) = self.rolling {
            not_negative("rolling coefficient", coefficient)?;
            positive("rolling stiffness", share)?;
        }
        Ok(self)
    }

    /// The linear law with the stiffness and damping that a contact of `overlap` has at this moment, between bodies of
    /// reduced radius `R*` and reduced mass `m`.
    pub fn at(&self, overlap: f64, radius: f64, mass: f64) -> ContactLaw {
        // a = √(R* δ);  F_n/δ = (4/3) E* a,  S_n = 2 E* a,  S_t = 8 G* a;  γ = 2 √(5/6) ζ √(m S)
        let a = (radius * overlap.max(0.0)).sqrt();
        let factor = 2.0 * (5.0_f64 / 6.0).sqrt() * self.damping_ratio;
        let dashpot = |slope: f64| factor * (mass * slope).sqrt();
        let (stiffness, damping) = (4.0 / 3.0 * self.modulus * a, dashpot(2.0 * self.modulus * a));
        let across = 8.0 * self.shear_modulus * a;
        let friction = self.friction.map(|coefficient| Friction {
            coefficient,
            stiffness: across,
            damping: dashpot(across),
        });
        let rolling = self.rolling.map(|RollingShare { coefficient, share }| Rolling {
            coefficient,
            stiffness: share * stiffness,
            damping: share * damping,
        });
        ContactLaw { stiffness, damping, friction, rolling }
    }

    /// Speed of parting over speed of meeting in a central impact of any bodies at any speed.
    pub fn restitution(&self) -> f64 {
        restitution(self.damping_ratio)
    }

    /// Largest overlap in a central impact at `speed`, length.
    pub fn largest_overlap(&self, radius: f64, mass: f64, speed: f64) -> f64 {
        // δ_max = ((v/ω₀) √e)^(4/5)
        (speed / self.frequency(radius, mass) * self.restitution().sqrt()).powf(0.8)
    }

    /// Time from touch to zero force of a central impact at `speed`, to a ten-thousandth.
    pub fn duration(&self, radius: f64, mass: f64, speed: f64) -> f64 {
        // t_c = (4/5) (v/ω₀)^(-1/5)/ω₀ ∫ f^(-1/5) dθ
        let omega = self.frequency(radius, mass);
        0.8 * (speed / omega).powf(-0.2) / omega * duration_integral(self.damping_ratio)
    }

    /// What a sub-step must resolve of a contact with an overlap of [`RESOLVED_OVERLAP`] of a body of radius
    /// `smaller`: [`ContactLaw::shortest_time`] of the law of that moment. That is about 2 times
    /// [`Elastic::rayleigh_time`] between smooth grains, and about 1 time with friction, so that a tenth of it, the
    /// longest sub-step that is accepted, is the 10 to 20 % of Rayleigh's time that is usual.
    pub fn shortest_time(&self, smaller: f64, radius: f64, mass: f64) -> f64 {
        self.at(RESOLVED_OVERLAP * smaller, radius, mass).shortest_time(mass)
    }

    /// `ω₀` of the linear oscillator of which overlaps are the `4/5`-th power, in the units that this asks for.
    fn frequency(&self, radius: f64, mass: f64) -> f64 {
        // ω₀ = √(K/(5 m/4)),  K = (4/3) E* √R*
        (4.0 / 3.0 * self.modulus * radius.sqrt() / (1.25 * mass)).sqrt()
    }
}

/// Springs that had the overlap `before.overlap`, for a sub-step `dt` to whose end it becomes `overlap`; their movement in
/// the sub-step is still to come. While the overlap grows their force stays, and what the movement adds has the mean of the
/// two stiffnesses; while it shrinks they stay as they are.
pub(super) fn relaxed(
    before: &ContactMemory,
    overlap: f64,
    middle: &Relative,
    dt: f64,
) -> ContactMemory {
    // r = S_t'/S_t = √(δ'/δ);  S_t ξ = S_t' ξ' + (S_t' + S_t)/2 dξ,  so  ξ = r ξ' + (r - 1)/2 dξ + dξ
    let ratio = (before.overlap / overlap).sqrt();
    if ratio >= 1.0 || overlap <= 0.0 {
        return *before;
    }
    let half = 0.5 * (ratio - 1.0) * dt;
    ContactMemory {
        spring: ratio * before.spring + half * in_plane(&middle.velocity, &before.normal),
        rolling: ratio * before.rolling + half * in_plane(&middle.angular_velocity, &before.normal),
        ..*before
    }
}

/// `∫ f^(-1/5) dθ` from 0 to `2 s(ζ)`.
fn duration_integral(zeta: f64) -> f64 {
    const POINTS: u32 = 2000;
    let end = 2.0 * phase_per_sine(zeta);
    // At both ends f may vanish as θ does: θ = (end/2) w^(5/4) takes the singularity away.
    let sum: f64 = (0..POINTS)
        .map(|point| {
            let w = (f64::from(point) + 0.5) / f64::from(POINTS);
            let theta = 0.5 * end * w.powf(1.25);
            let ends = swing(theta, zeta).powf(-0.2) + swing(end - theta, zeta).powf(-0.2);
            ends * w.powf(0.25)
        })
        .sum();
    0.625 * end * sum / f64::from(POINTS)
}

/// `f(θ) = exp(-ζ θ) sin(x θ)/x` with `x = √(1 - ζ²)`, continued beyond `ζ = 1`.
fn swing(theta: f64, zeta: f64) -> f64 {
    let square = 1.0 - zeta * zeta;
    let x = square.abs().sqrt();
    let shape = if x < 1e-3 {
        // sin(x θ)/x = θ (1 - x² θ²/6 + ...)
        theta * (1.0 - square * theta * theta / 6.0)
    } else if square > 0.0 {
        (x * theta).sin() / x
    } else {
        (x * theta).sinh() / x
    };
    (-zeta * theta).exp() * shape
}
