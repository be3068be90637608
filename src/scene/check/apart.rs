//! Solids that are no spheres must not overlap each other or spheres.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::Domain;

use super::Trouble;
use super::grains::GrainList;
use crate::bodies::filled::{Common, Filled, MAY_SHARE};
use crate::scene::format_grains::MotionKind;

/// Errors if images and bodies overlap each other or spheres, or if a sphere beside them moves.
pub(super) fn check(list: &GrainList, domain: &Domain) -> Result<(), Trouble> {
    if list.bodies.is_empty() {
        return Ok(());
    }
    if let Some(grain) = list.grains.iter().find(|grain| grain.motion != MotionKind::Fixed) {
        let problem = "a sphere moves or spins, and nothing keeps it out of an image or a body";
        let remedy = "leave out `motion` of the spheres beside it, or the image or body";
        return Err(grain.trouble(problem.to_owned(), remedy));
    }
    let mut filled = Filled::none(domain.cell_count());
    let solids = list.solids();
    let spheres = list.grains.len();
    for (number, solid) in solids.iter().enumerate() {
        let covered = solid.covered(domain, CoverageRule::Exact);
        let cells: Vec<_> = covered.iter().map(|at| (at.cell, at.epsilon)).collect();
        // Spheres among each other: `neighbours.rs`.
        let key = number.checked_sub(spheres).map(|body| &list.body_keys[body]);
        if let (Some(key), Some(Common { other, share })) = (key, filled.common(&cells)) {
            let other = match other.checked_sub(spheres) {
                Some(body) => format!("`{}`", list.body_keys[body]),
                None => list.grains[other].name(other),
            };
            let problem = format!(
                "it and {other} have {:.1} % of the volume of the smaller one in common; {:.0} % is the limit",
                100.0 * share,
                100.0 * MAY_SHARE
            );
            let remedy = "move one of them (`corner`, `centre`), or crop the image";
            return Err(Trouble::new(key, problem, remedy));
        }
        // It stays.
        let _ = filled.add(number, &cells);
    }
    Ok(())
}
