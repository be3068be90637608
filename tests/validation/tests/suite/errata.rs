//! Numbers that ERRATA.md quotes are those of the tables that it names: each sentence is put together here from the
//! table, and must stand there.

use psmrt::table::Table;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn table(file: &str) -> Table {
    Table::read(&root().join("golden").join(file)).unwrap()
}

/// The values of a column in the rows with these words.
fn numbers(table: &Table, words: &[(&str, &str)], column: &str) -> Vec<f64> {
    let values = table.with(words).unwrap().numbers(column).unwrap();
    assert!(!values.is_empty(), "no row with {words:?}");
    values
}

/// The value in the one row with these words.
fn number(table: &Table, words: &[(&str, &str)], column: &str) -> f64 {
    let values = numbers(table, words, column);
    assert_eq!(values.len(), 1, "{words:?}: {column} {values:?}");
    values[0]
}

/// A whole number as the text spells it: thousands are set apart.
fn whole(value: f64) -> String {
    let digits = format!("{:.0}", value.abs());
    match digits.len() {
        4.. => format!("{},{}", &digits[..digits.len() - 3], &digits[digits.len() - 3..]),
        _ => digits,
    }
}

fn percent(share: f64) -> String {
    whole(100.0 * share)
}

#[test]
fn numbers_of_errata_are_those_of_their_tables() {
    let text = std::fs::read_to_string(root().join("reference/ERRATA.md")).unwrap();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let claims =
        [arrays(), coverage(), dense_bed(), limits_of_a_bed(), inlets(), stream()].concat();
    for claim in &claims {
        assert!(text.contains(claim), "the tables say {claim:?}, which ERRATA.md does not");
    }
    assert!(claims.len() >= 13, "only {} sentences are compared", claims.len());
}

/// Drag of sphere arrays.
fn arrays() -> Vec<String> {
    let study = table("sphere_arrays/study.csv");
    let ours = [("operator", "bounce_back"), ("shift", "quarter")];
    let simple = |collision, weight, tau| {
        let own = [("lattice", "SC"), ("solid_fraction", "0.06544984695")];
        let of = [
            ("cells_per_diameter", "8.0000"),
            ("collision", collision),
            ("weight", weight),
            ("tau", tau),
        ];
        number(&study, &[&own[..], &ours, &of].concat(), "relative_error")
    };
    let dense = |tau| {
        let own =
            [("lattice", "FCC"), ("solid_fraction", "0.6"), ("cells_per_diameter", "15.8213")];
        let of = [("collision", "MRT_dHumieres"), ("weight", "NT"), ("tau", tau)];
        percent(number(&study, &[&own[..], &ours, &of].concat(), "relative_error"))
    };
    let (mrt, srt) = ("MRT_dHumieres", "SRT");
    let operators = table("tradeoff/operators.csv");
    let graded = |tau| {
        let bed = [("case", "fcc"), ("geometry", "0.6"), ("cells", "24"), ("tau", tau)];
        let run = [("operator", "graded_viscosity"), ("collision", mrt), ("coverage", "exact")];
        // The velocity is off; the drag goes with one over it.
        let error = number(&operators, &[&bed[..], &run].concat(), "error");
        format!("{:.1}", 100.0 * (1.0 - 1.0 / (1.0 + error)))
    };
    vec![
        format!("off by -{}, -{} and -{} %", graded("0.6"), graded("0.8"), graded("1.5")),
        format!(
            "is off by -{} to -{} % for `tau` from 0.55 to 1",
            percent(simple(mrt, "NT", "0.55")),
            percent(simple(mrt, "NT", "1"))
        ),
        format!(
            "with `B = epsilon` it is +{} % to +{} %",
            percent(simple(mrt, "eps", "0.55")),
            percent(simple(mrt, "eps", "1"))
        ),
        format!(
            "(-{} to -{} % for `tau` from 0.55 to 2, SRT -{} to -{} %)",
            percent(simple(mrt, "NT", "0.55")),
            percent(simple(mrt, "NT", "2")),
            percent(simple(srt, "NT", "0.55")),
            percent(simple(srt, "NT", "2"))
        ),
        format!(
            "is {} % too permeable at `tau` = 0.6, {} % at 0.8, {} % at 1.5",
            dense("0.6"),
            dense("0.8"),
            dense("1.5")
        ),
    ]
}

fn coverage() -> Vec<String> {
    let cost = table("coverage/cost.csv");
    let rms = number(&cost, &[("method", "sampled"), ("n", "6")], "rms_error");
    vec![format!("err by {:.1} % rms", 100.0 * rms)]
}

