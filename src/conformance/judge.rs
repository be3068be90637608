//! The judge: error over the candidate's epsilon times the gauge, answer by answer.

use psmrt_reference::directions::Q;

use super::array::Array;
use super::candidate::Candidate;
use super::diagnosis::{Diagnosis, diagnose};
use super::judged::{Judged, LIMIT, Outcome, Submission, largest_ratio};
use super::kit::{Expected, Kit, KitError};
use super::order::DirectionOrder;
use super::precision::Precision;
use super::spec::DIRECTION;

/// The verdict on a candidate. Its `Display` is the judge's table.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Name of the candidate.
    pub candidate: String,
    /// Precision by which it was judged.
    pub precision: Precision,
    /// Each answer of the kit.
    pub judged: Vec<Judged>,
    /// What is probably wrong, if something is.
    pub diagnosis: Option<Diagnosis>,
    /// What the candidate's folder holds besides answers to the kit.
    pub unasked: Vec<String>,
}

impl Verdict {
    /// Whether something was attempted and all of it is right.
    pub fn passed(&self) -> bool {
        self.attempted() > 0 && !self.judged.iter().any(Judged::failed)
    }

    /// Number of answers that were attempted.
    pub fn attempted(&self) -> usize {
        self.judged.iter().filter(|judged| judged.outcome != Outcome::NotAttempted).count()
    }

    /// Largest error among right and wrong answers, in epsilon times gauge.
    pub fn largest_error(&self) -> f64 {
        let error = |judged: &Judged| match judged.outcome {
            Outcome::Right(error) | Outcome::Wrong(error) => error,
            _ => 0.0,
        };
        self.judged.iter().map(error).fold(0.0, f64::max)
    }
}

/// Judges an engine: the whole suite in one call. Errors only if the kit cannot be made.
pub fn judge(candidate: &mut dyn Candidate) -> Result<Verdict, KitError> {
    let kit = Kit::make()?;
    let submission = Submission::of(&kit, candidate);
    Ok(judge_submission(&kit, &submission))
}

/// Judges answers that are there already.
pub fn judge_submission(kit: &Kit, submission: &Submission) -> Verdict {
    let mut unasked = submission.unasked.clone();
    let (mut judged, mut usable) = (Vec::new(), Vec::new());
    for (solved, given) in kit.problems.iter().zip(&submission.answers) {
        let asked = |name: &str| solved.expected.iter().any(|expected| expected.spec.name == name);
        let foreign = given.iter().filter(|(name, _)| !asked(name));
        unasked.extend(foreign.map(|(name, _)| format!("{}/{name}", solved.problem.id)));
        for expected in &solved.expected {
            let answer = given.iter().find(|(name, _)| name == expected.spec.name);
            let sorted = answer.map(|(_, array)| match array {
                Ok(array) => into_kit_order(expected, array, &submission.order),
                Err(reason) => Err(reason.clone()),
            });
            let outcome = match &sorted {
                None => Outcome::NotAttempted,
                Some(Err(reason)) => Outcome::Unusable(reason.clone()),
                Some(Ok(array)) => compare(expected, array, submission.precision),
            };
            let (stage, problem) = (solved.problem.stage, solved.problem.id);
            judged.push(Judged { stage, problem, answer: expected.spec.name, outcome });
            usable.push(sorted.and_then(Result::ok));
        }
    }
    let diagnosis = diagnose(kit, &judged, &usable, submission);
    let (candidate, precision) = (submission.name.clone(), submission.precision);
    Verdict { candidate, precision, judged, diagnosis, unasked }
}

fn compare(expected: &Expected, array: &Array, precision: Precision) -> Outcome {
    let error = largest_ratio(&array.values, &expected.values.values, &expected.gauges.values)
        / precision.epsilon();
    if error <= LIMIT { Outcome::Right(error) } else { Outcome::Wrong(error) }
}

/// The array with directions in the kit's order, if it has the shape that is asked for.
fn into_kit_order(
    expected: &Expected,
    array: &Array,
    order: &DirectionOrder,
) -> Result<Array, String> {
    let spec = &expected.spec;
    if array.shape != spec.shape {
        return Err(format!(
            "its shape is {:?}, asked is {:?} ({})",
            array.shape,
            spec.shape,
            spec.axes.join(", ")
        ));
    }
    let mut values = array.values.clone();
    if spec.numbers_directions {
        for value in &mut values {
            let number = (0..Q).find(|&own| own as f64 == *value);
            let own = number
                .ok_or_else(|| format!("{value} is not the number of a direction, 0 to 18"))?;
            *value = order.in_kit(own) as f64;
        }
    }
    if let Some(axis) = spec.axes.iter().position(|&axis| axis == DIRECTION) {
        let stride: usize = spec.shape[axis + 1..].iter().product();
        let unsorted = values.clone();
        for (position, value) in unsorted.into_iter().enumerate() {
            let own = position / stride % Q;
            let sorted = position + order.in_kit(own) * stride - own * stride;
            values[sorted] = value;
        }
    }
    Ok(Array { shape: array.shape.clone(), values })
}
