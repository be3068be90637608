//! Packings to start from: a settled bed ([`bed`]), a periodic random packing at a wanted porosity
//! ([`periodic`]) and a dilute random suspension ([`suspension`]), each from a seed, and what can be
//! said of them.
//!
//! How many grains, and of which sizes, say `sizes.rs` and, by a sieve curve, `grading.rs`. The same seed gives the same packing, to the last bit, on any number of threads.

pub mod bed;
mod grading;
pub mod periodic;
mod sizes;
pub mod suspension;

pub use grading::{FOLLOWS, Grading, passing_diameter};
pub use sizes::{Amount, Sizes};

use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::law::LawError;
use psmrt_reference::grains::neighbours::candidates;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainError, PeriodicBox};
use std::f64::consts::PI;
use thiserror::Error;

/// Grains closer than this fraction of their mean diameter are counted as touching.
pub const TOUCHING: f64 = 1e-3;

/// What can be said of a packing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackingReport {
    /// Void volume over volume: of a periodic domain all of it, of a bed its middle half.
    pub porosity: f64,
    /// Mean number of grains that a grain touches: gap below [`TOUCHING`]. Grains that touch none
    /// count, planes do not.
    pub coordination: f64,
    /// Largest overlap, as a fraction of the mean diameter of the two grains (of the grain's, on a
    /// plane); 0 if there is none.
    pub largest_overlap: f64,
}

/// A packing: grains at rest, of density 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Packing {
    /// The grains.
    pub grains: Vec<Grain>,
    /// The periodic axes.
    pub sides: PeriodicBox,
    /// Floor and walls.
    pub planes: Vec<Plane>,
    /// What can be said of it.
    pub report: PackingReport,
}

/// A packing that cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PackingError {
    /// A value out of its range.
    #[error("packing: {key} = {value} {allowed}")]
    BadValue {
        /// Name of the value.
        key: &'static str,
        /// The value as given.
        value: f64,
        /// What is allowed, and what to do.
        allowed: &'static str,
    },
    /// The grains cannot be moved.
    #[error(transparent)]
    Grains(#[from] GrainError),
    /// The contact law.
    #[error(transparent)]
    Law(#[from] LawError),
    /// The grains still overlap.
    #[error(
        "a porosity of {porosity:.4} was not reached: after {substeps} sub-steps grains still overlap \
         by {overlap:.2e} of a diameter, {allowed:.2e} is allowed; spheres of these sizes jam at random near \
         {jams_at:.3} (a few grains scatter by some 0.01 about it): raise the porosity (enlarge the box, take \
         fewer or smaller grains), try another seed or allow more overlap"
    )]
    Jammed {
        /// Porosity that was wanted.
        porosity: f64,
        /// Largest overlap left, fraction of a diameter.
        overlap: f64,
        /// Largest overlap allowed.
        allowed: f64,
        /// Sub-steps made.
        substeps: u32,
        /// Porosity at which spheres of these sizes jam.
        jams_at: f64,
    },
    /// No place was found.
    #[error(
        "{placed} of {wanted} grains found a place, the next one did not: random places run out near a \
         solid fraction of 0.3; take fewer or smaller grains, a smaller gap or a larger box"
    )]
    Crowded {
        /// Grains that found a place.
        placed: usize,
        /// Grains that were wanted.
        wanted: usize,
    },
    /// The bed still moves.
    #[error(
        "the bed has not come to rest after {substeps} sub-steps: its kinetic energy per grain is \
         still {energy:.2e} of weight times diameter; try another seed or more friction"
    )]
    Restless {
        /// Kinetic energy per grain over `m g d`.
        energy: f64,
        /// Sub-steps made.
        substeps: u32,
    },
}

/// Porosity of grains that lie, without overlap, in a volume.
pub fn porosity(radii: &[f64], volume: f64) -> f64 {
    // n = 1 - Σ (4/3) π R³ / V
    1.0 - radii.iter().map(|&radius| sphere_volume(radius)).sum::<f64>() / volume
}

