//! What every shape answers for, one file a shape. A further shape is a variant of [`Shape`], a file here, and what the
//! compiler then asks for.

mod cells;
mod sphere;

use crate::coverage::rule::CoverageRule;
use crate::domain::Domain;
use crate::lattice::Vec3;
use crate::solids::{Shape, Solid};

/// A cell that a solid covers a part of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    /// Number of the cell.
    pub cell: usize,
    /// Solid fraction, in (0, 1].
    pub epsilon: f64,
    /// From the solid's centre (its nearest image) to the centre of the cell.
    pub arm: Vec3,
}

impl Solid {
    /// Volume in cells; of a sphere all of it, wherever it is.
    pub fn volume(&self) -> f64 {
        match &self.shape {
            Shape::Sphere { radius } => sphere::volume(*radius),
            Shape::Cells { fractions, .. } => cells::volume(fractions),
        }
    }

    /// Diameter of the sphere of its volume.
    pub fn diameter(&self) -> f64 {
        match &self.shape {
            Shape::Sphere { radius } => 2.0 * radius,
            Shape::Cells { fractions, .. } => sphere::diameter_of(cells::volume(fractions)),
        }
    }

    /// The corners, lowest and highest, of the box along the axes that just holds it, as it stands: not wrapped.
    /// `None` if there is nothing of it.
    pub fn bounds(&self, domain: &Domain) -> Option<[Vec3; 2]> {
        match &self.shape {
            Shape::Sphere { radius } => Some(sphere::bounds(&self.centre, *radius)),
            Shape::Cells { fractions, .. } => cells::bounds(domain, fractions),
        }
    }

    /// The cells that it covers a part of. Along periodic axes a sphere is wrapped, image by image; beyond other faces
    /// it is cut off.
    pub fn covered(&self, domain: &Domain, rule: CoverageRule) -> Vec<Covered> {
        match &self.shape {
            Shape::Sphere { radius } => sphere::covered(domain, &self.centre, *radius, rule),
            Shape::Cells { fractions, .. } => cells::covered(domain, &self.centre, fractions),
        }
    }

    /// Cells that it may touch, at most.
    pub fn most_cells(&self) -> f64 {
        match &self.shape {
            Shape::Sphere { radius } => sphere::most_cells(*radius),
            Shape::Cells { fractions, .. } => fractions.len() as f64,
        }
    }

    /// Speed of its fastest point: of a sphere a bound, reached where it spins across its way.
    pub fn top_speed(&self, domain: &Domain) -> f64 {
        match &self.shape {
            Shape::Sphere { radius } => {
                self.velocity.norm() + radius * self.angular_velocity.norm()
            }
            Shape::Cells { fractions, .. } => {
                let covered = cells::covered(domain, &self.centre, fractions);
                covered.iter().map(|at| self.velocity_at(&at.arm).norm()).fold(0.0, f64::max)
            }
        }
    }

    /// Whether its cells change from step to step.
    pub fn moves(&self) -> bool {
        match self.shape {
            Shape::Sphere { .. } => self.velocity != Vec3::zeros(),
            // A belt stays where it is.
            Shape::Cells { place, .. } => place.is_some() && self.has_velocity(),
        }
    }

    /// Whether it covers other cells than `before`, itself at another time.
    pub fn covers_other_cells(&self, before: &Solid) -> bool {
        let place = |solid: &Solid| match solid.shape {
            Shape::Sphere { .. } => None,
            Shape::Cells { place, .. } => place,
        };
        self.centre != before.centre || place(self) != place(before)
    }
}
