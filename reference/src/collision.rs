//! The collision of the fluid alone: SRT (Eq. 2) and MRT (Eq. 3), each with its body force.

use crate::directions::Q;
use crate::equilibrium::{equilibrium, equilibrium_moments};
use crate::forcing::{source, source_moments};
use crate::lattice::{Populations, Vec3};
use crate::moments::{
    CellMatrix, Moments, inverse_moment_matrix, moment_matrix, relaxation_matrix,
};
use crate::rates::{RateError, Rates};

/// Which collision the fluid uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Collision {
    /// Single relaxation time `tau` (Eq. 2): the collision of Bhatnagar, Gross and Krook (BGK).
    Srt {
        /// Relaxation time, greater than 1/2.
        tau: f64,
    },
    /// Multiple relaxation times (Eq. 3).
    Mrt {
        /// The rates, with `1/tau` among them.
        rates: Rates,
    },
}

impl Collision {
    /// The relaxation time of the stress, which sets the viscosity.
    pub fn tau(&self) -> f64 {
        match self {
            Collision::Srt { tau } => *tau,
            Collision::Mrt { rates } => rates.tau(),
        }
    }

    /// This collision if its rates can be used; else an error that names the rate.
    pub fn checked(self) -> Result<Self, RateError> {
        match self {
            Collision::Srt { tau } => Rates::srt(tau)?,
            Collision::Mrt { rates } => rates.checked()?,
        };
        Ok(self)
    }
}

/// The collisions that are studied and planned with: one spelling of each, in all tables and commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Preset {
    /// Single relaxation time (BGK).
    Srt,
    /// MRT with the rates of d'Humières et al. (2002), [`Rates::dhumieres`].
    DHumieres,
    /// MRT with two relaxation times (TRT), [`Rates::magic`] with [`Preset::MAGIC`].
    Trt,
}

impl Preset {
    /// All of them, from the plainest to the most special.
    pub const ALL: [Preset; 3] = [Preset::Srt, Preset::DHumieres, Preset::Trt];

    /// The magic parameter Λ of [`Preset::Trt`]: plane walls lie exactly half-way between nodes.
    pub const MAGIC: f64 = 3.0 / 16.0;

    /// As tables spell it.
    pub const fn word(self) -> &'static str {
        match self {
            Preset::Srt => "SRT",
            Preset::DHumieres => "MRT_dHumieres",
            Preset::Trt => "TRT_3/16",
        }
    }

    /// The preset of a word of a table, if it is one.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.word() == word)
    }

    /// For readers.
    pub fn title(self) -> &'static str {
        match self {
            Preset::Srt => "SRT",
            Preset::DHumieres => "MRT d'Humieres",
            Preset::Trt => "TRT 3/16",
        }
    }

    /// The rates at relaxation time `tau`. Errors if `tau <= 1/2`.
    pub fn rates(self, tau: f64) -> Result<Rates, RateError> {
        match self {
            Preset::Srt => Rates::srt(tau),
            Preset::DHumieres => Rates::dhumieres(tau),
            Preset::Trt => Rates::magic(tau, Self::MAGIC),
        }
    }

    /// The collision at relaxation time `tau`. Errors if `tau <= 1/2`.
    pub fn collision(self, tau: f64) -> Result<Collision, RateError> {
        let rates = self.rates(tau)?;
        Ok(match self {
            Preset::Srt => Collision::Srt { tau },
            Preset::DHumieres | Preset::Trt => Collision::Mrt { rates },
        })
    }

    /// The preset that a collision is, whichever way its rates were set; `None` if it is none of them.
    pub fn of(collision: &Collision) -> Option<Self> {
        let Collision::Mrt { rates } = collision else { return Some(Preset::Srt) };
        // But for the rounding of rates that were given as numbers.
        let same = |other: &Rates| {
            let mut pairs = other.diagonal().into_iter().zip(rates.diagonal());
            pairs.all(|(a, b)| (a - b).abs() < 1e-9)
        };
        let by_likelihood = [Preset::DHumieres, Preset::Trt, Preset::Srt];
        by_likelihood.into_iter().find(|preset| preset.rates(rates.tau()).is_ok_and(|r| same(&r)))
    }
}

