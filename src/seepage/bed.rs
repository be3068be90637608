//! Where the grains of a scene lie densest: a bed with clear fluid above it is as tight as the bed, not as
//! the domain.
//!
//! Along an axis the solid fraction is averaged over slabs as thick as the largest grain. The bed is the
//! stretch around the fullest slab in which such slabs hold at least half as much; it is found along one axis
//! after the other, first along that which tells most. The solid fraction is exact along the axis; what a
//! second axis cuts off a grain is taken to be the same at every height.

use std::f64::consts::PI;

use psmrt_reference::setup::Setup;
use psmrt_reference::solids::Solid;

use crate::scene::Scene;

use super::spheres::{has_image, share_of, solid_fraction, spheres, spheres_of, volume};

/// A bed that is told from its domain has at least this solid fraction: looser grains are a cloud, whose drag
/// does not depend much on how they lie.
pub(crate) const DENSE: f64 = 0.3;

/// It holds the volume of so many of its largest grain, or it is a few that touch.
const FEWEST: f64 = 4.0;

/// It is so much denser than the domain, or the domain is the bed.
const DENSER: f64 = 1.05;

/// A slab is looked at every so many of its thickness.
const EVERY: f64 = 0.125;

/// A part of the domain that holds a bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bed {
    /// Solid fraction.
    pub fraction: f64,
    /// From where to where along each axis, cells; over an end of a periodic domain it goes on at the other.
    pub reaches: [[f64; 2]; 3],
}

/// A sphere as a bed sees it.
struct Part {
    centre: [f64; 3],
    radius: f64,
    /// Share of it that lies within the bed along the axes that are done.
    share: f64,
}

impl Part {
    fn new(solid: &Solid, radius: f64, share: f64) -> Self {
        Part { centre: solid.centre.into(), radius, share }
    }
}

/// The bed of a scene, if its grains are dense somewhere and the domain is not as dense everywhere.
pub(crate) fn bed(scene: &Scene) -> Option<Bed> {
    let domain = &scene.setup.domain;
    let cells = domain.cells().map(|n| n as f64);
    let part = |(solid, radius, _): (&Solid, f64, f64)| Part::new(solid, radius, 1.0);
    let mut parts: Vec<Part> = spheres(scene).into_iter().map(part).collect();
    let largest = largest_of(&parts);
    if largest == 0.0 {
        return None;
    }
    let mut reaches = cells.map(|length| [0.0, length]);
    let mut left = vec![0, 1, 2];
    while !left.is_empty() {
        let found = left.iter().map(|&axis| {
            let is_periodic = domain.is_periodic(axis);
            (axis, stretch(&parts, axis, (cells[axis], is_periodic), 2.0 * largest))
        });
        let shortest = found.min_by(|a, b| {
            let share = |(axis, [low, high]): &(usize, [f64; 2])| (high - low) / cells[*axis];
            share(a).total_cmp(&share(b))
        });
        let Some((axis, [low, high])) = shortest else { break };
        let length = domain.is_periodic(axis).then_some(cells[axis]);
        for part in &mut parts {
            part.share *= within(part, axis, [low, high], length);
        }
        reaches[axis] = [low, high];
        left.retain(|&other| other != axis);
    }
    let volume: f64 = parts.iter().map(|part| part.share * sphere(part.radius)).sum();
    let fraction = volume / reaches.iter().map(|[low, high]| high - low).product::<f64>();
    let is_bed = is_told(volume, fraction, (largest, solid_fraction(scene)));
    is_bed.then_some(Bed { fraction, reaches })
}

/// Whether grains of this volume and solid fraction are a bed in a domain with the largest grain and the solid fraction
/// that follow.
fn is_told(volume: f64, fraction: f64, (largest, whole): (f64, f64)) -> bool {
    fraction >= DENSE && volume >= FEWEST * sphere(largest) && fraction > DENSER * whole
}

/// The stretch of an axis that a bed fills from side to side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layer {
    /// From where to where, cells; over an end of a periodic domain it goes on at the other.
    pub reach: [f64; 2],
    /// Solid fraction there.
    pub fraction: f64,
    /// Whether it is told from the domain: if not, the domain is the bed.
    pub is_told: bool,
}

