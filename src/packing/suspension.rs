//! A random suspension: spheres put down one after the other at random, each where no other is.
//!
//! Random sequential addition: each place is drawn evenly from the domain until one is free. It works in
//! a domain with any periodic axes and walls, up to solid fractions near 0.3 (it jams at 0.38); denser
//! periodic ones are made by [`super::periodic`].

use crate::packing::{Packing, PackingError, PackingReport, check_radii, contacts, porosity};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::random::SplitMix64;
use psmrt_reference::grains::setup::PeriodicBox;
use psmrt_reference::lattice::Vec3;
use std::collections::HashMap;

/// Places tried for a grain before the attempt is given up.
const MOST_TRIES: u32 = 200_000;

/// A random suspension that is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomSuspension {
    /// Lengths of the domain.
    pub lengths: [f64; 3],
    /// Which axes are periodic; at the ends of the others are walls.
    pub periodic: [bool; 3],
    /// Radius of each grain, length.
    pub radii: Vec<f64>,
    /// Least distance between two surfaces, length.
    pub gap: f64,
    /// Seed of the places.
    pub seed: u64,
}

impl RandomSuspension {
    /// Puts the grains down, the largest first. They keep the order of their radii. Errors if a value
    /// makes no sense or no place is found for a grain.
    pub fn make(&self) -> Result<Packing, PackingError> {
        self.check()?;
        let length = |axis: usize| self.periodic[axis].then_some(self.lengths[axis]);
        let sides = PeriodicBox { lengths: [length(0), length(1), length(2)] };
        let mut random = SplitMix64::new(self.seed);
        let mut order: Vec<usize> = (0..self.radii.len()).collect();
        order.sort_by(|&a, &b| self.radii[b].total_cmp(&self.radii[a]).then(a.cmp(&b)));
        let mut known = PutDown::new(self);
        let mut grains = vec![None; self.radii.len()];
        for (placed, &number) in order.iter().enumerate() {
            let radius = self.radii[number];
            let mut tries = (0..MOST_TRIES).map(|_| self.place(radius, &mut random));
            let free = tries.find(|place| known.is_free(self, place, radius));
            let wanted = order.len();
            let place = free.ok_or(PackingError::Crowded { placed, wanted })?;
            known.add(place, radius);
            grains[number] = Some(Grain::sphere(place, radius, 1.0));
        }
        let grains: Vec<Grain> = grains.into_iter().flatten().collect();
        let (coordination, largest_overlap) = contacts(&grains, &sides, &[]);
        let porosity = porosity(&self.radii, self.lengths.iter().product());
        let report = PackingReport { porosity, coordination, largest_overlap };
        Ok(Packing { grains, sides, planes: Vec::new(), report })
    }

    /// A place for the centre of a sphere, evenly distributed over where it fits.
    fn place(&self, radius: f64, random: &mut SplitMix64) -> Vec3 {
        Vec3::from_fn(|axis, _| {
            let margin = if self.periodic[axis] { 0.0 } else { radius + self.gap };
            margin + (self.lengths[axis] - 2.0 * margin) * random.unit()
        })
    }

    fn check(&self) -> Result<(), PackingError> {
        let bad = |key, value, allowed| Err(PackingError::BadValue { key, value, allowed });
        check_radii(&self.radii)?;
        if !(self.gap >= 0.0 && self.gap.is_finite()) {
            return bad("gap", self.gap, "must be finite and not negative");
        }
        let across = 2.0 * (self.radii.iter().copied().fold(0.0, f64::max) + self.gap);
        match self.lengths.iter().find(|&&length| !(length > across && length.is_finite())) {
            Some(&length) => {
                bad("box length", length, "must be finite and exceed the largest diameter and gaps")
            }
            None => Ok(()),
        }
    }
}

/// The grains put down so far, by cells as wide as two of them can be apart and still be too close.
struct PutDown {
    counts: [i64; 3],
    edges: [f64; 3],
    cells: HashMap<[i64; 3], Vec<(Vec3, f64)>>,
}

impl PutDown {
    fn new(wanted: &RandomSuspension) -> Self {
        let reach = 2.0 * wanted.radii.iter().copied().fold(0.0, f64::max) + wanted.gap;
        #[expect(clippy::cast_possible_truncation, reason = "a box of more cells has no memory")]
        let counts = wanted.lengths.map(|length| ((length / reach).floor() as i64).max(1));
        let edges = std::array::from_fn(|axis| wanted.lengths[axis] / counts[axis] as f64);
        PutDown { counts, edges, cells: HashMap::new() }
    }

    #[expect(clippy::cast_possible_truncation, reason = "inside the box")]
    fn cell(&self, place: &Vec3) -> [i64; 3] {
        std::array::from_fn(|axis| {
            ((place[axis] / self.edges[axis]).floor() as i64).min(self.counts[axis] - 1)
        })
    }

    fn add(&mut self, place: Vec3, radius: f64) {
        self.cells.entry(self.cell(&place)).or_default().push((place, radius));
    }

    fn is_free(&self, wanted: &RandomSuspension, place: &Vec3, radius: f64) -> bool {
        let home = self.cell(place);
        let around = |axis: usize| {
            let mut near: Vec<i64> = (-1..=1)
                .map(|step| home[axis] + step)
                .filter(|&n| wanted.periodic[axis] || (0..self.counts[axis]).contains(&n))
                .map(|n| n.rem_euclid(self.counts[axis]))
                .collect();
            near.sort_unstable();
            near.dedup();
            near
        };
        let [xs, ys, zs] = [around(0), around(1), around(2)];
        let near = xs.iter().flat_map(|&x| {
            let zs = &zs;
            ys.iter().flat_map(move |&y| zs.iter().map(move |&z| [x, y, z]))
        });
        near.filter_map(|cell| self.cells.get(&cell)).flatten().all(|(other, other_radius)| {
            let offset = Vec3::from_fn(|axis, _| {
                let (along, length) = (other[axis] - place[axis], wanted.lengths[axis]);
                let image = if wanted.periodic[axis] { (along / length).round() } else { 0.0 };
                along - image * length
            });
            offset.norm() >= radius + other_radius + wanted.gap
        })
    }
}
