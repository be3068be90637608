//! How free grains touch: from the `[contact]` section to laws in lattice units.
//!
//! Faces of the domain hold free grains: a wall is a plane with friction. A mirror plane is the contact with the grain's own
//! mirror image, which is twice as stiff and without friction; grains centred on it are halved only if all of them
//! are. Inlets and outlets act as sieves, so that no grain leaves the domain.

use psmrt_reference::grains::law::{ContactLaw, Friction, LawError, Rolling};
use psmrt_reference::grains::laws::Law;
use psmrt_reference::grains::motion::Substeps;

use super::contact_values::{
    Bodies, DEFAULT_FRICTION, DEFAULT_RESTITUTION, HUGE, LONGEST_DURATION, capped, trouble,
};
use super::numbers::{absent, coefficient, positive};
use super::{Trouble, hertz};
use crate::scene::format_free::ContactSection;
use crate::units::Units;

/// More sub-steps in a time step are refused: the contacts would last less than a hundredth of it.
pub(super) const MOST_SUBSTEPS: u32 = 2500;

/// Longest contact duration in time steps where a scene says nothing. The load of the fluid is held during a
/// step and the inertia of the fluid inside comes a step late: in a contact of several steps the fluid takes
/// part, and short ones cost sub-steps. Kempe & Fröhlich, J. Fluid Mech. 709, 445 (2012), stretch contacts
/// to ten steps for the same reason. Where weight or impacts would press grains too deep into each other
/// (`hardness.rs`), contacts are shorter: down to 0.03 steps they survive and end at the right overlap
/// (golden/stability/contact.csv).
pub const DEFAULT_DURATION: f64 = 10.0;

/// Tangential over normal stiffness that is accepted: far beyond any material on both sides (2/3 to 1 for
/// elastic spheres, by Mindlin), and short of what round-off makes of it.
const TANGENTIAL_RATIOS: std::ops::RangeInclusive<f64> = 0.001..=10.0;

/// The laws of a scene, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Laws {
    /// Between grains.
    pub grains: Law,
    /// Between a grain and a face: the same stiffness, and where a restitution is wanted the damping
    /// that gives it on a wall.
    pub walls: Law,
}

/// Errors unless the keys of the section go together.
pub(super) fn consistent(section: &ContactSection) -> Result<(), Trouble> {
    let key = |name: &str| format!("contact.{name}");
    hertz::consistent(section)?;
    if section.stiffness.is_none() {
        absent(&key("damping"), section.damping.as_ref(), "`stiffness`")?;
    }
    one_of(section.stiffness.is_some(), section.duration.is_some(), "stiffness", "duration")?;
    one_of(section.damping.is_some(), section.restitution.is_some(), "damping", "restitution")?;
    if section.friction == Some(0.0) {
        absent(&key("tangential_ratio"), section.tangential_ratio.as_ref(), "`friction` above 0")?;
    }
    for (name, value, usual) in [
        ("friction", section.friction, "0.5 is usual for sand"),
        ("rolling_resistance", section.rolling_resistance, "0.1 is usual for rounded sand"),
    ] {
        coefficient(&key(name), value.unwrap_or(0.0), usual)?;
    }
    match section.tangential_ratio {
        Some(ratio) if !TANGENTIAL_RATIOS.contains(&ratio) => {
            let (low, high) = (TANGENTIAL_RATIOS.start(), TANGENTIAL_RATIOS.end());
            let problem = format!("it must be positive, {low} to {high}");
            Err(Trouble::new(key("tangential_ratio"), problem, "2/7 = 0.2857 is usual"))
        }
        _ => Ok(()),
    }
}

