//! The kit as files: the same bytes each time, held by committed checksums, comparable between
//! machines; and clear words for kits and candidates that cannot be used.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::{Folder, psmrt, stderr, stdout};
use crate::conformance::kit;
use psmrt::conformance::KIT_VERSION;
use psmrt::conformance::checksums::{agree, parse, rows};
use psmrt::conformance::files::files;
use psmrt::conformance::kit::Kit;
use serde_json::Value;

fn export(folder: &Folder, name: &str) -> PathBuf {
    let kit = folder.path(name);
    let output = psmrt(&["conformance", "export", "--out", kit.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    kit
}

/// A candidate that answers one problem with the expected values, as files.
fn candidate(folder: &Folder, kit: &Path) -> PathBuf {
    let out = folder.path("candidate");
    fs::create_dir_all(out.join("weights")).unwrap();
    fs::write(
        out.join("manifest.json"),
        r#"{"name": "files", "precision": "f32", "kit_version": 3}"#,
    )
    .unwrap();
    fs::copy(kit.join("problems/weights/expected/weight.npy"), out.join("weights/weight.npy"))
        .unwrap();
    out
}

fn check(kit: &Path, candidate: &Path) -> (Option<i32>, String, String) {
    let output =
        psmrt(&["conformance", "check", kit.to_str().unwrap(), candidate.to_str().unwrap()]);
    (output.status.code(), stdout(&output), stderr(&output))
}

#[test]
fn two_exports_have_the_same_bytes_and_are_small() {
    let (one, two) = (files(kit()), files(&Kit::make().unwrap()));
    assert_eq!(one, two);
    let bytes: usize = one.values().map(Vec::len).sum();
    assert!(bytes < 3_000_000, "{bytes}");
}

#[test]
fn kit_is_the_committed_one_or_has_another_version() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/conformance/checksums.csv");
    let (version, committed) = parse(&fs::read_to_string(golden).unwrap()).unwrap();
    let remedy = "a change of any value of the kit needs a higher KIT_VERSION (src/conformance/mod.rs) and \
                  new checksums (golden/conformance/README.md)";
    assert_eq!(version, KIT_VERSION, "{remedy}");
    let found = rows(kit(), &files(kit()));
    assert_eq!(found.len(), committed.len(), "{remedy}");
    for (found, committed) in found.iter().zip(&committed) {
        assert!(agree(found, committed), "{found:?} was {committed:?}: {remedy}");
    }
}

#[test]
fn checksums_see_a_change_of_any_value_beyond_what_machines_differ_in() {
    let mut kit = kit().clone();
    let before = rows(&kit, &files(&kit));
    let changed = |kit: &Kit| {
        let after = rows(kit, &files(kit));
        before
            .iter()
            .zip(&after)
            .filter(|(a, b)| !agree(b, a))
            .map(|(a, _)| a.file.clone())
            .collect::<Vec<String>>()
    };
    let value = &mut kit.problems[2].expected[0].values.values[30];
    // The last bit is another machine's right, a millionth of a millionth is not.
    *value = value.next_up();
    assert_eq!(changed(&kit), Vec::<String>::new());
    kit.problems[2].expected[0].values.values[30] *= 1.0 + 1e-11;
    assert_eq!(changed(&kit), ["problems/srt/expected/post.npy"]);
}

#[test]
fn manifest_keeps_its_schema_and_lists_every_file() {
    let files = files(kit());
    let manifest: Value = serde_json::from_slice(&files["manifest.json"]).unwrap();
    let schema: Value = serde_json::from_slice(&files["manifest.schema.json"]).unwrap();
    for required in schema["required"].as_array().unwrap() {
        assert!(!manifest[required.as_str().unwrap()].is_null(), "{required}");
    }
    let mut listed = vec!["manifest.json", "manifest.schema.json", "candidate.schema.json"];
    listed.extend(["README.md", "checksums.csv"]);
    let flags = manifest["flags"].as_object().unwrap();
    for problem in manifest["problems"].as_array().unwrap() {
        for flag in problem["flags"].as_array().unwrap() {
            assert!(flags.contains_key(flag.as_str().unwrap()), "{flag} is not explained");
        }
        for array in ["given", "asked"].iter().flat_map(|kind| problem[kind].as_array().unwrap()) {
            listed.extend(["file", "csv", "gauge"].iter().filter_map(|key| array[key].as_str()));
        }
    }
    listed.sort_unstable();
    let there: Vec<&str> = files.keys().map(String::as_str).collect();
    assert_eq!(listed, there);
    for stage in 0..9 {
        let problems = manifest["problems"].as_array().unwrap();
        assert!(
            problems.iter().any(|problem| problem["stage"] == stage),
            "no problem in stage {stage}"
        );
    }
}

#[test]
fn nothing_is_overwritten() {
    let folder = Folder::new("kit_overwrite");
    folder.write("mine.txt", "mine");
    let path = folder.path("");
    let output = psmrt(&["conformance", "export", "--out", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("is not empty: name another folder with --out"), "{output:?}");
    assert_eq!(folder.entries(), ["mine.txt"]);
}

#[test]
fn check_exits_with_0_1_or_2_and_prints_one_json_object_on_request() {
    let folder = Folder::new("kit_check");
    let kit = export(&folder, "kit");
    let candidate = candidate(&folder, &kit);
    let (code, text, _) = check(&kit, &candidate);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("not attempted") && text.contains("passed: 1 of 91 answers"), "{text}");
    // A value that is off by a thousandth.
    let file = candidate.join("weights/weight.npy");
    let mut bytes = fs::read(&file).unwrap();
    let last = bytes.len() - 8;
    bytes[last..].copy_from_slice(&1.001_f64.to_le_bytes());
    fs::write(&file, bytes).unwrap();
    let (code, text, _) = check(&kit, &candidate);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("weights/weight: error") && text.contains("only at cell 24"), "{text}");
    let paths = [kit.to_str().unwrap(), candidate.to_str().unwrap()];
    let output = psmrt(&["conformance", "check", paths[0], paths[1], "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let json: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!((&json["passed"], &json["precision"]), (&false.into(), &"f32".into()));
    assert!(stderr(&output).is_empty(), "{}", stderr(&output));
}

#[test]
fn former_name_of_the_command_still_works_and_tells_the_new_one() {
    let (now, before) = (psmrt(&["conformance", "mistakes"]), psmrt(&["oracle", "mistakes"]));
    assert_eq!((now.status.code(), before.status.code()), (Some(0), Some(0)), "{before:?}");
    assert_eq!(stdout(&now), stdout(&before), "both names print the same");
    assert!(stderr(&now).is_empty(), "{now:?}");
    let hint = stderr(&before);
    assert!(hint.lines().count() == 1 && hint.contains("psmrt conformance"), "{hint}");
}

#[test]
fn kits_compare_within_the_bound_and_name_the_file_beyond_it() {
    let folder = Folder::new("kit_compare");
    let (one, two) = (export(&folder, "one"), export(&folder, "two"));
    let compare =
        || psmrt(&["conformance", "compare", one.to_str().unwrap(), two.to_str().unwrap()]);
    assert!(stdout(&compare()).contains("largest difference 0.00"));
    let file = two.join("problems/mrt/expected/post.npy");
    let mut bytes = fs::read(&file).unwrap();
    let at = bytes.len() - 8;
    let value = f64::from_le_bytes(bytes[at..].try_into().unwrap());
    bytes[at..].copy_from_slice(&value.next_up().to_le_bytes());
    fs::write(&file, &bytes).unwrap();
    assert_eq!(compare().status.code(), Some(0), "the last bit is within the bound");
    bytes[at..].copy_from_slice(&(value + 1e-12).to_le_bytes());
    fs::write(&file, &bytes).unwrap();
    let output = compare();
    assert_eq!(output.status.code(), Some(2));
    let text = stderr(&output);
    assert!(text.contains("mrt/expected/post.npy: value 151 is"), "{text}");
    // A kit that was tampered with judges nobody.
    let (code, _, text) = check(&two, &candidate(&folder, &one));
    assert_eq!(code, Some(2));
    assert!(text.contains("export the kit anew"), "{text}");
}

#[test]
fn bad_folders_are_refused_with_file_problem_and_remedy() {
    let folder = Folder::new("kit_bad");
    let kit = export(&folder, "kit");
    let candidate = candidate(&folder, &kit);
    let manifest = candidate.join("manifest.json");
    for (text, problem, remedy) in [
        ("", "EOF", "candidate.schema.json"),
        (r#"{"name": "x"}"#, "missing field `kit_version`", "write e.g."),
        (r#"{"name": "x", "kit_version": 7}"#, "kit_version = 7, the kit's is 3", "this version"),
        (r#"{"name": "x", "kit_version": 3, "precision": "f8"}"#, "unknown variant `f8`", "f32"),
        (r#"{"name": "x", "kit_version": 3, "order": 1}"#, "unknown field `order`", "write e.g."),
        (
            r#"{"name": "x", "kit_version": 3, "directions": [[0, 0, 0]]}"#,
            "directions lists 1 directions",
            "list all nineteen",
        ),
    ] {
        fs::write(&manifest, text).unwrap();
        let (code, _, error) = check(&kit, &candidate);
        assert_eq!(code, Some(2), "{error}");
        for word in ["candidate/manifest.json", problem, remedy] {
            assert!(error.contains(word), "{error}: no {word}");
        }
    }
    fs::remove_file(&manifest).unwrap();
    assert!(check(&kit, &candidate).2.contains("manifest.json: it cannot be read"));
    // The two folders the other way round.
    assert!(check(&candidate, &kit).2.contains("manifest.json"));
    fs::write(&manifest, r#"{"name": "x", "kit_version": 3}"#).unwrap();
    let (code, _, error) = check(&candidate, &kit);
    assert_eq!(code, Some(2));
    assert!(error.contains("is not the manifest of a kit"), "{error}");
    fs::remove_dir_all(candidate.join("weights")).unwrap();
    let (code, _, error) = check(&kit, &candidate);
    assert_eq!(code, Some(2));
    assert!(error.contains("has no answers: put them at"), "{error}");
    assert!(check(&kit.join("problems"), &candidate).2.contains("problems/manifest.json"));
}

#[test]
fn answers_that_cannot_be_used_are_wrong_with_their_reason() {
    let folder = Folder::new("kit_unusable");
    let kit = export(&folder, "kit");
    let candidate = candidate(&folder, &kit);
    let file = candidate.join("weights/weight.npy");
    let good = fs::read(&file).unwrap();
    let header = |from: &str, to: &str| {
        let text: Vec<u8> = good.clone();
        let at = text.windows(from.len()).position(|w| w == from.as_bytes()).unwrap();
        let mut text = text;
        text[at..at + to.len()].copy_from_slice(to.as_bytes());
        text
    };
    for (bytes, reason) in [
        (b"not an array".to_vec(), "it is no .npy file"),
        (good[..good.len() - 1].to_vec(), "it ends early: 199 bytes"),
        (header("<f8", "<c8"), "its values are of type \"<c8\""),
        (header("(25,)", "(5,5)"), "its shape is [5, 5], asked is [25] (cell)"),
        (header("'shape'", "'shap_'"), "its header has no shape"),
        (good[..40].to_vec(), "it is no .npy file"),
    ] {
        fs::write(&file, bytes).unwrap();
        let (code, text, _) = check(&kit, &candidate);
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains(&format!("weights/weight: {reason}")), "{text}: no {reason}");
    }
    // What is no file is not waited for.
    #[cfg(unix)]
    for (target, reason) in [("/dev/zero", "it is a device, not a file"), ("pipe", "it is a pipe")]
    {
        let pipe = candidate.join(".pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.is_ok_and(|status| status.success()), "mkfifo");
        fs::remove_file(&file).unwrap();
        std::os::unix::fs::symlink(target.replace("pipe", "../.pipe"), &file).unwrap();
        let (code, text, _) = check(&kit, &candidate);
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains(&format!("weights/weight: {reason}")), "{text}: no {reason}");
        fs::remove_file(pipe).unwrap();
    }
    fs::remove_file(&file).unwrap();
    let mut nan = good.clone();
    let last = nan.len() - 8;
    nan[last..].copy_from_slice(&f64::NAN.to_le_bytes());
    fs::write(&file, nan).unwrap();
    let (code, text, _) = check(&kit, &candidate);
    assert_eq!(code, Some(1));
    assert!(text.contains("some are not numbers"), "{text}");
    // What is not asked for is mentioned, not judged.
    fs::write(&file, good).unwrap();
    folder.write("candidate/weights/wieght.npy", "x");
    folder.write("candidate/notes.txt", "x");
    let (code, text, _) = check(&kit, &candidate);
    assert_eq!(code, Some(0), "{text}");
    assert!(
        text.contains("weights/wieght is no answer") && text.contains("notes.txt is no"),
        "{text}"
    );
}

#[test]
fn arrays_of_every_kind_that_numpy_writes_are_read() {
    use psmrt::conformance::Array;
    let npy = |descr: &str, fortran: &str, shape: &str, values: &[u8]| {
        let mut header =
            format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}")
                .into_bytes();
        header.resize(117, b' ');
        header.push(b'\n');
        let mut bytes = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
        bytes.extend(&header);
        bytes.extend(values);
        Array::of_npy(&bytes).unwrap()
    };
    // Half precision: 1, -2, the smallest number of all, the largest, infinity.
    let halves = [0x3c00_u16, 0xc000, 0x0001, 0x7bff, 0x7c00];
    let halves: Vec<u8> = halves.iter().flat_map(|bits| bits.to_le_bytes()).collect();
    let found = npy("<f2", "False", "(5,)", &halves).values;
    assert_eq!(found, [1.0, -2.0, 2.0_f64.powi(-24), 65504.0, f64::INFINITY]);
    let single: Vec<u8> = [0.5_f32, -3.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    assert_eq!(npy("<f4", "False", "(2,)", &single).values, [0.5, -3.0]);
    assert_eq!(npy("|i1", "False", "()", &[0xff]), psmrt::conformance::Array::number(-1.0));
    // Two rows of three, column by column.
    let turned = npy("|u1", "True", "(2, 3)", &[1, 4, 2, 5, 3, 6]);
    assert_eq!((turned.shape, turned.values), (vec![2, 3], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
}
