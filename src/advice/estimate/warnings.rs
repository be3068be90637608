//! What looks risky about a scene, one topic a file. `psmrt check` prints all of it, and `psmrt run` and
//! `psmrt resume` before they start.

pub(crate) mod accuracy;
mod contacts;
mod density;
mod ends;
mod faces;
mod graded;
mod gravity;
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
    faces::warnings,
    start::warnings,
    ends::warnings,
    gravity::warnings,
    density::warnings,
    contacts::warnings,
    prescribed::warnings,
    stability::warnings,
    lists::warnings,
    records::warnings,
];

/// All that looks risky.
pub fn warnings(scene: &Scene) -> Vec<Warning> {
    TOPICS.iter().flat_map(|topic| topic(scene)).collect()
}
