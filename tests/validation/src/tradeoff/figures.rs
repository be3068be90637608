//! The figures: error against time with the front drawn, one a flow; predictions beside what was measured.

use psmrt_reference::collision::Preset;
use psmrt_reference::coverage::CoverageRule;
use psmrt_report::{Axis, Figure, Marker, Series, Style};

use super::cost::seconds_per_update;
use super::pareto::front;
use crate::cases::CaseError;
use crate::tradeoff::parameters::{Flow, Storage};
use crate::tradeoff::row::Row;
use crate::tradeoff::trial::{Trial, score};
use psmrt::table::Table;

/// Errors below this are drawn at it: a log axis has no zero.
const FLOOR: f64 = 1e-8;

/// A run on the plane of cost and error.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed<'a> {
    /// The run.
    pub row: &'a Row,
    /// Seconds: cell updates times the best measured cost of one.
    pub seconds: f64,
    /// Size of the error.
    pub error: f64,
}

/// The different flows and geometries among some rows, in the order of the report.
pub fn problems(rows: &[Row]) -> Vec<(Flow, String)> {
    let mut found = Vec::new();
    for flow in Flow::ALL {
        for row in rows.iter().filter(|row| row.parameters.flow == flow) {
            let problem = (flow, row.parameters.geometry.clone());
            if !found.contains(&problem) {
                found.push(problem);
            }
        }
    }
    found
}

/// Faster flows have another truth: inertia adds to the drag.
const MOST_REYNOLDS: f64 = 1.0;

/// The runs of a flow in a geometry that have an error and a cost.
pub fn placed<'a>(
    (flow, geometry): &(Flow, String),
    rows: &'a [Row],
    costs: &Table,
) -> Vec<Placed<'a>> {
    let own = rows
        .iter()
        .filter(|row| row.parameters.flow == *flow && row.parameters.geometry == *geometry);
    own.filter(|row| row.parameters.reynolds() < MOST_REYNOLDS)
        .filter_map(|row| {
            let cost = seconds_per_update(costs, &row.parameters).ok()?;
            let seconds = row.cell_updates() as f64 * cost;
            Some(Placed { row, seconds, error: row.error?.abs().max(FLOOR) })
        })
        .collect()
}

/// Whether a run's models converge with the grid. The others (`B = eps`, few sample points, superposition)
/// can come out right at one relaxation time, where two errors cancel, and are far off at the next.
fn converges(row: &Row) -> bool {
    row.parameters.weight == "NT"
        && row.parameters.operator == "bounce_back"
        && !matches!(row.parameters.coverage, CoverageRule::Sampled { .. })
}

/// The runs of the front among them, the cheapest first: of all, or of those whose models converge. What
/// psmrt cannot do (storage in fewer digits is tried on the oracle only) has no place on it.
pub fn on_front<'a, 'b>(placed: &'b [Placed<'a>], all: bool) -> Vec<&'b Placed<'a>> {
    let offered: Vec<_> = placed
        .iter()
        .filter(|p| !p.row.parameters.is_emulated())
        .filter(|p| all || converges(p.row))
        .collect();
    let points: Vec<_> = offered.iter().map(|p| (p.seconds, p.error)).collect();
    front(&points).into_iter().map(|i| offered[i]).collect()
}

/// Which series of a figure a run belongs to.
fn series_of(row: &Row) -> &'static str {
    let parameters = &row.parameters;
    match (parameters.storage, &*parameters.engine) {
        (Storage::F32, _) => "f32 unshifted (storage only)",
        (Storage::F16Shifted, _) => "f16 shifted (storage only)",
        (_, "wgpu") => "kernel, f32 shifted",
        _ if parameters.weight == "eps" => "weight B = eps",
        _ if parameters.operator == "superposition" => "superposition",
        _ if parameters.coverage == CoverageRule::Linear => "linear coverage",
        _ if parameters.coverage != CoverageRule::Exact => "sampled coverage",
        _ => match parameters.collision {
            Preset::Srt => "SRT",
            Preset::DHumieres => "MRT d'Humieres (default)",
            Preset::Trt => "TRT 3/16",
        },
    }
}

const SERIES: [(&str, Marker); 10] = [
    ("MRT d'Humieres (default)", Marker::Circle),
    ("SRT", Marker::Square),
    ("TRT 3/16", Marker::TriangleUp),
    ("weight B = eps", Marker::Diamond),
    ("superposition", Marker::TriangleDown),
    ("sampled coverage", Marker::Ring),
    ("linear coverage", Marker::Square),
    ("kernel, f32 shifted", Marker::Cross),
    ("f32 unshifted (storage only)", Marker::TriangleUp),
    ("f16 shifted (storage only)", Marker::Circle),
];

/// Title of a flow in a geometry.
pub fn title((flow, geometry): &(Flow, String)) -> String {
    match flow {
        Flow::Poiseuille => "Flow between plates, 8 to 24 cells".to_owned(),
        Flow::Sc => format!("Simple cubic array, solid fraction {geometry}"),
        Flow::Bcc => format!("Body-centred cubic array, solid fraction {geometry}"),
        Flow::Fcc => format!("Face-centred cubic array, solid fraction {geometry}"),
        Flow::SphereDrag => "A sphere in a duct 5 diameters wide".to_owned(),
        Flow::Settling => {
            let width = 1.0 / geometry.parse().unwrap_or(f64::NAN);
            format!("A grain settles in a shaft {width} diameters wide")
        }
        Flow::Seepage => format!("Seepage through a bed as dense as sand ({geometry})"),
        Flow::Random => format!("Eight spheres at random places, solid fraction {geometry}"),
    }
}

