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
    closed.chain(ends).collect()
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
    let (mut inside, mut across) = (0.0, 0.0);
    for (cell, &share) in filled.iter().enumerate() {
        let at = cell / step % count;
        if at + 1 < count {
            inside += f64::from((filled[cell + step] - share).abs());
        } else {
            across += f64::from((filled[cell - at * step] - share).abs());
        }
    }
    let ratio = across * (count - 1) as f64 / inside;
    // An image that ends before the domain does leaves nothing there that could fit.
    if ratio.is_nan() || ratio <= UNLIKE {
        return None;
    }
    let name = AXES[axis];
    let reason = format!(
        "across the periodic face along {name} the solid fraction of neighbouring cells differs {ratio:.1} times as much as \
         elsewhere: the ends of the image do not fit to each other, and throats close or open there that the sample does not have"
    );
    let remedy = format!(
        "`image.mirror = [\"{name}\"]`, or walls, mirror planes or pressure faces along {name}; in a long sample it matters little"
    );
    Some(warning(reason, remedy))
}