/// Porosity at which spheres of these radii jam at random. A spread of sizes packs denser, the more so if few
/// large ones lie among many small ones.
///
/// Source: Desmond & Weeks, Phys. Rev. E 90, 022204 (2014), with the polydispersity `δ` (standard deviation
/// over mean of the radii) and the skewness `S`. For equal spheres and for as many of radius 1 as of 1.4 it
/// agrees with O'Hern et al., Phys. Rev. E 68, 011306 (2003), within 0.005 (0.639 and 0.648).
pub fn jamming_porosity(radii: &[f64]) -> f64 {
    let count = radii.len() as f64;
    let mean = radii.iter().sum::<f64>() / count;
    let moment = |power: i32| {
        radii.iter().map(|radius| (radius / mean - 1.0).powi(power)).sum::<f64>() / count
    };
    let delta = moment(2).sqrt();
    // S δ² = <(R - <R>)³>/(<R>³ δ)
    let skewed = if delta > 0.0 { moment(3) / delta } else { 0.0 };
    // φ = 0.634 + 0.0658 δ + 0.0857 S δ²
    1.0 - (0.634 + 0.0658 * delta + 0.0857 * skewed)
}

/// The number of equal spheres with which a volume comes closest to `porosity`.
pub fn count_for(porosity: f64, radius: f64, volume: f64) -> f64 {
    ((1.0 - porosity) * volume / sphere_volume(radius)).round()
}

/// The radius at which `count` equal spheres give a volume exactly this `porosity`.
pub fn radius_for(porosity: f64, count: usize, volume: f64) -> f64 {
    ((1.0 - porosity) * volume / (count as f64 * sphere_volume(1.0))).cbrt()
}

/// Errors unless there are radii and all are positive and finite.
fn check_radii(radii: &[f64]) -> Result<(), PackingError> {
    let bad = |key, value, allowed| Err(PackingError::BadValue { key, value, allowed });
    if radii.is_empty() {
        return bad("number of grains", 0.0, "must be at least 1");
    }
    match radii.iter().find(|&&radius| !(radius > 0.0 && radius.is_finite())) {
        Some(&radius) => bad("radius", radius, "must be positive and finite"),
        None => Ok(()),
    }
}

/// Mean number of neighbours within [`TOUCHING`], and the largest overlap, as [`PackingReport`] has them.
pub fn contacts(grains: &[Grain], sides: &PeriodicBox, planes: &[Plane]) -> (f64, f64) {
    // Looks a little further than needed: the reach must suit grains of all sizes.
    let largest = grains.iter().map(|grain| grain.radius).fold(0.0, f64::max);
    let overlap_of = |one: &Grain, two: &Grain, image| {
        let distance = sides.offset(&one.position, &two.position, image).norm();
        1.0 - distance / (one.radius + two.radius)
    };
    let (mut touching, mut worst) = (0, 0.0_f64);
    for pair in candidates(grains, sides, 2.0 * TOUCHING * largest) {
        let (one, two) = (&grains[pair.first as usize], &grains[pair.second as usize]);
        let overlap = overlap_of(one, two, pair.image);
        worst = worst.max(overlap);
        touching += usize::from(overlap > -TOUCHING);
    }
    for grain in grains {
        for plane in planes {
            worst = worst.max(0.5 * (1.0 - plane.height(&grain.position) / grain.radius));
        }
    }
    (2.0 * touching as f64 / grains.len() as f64, worst)
}

/// Volume of the part of a sphere between the heights `low` and `high` above its centre.
fn slice_volume(radius: f64, low: f64, high: f64) -> f64 {
    // ∫ π (R² - z²) dz
    let primitive = |z: f64| PI * (radius * radius * z - z.powi(3) / 3.0);
    primitive(high.clamp(-radius, radius)) - primitive(low.clamp(-radius, radius))
}