/// Error against time for a flow in a geometry; `None` without a run to draw.
pub fn error_against_time(problem: &(Flow, String), rows: &[Row], costs: &Table) -> Option<Figure> {
    let placed = placed(problem, rows, costs);
    if placed.is_empty() {
        return None;
    }
    let title = title(problem);
    let error = match problem.0 {
        Flow::Poiseuille => "error of the profile (relative L2)",
        Flow::Settling => "error of the settling velocity",
        _ => "error of the velocity under a given force",
    };
    let mut figure = Figure::new(
        format!("{title}: error against time"),
        Axis::log("time to the steady flow (s): cell updates times the cost of one"),
        Axis::log(error),
    )
    .size(800, 600);
    // The same colour and marker in every figure.
    for (number, (label, marker)) in SERIES.into_iter().enumerate() {
        let own = placed.iter().filter(|p| series_of(p.row) == label);
        let points: Vec<_> = own.map(|p| (p.seconds, p.error)).collect();
        if !points.is_empty() {
            let series = Series::new(label, Style::Points(Some(marker)), points);
            figure = figure.with(series.with_colour(number));
        }
    }
    let points = |all| on_front(&placed, all).iter().map(|p| (p.seconds, p.error)).collect();
    let (best, of_all): (Vec<_>, Vec<_>) = (points(false), points(true));
    if best.len() > 1 {
        let label = "Pareto front of models that converge";
        figure = figure.with(Series::dashed(label, steps(&best)).with_colour(0));
    }
    if of_all.len() > 1 && of_all != best {
        let label = "Pareto front of all runs";
        figure = figure.with(Series::new(label, Style::Reference, steps(&of_all)));
    }
    let figure =
        figure.note("on a Pareto front no run is both faster and more accurate than another; sweep.csv has all runs");
    let floor = placed.iter().any(|p| p.error == FLOOR);
    Some(match problem.0 {
        Flow::Poiseuille if floor => figure.note("errors below 1e-8 are drawn at 1e-8"),
        Flow::Poiseuille => figure,
        _ => figure.note(
            "below the front of models that converge errors cancel: at another tau the same model is far off",
        ),
    })
}

/// A front as a staircase: until the next better point nothing better is to be had.
fn steps(best: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let corners = best.windows(2).flat_map(|pair| [pair[0], (pair[1].0, pair[0].1)]);
    corners.chain(best.last().copied()).collect()
}

/// Measured against predicted errors of what was held back.
pub fn held_back(trials: &[Trial]) -> Option<Figure> {
    // Errors with B = epsilon have either sign: no place for them on logarithms.
    let shown = |trial: &&Trial| {
        trial.measured.abs() > 0.0 && trial.predicted > 0.0 && trial.row.parameters.weight == "NT"
    };
    let shown: Vec<&Trial> = trials.iter().filter(shown).collect();
    let values = || shown.iter().flat_map(|trial| [trial.predicted, trial.measured.abs()]);
    let low = 0.7 * values().fold(f64::INFINITY, f64::min);
    let high = 1.5 * values().fold(0.0, f64::max);
    if shown.is_empty() {
        return None;
    }
    let mut figure = Figure::new(
        "Configurations held back from the fits: measured against predicted error",
        Axis::log("predicted error").range(low, high),
        Axis::log("measured error").range(low / 1.5, high * 1.5),
    );
    for (colour, collision) in Preset::ALL.into_iter().enumerate() {
        let own = shown.iter().filter(|trial| trial.row.parameters.collision == collision);
        let points: Vec<_> = own.map(|t| (t.predicted, t.measured.abs())).collect();
        if !points.is_empty() {
            figure = figure.with(Series::points(collision.title(), points).with_colour(colour));
        }
    }
    let line = |factor: f64| [(low, factor * low), (high, factor * high)];
    let [up, down] = [line(1.5), line(1.0 / 1.5)];
    let [[first, of_first], [hits, of]] = score(trials);
    Some(
        figure
            .with(Series::new("as predicted", Style::Reference, line(1.0).into()))
            // Both in one series, joined along the frame.
            .with(Series::new(
                "a factor of 1.5 off",
                Style::Reference,
                vec![up[0], up[1], down[1], down[0]],
            ))
            .note(format!(
                "{hits} of {of} lie within their own band, and {first} of the {of_first} after which bands were widened; \
                 B = eps, whose errors have either sign, is counted and not drawn"
            )),
    )
}

/// Ten Cate's sphere: error of the largest velocity against time, from the committed falls.
pub fn ten_cate(study: &Table, costs: &Table) -> Result<Figure, CaseError> {
    let wanted = [("engine", "reference"), ("collision", "MRT_dHumieres"), ("scene", "free")];
    let cost = 1e-9 * costs.with(&wanted)?.number("ns_per_cell_update")?;
    let mut figure = Figure::new(
        "Ten Cate's settling sphere: error against time",
        Axis::log("time of the fall (s): cell updates times the cost of one"),
        Axis::linear("error of the largest velocity").range(-0.04, 0.04),
    );
    for case in study.values("case")? {
        let own = study.with(&[("case", &case)])?;
        let (cells, steps) = (own.numbers("cells")?, own.numbers("steps")?);
        let seconds = cells.iter().zip(&steps).map(|(cells, steps)| cells * steps * cost);
        let points = seconds.zip(own.numbers("error_of_largest")?).collect();
        let tau = own.values("tau")?.join(", ");
        figure = figure.with(Series::line_points(format!("{case}, tau {tau}"), points));
    }
    Ok(figure.note(
        "8, 12 and 16 cells per diameter; the experiment itself is good to 2 %: no front is drawn",
    ))
}
