//! Plain tests of the cases, the sweeps and the commands of `cargo validate`.

#[path = "../../../common/mod.rs"]
mod common;
#[path = "../edges/mod.rs"]
mod edges;

mod acceptance;
mod coefficients;
mod errata;
mod extremes;
mod golden;
mod report;
mod stability_warnings;
mod tradeoff;
