//! What stands behind a prediction, in words.

use super::model::{LEAST_TAU, SolidMethod};
use super::model_eps::EpsModel;
use super::model_tight::TightModel;
use super::models::Models;
use super::runs::{GrainPoint, committed};
use crate::advice::coefficients::numbers;
use crate::table::TableError;
use psmrt_reference::collision::Preset;

/// How many of the nearest runs are named.
const NEAREST: usize = 3;

/// Evidence for an error with grains.
pub fn of_grains(
    models: &Models,
    (collision, solid): (Preset, SolidMethod),
    cells: f64,
    tau: f64,
    drag: f64,
) -> Result<Vec<String>, TableError> {
    if let Some(model) = models.of_tight(collision, solid) {
        return of_tight(models, model, cells, tau, drag);
    }
    let Some(model) = models.of_grains(collision, solid) else {
        return Ok(vec![format!(
            "with B = epsilon two errors of opposite sign cancel here and not there: what was left out of the \
             fit lies within a factor of {:.2} of the velocity (src/advice/tradeoff/model_eps.rs)",
            models.eps.as_ref().map_or(f64::NAN, EpsModel::band)
        )]);
    };
    let p = &model.parameters;
    let [[least, most], [low, high], [light, heavy]] = model.evidence.ranges;
    let mut lines = vec![
        format!(
            "{} runs of {} geometries with {} (golden/tradeoff/sweep.csv, golden/sphere_arrays/study.csv): \
             {least:.1} to {most:.1} cells, tau {low} to {high}, drag {light:.2} to {heavy:.0}",
            model.evidence.counts[0],
            model.evidence.counts[1],
            collision.title()
        ),
        format!(
            "error = K^{:.2} [{:.2} (tau - 1/2)/d^2 + {:.2}/d^{:.2}]; 95 % of what was \
             left out of the fit lies within a factor of {:.2}",
            p[2],
            p[0].exp(),
            p[1].exp(),
            p[3],
            model.band()
        ),
    ];
    let is_low = tau < LEAST_TAU && collision == Preset::DHumieres;
    if let Some(low) = models.low.as_ref().filter(|_| is_low && solid == SolidMethod::Usual) {
        let p = &low.parameters;
        let [_, [low_tau, high_tau], [light, heavy]] = low.evidence.ranges;
        lines.push(format!(
            "below tau {LEAST_TAU} the velocity is less by exp(-s), s = K^{:.2} {:.3}/d^{:.2} [(tau - 1/2)^-1/2 - \
             {:.2}]: {} runs of {} geometries at tau {low_tau} to {high_tau}, drag {light:.2} to {heavy:.0}, also \
             of golden/seepage/study.csv; 95 % of what was left out of the fit lies within {:.0} % of the \
             error above (of the velocity, and 2 %)",
            p[1],
            p[0].exp(),
            p[2],
            (LEAST_TAU - 0.5).powf(-0.5),
            low.evidence.counts[0],
            low.evidence.counts[1],
            100.0 * low.share()
        ));
    }
    let [first, of_first, hits, of] = numbers("held back", "grains and plates")?;
    lines.push(format!(
        "configurations held back from the fits: {hits} of {of} within their band, and {first} of {of_first} \
         of those that the bands were widened after"
    ));
    lines.extend(near(models, (collision, solid), cells, tau, drag)?);
    lines.extend(beyond(drag, [light, heavy]));
    Ok(lines)
}

