//! `psmrt pack` and grains that scenes make by themselves: what is asked for, the same for a seed.

use std::f64::consts::PI;
use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::cli::{Folder, psmrt, psmrt_in, stderr, stdout};
use crate::scenes::{BOX, scene, water};
use psmrt_reference::solids::{Shape, Solid};

/// Runs `psmrt pack` with these options in a folder; its JSON.
fn pack(folder: &Folder, options: &str) -> serde_json::Value {
    let arguments: Vec<&str> = ["pack", "--json"].into_iter().chain(options.split(' ')).collect();
    let output = psmrt_in(&folder.path(""), &arguments);
    assert!(output.status.success(), "{options}: {}", stderr(&output));
    serde_json::from_str(&stdout(&output)).unwrap()
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_seed_other_ones() {
    let folder = Folder::new("pack_seed");
    let bytes = |options: &str, out: &str| {
        pack(&folder, &format!("{options} --out {out}"));
        fs::read(folder.path(out)).unwrap()
    };
    let periodic =
        "--size 6e-4,5e-4,4e-4 --diameter 8e-5 --largest-diameter 1.2e-4 --porosity 0.45";
    let bed = "--bed --walls --size 4e-4,4e-4 --diameter 1e-4 --count 60 --density 2650";
    for options in [periodic, bed] {
        let first = bytes(options, "a.csv");
        assert!(first == bytes(options, "b.csv"));
        assert!(first != bytes(&format!("{options} --seed 2"), "c.csv"));
        for name in ["a.csv", "b.csv", "c.csv"] {
            fs::remove_file(folder.path(name)).unwrap();
        }
    }
}

#[test]
fn a_packing_has_the_porosity_asked_for_and_a_scene_reads_it() {
    let folder = Folder::new("pack_read");
    let told = pack(&folder, "--size 4e-4,4e-4,4e-4 --count 60 --porosity 0.42 --density 2650");
    assert!((told["porosity"].as_f64().unwrap() - 0.42).abs() < 1e-9, "{told}");
    assert!(told["largest_overlap"].as_f64().unwrap() <= 2e-3 && told["grains"] == 60, "{told}");
    let scene = folder.write(
        "scene.toml",
        water(
            [40, 40, 40],
            1e-5,
            "[stop]\nsteps = 1\n[[grains]]\nkind = \"csv\"\nfile = \"grains.csv\"\nmotion = \"free\"\n",
        ),
    );
    let output = psmrt(&["check", scene.to_str().unwrap(), "--json"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let said: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let numbers = said["numbers"].as_array().unwrap();
    let fraction = numbers.iter().find(|number| number["name"] == "solid fraction").unwrap();
    assert!((fraction["value"].as_f64().unwrap() - 0.58).abs() < 1e-9, "{fraction}");
}

#[test]
fn a_list_that_is_there_is_not_replaced_unless_asked() {
    let folder = Folder::new("pack_there");
    folder.write("grains.csv", "mine");
    let options = ["pack", "--size", "4e-4,4e-4,4e-4", "--count", "20", "--porosity", "0.6"];
    let output = psmrt_in(&folder.path(""), &options);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("--force"), "{}", stderr(&output));
    assert_eq!(fs::read(folder.path("grains.csv")).unwrap(), b"mine");
    pack(&folder, &(options[1..].join(" ") + " --force"));
    assert!(fs::read(folder.path("grains.csv")).unwrap().starts_with(b"# 20 grains"));
}

#[test]
fn a_list_that_appears_while_grains_are_packed_stays_and_the_packing_is_kept_too() {
    let folder = Folder::new("pack_appears");
    // Grains that settle, for longer than it takes to write a file.
    let options = "pack --bed --size 1e-3,1e-3 --diameter 1e-4 --count 400 --out a.csv";
    let mut child = Command::new(env!("CARGO_BIN_EXE_psmrt"))
        .args(options.split(' '))
        .current_dir(folder.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // It has looked for the file by then.
    std::thread::sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none(), "the packing was made too soon for this test");
    folder.write("a.csv", "precious");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("the list is in a-2.csv"), "{}", stderr(&output));
    assert_eq!(fs::read(folder.path("a.csv")).unwrap(), b"precious");
    assert!(fs::read(folder.path("a-2.csv")).unwrap().starts_with(b"# 400 grains"));
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_not_replaced_by_force_and_half_written_files_of_the_user_stay() {
    let folder = Folder::new("pack_special");
    folder.write("mine.csv", "mine");
    folder.write("new.csv.part", "mine too");
    std::os::unix::fs::symlink("mine.csv", folder.path("link.csv")).unwrap();
    fs::create_dir(folder.path("folder.csv")).unwrap();
    assert!(Command::new("mkfifo").arg(folder.path("pipe.csv")).status().unwrap().success());
    let options =
        ["pack", "--size", "4e-4,4e-4,4e-4", "--count", "20", "--porosity", "0.6", "--force"];
    for (out, told) in [
        ("link.csv", "is a link"),
        ("folder.csv", "is a folder"),
        ("pipe.csv", "is a device, pipe or socket"),
        ("nowhere/new.csv", "there is no folder nowhere"),
    ] {
        let output = psmrt_in(&folder.path(""), &[&options[..], &["--out", out]].concat());
        assert_eq!(output.status.code(), Some(2), "{out}: {}", stderr(&output));
        assert!(stderr(&output).contains(told), "{out}: {}", stderr(&output));
    }
    assert!(folder.path("link.csv").symlink_metadata().unwrap().is_symlink());
    assert!(!folder.path("pipe.csv").metadata().unwrap().is_file());
    assert_eq!(fs::read(folder.path("mine.csv")).unwrap(), b"mine");
    pack(&folder, &(options[1..].join(" ") + " --out new.csv"));
    assert_eq!(fs::read(folder.path("new.csv.part")).unwrap(), b"mine too");
}

#[test]
fn packings_that_cannot_be_made_are_refused_and_leave_nothing() {
    let folder = Folder::new("pack_bad");
    for (options, told) in [
        ("--size 1e-3,1e-3 --diameter 1e-4 --count 10", "x,y,z"),
        ("--size 1e-3,1e-3,0 --diameter 1e-4 --count 10", "--size 0"),
        ("--size 1e-3,1e-3,1e-3 --diameter nan --count 10", "--diameter"),
        ("--size 1e-3,1e-3,1e-3 --diameter 1e-4", "--count, or --porosity"),
        ("--size 1e-3,1e-3,1e-3 --count 10", "--diameter"),
        ("--size 1e-3,1e-3,1e-3 --diameter 1e-4 --count 0", "--count"),
        ("--size 1e-3,1e-3,1e-3 --diameter 1e-4 --porosity 1.5", "between 0 and 1"),
        ("--size 1e-3,1e-3,1e-3 --diameter 1e-4 --porosity 0.2", "denser than spheres"),
        ("--size 1e-3,1e-3,1e-3 --diameter 1e-7 --porosity 0.5", "no grain, or more"),
        ("--size 1e-3,1e-3,1e-3 --diameter 1e-4 --count 9 --porosity 0.5", "two of them"),
        ("--size 1e-3,1e-3,1e-3 --diameter 2e-4 --largest-diameter 1e-4 --count 9", "at least"),
        ("--size 1e-3,1e-3,1e-3 --diameter 2e-3 --count 1", "porosity"),
        ("--bed --size 1e-3,1e-3 --diameter 1e-4 --porosity 0.4", "finds its own"),
        ("--bed --size 1e-3,1e-3 --diameter 1e-4 --count 9 --friction=-1", "between 0 and 10"),
        ("--bed --size 1e-3,1e-3 --diameter 1e-4 --count 9 --friction 1e300", "between 0 and 10"),
        ("--bed --size 1e-3,1e-3 --diameter 2e-3 --count 9", "box length"),
    ] {
        let arguments: Vec<&str> = ["pack"].into_iter().chain(options.split(' ')).collect();
        let output = psmrt_in(&folder.path(""), &arguments);
        assert_eq!(output.status.code(), Some(2), "{options}: {}", stderr(&output));
        assert!(stderr(&output).contains(told), "{options}: {}", stderr(&output));
        assert!(folder.entries().is_empty(), "{options}");
    }
}

fn solids(grains: &str, faces: &str) -> Vec<Solid> {
    let rest = format!("[stop]\nsteps = 1\n{faces}[[grains]]\n{grains}");
    scene(&water([40, 32, 48], 1e-5, &rest)).setup.solid_phase.unwrap().solids
}

fn radius(solid: &Solid) -> f64 {
    let Shape::Sphere { radius } = solid.shape else { panic!() };
    radius
}

#[test]
fn a_random_suspension_has_the_fraction_the_gap_and_the_seed_asked_for() {
    let grains = "kind = \"random\"\nsolid_fraction = 0.12\ndiameter = 5e-5\ngap = 5e-6\nseed = 4";
    for (faces, periodic) in [("", true), (BOX, false)] {
        let found = solids(grains, faces);
        let fraction = found.len() as f64 * PI / 6.0 * 5.0_f64.powi(3) / (40.0 * 32.0 * 48.0);
        // To half a grain of the 113.
        assert!((fraction / 0.12 - 1.0).abs() < 0.5 / 112.0, "{fraction}");
        let lengths = [40.0, 32.0, 48.0];
        for (number, one) in found.iter().enumerate() {
            for axis in 0..3 {
                let margin = if periodic { 0.0 } else { 3.0 };
                assert!((margin..=lengths[axis] - margin).contains(&one.centre[axis]));
            }
            for two in &found[..number] {
                let mut between = one.centre - two.centre;
                for axis in (0..3).filter(|_| periodic) {
                    between[axis] -= lengths[axis] * (between[axis] / lengths[axis]).round();
                }
                // Diameter and gap, to round-off of the conversion from metres.
                assert!(between.norm() >= 5.5 - 1e-9, "{}", between.norm());
            }
        }
        assert!(found == solids(grains, faces));
        assert!(found != solids(&grains.replace("seed = 4", "seed = 5"), faces));
    }
}

#[test]
fn a_dense_periodic_suspension_is_pushed_apart_and_sizes_lie_in_their_range() {
    let grains = "kind = \"random\"\nsolid_fraction = 0.5\ndiameter_range = [5e-5, 8e-5]";
    let found = solids(grains, "");
    let volume: f64 = found.iter().map(|solid| 4.0 / 3.0 * PI * radius(solid).powi(3)).sum();
    // To half of the largest grain.
    assert!((volume - 0.5 * 61440.0).abs() < 0.5 * PI / 6.0 * 512.0, "{volume}");
    let (low, high) = found.iter().fold((9.0_f64, 0.0_f64), |(low, high), solid| {
        (low.min(radius(solid)), high.max(radius(solid)))
    });
    assert!((2.5..2.8).contains(&low) && (3.7..4.0).contains(&high), "{low} {high}");
}

#[test]
fn a_bed_lies_on_the_floor_between_its_walls() {
    let grains = "kind = \"bed\"\ncount = 40\ndiameter = 8e-5\npacking_friction = 0.3";
    let found = solids(grains, BOX);
    assert_eq!(found.len(), 40);
    let lowest = found.iter().map(|solid| solid.centre.z - 4.0).fold(f64::INFINITY, f64::min);
    let highest = found.iter().map(|solid| solid.centre.z + 4.0).fold(0.0, f64::max);
    // Pressed into the floor by less than a hundredth of a diameter; 40 grains make three layers.
    assert!(lowest.abs() < 0.08 && highest < 32.0, "{lowest} {highest}");
}

#[test]
fn sizes_between_one_and_two_are_packed_at_a_porosity_at_which_equal_grains_jam() {
    let folder = Folder::new("pack_sizes");
    // Asked for in percent; of some forty grains, on each seed.
    for seed in 1..=3 {
        let told = pack(
            &folder,
            &format!(
                "--size 1e-3,1e-3,1e-3 --diameter 2e-4 --largest-diameter 4e-4 --porosity 36.5% --seed {seed} \
                 --force"
            ),
        );
        // Within half of the largest grain (3.35e-11 m3 of 1e-9) of what was asked for.
        let porosity = told["porosity"].as_f64().unwrap();
        assert!((porosity - 0.365).abs() < 0.017, "{told}");
        // By the list itself: all pairs, nearest images.
        let list = fs::read_to_string(folder.path("grains.csv")).unwrap();
        let rows = list.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
        let numbers = |row: &str| row.split(',').map(|cell| cell.trim().parse().unwrap()).collect();
        let grains: Vec<Vec<f64>> = rows.map(numbers).collect();
        assert_eq!(grains.len() as u64, told["grains"].as_u64().unwrap());
        let volume: f64 = grains.iter().map(|grain| PI / 6.0 * grain[3].powi(3)).sum();
        assert!((1.0 - volume / 1e-9 - porosity).abs() < 1e-9, "{volume} {told}");
        let mut largest = 0.0_f64;
        for (number, one) in grains.iter().enumerate() {
            for two in &grains[number + 1..] {
                let along =
                    |i: usize| (one[i] - two[i]) - 1e-3 * ((one[i] - two[i]) / 1e-3).round();
                let apart = (0..3).map(|i| along(i).powi(2)).sum::<f64>().sqrt();
                largest = largest.max(1.0 - apart / (0.5 * (one[3] + two[3])));
            }
        }
        assert!(largest > 0.0 && largest <= 2e-3 + 1e-9, "{largest}");
    }
}

#[test]
fn what_cannot_be_packed_is_told_at_which_porosity_its_sizes_jam() {
    let folder = Folder::new("pack_jammed");
    let jams_at = |sizes: &str| {
        let options = format!("pack --size 8e-4,8e-4,8e-4 {sizes} --porosity 30%");
        let output = psmrt_in(&folder.path(""), &options.split(' ').collect::<Vec<_>>());
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        let said = stderr(&output);
        let (_, rest) = said.split_once("jam at random near ").unwrap_or_else(|| panic!("{said}"));
        rest[..5].parse::<f64>().unwrap()
    };
    // Desmond & Weeks (2014): 1 - 0.634 for equal spheres. Evenly distributed between d and 2 d: standard
    // deviation over mean (1/√12)/1.5 = 0.19245, no skewness: 1 - 0.634 - 0.0658 * 0.19245 = 0.3533; of some
    // twenty grains the two scatter by a fifth and by half of one.
    assert!((jams_at("--diameter 2e-4") - 0.366).abs() < 1e-9);
    assert!((jams_at("--diameter 2e-4 --largest-diameter 4e-4") - 0.3533).abs() < 0.006);
}
