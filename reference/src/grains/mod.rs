//! Grains: spheres that touch, roll, settle and are carried (discrete element method, DEM).
//!
//! | equation | what it says | file |
//! |---|---|---|
//! | `F = k δ + γ dδ/dt`, Coulomb | linear contact law, and its conversion from duration and restitution | [`law`] |
//! | `F = (4/3) E* √(R* δ) δ`, Mindlin | contact law of elastic spheres | [`hertz`] |
//! | | the two laws, and what is asked of both | [`laws`] |
//! | | the force of one contact, its springs carried along as it turns | [`contact`] |
//! | `6π μ a X(gap) U` | lubrication correction | [`lubrication`] |
//! | | walls and other planes | [`plane`] |
//! | | contact and lubrication together | [`interaction`] |
//! | | candidate pairs from a cell list | [`neighbours`] |
//! | | their forces, computed and gathered in one order whatever the threads | [`pairs`] |
//! | `m dv/dt = F` | velocity Verlet, the length of a sub-step | [`motion`] |
//! | | the domain, what a set of grains is set up with, and the checks | [`setup`] |
//! | | order of operations in a sub-step, checkpoints | [`system`] |
//! | | whether contacts hold | [`hold`] |
//! | | the contacts as they are now | [`touching`] |
//!
//! Units: any consistent ones (SI, or the lattice units of the fluid): nothing here has a scale of
//! its own. Units are given as `length`, `time`, `mass` and what is made of them. Angles are radians.

pub mod contact;
pub mod grain;
pub mod hertz;
pub mod hold;
pub mod interaction;
pub mod law;
pub mod laws;
pub mod lubrication;
pub mod motion;
pub mod neighbours;
pub mod pairs;
mod parallel;
pub mod plane;
pub mod random;
pub mod setup;
pub mod sunk;
pub mod system;
pub mod touching;
