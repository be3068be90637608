//! Grains that are put down by a rule with a seed: random suspensions and settled beds.
//!
//! They are made anew when a run is resumed: the same seed gives the same bits.

use crate::packing::bed::{BedSides, SettledBed};
use crate::packing::periodic::PeriodicPacking;
use crate::packing::suspension::RandomSuspension;
use crate::packing::{Packing, PackingError};
use psmrt_reference::domain::Face;
use psmrt_reference::grains::grain::{Grain, sphere_volume};

use super::Trouble;
use super::contact_values::DEFAULT_FRICTION;
use super::listed::{Ball, Site, check_size, size_key};
use super::numbers::{absent, coefficient, count, needed, positive};
use crate::packing::{Amount, FOLLOWS, Grading, Sizes};
use crate::scene::format_grains::{GrainsSection, MotionKind};

/// Above this solid fraction random places run out: grains are pushed apart instead.
const DILUTE: f64 = 0.25;

/// Volume of spheres over that of the domain in their densest packing, rounded down.
const DENSEST: f64 = 0.74;

/// More grains are refused: a scene is read in seconds.
const MOST_GRAINS: usize = 1_000_000;

/// More grains are refused in a bed, which takes minutes then: `psmrt pack` makes it once.
const MOST_IN_BED: usize = 20_000;

/// A random suspension.
pub(super) fn random(section: &GrainsSection, place: &Site) -> Result<Vec<Ball>, Trouble> {
    let (at, si_lengths) = (&place.at, place.si_lengths());
    absent(&at("packing_friction"), section.packing_friction.as_ref(), "grains of kind `bed`")?;
    absent(&at("floor"), section.floor.as_ref(), "grains of kind `bed`")?;
    let seed = seed(section, place)?;
    let amount = match (section.count, section.solid_fraction) {
        (Some(number), None) => Amount::Count(whole(&at("count"), number, MOST_GRAINS)?),
        (None, Some(fraction)) if fraction > 0.0 && fraction < DENSEST => Amount::Volume {
            volume: fraction * si_lengths.iter().product::<f64>(),
            most: MOST_GRAINS,
        },
        (None, Some(_)) => {
            let problem = "it must lie between 0 and 0.74, the densest packing of equal spheres";
            return Err(Trouble::new(at("solid_fraction"), problem, "0.3 is dense, 0.6 a bed"));
        }
        (Some(_), Some(_)) => {
            let problem = "the section has both `count` and `solid_fraction`";
            return Err(Trouble::new(at("solid_fraction"), problem, "give one of them"));
        }
        (None, None) => {
            let problem = "it is missing: a suspension needs `count` or `solid_fraction`";
            return Err(Trouble::new(at("count"), problem, "add one of them"));
        }
    };
    let radii = radii(section, place, amount, seed)?;
    let gap = section.gap.unwrap_or(0.0);
    if !(gap >= 0.0 && gap.is_finite()) {
        let problem = "it must be finite and not negative";
        return Err(Trouble::new(at("gap"), problem, "give a length in m, or leave it out"));
    }
    let periodic: [bool; 3] = std::array::from_fn(|axis| place.domain.is_periodic(axis));
    let volume: f64 = radii.iter().map(|&radius| sphere_volume(radius)).sum();
    let dense = volume / si_lengths.iter().product::<f64>() > DILUTE;
    let packing = if dense && periodic == [true; 3] {
        let mean = radii.iter().sum::<f64>() / radii.len() as f64;
        let wanted = PeriodicPacking::new(si_lengths, radii, seed);
        PeriodicPacking { clearance: 0.5 * gap / mean, ..wanted }.make()
    } else {
        RandomSuspension { lengths: si_lengths, periodic, radii, gap, seed }.make()
    };
    balls(packing, place)
}

