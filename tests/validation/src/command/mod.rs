//! The commands of `cargo validate`, one a file.

pub mod coefficients;
mod environment;
pub mod golden;
pub mod history;
pub mod operators;
pub mod report;
mod report_claims;
mod report_files;
pub mod report_request;
pub mod speed;
pub mod stability;
pub mod tradeoff;
