//! The house rules that a machine can hold.

use std::fs;
use std::path::{Path, PathBuf};

/// All files below `folder` whose name ends in one of `endings`, sorted.
fn files(folder: &str, endings: &[&str]) -> Vec<PathBuf> {
    fn gather(folder: &Path, endings: &[&str], found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                gather(&entry, endings, found);
            } else if endings.iter().any(|ending| entry.to_string_lossy().ends_with(ending)) {
                found.push(entry);
            }
        }
    }
    let mut found = Vec::new();
    gather(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), endings, &mut found);
    found.sort();
    found
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The sum of the literals in all calls of `call` in the tests.
fn declared(call: &str) -> u64 {
    let mut sum = 0;
    for path in files("tests", &[".rs"]) {
        let text = text(&path);
        for rest in text.split(call).skip(1) {
            let literal = rest.split(')').next().unwrap();
            match literal.replace('_', "").parse::<u64>() {
                Ok(updates) => sum += updates,
                // Its own definition, and this file.
                Err(_) => assert!(
                    path.ends_with("tests/common/mod.rs") || path.ends_with("tests/suite/tidy.rs"),
                    "{}: declare the budget as a literal, not {literal:?}",
                    path.display()
                ),
            }
        }
    }
    sum
}

#[test]
fn declared_cell_updates_of_all_tests_stay_within_the_budget_of_the_suite() {
    // Together with all else, six minutes on two cores: the oracle makes four to ten million a second on two.
    let oracle = declared("Budget::oracle(");
    assert!(oracle <= 770_000_000, "the tests declare {oracle} cell updates of the oracle");
    // The kernel's, on a software adapter, and the CPU engine's.
    let kernel = declared("Budget::kernel(");
    assert!(kernel <= 2_600_000_000, "the tests declare {kernel} cell updates of the kernel");
}

#[test]
fn every_file_of_tests_is_among_the_modules_of_its_binary() {
    for (folder, top) in [
        ("oracle", "all.rs"),
        ("suite", "main.rs"),
        ("device", "main.rs"),
        ("validation/tests/suite", "main.rs"),
        ("validation/tests/device", "main.rs"),
    ] {
        let folder = format!("tests/{folder}");
        let modules = text(&files(&folder, &[top])[0]);
        for path in files(&folder, &[".rs"]) {
            let beside_top = path.parent().is_some_and(|parent| parent.ends_with(&folder));
            let name = path.file_stem().unwrap().to_str().unwrap();
            let listed = modules.lines().any(|line| line == format!("mod {name};"));
            assert!(
                listed || !beside_top || path.ends_with(top),
                "{} is not among the modules of {folder}/{top}: nothing runs it",
                path.display()
            );
        }
    }
}

#[test]
fn proofs_of_the_oracle_alone_are_run_with_its_package() {
    const WORDS: [&str; 6] = [
        "psmrt::",
        "CARGO_BIN_EXE",
        "crate::cli",
        "crate::conformance",
        "crate::edges",
        "crate::parity",
    ];
    for folder in ["tests/suite", "tests/device"] {
        for path in files(folder, &[".rs"]) {
            let in_folder = path.parent().is_some_and(|parent| parent.ends_with(folder));
            let text = text(&path);
            assert!(
                !in_folder
                    || path.ends_with("main.rs")
                    || path.ends_with("circles.rs")
                    || WORDS.iter().any(|word| text.contains(word)),
                "{}: nothing but the reference is tested here, so it belongs into tests/oracle",
                path.display()
            );
        }
    }
}

