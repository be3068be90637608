//! Lists of grains as other programs write them: read alike, or refused with the line and with what to
//! do about it.

use crate::cli::{Folder, psmrt_in, stderr, stdout};
use psmrt::scene::{Scene, SceneError};

const HEAD: &str = "x (m),y (m),z (m),diameter (m)\n";

/// A grain that fits into the domain, beside the scene's others.
const GRAIN: &str = "3e-4,2.5e-4,2.5e-4,2e-4\n";

/// A folder with the scene of wrong scenes, its first grain from a list.
fn folder(name: &str) -> Folder {
    let sphere = "kind = \"sphere\"\ncentre = [3e-4, 2.5e-4, 2.5e-4]\ndiameter = 2e-4";
    let good = include_str!("bad_scenes/good.toml");
    assert!(good.contains(sphere));
    let folder = Folder::new(name);
    folder.write("scene.toml", good.replace(sphere, "kind = \"csv\"\nfile = \"grains.csv\""));
    folder
}

fn load(folder: &Folder, list: impl AsRef<[u8]>) -> Result<Scene, Box<SceneError>> {
    folder.write("grains.csv", list);
    Scene::load(&folder.path("scene.toml"), &[])
}

#[test]
fn lists_of_other_programs_give_the_same_grains() {
    let folder = folder("lists_alike");
    let standard = load(&folder, format!("{HEAD}{GRAIN}")).unwrap().setup;
    for list in [
        format!("\u{feff}{HEAD}{GRAIN}"),
        format!("{HEAD}{GRAIN}").replace('\n', "\r\n"),
        format!("{HEAD}{GRAIN}").replace('\n', "\r"),
        format!("# made by hand\n\n{HEAD}\n  # one grain\n{GRAIN}\n\n"),
        format!("{HEAD}{}", GRAIN.trim_end()),
        format!("{HEAD} 3e-4 ,\t2.5e-4, 2.5e-4 ,2e-4  \n"),
        "\"x (m)\",\"y (m)\",\"z (m)\",\"diameter (m)\"\n\"3e-4\",\"2.5e-4\",\"2.5e-4\",\"2e-4\"\n"
            .into(),
        "diameter (m),z (m),x (m),y (m)\n2e-4,2.5e-4,3e-4,2.5e-4\n".into(),
        "x (m),y (m),z (m),radius (m)\n3e-4,2.5e-4,2.5e-4,1e-4\n".into(),
        "X [m],Y [m],Z [m],Diameter [m]\n3.0E-04,2.5E-04,+2.5e-4,0.0002\n".into(),
        "density (kg/m3),x (m),y (m),z (m),diameter (m)\n2650,3e-4,2.5e-4,2.5e-4,2e-4\n".into(),
    ] {
        let scene = load(&folder, &list).unwrap_or_else(|error| panic!("{list:?}\n{error}"));
        assert_eq!(scene.setup.solid_phase, standard.solid_phase, "{list:?}");
    }
}

/// A list, the line that is to blame, and what is said about it.
#[rustfmt::skip]
#[test]
fn dumps_of_lammps_and_text_of_yade_give_the_same_grains() {
    let folder = folder("lists_foreign");
    let standard = load(&folder, format!("{HEAD}{GRAIN}")).unwrap().setup;
    let frame = |step: u32, x: &str| {
        format!(
            "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp ff\n0 1e-3\n0 1e-3\n0 1e-3\n\
             ITEM: ATOMS id type x y z vx vy vz radius density \n1 1 {x} 2.5e-4 2.5e-4 0 0 -0.01 1e-4 2650 \n"
        )
    };
    for list in [
        frame(0, "1e-4") + &frame(100, "3e-4"),
        frame(100, "3e-4").replace('\n', "\r\n"),
        // Half of the box below zero, and a blank line at the end.
        frame(100, "-0.00018828125000000003").replace("ff\n0 1e-3", "ff\n-0.00048828125 1e-3") + "\n",
        "#format x_y_z_r\n3e-4\t2.5e-4\t2.5e-4\t1e-4\n".to_owned(),
        "#format x_y_z_r_matId\n# made by YADE\n3e-4 2.5e-4 2.5e-4 1e-4 0\n".to_owned(),
    ] {
        let setup = load(&folder, &list).unwrap_or_else(|error| panic!("{error}\n{list}")).setup;
        assert!(setup == standard, "other grains from\n{list}");
    }
    for (list, told) in [
        ("ITEM: TIMESTEP\n0\n".to_owned(), "without \"ITEM: ATOMS\""),
        (frame(0, "3e-4").replace(" y ", " ys "), "there is no column \"y (m)\""),
        (frame(0, "3e-4").replace(" x ", " xs "), "scaled or unwrapped"),
        (format!("ITEM: UNITS\nlj\n{}", frame(0, "3e-4")), "its units are \"lj\""),
        (frame(0, "3e-4").replace("ATOMS\n1\n", "ATOMS\n2\n"), "cut off: 1 of 2"),
        (frame(0, "3e-4").replace("3e-4 ", "left "), "line 10"),
    ] {
        let said = load(&folder, &list).unwrap_err().to_string();
        assert!(said.contains(told), "no {told:?} in\n{said}");
    }
}

