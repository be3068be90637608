//! psmrt: particle-resolved simulation of grains in water (PS-MRT lattice Boltzmann, partially saturated method).
//!
//! | module | what it does |
//! |---|---|
//! | [`scene`] | scene file (TOML, SI units) to checked scene in lattice units |
//! | [`engine`] | what an engine can do; the oracle and the kernel as engines |
//! | [`cpu`] | the CPU engine: the fluid on all cores, in single or double precision |
//! | [`kernel`] | the production kernel: the fluid on any GPU |
//! | [`run`] | the time loop |
//! | [`checkpoint`] | the state of a run in a file |
//! | [`output`] | CSV, pictures, the folder of a run |
//! | [`advice`] | what a scene will cost, how wrong it will be and what may go wrong; the cheapest settings |
//! | [`exact`] | exact solutions to compare with |
//! | [`courses`] | what prescribed spheres run into |
//! | [`diagnosis`] | why a run was stopped, and what to change |
//! | [`stopped_grain`] | why a run stopped at a free grain |
//! | [`command`] | the commands of the command line |
//! | [`seepage`] | flow through a bed of grains: where it lies, its permeability, laws for it |
//! | [`packing`] | packings, suspensions and settled beds of grains to start from |
//! | [`conformance`] | the conformance kit: problems for other people's kernels, a verdict on their answers |
//! | [`convergence`] | how uncertain a result is, by three grids |
//! | [`ball`] | what cells share with a ball |
//! | [`lanes`] | vectors of numbers |
//! | [`table`] | rows of named columns, as CSV files hold them |
//! | [`units`] | SI units and lattice units |
//! | [`in_time`] | values that change in time |
//! | [`input`] | reading of files that the user names |
//! | [`quote`] | how the user's text stands in messages |
//! | [`npy`] | reading of NumPy arrays, and their header |
//! | [`number_type`] | numbers as files hold them |
//! | [`voxels`] | images of solids, voxel by voxel |
//! | [`machine`] | what this machine has |
//! | [`provenance`] | which commit results come from, and which day |

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![warn(clippy::print_stdout, clippy::print_stderr)] // they panic where nobody reads: see command/say.rs

pub mod advice;
pub mod ball;
pub mod bodies;
pub mod checkpoint;
pub mod command;
pub mod conformance;
pub mod convergence;
pub mod courses;
pub mod cpu;
pub mod diagnosis;
pub mod engine;
pub mod exact;
pub mod in_time;
pub mod input;
pub mod kernel;
pub mod lanes;
pub mod machine;
pub mod npy;
pub mod number_type;
pub mod output;
pub mod packing;
pub mod provenance;
pub mod quote;
pub mod run;
pub mod scene;
pub mod seepage;
pub mod stopped_grain;
pub mod table;
pub mod units;
pub mod voxels;
