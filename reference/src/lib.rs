//! The oracle of psmrt: the fluid and the grains of Fukumoto, Ohtsuka & Murakami's PS-MRT lattice Boltzmann method
//! in plain double precision, one equation in one place. Grains are particle-resolved, by the partially saturated
//! method (PSM, also immersed moving boundary), and move by DEM.
//!
//! | equation of the paper | what it says | file |
//! |---|---|---|
//! | D3Q19 | directions and their numbering | [`directions`] |
//! | D3Q19 | weights, density, momentum, viscosity | [`lattice`] |
//! | Eq. 1 | streaming | [`streaming`], at the faces [`boundary`], where sound leaves [`non_reflecting`] |
//! | Eq. 1, `G` | body force | [`forcing`]; its value in a step, and those of the faces, [`drive`] |
//! | Eq. 2 | SRT (BGK) | [`collision`] |
//! | Eq. 3 | MRT | [`collision`], `M` in [`moments`], `S-hat` in [`rates`] |
//! | Eqs. 2, 3, `f_eq`, `m_eq` | equilibria | [`equilibrium`] |
//! | Eqs. 4, 6 | PS-SRT, PS-MRT: fluid and solid part of a cell | [`cell_collision`] |
//! | Eq. 5, `B` | the solid's collision and its weight, force on the solid | [`partial_saturation`] |
//! | `epsilon` | solid fraction of a sphere in a cell | [`coverage`]; what each shape covers: [`shapes`] |
//! | | how the fluid starts | [`start`] |
//! | | order of operations in a step | [`solver`] |
//! | section 4, contact | Voigt, Coulomb, motion (DEM) | [`grains`] |
//! | section 4, fluid on grains | free grains in the fluid | [`coupling`] |
//!
//! Symbols: `reference/NOTATION.md`. Departures from the printed equations, each with the test that
//! shows why: `reference/ERRATA.md`. Proofs: `tests/oracle/`, run by `cargo test -p psmrt-reference`.
//! Everything is in lattice units: grid spacing, time step and the
//! reference density are 1.

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod boundary;
pub mod cell_collision;
pub mod collision;
pub mod coupling;
pub mod coverage;
pub mod directions;
pub mod domain;
pub mod drive;
pub mod equilibrium;
pub mod forcing;
pub mod graded_viscosity;
pub mod grains;
pub mod guard;
pub mod lattice;
pub mod moments;
pub mod non_reflecting;
pub mod partial_saturation;
pub mod planes;
pub mod rates;
pub mod setup;
pub mod shapes;
pub mod solids;
pub mod solver;
pub mod start;
pub mod streaming;
