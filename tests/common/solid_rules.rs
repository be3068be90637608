//! Which weight goes with which solid operator.

use psmrt_reference::partial_saturation::{SolidOperator, Weighting};

/// The operators that are a sum of a fluid and a solid part.
pub const SUMS: [SolidOperator; 3] = [
    SolidOperator::NonEquilibriumBounceBack,
    SolidOperator::Superposition,
    SolidOperator::FullBounceBack,
];

/// The weights that go with these.
pub const WEIGHTINGS: [Weighting; 2] = [Weighting::SolidFraction, Weighting::NobleTorczynski];

/// The operator that has a weight of its own.
pub const GRADED: (SolidOperator, Weighting) = (SolidOperator::GradedViscosity, Weighting::Graded);

/// All operators, each with each of its weights.
pub fn solid_rules() -> Vec<(SolidOperator, Weighting)> {
    let sums = SUMS.into_iter().flat_map(|operator| WEIGHTINGS.map(|weight| (operator, weight)));
    sums.chain([GRADED]).collect()
}

/// Each operator once, with the weight that it has if nothing is said.
pub fn operators() -> Vec<(SolidOperator, Weighting)> {
    SUMS.into_iter().map(|operator| (operator, Weighting::default())).chain([GRADED]).collect()
}
