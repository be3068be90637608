//! Contacts of elastic spheres: from `youngs_modulus` and `poisson_ratio` of `[contact]` to laws in lattice units.

use psmrt_reference::grains::hertz::{Elastic, HertzLaw, RollingShare};
use psmrt_reference::grains::law::LawError;

use super::Trouble;
use super::contact_values::{
    Bodies, DEFAULT_FRICTION, DEFAULT_RESTITUTION, LONGEST_DURATION, capped, trouble,
};
use super::numbers::{absent, positive};
use crate::scene::format_free::ContactSection;
use crate::units::Units;

/// Poisson's ratio where a scene says nothing: in the middle of what most solids have (0.2 to 0.4). Overlaps change by less
/// than a tenth over that range.
const DEFAULT_POISSON_RATIO: f64 = 0.3;

/// Errors unless the keys of the section go together.
pub(super) fn consistent(section: &ContactSection) -> Result<(), Trouble> {
    if section.youngs_modulus.is_none() {
        let ratio = section.poisson_ratio.as_ref();
        return absent("contact.poisson_ratio", ratio, "`youngs_modulus`");
    }
    let linear = [
        ("stiffness", section.stiffness),
        ("damping", section.damping),
        ("duration", section.duration),
        ("tangential_ratio", section.tangential_ratio),
    ];
    let Some((name, _)) = linear.into_iter().find(|(_, value)| value.is_some()) else {
        return Ok(());
    };
    let problem = format!(
        "`{name}` belongs to linear contacts, and `youngs_modulus` makes contacts those of elastic spheres (Hertz and \
         Mindlin), in which it follows from modulus, Poisson's ratio, sizes, overlap and restitution"
    );
    let remedy = format!("remove `{name}`, or remove `youngs_modulus` for linear contacts");
    Err(Trouble::new(format!("contact.{name}"), problem, remedy))
}

/// The law of a section that gives `si_modulus`, between grains and between a grain and a wall of the same material alike.
pub(super) fn law(
    section: &ContactSection,
    si_modulus: f64,
    bodies: &Bodies,
    units: &Units,
) -> Result<HertzLaw, Trouble> {
    positive("contact.youngs_modulus", si_modulus, "Pa")?;
    let material = Elastic {
        youngs_modulus: capped(si_modulus / units.si_pressure()),
        poisson_ratio: section.poisson_ratio.unwrap_or(DEFAULT_POISSON_RATIO),
    };
    let restitution = section.restitution.unwrap_or(DEFAULT_RESTITUTION);
    let law = made(section, material, restitution).map_err(|error| trouble(&error))?;
    // Two of the lightest, pressed into each other as deep as sub-steps resolve. It goes as 1/√E.
    let (radius, mass) = (bodies.radius_of_lightest, bodies.lightest);
    let longest = law.shortest_time(radius, 0.5 * radius, 0.5 * mass);
    if longest > LONGEST_DURATION {
        let problem = format!(
            "it must be {:.2e} Pa or more: softer contacts last longer than {LONGEST_DURATION:.0e} time steps and hold \
             nothing",
            1.01 * si_modulus * (longest / LONGEST_DURATION).powi(2)
        );
        let remedy = "give the modulus in Pa, or leave it out for linear contacts";
        return Err(Trouble::new("contact.youngs_modulus", problem, remedy));
    }
    Ok(law)
}

fn made(
    section: &ContactSection,
    material: Elastic,
    restitution: f64,
) -> Result<HertzLaw, LawError> {
    let mut law = HertzLaw::between([material, material], restitution)?;
    let coefficient = section.friction.unwrap_or(DEFAULT_FRICTION);
    if coefficient != 0.0 {
        law = law.with_friction(coefficient)?;
    }
    match section.rolling_resistance {
        Some(coefficient) => law.with_rolling(coefficient),
        None => Ok(law),
    }
}

/// The law of a mirror plane, as [`super::contact::mirror`].
pub(super) fn mirror(law: &HertzLaw) -> HertzLaw {
    // The grain and its image: δ' = 2 δ and R' = R/2, so F = (4/3) E* √(R/2) (2 δ)^(3/2) = 2 (4/3) E* √R δ^(3/2): a rigid
    // plane. The springs' stiffness is twice that of the pair, of which rolling keeps half: see there.
    HertzLaw {
        modulus: 2.0 * law.modulus,
        shear_modulus: 2.0 * law.shear_modulus,
        friction: None,
        rolling: law.rolling.map(|RollingShare { coefficient, share }| RollingShare {
            coefficient: 0.5 * coefficient,
            share: 0.25 * share,
        }),
        ..*law
    }
}
