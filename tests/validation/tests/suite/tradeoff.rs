//! The trade-off study: its fits, fronts and files, and that its committed tables are what its rows make.

use crate::common::{Budget, golden_rows};
use proptest::prelude::*;
use psmrt::advice::tradeoff::model::{GrainModel, LEAST_ERROR, SolidMethod};
use psmrt::advice::tradeoff::models::Models;
use psmrt::advice::tradeoff::runs::GrainPoint;
use psmrt::table::Table;
use psmrt_reference::collision::Preset;
use psmrt_reference::coverage::CoverageRule;
use psmrt_report::render_svg;
use psmrt_validation::cases::{CASES, Golden};
use psmrt_validation::tradeoff::effects;
use psmrt_validation::tradeoff::evidence::{committed_sweep, grain_points, solid_method};
use psmrt_validation::tradeoff::evidence_low::low_points;
use psmrt_validation::tradeoff::evidence_tight::tight_points;
use psmrt_validation::tradeoff::fit::Fit;
use psmrt_validation::tradeoff::fitting::{Fits, eps_model, grain_model, tight_model};
use psmrt_validation::tradeoff::measure::Runner;
use psmrt_validation::tradeoff::parameters::{Flow, Parameters, Storage};
use psmrt_validation::tradeoff::pareto::front;
use psmrt_validation::tradeoff::record::SweepLog;
use psmrt_validation::tradeoff::row::Row;
use psmrt_validation::tradeoff::storage::half;
use psmrt_validation::tradeoff::sweep::runs;
use psmrt_validation::tradeoff::tables;
use psmrt_validation::tradeoff::trial::{committed_results, score, trials};
use std::fs;
use std::path::Path;

const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden");

/// Points of the model `K^0.8 [4 (τ - 1/2)/d² + 3/d³]`, each off by a factor `exp(noise)`.
fn synthetic(mut noise: impl FnMut() -> f64) -> Vec<GrainPoint> {
    let mut points = Vec::new();
    for (geometry, drag) in [("a", 1.4), ("b", 3.0), ("c", 10.0), ("d", 30.0), ("e", 100.0)] {
        for cells in [4.0, 6.0, 8.0, 12.0, 16.0_f64] {
            for tau in [0.6, 0.8, 1.0, 1.5, 2.0] {
                let leak = 4.0 * (tau - 0.5) / (cells * cells);
                let error = f64::powf(drag, 0.8) * (leak + 3.0 / cells.powi(3));
                points.push(GrainPoint {
                    solid: SolidMethod::Usual,
                    geometry: geometry.to_owned(),
                    source: "synthetic".to_owned(),
                    collision: Preset::DHumieres,
                    cells,
                    tau,
                    drag,
                    error: error * noise().exp(),
                });
            }
        }
    }
    points
}

fn fitted(points: &[GrainPoint]) -> Option<(GrainModel, Fit)> {
    grain_model(Preset::DHumieres, SolidMethod::Usual, points)
}

#[test]
fn fit_recovers_the_coefficients_that_made_the_data() {
    let (exact, _) = fitted(&synthetic(|| 0.0)).unwrap();
    let p = &exact.parameters;
    for (found, wanted) in [(p[0].exp(), 4.0), (p[1].exp(), 3.0), (p[2], 0.8), (p[3], 3.0)] {
        // Derivatives by differences of 1e-7 leave some 1e-7.
        assert!((found - wanted).abs() < 1e-5 * wanted, "{found} instead of {wanted}");
    }
    assert!(exact.evidence.scatter < 1e-5, "{}", exact.evidence.scatter);

    // A tenth of noise, the same in every run: from a linear congruence, spread evenly, which has the
    // standard deviation 0.1 on ±0.1 sqrt(3).
    let mut state = 1_u32;
    let noise = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        0.1 * 3.0_f64.sqrt() * (2.0 * f64::from(state >> 8) / f64::from(1_u32 << 24) - 1.0)
    };
    let (_, noisy) = fitted(&synthetic(noise)).unwrap();
    let (p, e) = (&noisy.parameters, &noisy.errors);
    for (i, wanted) in [4.0_f64.ln(), 3.0_f64.ln(), 0.8, 3.0].into_iter().enumerate() {
        // Four numbers within three standard errors: missed by chance in one of a hundred such data sets,
        // and these data are always the same.
        assert!((p[i] - wanted).abs() < 3.0 * e[i], "parameter {i}: {} ± {}", p[i], e[i]);
    }
    // 125 points give a standard deviation to 6 %.
    assert!((noisy.scale / 0.1 - 1.0).abs() < 0.2, "{}", noisy.scale);
}

