//! psmrt: grains and water, resolved grain by grain.
//!
//! | module | what it does |
//! |---|---|
//! | [`scene`] | scene file (TOML, SI units) to checked scene in lattice units |
//! | [`engine`] | what an engine can do; the oracle as one |
//! | [`run`] | the time loop |
//! | [`checkpoint`] | the state of a run in a file |
//! | [`output`] | CSV, pictures, the folder of a run |
//! | [`estimate`] | what a scene will be, cost and risk |
//! | [`exact`] | exact solutions to compare with |
//! | [`command`] | the commands of the command line |
//! | [`oracle`] | problems for other people's kernels, a verdict and a diagnosis back |
//! | [`machine`] | what this machine has |

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod checkpoint;
pub mod command;
pub mod engine;
pub mod estimate;
pub mod exact;
pub mod machine;
pub mod oracle;
pub mod output;
pub mod run;
pub mod scene;
