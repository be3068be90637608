//! The proofs of the oracle: `cargo test -p psmrt-reference` runs them, and nothing else.
//!
//! They use `psmrt_reference` and no other code of psmrt, as one binary that links no graphics:
//! one test is `cargo test -p psmrt-reference couette::`. (Were this file named `main.rs`, cargo would take
//! the folder for a test of psmrt as well.)

#[path = "../common/mod.rs"]
mod common;

mod boundaries;
mod conservation;
mod couette;
mod coupling;
mod coupling_resume;
mod coverage;
mod coverage_degenerate;
mod coverage_linear;
mod coverage_sampling;
mod duct;
mod errata;
mod free_grains;
mod free_start;
mod grains_chung_ooi;
mod grains_conservation;
mod grains_contact;
mod grains_hertz;
mod grains_hold;
mod grains_lubrication;
mod grains_motion;
mod grains_neighbours;
mod grains_oblique;
mod grains_rolling;
mod grains_system;
mod grains_values;
mod guard;
mod implicit_coupling;
mod leakage;
mod limits;
mod moments;
mod momentum_balance;
mod non_reflecting;
mod poiseuille;
mod ps_channel_wall;
mod released_sphere;
mod reproducible;
mod shapes;
mod sound;
mod sphere_arrays;
mod stokes_settling;
mod suspension;
mod symmetry;
mod ten_cate;
mod tight_solids;
mod torque;
mod towed_sphere;
mod tumbling;
mod viscosity;
mod vortices;