#[test]
fn fit_with_b_epsilon_recovers_the_coefficients_of_both_its_errors() {
    let mut points = synthetic(|| 0.0);
    for point in &mut points {
        let (d, tau, drag) = (point.cells, point.tau, point.drag);
        let leak = 4.0 * drag.powf(0.8) * (tau - 0.5) / (d * d);
        let shift = 0.4 * drag.powf(0.3) * (tau - 0.5).powf(-0.6) / d;
        point.error = (1.0 + leak) * (-shift).exp() - 1.0;
        point.solid = SolidMethod::SolidFraction;
    }
    // Of either sign: that is why it has a form of its own.
    assert!(points.iter().any(|p| p.error < -0.2) && points.iter().any(|p| p.error > 0.2));
    let (model, _) = eps_model(&points).unwrap();
    let p = &model.parameters;
    let found = [p[0].exp(), p[1], p[2].exp(), p[3], p[4]];
    for (found, wanted) in found.into_iter().zip([4.0, 0.8, 0.4, 0.3, 0.6]) {
        // Derivatives by differences of 1e-7 leave some 1e-7.
        assert!((found - wanted).abs() < 1e-5 * wanted, "{found} instead of {wanted}");
    }
}

#[test]
fn fit_of_a_tight_operator_recovers_the_coefficients_that_made_the_data() {
    for (collision, solid, last) in [
        (Preset::Srt, SolidMethod::Graded, 3.0_f64.ln()),
        (Preset::DHumieres, SolidMethod::FullBounceBack, 0.25),
    ] {
        let mut points = synthetic(|| 0.0);
        for point in &mut points {
            let (d, x, drag) = (point.cells, point.tau - 0.5, point.drag);
            let size = match collision {
                Preset::Srt => 4.0 + 3.0 * x * x,
                _ => 4.0 * x.powf(0.25),
            };
            let logarithm = drag.powf(0.4) * size / (d * d) - 0.5 * drag.powf(0.2) / d;
            (point.collision, point.solid) = (collision, solid);
            point.error = logarithm.exp_m1();
        }
        // Of either sign, as those of the runs.
        assert!(points.iter().any(|p| p.error < -0.01) && points.iter().any(|p| p.error > 0.2));
        let (model, _) = tight_model(collision, solid, &points).unwrap();
        let wanted = [4.0_f64.ln(), 0.4, 0.5_f64.ln(), 0.2, last];
        for (found, wanted) in model.parameters.into_iter().zip(wanted) {
            // Derivatives by differences of 1e-7 leave some 1e-7.
            assert!((found - wanted).abs() < 1e-5, "{solid:?}: {found} instead of {wanted}");
        }
    }
}

#[test]
fn front_of_hand_made_points_is_the_expected_one() {
    let points = [
        (1.0, 9.0),
        (2.0, 5.0),
        (2.0, 6.0), // as dear as the one before, and worse
        (3.0, 5.0), // as good as (2, 5), and dearer
        (4.0, 1.0),
        (0.5, f64::INFINITY), // broken
        (9.0, 2.0),
    ];
    assert_eq!(front(&points), [0, 1, 4]);
    assert!(front(&[]).is_empty());
}

proptest! {
    #[test]
    fn front_is_what_nothing_beats(points in prop::collection::vec((1_u8..20, 1_u8..20), 0..40)) {
        let points: Vec<_> = points.iter().map(|&(a, b)| (f64::from(a), f64::from(b))).collect();
        let best = front(&points);
        let beats = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
        for i in 0..points.len() {
            let beaten = points.iter().any(|&other| beats(other, points[i]));
            let same = best.iter().any(|&kept| points[kept] == points[i]);
            prop_assert_eq!(same, !beaten, "point {:?}", points[i]);
        }
        prop_assert!(best.windows(2).all(|pair| points[pair[0]].0 < points[pair[1]].0));
    }
}

