//! The folder of a run: one process at a time, names that differ, and what happens when it goes away.

use std::fs;
use std::path::Path;
use std::process::Child;

use crate::cli::runs::{CELLS, bytes, checkpoints, scene, start, until, write};
use crate::cli::{Folder, psmrt, psmrt_in, stderr, stdout};
use crate::common::Budget;

/// Longer than any test waits: these runs are killed.
const ENDLESS: u64 = 1_000_000_000;

fn end(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn a_second_process_is_refused_and_told_who_writes_and_a_killed_one_frees_the_folder() {
    let folder = Folder::new("held");
    let scene = write(&folder, ENDLESS, true);
    let out = folder.path("run");
    let child = start(&scene, &out);
    until("a checkpoint", || !checkpoints(&out).is_empty());
    let (path, holder) = (out.to_str().unwrap(), format!("process {} on host", child.id()));
    for arguments in
        [&["resume", path] as &[&str], &["run", scene.to_str().unwrap(), "--out", path]]
    {
        let output = psmrt(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(&holder), "{arguments:?}: {}", stderr(&output));
    }
    end(child);
    // Refused for another reason: the lock is free.
    fs::write(out.join("grains_0.csv"), "x (m),y (m),z (m),diameter (m)\n4e-5,4e-5,4e-5,3e-5\n")
        .unwrap();
    let output = psmrt(&["resume", path]);
    assert!(stderr(&output).contains("grains_0.csv has been changed"), "{}", stderr(&output));
}

#[test]
fn of_two_runs_into_one_folder_one_is_refused_and_the_other_is_whole() {
    const STEPS: u64 = 50;
    Budget::oracle(307_200).spend(12 * STEPS * CELLS);
    let folder = Folder::new("two");
    let scene = write(&folder, STEPS, true);
    let whole = folder.path("whole");
    assert!(start(&scene, &whole).wait().unwrap().success());
    for trial in 0..5 {
        let out = folder.path(&format!("both_{trial}"));
        let both = [start(&scene, &out), start(&scene, &out)];
        let mut codes = both.map(|child| child.wait_with_output().unwrap().status.code());
        codes.sort();
        assert_eq!(codes, [Some(0), Some(2)], "trial {trial}");
        for table in ["box.csv", "loads.csv"] {
            let read = |run: &Path| fs::read(run.join(table)).unwrap();
            assert!(read(&out) == read(&whole), "trial {trial}: {table}");
        }
    }
}

#[test]
fn a_lock_that_cannot_be_made_is_an_error_that_names_it() {
    let folder = Folder::new("no_lock");
    let out = folder.path("run");
    fs::create_dir_all(out.join("run.lock")).unwrap();
    write(&folder, 10, false);
    fs::copy(folder.path("scene.toml"), out.join("scene.toml")).unwrap();
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("run.lock"), "{}", stderr(&output));
}