/// A settled bed on the face at z = 0.
pub(super) fn bed(section: &GrainsSection, place: &Site) -> Result<Vec<Ball>, Trouble> {
    let (at, si_lengths) = (&place.at, place.si_lengths());
    absent(&at("gap"), section.gap.as_ref(), "grains of kind `random`")?;
    let belongs = "grains of kind `array` and `random`; friction sets the density of a bed";
    absent(&at("solid_fraction"), section.solid_fraction.as_ref(), belongs)?;
    let seed = seed(section, place)?;
    let because = "a bed needs it";
    let number = needed(&at("count"), section.count, because, "add `count`, the number of grains")?;
    let number = whole(&at("count"), number, MOST_IN_BED)?;
    let radii = radii(section, place, Amount::Count(number), seed)?;
    let friction = section.packing_friction.unwrap_or(DEFAULT_FRICTION);
    coefficient(&at("packing_friction"), friction, "0 packs dense, 0.5 is usual for sand")?;
    let faces = place.domain.faces();
    if faces.axis(2)[0] == Face::Periodic {
        let problem = "a bed lies on the face z_low, which is periodic";
        return Err(Trouble::new(at("kind"), problem, "make z_low a wall, or use `random`"));
    }
    let sides = match [0, 1].map(|axis| place.domain.is_periodic(axis)) {
        [true, true] => BedSides::Periodic,
        [false, false] => BedSides::Walls,
        _ => {
            let problem = "a bed needs x and y both periodic or both not";
            let remedy = "change the faces, or make the bed with another code and read it as `csv`";
            return Err(Trouble::new(at("kind"), problem, remedy));
        }
    };
    let lengths = [si_lengths[0], si_lengths[1]];
    let floor = floor(section, place)?;
    let mut balls = balls(SettledBed { lengths, sides, radii, friction, seed }.make(), place)?;
    for ball in &mut balls {
        ball.si_centre[2] += floor;
    }
    let tops = balls.iter().map(|ball| ball.si_centre[2] + 0.5 * ball.si_diameter);
    let above = tops.fold(0.0, f64::max) - si_lengths[2];
    if floor > 0.0 && above > 0.0 {
        let problem = format!("the bed on it is {above:.4e} m higher than the domain");
        let remedy = format!("at most {:.4e}, or a higher domain, or fewer grains", floor - above);
        return Err(Trouble::new(at("floor"), problem, remedy));
    }
    Ok(balls)
}

/// Height of the floor of a bed above the face `z_low`, m.
fn floor(section: &GrainsSection, place: &Site) -> Result<f64, Trouble> {
    let (key, si_height) = ((place.at)("floor"), place.si_lengths()[2]);
    let floor = section.floor.unwrap_or(0.0);
    if !(0.0..si_height).contains(&floor) {
        let problem =
            format!("it must lie between 0 and the height of the domain, {si_height:.4e} m");
        return Err(Trouble::new(key, problem, "a diameter above a velocity inlet is enough"));
    }
    if floor > 0.0 && section.motion == MotionKind::Free {
        let problem = "free grains would fall from there: nothing holds them";
        return Err(Trouble::new(key, problem, "leave it out, or let the grains be `fixed`"));
    }
    Ok(floor)
}

fn seed(section: &GrainsSection, place: &Site) -> Result<u64, Trouble> {
    u64::try_from(section.seed.unwrap_or(1)).map_err(|_| {
        Trouble::new((place.at)("seed"), "it must be a whole number of at least 0", "try 1")
    })
}

fn whole(key: &str, given: i64, most: usize) -> Result<usize, Trouble> {
    let number = count(key, given)?;
    usize::try_from(number).ok().filter(|&number| number <= most).ok_or_else(|| {
        let remedy = "take fewer, or make them with `psmrt pack` and read them as `csv`";
        Trouble::new(key, format!("{most} is the limit"), remedy)
    })
}

