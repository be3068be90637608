//! What does not go together with free grains whose operator couples them implicitly.

use psmrt_reference::coupling::is_implicit;
use psmrt_reference::setup::Setup;

use super::Trouble;
use super::free::FreePart;
use crate::scene::EngineKind;
use crate::scene::format_run::EngineSection;

/// Errors at an engine that cannot say how grains hold the fluid before a collision, and at averaged loads: the velocity in
/// the collision is solved for with the load of that collision alone.
pub(super) fn check(
    setup: &Setup,
    free: Option<&FreePart>,
    engine: Option<&EngineSection>,
) -> Result<(), Trouble> {
    let Some(part) = free.filter(|_| is_implicit(setup)) else { return Ok(()) };
    if engine.is_some_and(|section| section.kind == EngineKind::Wgpu) {
        let problem = "engine wgpu cannot move free grains with `solid.operator = \"full_bounce_back\"`: their velocity \
                       must be solved for before the collision";
        let remedy = "take `kind = \"cpu\"`, or `solid.operator = \"bounce_back\"`";
        return Err(Trouble::new("engine.kind", problem, remedy));
    }
    if part.settings.average_loads {
        let problem = "it is for explicit coupling; `solid.operator = \"full_bounce_back\"` couples free grains \
                       implicitly";
        let remedy = "remove the key, or take `solid.operator = \"bounce_back\"`";
        return Err(Trouble::new("coupling.average_loads", problem, remedy));
    }
    Ok(())
}