/// Lets `vanish` take away the folder of a run that has written something; the run stops and says so, has
/// made no new folder of that name, and goes on in the one that it names.
fn rescued(name: &str, vanish: impl Fn(&Path)) {
    const STEPS: u64 = 1000;
    // For the three tests that call this: the whole, and one that is made in two parts.
    Budget::oracle(3_072_000).spend(3 * 2 * STEPS * CELLS);
    let folder = Folder::new(name);
    let scene = write(&folder, STEPS, true);
    let (whole, out) = (folder.path("whole"), folder.path("run"));
    assert!(start(&scene, &whole).wait().unwrap().success());
    let child = start(&scene, &out);
    until("a checkpoint", || !checkpoints(&out).is_empty());
    vanish(&out);
    let output = child.wait_with_output().unwrap();
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("moved or removed while the run wrote into it"), "{said}");
    assert!(!out.join("box.csv").exists(), "the folder or its table has been made again");
    let rescued = folder.path("run-rescued");
    assert!(said.contains(&format!("psmrt resume {}", rescued.display())), "{said}");
    let output = psmrt(&["resume", rescued.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    for table in ["box.csv", "loads.csv", "box.svg"] {
        let read = |run: &Path| fs::read(run.join(table)).unwrap();
        assert!(read(&rescued) == read(&whole), "{table} of the rescued run differs");
    }
}

#[cfg(unix)]
#[test]
fn a_run_whose_folder_is_moved_stops_and_goes_on_beside_it_with_the_same_bytes() {
    rescued("moved", |out| fs::rename(out, out.with_file_name("elsewhere")).unwrap());
}

#[cfg(unix)]
#[test]
fn a_run_whose_folder_is_removed_stops_and_goes_on_beside_it_with_the_same_bytes() {
    // The run may write a file while they are removed.
    rescued("removed", |out| while fs::remove_dir_all(out).is_err() && out.exists() {});
}

#[cfg(unix)]
#[test]
fn a_run_whose_table_is_removed_stops_and_goes_on_beside_it_with_all_its_rows() {
    rescued("removed_table", |out| fs::remove_file(out.join("box.csv")).unwrap());
}

#[test]
fn records_whose_files_would_meet_others_are_refused_by_key_before_anything_is_made() {
    let folder = Folder::new("names");
    write(&folder, 10, true);
    let poiseuille = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/poiseuille/scene.toml");
    let poiseuille = fs::read_to_string(poiseuille).unwrap();
    let own = scene(10, true);
    let before = folder.entries();
    let record = |text: &str, name: &str, kind: &str| {
        format!("{text}\n[[records]]\nname = \"{name}\"\nkind = {kind}\n")
    };
    let slice = "\"slice\"\naxis = \"x\"";
    for (text, told) in [
        (record(&poiseuille, "comparison", "\"box\""), "comparison.csv"),
        (record(&poiseuille, "COMPARISON", "\"box\""), "COMPARISON.csv"),
        (record(&own, "grains_0", "\"box\""), "the copy of `grains[0].file`"),
        (record(&own, "checkpoints", slice), "checkpoints"),
        (record(&own, "Checkpoints", slice), "Checkpoints"),
        (record(&own, "BOX", slice), "records[0] has this name already"),
        (record(&own, "con", "\"box\""), "Windows"),
        (record(&own, "Lpt1", "\"box\""), "Windows"),
    ] {
        let output = Folder::new("names_scene");
        let scene = output.write("scene.toml", &text);
        fs::copy(folder.path("list.csv"), output.path("list.csv")).unwrap();
        let run = psmrt_in(&folder.path(""), &["run", scene.to_str().unwrap(), "--out", "run"]);
        assert_eq!(run.status.code(), Some(2), "{told}: {}", stderr(&run));
        assert!(stderr(&run).contains(told), "{told}: {}", stderr(&run));
        assert!(stderr(&run).contains(".name = "), "{told}: {}", stderr(&run));
        assert_eq!(folder.entries(), before, "{told}");
    }
    // None of these is taken where nothing else makes it.
    let free = record(&record(&own, "comparison", "\"box\""), "grains_1", "\"box\"");
    let scene = folder.write("free.toml", free);
    let output = psmrt(&["check", scene.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn all_that_a_run_makes_was_known_before_it_started() {
    Budget::oracle(5_120).spend(10 * CELLS);
    let folder = Folder::new("known");
    write(&folder, 10, true);
    let text = scene(10, true)
        + "[[records]]\nname = \"all\"\nkind = \"fields\"\nformats = [\"vti\", \"npy\"]\n\
           [[records]]\nname = \"points\"\nkind = \"grains\"\n\
           [[records]]\nname = \"line\"\nkind = \"profile\"\naxis = \"x\"\n";
    let scene = folder.write("known.toml", text);
    let out = folder.path("run");
    let output = start(&scene, &out).wait_with_output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let scene = psmrt::scene::Scene::load(&out.join("scene.toml"), &[]).unwrap();
    let known = psmrt::scene::names::all(
        &scene.records,
        &scene.attachments,
        (scene.exact.is_some(), scene.free.is_some()),
    );
    // A single row has no curve: that picture is not drawn.
    let drawn = known.into_iter().map(|made| made.name).filter(|name| name != "loads.svg");
    let mut known: Vec<_> = drawn.collect();
    known.sort();
    let mut found: Vec<_> = fs::read_dir(&out)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    found.sort();
    assert_eq!(found, known);
}

#[test]
fn half_written_files_of_a_killed_process_are_removed_on_resume_and_others_stay() {
    const STEPS: u64 = 600;
    Budget::oracle(307_200).spend(STEPS * CELLS);
    let folder = Folder::new("leftovers");
    let scene = write(&folder, STEPS, true);
    let out = folder.path("run");
    let child = start(&scene, &out);
    until("a checkpoint", || !checkpoints(&out).is_empty());
    end(child);
    let [half, mine] = ["checkpoints/psmrt-Ab12Cd.part", "notes.part"].map(|name| out.join(name));
    fs::write(&half, "PSMRTCK6").unwrap();
    fs::write(&mine, "of the user").unwrap();
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(
        !half.exists() && mine.exists(),
        "{:?}",
        bytes(&out).iter().map(|f| &f.0).collect::<Vec<_>>()
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_whose_name_is_not_utf_8_gives_json_all_the_same() {
    use std::os::unix::ffi::OsStrExt;
    Budget::oracle(5_120).spend(10 * CELLS);
    let folder = Folder::new("not_utf8");
    let scene = write(&folder, 10, false);
    let out = folder.path("").join(std::ffi::OsStr::from_bytes(b"out_\xff"));
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_psmrt"))
        .arg("run")
        .arg(scene)
        .arg("--json")
        .arg("--out")
        .arg(&out)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let said: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(said["folder"].as_str().unwrap().contains("out_"), "{said}");
    assert!(out.join("box.csv").is_file());
}
