//! Warnings of an image: pores that no fluid gets to, and ends that do not fit to each other across a periodic face.

use crate::advice::estimate::warning::{Warning, warning};
use crate::scene::Scene;
use crate::scene::check::permeability::driven_axes;
use crate::seepage::spheres::has_image;
use crate::seepage::surface::filled;
use crate::voxels::pores::{pores, solid_cells};

/// A smaller share of closed pores is not worth a word: porosity is not known better.
const CLOSED: f64 = 0.01;

/// Ends of an image whose neighbouring planes differ so many times as much as others do do not fit to each other.
const UNLIKE: f64 = 2.0;

const AXES: [&str; 3] = ["x", "y", "z"];

pub(super) fn warnings(scene: &Scene) -> Vec<Warning> {
    if !has_image(&scene.setup) {
        return Vec::new();
    }
    let closed = driven_axes(&scene.setup).into_iter().filter_map(|axis| closed(scene, axis));
    let ends = (0..3).filter_map(|axis| ends(scene, axis));
    coarse(scene).into_iter().chain(closed).chain(ends).collect()
}

/// Cells that are solid in part, of all that have solid: more are those of grains below some six cells across.
const CUT: f64 = 0.8;

/// A grid that is too coarse for the image.
fn coarse(scene: &Scene) -> Option<Warning> {
    let filled = filled(&scene.setup);
    let with_solid = filled.iter().filter(|share| **share > 0.0).count();
    let cut = filled.iter().filter(|share| **share > 0.0 && **share < 1.0).count();
    let share = cut as f64 / with_solid as f64;
    if share <= CUT {
        return None;
    }
    let reason = format!(
        "{:.0} % of the cells with solid are solid in part only: the grid is coarser than what the image or the body shows, and neither flow \
         nor 6 V/S, with all that rests on it, can be trusted",
        100.0 * share
    );
    Some(warning(reason, "a finer grid (`domain.dx`)"))
}

/// Pores that hang on no path from end to end.
fn closed(scene: &Scene, axis: usize) -> Option<Warning> {
    let found = pores(&scene.setup.domain, &solid_cells(&scene.setup), axis);
    let share = 1.0 - found.through as f64 / found.all as f64;
    if share <= CLOSED {
        return None;
    }
    let reason = format!(
        "{:.1} % of the cells that are not solid throughout hang on no path along {}: no fluid flows there, and porosity \
         counts them",
        100.0 * share,
        AXES[axis]
    );
    let remedy = "an image with those pores filled, if the porosity that conducts is meant";
    Some(warning(reason, remedy))
}

/// How much the first and the last plane differ, over how much neighbouring planes do elsewhere.
fn ends(scene: &Scene, axis: usize) -> Option<Warning> {
    let domain = &scene.setup.domain;
    let count = domain.cells()[axis];
    if !domain.is_periodic(axis) || count < 3 {
        return None;
    }
    let filled = filled(&scene.setup);
    let step = [1, domain.cells()[0], domain.cells()[0] * domain.cells()[1]][axis];
    let mut between = vec![0.0; count];
    for (cell, &share) in filled.iter().enumerate() {
        let at = cell / step % count;
        let next = if at + 1 < count { cell + step } else { cell - at * step };
        between[at] += f64::from((filled[next] - share).abs());
    }
    // Planes within the same voxels are alike.
    let (across, inside) = between.split_last()?;
    let inside: Vec<f64> = inside.iter().copied().filter(|&differs| differs > 0.0).collect();
    let ratio = across * inside.len() as f64 / inside.iter().sum::<f64>();
    // An image that ends before the domain does leaves nothing there that could fit.
    if ratio.is_nan() || ratio <= UNLIKE {
        return None;
    }
    let name = AXES[axis];
    let reason = format!(
        "across the periodic face along {name} the solid fraction of neighbouring cells differs {ratio:.1} times as much as \
         elsewhere: the ends of the solids do not fit to each other, and throats close or open there that the sample does not have"
    );
    let remedy = format!(
        "for an image `image.mirror = [\"{name}\"]`, or walls, mirror planes or pressure faces along {name}; in a long sample it matters little"
    );
    Some(warning(reason, remedy))
}
