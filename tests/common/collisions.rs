//! The collisions that the tests compare.

use psmrt_reference::collision::Collision;
use psmrt_reference::rates::Rates;

/// Single relaxation time.
pub fn srt(tau: f64) -> Collision {
    Collision::Srt { tau }
}

/// MRT with d'Humières' rates, the default of scenes.
pub fn dhumieres(tau: f64) -> Collision {
    Collision::Mrt { rates: Rates::dhumieres(tau).unwrap() }
}

/// MRT with two relaxation times and the parameter Λ = `magic`.
pub fn magic(tau: f64, magic: f64) -> Collision {
    Collision::Mrt { rates: Rates::magic(tau, magic).unwrap() }
}
