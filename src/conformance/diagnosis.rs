//! The diagnosis: which single mistake of the catalogue reproduces the candidate's wrong numbers.
//!
//! A mistake that makes a long scene unstable cannot be compared there: such a scene is disturbed by one epsilon, and what
//! that grows to is taken for round-off.

use psmrt_reference::lattice::Populations;

use super::array::{Answers, Array};
use super::judged::{Judged, LIMIT, Outcome, Submission, largest_ratio};
use super::kit::Kit;
use super::mistakes::{CATALOGUE, Entry, Mistake};
use super::model::{GaugedAnswers, Model};
use super::order::DirectionOrder;
use super::problem::Problem;
use super::residual::{ErrorPlace, locate};
use super::task::Task;

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
    pub places: Vec<ErrorPlace>,
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
    let numbers = kit
        .problems
        .iter()
        .enumerate()
        .flat_map(|(number, solved)| solved.expected.iter().map(move |_| number));
    for ((judged, array), problem) in judged.iter().zip(usable).zip(numbers) {
        if let Some(array) = array {
            given.push(Given { problem, judged, array });
        }
    }
    if !given.iter().any(|given| wrong(given.judged)) {
        return None;
    }
    let mut judge =
        Trials { kit, given: &given, epsilon: submission.precision.epsilon(), strict: true };
    let mut single = judge.fits(&submission.order);
    if single.is_empty() {
        // What contradicts right answers is only worth a word if nothing fits without.
        judge.strict = false;
        single = judge.fits(&submission.order);
        single.sort_by_key(|fit| fit.contradicted.len());
    }
    let (mut by_problem, mut places) = (Vec::new(), Vec::new());
    if single.is_empty() {
        by_problem = judge.by_problem(&submission.order);
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

/// How a prediction and a candidate's answer go together.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Match {
    Reproduced,
    /// The mistake makes the scene unstable: round-off has grown beyond comparison.
    Undecided,
    Differs,
}

/// Trials of mistakes on the answers of a candidate.
struct Trials<'a> {
    kit: &'a Kit,
    given: &'a [Given<'a>],
    epsilon: f64,
    /// A right answer that the mistake would have changed ends a trial.
    strict: bool,
}

impl<'a> Trials<'a> {
    /// The mistakes that reproduce all wrong answers.
    fn fits(&self, order: &DirectionOrder) -> Vec<Fit> {
        let fit = |entry: &Entry| {
            let contradicted = self.single(&Model::mistaken(entry.mistake, order))?;
            Some(Fit { mistake: entry.mistake, contradicted })
        };
        CATALOGUE.iter().filter_map(fit).collect()
    }

    /// The answers given to each problem.
    fn problems(&self) -> impl Iterator<Item = &'a [Given<'a>]> + use<'a> {
        self.given.chunk_by(|a, b| a.problem == b.problem)
    }

    /// `None` unless the mistake reproduces all wrong answers; else the right answers that it
    /// contradicts. Problems are tried from the cheapest, and the first answer that differs ends it.
    fn single(&self, model: &Model) -> Option<Vec<(&'static str, &'static str)>> {
        let (mut contradicted, mut reproduced) = (Vec::new(), 0);
        for answers in self.problems() {
            let prediction = self.predict(model, answers[0].problem);
            for given in answers {
                match (self.compare(&prediction, given), wrong(given.judged)) {
                    (Match::Reproduced, true) => reproduced += 1,
                    (Match::Reproduced, false) | (Match::Undecided, true) => {}
                    (Match::Differs, true) => return None,
                    (_, false) if self.strict => return None,
                    (_, false) => contradicted.push((given.judged.problem, given.judged.answer)),
                }
            }
        }
        (reproduced > 0).then_some(contradicted)
    }

    /// For each problem with wrong answers, the mistakes that reproduce all answers to it. Scenes of
    /// several steps are dear: once something is wrong before them, only its explanations are tried.
    fn by_problem(&self, order: &DirectionOrder) -> Vec<(&'static str, Vec<Mistake>)> {
        let mut explained: Vec<(&'static str, Vec<Mistake>)> = Vec::new();
        for answers in
            self.problems().filter(|answers| answers.iter().any(|given| wrong(given.judged)))
        {
            let problem = &self.kit.problems[answers[0].problem].problem;
            let dear = matches!(&problem.task, Task::Scene(scene) if scene.steps > 1);
            let tried = |entry: &&Entry| {
                !dear
                    || explained.is_empty()
                    || explained.iter().any(|(_, mistakes)| mistakes.contains(&entry.mistake))
            };
            let fits = |entry: &&Entry| {
                let model = Model::mistaken(entry.mistake, order);
                let prediction = self.predict(&model, answers[0].problem);
                answers.iter().all(|given| self.compare(&prediction, given) == Match::Reproduced)
            };
            let mistakes = CATALOGUE.iter().filter(tried).filter(fits).map(|entry| entry.mistake);
            let found = (problem.id, mistakes.collect());
            explained.push(found);
        }
        explained
    }

    fn predict(&self, model: &Model, problem: usize) -> Prediction {
        let problem = &self.kit.problems[problem].problem;
        let disturbed = match &problem.task {
            Task::Scene(scene) if scene.steps > LONG => {
                let mut scene = scene.clone();
                disturb(&mut scene.populations, self.epsilon);
                let task = Task::Scene(scene);
                Some(model.answer(&Problem { task, ..problem.clone() }).values)
            }
            _ => None,
        };
        Prediction { answers: model.answer(problem), disturbed }
    }

    fn compare(&self, prediction: &Prediction, given: &Given<'_>) -> Match {
        let name = given.judged.answer;
        let GaugedAnswers { values, gauges } = &prediction.answers;
        let (Some(values), Some(gauges)) = (values.get(name), gauges.get(name)) else {
            return Match::Differs;
        };
        let close = |gauges: &[f64]| {
            largest_ratio(&given.array.values, &values.values, gauges) <= LIMIT * self.epsilon
        };
        if close(&gauges.values) {
            return Match::Reproduced;
        }
        let Some(disturbed) = prediction.disturbed.as_ref().and_then(|answers| answers.get(name))
        else {
            return Match::Differs;
        };
        // What the mistake makes of a disturbance by one epsilon, it makes of round-off too.
        let grown = |i: usize| {
            let growth = (values.values[i] - disturbed.values[i]).abs() / self.epsilon;
            if growth.is_finite() { gauges.values[i] + GROWTH * growth } else { f64::INFINITY }
        };
        let grown: Vec<f64> = (0..values.values.len()).map(grown).collect();
        let finite = given.array.values.iter().chain(&values.values).all(|value| value.is_finite());
        if !finite || close(&grown) { Match::Undecided } else { Match::Differs }
    }
}

/// What a mistake makes of a problem.
struct Prediction {
    answers: GaugedAnswers,
    /// The same from a disturbed start, for long scenes.
    disturbed: Option<Answers>,
}

/// Scenes of more steps may let round-off grow out of hand, if a mistake makes them unstable.
const LONG: u64 = 20;

/// Round-off is made in every step, in other places than the disturbance at the start: it may grow to
/// this many times as much.
const GROWTH: f64 = 100.0;

/// Changes populations by one epsilon up or down, without a pattern.
fn disturb(populations: &mut [Populations], epsilon: f64) {
    for (number, f) in populations.iter_mut().flatten().enumerate() {
        let mixed = (number as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        *f *= if mixed >> 63 == 0 { 1.0 + epsilon } else { 1.0 - epsilon };
    }
}
