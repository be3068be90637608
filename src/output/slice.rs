//! A plane of cells as a map: which values go where; the drawing itself is psmrt-report's.

use psmrt_reference::solids::Shape;
use psmrt_report::{Axis, Map};

use super::between;
use crate::engine::{CellState, Coupled};
use crate::scene::Scene;
use crate::scene::format_run::Quantity;
use crate::units::Units;

/// Cells that grains cover by more than this are grey.
const MOSTLY_SOLID: f64 = 0.5;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The plane at `at` (in cells) along `normal`; `si_range` says where its colours end, if not at its values.
pub fn map(
    scene: &Scene,
    engine: &Coupled,
    (normal, at): (usize, f64),
    quantity: Quantity,
    si_range: Option<[f64; 2]>,
) -> Map {
    let (domain, units) = (&scene.setup.domain, &scene.units);
    let cells = domain.cells();
    // Of the two axes of the plane the first one runs faster, as in the picture.
    let [right, up] = [[1, 2], [0, 2], [0, 1]][normal];
    let states = between::states(engine, domain, between::plane(normal, at));
    let (label, si_factor, value) = words(quantity);
    let shown = |cell: &CellState| {
        (cell.solid_fraction <= MOSTLY_SOLID).then(|| si_factor * value(units, quantity, cell))
    };
    let axis = |axis: usize| {
        let end = cells[axis] as f64 * units.si_dx * 1e3;
        Axis::linear(format!("{} (mm)", AXES[axis])).range(0.0, end)
    };
    let place = at * units.si_dx * 1e3;
    let colours = match si_range {
        None => Axis::linear(label),
        Some([low, high]) => {
            Axis::linear(format!("{label}, fixed range")).range(si_factor * low, si_factor * high)
        }
    };
    Map {
        title: scene.title.clone(),
        x: axis(right),
        y: axis(up),
        value: colours,
        columns: cells[right],
        circles: outlines(scene, engine, normal, at)
            .into_iter()
            .map(|circle| circle.map(|along| along * units.si_dx * 1e3))
            .collect(),
        values: states.iter().map(shown).collect(),
        note: format!(
            "plane {} = {place:.4} mm, after {:.4e} s",
            AXES[normal],
            engine.steps() as f64 * units.si_dt
        ),
    }
}

/// Where the plane at `place` along `normal` cuts the grains: centre and radius of each circle, in
/// cells, with those of images across periodic faces.
fn outlines(scene: &Scene, engine: &Coupled, normal: usize, place: f64) -> Vec<[f64; 3]> {
    let domain = &scene.setup.domain;
    let [right, up] = [[1, 2], [0, 2], [0, 1]][normal];
    let mut circles = Vec::new();
    for solid in engine.solids() {
        // What is given cell by cell is seen as cells.
        let Shape::Sphere { radius } = solid.shape else { continue };
        let images = |axis: usize, reach: f64| -> Vec<f64> {
            let (length, at) = (domain.cells()[axis] as f64, solid.centre[axis]);
            if !domain.is_periodic(axis) {
                return vec![at];
            }
            let at = at.rem_euclid(length);
            let near = [at - length, at, at + length];
            near.into_iter().filter(|x| (-reach..=length + reach).contains(x)).collect()
        };
        for across in images(normal, radius) {
            let square = radius * radius - (across - place).powi(2);
            if square <= 0.0 {
                continue;
            }
            let cut = square.sqrt();
            for x in images(right, cut) {
                circles.extend(images(up, cut).into_iter().map(|y| [x, y, cut]));
            }
        }
    }
    circles
}

type Value = fn(&Units, Quantity, &CellState) -> f64;

/// The label of the scale, its unit over that of SI, and the value of a cell in SI units.
fn words(quantity: Quantity) -> (&'static str, f64, Value) {
    let velocity: Value = |units, quantity, cell| {
        let si_velocity = cell.velocity * units.si_velocity();
        match quantity {
            Quantity::VelocityX => si_velocity.x,
            Quantity::VelocityY => si_velocity.y,
            Quantity::VelocityZ => si_velocity.z,
            Quantity::Speed | Quantity::Pressure => si_velocity.norm(),
        }
    };
    match quantity {
        Quantity::Speed => ("speed (mm/s)", 1e3, velocity),
        Quantity::Pressure => {
            ("pressure (Pa)", 1.0, |units, _, cell| units.si_gauge_pressure(cell.density))
        }
        Quantity::VelocityX => ("velocity x (mm/s)", 1e3, velocity),
        Quantity::VelocityY => ("velocity y (mm/s)", 1e3, velocity),
        Quantity::VelocityZ => ("velocity z (mm/s)", 1e3, velocity),
    }
}
