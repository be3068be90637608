//! Warnings of grains too light for the fluid inside them.

use psmrt_reference::coupling::{InternalFluid, is_implicit};

use crate::advice::estimate::warning::{Warning, warning};
use crate::advice::plan::facts::lightest;
use crate::advice::stability::limits;
use crate::scene::Scene;

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    // What is known of light grains is known of explicit coupling.
    if is_implicit(&scene.setup) {
        return Vec::new();
    }
    let Some((ratio, inside)) = lightest(scene) else { return Vec::new() };
    let tau = scene.setup.collision.tau();
    let limit = limits::lightest(inside, tau);
    if limit.is_some_and(|limit| ratio >= limit) {
        return Vec::new();
    }
    let known = match limit {
        Some(limit) => format!("at tau = {tau:.4} the coupling is stable down to {limit} times"),
        None => format!("at tau = {tau:.4} nothing is known"),
    };
    let reason = format!(
        "a free grain has {ratio:.3} times the density of the fluid: {known} with internal_fluid = \"{}\" \
         (golden/stability/movers.csv); for lighter ones the inertia of the fluid inside makes it \
         unstable, and smaller time steps do not help",
        word(inside)
    );
    vec![warning(reason, remedy(ratio, tau))]
}

/// The other treatment of the internal mass, or another relaxation time, if either was stable.
fn remedy(ratio: f64, tau: f64) -> String {
    let both = [InternalFluid::Lagged, InternalFluid::Kept];
    let is_right = |inside, tau| limits::lightest(inside, tau).is_some_and(|limit| ratio >= limit);
    if let Some(inside) = both.into_iter().find(|&inside| is_right(inside, tau)) {
        return format!(
            "use `coupling.internal_fluid = \"{}\"`, with which it is stable",
            word(inside)
        );
    }
    let taus = limits::taus_of_movers();
    let found = both.into_iter().find_map(|inside| {
        let nearest = taus.iter().copied().filter(|&tau| is_right(inside, tau));
        let nearest = nearest.min_by(|a, b| (a - tau).abs().total_cmp(&(b - tau).abs()))?;
        Some((inside, nearest))
    });
    match found {
        Some((inside, tau)) => format!(
            "use `time.tau` = {tau} with `coupling.internal_fluid = \"{}\"`, with which it is stable",
            word(inside)
        ),
        None => {
            "use denser grains, or fix the grain: psmrt has no stable scheme for grains as light"
                .to_owned()
        }
    }
}

fn word(inside: InternalFluid) -> &'static str {
    match inside {
        InternalFluid::Lagged => "lagged",
        InternalFluid::Kept => "kept",
    }
}
