//! Trials that need an adapter: listed as ignored, with the reason, where there is none, and failing
//! there if `PSMRT_REQUIRE_GPU=1`. libtest hides what passing tests print, so these run under
//! libtest-mimic (`harness = false`).

#![allow(dead_code, reason = "each test binary is a crate of its own and uses a part of this")]

use std::process::ExitCode;
use std::sync::{Arc, OnceLock};

use libtest_mimic::{Arguments, Failed, Trial};
use psmrt::engine::EngineName;
use psmrt::kernel::{Gpu, Kernel, KernelError};

use crate::common::Budget;

/// The device of this process, opened once.
pub fn gpu() -> Result<Arc<Gpu>, KernelError> {
    static GPU: OnceLock<Result<Arc<Gpu>, KernelError>> = OnceLock::new();
    GPU.get_or_init(|| Gpu::open(None)).clone()
}

/// The device for an engine that needs one.
pub fn device_of(engine: EngineName) -> Option<Arc<Gpu>> {
    engine.needs_device().then(|| gpu().unwrap_or_else(|error| panic!("{error}")))
}

/// A trial by its claim.
pub type Claim = (&'static str, fn());

/// A trial that each engine is put through, by its claim.
pub type EngineClaim = (&'static str, fn(EngineName));

/// Runs the trials.
pub fn run(claims: &[Claim]) -> ExitCode {
    let arguments = arguments();
    let trials = on_device(&arguments, None, claims);
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// The arguments of the command line, and one trial at a time unless they say otherwise: a software adapter uses
/// all cores by itself, and a shared one is shared by all trials.
pub fn arguments() -> Arguments {
    let mut arguments = Arguments::from_args();
    arguments.test_threads.get_or_insert(1);
    arguments
}

/// The trials of a file, whose name comes before theirs.
pub fn on_device(arguments: &Arguments, file: Option<&str>, claims: &[Claim]) -> Vec<Trial> {
    trials_of(arguments, true, file, claims.iter().copied())
}

fn trials_of(
    arguments: &Arguments,
    needs_device: bool,
    file: Option<&str>,
    claims: impl Iterator<Item = (&'static str, impl Fn() + Send + 'static)>,
) -> Vec<Trial> {
    let required = std::env::var("PSMRT_REQUIRE_GPU").is_ok_and(|value| value == "1");
    let device = if needs_device && !arguments.list { gpu().map(|_| ()) } else { Ok(()) };
    let named = |claim: &str| file.map_or(claim.to_owned(), |file| format!("{file}::{claim}"));
    claims
        .map(|(name, claim)| (named(name), claim))
        .map(|(name, claim)| match &device {
            Ok(()) => Trial::test(name, move || {
                claim();
                Ok(())
            }),
            Err(error) if required => {
                let reason = format!("PSMRT_REQUIRE_GPU=1, but {error}");
                Trial::test(name, move || Err(Failed::from(reason)))
            }
            Err(_) => Trial::test(name, || Ok(()))
                .with_kind("NOT RUN: no adapter")
                .with_ignored_flag(true),
        })
        .collect()
}

/// The same for an engine, whose name comes first; without an adapter those of an engine that needs none run.
pub fn of_engine(
    arguments: &Arguments,
    engine: EngineName,
    file: &str,
    claims: &[EngineClaim],
) -> Vec<Trial> {
    let file = format!("{}::{file}", engine.word());
    let named = claims.iter().map(|&(name, claim)| (name, move || claim(engine)));
    trials_of(arguments, engine.needs_device(), Some(&file), named)
}

impl Budget {
    /// Makes `steps` steps on the device.
    pub fn advance(&mut self, kernel: &mut Kernel, steps: u64) {
        self.spend(steps * kernel.setup().domain.cell_count() as u64);
        kernel.advance(steps, true).unwrap_or_else(|error| panic!("{error}"));
    }
}
