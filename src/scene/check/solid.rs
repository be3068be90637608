//! How grains act on the fluid.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::Solid;

use super::Trouble;
use super::numbers::{absent, needed};
use crate::scene::format_grains::{CoverageName, OperatorName, SolidSection, WeightingName};

/// The solid phase, if there are grains; `solids`: with whether one may move that is at rest at the start; `has_free`:
/// some of them are free.
pub(super) fn solid_phase(
    section: Option<&SolidSection>,
    (solids, can_move): (Vec<Solid>, bool),
    has_free: bool,
) -> Result<Option<SolidPhase>, Trouble> {
    if solids.is_empty() {
        let remedy = "add [[grains]], or remove [solid]";
        return match section {
            Some(_) => Err(Trouble::new("solid", "the scene has no grains", remedy)),
            None => Ok(None),
        };
    }
    let section = section.cloned().unwrap_or_default();
    let name = section.operator.unwrap_or_else(|| {
        let is_fixed = !can_move && !solids.iter().any(Solid::has_velocity);
        chosen(&section, is_fixed)
    });
    let operator = match name {
        OperatorName::BounceBack => SolidOperator::NonEquilibriumBounceBack,
        OperatorName::Superposition => SolidOperator::Superposition,
        OperatorName::GradedViscosity if has_free => {
            let problem = "free grains are unstable with it: what a grain takes of the fluid's momentum in a step is twice \
                           what it holds";
            let remedy = "take `operator = \"full_bounce_back\"` or `\"bounce_back\"`, or grains that are fixed or whose \
                          motion is prescribed";
            return Err(Trouble::new("solid.operator", problem, remedy));
        }
        OperatorName::FullBounceBack => SolidOperator::FullBounceBack,
        OperatorName::GradedViscosity => SolidOperator::GradedViscosity,
    };
    let weighting = weighting(&section, name)?;
    Ok(Some(SolidPhase { solids, weighting, operator, coverage: coverage(&section)? }))
}

/// The operator of a scene that names none: the more accurate one where all grains are fixed (golden/tradeoff/operators.csv);
/// the paper's where some move, since that one cannot move free grains, and the force on one that moves as prescribed swings
/// from step to step; and where a weight is given, which that one does not have.
fn chosen(section: &SolidSection, is_fixed: bool) -> OperatorName {
    if is_fixed && section.weighting.is_none() {
        OperatorName::GradedViscosity
    } else {
        OperatorName::BounceBack
    }
}

fn weighting(section: &SolidSection, operator: OperatorName) -> Result<Weighting, Trouble> {
    if operator == OperatorName::GradedViscosity {
        return match section.weighting {
            None => Ok(Weighting::Graded),
            Some(_) => {
                let problem = "the operator graded_viscosity has a weight of its own";
                Err(Trouble::new(
                    "solid.weighting",
                    problem,
                    "remove this key, or take another operator",
                ))
            }
        };
    }
    Ok(match section.weighting {
        None | Some(WeightingName::NobleTorczynski) => Weighting::NobleTorczynski,
        Some(WeightingName::SolidFraction) => Weighting::SolidFraction,
    })
}

fn coverage(section: &SolidSection) -> Result<CoverageRule, Trouble> {
    let without_samples = match section.coverage {
        CoverageName::Exact => Some(CoverageRule::Exact),
        CoverageName::Linear => Some(CoverageRule::Linear),
        CoverageName::Sampled => None,
    };
    if let Some(rule) = without_samples {
        absent("solid.samples", section.samples.as_ref(), "`coverage = \"sampled\"`")?;
        return Ok(rule);
    }
    let remedy = "add `samples = 5`";
    let n = needed("solid.samples", section.samples, "`coverage = \"sampled\"` needs it", remedy)?;
    match usize::try_from(n) {
        Ok(n @ 1..=100) => Ok(CoverageRule::Sampled { n }),
        _ => Err(Trouble::new("solid.samples", "it must lie between 1 and 100", remedy)),
    }
}
