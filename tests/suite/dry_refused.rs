//! Scenes without fluid: what is said of them, and what they are refused.

use crate::cli::{Folder, psmrt_in, stderr, stdout};
use crate::scenes::{BOX, FLOOR_AND_LID, GRAVITY, dry, free_sphere, read};

#[test]
fn check_says_that_grains_alone_are_computed_and_plan_that_there_is_nothing_to_plan() {
    let folder = Folder::new("dry_check");
    let ball = free_sphere("[5e-3, 5e-3, 5e-3]", "2e-3", "2500.0");
    folder.write("scene.toml", dry([1000; 3], &format!("{BOX}{GRAVITY}{ball}")));
    let output = psmrt_in(&folder.path(""), &["check", "scene.toml"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let said = stdout(&output) + &stderr(&output);
    for words in
        ["alone: the scene has no fluid", "no cells", "all of its weight", "grain steps a second"]
    {
        assert!(said.contains(words), "no {words:?} in\n{said}");
    }
    for words in [
        "tau",
        "collision",
        "Mach",
        "buoyancy",
        "Stokes",
        "density ratio",
        "bounce-back",
        "populations",
        "solid.operator",
    ] {
        assert!(!said.contains(words), "{words:?} in\n{said}");
    }
    let output = psmrt_in(&folder.path(""), &["plan", "scene.toml", "--error", "5%"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("has no fluid"), "{}", stderr(&output));
}

#[test]
fn a_run_that_a_grain_stops_says_why_without_a_word_of_fluid() {
    let soft = "[contact]\nstiffness = 0.01\n";
    let text = dry(
        [10, 10, 30],
        &format!(
            "{FLOOR_AND_LID}{GRAVITY}{soft}{}",
            free_sphere("[5e-3, 5e-3, 21e-3]", "2e-3", "2500.0")
        ),
    );
    let folder = Folder::new("dry_stop");
    folder.write("scene.toml", text.replace("steps = 100\n", "steps = 5000\n"));
    let output = psmrt_in(&folder.path(""), &["run", "scene.toml", "--out", "out"]);
    let said = stderr(&output);
    assert!(said.contains("too soft") && said.contains("contact.stiffness"), "{said}");
    assert!(!said.contains("fluid") && !said.contains("hydrodynamic"), "{said}");
}

#[test]
fn keys_of_the_fluid_are_refused_where_there_is_none() {
    let good = dry(
        [10, 10, 20],
        &format!("{BOX}{GRAVITY}{}", free_sphere("[5e-3, 5e-3, 5e-3]", "2e-3", "2500.0")),
    );
    read(&good).unwrap_or_else(|error| panic!("{error}"));
    let record = |kind: &str, more: &str| {
        format!("[[records]]\nname = \"r\"\nkind = \"{kind}\"\n{more}[stop]")
    };
    for (from, to, key, told) in [
        (
            "motion = \"free\"",
            "motion = \"free\"\nvelocity = [3.0, 0.0, 0.0]".to_owned(),
            "grains[0].velocity",
            "0.300 times `domain.dx`",
        ),
        (
            "x_low.kind = \"wall\"",
            "x_low = { kind = \"wall\", velocity = [0.0, 3.0, 0.0] }".to_owned(),
            "faces.x_low.velocity",
            "shorten the time step",
        ),
        ("dt = 1e-4", "tau = 0.8".to_owned(), "time.tau", "[fluid]"),
        (
            "dt = 1e-4",
            "lattice_velocity = 0.05\nreference_velocity = 1.0".to_owned(),
            "time.lattice_velocity",
            "[fluid]",
        ),
        ("[time]\ndt = 1e-4", "[time]".to_owned(), "time.dt", "add `dt`, in s"),
        ("dt = 1e-4", "dt = -1e-4".to_owned(), "time.dt", "above 0"),
        (
            "[stop]",
            "[collision]\nmodel = \"mrt\"\n[stop]".to_owned(),
            "collision",
            "belongs to the fluid",
        ),
        (
            "[stop]",
            "[body_force]\nacceleration = [1.0, 0.0, 0.0]\n[stop]".to_owned(),
            "body_force",
            "belongs to the fluid",
        ),
        (
            "[stop]",
            "[initial]\nvelocity = [0.0, 0.0, 0.0]\n[stop]".to_owned(),
            "initial",
            "belongs to the fluid",
        ),
        ("[stop]", "[solid]\nsamples = 4\n[stop]".to_owned(), "solid", "belongs to the fluid"),
        ("[stop]", "[lubrication]\n[stop]".to_owned(), "lubrication", "belongs to the fluid"),
        ("[stop]", "[coupling]\n[stop]".to_owned(), "coupling", "belongs to the fluid"),
        (
            "[stop]",
            "[compare]\nexact = \"plane_poiseuille\"\n[stop]".to_owned(),
            "compare",
            "belongs to the fluid",
        ),
        (
            "x_low.kind = \"wall\"",
            "x_low = { kind = \"velocity_inlet\", velocity = [0.1, 0.0, 0.0] }".to_owned(),
            "faces.x_low.kind",
            "`wall` or `free_slip`",
        ),
        (
            "x_low.kind = \"wall\"",
            "x_low = { kind = \"pressure\", pressure = 0.0 }".to_owned(),
            "faces.x_low.kind",
            "only fluid passes it",
        ),
        (
            "x_low.kind = \"wall\"",
            "x_low = { kind = \"wall\", velocity = { amplitude = [0.0, 0.1, 0.0], period = 1.0 } }"
                .to_owned(),
            "faces.x_low.velocity",
            "three numbers",
        ),
        (
            "[0.0, 0.0, -9.81]",
            "[0.0, 0.0, -9.81]\nbalance = true".to_owned(),
            "gravity.balance",
            "pressure gradient",
        ),
        (
            "[0.0, 0.0, -9.81]",
            "[0.0, 0.0, -9.81]\nform = \"body_force\"".to_owned(),
            "gravity.form",
            "on the fluid too",
        ),
        (
            "density = 2500.0\nmotion = \"free\"",
            String::new(),
            "gravity",
            "no grain of the scene is free",
        ),
        ("[gravity]\nacceleration = [0.0, 0.0, -9.81]\n", String::new(), "", ""),
        (
            "density = 2500.0",
            "density = 2.5".to_owned(),
            "grains[0].density",
            "10 to 1000000 kg/m3",
        ),
        ("[stop]", record("loads", ""), "records[0].kind", "`kind = \"grains\"`"),
        ("[stop]", record("box", ""), "records[0].kind", "cells of the fluid"),
        ("[stop]", record("profile", "axis = \"x\"\n"), "records[0].kind", "cells of the fluid"),
        ("[stop]", record("slice", "axis = \"x\"\n"), "records[0].kind", "cells of the fluid"),
        ("[stop]", record("fields", ""), "records[0].kind", "cells of the fluid"),
        (
            "[stop]",
            record("layers", "axis = \"z\"\nlayers = 4\n"),
            "records[0].kind",
            "cells of the fluid",
        ),
        (
            "[stop]",
            record("permeability", "axis = \"z\"\n"),
            "records[0].kind",
            "cells of the fluid",
        ),
    ] {
        assert!(good.contains(from), "{from}");
        match read(&good.replace(from, &to)) {
            // Nothing that must be there.
            Ok(_) => assert!(key.is_empty(), "{to} is taken"),
            Err(error) => {
                assert!(error.contains(key) && error.contains(told), "{key}, {told}:\n{error}");
                assert!(error.contains("help: "), "{error}");
            }
        }
    }
    let fixed = good.replace("density = 2500.0\nmotion = \"free\"", "").replace(GRAVITY, "");
    let error = read(&fixed).unwrap_err();
    assert!(
        error.contains("no grain of the scene is free") && error.contains("[fluid]"),
        "{error}"
    );
}
