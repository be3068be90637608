//! Flow through a bed of grains: where the bed lies, how permeable it is, and what laws say of it.
//!
//! | file | what it does |
//! |---|---|
//! | `spheres.rs` | the spheres of a scene, and how much of each the domain holds |
//! | `surface.rs` | volume and surface of solids of any shape |
//! | `bed.rs` | where they lie densest |
//! | `laws.rs` | laws for the resistance of beds of spheres |
//! | `permeability.rs` | the permeability of a bed, by the flow that a gradient drives through it |

pub(crate) mod bed;
pub mod laws;
pub mod permeability;
pub(crate) mod spheres;
pub(crate) mod surface;
