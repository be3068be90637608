//! What a run cannot go on from is refused by name, and nothing is lost by trying.

use std::fs;
use std::path::Path;

use crate::cli::runs::{self, CELLS, bytes, checkpoints, header, killed, start, until, write};
use crate::cli::{Folder, psmrt, stderr, stdout};
use crate::common::Budget;

/// Longer than any test waits: these runs are killed.
const ENDLESS: u64 = 1_000_000_000;

/// `psmrt resume` with these arguments is refused with exit code 2 and changes nothing in `out`; what it says.
fn refused(out: &Path, arguments: &[&str]) -> String {
    let before = bytes(out);
    let output = psmrt(&[&["resume", out.to_str().unwrap()], arguments].concat());
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
    assert!(bytes(out) == before, "a refused resume has changed a file: {}", stderr(&output));
    stderr(&output)
}

/// Replaces text in a file.
fn edit(path: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

#[test]
fn an_edited_list_of_grains_is_refused_by_name_and_no_older_checkpoint_offered() {
    let folder = Folder::new("edited_list");
    let out = killed(&folder, &write(&folder, ENDLESS, true), "run");
    // The same number of bytes, and a scene that is as good.
    edit(&out.join("grains_0.csv"), "4e-5\n", "3e-5\n");
    let said = refused(&out, &[]);
    assert!(said.contains("grains_0.csv has been changed since"), "{said}");
    assert!(!said.contains("an older one"), "the older one fails alike: {said}");
    edit(&out.join("grains_0.csv"), "3e-5\n", "4e-5\n");
    edit(&out.join("scene.toml"), "tau = 0.8", "tau = 0.9");
    let said = refused(&out, &[]);
    assert!(said.contains("scene.toml has been changed since"), "{said}");
}

#[test]
fn a_checkpoint_of_another_run_of_the_same_scene_is_refused() {
    let folder = Folder::new("other_run");
    let scene = write(&folder, ENDLESS, true);
    let (one, other) = (killed(&folder, &scene, "one"), killed(&folder, &scene, "other"));
    let foreign = checkpoints(&other).pop().unwrap();
    let said = refused(&one, &["--checkpoint", foreign.to_str().unwrap()]);
    assert!(said.contains("belongs to another run of this scene"), "{said}");
}

#[test]
fn edited_rows_of_a_table_are_refused_and_an_older_checkpoint_offered_only_if_it_knows_them() {
    let folder = Folder::new("edited_rows");
    let out = killed(&folder, &write(&folder, ENDLESS, true), "run");
    let table = out.join("box.csv");
    let whole = fs::read(&table).unwrap();
    let known = checkpoints(&out);
    let length = |checkpoint: &Path| {
        let length = header(checkpoint)["progress"]["tables"][0]["length"].as_u64().unwrap();
        usize::try_from(length).unwrap()
    };
    let (older, newest) = (length(&known[0]), length(&known[1]));
    assert!(older < newest, "{older} {newest}");
    // The last bytes before the end of a row, which both have or only the newest.
    for (at, is_offered) in [(older - 2, false), (newest - 2, true)] {
        let mut edited = whole.clone();
        edited[at] = if edited[at] == b'1' { b'2' } else { b'1' };
        fs::write(&table, edited).unwrap();
        let said = refused(&out, &[]);
        assert!(said.contains("box.csv") && said.contains("have been changed"), "{said}");
        assert_eq!(said.contains("an older one is there"), is_offered, "byte {at}: {said}");
    }
    fs::write(&table, &whole[..older - 2]).unwrap();
    let said = refused(&out, &[]);
    assert!(said.contains("box.csv") && said.contains("shorter than"), "{said}");
    fs::remove_file(&table).unwrap();
    assert!(refused(&out, &[]).contains("box.csv"));
}

#[test]
fn a_checkpoint_of_another_format_is_refused() {
    let folder = Folder::new("format");
    let out = killed(&folder, &write(&folder, ENDLESS, true), "run");
    let newest = checkpoints(&out).pop().unwrap();
    let mut old = fs::read(&newest).unwrap();
    old[..8].copy_from_slice(b"PSMRTCK4");
    fs::write(&newest, old).unwrap();
    let said = refused(&out, &[]);
    assert!(said.contains("another version of psmrt"), "{said}");
}

#[test]
fn checkpoints_that_cannot_be_listed_are_an_error_and_not_a_fresh_start() {
    let folder = Folder::new("unlistable");
    let out = killed(&folder, &write(&folder, ENDLESS, true), "run");
    fs::rename(out.join("checkpoints"), folder.path("elsewhere")).unwrap();
    // A file cannot be listed, whoever asks; a folder without leave could be by root.
    fs::write(out.join("checkpoints"), "").unwrap();
    assert!(refused(&out, &[]).contains("checkpoints"));
}

#[test]
fn a_finished_run_is_said_to_have_finished_and_left_alone() {
    Budget::oracle(10_240).spend(20 * CELLS);
    let folder = Folder::new("finished");
    let out = folder.path("run");
    assert!(start(&write(&folder, 20, true), &out).wait().unwrap().success());
    let before = bytes(&out);
    let path = out.to_str().unwrap();
    let output = psmrt(&["resume", path]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("has finished"), "{}", stdout(&output));
    let output = psmrt(&["resume", path, "--json"]);
    let said: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(said["resumed"], false, "{said}");
    assert_eq!(said["run"]["steps"], 20, "{said}");
    assert!(bytes(&out) == before, "a finished run has been changed");
}

#[test]
fn tables_of_a_run_without_a_checkpoint_are_set_aside_when_it_starts_again() {
    const STEPS: u64 = 600;
    // Killed, again, and the whole.
    Budget::oracle(921_600).spend(3 * STEPS * CELLS);
    let folder = Folder::new("aside");
    let scene = write(&folder, STEPS, false);
    let (whole, out) = (folder.path("whole"), folder.path("run"));
    assert!(start(&scene, &whole).wait().unwrap().success());
    let mut child = start(&scene, &out);
    let table = out.join("box.csv");
    until("rows", || fs::read_to_string(&table).is_ok_and(|text| text.lines().count() > 3));
    child.kill().unwrap();
    child.wait().unwrap();
    let rows = fs::read(&table).unwrap();
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("set aside as"), "{}", stderr(&output));
    assert!(fs::read(out.join("box.csv.old")).unwrap() == rows, "the old rows are not kept");
    assert!(fs::read(&table).unwrap() == fs::read(whole.join("box.csv")).unwrap());
}

#[cfg(unix)]
#[test]
fn a_run_begun_by_auto_on_the_cpu_goes_on_there_once_an_adapter_has_appeared() {
    const STEPS: u64 = 600;
    Budget::oracle(614_400).spend(2 * STEPS * CELLS);
    let folder = Folder::new("auto");
    let text = runs::scene(STEPS, true) + "[engine]\nkind = \"auto\"\nadapter = \"llvmpipe\"\n";
    write(&folder, STEPS, true);
    let scene = folder.write("auto.toml", text);
    let out = folder.path("run");
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_psmrt"))
        .args(["run", scene.to_str().unwrap(), "--out", out.to_str().unwrap()])
        .env("VK_ICD_FILENAMES", "/nowhere")
        .env("VK_DRIVER_FILES", "/nowhere")
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    until("a checkpoint", || !checkpoints(&out).is_empty());
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = fs::read_to_string(out.join("scene.toml")).unwrap();
    assert!(kept.contains("kind = \"cpu\""), "{kept}");
    // With whatever adapters this machine has.
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
}