/// Evidence for an error with an operator that lets no fluid through.
fn of_tight(
    models: &Models,
    model: &TightModel,
    cells: f64,
    tau: f64,
    drag: f64,
) -> Result<Vec<String>, TableError> {
    let p = &model.parameters;
    let [[least, most], [low, high], reach @ [light, heavy]] = model.evidence.ranges;
    let size = match model.collision {
        Preset::Srt => format!("[{:.2} + {:.2} (tau - 1/2)^2]", p[0].exp(), p[4].exp()),
        Preset::DHumieres | Preset::Trt => format!("{:.2} (tau - 1/2)^{:.2}", p[0].exp(), p[4]),
    };
    let [hits, of] = numbers("held back", "operators")?;
    let mut lines = vec![
        format!(
            "{} runs of {} geometries with {} and {} (golden/tradeoff/operators.csv): {least:.1} to {most:.1} cells, tau \
             {low} to {high}, drag {light:.2} to {heavy:.0}",
            model.evidence.counts[0],
            model.evidence.counts[1],
            model.solid.title(),
            model.collision.title()
        ),
        format!(
            "ln(1 + error) = K^{:.2} {size}/d^2 - {:.2} K^{:.2}/d; 95 % of what was left out of the fit lies within {:.0} % \
             of the first part, and 1 %",
            p[1],
            p[2].exp(),
            p[3],
            100.0 * model.share()
        ),
        format!("configurations held back from the fits: {hits} of {of} within their band"),
    ];
    lines.extend(near(models, (model.collision, model.solid), cells, tau, drag)?);
    lines.extend(beyond(drag, reach));
    Ok(lines)
}

/// A warning where a drag lies outside the evidence.
fn beyond(drag: f64, [light, heavy]: [f64; 2]) -> Option<String> {
    (!(light..=heavy).contains(&drag)).then(|| {
        format!("warning: a drag of {drag:.2} lies outside the evidence ({light:.2} to {heavy:.0})")
    })
}

/// The runs nearest to a prediction, a line each.
fn near(
    models: &Models,
    (collision, solid): (Preset, SolidMethod),
    cells: f64,
    tau: f64,
    drag: f64,
) -> Result<Vec<String>, TableError> {
    let mut lines = Vec::new();
    let mut points = committed()?;
    points.retain(|point| point.collision == collision && point.solid == solid);
    let distance = |point: &GrainPoint| {
        let ratio = |a: f64, b: f64| (a / b).ln().powi(2);
        ratio(point.cells, cells) + ratio(point.tau - 0.5, tau - 0.5) + ratio(point.drag, drag)
    };
    points.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    for point in points.iter().take(NEAREST) {
        lines.push(format!(
            "near it: {}, {:.1} cells, tau {}, drag {:.2}: measured {:.1} %, by the model {:.1} % ({})",
            point.geometry,
            point.cells,
            point.tau,
            point.drag,
            100.0 * point.error,
            100.0
                * models
                    .with_grains((collision, solid), point.cells, point.tau, point.drag)
                    .map_or(f64::NAN, |found| found.error),
            point.source
        ));
    }
    Ok(lines)
}

/// What is known at the Reynolds number of a scene.
pub fn of_reynolds(reynolds: Option<f64>) -> Option<String> {
    match reynolds? {
        reynolds if reynolds < 1.0 => None,
        reynolds if reynolds <= 35.0 => Some(format!(
            "Re is about {reynolds:.1}, the runs above have 0.05 and less; ten Cate's sphere (Re 1.5 to 32, 8 \
             to 16 cells) settles within 3 % of the experiment (golden/ten_cate/study.csv)"
        )),
        reynolds => Some(format!(
            "warning: Re is about {reynolds:.0}; nothing above 32 stands behind this: boundary layers of \
             grains get thinner, and the error is larger than predicted"
        )),
    }
}

/// Evidence for an error between plates.
pub fn of_walls(models: &Models, collision: Preset) -> Vec<String> {
    match models.of_walls(collision) {
        Some(model) => vec![format!(
            "{} runs between plates with {} (golden/tradeoff/sweep.csv): {:.3} times the slip that Ginzburg \
             and d'Humieres derived, and {:.4} u^2 (u in cells per step)",
            model.count,
            collision.title(),
            model.parameters[0],
            model.parameters[1]
        )],
        None => vec![
            "with Lambda = 3/16 a plane wall along the grid stands exactly half-way between nodes: only \
             rounding is left (golden/tradeoff/sweep.csv); walls that are not plane do not gain"
                .to_owned(),
        ],
    }
}
