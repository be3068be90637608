//! How many sub-steps the contacts cost, and which key to blame if they are too many.

use psmrt_reference::grains::motion::{FEWEST_SUBSTEPS_PER_CONTACT, SUBSTEPS_PER_CONTACT};

use super::Trouble;
use super::contact::MOST_SUBSTEPS;
use super::maker::Maker;
use crate::scene::format_free::{ContactSection, LubricationSection};

/// The keys on which the number depends: where they stand, and their unit.
const KEYS: [(&str, &str); 7] = [
    ("contact.stiffness", " N/m"),
    ("contact.damping", " N s/m"),
    ("contact.duration", " s"),
    ("contact.restitution", ""),
    ("contact.tangential_ratio", ""),
    ("lubrication.smallest_gap", " m"),
    ("contact.youngs_modulus", " Pa"),
];

/// Place of `youngs_modulus` in [`KEYS`].
const MODULUS: usize = 6;

/// The two sections, with one key changed at a time.
#[derive(Clone)]
struct Keys {
    contact: ContactSection,
    lubrication: Option<LubricationSection>,
}

impl Keys {
    /// The key number `key` of [`KEYS`], if the section that it belongs to is there.
    fn key(&mut self, key: usize) -> Option<&mut Option<f64>> {
        let ContactSection {
            stiffness,
            damping,
            duration,
            restitution,
            tangential_ratio,
            youngs_modulus,
            ..
        } = &mut self.contact;
        let gap = self.lubrication.as_mut().map(|section| &mut section.smallest_gap);
        let all = [
            Some(stiffness),
            Some(damping),
            Some(duration),
            Some(restitution),
            Some(tangential_ratio),
            gap,
            Some(youngs_modulus),
        ];
        all.into_iter().nth(key).flatten()
    }

    /// The same with another value of a key.
    fn with(&self, key: usize, value: Option<f64>) -> Self {
        let mut changed = self.clone();
        if let Some(place) = changed.key(key) {
            *place = value;
        }
        changed
    }

    /// The same with a key that is not to blame: absent, but for a modulus, without which contacts would be others.
    fn relieved(&self, key: usize, maker: &Maker) -> Self {
        self.with(key, if key == MODULUS { self.soft_modulus(maker) } else { None })
    }

    /// A modulus with which contacts are twice as long as they must be, Pa: times go as its root.
    fn soft_modulus(&self, maker: &Maker) -> Option<f64> {
        let (setup, _) = maker.make(&self.contact, self.lubrication.as_ref()).ok()?;
        let si_modulus = setup.law.hertz()?.material.youngs_modulus * maker.units.si_pressure();
        let affordable = SUBSTEPS_PER_CONTACT / f64::from(MOST_SUBSTEPS);
        Some(si_modulus * (0.5 * self.shortest_time(maker) / affordable).powi(2))
    }

    /// The shortest time that sub-steps must resolve, time steps; for ever if a value cannot be used.
    fn shortest_time(&self, maker: &Maker) -> f64 {
        let made = maker.make(&self.contact, self.lubrication.as_ref());
        made.map_or(f64::INFINITY, |(setup, planes)| setup.shortest_time(maker.grains, &planes))
    }

    /// Whether few enough sub-steps resolve it.
    fn is_affordable(&self, maker: &Maker) -> bool {
        self.shortest_time(maker) * f64::from(MOST_SUBSTEPS) >= SUBSTEPS_PER_CONTACT
    }

    /// The value of a key that the section leaves to us, in SI units.
    fn default_of(&self, key: usize, maker: &Maker) -> Option<f64> {
        if key == MODULUS {
            return self.soft_modulus(maker);
        }
        let absent = self.with(key, None);
        let (setup, _) = maker.make(&absent.contact, absent.lubrication.as_ref()).ok()?;
        let units = maker.units;
        let pair = 0.5 * maker.bodies.lightest;
        Some(match key {
            0 => setup.law.linear()?.stiffness * units.si_stiffness(),
            1 => setup.law.linear()?.damping * units.si_damping(),
            2 => setup.law.linear()?.duration(pair) * units.si_dt,
            3 => super::contact_values::DEFAULT_RESTITUTION,
            4 => 2.0 / 7.0,
            _ => setup.lubrication?.smallest_gap * units.si_dx,
        })
    }
}

