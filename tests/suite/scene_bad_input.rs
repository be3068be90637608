//! Wrong scenes: each gives one message with file, line, key, value, what is allowed and what to
//! do; exit code 2; no panic; nothing made.

use std::path::Path;

use crate::bad_scenes::{BAD, Bad, GOOD};
use crate::cli::{Folder, psmrt_in, stderr, stdout};
use psmrt::scene::Scene;
use psmrt_reference::solids::Shape;

fn check(folder: &Folder, name: &str) -> std::process::Output {
    psmrt_in(&folder.path(""), &["check", name])
}

#[test]
fn the_scene_that_the_wrong_ones_differ_from_is_right() {
    let folder = Folder::new("good");
    folder.write("scene.toml", GOOD);
    let output = check(&folder, "scene.toml");
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn each_wrong_scene_gets_one_message_with_its_place_and_remedy() {
    assert!(BAD.len() >= 60);
    let folder = Folder::new("bad");
    let mut wrong = Vec::new();
    for bad @ Bad(from, to, key, told) in BAD {
        let name = "wrong.toml";
        folder.write(name, bad.text());
        let output = psmrt_in(&folder.path(""), &["run", name]);
        let said = stderr(&output);
        let case = format!("{from:?} -> {to:?}:\n{said}");
        for (right, claim) in [
            (output.status.code() == Some(2), "exit code 2"),
            (said.matches("error: ").count() == 1, "one message"),
            (said.starts_with(&format!("error: {key}")), "the key comes first"),
            (said.contains(told), told),
            (said.contains("--> wrong.toml:"), "file and line"),
            (said.contains("= help: "), "a remedy"),
            (folder.entries() == [name], "nothing is made"),
        ] {
            if !right {
                wrong.push(format!("not so: {claim}, in {case}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_line_is_that_of_the_value() {
    let folder = Folder::new("line");
    folder.write("wrong.toml", GOOD.replace("tau = 0.8", "tau = 0.4"));
    let output = psmrt_in(&folder.path(""), &["check", "wrong.toml", "--json"]);
    let said: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let error = &said["error"];
    assert_eq!(error["file"], "wrong.toml");
    assert_eq!(error["line"], 9);
    assert_eq!(error["key"], "time.tau");
    assert_eq!(error["value"], "0.4");
}

#[test]
fn files_that_are_no_scenes_are_refused() {
    let folder = Folder::new("no_scene");
    folder.write("empty.toml", "");
    folder.write("blank.toml", " \n\n");
    folder.write("binary.toml", [0x7f, b'E', b'L', b'F', 0xff, 0xfe, 0, 1]);
    folder.write("nul.toml", [0; 64]);
    folder.write("long.toml", "a".repeat(1 << 20));
    folder.write("deep.toml", "a = ".to_owned() + &"[".repeat(100_000));
    folder.write("comment.toml", "# nothing\n");
    let before = folder.entries();
    for name in before.iter().map(String::as_str).chain(["absent.toml", "."]) {
        let output = psmrt_in(&folder.path(""), &["run", name]);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{name}: {said:.2000}");
        assert!(said.contains(name) && said.contains("help: "), "{name}: {said:.2000}");
    }
    assert_eq!(folder.entries(), before);
}

#[test]
fn wrong_changes_on_the_command_line_are_refused() {
    let folder = Folder::new("set");
    folder.write("scene.toml", GOOD);
    for (change, told) in [
        ("time.tau", "has no `=`"),
        ("=3", "names no key"),
        ("grains[7].diameter=1e-4", "no such section"),
        ("time.tau=0.5", "above 0.5"),
        ("time.tua=0.6", "did you mean `tau`?"),
        ("title.x=1", "no such"),
        ("tau=0.6", "did you mean `time.tau`?"),
        ("y_high.kind=\"wall\"", "did you mean `faces.y_high`?"),
        ("records[0]=5", "a section, not a value"),
        ("records[0].=5", "is no key"),
        ("records[0x]=5", "is no key"),
        ("records[-1].name=a", "is no key"),
        ("grains[0]={ kind = \"sphere\" }", "grains[0].centre"),
        ("grains[0].diameter.x=1", "no such key"),
        ("records={ name = \"z\", kind = \"box\" }", "write [[records]]"),
        ("grains=5", "write [[grains]]"),
        ("domain.cells=[8, 8, 8, 99]", "4 are given"),
    ] {
        let output = psmrt_in(&folder.path(""), &["run", "scene.toml", "--set", change]);
        assert_eq!(output.status.code(), Some(2), "{change}");
        assert!(stderr(&output).contains(told), "{change}: {}", stderr(&output));
    }
    let twice = ["check", "scene.toml", "--set", "time.tau=0.7", "--set", "time . tau=0.9"];
    let engine = ["check", "scene.toml", "--set", "engine.kind=reference", "--engine", "wgpu"];
    for arguments in [twice, engine] {
        let output = psmrt_in(&folder.path(""), &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains("set twice"), "{arguments:?}: {}", stderr(&output));
    }
    assert_eq!(folder.entries(), ["scene.toml"]);
}

#[test]
fn a_section_set_on_the_command_line_replaces_the_section() {
    let grain = "grains[0]={kind=\"sphere\",centre=[3e-4,2.5e-4,2.5e-4],diameter=1.5e-4}";
    let changes = [grain, "records[1]={name=\"z\",kind=\"box\"}", "stop.steps=7"].map(String::from);
    let scene = Scene::from_bytes("s", GOOD.as_bytes().to_vec(), Path::new(""), &changes).unwrap();
    let solids = &scene.setup.solid_phase.as_ref().unwrap().solids;
    // 1.5e-4 m and twice 1e-4 m in cells of 2.5e-5 m.
    let expected = [3.0, 2.0, 2.0].map(|radius| Shape::Sphere { radius });
    assert_eq!(solids.len(), 3);
    for (solid, right) in solids.iter().zip(expected) {
        assert_eq!(format!("{:.9?}", solid.shape), format!("{right:.9?}"));
    }
    let names: Vec<&str> = scene.records.iter().map(|record| record.name.as_str()).collect();
    assert_eq!(names, ["box", "z", "all"]);
    assert_eq!(scene.stop.steps, 7);
}

#[test]
fn a_folder_with_something_in_it_is_never_written_to() {
    let folder = Folder::new("occupied");
    folder.write("scene.toml", GOOD);
    let output = psmrt_in(&folder.path(""), &["run", "scene.toml", "--out", "."]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("not empty"), "{}", stderr(&output));
    assert_eq!(folder.entries(), ["scene.toml"]);
}
