//! Pictures of records of grains: `loads` and `grain_means` over time.

use std::io;
use std::path::Path;

use psmrt_report::{Axis, Figure, Series};

use crate::scene::columns;

/// Up to so many grains get a curve each.
const EACH: usize = 4;

/// First of the three columns of velocity and of force in a table of loads.
const VELOCITY: usize = 7;
const FORCE: usize = 13;

/// What one quantity of all grains was at one time.
#[derive(Clone, Debug, Default)]
struct Spread {
    sum: [f64; 3],
    low: [f64; 3],
    high: [f64; 3],
    /// Of the first few grains.
    first: Vec<[f64; 3]>,
}

impl Spread {
    fn add(&mut self, number: usize, vector: [f64; 3]) {
        for axis in 0..3 {
            let value = vector[axis];
            self.sum[axis] += value;
            self.low[axis] = if number == 0 { value } else { self.low[axis].min(value) };
            self.high[axis] = if number == 0 { value } else { self.high[axis].max(value) };
        }
        if self.first.len() < EACH {
            self.first.push(vector);
        }
    }
}

/// A time, the number of grains, their velocities and their forces.
type Moment = (f64, usize, Spread, Spread);

/// The picture of a record of kind `loads`: velocity and force along the axis along which the most
/// happens, for each grain if there are few, else their mean and extremes. `None` if the record has
/// fewer than two times.
pub fn loads(title: &str, table: &Path) -> io::Result<Option<Figure>> {
    let moments = moments(table)?;
    let Some((_, count, ..)) = moments.last().filter(|_| moments.len() > 1) else {
        return Ok(None);
    };
    let most = |part: fn(&Moment) -> &Spread, axis: usize| {
        let reach = moments.iter().map(|m| part(m).low[axis].abs().max(part(m).high[axis].abs()));
        reach.fold(0.0, f64::max)
    };
    let largest = |part: fn(&Moment) -> &Spread| {
        (0..3).max_by(|&a, &b| most(part, a).total_cmp(&most(part, b))).unwrap_or(0)
    };
    let velocity: fn(&Moment) -> &Spread = |moment| &moment.2;
    let force: fn(&Moment) -> &Spread = |moment| &moment.3;
    let moves = (0..3).any(|axis| most(velocity, axis) > 0.0);
    let axis = largest(if moves { velocity } else { force });
    let name = ["x", "y", "z"][axis];
    let (scale, unit) = prefixed(most(force, axis), "N");
    let force_axis = Axis::linear(format!("force {name} ({unit})"));
    let time = Axis::linear("time (s)");
    let mut figure = if moves {
        let speeds = Axis::linear(format!("velocity {name} (mm/s)"));
        let figure = curves(Figure::new(title, time, speeds), &moments, velocity, axis, 1e3);
        figure.with_panel(force_axis)
    } else {
        Figure::new(title, time, force_axis)
    };
    figure = curves(figure, &moments, force, axis, scale);
    let note =
        if *count == 1 { "force of the fluid on the grain" } else { "force of the fluid on each" };
    Ok(Some(figure.note(format!("{count} grain{}; {note}", if *count == 1 { "" } else { "s" }))))
}

/// The factor and the unit with which values up to `most` in `unit` are easy to read.
fn prefixed(most: f64, unit: &str) -> (f64, String) {
    let prefixes = ["", "m", "µ", "n", "p", "f", "a"];
    let mut factor = 1.0;
    for prefix in prefixes {
        if most * factor >= 1.0 || most == 0.0 {
            return (factor, format!("{prefix}{unit}"));
        }
        factor *= 1e3;
    }
    (1.0, unit.to_owned())
}

/// Adds the curves of one quantity along `axis`.
fn curves(
    figure: Figure,
    moments: &[Moment],
    part: fn(&Moment) -> &Spread,
    axis: usize,
    scale: f64,
) -> Figure {
    let curve = |value: &dyn Fn(&Moment) -> f64| -> Vec<(f64, f64)> {
        moments.iter().map(|moment| (moment.0, scale * value(moment))).collect()
    };
    let count = moments.last().map_or(0, |moment| moment.1);
    if count > EACH {
        return figure
            .with(Series::line("mean", curve(&|m| part(m).sum[axis] / m.1 as f64)))
            .with(Series::dashed("smallest", curve(&|m| part(m).low[axis])))
            .with(Series::dashed("largest", curve(&|m| part(m).high[axis])));
    }
    (0..count).fold(figure, |figure, grain| {
        figure.with(Series::line(format!("grain {grain}"), curve(&|m| part(m).first[grain][axis])))
    })
}

/// Reads a table of loads row by row, keeping what the picture needs.
fn moments(table: &Path) -> io::Result<Vec<Moment>> {
    let mut reader = ::csv::Reader::from_path(table)?;
    let mut moments: Vec<Moment> = Vec::new();
    let mut last_step = String::new();
    for row in reader.records() {
        let row = row?;
        let number = |column: usize| -> io::Result<f64> {
            row.get(column).unwrap_or("").parse().map_err(io::Error::other)
        };
        let step = row.get(1).unwrap_or("");
        if moments.is_empty() || step != last_step {
            step.clone_into(&mut last_step);
            moments.push((number(0)?, 0, Spread::default(), Spread::default()));
        }
        let vector = |first: usize| -> io::Result<[f64; 3]> {
            Ok([number(first)?, number(first + 1)?, number(first + 2)?])
        };
        if let Some((_, count, velocity, force)) = moments.last_mut() {
            velocity.add(*count, vector(VELOCITY)?);
            force.add(*count, vector(FORCE)?);
            *count += 1;
        }
    }
    Ok(moments)
}

/// The picture of a record of kind `grain_means`, from its rows (time and step first): mean velocity,
/// kinetic energy and contacts. `None` if there are fewer than two.
pub fn means(title: &str, rows: &[Vec<f64>]) -> Option<Figure> {
    if rows.len() < 2 {
        return None;
    }
    let over_time = |name: &str, factor: f64| -> Vec<(f64, f64)> {
        let column = columns::GRAIN_MEAN_COLUMNS.iter().position(|column| column.name == name);
        let column = 2 + column.unwrap_or(0);
        rows.iter().map(|row| (row[0], factor * row[column])).collect()
    };
    let mut figure =
        Figure::new(title, Axis::linear("time (s)"), Axis::linear("mean velocity (mm/s)"));
    for axis in ["x", "y", "z"] {
        figure = figure.with(Series::line(axis, over_time(&format!("velocity_{axis}"), 1e3)));
    }
    let most = |points: &[(f64, f64)]| points.iter().map(|point| point.1).fold(0.0, f64::max);
    let (factor, unit) = prefixed(most(&over_time("kinetic_energy", 1.0)), "J");
    figure = figure
        .with_panel(Axis::linear(format!("energy ({unit})")))
        .with(Series::line("kinetic energy", over_time("kinetic_energy", factor)));
    let contacts = over_time("contacts", 1.0);
    let highest = most(&contacts);
    if highest > 0.0 {
        figure = figure
            .with_panel(Axis::linear("contacts").range(0.0, 1.1 * highest))
            .with(Series::line("contacts", contacts));
    }
    Some(figure)
}
