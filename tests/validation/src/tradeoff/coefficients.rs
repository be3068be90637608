//! The tables by which the product predicts, made from the golden ones.

use psmrt::advice::coefficients::{COLUMNS, NONE};
use psmrt::advice::tradeoff::model::{LEAST_ERROR, SolidMethod, method};
use psmrt::advice::tradeoff::model_low::LOW;
use psmrt::advice::tradeoff::model_tight::TightModel;
use psmrt::advice::tradeoff::runs;
use psmrt::table::{Table, TableError};
use psmrt_reference::collision::Preset;

use super::evidence::{committed_sweep, grain_points};
use super::evidence_low::low_points;
use super::evidence_tight::tight_points;
use super::fitting::Fits;
use super::trial::{committed_results, is_of_tight, score, trials};
use crate::stability::frontier::{frontiers, lightest};
use psmrt::advice::tradeoff::model::Evidence;

/// The head of either file.
pub const HEADER: &str = "# Made by cargo validate coefficients from golden tables, and made again by \
                          tests/validation/tests/suite/coefficients.rs.\n";

const SHEAR_LAYER: &str = include_str!("../../../../golden/stability/shear_layer.csv");
const BED: &str = include_str!("../../../../golden/stability/bed_force.csv");
const MOVERS: &str = include_str!("../../../../golden/stability/movers.csv");
const COST: &str = include_str!("../../../../golden/tradeoff/cost.csv");
const ARRAYS: &str = include_str!("../../../../golden/sphere_arrays/literature.csv");
const SHAFTS: &str = include_str!("../../../../golden/stokes_settling/literature.csv");

const SWEEP: &str = "golden/tradeoff/sweep.csv and golden/sphere_arrays/study.csv";

/// Relaxation times of the runs shown of operators that let no fluid through.
const SHOWN_TAUS: [f64; 3] = [0.55, 0.8, 1.5];

/// The runs that a prediction is shown beside: those with grains whose error counts.
pub fn runs() -> Result<Table, TableError> {
    let sweep = committed_sweep()?;
    let mut points = grain_points(&sweep)?;
    points.extend(low_points(&sweep)?);
    let mut table = Table::new(&runs::COLUMNS);
    for point in points.iter().filter(|point| point.error > LEAST_ERROR) {
        table.add(point.row());
    }
    // Errors of these may have either sign. There are many, so that some relaxation times will do.
    for point in tight_points()?.iter().filter(|point| SHOWN_TAUS.contains(&point.tau)) {
        if point.error.abs() > LEAST_ERROR {
            table.add(point.row());
        }
    }
    Ok(table)
}

