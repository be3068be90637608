//! What a report was made with, line by line, for whoever wants to make it again or finds other numbers.

use std::path::Path;

use psmrt::kernel::{AdapterFacts, Gpu, adapters};
use psmrt::{machine, provenance};

/// Names and values of the table of the page. `golden` is the folder of the cases.
pub(super) fn environment(
    gpu: Option<&Gpu>,
    golden: &Path,
    scale: &str,
    seconds: f64,
) -> Vec<(String, String)> {
    let mut facts = vec![
        ("made on", provenance::today() + " (UTC)"),
        ("commit", provenance::COMMIT.unwrap_or("unknown: built outside a checkout").to_owned()),
        ("its sources", state(provenance::sources_changed()).to_owned()),
        ("its cases", state(provenance::files_changed(golden, &["."])).to_owned()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("profile", profile().to_owned()),
        ("operating system", machine::system()),
        ("architecture", std::env::consts::ARCH.to_owned()),
        ("processor", machine::processor().unwrap_or_else(|| "unknown".to_owned())),
        ("threads", machine::threads().to_string()),
        ("memory", machine::memory_words()),
        (
            "adapter used",
            gpu.map_or("none: the kernel was not run".to_owned(), |gpu| words(gpu.facts())),
        ),
    ];
    let there = adapters();
    if there.is_empty() {
        facts.push(("adapters here", "none".to_owned()));
    }
    facts.extend(there.iter().map(|adapter| ("adapter here", words(adapter))));
    facts.push(("scale", scale.to_owned()));
    facts.push(("time taken", format!("{seconds:.0} s")));
    facts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Whether files are those of the commit.
fn state(changed: Option<bool>) -> &'static str {
    match changed {
        Some(false) => "clean: as in the commit",
        Some(true) => "with changes that are not in the commit",
        None => "unknown: git could not be asked",
    }
}

fn profile() -> &'static str {
    if cfg!(debug_assertions) { "dev: optimised, with debug assertions" } else { "release" }
}

/// An adapter with its driver.
fn words(adapter: &AdapterFacts) -> String {
    let AdapterFacts { name, kind, backend, driver, .. } = adapter;
    format!("{name} ({kind}, {backend}); driver {driver}")
}
