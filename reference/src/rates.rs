//! The relaxation rates of MRT: the diagonal of `S-hat`, by name, with presets.

use crate::moments::Moments;
use thiserror::Error;

/// Relaxation rates, one per family of moments, each in (0, 2).
///
/// The paper (section 2) prints `S-hat = diag(0, s1, s2, _, s4, 0, s4, 0, s4, s9, s2, s9, s9, ...)`;
/// the fourth entry is blank, the thirteenth is misprinted and `s9` is said to be `tau`: see
/// `ERRATA.md`. [`Rates::diagonal`] is the corrected form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Energy, the paper's `s1`: sets the bulk viscosity.
    pub e: f64,
    /// Energy squared, the paper's `s2`.
    pub eps: f64,
    /// Energy flux, the paper's `s4`.
    pub q: f64,
    /// Stress, the paper's `s9 = 1/tau`: sets the kinematic viscosity.
    pub nu: f64,
    /// Fourth-order companions of the normal stresses, the paper's `s2`, d'Humières' `s10`.
    pub pi: f64,
    /// Third order, the paper's `s16`.
    pub m: f64,
}

/// A set of rates that cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RateError {
    /// `tau` gives no positive viscosity.
    #[error(
        "tau = {tau} must be greater than 0.5: the viscosity (tau - 1/2)/3 would not be positive; \
         raise the viscosity or the time step, or refine the grid"
    )]
    Tau {
        /// The relaxation time as given.
        tau: f64,
    },
    /// A rate outside (0, 2).
    #[error(
        "relaxation rate s_{name} = {value} must lie between 0 and 2 (exclusive): outside it the \
         moment is amplified at each collision; take a preset or a value such as 1.2"
    )]
    Rate {
        /// Name of the rate, one of [`Rates::NAMES`].
        name: &'static str,
        /// The value as given.
        value: f64,
    },
    /// A name that is none of the rates.
    #[error("there is no relaxation rate s_{name}: the rates are s_e, s_eps, s_q, s_pi and s_m")]
    Unknown {
        /// The name as given.
        name: String,
    },
    /// The stress rate is fixed by `tau`.
    #[error("s_nu is 1/tau and cannot be set by itself: set tau (or the viscosity) instead")]
    Stress,
    /// The magic parameter is not positive.
    #[error(
        "magic parameter Lambda = {value} must be positive and finite; common choices are 3/16 \
         (exact plane walls), 1/4 (stability), 1/6 and 1/12"
    )]
    Magic {
        /// The value as given.
        value: f64,
    },
}

impl Rates {
    /// Names of the rates, in the order of the fields.
    pub const NAMES: [&'static str; 6] = ["e", "eps", "q", "nu", "pi", "m"];

    /// Single relaxation time: all rates `1/tau`, with which MRT is SRT.
    ///
    /// Source: Eq. 2 of the paper. Errors if `tau <= 1/2`.
    pub fn srt(tau: f64) -> Result<Self, RateError> {
        let s = 1.0 / checked_tau(tau)?;
        Self { e: s, eps: s, q: s, nu: s, pi: s, m: s }.checked()
    }

    /// The rates that d'Humières et al. (2002) recommend for D3Q19: 1.19, 1.4, 1.2, 1.4, 1.98.
    ///
    /// The paper leaves its free rates open and cites this source. Errors if `tau <= 1/2`.
    pub fn dhumieres(tau: f64) -> Result<Self, RateError> {
        let nu = 1.0 / checked_tau(tau)?;
        Self { e: 1.19, eps: 1.4, q: 1.2, nu, pi: 1.4, m: 1.98 }.checked()
    }

    /// Two relaxation times (TRT): even moments at `1/tau`, odd ones so that the product of
    /// `1/s - 1/2` is `magic` (Λ).
    ///
    /// Source: Ginzburg, Verhaeghe & d'Humières, Commun. Comput. Phys. 3, 427 (2008). Λ = 3/16 puts
    /// a half-way bounce-back wall exactly half-way in Poiseuille flow. Errors if `tau <= 1/2` or
    /// `magic` is not positive.
    pub fn magic(tau: f64, magic: f64) -> Result<Self, RateError> {
        let even = 1.0 / checked_tau(tau)?;
        if !(magic > 0.0 && magic.is_finite()) {
            return Err(RateError::Magic { value: magic });
        }
        // Λ = (1/s_even - 1/2)(1/s_odd - 1/2)
        let odd = 1.0 / (magic / (tau - 0.5) + 0.5);
        Self { e: even, eps: even, q: odd, nu: even, pi: even, m: odd }.checked()
    }

    /// The same rates with one of them, named as in [`Rates::NAMES`], replaced.
    ///
    /// Errors if there is no such rate, if it is `nu`, or if `value` is outside (0, 2).
    pub fn with(mut self, name: &str, value: f64) -> Result<Self, RateError> {
        match name {
            "e" => self.e = value,
            "eps" => self.eps = value,
            "q" => self.q = value,
            "pi" => self.pi = value,
            "m" => self.m = value,
            "nu" => return Err(RateError::Stress),
            _ => return Err(RateError::Unknown { name: name.to_owned() }),
        }
        self.checked()
    }

    /// These rates if each lies in (0, 2), else an error that names the first that does not.
    pub fn checked(self) -> Result<Self, RateError> {
        let values = [self.e, self.eps, self.q, self.nu, self.pi, self.m];
        for (name, value) in Self::NAMES.into_iter().zip(values) {
            if !(value > 0.0 && value < 2.0) {
                return Err(RateError::Rate { name, value });
            }
        }
        Ok(self)
    }

    /// The relaxation time `tau = 1/s_nu`.
    pub fn tau(&self) -> f64 {
        1.0 / self.nu
    }

    /// The diagonal of `S-hat` (Eq. 3, corrected), in the order of [`crate::moments::NAMES`].
    #[rustfmt::skip]
    pub fn diagonal(&self) -> Moments {
        let Rates { e, eps, q, nu, pi, m } = *self;
        //rho  e  eps  jx   qx  jy   qy  jz   qz 3pxx 3pixx pww piww pxy pyz pxz mx my mz
        [0.0, e, eps, 0.0, q, 0.0, q, 0.0, q, nu, pi, nu, pi, nu, nu, nu, m, m, m]
    }
}

/// `tau` if it gives a positive, finite viscosity.
fn checked_tau(tau: f64) -> Result<f64, RateError> {
    if tau > 0.5 && tau.is_finite() { Ok(tau) } else { Err(RateError::Tau { tau }) }
}
