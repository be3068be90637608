//! A grain that its contacts do not hold ([`crate::grains::hold`]).

use thiserror::Error;

/// Deepest overlap that is still a contact, over the radius of the smaller body. Hard spheres do not
/// overlap at all; at half a radius a sphere has lost a sixth of its volume to its neighbour.
pub const DEEPEST: f64 = 0.5;

/// What a grain should not pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SunkInto {
    /// Another grain, by its number.
    Grain(usize),
    /// A plane, by its number.
    Plane(usize),
}

/// A free grain that lies too deep in an obstacle.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "grain {grain} lies {overlap} deep in {obstacle:?}, more than {DEEPEST} of the radius {radius}: its contact \
     does not hold it"
)]
pub struct Sunk {
    /// Number of the grain; of two free grains the smaller.
    pub grain: usize,
    /// Where it lies.
    pub obstacle: SunkInto,
    /// Overlap, length; on a plane beyond the radius if the centre is behind it.
    pub overlap: f64,
    /// Radius of the smaller body, length.
    pub radius: f64,
    /// Speed at which the two bodies approach, length/time; negative if they part.
    pub approach: f64,
}

impl Sunk {
    /// How deep, in radii of the smaller body.
    pub fn depth(&self) -> f64 {
        self.overlap / self.radius
    }
}