/// Errors if the contacts need too many sub-steps, or the scene gives too few.
pub(super) fn check(
    maker: &Maker,
    contact: &ContactSection,
    lubrication: Option<&LubricationSection>,
) -> Result<(), Trouble> {
    let keys = Keys { contact: contact.clone(), lubrication: lubrication.cloned() };
    if !keys.is_affordable(maker) {
        return Err(too_many(&keys, maker));
    }
    let fewest = (FEWEST_SUBSTEPS_PER_CONTACT / keys.shortest_time(maker)).ceil().max(1.0);
    match contact.substeps {
        Some(given) if (given as f64) < fewest => {
            let problem = format!(
                "the sub-steps would be too long: the shortest contact takes {:.3} time steps and needs \
                 {FEWEST_SUBSTEPS_PER_CONTACT} sub-steps or more",
                keys.shortest_time(maker)
            );
            let remedy = format!(
                "give {fewest} sub-steps or more, or leave `substeps` out: it is chosen then"
            );
            Err(Trouble::new("contact.substeps", problem, remedy))
        }
        _ => Ok(()),
    }
}

/// Blames the key without which there would be fewest.
fn too_many(keys: &Keys, maker: &Maker) -> Trouble {
    let given = |key: usize| keys.clone().key(key).and_then(|value| *value);
    let without = |key: &usize| keys.relieved(*key, maker).shortest_time(maker);
    let blamed = (0..KEYS.len())
        .filter(|&key| given(key).is_some())
        .filter(|key| keys.relieved(*key, maker).is_affordable(maker))
        .max_by(|one, two| without(one).total_cmp(&without(two)));
    let found = blamed.and_then(|key| Some((key, given(key)?, keys.default_of(key, maker)?)));
    let Some((key, value, good)) = found else { return heavy(keys, maker) };
    // On a logarithmic scale: the values may lie three hundred orders of magnitude apart.
    let (mut bad, mut good) = (value.ln(), good.ln());
    for _ in 0..60 {
        let middle = 0.5 * (bad + good);
        let is_good = keys.with(key, Some(middle.exp())).is_affordable(maker);
        if is_good { good = middle } else { bad = middle }
    }
    let ((name, unit), limit) = (KEYS[key], good.exp());
    // One percent off the limit, so that the figure that is shown works too.
    let range = match bad > good {
        true => format!("{:.2e}{unit} or less", 0.99 * limit),
        false => format!("{:.2e}{unit} or more", 1.01 * limit),
    };
    let problem = format!(
        "a time step would need more than {MOST_SUBSTEPS} sub-steps; it must be {range} (with the other keys as \
         they are)"
    );
    let remedy = match key {
        MODULUS => {
            "use a softer modulus: little changes as long as overlaps stay below 1 % of a diameter; or a shorter time step"
        }
        _ => "leave it out to have it chosen, or keep to that range",
    };
    Trouble::new(name, problem, remedy)
}

/// No single key is to blame: weight or impacts ask for it.
fn heavy(keys: &Keys, maker: &Maker) -> Trouble {
    let (short, units) = (keys.shortest_time(maker) / SUBSTEPS_PER_CONTACT, maker.units);
    let factor = short * f64::from(MOST_SUBSTEPS);
    let law = maker.make(&keys.contact, keys.lubrication.as_ref()).map(|(setup, _)| setup.law);
    if law.as_ref().is_ok_and(|law| law.hertz().is_some()) {
        let problem = format!(
            "a time step would take {:.0} sub-steps; {MOST_SUBSTEPS} is the limit",
            1.0 / short
        );
        let si_dt = 0.98 * factor * units.si_dt;
        return Trouble::new(
            "contact",
            problem,
            format!("shorten the time step to {si_dt:.2e} s or less"),
        );
    }
    let stiffness = law.ok().and_then(|law| law.linear().map(|law| law.stiffness));
    let si_stiffness = stiffness.unwrap_or(0.0) * units.si_stiffness();
    let problem = format!(
        "the grains need contacts so stiff ({si_stiffness:.2e} N/m, from weight and size of the heaviest and the \
         smallest) that a time step takes {:.0} sub-steps; {MOST_SUBSTEPS} is the limit",
        1.0 / short
    );
    let remedy = format!(
        "shorten the time step to {:.2e} s or less, or accept that grains are pressed {:.1} times as deep into \
         each other: [contact] stiffness = {:.2e}",
        0.98 * factor * units.si_dt,
        1.02 / (factor * factor),
        0.97 * factor * factor * si_stiffness
    );
    Trouble::new("contact", problem, remedy)
}