fn wrong() -> Vec<(Vec<u8>, Option<usize>, &'static str, &'static str)> {
    let utf16 = |text: &str, mark: &[u8]| -> Vec<u8> {
        mark.iter().copied().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect()
    };
    let rows: Vec<(String, usize, &str, &str)> = vec![
        ("x,y,z,d\n1,2,3,4\n".into(), 1, "column 1 is \"x\", not \"x (m)\"", "SI units"),
        (
            "x (mm),y (mm),z (mm),diameter (mm)\n0.3,0.25,0.25,0.2\n".into(),
            1,
            "\"x (mm)\"",
            "divide it by 1000",
        ),
        (
            "x (m),y (m),z (m),diameter (um)\n3e-4,2.5e-4,2.5e-4,200\n".into(),
            1,
            "\"diameter (um)\"",
            "divide it by 1e6",
        ),
        (
            HEAD.replace('\n', ",density (g/cm3)\n3e-4,2.5e-4,2.5e-4,2e-4,2.65\n"),
            1,
            "(g/cm3)",
            "multiply it by 1000",
        ),
        (GRAIN.into(), 1, "begins with numbers", "x (m),y (m),z (m),diameter (m)"),
        (format!("\n{}{GRAIN}", GRAIN.replace("e-4", "D-04")), 2, "begins with numbers", "x (m)"),
        (format!("# {HEAD}{GRAIN}"), 2, "begins with numbers", "take the # off"),
        (format!("{HEAD}1e-4,2e-4,2e-4\n"), 2, "it has 3 values", "a value for each column"),
        (format!("{HEAD}{GRAIN}1e-4,two,2e-4,1e-4\n"), 3, "y (m) = \"two\"", "finite numbers"),
        (format!("{HEAD}1e-4,2e-4,2e-4,-1e-4\n"), 2, "diameter (m) = \"-1e-4\"", "above 0"),
        (format!("{HEAD}1e-4,2e-4,NaN,1e-4\n"), 2, "z (m) = \"NaN\"", "finite"),
        (format!("{HEAD}1e-4,2e-4,,1e-4\n"), 2, "z (m) = \"\"", "finite"),
        (format!("{HEAD}{GRAIN},,,\n"), 3, "only commas", "remove the line"),
        (HEAD.into(), 2, "no grains in it", "a line for each"),
        (String::new(), 1, "nothing in it", "x (m)"),
        (
            HEAD.replace('\n', ",density (kg/m3),colour\n"),
            1,
            "a column too many, \"colour\"",
            "keep",
        ),
        (HEAD.replace('\n', ",density\n"), 1, "column 5 is \"density\"", "density (kg/m3)"),
        (HEAD.replace('\n', ",\n"), 1, "column 5 has no name", "commas at the end"),
        (HEAD.replace("z (m),", ""), 1, "no column \"z (m)\"", "x (m),y (m),z (m)"),
        (HEAD.replace("z (m)", "x (m)"), 1, "\"x (m)\" is there twice", "one of the columns"),
        (HEAD.replace(",diameter (m)", ""), 1, "no column \"diameter (m)\"", "radius (m)"),
        (HEAD.replace('\n', ",radius (m)\n"), 1, "for the radius", "one of them"),
        (
            HEAD.replace('\n', ",density (kg/m3)\n3e-4,2.5e-4,2.5e-4,2e-4,-1\n"),
            2,
            "density (kg/m3) = \"-1\"",
            "above 0",
        ),
        (
            format!("{HEAD}{GRAIN}3.0D-04,2.5D-04,2.5D-04,2.0D-04\n"),
            3,
            "x (m) = \"3.0D-04\"",
            "write Fortran's D as E: 3.0E-04",
        ),
        (
            "x (m);y (m);z (m);diameter (m)\n0,0003;0,00025;0,00025;0,0002\n".into(),
            1,
            "separated by semicolons",
            "decimals with points",
        ),
        (
            "x (m)\ty (m)\tz (m)\tdiameter (m)\n3e-4\t2e-4\t2e-4\t2e-4\n".into(),
            1,
            "separated by tabulators",
            "tr ",
        ),
        ("3e-4 2.5e-4 2.5e-4 2e-4\n".into(), 1, "separated by blanks", "commas"),
        (
            format!("{HEAD}0,0003,0,00025,0,00025,0,0002\n"),
            2,
            "it has 8 values",
            "decimals with points",
        ),
        (
            format!("{HEAD}\"0,0003\",\"0,00025\",\"0,00025\",\"0,0002\"\n"),
            2,
            "x (m) = \"0,0003\"",
            "points: 0.0003",
        ),
        // The line in the file, whatever ends lines and whatever stands between them.
        (format!("{HEAD}{GRAIN}9,9,9,x\n").replace('\n', "\r\n"), 3, "diameter (m) = \"x\"", ""),
        (format!("{HEAD}{GRAIN}9,9,9,x\n").replace('\n', "\r"), 3, "diameter (m) = \"x\"", ""),
        (format!("# a\n\n{HEAD}# b\n\n\n{GRAIN}# c\n9,9,9,x\n"), 9, "diameter (m) = \"x\"", ""),
        (
            format!("# a\n\n{HEAD}# b\n\n\n{GRAIN}# c\n9,9,9,x\n").replace('\n', "\r\n"),
            9,
            "diameter (m) = \"x\"",
            "",
        ),
        // Grains that the list itself cannot know to be wrong.
        (
            format!("# a\n{HEAD}\n{GRAIN}3e-4,2.5e-4,1.0,2e-4\n").replace('\n', "\r\n"),
            5,
            "outside the domain",
            "move it",
        ),
        (format!("{HEAD}{GRAIN}9.5e-4,2.5e-4,2.5e-4,2e-4\n"), 3, "extends", "move it"),
        (format!("{HEAD}{GRAIN}3e-4,1e-4,1e-4,2e-5\n"), 3, "cells across", "domain.dx"),
        (format!("{HEAD}\n{GRAIN}{GRAIN}"), 4, "overlap", "apart"),
    ];
    let mut rows: Vec<_> = rows
        .into_iter()
        .map(|(list, line, told, remedy)| (list.into_bytes(), Some(line), told, remedy))
        .collect();
    rows.extend([
        (utf16(&format!("{HEAD}{GRAIN}"), &[0xff, 0xfe]), None, "UTF-16", "iconv"),
        (utf16(&format!("{HEAD}{GRAIN}"), &[]), None, "UTF-16", "iconv"),
        (
            format!("{HEAD}# 20 ").into_bytes().into_iter().chain([0xb5, b'm']).collect(),
            None,
            "see line 2",
            "UTF-8",
        ),
    ]);
    rows
}

