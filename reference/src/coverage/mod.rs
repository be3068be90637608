//! Which cells the solids cover, and by how much.
//!
//! `sphere` and `sampled` give the solid fraction of one sphere in one cell; this file lists them
//! for all solids. Along periodic axes a sphere is wrapped, image by image, so that every share
//! carries the arm from the right image of the centre; beyond other faces it is cut off.

mod sampled;
mod sphere;

pub use sampled::sampled_fraction;
pub use sphere::exact_fraction;

use crate::domain::Domain;
use crate::lattice::Vec3;
use crate::solids::{Shape, Solid};

/// How the solid fraction of a sphere in a cell is found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CoverageRule {
    /// Exactly, in closed form.
    #[default]
    Exact,
    /// By `n × n × n` sample points.
    Sampled {
        /// Points along each axis, at least 1.
        n: usize,
    },
}

impl CoverageRule {
    /// Solid fraction of a sphere whose centre lies at `centre` from the centre of the cell.
    pub fn fraction(self, centre: &Vec3, radius: f64) -> f64 {
        match self {
            CoverageRule::Exact => exact_fraction(centre, radius),
            CoverageRule::Sampled { n } => sampled_fraction(centre, radius, n),
        }
    }
}

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
#[derive(Clone, Debug)]
pub struct Coverage {
    /// Cell index → position in `shares`, or `BARE`.
    slot: Vec<u32>,
    /// Cell index and its shares, in the order in which the solids met the cells.
    shares: Vec<(usize, Vec<Share>)>,
}

impl Coverage {
    /// Lists what `solids` cover of `domain`.
    pub fn new(domain: &Domain, solids: &[Solid], rule: CoverageRule) -> Self {
        let mut coverage = Coverage { slot: vec![BARE; domain.cell_count()], shares: Vec::new() };
        coverage.update(domain, solids, rule);
        coverage
    }

    /// Lists it again after solids have moved. Costs nothing for cells that no solid touched.
    pub fn update(&mut self, domain: &Domain, solids: &[Solid], rule: CoverageRule) {
        for (cell, _) in self.shares.drain(..) {
            self.slot[cell] = BARE;
        }
        for (number, solid) in solids.iter().enumerate() {
            match &solid.shape {
                Shape::Sphere { radius } => {
                    self.add_sphere(domain, number, &solid.centre, *radius, rule);
                }
                Shape::Cells { fractions } => {
                    for &(cell, epsilon) in fractions.iter().filter(|(_, epsilon)| *epsilon > 0.0) {
                        let arm = domain.centre(domain.coordinates(cell)) - solid.centre;
                        self.add(cell, Share { solid: number, epsilon, arm });
                    }
                }
            }
        }
    }

    /// The shares of cell `cell`; empty where no solid is.
    pub fn shares(&self, cell: usize) -> &[Share] {
        match self.slot[cell] {
            BARE => &[],
            slot => &self.shares[slot as usize].1,
        }
    }

    /// Total solid fraction of cell `cell`, `epsilon_t = min(1, sum epsilon_s)`.
    pub fn solid_fraction(&self, cell: usize) -> f64 {
        self.shares(cell).iter().map(|share| share.epsilon).sum::<f64>().min(1.0)
    }

    fn add_sphere(
        &mut self,
        domain: &Domain,
        solid: usize,
        centre: &Vec3,
        radius: f64,
        rule: CoverageRule,
    ) {
        let range =
            |axis: usize| first_cell(centre[axis] - radius)..=first_cell(centre[axis] + radius);
        for z in range(2) {
            for y in range(1) {
                for x in range(0) {
                    let Some(inside) = domain.locate([x, y, z]) else { continue };
                    // The cell's centre before wrapping: the arm is that of this image.
                    let cell_centre = Vec3::new(x as f64, y as f64, z as f64).add_scalar(0.5);
                    let arm = cell_centre - centre;
                    let epsilon = rule.fraction(&-arm, radius);
                    if epsilon > 0.0 {
                        self.add(domain.index(inside), Share { solid, epsilon, arm });
                    }
                }
            }
        }
    }

    fn add(&mut self, cell: usize, share: Share) {
        if self.slot[cell] == BARE {
            // The box has fewer than 2^32 - 1 cells, so the position fits.
            #[expect(clippy::cast_possible_truncation, reason = "Domain::new bounds the cells")]
            let position = self.shares.len() as u32;
            self.slot[cell] = position;
            self.shares.push((cell, Vec::with_capacity(1)));
        }
        self.shares[self.slot[cell] as usize].1.push(share);
    }
}

/// The cell that contains a coordinate along an axis.
#[expect(clippy::cast_possible_truncation, reason = "coordinates of solids are far below 2^63")]
fn first_cell(coordinate: f64) -> i64 {
    coordinate.floor() as i64
}
