//! The judge: error over the candidate's epsilon times the gauge, answer by answer.

use psmrt_reference::directions::Q;

use super::array::{Answers, Array};
use super::candidate::{Candidate, answers};
use super::diagnosis::{Diagnosis, diagnose};
use super::kit::{Expected, Kit, KitError, Solved};
use super::order::DirectionOrder;
use super::precision::Precision;
use super::problem::Problem;
use super::spec::DIRECTION;

/// Largest error that passes, in the candidate's epsilon times the gauge.
///
/// The gauge sums the absolute terms of one formula, so the round-off of any sensible order of
/// evaluation is of the order of 1 with a little for inputs rounded to the candidate's precision and
/// for chains of formulas; honest candidates in single precision stay below 3 (a test holds it). Mistakes
/// are thousands to billions of times larger, save in half precision.
pub const LIMIT: f64 = 8.0;

/// What the judge finds about one answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The candidate gave none.
    NotAttempted,
    /// Within the limit; its largest error in epsilon times gauge.
    Right(f64),
    /// Beyond it; its largest error likewise, infinite for a number that is none.
    Wrong(f64),
    /// It cannot be judged.
    Unusable(String),
}

/// What the judge finds about one answer, with its place in the kit.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Stage of the problem.
    pub stage: usize,
    /// The problem.
    pub problem: &'static str,
    /// The answer.
    pub answer: &'static str,
    /// What was found.
    pub outcome: Outcome,
}

impl Judged {
    /// Whether it counts against the candidate.
    pub fn failed(&self) -> bool {
        matches!(self.outcome, Outcome::Wrong(_) | Outcome::Unusable(_))
    }
}

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

/// A candidate's answers to all problems: for each problem of the kit, what it gave, or why that
/// cannot be used.
#[derive(Clone, Debug)]
pub struct Submission {
    /// Name of the candidate.
    pub name: String,
    /// Its precision.
    pub precision: Precision,
    /// Its order of directions.
    pub order: DirectionOrder,
    /// For each problem its answers by name; `Err` says why one cannot be read.
    pub answers: Vec<Vec<(String, Result<Array, String>)>>,
    /// What it holds besides.
    pub unasked: Vec<String>,
}

impl Submission {
    /// The answers of an engine to all problems of `kit`.
    pub fn of(kit: &Kit, candidate: &mut dyn Candidate) -> Self {
        let mut submission = Self::gather(kit, |problem| answers(candidate, problem));
        submission.name = candidate.name();
        submission.precision = candidate.precision();
        submission.order = candidate.order();
        submission
    }

    /// What `answer` gives to all problems of `kit`, in double precision and the kit's order.
    pub fn gather(kit: &Kit, mut answer: impl FnMut(&Problem) -> Option<Answers>) -> Self {
        let mut ask = |solved: &Solved| {
            let Answers(given) = answer(&solved.problem).unwrap_or_default();
            given.into_iter().map(|(name, array)| (name, Ok(array))).collect()
        };
        let answers = kit.problems.iter().map(&mut ask).collect();
        Submission {
            name: String::new(),
            precision: Precision::F64,
            order: DirectionOrder::default(),
            answers,
            unasked: Vec::new(),
        }
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

/// Largest difference over gauge: infinite where a value is none, or differs where the gauge is 0.
pub(super) fn largest_ratio(found: &[f64], right: &[f64], gauges: &[f64]) -> f64 {
    let ratio = |((&found, &right), &gauge): ((&f64, &f64), &f64)| ratio(found, right, gauge);
    found.iter().zip(right).zip(gauges).map(ratio).fold(0.0, f64::max)
}

/// Difference over gauge of one value.
pub(super) fn ratio(found: f64, right: f64, gauge: f64) -> f64 {
    if found == right || (found.is_nan() && right.is_nan()) {
        return 0.0;
    }
    let ratio = (found - right).abs() / gauge;
    if ratio.is_nan() { f64::INFINITY } else { ratio }
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
