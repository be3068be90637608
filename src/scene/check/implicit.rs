//! What does not go together with free grains whose operator couples them implicitly.

use psmrt_reference::coupling::is_implicit;
use psmrt_reference::setup::Setup;

use super::Trouble;
use super::free::FreePart;

/// Errors at averaged loads: the velocity in the collision is solved for with the load of that collision alone.
pub(super) fn check(setup: &Setup, free: Option<&FreePart>) -> Result<(), Trouble> {
    let Some(part) = free.filter(|_| is_implicit(setup)) else { return Ok(()) };
    if part.settings.average_loads {
        let problem = "it is for explicit coupling; `solid.operator = \"full_bounce_back\"` couples free grains \
                       implicitly";
        let remedy = "remove the key, or take `solid.operator = \"bounce_back\"`";
        return Err(Trouble::new("coupling.average_loads", problem, remedy));
    }
    Ok(())
}
