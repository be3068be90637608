//! A second, small implementation of everything that the kit asks, with a switch for each mistake of
//! the catalogue. It shares vocabulary with the oracle and nothing else, except `M` and the exact
//! coverage of a sphere, which `tests/oracle/moments.rs` and `tests/oracle/coverage.rs` hold to other sources.
//!
//! It serves twice: without a mistake, its numbers carry the gauges of the kit (and agree with the
//! oracle, which a test holds); with one, it says what a candidate that makes it would answer.

mod cell;
mod constants;
mod contact;
mod faces;
mod graded;
mod scene;

use psmrt_reference::directions::{C, Q, number_of};

use super::array::{Answers, Array};
use super::gauged::Gauged;
use super::mistakes::Mistake;
use super::order::DirectionOrder;
use super::problem::Problem;
use super::task::Task;

/// Populations or moments of a cell.
type Cell = [Gauged; Q];

/// Answers and their gauges, in the kit's order of directions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GaugedAnswers {
    /// The answers.
    pub values: Answers,
    /// The gauge of each value.
    pub gauges: Answers,
}

impl GaugedAnswers {
    /// These and one more.
    fn with(mut self, name: &str, shape: &[usize], numbers: &[Gauged]) -> Self {
        let array = |of: fn(&Gauged) -> f64| Array::new(shape, numbers.iter().map(of).collect());
        self.values = self.values.with(name, array(|number| number.value));
        self.gauges = self.gauges.with(name, array(|number| number.gauge));
        self
    }
}

/// The implementation, with at most one mistake.
#[derive(Clone, Debug)]
pub struct Model {
    mistake: Option<Mistake>,
    weights: [f64; Q],
    opposite: [usize; Q],
    /// `M`, rows are moments.
    matrix: [[f64; Q]; Q],
    columns: [[f64; Q]; Q],
    inverse_columns: [[f64; Q]; Q],
}

impl Model {
    /// The implementation as it should be.
    pub fn right() -> Self {
        Self::new(None, &DirectionOrder::default())
    }

    /// The implementation with a mistake, as one would make it who numbers the directions in `order`.
    pub fn mistaken(mistake: Mistake, order: &DirectionOrder) -> Self {
        Self::new(Some(mistake), order)
    }

    fn new(mistake: Option<Mistake>, order: &DirectionOrder) -> Self {
        let matrix = constants::moment_matrix(mistake);
        Model {
            mistake,
            weights: constants::weights(mistake),
            opposite: std::array::from_fn(|a| opposite(a, mistake, order)),
            columns: constants::columns(&matrix),
            inverse_columns: constants::inverse_columns(&matrix),
            matrix,
        }
    }

    fn has(&self, mistake: Mistake) -> bool {
        self.mistake == Some(mistake)
    }

    /// What this implementation answers.
    pub fn answer(&self, problem: &Problem) -> GaugedAnswers {
        match &problem.task {
            Task::Constants(task) => self.constants(task),
            Task::Moments(task) => self.states(task),
            Task::Collisions(task) => self.collisions(task),
            Task::SolidFractions(task) => self.solid_fractions(task),
            Task::Weights(task) => self.weights_of(task),
            Task::SharedWeights(task) => self.shared_weights(task),
            Task::Streaming(task) => self.streaming(task),
            Task::Scene(task) => self.scene(task),
            Task::Contacts(task) => self.contacts(task),
            Task::Formulas(task) => self.formulas(task),
        }
    }
}

/// Number of the direction that is taken for the opposite of `a`.
fn opposite(a: usize, mistake: Option<Mistake>, order: &DirectionOrder) -> usize {
    match mistake {
        Some(Mistake::OppositesInPairs) => {
            // Its neighbour among the eighteen that move: 1-2, 3-4, ...
            let moving: Vec<usize> =
                (0..Q).map(|own| order.in_kit(own)).filter(|&a| a != 0).collect();
            moving.iter().position(|&own| own == a).map_or(0, |own| moving[own ^ 1])
        }
        Some(Mistake::OppositesMirrored) => {
            let mut c = C[a];
            if let Some(component) = c.iter_mut().rev().find(|component| **component != 0) {
                *component = -*component;
            }
            number_of(c)
        }
        _ => number_of(C[a].map(|component| -component)),
    }
}
