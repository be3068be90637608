//! The kit in memory: problems, the oracle's answers, and their gauges.

use thiserror::Error;

use super::array::{Answers, Array};
use super::candidate::answers;
use super::model::Model;
use super::problem::Problem;
use super::problems;
use super::reference::Oracle;
use super::spec::{AnswerSpec, answer_specs};

/// A kit that cannot be made: a mistake in this program, not in what a user gave.
#[derive(Debug, Error)]
pub enum KitError {
    /// A problem whose set-up is refused.
    #[error("a problem of the kit cannot be set up: {0}")]
    Problem(problems::MakeError),
    /// A problem that the oracle does not answer as its specification says.
    #[error("problem {problem}: the oracle has no answer {answer} of the specified shape")]
    Answer {
        /// The problem.
        problem: &'static str,
        /// The answer.
        answer: &'static str,
    },
}

/// An answer of the oracle with its gauge.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// Name, axes and meaning.
    pub spec: AnswerSpec,
    /// The oracle's values.
    pub values: Array,
    /// The gauge of each value.
    pub gauges: Array,
}

/// A problem and its answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    /// The problem.
    pub problem: Problem,
    /// Its answers.
    pub expected: Vec<Expected>,
}

/// All problems with their answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Kit {
    /// By stage.
    pub problems: Vec<Solved>,
}

impl Kit {
    /// Makes the kit: a second of work.
    pub fn make() -> Result<Self, KitError> {
        let model = Model::right();
        let solve = |problem: Problem| {
            let values = answers(&mut Oracle, &problem).unwrap_or_default();
            let gauges = model.answer(&problem).gauges;
            let take = |spec: AnswerSpec| {
                let of = |answers: &Answers| {
                    answers.get(spec.name).filter(|array| array.shape == spec.shape).cloned()
                };
                let (Some(values), Some(gauges)) = (of(&values), of(&gauges)) else {
                    return Err(KitError::Answer { problem: problem.id, answer: spec.name });
                };
                Ok(Expected { spec, values, gauges })
            };
            let expected =
                answer_specs(&problem.task).into_iter().map(take).collect::<Result<_, _>>()?;
            Ok(Solved { problem, expected })
        };
        let problems = problems::all().map_err(KitError::Problem)?;
        Ok(Kit { problems: problems.into_iter().map(solve).collect::<Result<_, _>>()? })
    }
}
