//! Tells the program which commit it was built from, and whether its sources had been changed since.
//! The commit is read from `.git` without needing git; the changes are what git says, if it is there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the program is made of. Reports are written to `report/validation`, which is no source.
const SOURCES: [&str; 8] = [
    "src",
    "reference",
    "report/src",
    "report/Cargo.toml",
    "tests/validation/src",
    "tests/validation/Cargo.toml",
    "Cargo.toml",
    "Cargo.lock",
];

fn main() {
    // Each time that the sources change, they may begin or cease to be those of the commit.
    SOURCES.iter().for_each(|path| println!("cargo::rerun-if-changed={path}"));
    let Some(commit) = folder(Path::new(".git")).and_then(|git| commit(&git)) else { return };
    println!("cargo::rustc-env=PSMRT_COMMIT={commit}");
    if let Some(modified) = modified() {
        println!("cargo::rustc-env=PSMRT_MODIFIED={modified}");
    }
}

/// The folder that git keeps this checkout in: `.git`, or where that file points to in a worktree.
fn folder(git: &Path) -> Option<PathBuf> {
    if git.is_dir() {
        return Some(git.to_owned());
    }
    let text = fs::read_to_string(git).ok()?;
    Some(PathBuf::from(text.strip_prefix("gitdir:")?.trim()))
}

/// The commit that is checked out.
fn commit(git: &Path) -> Option<String> {
    let head = fs::read_to_string(git.join("HEAD")).ok()?;
    println!("cargo::rerun-if-changed={}", git.join("HEAD").display());
    let Some(name) = head.trim().strip_prefix("ref: ") else { return Some(head.trim().to_owned()) };
    // Branches are kept in the main checkout.
    let common = match fs::read_to_string(git.join("commondir")) {
        Ok(common) => git.join(common.trim()),
        Err(_) => git.to_owned(),
    };
    let loose = common.join(name);
    println!("cargo::rerun-if-changed={}", loose.display());
    if let Ok(commit) = fs::read_to_string(&loose) {
        return Some(commit.trim().to_owned());
    }
    let packed = fs::read_to_string(common.join("packed-refs")).ok()?;
    let line = packed.lines().find(|line| line.ends_with(name))?;
    Some(line.split_whitespace().next()?.to_owned())
}

/// Whether the sources differ from those of the commit; `None` if git cannot be asked.
fn modified() -> Option<bool> {
    let mut git = Command::new("git");
    // Git shall not refresh its index here: that would be a change for the next build.
    git.args(["--no-optional-locks", "status", "--porcelain", "--"]).args(SOURCES);
    let output = git.output().ok().filter(|output| output.status.success())?;
    Some(!output.stdout.is_empty())
}
