//! `cargo validate report`: a folder that needs nothing else, and says what it was made with.

use crate::common::Budget;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Every link of a page that is not to a place on it.
fn links(html: &str) -> Vec<&str> {
    let targets = html.split("href=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
    targets.filter(|target| !target.starts_with('#')).collect()
}

#[test]
fn the_folder_of_a_report_holds_all_that_its_page_links_and_says_where_it_comes_from() {
    let temp = tempfile::tempdir().unwrap();
    let mut budget = Budget::oracle(2_800_000);
    budget.spend(2_800_000); // of poiseuille, as in acceptance.rs
    let mut command = Command::new(env!("CARGO_BIN_EXE_validate"));
    command
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .args(["report", "--oracle-only"]);
    for case in ["poiseuille", "stability", "tradeoff"] {
        command.args(["--case", case]);
    }
    let output = command.arg("--out").arg(temp.path()).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let html = fs::read_to_string(temp.path().join("index.html")).unwrap();

    let found = links(&html);
    for link in &found {
        let is_there = temp.path().join(link).is_file() || link.starts_with("http");
        assert!(is_there, "the page links {link}, which is not there");
    }
    for link in [
        "poiseuille.csv",
        "poiseuille_1.svg",
        "data/poiseuille/scene.toml",
        "data/poiseuille/bounceback_wall.csv",
        "data/stability/movers.csv",
        "data/stability/bed_inlet.csv",
        "data/tradeoff/sweep.csv",
    ] {
        assert!(found.contains(&link), "no link to {link} in {found:?}");
    }
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
    for copy in ["stability/movers.csv", "poiseuille/scene.toml"] {
        let same = fs::read(golden.join(copy)).unwrap();
        assert!(fs::read(temp.path().join("data").join(copy)).unwrap() == same, "{copy}");
    }

    // What was measured says how to make it again and in which units; what was only judged says so.
    let head = |name: &str| {
        let text = fs::read_to_string(temp.path().join(name)).unwrap();
        text.lines().filter(|line| line.starts_with('#')).collect::<Vec<_>>().join("\n")
    };
    let (poiseuille, tradeoff) = (head("poiseuille.csv"), head("tradeoff.csv"));
    for part in [
        "report --case poiseuille --oracle-only, at ",
        "quick scale; engines: reference",
        "# Units: ",
    ] {
        assert!(poiseuille.contains(part), "{part}: {poiseuille}");
    }
    assert!(
        tradeoff.contains("Read, not computed, by: ")
            && tradeoff.contains("; from golden/tradeoff/held_back_check.csv"),
        "{tradeoff}"
    );

    for name in [
        "made on",
        "commit",
        "its sources",
        "its cases",
        "profile",
        "operating system",
        "processor",
    ] {
        assert!(html.contains(&format!("<th scope=\"row\">{name}</th>")), "no {name}");
    }
}
