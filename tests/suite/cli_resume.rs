//! A run that is killed at any moment goes on, and ends with the same bytes as one that was not.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{LazyLock, OnceLock};
use std::time::Duration;

use crate::cli::runs::{checkpoints, start};
use crate::cli::{Folder, psmrt, stderr};
use crate::common::Budget;
use crate::scenes::{thick, water};

/// A sphere that moves through a box, all kinds of records, in half a second of computing.
static SCENE: LazyLock<String> = LazyLock::new(|| {
    let rest = r#"
[body_force]
acceleration = [0.5, 0.0, 0.1]
[[grains]]
kind = "sphere"
centre = [6.13e-5, 5.9e-5, 6.2e-5]
diameter = 6.5e-5
motion = "prescribed"
velocity = [2e-3, 1e-3, 0.0]
spin = [0.0, 30.0, 0.0]
[[records]]
name = "box"
kind = "box"
every_steps = 7
[[records]]
name = "loads"
kind = "loads"
every_steps = 11
[[records]]
name = "fields"
kind = "fields"
formats = ["npy"]
every_steps = 200
[[records]]
name = "profile"
kind = "profile"
axis = "x"
[checkpoint]
every_steps = 20
[stop]
steps = 600
"#;
    water([16, 12, 12], 1e-5, rest)
});

/// A free sphere thrown onto two more, with friction, and a wall that moves: contacts come and go.
fn free_scene() -> String {
    let rest = r#"
[faces]
z_low = { kind = "wall", velocity = [5e-2, 0.0, 0.0] }
z_high.kind = "wall"
[gravity]
acceleration = [0.0, 0.0, -9.81]
[contact]
friction = 0.4
rolling_resistance = 0.05
[lubrication]
[coupling]
average_loads = true
[[grains]]
kind = "csv"
file = "grains.csv"
motion = "free"
velocity = [0.0, 0.0, -0.1]
[[records]]
name = "loads"
kind = "loads"
every_steps = 3
[[records]]
name = "means"
kind = "grain_means"
every_steps = 5
[[records]]
name = "layers"
kind = "layers"
axis = "z"
layers = 5
every_steps = 8
[[records]]
name = "walls"
kind = "walls"
every_steps = 8
[[records]]
name = "contact_means"
kind = "contact_means"
every_steps = 4
[[records]]
name = "grains"
kind = "grains"
every_steps = 50
[checkpoint]
every_steps = 8
[stop]
steps = 400
"#;
    thick(&water([16, 12, 14], 4e-5, rest)).replace("tau = 0.8", "tau = 0.6")
}

const GRAINS: &str = "x (m),y (m),z (m),diameter (m),density (kg/m3)
3.5e-4,2.3e-4,3.1e-4,1.6e-4,2500
2.9e-4,2.4e-4,1.2e-4,2.0e-4,2500
4.6e-4,1.5e-4,0.9e-4,1.6e-4,8000
";

/// Every file with results, and its bytes.
fn results(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    const KINDS: [&str; 5] = ["csv", "npy", "vtp", "pvd", "svg"];
    let mut found = Vec::new();
    for folder in [folder.to_owned(), folder.join("fields"), folder.join("grains")] {
        for path in fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path()) {
            if path.extension().is_some_and(|suffix| KINDS.iter().any(|kind| suffix == *kind)) {
                let bytes = fs::read(&path).unwrap();
                found.push((path.file_name().unwrap().into(), bytes));
            }
        }
    }
    found.sort();
    found
}

fn assert_same(a: &[(PathBuf, Vec<u8>)], b: &[(PathBuf, Vec<u8>)], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}");
    for ((name, a), (other, b)) in a.iter().zip(b) {
        assert_eq!(name, other, "{what}");
        assert!(a == b, "{what}: {} differs", name.display());
    }
}

/// The reference, and how long it took.
fn uninterrupted(folder: &Folder, scene: &Path) -> (Vec<(PathBuf, Vec<u8>)>, Duration) {
    let out = folder.path("whole");
    let begin = std::time::Instant::now();
    assert!(start(scene, &out).wait().unwrap().success());
    (results(&out), begin.elapsed())
}

/// The results of [`SCENE`], run once for the three tests that compare one run with them.
fn whole() -> &'static [(PathBuf, Vec<u8>)] {
    static WHOLE: OnceLock<Vec<(PathBuf, Vec<u8>)>> = OnceLock::new();
    WHOLE.get_or_init(|| {
        // This run, and theirs.
        Budget::oracle(5_600_000).spend(4 * 600 * 16 * 12 * 12);
        let folder = Folder::new("reference");
        let scene = folder.write("scene.toml", &*SCENE);
        uninterrupted(&folder, &scene).0
    })
}

#[test]
fn a_run_killed_again_and_again_ends_with_the_same_bytes() {
    // The whole run and four that are killed, which do some steps twice.
    Budget::oracle(8_100_000).spend(5 * 700 * 16 * 12 * 12);
    // Tables and pictures of them, and 4 times 3 arrays.
    killed_again_and_again("killed", &SCENE, 3 + 3 + 3 * 4);
}

#[test]
fn a_run_with_free_grains_that_touch_ends_with_the_same_bytes_too() {
    Budget::oracle(6_750_000).spend(5 * 500 * 16 * 12 * 14);
    // The list of grains, five tables and the pictures of four, 9 files of grains and their series, the list of where
    // the grains have come to.
    killed_again_and_again("killed_free", &free_scene(), 1 + 4 + 5 + 9 + 1 + 1);
}

