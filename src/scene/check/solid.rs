//! How grains act on the fluid.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::Solid;

use super::Trouble;
use super::numbers::{absent, needed};
use crate::scene::format_grains::{CoverageName, OperatorName, SolidSection, WeightingName};

/// The solid phase, if there are grains.
pub(super) fn solid_phase(
    section: Option<&SolidSection>,
    solids: Vec<Solid>,
) -> Result<Option<SolidPhase>, Trouble> {
    if solids.is_empty() {
        let remedy = "add [[grains]], or remove [solid]";
        return match section {
            Some(_) => Err(Trouble::new("solid", "the scene has no grains", remedy)),
            None => Ok(None),
        };
    }
    let section = section.cloned().unwrap_or_default();
    let weighting = match section.weighting {
        WeightingName::NobleTorczynski => Weighting::NobleTorczynski,
        WeightingName::SolidFraction => Weighting::SolidFraction,
    };
    let operator = match section.operator {
        OperatorName::BounceBack => SolidOperator::NonEquilibriumBounceBack,
        OperatorName::Superposition => SolidOperator::Superposition,
    };
    Ok(Some(SolidPhase { solids, weighting, operator, coverage: coverage(&section)? }))
}

fn coverage(section: &SolidSection) -> Result<CoverageRule, Trouble> {
    if section.coverage == CoverageName::Exact {
        absent("solid.samples", section.samples.as_ref(), "`coverage = \"sampled\"`")?;
        return Ok(CoverageRule::Exact);
    }
    let remedy = "add `samples = 5`";
    let n = needed("solid.samples", section.samples, "`coverage = \"sampled\"` needs it", remedy)?;
    match usize::try_from(n) {
        Ok(n @ 1..=100) => Ok(CoverageRule::Sampled { n }),
        _ => Err(Trouble::new("solid.samples", "it must lie between 1 and 100", remedy)),
    }
}
