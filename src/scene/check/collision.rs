//! The collision and its rates.

use psmrt_reference::collision::Collision;
use psmrt_reference::rates::Rates;

use super::Trouble;
use super::numbers::{absent, needed};
use crate::scene::format::{CollisionModel, CollisionSection, RatesName};

/// The collision at relaxation time `tau`.
pub(super) fn collision(section: &CollisionSection, tau: f64) -> Result<Collision, Trouble> {
    let CollisionSection { model, rates, magic, .. } = section;
    let single = [
        ("e", section.s_e),
        ("eps", section.s_eps),
        ("q", section.s_q),
        ("pi", section.s_pi),
        ("m", section.s_m),
    ];
    if *model == CollisionModel::Srt {
        let belongs = "`model = \"mrt\"`";
        absent("collision.rates", rates.as_ref(), belongs)?;
        absent("collision.magic", magic.as_ref(), belongs)?;
        for (name, value) in single {
            absent(&format!("collision.s_{name}"), value.as_ref(), belongs)?;
        }
        return Ok(Collision::Srt { tau });
    }
    let preset = rates.unwrap_or_default();
    if preset != RatesName::Magic {
        absent("collision.magic", magic.as_ref(), "`rates = \"magic\"`")?;
    }
    let (key, built) = match preset {
        RatesName::Dhumieres => ("collision.rates", Rates::dhumieres(tau)),
        RatesName::Srt => ("collision.rates", Rates::srt(tau)),
        RatesName::Magic => {
            let remedy = "add `magic = 0.1875` (3/16: plane walls exact) or 0.25 (stability)";
            let magic = needed("collision.magic", *magic, "`rates = \"magic\"` needs it", remedy)?;
            ("collision.magic", Rates::magic(tau, magic))
        }
    };
    let remedy = "take a preset, or a value such as 1.2";
    let mut rates =
        built.map_err(|error| Trouble::new(key, error.to_string(), "try 0.1875 (3/16)"))?;
    for (name, value) in single {
        if let Some(value) = value {
            rates = rates.with(name, value).map_err(|error| {
                Trouble::new(format!("collision.s_{name}"), error.to_string(), remedy)
            })?;
        }
    }
    Ok(Collision::Mrt { rates })
}