#[test]
fn wrong_lists_are_told_with_their_line_and_a_remedy() {
    let folder = folder("lists_wrong");
    let mut missing = Vec::new();
    for (list, line, told, remedy) in wrong() {
        let shown = String::from_utf8_lossy(&list).into_owned();
        let error = *load(&folder, &list).expect_err(&shown);
        let at = line.map_or_else(String::new, |line| format!("line {line}"));
        let found = &error.problem;
        // `line 3` is no part of `line 30`.
        let is_there = found
            .match_indices(&at)
            .any(|(start, _)| !found[start + at.len()..].starts_with(|c: char| c.is_ascii_digit()));
        if error.key != "grains[0].file"
            || !is_there
            || !found.contains(told)
            || !error.remedy.contains(remedy)
        {
            missing.push(format!("{shown:?}: {at}, {told}, {remedy}:\n{error}"));
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn densities_of_fixed_grains_are_said_to_mean_nothing() {
    let folder = folder("lists_density");
    let head = HEAD.replace('\n', ",density (kg/m3)\n");
    folder.write("grains.csv", format!("{head}3e-4,2.5e-4,2.5e-4,2e-4,2650\n"));
    let told = "the densities in the list of grains[0].file are not used";
    let said = |arguments: &[&str]| {
        let output = psmrt_in(&folder.path(""), arguments);
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output) + &stderr(&output)
    };
    let fixed = said(&["check", "scene.toml"]);
    assert!(fixed.contains(told), "{fixed}");
    let free = said(&["check", "scene.toml", "--set", "grains[0].motion=free"]);
    assert!(!free.contains(told), "{free}");
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_refused_as_scene_and_as_list() {
    let folder = folder("lists_devices");
    folder.write("grains.csv", format!("{HEAD}{GRAIN}"));
    let scene = std::fs::read_to_string(folder.path("scene.toml")).unwrap();
    let made = std::process::Command::new("mkfifo").arg(folder.path("pipe")).status();
    assert!(made.is_ok_and(|status| status.success()), "mkfifo");
    std::os::unix::fs::symlink("pipe", folder.path("link")).unwrap();
    for (name, told) in [
        ("/dev/zero", "it is a device, not a file"),
        ("pipe", "it is a pipe, not a file"),
        ("link", "it is a pipe, not a file"),
        (".", "it is a folder, not a file"),
    ] {
        for as_list in [false, true] {
            folder.write("list.toml", scene.replace("grains.csv", name));
            let file = if as_list { "list.toml" } else { name };
            let output = psmrt_in(&folder.path(""), &["check", file]);
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{name}: {said}");
            assert!(said.contains(told) && said.contains("= help: "), "{name}: {said}");
        }
    }
}

#[test]
fn files_beyond_all_proportion_are_refused_by_their_size() {
    let folder = folder("lists_large");
    // Sparse: nothing is written.
    for (name, bytes) in [("huge.toml", 17 << 20), ("grains.csv", 5_u64 << 30)] {
        std::fs::File::create(folder.path(name)).unwrap().set_len(bytes).unwrap();
    }
    for (scene, told) in
        [("huge.toml", "larger than 16 MiB"), ("scene.toml", "larger than 1024 MiB")]
    {
        let output = psmrt_in(&folder.path(""), &["check", scene]);
        assert_eq!(output.status.code(), Some(2), "{scene}");
        assert!(stderr(&output).contains(told), "{scene}: {}", stderr(&output));
    }
}

#[test]
fn what_users_wrote_is_cut_and_escaped_in_messages() {
    let folder = folder("lists_echo");
    let scene = std::fs::read_to_string(folder.path("scene.toml")).unwrap();
    let noise: String = (1..=31_u8).cycle().take(260_000).map(char::from).collect();
    let noise = noise.replace(['\n', '\r'], "\u{1b}[31m");
    let mut said = Vec::new();
    let mut say = |arguments: &[&str]| {
        for json in [&[] as &[&str], &["--json"]] {
            let output = psmrt_in(&folder.path(""), &[arguments, json].concat());
            assert_eq!(output.status.code(), Some(2), "{arguments:.80?}");
            said.push(stdout(&output) + &stderr(&output));
        }
    };
    // Cells and names of columns.
    for list in [
        noise.clone(),
        format!("{noise},{noise},{noise},{noise}\n"),
        format!("{HEAD}1,2,3,{noise}\n"),
        format!("{HEAD}{noise}\n"),
        (0..=255_u8).cycle().take(260_000).map(char::from).collect(),
    ] {
        folder.write("grains.csv", list);
        say(&["check", "scene.toml"]);
    }
    // Keys, values, words and names of files, in scenes and on the command line.
    let long = "a\\u001b[31m".repeat(10_000);
    for (from, to) in [
        ("title = \"good\"", format!("\"{long}\" = 1")),
        ("dx = 2.5e-5", format!("dx = \"{long}\"")),
        ("model = \"mrt\"", format!("model = \"{long}\"")),
        ("name = \"line\"", format!("name = \"{long}\"")),
        ("record = \"box\"", format!("record = \"{long}\"")),
        ("file = \"grains.csv\"", format!("file = \"{long}\"")),
        ("file = \"grains.csv\"", "file = \"\\u001b[31m.csv\"".to_owned()),
    ] {
        folder.write("wrong.toml", scene.replace(from, &to));
        say(&["check", "wrong.toml"]);
    }
    let long = "a\u{1b}[31m".repeat(2_000);
    for change in [format!("{long}=1"), long.clone(), format!("time.tau={long}")] {
        say(&["check", "scene.toml", "--set", &change]);
    }
    say(&["check", "\u{1b}[31m.toml"]);
    for said in said {
        assert!(said.len() < 5000, "{} bytes: {said:.3000}", said.len());
        let control = |c: char| c.is_control() && c != '\n';
        assert!(!said.contains(control), "{said:.3000?}");
    }
}