#[test]
fn half_precision_rounds_as_ieee_754_says() {
    let two = |e: i32| 2.0_f64.powi(e);
    for (value, wanted) in [
        (0.0, 0.0),
        (1.0, 1.0),
        (1.0 + two(-11), 1.0), // half-way: to the even neighbour
        (1.0 + 3.0 * two(-11), 1.0 + two(-9)),
        (1.0 + 1.01 * two(-11), 1.0 + two(-10)),
        (-1.0 - 1.01 * two(-11), -1.0 - two(-10)),
        (65504.0, 65504.0), // the largest
        (65519.0, 65504.0),
        (65520.0, f64::INFINITY),
        (two(-24), two(-24)), // the smallest
        (two(-25), 0.0),
        (1.01 * two(-25), two(-24)),
        (1.5 * two(-20), 1.5 * two(-20)),
    ] {
        assert_eq!(half(value), wanted, "{value:e}");
    }
}

#[test]
fn knobs_read_back_as_they_were_written() {
    let all = Flow::ALL.into_iter().flat_map(|flow| runs(flow, false));
    let mut count = 0;
    for parameters in all {
        assert_eq!(Parameters::from_row(&parameters.row()).unwrap(), parameters);
        count += 1;
    }
    assert!(count > 500, "{count}");
}

#[test]
fn a_sweep_goes_on_after_it_was_cut_off_and_refuses_a_foreign_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sweep.csv");
    let rows = committed_sweep().unwrap();
    let mut record = SweepLog::open(&file, "# a header\n").unwrap();
    for row in &rows[..2] {
        record.add(row.clone()).unwrap();
    }
    let whole = fs::read_to_string(&file).unwrap();
    fs::write(&file, format!("{whole}sc,0.2,8,0.")).unwrap();
    let mut again = SweepLog::open(&file, "# another header\n").unwrap();
    assert_eq!(again.rows.len(), 2);
    assert!(again.holds(&rows[0].parameters) && !again.holds(&rows[2].parameters));
    assert_eq!(fs::read_to_string(&file).unwrap(), whole);
    again.add(rows[2].clone()).unwrap();
    let read = SweepLog::open(&file, "").unwrap().rows;
    assert_eq!(read[2].parameters, rows[2].parameters);

    let foreign = folder.path().join("foreign.csv");
    fs::write(&foreign, "a,b\n1,2\n").unwrap();
    let error = SweepLog::open(&foreign, "").unwrap_err().to_string();
    assert!(error.contains("foreign.csv") && error.contains("columns"), "{error}");
    assert_eq!(fs::read_to_string(&foreign).unwrap(), "a,b\n1,2\n");
}

/// One measured row, its cell updates counted.
fn measured(runner: &mut Runner, parameters: &Parameters, budget: &mut Budget) -> Row {
    let row = runner.measure(parameters).unwrap();
    budget.spend(row.cell_updates());
    row
}

#[test]
fn committed_rows_can_be_measured_again() {
    let mut budget = Budget::oracle(4_000_000);
    let mut runner = Runner::new(Path::new(GOLDEN), None).unwrap();
    let committed = committed_sweep().unwrap();
    let mut compared = 0;
    for row in &committed {
        let Parameters { flow, cells, tau, ref engine, storage, .. } = row.parameters;
        let coarse = match flow {
            Flow::Settling => cells == 4 && tau == 1.5 && row.parameters.geometry == "0.5",
            Flow::SphereDrag => false,
            _ => cells == 8 && tau == 1.5,
        };
        if !coarse || engine != "reference" || storage != Storage::F64 {
            continue;
        }
        let again = measured(&mut runner, &row.parameters, &mut budget);
        let (new, old) = (again.error.unwrap(), row.error.unwrap());
        // The same program on another machine: mathematical libraries differ in the last digit, and the error is
        // rounded to six. And the committed flows were taken for steady by an older criterion, three changes below
        // 2e-5 (1e-8 between plates) from row to row: where these fall by a tenth each time, ten times that is left.
        let left = match flow {
            Flow::Settling => 0.0,
            Flow::Poiseuille => 1e-7,
            _ => 2e-4,
        };
        let allowed = 1e-5 * old.abs().max(1e-3) + left * (1.0 + old.abs());
        assert!((new - old).abs() < allowed, "{:?}: {new} {old}", row.parameters);
        compared += 1;
    }
    assert!(compared >= 30, "only {compared}");
}

