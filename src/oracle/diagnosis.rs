//! The diagnosis: which single mistake of the catalogue reproduces the candidate's wrong numbers.

use super::array::Array;
use super::judge::{Judged, LIMIT, Outcome, Submission, largest_ratio};
use super::kit::Kit;
use super::mistakes::{CATALOGUE, Mistake};
use super::model::Model;
use super::residual::{Place, locate};

/// A mistake that reproduces wrong answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fit {
    /// The mistake.
    pub mistake: Mistake,
    /// Answers (problem, answer) that it would have changed too, though the candidate has them right.
    pub contradicted: Vec<(&'static str, &'static str)>,
}

/// What is probably wrong with a candidate.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Single mistakes that reproduce all wrong answers, those without contradiction first.
    pub single: Vec<Fit>,
    /// Where no single one does: for each problem with wrong answers, the mistakes that reproduce
    /// these by themselves.
    pub by_problem: Vec<(&'static str, Vec<Mistake>)>,
    /// Where the errors sit, for problems that nothing explains.
    pub places: Vec<Place>,
}

impl Diagnosis {
    /// The mistake that is named: the one single mistake that contradicts nothing, or least.
    pub fn named(&self) -> Option<Mistake> {
        self.single.first().map(|fit| fit.mistake)
    }
}

/// An answer that the candidate gave and that could be compared.
struct Given<'a> {
    problem: usize,
    judged: &'a Judged,
    array: &'a Array,
}

/// Finds what is wrong; `None` if nothing is, or nothing that could be compared.
pub(super) fn diagnose(
    kit: &Kit,
    judged: &[Judged],
    usable: &[Option<Array>],
    submission: &Submission,
) -> Option<Diagnosis> {
    let mut given = Vec::new();
    let numbers = kit.problems.iter().enumerate().flat_map(|(number, solved)| {
        solved.expected.iter().map(move |_| number)
    });
    for ((judged, array), problem) in judged.iter().zip(usable).zip(numbers) {
        if let Some(array) = array {
            given.push(Given { problem, judged, array });
        }
    }
    if !given.iter().any(|given| wrong(given.judged)) {
        return None;
    }
    let mut trials = Vec::new();
    for entry in &CATALOGUE {
        let model = Model::mistaken(entry.mistake, &submission.order);
        let epsilon = submission.precision.epsilon();
        trials.push(try_mistake(kit, &given, &model, epsilon).map(|contradicted| Fit {
            mistake: entry.mistake,
            contradicted,
        }));
    }
    let mut single: Vec<Fit> = trials.into_iter().flatten().collect();
    single.sort_by_key(|fit| fit.contradicted.len());
    // What contradicts right answers is only worth a word if nothing fits without.
    if single.first().is_some_and(|fit| fit.contradicted.is_empty()) {
        single.retain(|fit| fit.contradicted.is_empty());
    }
    let (mut by_problem, mut places) = (Vec::new(), Vec::new());
    if single.is_empty() {
        by_problem = explain_by_problem(kit, &given, submission);
        for given in given.iter().filter(|given| wrong(given.judged)) {
            let id = given.judged.problem;
            if by_problem.iter().any(|(problem, mistakes)| *problem == id && mistakes.is_empty()) {
                let solved = &kit.problems[given.problem];
                let expected = solved.expected.iter().find(|e| e.spec.name == given.judged.answer);
                let epsilon = submission.precision.epsilon();
                places.extend(expected.map(|e| locate(&solved.problem, e, given.array, epsilon)));
            }
        }
    }
    Some(Diagnosis { single, by_problem, places })
}

fn wrong(judged: &Judged) -> bool {
    matches!(judged.outcome, Outcome::Wrong(_))
}

/// `None` unless the mistake reproduces all wrong answers; else the right answers that it contradicts.
/// Problems are tried from the cheapest, and the first wrong answer that differs ends the trial.
fn try_mistake(
    kit: &Kit,
    given: &[Given<'_>],
    model: &Model,
    epsilon: f64,
) -> Option<Vec<(&'static str, &'static str)>> {
    let mut contradicted = Vec::new();
    for chunk in given.chunk_by(|a, b| a.problem == b.problem) {
        let solved = &kit.problems[chunk[0].problem];
        let predicted = model.answer(&solved.problem);
        for given in chunk {
            let name = given.judged.answer;
            if reproduces(&predicted, name, given.array, epsilon) {
                continue;
            }
            if wrong(given.judged) {
                return None;
            }
            contradicted.push((given.judged.problem, name));
        }
    }
    Some(contradicted)
}

fn reproduces(
    predicted: &super::model::GaugedAnswers,
    name: &str,
    array: &Array,
    epsilon: f64,
) -> bool {
    let (Some(values), Some(gauges)) = (predicted.values.get(name), predicted.gauges.get(name)) else {
        return false;
    };
    largest_ratio(&array.values, &values.values, &gauges.values) <= LIMIT * epsilon
}

/// For each problem with wrong answers, the mistakes that reproduce these.
fn explain_by_problem(
    kit: &Kit,
    given: &[Given<'_>],
    submission: &Submission,
) -> Vec<(&'static str, Vec<Mistake>)> {
    let epsilon = submission.precision.epsilon();
    let models: Vec<(Mistake, Model)> = CATALOGUE
        .iter()
        .map(|entry| (entry.mistake, Model::mistaken(entry.mistake, &submission.order)))
        .collect();
    let mut explained = Vec::new();
    for chunk in given.chunk_by(|a, b| a.problem == b.problem) {
        if !chunk.iter().any(|given| wrong(given.judged)) {
            continue;
        }
        let solved = &kit.problems[chunk[0].problem];
        let fits = |model: &Model| {
            let predicted = model.answer(&solved.problem);
            chunk.iter().all(|given| reproduces(&predicted, given.judged.answer, given.array, epsilon))
        };
        let mistakes = models.iter().filter(|(_, model)| fits(model)).map(|(mistake, _)| *mistake);
        explained.push((solved.problem.id, mistakes.collect()));
    }
    explained
}
