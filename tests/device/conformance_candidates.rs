//! Candidates in Python and C answer the kit and are judged, with and without planted mistakes. Where
//! the language is missing they are listed as ignored, with the reason; with PSMRT_REQUIRE_PYTHON=1 that
//! is a failure.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::conformance::{self, numpy_candidate, run, sources, verdict, with_kit};
use libtest_mimic::{Failed, Trial};

/// The trials of the candidates.
pub fn trials() -> Vec<Trial> {
    let (python, cc) = (conformance::python_missing(), conformance::compiler_missing());
    vec![
        trial("numpy_candidate_passes_in_double_single_and_half_precision", python, precisions),
        trial("each_mistake_planted_in_the_numpy_candidate_is_named", python, mistakes),
        trial("first_answers_of_the_readme_are_right", python, first_answers),
        trial("c_candidate_passes_stages_0_to_2", cc, c_candidate),
    ]
}

/// A trial that is ignored, or fails, where what it needs is missing.
fn trial(claim: &str, missing: Option<&'static str>, test: fn()) -> Trial {
    let name = format!("conformance_candidates::{claim}");
    let required = std::env::var_os("PSMRT_REQUIRE_PYTHON").is_some_and(|value| value == "1");
    match missing {
        None => Trial::test(name, move || {
            test();
            Ok(())
        }),
        Some(reason) if required => Trial::test(name, move || {
            Err(Failed::from(format!("{reason}, and PSMRT_REQUIRE_PYTHON=1")))
        }),
        Some(reason) => Trial::test(name, || Ok(()))
            .with_kind(format!("NOT RUN: {reason}"))
            .with_ignored_flag(true),
    }
}

/// A folder of the trial's own with the kit in it.
fn folder(name: &str) -> PathBuf {
    with_kit(Path::new(env!("CARGO_TARGET_TMPDIR")), name)
}

fn precisions() {
    let folder = folder("numpy_precisions");
    let precisions = ["f64", "f32", "f16-storage"];
    // A process each, side by side.
    std::thread::scope(|threads| {
        for precision in precisions {
            let (kit, out) = (folder.join("kit"), folder.join(precision));
            threads.spawn(move || {
                run(&mut numpy_candidate(&kit, &out, &["--precision", precision]));
            });
        }
    });
    for precision in precisions {
        let verdict = verdict(&folder.join(precision));
        assert!(verdict.passed() && verdict.unasked.is_empty(), "{verdict}");
        assert_eq!(verdict.attempted(), verdict.judged.len());
        // It passes with room to spare: 1.3 was measured, in single precision.
        assert!(verdict.largest_error() < 3.0, "{verdict}");
    }
    fs::remove_dir_all(folder).unwrap();
}

fn mistakes() {
    let folder = folder("numpy_mistakes");
    let table = conformance::confusion(&folder, "f64");
    let golden = fs::read_to_string(sources().join("confusion.csv")).unwrap();
    let golden: Vec<&str> = golden.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!(
        table.lines().collect::<Vec<_>>(),
        golden,
        "see tests/validation/examples/confusion.rs"
    );
    let mut planted = 0;
    for line in &golden[1..] {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!((fields[0], fields[2]), (fields[1], "0"), "{line}");
        planted += 1;
    }
    assert!(planted >= 25, "{planted}");
    fs::remove_dir_all(folder).unwrap();
}

/// The program in the kit's README is run as it is printed there, and once with its mistake.
fn first_answers() {
    let folder = folder("readme");
    let readme = fs::read_to_string(folder.join("kit/README.md")).unwrap();
    let (_, rest) = readme.split_once("```python\n").unwrap();
    let (program, _) = rest.split_once("```").unwrap();
    run(Command::new("python3").args(["-c", program]).current_dir(&folder));
    let right = verdict(&folder.join("candidate"));
    assert!(right.passed() && right.attempted() == 3, "{right}");
    fs::remove_dir_all(folder.join("candidate")).unwrap();
    let without_tau = program.replace(" / tau[:, None]", "");
    assert_ne!(program, without_tau);
    run(Command::new("python3").args(["-c", &without_tau]).current_dir(&folder));
    let wrong = verdict(&folder.join("candidate"));
    let named = wrong.diagnosis.as_ref().and_then(|diagnosis| diagnosis.named());
    assert_eq!(named.map(|mistake| mistake.entry().name), Some("eq2_without_tau"), "{wrong}");
    fs::remove_dir_all(folder).unwrap();
}

fn c_candidate() {
    let folder = folder("c_candidate");
    let program = folder.join("c_candidate");
    let source = sources().join("c_candidate.c");
    let flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-o"];
    run(Command::new("cc").args(flags).arg(&program).arg(&source).arg("-lm"));
    run(Command::new(&program).arg(folder.join("kit")).arg(folder.join("candidate")));
    let verdict = verdict(&folder.join("candidate"));
    assert!(verdict.passed() && verdict.unasked.is_empty(), "{verdict}");
    assert_eq!(verdict.attempted(), 6 + 5 + 24);
    fs::remove_dir_all(folder).unwrap();
}
