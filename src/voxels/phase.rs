//! Which numbers of an image are solid, and how much of the voxel.

/// How much of a voxel is solid, by its number.
#[derive(Clone, Debug, PartialEq)]
pub enum Phase {
    /// All of it where the number is one of these.
    Values(Vec<f64>),
    /// All of it where the number is larger.
    Above(f64),
    /// None of it at `pore`, all at `solid`, and in between in proportion to the grey; beyond them as at them.
    Grey {
        /// The grey of a voxel without solid.
        pore: f64,
        /// The grey of a voxel that is all solid.
        solid: f64,
    },
}

impl Phase {
    /// The solid share of a voxel, 0 to 1.
    pub fn share(&self, number: f64) -> f64 {
        match self {
            Phase::Values(solid) => f64::from(u8::from(solid.contains(&number))),
            Phase::Above(threshold) => f64::from(u8::from(number > *threshold)),
            // As it is where the image holds shares itself, so that they come back bit for bit.
            Phase::Grey { pore: 0.0, solid: 1.0 } => number.clamp(0.0, 1.0),
            Phase::Grey { pore, solid } => ((number - pore) / (solid - pore)).clamp(0.0, 1.0),
        }
    }
}
