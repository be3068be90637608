//! Grains from the points of a VTK file: those that a record of kind `grains` has written, and those of DEM codes whose arrays
//! have plainer names, without units: SI units, as in LIGGGHTS.

use super::list_header::{COLUMNS, MOTION_COLUMNS};
use super::list_text::Fault;
use super::listed::Ball;
use super::vtk_file::{Points, points};
use crate::quote::quoted;

/// What an array of a file may be: our own name first, then those of others.
const DIAMETER: [&str; 2] = ["diameter (m)", "diameter"];
const RADIUS: [&str; 3] = ["radius (m)", "radius", "radii"];
const DENSITY: [&str; 2] = ["density (kg/m3)", "density"];
const VELOCITY: [&str; 2] = ["velocity (m/s)", "v"];
const SPIN: [&str; 2] = ["spin (rad/s)", "omega"];

/// The grains of a file, in the order of its points.
pub(super) fn balls(bytes: &[u8]) -> Result<Vec<Ball>, Fault> {
    let known =
        |name: &str| [&DIAMETER[..], &RADIUS, &DENSITY, &VELOCITY, &SPIN].concat().contains(&name);
    let file = points(bytes, known)?;
    if file.places.is_empty() {
        return Err(("it has no points".to_owned(), "give a file with a point a grain".to_owned()));
    }
    let values = |names: &[&str], components| values(&file, names, components);
    let (size, per_size) = match (values(&DIAMETER, 1)?, values(&RADIUS, 1)?) {
        (Some(diameters), Some(radii))
            if diameters.iter().zip(radii).any(|(d, r)| (d - 2.0 * r).abs() > 1e-3 * d.abs()) =>
        {
            let problem = "its points have a diameter and a radius that is not half of it";
            return Err((problem.to_owned(), "leave one of the two arrays out".to_owned()));
        }
        (Some(diameters), _) => (diameters, 1.0),
        (None, Some(radii)) => (radii, 2.0),
        (None, None) => {
            let problem = format!("its points have no array {}", quoted(DIAMETER[0]));
            let remedy =
                "add it, or \"radius (m)\" (ParaView: Calculator), and give its points in m";
            return Err((problem, remedy.to_owned()));
        }
    };
    let density = values(&DENSITY, 1)?;
    let (velocity, spin) = (values(&VELOCITY, 3)?, values(&SPIN, 3)?);
    let ball = |(number, &place): (usize, &[f64; 3])| {
        let at = |name: &str, value: f64, is_allowed: bool| match is_allowed && value.is_finite() {
            true => Ok(value),
            false => Err((
                format!("point {number} (from 0): {name} = {value} is not allowed"),
                "give finite numbers in SI units, and sizes and densities above 0".to_owned(),
            )),
        };
        let mut ball = Ball::of(place, 0.0);
        for axis in 0..3 {
            at(COLUMNS[axis], place[axis], true)?;
        }
        ball.si_diameter = at(COLUMNS[3], per_size * size[number], size[number] > 0.0)?;
        if let Some(values) = density {
            ball.si_density = Some(at(COLUMNS[4], values[number], values[number] > 0.0)?);
        }
        for axis in 0..3 {
            for (values, own, name) in [
                (velocity, &mut ball.si_velocity, MOTION_COLUMNS[axis]),
                (spin, &mut ball.si_spin, MOTION_COLUMNS[3 + axis]),
            ] {
                if let Some(values) = values {
                    own.get_or_insert_default()[axis] = at(name, values[3 * number + axis], true)?;
                }
            }
        }
        Ok(ball)
    };
    file.places.iter().enumerate().map(ball).collect()
}

/// The values of the array that bears the first of these names, if one does: so many for each point.
fn values<'a>(
    file: &'a Points,
    names: &[&str],
    components: usize,
) -> Result<Option<&'a [f64]>, Fault> {
    let called = |name: &&str| file.arrays.iter().find(|array| array.name == **name);
    let Some(array) = names.iter().find_map(called) else { return Ok(None) };
    if array.components == components && array.values.len() == components * file.places.len() {
        return Ok(Some(&array.values));
    }
    let problem = format!(
        "array {} has {} values of {} components for {} points",
        quoted(&array.name),
        array.values.len(),
        array.components,
        file.places.len()
    );
    Err((problem, format!("let it have {components} for each point")))
}
