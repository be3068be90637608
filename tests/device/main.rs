//! All trials that need a device, Python or C, as one binary: `cargo test --test device kernel_runs::` runs those
//! of a file, `wgpu::` those that an engine shares with others. Where what they need is missing they are listed as ignored, with the reason, or fail if
//! `PSMRT_REQUIRE_GPU=1` or `PSMRT_REQUIRE_PYTHON=1` asks for it.

#[path = "../cli/mod.rs"]
mod cli;
#[path = "../common/mod.rs"]
mod common;
#[path = "../conformance/mod.rs"]
mod conformance;
#[path = "../driven/mod.rs"]
mod driven;
#[path = "../edges/mod.rs"]
mod edges;
#[path = "../implicit/mod.rs"]
mod implicit;
#[path = "../mixed/mod.rs"]
mod mixed;
#[path = "../moving_bodies/mod.rs"]
mod moving_bodies;
#[path = "../parity/mod.rs"]
mod parity;
#[path = "../scenes/mod.rs"]
mod scenes;
#[path = "../trials/mod.rs"]
mod trials;

mod conformance_candidates;
mod drive;
mod implicit_coupling;
mod in_time;
mod kernel_conformance;
mod kernel_engine;
mod kernel_extremes;
mod kernel_fractions;
mod kernel_parity;
mod kernel_physics;
mod kernel_runs;

use std::process::ExitCode;

use psmrt::engine::EngineName;

/// The engines that are held to the oracle and to exact solutions, by the same trials; one more is one more here.
const HELD: [EngineName; 3] = [EngineName::Cpu, EngineName::CpuSingle, EngineName::Wgpu];

fn main() -> ExitCode {
    let arguments = trials::arguments();
    let mut all = conformance_candidates::trials();
    for engine in HELD {
        for (file, claims) in [
            ("drive", drive::CLAIMS),
            ("implicit_coupling", implicit_coupling::CLAIMS),
            ("in_time", in_time::CLAIMS),
            ("kernel_engine", kernel_engine::CLAIMS),
            ("kernel_extremes", kernel_extremes::CLAIMS),
            ("kernel_parity", kernel_parity::CLAIMS),
            ("kernel_physics", kernel_physics::CLAIMS),
            ("kernel_runs", kernel_runs::CLAIMS),
        ] {
            all.extend(trials::of_engine(&arguments, engine, file, claims));
        }
    }
    for (file, claims) in [
        ("implicit_coupling", implicit_coupling::OF_KERNEL),
        ("kernel_conformance", kernel_conformance::CLAIMS),
        ("kernel_engine", kernel_engine::OF_KERNEL),
        ("kernel_fractions", kernel_fractions::CLAIMS),
        ("kernel_runs", kernel_runs::OF_KERNEL),
    ] {
        all.extend(trials::on_device(&arguments, Some(file), claims));
    }
    libtest_mimic::run(&arguments, all).exit_code()
}
