//! What contacts of both laws need: defaults and limits, the bodies that they are made for, and the key to blame.

use psmrt_reference::grains::law::LawError;

use super::Trouble;

/// Longest contact duration that is accepted, time steps: longer ones hold nothing.
pub(super) const LONGEST_DURATION: f64 = 1e6;

/// Restitution where a scene says nothing. Grains that settle at Stokes numbers below 10 do not
/// rebound in a liquid, whatever they do in vacuum (Gondret, Lance & Petit, Phys. Fluids 14, 643
/// (2002)): the fluid takes the energy. What the dashpot takes serves resting contacts, which are calm
/// after a few durations.
pub const DEFAULT_RESTITUTION: f64 = 0.5;

/// Friction where a scene says nothing: tan 27°, in the middle of what Rowe, Proc. R. Soc. A 269, 500
/// (1962), measured for quartz grains under water (22° to 31°).
pub const DEFAULT_FRICTION: f64 = 0.5;

/// Beyond all stiffness and damping that sub-steps could resolve, and far from overflow.
pub(super) const HUGE: f64 = 1e200;

/// A value that does not overflow in what is made of it: `effort.rs` refuses it then.
pub(super) fn capped(value: f64) -> f64 {
    if value > HUGE { HUGE } else { value }
}

/// What the laws are made for, lattice units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bodies {
    /// Mass of the lightest free grain.
    pub lightest: f64,
    /// Its radius.
    pub radius_of_lightest: f64,
    /// Stiffness that weight and impacts ask for; 0 without gravity.
    pub weight_asks: f64,
}

/// The key to blame for a law that cannot be used.
pub(super) fn trouble(error: &LawError) -> Trouble {
    let LawError::BadValue { key, allowed, .. } = error;
    let (name, remedy) = match *key {
        "Young's modulus" => ("youngs_modulus", "give a modulus in Pa above 0"),
        "Poisson's ratio" => ("poisson_ratio", "0.3 is usual"),
        "restitution" => ("restitution", "0.5 is usual for grains in water, 0.9 for dry glass"),
        "contact duration" => ("duration", "give a time in s, some time steps long"),
        "stiffness" => ("stiffness", "give a stiffness in N/m above 0, or `duration`"),
        "damping" => ("damping", "give a damping in N s/m, or `restitution`"),
        "friction coefficient" => ("friction", "0.5 is usual for sand"),
        "tangential stiffness" => ("tangential_ratio", "2/7 = 0.2857 is usual"),
        "tangential damping" => ("tangential_ratio", "2/7 = 0.2857 is usual"),
        "rolling coefficient" => ("rolling_resistance", "0.1 is usual for rounded sand"),
        _ => return Trouble::new("contact", error.to_string(), "change the value"),
    };
    Trouble::new(format!("contact.{name}"), format!("it {allowed}"), remedy)
}
