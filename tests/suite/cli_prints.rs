//! Nobody who reads, or a disk that is full, is no reason to fail.

#![cfg(target_os = "linux")]

use std::fs::OpenOptions;
use std::process::{Command, Stdio};

use crate::cli::Folder;
use crate::cli::runs::{CELLS, checkpoints, start, until, write};
use crate::common::Budget;

/// A device that is always full.
fn full() -> Stdio {
    OpenOptions::new().write(true).open("/dev/full").unwrap().into()
}

/// A pipe whose reader has gone.
fn gone() -> Stdio {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    writer.into()
}

fn code(arguments: &[&str], out: Stdio, errors: Stdio) -> Option<i32> {
    Command::new(env!("CARGO_BIN_EXE_psmrt"))
        .args(arguments)
        .stdout(out)
        .stderr(errors)
        .status()
        .unwrap()
        .code()
}

#[test]
fn commands_end_as_they_should_where_nobody_reads() {
    for sink in [full, gone] {
        for (arguments, expected) in [
            (&["completions", "bash"] as &[&str], 0),
            (&["schema"], 0),
            (&["info", "--json"], 0),
            (&["conformance", "mistakes"], 0),
            (&["check", "/nowhere"], 2),
            (&["check", "/nowhere", "--json"], 2),
            (&["resume", "/nowhere"], 2),
        ] {
            assert_eq!(code(arguments, sink(), sink()), Some(expected), "{arguments:?}");
        }
    }
}

#[test]
fn a_run_goes_on_to_its_end_where_nobody_reads() {
    const STEPS: u64 = 600;
    Budget::oracle(614_400).spend(2 * STEPS * CELLS);
    for (name, sink) in [("full", full as fn() -> Stdio), ("gone", gone)] {
        let folder = Folder::new(name);
        let scene = write(&folder, STEPS, true);
        let out = folder.path("run");
        let mut child = start(&scene, &out);
        until("a checkpoint", || !checkpoints(&out).is_empty());
        child.kill().unwrap();
        child.wait().unwrap();
        let path = out.to_str().unwrap();
        assert_eq!(code(&["resume", path], sink(), sink()), Some(0), "{name}");
        let facts = std::fs::read_to_string(out.join("run.json")).unwrap();
        assert!(facts.contains("\"limit\""), "{name}: {facts}");
    }
}
