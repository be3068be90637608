//! Solids that are no spheres must not overlap each other or spheres.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::Domain;
use psmrt_reference::solids::{Shape, Solid};

use super::Trouble;
use super::grains::GrainList;
use super::neighbours::MAX_OVERLAP;
use crate::scene::format_grains::MotionKind;

/// Errors if images and bodies overlap each other or spheres, or if a sphere beside them moves.
pub(super) fn check(list: &GrainList, domain: &Domain) -> Result<(), Trouble> {
    let Some(first) = list.body_keys.first() else { return Ok(()) };
    if let Some(grain) = list.grains.iter().find(|grain| grain.motion != MotionKind::Fixed) {
        let problem = "a sphere moves, and nothing keeps it out of an image or a body";
        let remedy = "leave out `motion` of the spheres beside it, or the image or body";
        return Err(grain.trouble(problem.to_owned(), remedy));
    }
    let mut filled = vec![0.0; domain.cell_count()];
    for (key, body) in list.body_keys.iter().zip(&list.bodies) {
        let Shape::Cells { fractions, .. } = &body.shape else { continue };
        let both = |&(cell, share): &(usize, f64)| (filled[cell] + share - 1.0_f64).max(0.0);
        let common: f64 = fractions.iter().map(both).sum();
        if common > MAX_OVERLAP * body.volume() {
            return Err(overlap(key, "another image or body", common, body));
        }
        for &(cell, share) in fractions.iter() {
            filled[cell] += share;
        }
    }
    let spheres = list.solids();
    for (number, sphere) in spheres.iter().take(list.grains.len()).enumerate() {
        let covered = sphere.covered(domain, CoverageRule::Exact);
        let both: f64 =
            covered.iter().map(|at| (filled[at.cell] + at.epsilon - 1.0).max(0.0)).sum();
        if both > MAX_OVERLAP * sphere.volume() {
            return Err(overlap(first, &format!("grain {number} (from 0)"), both, sphere));
        }
    }
    Ok(())
}

/// What is said of two that overlap.
fn overlap(key: &str, other: &str, common: f64, of: &Solid) -> Trouble {
    let problem = format!(
        "it and {other} have {:.1} % of a volume in common; {:.0} % is the limit",
        100.0 * common / of.volume(),
        100.0 * MAX_OVERLAP
    );
    Trouble::new(key, problem, "move one of them (`corner`, `centre`), or crop the image")
}
