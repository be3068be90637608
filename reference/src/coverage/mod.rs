//! Which cells the solids cover, and by how much.
//!
//! `sphere`, `sampled` and `linear` give the solid fraction of one sphere in one cell, [`Solid::covered`] the cells that one solid
//! covers; this file lists them for all solids.

mod linear;
pub(crate) mod rule;
mod sampled;
mod sphere;

pub use linear::{SMALLEST_LINEAR_RADIUS, linear_fraction};
pub use rule::CoverageRule;
pub use sampled::sampled_fraction;
pub use sphere::exact_fraction;

use crate::domain::Domain;
use crate::lattice::Vec3;
use crate::shapes::Covered;
use crate::solids::Solid;
use rayon::prelude::*;

/// The part of one cell that one solid covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Number of the solid.
    pub solid: usize,
    /// Solid fraction `epsilon`, in (0, 1].
    pub epsilon: f64,
    /// From the solid's centre (its nearest image) to the centre of the cell.
    pub arm: Vec3,
}

/// No solid in this cell.
const BARE: u32 = u32::MAX;

/// The shares of all cells that a solid touches.
///
/// Within a cell they are ordered by the number of the solid, so that sums over them do not depend on
/// how the solids came there.
#[derive(Clone, Debug)]
pub struct Coverage {
    /// Cell index → position in `shares`, or `BARE`.
    slot: Vec<u32>,
    /// Shares of the cells that have some; empty ones are listed in `free`.
    shares: Vec<Vec<Share>>,
    free: Vec<u32>,
    /// For each solid, the cells that it touches, and the solid as it was when they were listed.
    touched: Vec<(Option<Solid>, Vec<usize>)>,
}

impl Coverage {
    /// Lists what `solids` cover of `domain`.
    pub fn new(domain: &Domain, solids: &[Solid], rule: CoverageRule) -> Self {
        let mut coverage = Coverage {
            slot: vec![BARE; domain.cell_count()],
            shares: Vec::new(),
            free: Vec::new(),
            touched: vec![(None, Vec::new()); solids.len()],
        };
        coverage.update(domain, solids, rule);
        coverage
    }

    /// Lists it again for the solids that have moved, visiting only cells that these touch.
    pub fn update(&mut self, domain: &Domain, solids: &[Solid], rule: CoverageRule) {
        let touched = &self.touched;
        let covered: Vec<(usize, Vec<Covered>)> = solids
            .par_iter()
            .enumerate()
            .filter(|(number, solid)| {
                touched[*number].0.as_ref().is_none_or(|before| solid.covers_other_cells(before))
            })
            .map(|(number, solid)| (number, solid.covered(domain, rule)))
            .collect();
        for (number, shares) in covered {
            self.remove(number);
            for Covered { cell, epsilon, arm } in shares {
                self.add(cell, Share { solid: number, epsilon, arm });
            }
            self.touched[number].0 = Some(solids[number].clone());
        }
    }

    /// The shares of cell `cell`; empty where no solid is.
    pub fn shares(&self, cell: usize) -> &[Share] {
        match self.slot[cell] {
            BARE => &[],
            slot => &self.shares[slot as usize],
        }
    }

    /// Total solid fraction of cell `cell`, `epsilon_t = min(1, sum epsilon_s)`.
    pub fn solid_fraction(&self, cell: usize) -> f64 {
        self.shares(cell).iter().map(|share| share.epsilon).sum::<f64>().min(1.0)
    }

    /// Removes solid number `solid` from all cells.
    fn remove(&mut self, solid: usize) {
        for cell in std::mem::take(&mut self.touched[solid].1) {
            let slot = self.slot[cell];
            if slot == BARE {
                continue; // a second image in the same cell, removed with the first
            }
            let shares = &mut self.shares[slot as usize];
            shares.retain(|share| share.solid != solid);
            if shares.is_empty() {
                self.free.push(slot);
                self.slot[cell] = BARE;
            }
        }
    }

    fn add(&mut self, cell: usize, share: Share) {
        if self.slot[cell] == BARE {
            self.slot[cell] = self.free.pop().unwrap_or_else(|| {
                self.shares.push(Vec::with_capacity(1));
                // The domain has fewer than 2^32 - 1 cells, so the position fits.
                #[expect(clippy::cast_possible_truncation, reason = "Domain::new bounds the cells")]
                let position = self.shares.len() as u32 - 1;
                position
            });
        }
        let shares = &mut self.shares[self.slot[cell] as usize];
        let position = shares.partition_point(|other| other.solid <= share.solid);
        shares.insert(position, share);
        self.touched[share.solid].1.push(cell);
    }
}
