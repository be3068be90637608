//! What an engine implements to be judged.

use super::array::Answers;
use super::order::DirectionOrder;
use super::precision::Precision;
use super::problem::Problem;
use super::task::{
    Collisions, Constants, Contacts, Formulas, Scene, SceneOutcome, SharedCells, SolidCells,
    Spheres, States, Streaming, Task,
};

/// An engine that can be judged. Every kind of problem is a method; what is left as it is answers
/// `None`: not attempted, which is no failure.
///
/// Problems give populations in the kit's order of directions
/// ([`psmrt_reference::directions`]); answers are in the candidate's, [`Candidate::order`]. Names and
/// shapes of the answers are in [`super::spec`] and, for people, in the kit's README. A wrong name or
/// shape is a verdict with its reason, not a panic.
///
/// ```
/// use psmrt::conformance::{Answers, Array, Candidate, Precision, judge};
/// use psmrt::conformance::task::SolidCells;
///
/// /// An engine in single precision that knows nothing yet but the weight of a solid.
/// struct MyEngine;
///
/// impl Candidate for MyEngine {
///     fn name(&self) -> String {
///         "my engine".to_owned()
///     }
///     fn precision(&self) -> Precision {
///         Precision::F32
///     }
///     fn weights(&mut self, problem: &SolidCells) -> Option<Answers> {
///         let weight = |&(epsilon, tau): &(f64, f64)| {
///             let (epsilon, tau) = (epsilon as f32, tau as f32);
///             f64::from(epsilon * (tau - 0.5) / ((1.0 - epsilon) + (tau - 0.5)))
///         };
///         let weights = problem.cells.iter().map(weight).collect();
///         Some(Answers::new().with("weight", Array::list(weights)))
///     }
/// }
///
/// let verdict = judge(&mut MyEngine).expect("the kit can be made");
/// assert!(verdict.passed(), "{verdict}"); // the reason for a test is in the text
/// assert_eq!(verdict.attempted(), 1);
/// ```
pub trait Candidate {
    /// A name for reports.
    fn name(&self) -> String;

    /// The precision in which it works.
    fn precision(&self) -> Precision {
        Precision::F64
    }

    /// The order of directions in which it answers.
    fn order(&self) -> DirectionOrder {
        DirectionOrder::default()
    }

    /// Stage 0: `weights`, `opposites`, `moment_matrix`, `s_hat`, `relaxation_time`, `directions`.
    fn constants(&mut self, _problem: &Constants) -> Option<Answers> {
        None
    }

    /// Stage 1: `density`, `momentum`, `moments`, `equilibrium`, `equilibrium_moments`.
    fn moments(&mut self, _problem: &States) -> Option<Answers> {
        None
    }

    /// Stage 2: `post`, and `force` where there is a solid.
    fn collisions(&mut self, _problem: &Collisions) -> Option<Answers> {
        None
    }

    /// Stage 3: `solid_fraction`.
    fn solid_fractions(&mut self, _problem: &Spheres) -> Option<Answers> {
        None
    }

    /// Stage 3: `weight`.
    fn weights(&mut self, _problem: &SolidCells) -> Option<Answers> {
        None
    }

    /// Stage 3: `weight` of each of two solids.
    fn shared_weights(&mut self, _problem: &SharedCells) -> Option<Answers> {
        None
    }

    /// Stage 4: `populations`.
    fn streaming(&mut self, _problem: &Streaming) -> Option<Answers> {
        None
    }

    /// Stages 5, 7 and 8: the end of a run. `None` also for a scene that the engine cannot run.
    fn scene(&mut self, _problem: &Scene) -> Option<SceneOutcome> {
        None
    }

    /// Stage 6: `force` on the first body, `torque` on both.
    fn contacts(&mut self, _problem: &Contacts) -> Option<Answers> {
        None
    }

    /// Stage 8: `drag_coefficient`, `settling_reynolds`, `bed_length`.
    fn formulas(&mut self, _problem: &Formulas) -> Option<Answers> {
        None
    }
}

/// What `candidate` answers to `problem`.
pub fn answers(candidate: &mut dyn Candidate, problem: &Problem) -> Option<Answers> {
    match &problem.task {
        Task::Constants(task) => candidate.constants(task),
        Task::Moments(task) => candidate.moments(task),
        Task::Collisions(task) => candidate.collisions(task),
        Task::SolidFractions(task) => candidate.solid_fractions(task),
        Task::Weights(task) => candidate.weights(task),
        Task::SharedWeights(task) => candidate.shared_weights(task),
        Task::Streaming(task) => candidate.streaming(task),
        Task::Scene(task) => candidate.scene(task).map(|outcome| task.answers(&outcome)),
        Task::Contacts(task) => candidate.contacts(task),
        Task::Formulas(task) => candidate.formulas(task),
    }
}
