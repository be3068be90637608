//! The conformance kit, and candidates in other languages: running them, and what the judge says of them.

#![allow(dead_code, reason = "the tests and the example use different parts of this")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use psmrt::conformance::judge::judge_submission;
use psmrt::conformance::judged::Submission;
use psmrt::conformance::kit::Kit;
use psmrt::conformance::mistakes::CATALOGUE;
use psmrt::conformance::{Candidate, Verdict};

/// The kit, which takes a second to make, once in a process.
pub fn kit() -> &'static Kit {
    static KIT: OnceLock<Kit> = OnceLock::new();
    KIT.get_or_init(|| Kit::make().expect("the kit can be made"))
}

/// The verdict on what a candidate in Rust answers.
pub fn judged(candidate: &mut dyn Candidate) -> Verdict {
    judge_submission(kit(), &Submission::of(kit(), candidate))
}

/// The folder of the candidates.
pub fn sources() -> PathBuf {
    // The package of the tests, or the root above it.
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let roots = package.ancestors().map(|folder| folder.join("golden/conformance"));
    roots.filter(|folder| folder.is_dir()).last().expect("golden/conformance is there")
}

/// Why Python cannot be used here, if it cannot.
pub fn python_missing() -> Option<&'static str> {
    let there = Command::new("python3").args(["-c", "import numpy"]).output();
    match there {
        Ok(output) if output.status.success() => None,
        _ => Some("no python3 with numpy"),
    }
}

/// Why C cannot be compiled here, if it cannot.
pub fn compiler_missing() -> Option<&'static str> {
    match Command::new("cc").arg("--version").output() {
        Ok(output) if output.status.success() => None,
        _ => Some("no cc"),
    }
}

/// A fresh folder of the given name in `parent`, and the kit in its sub-folder `kit`.
pub fn with_kit(parent: &Path, name: &str) -> PathBuf {
    let folder = parent.join(format!("{name}_{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    psmrt::conformance::files::export(&folder.join("kit")).expect("the kit is written");
    folder
}

/// Runs a command to its end; panics with what it said if it fails.
pub fn run(command: &mut Command) -> Output {
    let output = command.env("PYTHONDONTWRITEBYTECODE", "1").output().expect("the command starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {said}");
    output
}

/// The NumPy candidate, answering `kit` into `out`.
pub fn numpy_candidate(kit: &Path, out: &Path, options: &[&str]) -> Command {
    let mut command = Command::new("python3");
    command.arg(sources().join("numpy_candidate.py")).arg(kit).arg(out).args(options);
    command
}

/// The verdict on the answers in a folder.
pub fn verdict(folder: &Path) -> Verdict {
    let submission =
        psmrt::conformance::folder::read(kit(), folder).expect("the answers can be read");
    judge_submission(kit(), &submission)
}

/// The confusion table: what the judge says of the NumPy candidate, in the given precision, with each
/// mistake planted.
pub fn confusion(folder: &Path, precision: &str) -> String {
    let names: Vec<&str> = CATALOGUE.iter().map(|entry| entry.name).collect();
    // Two processes, for two cores.
    let halves = names.chunks(names.len().div_ceil(2)).enumerate().map(|(half, names)| {
        let out = folder.join(format!("half_{half}"));
        let mut command = numpy_candidate(
            &folder.join("kit"),
            &out,
            &["--precision", precision, "--mistake", &names.join(",")],
        );
        (names, out, std::thread::spawn(move || run(&mut command)))
    });
    let halves: Vec<_> = halves.collect();
    let mut table =
        String::from("planted,named,others_that_fit,wrong_answers,first_wrong_answer\n");
    for (names, out, running) in halves {
        running.join().expect("the candidate runs");
        for name in names {
            let verdict = verdict(&out.join(name));
            let wrong: Vec<_> = verdict.judged.iter().filter(|judged| judged.failed()).collect();
            let fits = verdict.diagnosis.as_ref().map_or(&[][..], |diagnosis| &diagnosis.single);
            let named = fits.first().map_or("", |fit| fit.mistake.entry().name);
            let first =
                wrong.first().map_or_else(String::new, |w| format!("{}/{}", w.problem, w.answer));
            let others = fits.len().saturating_sub(1);
            table.push_str(&format!("{name},{named},{others},{},{first}\n", wrong.len()));
        }
    }
    table
}
