//! Runs that are started and killed: a grain from a list in a small box.

#![allow(dead_code, reason = "each test binary is a crate of its own and uses a part of this")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use psmrt::run::Watcher;

use super::Folder;
use crate::scenes::water;

/// Cells of the box.
pub const CELLS: u64 = 8 * 8 * 8;

/// Its scene, which ends after `steps` and saves its state every 20 steps, or never.
pub fn scene(steps: u64, saves: bool) -> String {
    let checkpoint = if saves { "[checkpoint]\nevery_steps = 20\n" } else { "" };
    water([8, 8, 8], 1e-5, &format!("{SECTIONS}{checkpoint}[stop]\nsteps = {steps}\n"))
}

const SECTIONS: &str = r#"
[body_force]
acceleration = [1.0, 0.0, 0.0]
[[grains]]
kind = "csv"
file = "list.csv"
[[records]]
name = "box"
kind = "box"
every_steps = 5
[[records]]
name = "middle"
kind = "slice"
axis = "z"
every_steps = 500
[[records]]
name = "loads"
kind = "loads"
"#;

const LIST: &str = "x (m),y (m),z (m),diameter (m)\n4e-5,4e-5,4e-5,4e-5\n";

/// Writes the scene and its list.
pub fn write(folder: &Folder, steps: u64, saves: bool) -> PathBuf {
    folder.write("list.csv", LIST);
    folder.write("scene.toml", scene(steps, saves))
}

/// Starts a run.
pub fn start(scene: &Path, out: &Path) -> Child {
    Command::new(env!("CARGO_BIN_EXE_psmrt"))
        .arg("run")
        .arg(scene)
        .arg("--out")
        .arg(out)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Waits, for a minute at most.
pub fn until(what: &str, done: impl Fn() -> bool) {
    let start = Instant::now();
    while !done() {
        assert!(start.elapsed() < Duration::from_secs(60), "a minute was not enough: {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A watcher that goes on until so many steps have been made.
pub struct Until(pub u64);

impl Watcher for Until {
    fn watch(&mut self, steps: u64, _: Option<f64>) -> bool {
        steps < self.0
    }
}

/// The checkpoints of a run, the oldest first.
pub fn checkpoints(out: &Path) -> Vec<PathBuf> {
    psmrt::checkpoint::list(out).unwrap()
}

/// Starts a run and kills it once it has two checkpoints; its folder.
pub fn killed(folder: &Folder, scene: &Path, name: &str) -> PathBuf {
    let out = folder.path(name);
    let mut child = start(scene, &out);
    until("two checkpoints", || checkpoints(&out).len() == 2);
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(checkpoints(&out).len(), 2);
    out
}

/// All files below a folder but the lock, with their bytes.
pub fn bytes(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    fn gather(folder: &Path, found: &mut Vec<(PathBuf, Vec<u8>)>) {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                gather(&path, found);
            } else if path.file_name().unwrap() != "run.lock" {
                let bytes = fs::read(&path).unwrap();
                found.push((path, bytes));
            }
        }
    }
    let mut found = Vec::new();
    gather(folder, &mut found);
    found.sort();
    found
}

/// What a checkpoint says about itself (src/checkpoint.rs).
pub fn header(checkpoint: &Path) -> serde_json::Value {
    let bytes = fs::read(checkpoint).unwrap();
    let length = u64::from_le_bytes(bytes[8..16].try_into().unwrap());
    serde_json::from_slice(&bytes[16..16 + usize::try_from(length).unwrap()]).unwrap()
}
