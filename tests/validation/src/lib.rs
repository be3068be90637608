//! The acceptance suite's own program: cases that are measured, judged and drawn; sweeps; reviewed results.
//! It uses psmrt as anybody may; psmrt knows nothing of it.
//!
//! | module | what it does |
//! |---|---|
//! | [`cases`] | the acceptance cases, a folder each, named as under `golden/` |
//! | [`speed`] | how fast the engines are |
//! | [`stability`] | maps of where the method survives and where it is right |
//! | [`tradeoff`] | speed for accuracy, measured |
//! | [`numbers`] | the numbers that the report opens with, and how far off they are, quantity by quantity |
//! | [`history`] | what the committed reports found |
//! | [`command`] | the commands of `cargo validate` |
//! | [`failure`] | how these fail |

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![warn(clippy::print_stdout, clippy::print_stderr)] // they panic where nobody reads

pub mod cases;
pub mod command;
pub mod failure;
pub mod history;
pub mod numbers;
pub mod speed;
pub mod stability;
pub mod tradeoff;

/// How cargo runs this program, by an alias.
pub const PROGRAM: &str = "cargo validate";
