//! Warning of grains too small for the operator of graded viscosity, where nothing is predicted: `accuracy.rs` warns where
//! something is.

use super::accuracy::{Outlook, outlook};
use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;
use crate::seepage::spheres::spheres;
use psmrt_reference::partial_saturation::SolidOperator;

/// Cells per diameter from which on the operator is within 7 % at relaxation times up to 1, with d'Humières' rates and
/// exact coverage (golden/tradeoff/operators.csv; the report's case tradeoff judges it).
const ENOUGH_CELLS: f64 = 8.0;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let operator = scene.setup.solid_phase.as_ref().map(|phase| phase.operator);
    if operator != Some(SolidOperator::GradedViscosity) {
        return Vec::new();
    }
    let is_predicted = |outlook: Outlook| match outlook.found {
        Ok(_) => true,
        Err(outside) => outside.nearest.is_some(),
    };
    if outlook(scene).is_some_and(is_predicted) {
        return Vec::new();
    }
    let diameters = spheres(scene).into_iter().map(|(_, radius, _)| 2.0 * radius);
    let smallest = diameters.fold(f64::INFINITY, f64::min);
    if smallest >= ENOUGH_CELLS {
        return Vec::new();
    }
    let reason = format!(
        "the smallest grain is {smallest:.1} cells across: graded viscosity rests on cells that a grain fills, of which \
         there are few below {ENOUGH_CELLS} cells; at 5 to 8 cells the drag of dense beds came out up to 20 % too small"
    );
    let remedy = format!(
        "a grid with {ENOUGH_CELLS} cells across the smallest grain (`domain.dx`), or `solid.operator = \
         \"full_bounce_back\"`"
    );
    vec![warning(reason, remedy)]
}