#[test]
fn unshifted_single_precision_loses_digits_as_the_flow_slows_and_shifted_does_not() {
    let mut budget = Budget::oracle(600_000);
    let mut runner = Runner::new(Path::new(GOLDEN), None).unwrap();
    let mut lost = |storage, lattice_velocity| {
        let mut error = |storage| {
            let usual = Parameters::new(Flow::Sc, "0.2", 8, 0.8, Preset::DHumieres);
            let parameters = Parameters { storage, lattice_velocity, ..usual };
            measured(&mut runner, &parameters, &mut budget).error.unwrap()
        };
        // All of these run for the same number of steps.
        (error(storage) - error(Storage::F32Shifted)).abs()
    };
    let (slow, fast) = (lost(Storage::F32, 1e-5), lost(Storage::F32, 1e-3));
    println!("f32 unshifted, u = 1e-5: {slow:.1e}, u = 1e-3: {fast:.1e}");
    // Unshifted populations are kept to a share of themselves, whatever the flow: a hundredth of the
    // velocity, about a hundred times the relative error. Ten leaves room for chance.
    assert!(slow > 10.0 * fast, "{slow} {fast}");
}

#[test]
fn what_was_kept_back_is_in_no_fit() {
    let mut points = grain_points(&committed_sweep().unwrap()).unwrap();
    points.extend(tight_points().unwrap());
    let list = golden_rows("tradeoff/held_back.csv");
    let results = committed_results().unwrap();
    // The first row holds the names.
    assert_eq!(results.len(), list.len() - 1, "each of the list has been run, and nothing else");
    assert!(results.len() >= 12);
    for listed in &list[1..] {
        let listed: Vec<_> = listed.iter().map(str::to_owned).collect();
        let parameters = Parameters::from_row(&listed).unwrap();
        let row = results.iter().find(|row| row.parameters == parameters);
        let row = row.unwrap_or_else(|| panic!("{listed:?} has no result"));
        let Some(cells) = row.parameters.cells_per_diameter() else { continue };
        let same = points.iter().any(|point| {
            point.collision == row.parameters.collision
                && solid_method(&row.parameters) == Some(point.solid)
                && point.tau == row.parameters.tau
                && (point.cells - cells).abs() < 1e-3
                && point.drag == row.drag
        });
        assert!(!same, "{:?} is among the points", row.parameters);
    }
}

#[test]
fn committed_tables_are_what_the_committed_rows_make() {
    let rows = committed_sweep().unwrap();
    let fits = Fits::of(&rows).unwrap();
    let trials = trials(&fits.models(), &committed_results().unwrap()).unwrap();
    let golden = |name: &str| Table::read(&Path::new(GOLDEN).join("tradeoff").join(name)).unwrap();
    let costs = golden("cost.csv");
    for (name, made) in [
        ("fits.csv", tables::fits(&fits)),
        ("held_back_check.csv", tables::check(&trials)),
        ("front.csv", tables::fronts(&rows, &costs)),
        ("effects.csv", effects::to_table(&effects::effects(&rows))),
    ] {
        assert_eq!(
            golden(name),
            made,
            "{name}: make it anew with cargo validate tradeoff --out golden/tradeoff"
        );
    }
}

#[test]
fn bands_are_narrow_and_hold() {
    let rows = committed_sweep().unwrap();
    let models = Fits::of(&rows).unwrap().models();
    assert_eq!(models.grains.len(), 4);
    for model in &models.grains {
        // Wider ones would be no help in choosing a grid: from 8 to 12 cells an error falls by 2.25.
        assert!(model.band() < 1.5, "{}: {}", model.collision.title(), model.band());
    }
    let trials = trials(&models, &committed_results().unwrap()).unwrap();
    // Bands are made to hold 95 %; 90 % is the aim. Those that bands were widened after count by themselves.
    for [hits, of] in score(&trials) {
        println!("{hits} of {of}");
        assert!(of >= 12 && 10 * hits >= 9 * of, "{hits} of {of}");
    }
}

#[test]
fn bands_of_the_tight_operators_hold_what_was_kept_back() {
    let models = Models::committed().unwrap();
    let all = trials(models, &committed_results().unwrap()).unwrap();
    for solid in [SolidMethod::Graded, SolidMethod::FullBounceBack] {
        let own: Vec<_> =
            all.iter().filter(|trial| solid_method(&trial.row.parameters) == Some(solid)).collect();
        let hits = own.iter().filter(|trial| trial.hits()).count();
        println!("{solid:?}: {hits} of {}", own.len());
        // Bands are made to hold 95 %; 90 % is the aim, as above.
        assert!(own.len() >= 12 && 10 * hits >= 9 * own.len(), "{hits} of {}", own.len());
    }
    // With 14 cells in a bed of 15 times Stokes' drag the operators of this study are told apart from a tenth on.
    for model in &models.tight {
        let [low, high] = model.prediction(14.0, 0.8, 15.0).band;
        assert!(high - low < 0.2, "{:?} {:?}: {low} to {high}", model.solid, model.collision);
    }
}

