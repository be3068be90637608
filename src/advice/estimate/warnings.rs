//! What looks risky about a scene, one topic a file. `psmrt check` prints all of it, and `psmrt run` and
//! `psmrt resume` before they start.

pub(crate) mod accuracy;
mod closed;
mod contacts;
mod density;
mod ends;
mod faces;
mod graded;
mod gravity;
mod images;
mod in_time;
mod lists;
mod prescribed;
mod records;
mod scales;
pub(crate) mod stability;
mod start;

use super::warning::Warning;
use crate::scene::Scene;

/// The topics, in the order in which they are told.
const TOPICS: &[fn(&Scene) -> Vec<Warning>] = &[
    scales::warnings,
    accuracy::warnings,
    graded::warnings,
    images::warnings,
    faces::warnings,
    ends::warnings,
    gravity::warnings,
    closed::warnings,
    density::warnings,
    contacts::warnings,
    prescribed::warnings,
    stability::warnings,
    lists::warnings,
    records::warnings,
    in_time::warnings,
];

/// Those of a scene without fluid.
const OF_GRAINS: &[fn(&Scene) -> Vec<Warning>] =
    &[contacts::warnings, prescribed::warnings, lists::warnings, records::warnings];

/// All that looks risky, with values that change in time at their largest; but for how the scene starts.
pub fn warnings(scene: &Scene) -> Vec<Warning> {
    let strongest = scene.at_its_strongest();
    if scene.is_dry {
        return OF_GRAINS.iter().flat_map(|topic| topic(&strongest)).collect();
    }
    let all = TOPICS.iter().flat_map(|topic| topic(&strongest));
    let at_start = start::warnings(scene).into_iter().chain(closed::swings(scene));
    at_start.chain(all).collect()
}