/// The bed of a set-up along one axis, with the grains where they are now and over the whole cross-section; the domain
/// where no bed is told from it. An image is a bed from its first to its last solid; along a periodic axis it is the domain.
pub(crate) fn layer(setup: &Setup, axis: usize) -> Layer {
    let domain = &setup.domain;
    if has_image(setup) {
        return layer_of_image(setup, axis);
    }
    let cells = domain.cells().map(|n| n as f64);
    let part = |(solid, radius, share): (&Solid, f64, f64)| Part::new(solid, radius, share);
    let parts: Vec<Part> = spheres_of(setup).into_iter().map(part).collect();
    let [largest, length] = [largest_of(&parts), cells[axis]];
    let section = cells.iter().product::<f64>() / length;
    let periodic = domain.is_periodic(axis);
    let image = periodic.then_some(length);
    let volume_within = |reach: [f64; 2]| -> f64 {
        let inside = |part: &Part| part.share * within(part, axis, reach, image);
        parts.iter().map(|part| inside(part) * sphere(part.radius)).sum()
    };
    let all = parts.iter().map(|part| part.share * sphere(part.radius)).sum::<f64>();
    let whole = all / section / length;
    let reach = stretch(&parts, axis, (length, periodic), 2.0 * largest);
    let volume = volume_within(reach);
    let fraction = volume / section / (reach[1] - reach[0]);
    if largest > 0.0 && is_told(volume, fraction, (largest, whole)) {
        return Layer { reach, fraction, is_told: true };
    }
    Layer { reach: [0.0, length], fraction: whole, is_told: false }
}

fn layer_of_image(setup: &Setup, axis: usize) -> Layer {
    let domain = &setup.domain;
    let length = domain.cells()[axis] as f64;
    if domain.is_periodic(axis) {
        // It repeats, and where it begins says nothing.
        return Layer {
            reach: [0.0, length],
            fraction: volume(setup) / domain.cell_count() as f64,
            is_told: false,
        };
    }
    let section = domain.cell_count() as f64 / length;
    let solids = setup.solid_phase.iter().flat_map(|phase| &phase.solids);
    let reaches = solids.filter_map(|solid| solid.bounds(domain));
    let [low, high] = reaches.fold([length, 0.0], |[low, high], [from, to]| {
        [from[axis].max(0.0).min(low), to[axis].min(length).max(high)]
    });
    let is_told = high - low < length;
    let reach = if low < high { [low, high] } else { [0.0, length] };
    Layer { reach, fraction: volume(setup) / section / (reach[1] - reach[0]), is_told }
}

fn largest_of(parts: &[Part]) -> f64 {
    parts.iter().map(|part| part.radius).fold(0.0, f64::max)
}

fn sphere(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

/// The same of a grain; where the axis is periodic also that of its images.
fn within(part: &Part, axis: usize, planes: [f64; 2], length: Option<f64>) -> f64 {
    let share = |centre: f64| share_of(part.radius, centre, planes);
    let centre = part.centre[axis];
    match length {
        Some(length) => [-1.0, 0.0, 1.0].iter().map(|times| share(centre + times * length)).sum(),
        None => share(centre),
    }
}

/// The stretch of an axis in which slabs of a thickness are at least half as full as the fullest.
fn stretch(
    parts: &[Part],
    axis: usize,
    (length, is_periodic): (f64, bool),
    thickness: f64,
) -> [f64; 2] {
    let whole = [0.0, length];
    if length <= thickness {
        return whole;
    }
    // Slabs around points from end to end; at a closed end they lie against it.
    let [first, last] =
        if is_periodic { whole } else { [0.5 * thickness, length - 0.5 * thickness] };
    let count = ((last - first) / (EVERY * thickness)).ceil().max(1.0);
    let step = (last - first) / count;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
    let mut filled = vec![0.0; count as usize + 1];
    let point = |number: usize| first + number as f64 * step;
    for part in parts {
        let reach = 0.5 * thickness + part.radius;
        for image in if is_periodic { vec![-length, 0.0, length] } else { vec![0.0] } {
            let centre = part.centre[axis] + image;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "not below 0"
            )]
            let from = ((centre - reach - first) / step).max(0.0) as usize;
            for (number, volume) in filled.iter_mut().enumerate().skip(from) {
                let slab = [-0.5, 0.5].map(|half| point(number) + half * thickness);
                if slab[0] > centre + part.radius {
                    break;
                }
                *volume += part.share * sphere(part.radius) * share_of(part.radius, centre, slab);
            }
        }
    }
    let Some(top) = (0..filled.len()).max_by(|&a, &b| filled[a].total_cmp(&filled[b])) else {
        return whole;
    };
    let half = 0.5 * filled[top];
    if filled.iter().all(|&volume| volume >= half) {
        return whole;
    }
    // Where the filling falls through the half, between two points; `None` at a closed end.
    let edge = |way: isize| -> Option<f64> {
        let count = isize::try_from(filled.len()).ok()?;
        let mut at = isize::try_from(top).ok()?;
        for gone in 0..count {
            let mut next = at + way;
            if is_periodic {
                // The last point is the first again.
                next = if next < 0 { count - 2 } else { next % (count - 1) };
            } else if next < 0 || next >= count {
                return None;
            }
            let [here, there] = [at, next].map(|i| usize::try_from(i).unwrap_or(0));
            if filled[there] < half {
                let share = (filled[here] - half) / (filled[here] - filled[there]);
                return Some(step * (gone as f64 + share));
            }
            at = next;
        }
        None
    };
    let [low, high] = [edge(-1), edge(1)];
    [low.map_or(0.0, |gone| point(top) - gone), high.map_or(length, |gone| point(top) + gone)]
}
