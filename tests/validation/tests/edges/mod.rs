//! Runs on either side of the frontiers that `golden/stability` holds.

use psmrt::engine::EngineName;
use psmrt::stability::{FLOWS, Found, Lab, Line, Outcome};
use psmrt_reference::collision::Preset;
use psmrt_reference::partial_saturation::Weighting;

use crate::common::Budget;

/// A run close to a frontier, and whether it is to survive.
pub struct Near {
    pub flow: &'static str,
    pub model: Preset,
    pub weighting: Option<Weighting>,
    pub variant: &'static str,
    pub tau: f64,
    pub value: f64,
    pub lives: bool,
}

/// Runs on either side of frontiers: the values tried next to them (`golden/stability`), so that small
/// changes of the rounding do not matter, with the cells of their flow.
pub fn near_frontiers() -> Vec<(Near, u64)> {
    let mut all = Vec::new();
    let mut both = |flow, cells, model, weighting, variant, tau, [inside, outside]: [f64; 2]| {
        for (value, lives) in [(inside, true), (outside, false)] {
            all.push((Near { flow, model, weighting, variant, tau, value, lives }, cells));
        }
    };
    let nt = Some(Weighting::NobleTorczynski);
    both("shear_layer", 2304, Preset::Srt, None, "", 0.501, [0.1, 0.28]);
    both("shear_layer", 2304, Preset::DHumieres, None, "", 0.501, [0.28, 0.5]);
    both("abc", 4096, Preset::Srt, None, "", 0.500_001, [0.28, 0.5]);
    both("taylor_green", 4096, Preset::Srt, None, "", 0.51, [0.28, 0.5]);
    both("bed_force", 4096, Preset::Srt, nt, "", 0.501, [0.005, 0.02]);
    both("bed_force", 4096, Preset::DHumieres, nt, "", 0.501, [0.03, 0.07]);
    both("bed_force", 4096, Preset::Srt, nt, "", 0.6, [0.03, 0.07]);
    both("movers", 1728, Preset::DHumieres, nt, "lagged", 0.6, [0.8, 0.2]);
    // So light that it is thrown beyond all bounds before the guard looks.
    both("movers", 1728, Preset::DHumieres, nt, "lagged", 0.51, [1.0, 0.05]);
    all
}

/// Makes the run and holds it to what it should be; a run that is to break must be stopped by the guard,
/// at a step that is one of its looks.
pub fn assert_near(
    (near, cells): &(Near, u64),
    engine: EngineName,
    lab: &Lab,
    budget: &mut Budget,
) {
    let Near { flow, model, weighting, variant, tau, value, lives } = *near;
    let line = Line { engine, model, weighting, variant, tau };
    let flow = FLOWS.iter().find(|known| known.name == flow).unwrap();
    let found = (flow.run)(lab, &line, value).or_else(Found::of).unwrap();
    budget.spend(found.steps * cells);
    println!("{} {line:?} {value}: {found:?}", flow.name);
    if lives {
        assert!(
            found.outcome.lived(),
            "{} on this side of the frontier ({line:?} at {value}) ought to survive: {found:?}",
            flow.name,
        );
    } else {
        assert_eq!(
            found.outcome,
            Outcome::Stopped,
            "{} beyond the frontier ({line:?} at {value}) ought to be stopped",
            flow.name,
        );
        assert!(found.how.is_some());
    }
}

/// Eight grains whose centres share a cell live and close their balance; contacts as brief as a thirtieth of a
/// step are right with the sub-steps that they need, and refused with too few.
pub fn in_one_cell_and_too_hard(engine: EngineName, lab: &Lab, budget: &mut Budget) {
    let nt = Some(Weighting::NobleTorczynski);
    for (flow, cells, variant, tau, value, expected) in [
        ("crowd", 1728, "cluster", 0.501, 8.0, Outcome::Right),
        ("contact", 1200, "10", 0.6, 0.03, Outcome::Right),
        ("contact", 1200, "5", 0.6, 0.03, Outcome::Refused),
    ] {
        let line = Line { engine, model: Preset::DHumieres, weighting: nt, variant, tau };
        let flow = FLOWS.iter().find(|known| known.name == flow).unwrap();
        let found = (flow.run)(lab, &line, value).or_else(Found::of).unwrap();
        budget.spend(found.steps * cells);
        assert_eq!(
            found.outcome, expected,
            "{} near the frontier ({line:?} at {value}) ends otherwise than the map says: \
             {found:?}",
            flow.name,
        );
    }
}
