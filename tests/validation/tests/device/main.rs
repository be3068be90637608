//! Trials of the cases on a device.

#[path = "../../../common/mod.rs"]
mod common;
#[path = "../edges/mod.rs"]
mod edges;
#[path = "../../../trials/mod.rs"]
mod trials;

mod acceptance;
mod extremes;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = trials::arguments();
    let mut all = trials::on_device(&arguments, Some("acceptance"), acceptance::CLAIMS);
    all.extend(trials::on_device(&arguments, Some("extremes"), extremes::CLAIMS));
    libtest_mimic::run(&arguments, all).exit_code()
}