#[test]
fn every_test_named_in_the_errata_exists() {
    let errata = text(&files("reference", &["ERRATA.md"])[0]);
    let mut named = 0;
    for row in errata.lines().filter(|line| line.starts_with('|')) {
        let Some((_, tests)) = row.split_once("`tests/") else { continue };
        let (file, names) = tests.split_once('`').unwrap();
        let Some(names) = names.strip_prefix(": ") else { continue };
        let code = text(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(file));
        for name in names.split('|').next().unwrap().split(", ") {
            let name = name.trim().trim_matches('`');
            assert!(code.contains(&format!("fn {name}()")), "{file} has no test {name}");
            named += 1;
        }
    }
    assert!(named >= 9, "only {named} tests are named: has the table changed its form?");
}

#[test]
fn reference_knows_nothing_of_scenes_gpus_or_reports_and_the_report_nothing_of_solvers() {
    for (package, foreign) in [
        ("reference", &["psmrt::", "psmrt_report", "wgpu", "serde", "toml"] as &[&str]),
        ("report", &["psmrt::", "psmrt_reference", "wgpu"]),
    ] {
        for path in files(package, &[".rs", "Cargo.toml"]) {
            let text = text(&path);
            for word in foreign {
                assert!(!text.contains(word), "{} mentions {word}", path.display());
            }
        }
    }
}

#[test]
fn nothing_points_back_to_the_validation() {
    for folder in ["src", "reference", "report"] {
        for path in files(folder, &[".rs"]) {
            // Its name with an underscore is what a use of it would be called.
            assert!(!text(&path).contains("psmrt_validation"), "{} uses it", path.display());
        }
    }
    for manifest in ["reference/Cargo.toml", "report/Cargo.toml", "Cargo.toml"] {
        let all = text(&Path::new(env!("CARGO_MANIFEST_DIR")).join(manifest));
        assert!(!all.contains("psmrt-validation"), "{manifest} depends on it");
    }
}

#[test]
fn rooms_of_the_product_use_only_those_below_them() {
    // Lowest first.
    const ROOMS: [&str; 30] = [
        "quote",
        "number_type",
        "npy",
        "machine",
        "input",
        "units",
        "table",
        "provenance",
        "convergence",
        "voxels",
        "bodies",
        "packing",
        "exact",
        "in_time",
        "lanes",
        "ball",
        "cpu",
        "kernel",
        "scene",
        "diagnosis",
        "engine",
        "seepage",
        "courses",
        "stopped_grain",
        "output",
        "checkpoint",
        "run",
        "advice",
        "conformance",
        "command",
    ];
    let height = |room: &str| ROOMS.iter().position(|known| *known == room);
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut uses = 0;
    for path in files("src", &[".rs"]) {
        let inside = path.strip_prefix(&src).unwrap().iter().next().unwrap().to_str().unwrap();
        let room = inside.trim_end_matches(".rs");
        if ["main", "lib", "build"].contains(&room) {
            continue;
        }
        let own = height(room).unwrap_or_else(|| panic!("src/{inside} has no place among ROOMS"));
        let text = text(&path);
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        for rest in code.flat_map(|line| line.split("crate::").skip(1)) {
            // One name, or several in braces.
            let names = rest.strip_prefix('{').map_or(rest, |all| all.split('}').next().unwrap());
            for name in names.split(',') {
                let end = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
                let used = name.trim().split(end).next().unwrap();
                let Some(height) = height(used) else { continue };
                assert!(height <= own, "{} uses {used}, which stands above {room}", path.display());
                uses += 1;
                if !rest.starts_with('{') {
                    break;
                }
            }
        }
    }
    assert!(uses > 100, "only {uses} uses were found: has their form changed?");
}

#[test]
fn the_product_embeds_no_golden_table() {
    for path in files("src", &[".rs"]) {
        let text = text(&path);
        let embeds = text
            .split("include_")
            .skip(1)
            .any(|rest| rest.split(')').next().is_some_and(|call| call.contains("golden/")));
        assert!(!embeds, "{} embeds a golden table", path.display());
    }
}