/// The laws of a section whose keys go together.
pub(super) fn laws(
    section: &ContactSection,
    bodies: &Bodies,
    units: &Units,
) -> Result<Laws, Trouble> {
    if let Some(si_modulus) = section.youngs_modulus {
        let law = hertz::law(section, si_modulus, bodies, units)?.into();
        return Ok(Laws { grains: law, walls: law });
    }
    let key = |name: &str| format!("contact.{name}");
    // Two of the lightest have the reduced mass m/2, one against a wall has m.
    let pair = 0.5 * bodies.lightest;
    let restitution = section.restitution.unwrap_or(DEFAULT_RESTITUTION);
    let of_duration = |duration: f64| {
        ContactLaw::from_duration_and_restitution(duration, restitution, pair)
            .map(|law| law.stiffness)
            .map_err(|error| trouble(&error))
    };
    let stiffness = match (section.stiffness, section.duration) {
        (Some(si_stiffness), _) => {
            positive(&key("stiffness"), si_stiffness, "N/m")?;
            let softest = of_duration(LONGEST_DURATION)? * units.si_stiffness();
            if si_stiffness < softest {
                let problem = format!(
                    "it must be {:.2e} N/m or more: softer contacts last longer than {LONGEST_DURATION:.0e} time \
                     steps and hold nothing",
                    1.01 * softest
                );
                let remedy = "leave it out to have it chosen from weight and size";
                return Err(Trouble::new(key("stiffness"), problem, remedy));
            }
            capped(si_stiffness / units.si_stiffness())
        }
        (None, Some(si_duration)) => {
            positive(&key("duration"), si_duration, "s")?;
            let duration = si_duration / units.si_dt;
            if duration > LONGEST_DURATION {
                let problem = format!(
                    "it must be {:.2e} s or less ({LONGEST_DURATION:.0e} time steps): longer contacts hold nothing",
                    0.99 * LONGEST_DURATION * units.si_dt
                );
                let remedy = "leave it out to have it chosen from weight and size";
                return Err(Trouble::new(key("duration"), problem, remedy));
            }
            of_duration(duration.max(1.0 / HUGE.sqrt()))?
        }
        (None, None) => of_duration(DEFAULT_DURATION)?.max(bodies.weight_asks),
    };
    let law = |mass: f64| match section.damping {
        Some(si_damping) => ContactLaw::new(stiffness, capped(si_damping / units.si_damping())),
        None => ContactLaw::from_stiffness_and_restitution(stiffness, restitution, mass),
    };
    let both = |mass: f64| law(mass).and_then(|law| with_friction(law, section));
    let grains = both(pair).map_err(|error| trouble(&error))?;
    let walls = both(bodies.lightest).map_err(|error| trouble(&error))?;
    Ok(Laws { grains: grains.into(), walls: walls.into() })
}

/// The law with friction and rolling resistance.
fn with_friction(law: ContactLaw, section: &ContactSection) -> Result<ContactLaw, LawError> {
    let mut law = law;
    let coefficient = section.friction.unwrap_or(DEFAULT_FRICTION);
    if coefficient != 0.0 {
        law = law.with_friction(coefficient)?;
        if let (Some(friction), Some(ratio)) = (&mut law.friction, section.tangential_ratio) {
            let (stiffness, damping) = (ratio * law.stiffness, ratio * law.damping);
            *friction = Friction { stiffness, damping, ..*friction };
        }
    }
    match section.rolling_resistance {
        Some(coefficient) => law.with_rolling(coefficient),
        None => law.checked(),
    }
}

/// The law of a mirror plane: the contact of a grain with its own mirror image (exactly, but for a
/// rolling spring's turn about the normal, which a plane, having no angular velocity, takes to be half as fast).
pub(super) fn mirror(law: &Law) -> Law {
    match law {
        Law::Linear(law) => linear_mirror(law).into(),
        Law::Hertz(law) => hertz::mirror(law).into(),
    }
}

fn linear_mirror(law: &ContactLaw) -> ContactLaw {
    // The overlap with the image is twice that with the plane, and so is the speed of approach; the
    // two surfaces never slip. A couple per radian k_r (R/2)² (2 θ) is (k_r/2) R² θ; its limit
    // μ_r (R/2) F_n is (μ_r/2) R F_n.
    ContactLaw {
        stiffness: 2.0 * law.stiffness,
        damping: 2.0 * law.damping,
        friction: None,
        rolling: law.rolling.map(|rolling| Rolling {
            coefficient: 0.5 * rolling.coefficient,
            stiffness: 0.5 * rolling.stiffness,
            damping: 0.5 * rolling.damping,
        }),
    }
}

/// How the sub-steps are chosen.
pub(super) fn substeps(section: &ContactSection) -> Result<Substeps, Trouble> {
    let Some(given) = section.substeps else { return Ok(Substeps::Automatic) };
    match u32::try_from(given) {
        Ok(count @ 1..=MOST_SUBSTEPS) => Ok(Substeps::Fixed(count)),
        _ => {
            let problem = format!("it must be a whole number between 1 and {MOST_SUBSTEPS}");
            Err(Trouble::new("contact.substeps", problem, "leave it out to have it chosen"))
        }
    }
}

/// Errors if both of two keys are given that set the same thing.
fn one_of(first: bool, second: bool, name: &str, other: &str) -> Result<(), Trouble> {
    if !(first && second) {
        return Ok(());
    }
    let problem = format!("the section has both `{name}` and `{other}`, which set the same thing");
    Err(Trouble::new(format!("contact.{other}"), problem, "give one of them"))
}