/// Numbers in a row, with all their digits: whoever reads them again has the same.
fn words(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// Groups of numbers in a row.
fn groups(all: &[Vec<Option<f64>>]) -> String {
    let word = |number: &Option<f64>| number.map_or(NONE.to_owned(), |number| number.to_string());
    let group = |group: &Vec<Option<f64>>| group.iter().map(word).collect::<Vec<_>>().join(" ");
    all.iter().map(group).collect::<Vec<_>>().join(";")
}

/// The table of coefficients.
pub fn coefficients() -> Result<Table, TableError> {
    let mut table = Table::new(&COLUMNS);
    let mut add = |name: &str, of: &str, numbers: String, meaning: &str, source: &str| {
        table.add([name, of, &numbers, meaning, source].map(str::to_owned).to_vec());
    };
    let sweep = committed_sweep()?;
    let fits = Fits::of(&sweep)?;
    for (of, parameters, meaning, evidence, source) in rows(&fits) {
        add("grains", &of, words(&parameters), meaning, source);
        let Evidence { scatter, counts: [runs, geometries], ranges } = evidence;
        let mut numbers = vec![scatter, runs as f64, geometries as f64];
        numbers.extend(ranges.into_iter().flatten());
        let meaning = "scatter of unseen geometries; runs; geometries; cells per diameter; tau and drag: from and to";
        add("grains: evidence", &of, words(&numbers), meaning, source);
    }
    for (model, _) in &fits.walls {
        let [s, c] = model.parameters;
        let numbers = words(&[s, c, model.scatter, model.count as f64]);
        let meaning = "s; c; scatter; runs: error = s times the known slip + c u^2 (model.rs)";
        add("plates", model.collision.word(), numbers, meaning, "golden/tradeoff/sweep.csv");
    }
    let (tight, all): (Vec<_>, Vec<_>) =
        trials(&fits.models(), &committed_results()?)?.into_iter().partition(is_of_tight);
    let [[first, of_first], [hits, of]] = score(&all);
    add(
        "held back",
        "grains and plates",
        words(&[first, of_first, hits, of].map(|count| count as f64)),
        "runs within their band and all: of those that the bands were widened after; of the others",
        "golden/tradeoff/held_back_results.csv",
    );
    let [_, [hits, of]] = score(&tight);
    add(
        "held back",
        "operators",
        words(&[hits, of].map(|count| count as f64)),
        "runs within their band and all: with operators that let no fluid through",
        "golden/tradeoff/held_back_results.csv",
    );
    let costs = Table::parse("golden/tradeoff/cost.csv", COST)?;
    for engine in ["reference", "wgpu"] {
        let cost = |collision: Preset| {
            let wanted = [("engine", engine), ("collision", collision.word()), ("scene", "bed")];
            costs.with(&wanted)?.number("ns_per_cell_update")
        };
        let ratio = cost(Preset::DHumieres)? / cost(Preset::Srt)?;
        let meaning = "time of a cell update in a bed over that with one relaxation time";
        add("cost of MRT over SRT", engine, words(&[ratio]), meaning, "golden/tradeoff/cost.csv");
    }
    let curve = |points: Vec<(f64, f64)>| {
        groups(&points.into_iter().map(|(x, y)| vec![Some(x), Some(y)]).collect::<Vec<_>>())
    };
    let arrays = Table::parse("golden/sphere_arrays/literature.csv", ARRAYS)?;
    let arrays = arrays.with(&[("lattice", "FCC")])?.points("solid_fraction_c", "K_computed")?;
    let meaning = "solid fraction and drag over Stokes' drag in a face-centred cubic array";
    add("drag", "array", curve(arrays), meaning, "golden/sphere_arrays/literature.csv");
    let shafts = Table::parse("golden/stokes_settling/literature.csv", SHAFTS)?;
    let shafts = shafts.with(&[("section", "square")])?;
    let shafts = shafts.points("a_over_halfwidth", "K1_translating_in_still_fluid")?;
    let meaning = "radius over half the width and drag over Stokes' drag in a square shaft";
    add("drag", "shaft", curve(shafts), meaning, "golden/stokes_settling/literature.csv");
    for (flow, text, weight, source) in [
        ("shear layer", SHEAR_LAYER, "none", "golden/stability/shear_layer.csv"),
        ("bed NT", BED, "NT", "golden/stability/bed_force.csv"),
        ("bed eps", BED, "eps", "golden/stability/bed_force.csv"),
        ("bed graded", BED, "graded", "golden/stability/bed_force.csv"),
    ] {
        let all = frontiers(&Table::parse(source, text)?)?;
        for collision in Preset::ALL {
            let line = ["reference", collision.word(), weight];
            let own = all.iter().filter(|one| one.line[..3] == line);
            let mut own: Vec<_> =
                own.map(|one| vec![Some(one.tau), one.lives, one.right]).collect();
            own.sort_by(|a, b| a[0].unwrap_or(0.0).total_cmp(&b[0].unwrap_or(0.0)));
            if own.is_empty() {
                continue;
            }
            let meaning = "tau and the velocity (cells per step) up to which all runs live and up to which none is wrong";
            let of = format!("{flow} {}", collision.word());
            add("fastest", &of, groups(&own), meaning, source);
        }
    }
    let all = lightest(&Table::parse("golden/stability/movers.csv", MOVERS)?)?;
    for variant in ["lagged", "kept"] {
        let own = all.iter().filter(|one| one.variant == variant);
        let own: Vec<_> = own.map(|one| vec![Some(one.tau), one.ratio]).collect();
        let meaning =
            "tau and the density of a free grain over the fluid's down to which all were right";
        add("lightest", variant, groups(&own), meaning, "golden/stability/movers.csv");
    }
    Ok(table)
}

/// The models with grains: name, parameters, what they are, what they rest on, source.
fn rows(fits: &Fits) -> Vec<(String, Vec<f64>, &'static str, Evidence, &'static str)> {
    let mut rows = Vec::new();
    for (model, _) in &fits.grains {
        let meaning = "ln a; ln b; m; p: error = K^m [a (tau - 1/2)/d^2 + b/d^p] (model.rs)";
        let of = method(model.collision, model.solid);
        rows.push((of, model.parameters.to_vec(), meaning, model.evidence, SWEEP));
    }
    if let Some((model, _)) = &fits.eps {
        let meaning = "ln a; m; ln b; n; q: 1 + error = (1 + K^m a (tau - 1/2)/d^2) exp(-K^n b (tau - 1/2)^-q/d) \
                       (model_eps.rs)";
        let of = method(Preset::DHumieres, SolidMethod::SolidFraction);
        rows.push((of, model.parameters.to_vec(), meaning, model.evidence, SWEEP));
    }
    if let Some((model, _)) = &fits.low {
        let meaning = "ln b; n; r: the velocity is less by exp(-s) with s = K^n b/d^r [(tau - 1/2)^-1/2 - 0.1^-1/2] \
                       (model_low.rs)";
        let source = "as above and golden/seepage/study.csv";
        rows.push((LOW.to_owned(), model.parameters.to_vec(), meaning, model.evidence, source));
    }
    for (model, _) in &fits.tight {
        let TightModel { collision, solid, parameters, evidence } = model;
        let meaning = match collision {
            Preset::Srt => {
                "ln b; m; ln c; n; ln a: ln(1 + error) = K^m [b + a (tau - 1/2)^2]/d^2 - K^n c/d (model_tight.rs)"
            }
            Preset::DHumieres | Preset::Trt => {
                "ln b; m; ln c; n; r: ln(1 + error) = K^m b (tau - 1/2)^r/d^2 - K^n c/d (model_tight.rs)"
            }
        };
        let of = method(*collision, *solid);
        rows.push((of, parameters.to_vec(), meaning, *evidence, "golden/tradeoff/operators.csv"));
    }
    rows
}