#[test]
fn kernel_and_cpu_engine_take_from_the_reference_only_words_for_set_ups() {
    // Module, and the names that may be taken from it; none where all of it is vocabulary.
    const ALLOWED: [(&str, &[&str]); 12] = [
        ("directions", &[]),
        ("domain", &[]),
        ("drive", &[]),
        ("guard", &["Failure", "Guard", "Findings"]),
        ("solids", &[]),
        ("setup", &[]),
        ("rates", &[]),
        ("collision", &["Collision"]),
        ("coverage", &["CoverageRule"]),
        ("partial_saturation", &["SolidOperator", "Weighting"]),
        ("graded_viscosity", &["CUT_MAGIC"]),
        ("lattice", &["Populations", "Vec3"]),
    ];
    let mut uses = 0;
    let rooms = ["src/kernel", "src/cpu"].into_iter().flat_map(|room| files(room, &[".rs"]));
    for path in rooms {
        let text = text(&path);
        for rest in text.split("psmrt_reference::").skip(1) {
            let path_of_use = rest.split(['\n', ';', '(', ' ', '.', ')']).next().unwrap();
            let (module, names) = path_of_use.split_once("::").unwrap_or((path_of_use, ""));
            // The braces of a `use` of several names.
            let names = rest
                .strip_prefix(&format!("{module}::{{"))
                .map_or(names, |list| list.split('}').next().unwrap());
            let allowed = ALLOWED.iter().find(|(known, _)| *known == module);
            let Some((_, known)) = allowed else {
                panic!("{} takes `{path_of_use}` from the reference", path.display());
            };
            for name in names.split(',').map(|name| name.trim().trim_matches(['{', '}'])) {
                assert!(
                    known.is_empty() || known.contains(&name),
                    "{} takes `{module}::{name}` from the reference",
                    path.display()
                );
            }
            uses += 1;
        }
        // Methods that compute would come along with the words.
        for method in
            [".weight(", "exact_fraction", "share_weight", ".diagonal(", ".fraction(", ".covered("]
        {
            assert!(!text.contains(method), "{} calls {method}", path.display());
        }
    }
    assert!(uses > 10, "only {uses} uses were found: has their form changed?");
}

#[test]
fn every_mutant_of_the_oracle_that_survived_is_explained() {
    for file in
        ["list.csv", "grains.csv", "packings.csv"].map(|name| format!("golden/mutants/{name}"))
    {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&file);
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
        let rows: Vec<_> = reader.records().map(|row| row.unwrap()).collect();
        assert!(rows.iter().any(|row| &row[2] == "caught"), "{file}: none was caught");
        for row in rows.iter().filter(|row| &row[2] == "survived") {
            assert!(
                !row[3].is_empty(),
                "{file}: {} {}: which test fails, or why is it equivalent?",
                &row[0],
                &row[1]
            );
        }
    }
}

#[test]
fn readme_is_short_and_shows_the_scene_of_its_picture() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = text(&root.join("README.md"));
    let lines = readme.lines().count();
    assert!(lines <= 150, "the README has {lines} lines: more than 150 belong into docs/");
    let scene = text(&root.join("docs/grains_in_water.toml"));
    assert!(
        readme.contains(&scene),
        "the README shows another scene than docs/grains_in_water.toml"
    );
}

#[test]
fn nothing_is_unsafe_but_asking_for_memory_ahead() {
    let mut seen = 0;
    for path in
        ["src", "reference", "report", "tests"].into_iter().flat_map(|room| files(room, &[".rs"]))
    {
        // This file, and the one that may.
        if path.ends_with("tests/suite/tidy.rs") || path.ends_with("src/cpu/prefetch.rs") {
            seen += 1;
            continue;
        }
        let word =
            text(&path).split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|w| w == "unsafe");
        assert!(!word, "{} has unsafe code", path.display());
    }
    assert_eq!(seen, 2, "the file that may has moved");
    let blocks = text(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cpu/prefetch.rs"));
    assert_eq!(blocks.matches("unsafe {").count(), 1, "src/cpu/prefetch.rs holds one block");
}
