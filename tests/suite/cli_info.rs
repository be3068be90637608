//! What `psmrt info` prints where nothing is wrong.

use std::process::{Command, Output};

/// `psmrt info` where there is no session of a window system, as in containers.
fn info(loader_debug: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_psmrt"));
    command.arg("info").env_remove("XDG_RUNTIME_DIR").env("VK_LOADER_DEBUG", loader_debug);
    command.output().unwrap()
}

#[test]
fn drivers_complain_of_no_missing_window_system() {
    let output = info("");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{said}");
}

#[test]
fn what_else_drivers_print_is_passed_on() {
    // The Vulkan loader lists what it finds; where there is none, there are no adapters either.
    let output = info("all");
    let said = String::from_utf8_lossy(&output.stderr);
    let has_adapters = !String::from_utf8_lossy(&output.stdout).contains("adapters   none");
    assert!(!has_adapters || said.contains("layer"), "{said}");
    assert!(!said.lines().any(|line| line.starts_with("error: XDG_RUNTIME_DIR")), "{said}");
}

#[test]
fn every_engine_is_listed() {
    let output = info("");
    let said = String::from_utf8_lossy(&output.stdout);
    for engine in psmrt::engine::EngineName::ALL {
        assert!(
            said.contains(&format!("{} (", engine.word())),
            "{} is missing: {said}",
            engine.word()
        );
    }
}
