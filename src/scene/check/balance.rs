//! `gravity.balance`: where a pressure gradient may carry the net weight of all grains.

use psmrt_reference::domain::{Domain, FACE_NAMES, Face};
use psmrt_reference::lattice::Vec3;

use super::Trouble;
use super::grains::GrainList;
use crate::scene::format::SceneFile;
use crate::scene::format_free::GravityForm;
use crate::scene::format_grains::MotionKind;

/// Errors where something else holds up fluid and grains, or pushes them. `gravity`: along each axis the largest that it
/// ever is.
pub(super) fn check(
    file: &SceneFile,
    gravity: &Vec3,
    list: &GrainList,
    domain: &Domain,
) -> Result<(), Trouble> {
    let trouble =
        |problem: &str, remedy: &str| Err(Trouble::new("gravity.balance", problem, remedy));
    let Some(section) = &file.gravity else { return Ok(()) };
    if section.form == GravityForm::BodyForce {
        return trouble(
            "with `form = \"body_force\"` the fluid carries its own weight, which nothing balances",
            "remove `form`: with reduced pressure hydrostatics is exact",
        );
    }
    if file.body_force.is_some() {
        return trouble(
            "[body_force] would push fluid and grains that nothing holds back, faster and faster",
            "remove [body_force], or `balance` and choose the body force yourself",
        );
    }
    for axis in 0..3 {
        for (side, face) in domain.faces().axis(axis).into_iter().enumerate() {
            let along = gravity[axis] != 0.0;
            if face != Face::Periodic && (along || face != Face::FreeSlip) {
                let problem = format!(
                    "the face at {} holds up what is in the domain, so that nothing is to be balanced",
                    FACE_NAMES[axis][side]
                );
                return trouble(
                    &problem,
                    "remove `balance`, or make faces periodic (across gravity `free_slip` too)",
                );
            }
        }
    }
    if let Some(grain) = list.grains.iter().find(|grain| grain.motion != MotionKind::Free) {
        let problem = format!(
            "the grain of `{}` is not free: it holds up the fluid, so that nothing is to be balanced",
            grain.key
        );
        return trouble(&problem, "remove `balance`, or make all grains `motion = \"free\"`");
    }
    Ok(())
}
