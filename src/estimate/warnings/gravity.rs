//! Warnings of forces that do not reach fluid and free grains alike.

use psmrt_reference::coupling::Gravity;

use super::warning;
use crate::estimate::Warning;
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    let Some(part) = &scene.free else { return Vec::new() };
    if let Some(Gravity::OnFluidToo { .. }) = part.settings.gravity {
        let reason = "gravity as a body force: the fluid displaced is the sum of the weights B, so that \
                      the buoyancy is only 58, 80 and 92 % of V g at 4, 8 and 16 cells per diameter";
        return vec![warning(reason, "use `form = \"reduced\"`, with which hydrostatics is exact")];
    }
    if scene.setup.body_force.is_some() {
        let reason = "a body force on the fluid does not push the grains as the pressure gradient that \
                      it stands for would: they lack V grad p";
        return vec![warning(
            reason,
            "drive the flow by pressure faces, or add the force to [gravity]",
        )];
    }
    Vec::new()
}