fn killed_again_and_again(name: &str, text: &str, files: usize) {
    let folder = Folder::new(name);
    folder.write("grains.csv", GRAINS);
    let scene = folder.write("scene.toml", text);
    let (whole, took) = uninterrupted(&folder, &scene);
    assert_eq!(whole.len(), files, "{:?}", whole.iter().map(|(name, _)| name).collect::<Vec<_>>());
    // Moments spread over the run by the golden ratio, also before the first checkpoint.
    for trial in 0..4_u32 {
        let out = folder.path(&format!("killed_{trial}"));
        let mut child = start(&scene, &out);
        for kill in 0..3_u32 {
            let share = (f64::from(3 * trial + kill + 1) * 0.618_034).fract();
            std::thread::sleep(took.mul_f64(0.6 * share));
            child.kill().unwrap();
            child.wait().unwrap();
            if !out.join("scene.toml").exists() {
                break;
            }
            child = Command::new(env!("CARGO_BIN_EXE_psmrt"))
                .arg("resume")
                .arg(&out)
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .unwrap();
        }
        if !out.join("scene.toml").exists() {
            continue;
        }
        assert!(child.wait().unwrap().success(), "trial {trial}");
        assert_same(&whole, &results(&out), &format!("trial {trial}"));
    }
}

/// A run that was killed with two checkpoints on the disk.
fn killed_with_two_checkpoints(folder: &Folder) -> (PathBuf, Vec<PathBuf>) {
    let scene = folder.write("scene.toml", &*SCENE);
    let out = folder.path("run");
    let mut child = start(&scene, &out);
    let list = || checkpoints(&out);
    while list().len() < 2 && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let known = list();
    assert!(known.len() >= 2, "the run ended too soon to be killed");
    (out, known)
}

#[test]
fn a_damaged_checkpoint_is_refused_and_the_older_one_offered_and_used() {
    let folder = Folder::new("damaged");
    let (out, known) = killed_with_two_checkpoints(&folder);
    let (newest, older) = (&known[known.len() - 1], &known[known.len() - 2]);
    let bytes = fs::read(newest).unwrap();
    let mut flipped = bytes.clone();
    flipped[bytes.len() / 2] ^= 1;
    let foreign = b"PNG or whatever else it may be, but long enough".to_vec();
    for (name, damaged, told) in [
        ("cut off", bytes[..bytes.len() - 100].to_vec(), "cut off or damaged"),
        ("a single bit", flipped, "cut off or damaged"),
        ("nearly empty", bytes[..10].to_vec(), "too short"),
        ("another file", foreign, "no checkpoint of psmrt"),
    ] {
        fs::write(newest, damaged).unwrap();
        let output = psmrt(&["resume", out.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        let said = stderr(&output);
        assert!(said.contains(told) && said.contains("an older one is there"), "{name}: {said}");
        assert!(said.contains(older.to_str().unwrap()), "{name}: {said}");
    }
    let output = psmrt(&["resume", out.to_str().unwrap(), "--checkpoint", older.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_same(whole(), &results(&out), "from the older one");
}

#[test]
fn a_checkpoint_of_another_scene_is_refused() {
    let folder = Folder::new("foreign");
    let (out, _) = killed_with_two_checkpoints(&folder);
    let scene = out.join("scene.toml");
    let text = fs::read_to_string(&scene).unwrap().replace("tau = 0.8", "tau = 0.9");
    fs::write(&scene, text).unwrap();
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("scene.toml has been changed"), "{}", stderr(&output));
}

#[test]
fn a_folder_that_is_no_run_is_refused() {
    let folder = Folder::new("no_run");
    let output = psmrt(&["resume", folder.path("").to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("no folder of a run"), "{}", stderr(&output));
}

#[test]
fn a_run_killed_before_its_scene_was_written_says_what_to_do() {
    let folder = Folder::new("too_soon");
    folder.write("scene.toml.part", &SCENE[..20]);
    let path = folder.path("");
    let output = psmrt(&["resume", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("killed before it had written its scene"), "{output:?}");
    assert!(stderr(&output).contains("psmrt run"), "{output:?}");
}

#[cfg(unix)]
#[test]
fn an_interruption_saves_the_state_and_says_how_to_go_on() {
    let folder = Folder::new("interrupted");
    let scene = folder.write("scene.toml", &*SCENE);
    let out = folder.path("run");
    let child = start(&scene, &out);
    while checkpoints(&out).is_empty() {
        std::thread::sleep(Duration::from_millis(2));
    }
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_same(whole(), &results(&out), "after Ctrl-C");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_loses_nothing_that_was_written_before() {
    let folder = Folder::new("full");
    let (out, _) = killed_with_two_checkpoints(&folder);
    let before = checkpoints(&out);
    // A limit on the size of files stands for the full disk.
    let script = format!(
        "trap '' XFSZ; ulimit -f 16; exec {} resume {}",
        env!("CARGO_BIN_EXE_psmrt"),
        out.display()
    );
    let output = Command::new("sh").args(["-c", &script]).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("cannot be written"), "{}", stderr(&output));
    assert_eq!(checkpoints(&out), before);
    let output = psmrt(&["resume", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_same(whole(), &results(&out), "after a full disk");
}