/// Drag of a bed of 31 spheres against `tau`.
fn dense_bed() -> Vec<String> {
    let study = table("seepage/study.csv");
    let drag = |collision, weighting, tau| {
        let own = [("engine", "reference"), ("spheres", "31"), ("seed", "1"), ("Re_wanted", "1")];
        let of = [
            ("cells_per_diameter", "8.0000"),
            ("collision", collision),
            ("weighting", weighting),
            ("tau", tau),
        ];
        whole(number(&study, &[&own[..], &of].concat(), "psi_Re"))
    };
    let mrt = |weighting, tau| drag("MRT_dHumieres", weighting, tau);
    let (eps, nt) = ("solid_fraction", "noble_torczynski");
    vec![
        format!(
            "has `psi Re` = {} at `tau` = 1, {} at 0.6, {} at 0.52 and {} at 0.503",
            mrt(eps, "1"),
            mrt(eps, "0.6"),
            mrt(eps, "0.52"),
            mrt(eps, "0.503")
        ),
        format!(
            "With Noble and Torczynski's weight it is {}, {}, {} and {} (MRT) or {} (SRT)",
            mrt(nt, "1"),
            mrt(nt, "0.6"),
            mrt(nt, "0.52"),
            mrt(nt, "0.503"),
            drag("SRT", nt, "0.503")
        ),
    ]
}

/// How fast the flow through a bed may be that a body force drives.
fn limits_of_a_bed() -> Vec<String> {
    let runs = table("seepage/stability.csv");
    let limit = |engine, collision, weighting, tau| {
        let words = [
            ("engine", engine),
            ("collision", collision),
            ("weighting", weighting),
            ("tau", tau),
            ("outcome", "stable"),
            ("cells_per_diameter", "8.0000"),
        ];
        numbers(&runs, &words, "Re").into_iter().fold(0.0, f64::max)
    };
    let (srt, mrt, nt) = ("SRT", "MRT_dHumieres", "noble_torczynski");
    // The smaller of the two.
    let both = |weighting, tau| {
        let of = |collision| limit("reference", collision, weighting, tau);
        whole(of(srt).min(of(mrt)))
    };
    vec![
        format!(
            "both reach Re = {} at `tau` = 0.6, {} at 0.55, {} at 0.53 and {} at 0.51",
            both(nt, "0.6"),
            both(nt, "0.55"),
            both(nt, "0.53"),
            both(nt, "0.51")
        ),
        format!(
            "at 0.505 SRT is unstable beyond {}, MRT is not at {}; at 0.501 SRT beyond {}",
            whole(limit("reference", srt, nt, "0.505")),
            whole(limit("reference", mrt, nt, "0.505")),
            whole(limit("wgpu", srt, nt, "0.501"))
        ),
        format!("MRT is not at {} in 24,000", whole(limit("wgpu", mrt, nt, "0.501"))),
        format!(
            "With `B = epsilon` they are {} at `tau` = 0.6 and {} at 0.51",
            both("solid_fraction", "0.6"),
            both("solid_fraction", "0.51")
        ),
    ]
}

/// How fast the flow through a bed may be that an inlet pushes.
fn inlets() -> Vec<String> {
    let runs = table("seepage/inlet.csv");
    let outcome = |engine, tau, reynolds: &str| {
        let words = [("engine", engine), ("tau", tau), ("Re", reynolds)];
        let outcomes = runs.with(&words).unwrap().values("outcome").unwrap();
        outcomes.into_iter().map(|outcome| outcome.split(' ').next().unwrap().to_owned())
    };
    let is = |engine, tau, reynolds: &str, wanted: &str| {
        assert!(
            outcome(engine, tau, reynolds).all(|outcome| outcome == wanted),
            "at tau {tau}, Re {reynolds} the table does not have {wanted:?} for both"
        );
    };
    is("reference", "0.6", "4", "steady");
    is("reference", "0.6", "8", "drifts");
    is("reference", "0.6", "16", "stopped");
    is("wgpu", "0.55", "16", "drifts");
    is("wgpu", "0.55", "32", "stopped");
    let density = |collision| {
        let words =
            [("engine", "reference"), ("tau", "0.6"), ("Re", "8"), ("collision", collision)];
        number(&runs, &words, "density")
    };
    vec![
        format!(
            "drifts at 8 (mean density {:.1} to {:.1} times that at the start)",
            density("SRT"),
            density("MRT_dHumieres")
        ),
        "is steady at Re = 4, drifts at 8".to_owned(),
        "stopped at 16, with both; at 0.55 it drifts at 16 and is stopped at 32, with both"
            .to_owned(),
    ]
}

/// The stream about a sphere in which SRT does not become steady.
fn stream() -> Vec<String> {
    let study = table("sphere_drag/study.csv");
    // The paper's stream is five diameters wide.
    let own = [("engine", "reference"), ("cells_per_diameter", "6"), ("width_d", "5")];
    let mut steps = 0.0_f64;
    for (reynolds, tau) in [("100", "0.515"), ("150", "0.51")] {
        let of = |collision| {
            [&own[..], &[("collision", collision), ("Re", reynolds), ("tau", tau)]].concat()
        };
        let outcomes = study.with(&of("SRT")).unwrap().values("outcome").unwrap();
        assert_eq!(outcomes, ["not steady after 10800 steps"], "Re = {reynolds}");
        steps = steps.max(number(&study, &of("MRT_dHumieres"), "steps"));
    }
    vec![format!(
        "after 10,800 steps where MRT is steady after {}",
        whole((steps / 100.0).round() * 100.0)
    )]
}
