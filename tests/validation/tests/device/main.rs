//! Trials of the cases on a device.

#[path = "../../../common/mod.rs"]
mod common;
#[path = "../../../trials/mod.rs"]
mod trials;

mod acceptance;

use std::process::ExitCode;

fn main() -> ExitCode {
    trials::run(acceptance::CLAIMS)
}
