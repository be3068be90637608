//! What is judged, and what is found of it: a candidate's answers, and the error of each over its gauge.

use super::array::{Answers, Array};
use super::candidate::{Candidate, answers};
use super::kit::{Kit, Solved};
use super::order::DirectionOrder;
use super::precision::Precision;
use super::problem::Problem;

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
