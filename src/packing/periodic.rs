//! A periodic random packing: spheres put down at random, and pushed apart until they hardly overlap.
//!
//! All spheres have their final size from the start. They are moved by the contact law, without
//! friction, in a viscous medium that takes their energy; the packing is the first configuration in
//! which no overlap is larger than allowed. Above the porosity at which random packings jam
//! ([`jamming_porosity`]) that state exists and is reached in some hundreds of sub-steps; near it some
//! beginnings end in a dead end, the more often the fewer grains there are, so that others are tried.

use crate::packing::{
    Packing, PackingError, PackingReport, check_radii, contacts, jamming_porosity, porosity,
};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::random::SplitMix64;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

/// Drag of the medium over `√(k m)`: measured, a tenth is fastest; less lets the spheres fly about,
/// more makes them creep.
const DRAG: f64 = 0.1;

/// Sub-steps after which the attempt is given up; 2,000 are enough at porosity 0.38.
const MOST_SUBSTEPS: u32 = 20_000;

/// Beginnings that are tried where spheres of these sizes do not jam for certain.
const BEGINNINGS: u64 = 6;

/// How far below the porosity of jamming a packing of a few grains may still be found.
const SCATTER: f64 = 0.01;

/// Sub-steps from one look at the overlaps to the next.
const LOOK_EVERY: u32 = 10;

/// A periodic packing that is wanted. Its porosity is that of these radii in this domain:
/// [`crate::packing::radius_for`] and [`crate::packing::count_for`] find what fits.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicPacking {
    /// Lengths of the domain, all three axes periodic.
    pub lengths: [f64; 3],
    /// Radius of each grain, length.
    pub radii: Vec<f64>,
    /// Seed of the places.
    pub seed: u64,
    /// Largest overlap allowed, as a fraction of the mean diameter of the two grains.
    pub largest_overlap: f64,
    /// The grains are pushed apart as if their diameters were larger by this fraction: 0 for a bed,
    /// as much as `largest_overlap` for one without any overlap, more for a suspension.
    pub clearance: f64,
}

impl PeriodicPacking {
    /// Overlaps up to 0.2% of a diameter, no clearance.
    pub fn new(lengths: [f64; 3], radii: Vec<f64>, seed: u64) -> Self {
        PeriodicPacking { lengths, radii, seed, largest_overlap: 2e-3, clearance: 0.0 }
    }

    /// Makes the packing. Errors if a value makes no sense or the grains jam.
    pub fn make(&self) -> Result<Packing, PackingError> {
        self.check()?;
        let sides = PeriodicBox::all(self.lengths);
        let porosity = porosity(&self.radii, self.lengths.iter().product());
        let pushed = 1.0 - (1.0 - porosity) * (1.0 + self.clearance).powi(3);
        let is_near = pushed > jamming_porosity(&self.radii) - SCATTER;
        let beginnings = if is_near { BEGINNINGS } else { 1 };
        let mut made = self.push_apart(sides, porosity, self.seed);
        for beginning in 1..beginnings {
            let Err(PackingError::Jammed { .. }) = made else { break };
            // Not a neighbouring seed: that one is the user's next try.
            made = self.push_apart(sides, porosity, self.seed ^ (beginning << 48));
        }
        made
    }

    /// One attempt.
    fn push_apart(
        &self,
        sides: PeriodicBox,
        porosity: f64,
        seed: u64,
    ) -> Result<Packing, PackingError> {
        let mut system = self.thrown_in(sides, seed)?;
        let substep = system.shortest_time() / 15.0;
        let stiffness = system.setup().law.linear().map_or(0.0, |law| law.stiffness);
        let drag = |grain: &Grain| DRAG * (stiffness * grain.mass).sqrt();
        let mut loads = vec![Load::default(); self.radii.len()];

        for _ in 0..MOST_SUBSTEPS / LOOK_EVERY {
            if contacts(system.grains(), &sides, &[]).1 <= self.largest_overlap {
                return Ok(self.finished(&system, porosity));
            }
            for _ in 0..LOOK_EVERY {
                for (load, grain) in loads.iter_mut().zip(system.grains()) {
                    load.force = -drag(grain) * grain.velocity;
                }
                system.substep(substep, &loads)?;
            }
        }
        let (_, overlap) = contacts(system.grains(), &sides, &[]);
        let (allowed, substeps) = (self.largest_overlap, MOST_SUBSTEPS);
        let jams_at = jamming_porosity(&self.radii);
        Err(PackingError::Jammed { porosity, overlap, allowed, substeps, jams_at })
    }

    /// Grains, their diameters enlarged by the clearance, at random places, regardless of overlaps.
    fn thrown_in(&self, sides: PeriodicBox, seed: u64) -> Result<GrainSystem, PackingError> {
        let mut random = SplitMix64::new(seed);
        let grain = |&radius: &f64| {
            let place = Vec3::from_fn(|axis, _| self.lengths[axis] * random.unit());
            Grain::sphere(place, radius * (1.0 + self.clearance), 1.0)
        };
        let grains: Vec<Grain> = self.radii.iter().map(grain).collect();
        let mean_mass = grains.iter().map(|grain| grain.mass).sum::<f64>() / grains.len() as f64;
        let law = ContactLaw::from_duration_and_restitution(1.0, 0.5, 0.5 * mean_mass)?;
        Ok(GrainSystem::new(GrainSetup { sides, ..GrainSetup::new(law) }, grains, Vec::new())?)
    }

    /// The grains where they are now, at rest, in the domain, at their own size.
    fn finished(&self, system: &GrainSystem, porosity: f64) -> Packing {
        let sides = system.setup().sides;
        let at_rest = |(grain, &radius): (&Grain, &f64)| {
            Grain::sphere(sides.wrap(&grain.position), radius, 1.0)
        };
        let grains: Vec<Grain> = system.grains().iter().zip(&self.radii).map(at_rest).collect();
        let (coordination, largest_overlap) = contacts(&grains, &sides, &[]);
        let report = PackingReport { porosity, coordination, largest_overlap };
        Packing { grains, sides, planes: Vec::new(), report }
    }

    fn check(&self) -> Result<(), PackingError> {
        let bad = |key, value, allowed| Err(PackingError::BadValue { key, value, allowed });
        check_radii(&self.radii)?;
        for length in self.lengths {
            if !(length > 0.0 && length.is_finite()) {
                return bad("box length", length, "must be positive and finite");
            }
        }
        if !(self.largest_overlap > 0.0 && self.largest_overlap <= 0.1) {
            let allowed = "must lie between 0 (exclusive) and 0.1; for none at all set the clearance \
                           to the same value";
            return bad("largest_overlap", self.largest_overlap, allowed);
        }
        if !(self.clearance >= 0.0 && self.clearance.is_finite()) {
            return bad("clearance", self.clearance, "must be finite and not negative");
        }
        let porosity = porosity(&self.radii, self.lengths.iter().product());
        if porosity < 0.25 {
            // The densest packing of equal spheres has 0.2595.
            let allowed = "is denser than spheres can be packed; random packings of equal spheres \
                           reach about 0.36";
            return bad("porosity", porosity, allowed);
        }
        Ok(())
    }
}