/// A collision ready for use: for MRT with its matrices built.
#[derive(Clone, Debug)]
pub enum CollisionOperator {
    /// Eq. 2.
    Srt {
        /// Relaxation time.
        tau: f64,
    },
    /// Eq. 3. Boxed: it holds three 19 × 19 matrices.
    Mrt(Box<MrtOperator>),
}

/// The matrices of Eq. 3.
#[derive(Clone, Debug)]
pub struct MrtOperator {
    /// `M`
    to_moments: CellMatrix,
    /// `M⁻¹ S-hat`
    relax: CellMatrix,
    /// `M⁻¹ (I - S-hat/2)`
    force: CellMatrix,
}

impl MrtOperator {
    /// Builds the matrices for a diagonal of `S-hat` in the order of [`crate::moments::NAMES`].
    ///
    /// Any diagonal is taken as it stands, so that a misprinted one can be tried too.
    pub fn new(diagonal: &Moments) -> Self {
        let inverse = inverse_moment_matrix();
        let s_hat = relaxation_matrix(diagonal);
        let half_left = s_hat.map(|rate| 1.0 - 0.5 * rate);
        MrtOperator {
            to_moments: CellMatrix::from_faer(&moment_matrix()),
            relax: CellMatrix::from_faer(&(&inverse * &s_hat)),
            force: CellMatrix::from_faer(&(&inverse * &half_left)),
        }
    }
}

impl CollisionOperator {
    /// Prepares `collision`.
    pub fn new(collision: &Collision) -> Self {
        match collision {
            Collision::Srt { tau } => CollisionOperator::Srt { tau: *tau },
            Collision::Mrt { rates } => {
                CollisionOperator::Mrt(Box::new(MrtOperator::new(&rates.diagonal())))
            }
        }
    }

    /// The change `Omega` of the populations in one collision towards the equilibrium at
    /// (`rho`, `u`).
    pub fn relaxation(&self, f: &Populations, rho: f64, u: &Vec3) -> Populations {
        match self {
            CollisionOperator::Srt { tau } => srt(f, rho, u, *tau),
            CollisionOperator::Mrt(operator) => mrt(f, rho, u, operator),
        }
    }

    /// The change of the populations by the body force, scaled to go with [`Self::relaxation`]:
    /// together they change the momentum by exactly `body_force`.
    pub fn source(&self, u: &Vec3, body_force: &Vec3) -> Populations {
        match self {
            // (1 - 1/(2τ)) F
            CollisionOperator::Srt { tau } => {
                source(u, body_force).map(|value| (1.0 - 0.5 / tau) * value)
            }
            // M⁻¹ (I - Ŝ/2) M F
            CollisionOperator::Mrt(operator) => {
                operator.force.times(&source_moments(u, body_force))
            }
        }
    }
}

/// SRT, Eq. 2.
fn srt(f: &Populations, rho: f64, u: &Vec3, tau: f64) -> Populations {
    let f_eq = equilibrium(rho, u);
    let mut omega = [0.0; Q];
    for a in 0..Q {
        // Ω = -(f - f^eq)/τ                                                             (Eq. 2)
        omega[a] = -(f[a] - f_eq[a]) / tau;
    }
    omega
}

/// MRT, Eq. 3.
fn mrt(f: &Populations, rho: f64, u: &Vec3, operator: &MrtOperator) -> Populations {
    let m = operator.to_moments.times(f);
    let m_eq = equilibrium_moments(rho, u);
    let mut m_neq = [0.0; Q];
    for k in 0..Q {
        m_neq[k] = m[k] - m_eq[k];
    }
    // Ω = -M⁻¹ Ŝ (m - m^eq)                                                             (Eq. 3)
    operator.relax.times(&m_neq).map(|value| -value)
}