#[test]
fn graded_viscosity_errs_no_more_than_the_papers_operator_in_fixed_beds() {
    let table = Table::read(&Path::new(GOLDEN).join("tradeoff/operators.csv")).unwrap();
    let rows = Row::of_table(&table).unwrap();
    let exact = |row: &&Row| row.parameters.coverage == CoverageRule::Exact && row.error.is_some();
    let mut pairs: Vec<(&Row, f64, f64)> = Vec::new();
    for row in rows.iter().filter(exact).filter(|row| row.parameters.weight == "graded") {
        let usual = Parameters {
            weight: "NT".to_owned(),
            operator: "bounce_back".to_owned(),
            ..row.parameters.clone()
        };
        let usual = rows.iter().find(|other| other.parameters == usual);
        if let (Some(own), Some(usual)) = (row.error, usual.and_then(|other| other.error)) {
            pairs.push((row, own.abs(), usual.abs()));
        }
    }
    assert!(pairs.len() > 150, "only {} pairs", pairs.len());
    let better = pairs.iter().filter(|(_, own, usual)| own <= usual).count();
    println!("better in {better} of {}", pairs.len());
    // Near tau = 1/2 the two errors of the other cancel in places; nine of ten are asked for all the same.
    assert!(10 * better >= 9 * pairs.len(), "better in {better} of {} only", pairs.len());
    for (row, own, usual) in &pairs {
        // What the place of a grain on the grid may do to two runs, 1 % each.
        assert!(*own < usual + 2.0 * LEAST_ERROR, "{:?}: {own} for {usual}", row.parameters);
    }
    // In no bed on no grid is its largest error the larger.
    for (row, ..) in &pairs {
        let same = |other: &&(&Row, f64, f64)| {
            let (one, other) = (&row.parameters, &other.0.parameters);
            (one.flow, &one.geometry, one.cells) == (other.flow, &other.geometry, other.cells)
        };
        let own = pairs.iter().filter(same).map(|pair| pair.1).fold(0.0, f64::max);
        let usual = pairs.iter().filter(same).map(|pair| pair.2).fold(0.0, f64::max);
        assert!(own < usual, "{:?}: {own} for {usual}", row.parameters);
    }
}

#[test]
fn near_tau_one_half_the_second_error_halves_what_is_left() {
    let points = low_points(&committed_sweep().unwrap()).unwrap();
    assert!(points.len() > 40, "only {} runs", points.len());
    let models = Models::committed().unwrap();
    let above = models.of_grains(Preset::DHumieres, SolidMethod::Usual).unwrap();
    let low = models.low.as_ref().unwrap();
    let (mut with, mut without, mut inside) = (0.0, 0.0, 0);
    for point in &points {
        let found = low.prediction(above, point.cells, point.tau, point.drag);
        let off = |error: f64| (error.ln_1p() - point.error.ln_1p()).powi(2);
        with += off(found.error);
        without += off(above.error(point.cells, point.tau, point.drag));
        inside += usize::from((found.band[0]..=found.band[1]).contains(&point.error));
    }
    let share = (with / without).sqrt();
    println!("{} runs, {inside} within their band, left {share:.2}", points.len());
    assert!(share < 0.5, "the second error leaves {share:.2} of what the first does");
    // 95 % are meant; of so few the count scatters by some hundredths.
    assert!(inside as f64 > 0.9 * points.len() as f64, "{inside} of {}", points.len());
}

#[test]
fn section_of_the_report_draws_every_flow_and_what_was_kept_back() {
    let case = CASES.iter().find(|case| case.name == "tradeoff").unwrap();
    let golden = Golden::of(case, Path::new(GOLDEN));
    let figures = (case.draw)(&golden, &Table::default()).unwrap();
    let wanted = [
        "Flow between plates",
        "Simple cubic",
        "Body-centred",
        "Face-centred",
        "A sphere in a duct",
        "A grain settles",
        "Seepage",
        "Eight spheres",
        "Ten Cate",
        "held back",
    ];
    for title in wanted {
        let figure = figures.iter().find(|figure| figure.title.contains(title));
        let figure = figure.unwrap_or_else(|| panic!("no figure {title:?}"));
        let svg = render_svg(figure).unwrap_or_else(|error| panic!("{title}: {error}"));
        assert!(svg.starts_with("<svg"), "{title}");
    }
}
