//! Tells the program which commit it was built from, without needing git: reads `.git/HEAD`.

use std::fs;
use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=src/build.rs");
    if let Some(commit) = commit(Path::new(".git")) {
        println!("cargo::rustc-env=PSMRT_COMMIT={commit}");
    }
}

/// The commit that is checked out, if this is a checkout.
fn commit(git: &Path) -> Option<String> {
    let head = fs::read_to_string(git.join("HEAD")).ok()?;
    println!("cargo::rerun-if-changed={}", git.join("HEAD").display());
    let Some(name) = head.trim().strip_prefix("ref: ") else { return Some(head.trim().to_owned()) };
    let loose = git.join(name);
    println!("cargo::rerun-if-changed={}", loose.display());
    if let Ok(commit) = fs::read_to_string(&loose) {
        return Some(commit.trim().to_owned());
    }
    let packed = fs::read_to_string(git.join("packed-refs")).ok()?;
    let line = packed.lines().find(|line| line.ends_with(name))?;
    Some(line.split_whitespace().next()?.to_owned())
}
