//! A plane of cells as a map: which values go where; the drawing itself is psmrt-report's.

use psmrt_reference::solids::Shape;
use psmrt_report::{Axis, Map};

use crate::engine::{CellState, Engine};
use crate::scene::format_run::Quantity;
use crate::scene::{Scene, Units};

/// Cells that grains cover by more than this are grey.
const MOSTLY_SOLID: f64 = 0.5;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The plane number `plane` along `normal`.
pub fn map(
    scene: &Scene,
    engine: &dyn Engine,
    normal: usize,
    plane: usize,
    quantity: Quantity,
) -> Map {
    let (domain, units) = (&scene.setup.domain, &scene.units);
    let cells = domain.cells();
    let [right, up] = [[1, 2], [0, 2], [0, 1]][normal];
    let mut numbers = Vec::with_capacity(cells[right] * cells[up]);
    for j in 0..cells[up] {
        for i in 0..cells[right] {
            let mut cell = [plane; 3];
            (cell[right], cell[up]) = (i, j);
            numbers.push(domain.index(cell));
        }
    }
    let (label, value) = words(quantity);
    let shown = |cell: &CellState| {
        (cell.solid_fraction <= MOSTLY_SOLID).then(|| value(units, quantity, cell))
    };
    let axis = |axis: usize| {
        let end = cells[axis] as f64 * units.si_dx * 1e3;
        Axis::linear(format!("{} (mm)", AXES[axis])).range(0.0, end)
    };
    let place_in_cells = plane as f64 + 0.5;
    let place = place_in_cells * units.si_dx * 1e3;
    Map {
        title: scene.title.clone(),
        x: axis(right),
        y: axis(up),
        value: Axis::linear(label),
        columns: cells[right],
        circles: outlines(scene, engine, normal, place_in_cells)
            .into_iter()
            .map(|circle| circle.map(|along| along * units.si_dx * 1e3))
            .collect(),
        values: engine.cells(&numbers).iter().map(shown).collect(),
        note: format!(
            "plane {} = {place:.4} mm, after {:.4e} s",
            AXES[normal],
            engine.steps() as f64 * units.si_dt
        ),
    }
}

/// Where the plane at `place` along `normal` cuts the grains: centre and radius of each circle, in
/// cells, with those of images across periodic faces.
fn outlines(scene: &Scene, engine: &dyn Engine, normal: usize, place: f64) -> Vec<[f64; 3]> {
    let domain = &scene.setup.domain;
    let [right, up] = [[1, 2], [0, 2], [0, 1]][normal];
    let mut circles = Vec::new();
    for solid in engine.solids() {
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

/// The label of the scale, and the value of a cell.
fn words(quantity: Quantity) -> (&'static str, Value) {
    let velocity: Value = |units, quantity, cell| {
        let si_velocity = cell.velocity * units.si_velocity() * 1e3;
        match quantity {
            Quantity::VelocityX => si_velocity.x,
            Quantity::VelocityY => si_velocity.y,
            Quantity::VelocityZ => si_velocity.z,
            Quantity::Speed | Quantity::Pressure => si_velocity.norm(),
        }
    };
    match quantity {
        Quantity::Speed => ("speed (mm/s)", velocity),
        Quantity::Pressure => {
            ("pressure (Pa)", |units, _, cell| units.si_gauge_pressure(cell.density))
        }
        Quantity::VelocityX => ("velocity x (mm/s)", velocity),
        Quantity::VelocityY => ("velocity y (mm/s)", velocity),
        Quantity::VelocityZ => ("velocity z (mm/s)", velocity),
    }
}