/// Radii, m: all alike, evenly distributed over `diameter_range`, or by a sieve curve.
fn radii(
    section: &GrainsSection,
    place: &Site,
    amount: Amount,
    seed: u64,
) -> Result<Vec<f64>, Trouble> {
    let at = &place.at;
    let given = [
        ("diameter", section.diameter.is_some()),
        ("diameter_range", section.diameter_range.is_some()),
        ("grading", section.grading.is_some()),
        ("log_normal", section.log_normal.is_some()),
    ];
    let mut given = given.into_iter().filter(|(_, is_given)| *is_given).map(|(key, _)| key);
    let (first, second) = (given.next(), given.next());
    if let (Some(first), Some(second)) = (first, second) {
        let problem = format!("the section has both `{first}` and `{second}`");
        return Err(Trouble::new(at(second), problem, "give one of them"));
    }
    let grading = grading(section, place)?;
    let si_diameters = match (section.diameter, section.diameter_range, &grading) {
        (_, _, Some(grading)) => grading.diameters(),
        (Some(si_diameter), ..) => {
            positive(&at("diameter"), si_diameter, "m")?;
            [si_diameter; 2]
        }
        (None, Some([low, high]), _) => {
            if !(low > 0.0 && low <= high && high.is_finite()) {
                let problem = "it must be two lengths above 0, the smaller first";
                return Err(Trouble::new(at("diameter_range"), problem, "[1e-4, 2e-4], say"));
            }
            [low, high]
        }
        (None, None, None) => {
            let problem = "it is missing: these grains need `diameter`, `diameter_range`, `grading` or `log_normal`";
            return Err(Trouble::new(at("diameter"), problem, "add one of them, in m"));
        }
    };
    // Before any work: sizes and numbers out of all proportion would take for ever.
    let radius = 0.5 * si_diameters[0] / place.units.si_dx;
    check_size(&size_key(section, *at), radius, place)?;
    let si_volume: f64 = place.si_lengths().iter().product();
    if let Amount::Count(count) = amount
        && count as f64 * sphere_volume(0.5 * si_diameters[0]) > DENSEST * si_volume
    {
        let problem = "so many grains do not fit into the domain";
        return Err(Trouble::new(at("count"), problem, "take fewer or smaller grains"));
    }
    let radii = match grading {
        Some(grading) => match grading.radii(amount, seed) {
            Some((radii, scale)) if (scale - 1.0).abs() > FOLLOWS => {
                let problem = format!(
                    "{} grains do not follow so wide a curve: their diameters come out {:.0} % off",
                    radii.len(),
                    100.0 * (scale - 1.0).abs()
                );
                let remedy =
                    "take more grains or a larger domain, or cut the coarse end off the curve";
                return Err(Trouble::new(size_key(section, *at), problem, remedy));
            }
            found => found.map(|(radii, _)| radii),
        },
        None => Sizes { diameters: si_diameters, seed }.radii(amount),
    };
    radii.ok_or_else(|| {
        let key = if section.solid_fraction.is_some() { "solid_fraction" } else { "count" };
        let problem = format!("there would be no grain, or more than {MOST_GRAINS}");
        Trouble::new(at(key), problem, "change it, or the diameter")
    })
}

/// The sieve curve that a section gives, if it gives one.
fn grading(section: &GrainsSection, place: &Site) -> Result<Option<Grading>, Trouble> {
    let at = &place.at;
    if let Some(rows) = &section.grading {
        let points: Vec<(f64, f64)> =
            rows.iter().map(|&[diameter, finer]| (diameter, finer)).collect();
        let remedy = "rows [diameter (m), share of the mass that is finer], for example [[1e-4, 0], [2e-4, 0.4], [4e-4, 1]]";
        let made = Grading::new(&points);
        return made.map(Some).map_err(|problem| Trouble::new(at("grading"), problem, remedy));
    }
    let Some([median, deviation]) = section.log_normal else { return Ok(None) };
    let remedy = "[median diameter (m), factor of one standard deviation], for example [2e-4, 1.5]";
    let made = Grading::log_normal(median, deviation);
    made.map(Some).map_err(|problem| Trouble::new(at("log_normal"), problem, remedy))
}

fn balls(packing: Result<Packing, PackingError>, place: &Site) -> Result<Vec<Ball>, Trouble> {
    let packing = packing.map_err(|error| {
        let remedy = "change number, size, seed or domain; `psmrt pack` makes dense packings";
        Trouble::new((place.at)("kind"), error.to_string(), remedy)
    })?;
    let ball = |grain: &Grain| Ball::of(grain.position.into(), 2.0 * grain.radius);
    Ok(packing.grains.iter().map(ball).collect())
}
