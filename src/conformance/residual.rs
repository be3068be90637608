//! Where the error of a wrong answer sits: in which directions, moments and cells.

use psmrt_reference::directions::{C, Q};
use psmrt_reference::moments::{NAMES, moment_matrix};

use super::array::Array;
use super::judged::{LIMIT, ratio};
use super::kit::Expected;
use super::problem::Problem;
use super::spec::DIRECTION;
use super::task::Task;

/// Where the error of an answer sits.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorPlace {
    /// The problem.
    pub problem: &'static str,
    /// The answer.
    pub answer: &'static str,
    /// Findings, each a sentence.
    pub findings: Vec<String>,
}

/// Most items that a finding lists.
const LISTED: usize = 8;

/// Looks where `found` differs from what is expected.
pub(super) fn locate(
    problem: &Problem,
    expected: &Expected,
    found: &Array,
    epsilon: f64,
) -> ErrorPlace {
    let spec = &expected.spec;
    let (right, gauges) = (&expected.values.values, &expected.gauges.values);
    let bad: Vec<usize> = (0..right.len())
        .filter(|&i| ratio(found.values[i], right[i], gauges[i]) > LIMIT * epsilon)
        .collect();
    let mut findings = vec![format!("{} of {} values are off", bad.len(), right.len())];
    if bad.iter().any(|&i| !found.values[i].is_finite()) {
        findings.push("some are not numbers (NaN or infinite)".to_owned());
    }
    let mut stride: usize = right.len();
    for (&axis, &length) in spec.axes.iter().zip(&spec.shape) {
        stride /= length;
        let mut at: Vec<usize> = bad.iter().map(|i| i / stride % length).collect();
        at.sort_unstable();
        at.dedup();
        if at.len() < length {
            let names: Vec<String> = at.iter().map(|&i| name(axis, i)).collect();
            findings.push(format!("only at {axis} {}", list(&names)));
        }
    }
    if spec.axes.last() == Some(&DIRECTION) {
        findings.extend(in_moments(&found.values, right, gauges, epsilon));
    }
    findings.extend(in_cells(problem, expected, &bad));
    if let Some(finding) = factor(&found.values, right, gauges, epsilon) {
        findings.push(finding);
    }
    ErrorPlace { problem: problem.id, answer: spec.name, findings }
}

/// What position `i` along an axis is called.
fn name(axis: &str, i: usize) -> String {
    match axis {
        DIRECTION => format!("{i} ({:+}{:+}{:+})", C[i][0], C[i][1], C[i][2]),
        "component" => ["x", "y", "z"][i].to_owned(),
        "moment" => NAMES[i].to_owned(),
        _ => i.to_string(),
    }
}

fn list(names: &[String]) -> String {
    let more = names.len().saturating_sub(LISTED);
    let listed = names.iter().take(LISTED).cloned().collect::<Vec<_>>().join(", ");
    if more > 0 { format!("{listed} and {more} more") } else { listed }
}

/// In which moments the error sits: `M` times the difference of the populations.
fn in_moments(found: &[f64], right: &[f64], gauges: &[f64], epsilon: f64) -> Option<String> {
    let matrix = moment_matrix();
    let off = |k: usize| {
        (0..right.len() / Q).any(|cell| {
            let terms = (0..Q).map(|a| {
                let i = cell * Q + a;
                (matrix[(k, a)] * (found[i] - right[i]), matrix[(k, a)].abs() * gauges[i])
            });
            let (difference, gauge) =
                terms.fold((0.0, 0.0), |sum, term| (sum.0 + term.0, sum.1 + term.1));
            difference.abs() > LIMIT * epsilon * gauge
        })
    };
    let names: Vec<String> = (0..Q).filter(|&k| off(k)).map(|k| NAMES[k].to_owned()).collect();
    let conserved =
        ["rho", "jx", "jy", "jz"].iter().filter(|&&name| !names.iter().any(|n| n == name));
    let conserved: Vec<&str> = conserved.copied().collect();
    match (names.len(), conserved.len()) {
        (Q | 0, _) => None,
        (_, 4) => Some(format!("in the moments {}; mass and momentum are right", list(&names))),
        _ => Some(format!("in the moments {}", list(&names))),
    }
}

/// Whether the wrong cells are those beside faces, or with solid in them.
fn in_cells(problem: &Problem, expected: &Expected, bad: &[usize]) -> Option<String> {
    if let Task::Collisions(task) = &problem.task {
        let per_cell = expected.values.values.len() / task.cells.len();
        let off = |cell: usize| bad.iter().any(|i| i / per_cell == cell);
        let bare = |cell: usize| task.cells[cell].solid.is_some_and(|solid| solid.0 == 0.0);
        let solid = task.cells.iter().any(|cell| cell.solid.is_some());
        let right_where_bare = (0..task.cells.len()).all(|cell| !(bare(cell) && off(cell)));
        return (solid && right_where_bare).then(|| "only in cells with solid in them".to_owned());
    }
    let domain = match &problem.task {
        Task::Streaming(task) => &task.domain,
        Task::Scene(scene) => &scene.setup.domain,
        _ => return None,
    };
    if expected.spec.name != "populations" {
        return None;
    }
    let n = domain.cells();
    let beside = |i: &usize| {
        let x = domain.coordinates(i / Q);
        (0..3).any(|axis| !domain.is_periodic(axis) && (x[axis] == 0 || x[axis] + 1 == n[axis]))
    };
    let walled = (0..3).any(|axis| !domain.is_periodic(axis));
    (walled && bad.iter().all(beside))
        .then(|| "only in cells beside faces that are not periodic".to_owned())
}

/// A common factor between what was found and what is right.
fn factor(found: &[f64], right: &[f64], gauges: &[f64], epsilon: f64) -> Option<String> {
    let largest = (0..right.len()).max_by(|&a, &b| right[a].abs().total_cmp(&right[b].abs()))?;
    let factor = found[largest] / right[largest];
    if !factor.is_finite() || right.len() < 3 {
        return None;
    }
    let fits = |i: usize| {
        ratio(found[i], factor * right[i], gauges[i] * factor.abs().max(1.0))
            <= 4.0 * LIMIT * epsilon
    };
    (0..right.len())
        .all(fits)
        .then(|| format!("all values are {factor:.6} times what they should be"))
}
