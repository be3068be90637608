//! The runs that error models rest on: the committed sweep, and the older study of arrays.

use super::parameters::{Flow, Parameters, Storage};
use super::row::Row;
use psmrt::advice::tradeoff::model::{LEAST_TAU, SolidMethod};
use psmrt::advice::tradeoff::runs::GrainPoint;
use psmrt::table::{Table, TableError};
use psmrt_reference::collision::Preset;
use psmrt_reference::coverage::CoverageRule;

/// The committed rows.
const SWEEP: &str = include_str!("../../../../golden/tradeoff/sweep.csv");
const STUDY: &str = include_str!("../../../../golden/sphere_arrays/study.csv");

/// The grids that count: coarser ones have more than one error, and finer ones cost too much to be many.
pub(super) const LEAST_CELLS: f64 = 3.9;

/// The drag of random beds is known to 1 % only (`golden/tradeoff/random_drag.csv`): their smaller errors say
/// little.
const LEAST_OF_RANDOM: f64 = 0.05;

/// Reynolds number above which inertia shows in the truth itself.
const MOST_REYNOLDS: f64 = 0.06;

/// How the solid cells of some parameters collide; `None` for weight and operator turned at once, of which there are no runs.
pub fn solid_method(parameters: &Parameters) -> Option<SolidMethod> {
    match (&*parameters.weight, &*parameters.operator) {
        ("NT", "bounce_back") => Some(SolidMethod::Usual),
        ("NT", "superposition") => Some(SolidMethod::Superposition),
        ("eps", "bounce_back") => Some(SolidMethod::SolidFraction),
        ("NT", "full_bounce_back") => Some(SolidMethod::FullBounceBack),
        ("graded", "graded_viscosity") => Some(SolidMethod::Graded),
        _ => None,
    }
}

/// A run between plates.
#[derive(Clone, Debug, PartialEq)]
pub struct WallPoint {
    /// Collision of the fluid.
    pub collision: Preset,
    /// Cells from plate to plate.
    pub cells: f64,
    /// Relaxation time.
    pub tau: f64,
    /// Largest velocity, cells per step.
    pub velocity: f64,
    /// Relative L2 error of the profile.
    pub error: f64,
}

/// The committed sweep.
pub fn committed_sweep() -> Result<Vec<Row>, TableError> {
    Row::of_table(&Table::parse("golden/tradeoff/sweep.csv", SWEEP)?)
}

/// Whether a row has exact solid fractions, double precision and slow flow.
pub(super) fn is_plain(row: &Row) -> bool {
    let parameters = &row.parameters;
    parameters.coverage == CoverageRule::Exact
        && parameters.storage == Storage::F64
        && parameters.reynolds() < MOST_REYNOLDS
}

/// The point of a row with grains, if it has an error; whether it is within the range of the models is
/// not asked.
pub fn grain_point(row: &Row) -> Option<GrainPoint> {
    let parameters = &row.parameters;
    let lattice = parameters.flow.lattice().map_or(parameters.flow.word(), |(name, _)| name);
    Some(GrainPoint {
        solid: solid_method(parameters)?,
        geometry: format!("{lattice} {}", parameters.geometry),
        source: "golden/tradeoff/sweep.csv".to_owned(),
        collision: parameters.collision,
        cells: parameters.cells_per_diameter()?,
        tau: parameters.tau,
        drag: row.drag,
        error: row.error?,
    })
}

/// The point of a row between plates, if it has an error.
pub fn wall_point(row: &Row) -> Option<WallPoint> {
    let Row { parameters, error, .. } = row;
    (parameters.flow == Flow::Poiseuille).then_some(WallPoint {
        collision: parameters.collision,
        cells: f64::from(parameters.cells),
        tau: parameters.tau,
        velocity: parameters.lattice_velocity,
        error: (*error)?,
    })
}

/// The points with grains that models are fitted to.
pub fn grain_points(sweep: &[Row]) -> Result<Vec<GrainPoint>, TableError> {
    let mut points = all_grain_points(sweep)?;
    points.retain(|point| point.tau >= LEAST_TAU);
    Ok(points)
}

/// The points with grains at all relaxation times.
pub(super) fn all_grain_points(sweep: &[Row]) -> Result<Vec<GrainPoint>, TableError> {
    let mut points: Vec<_> =
        sweep.iter().filter(|row| is_plain(row)).filter_map(grain_point).collect();
    points.retain(|point| {
        !point.geometry.starts_with("random") || point.error.abs() > LEAST_OF_RANDOM
    });
    for point in study()? {
        // Some configurations are in both.
        let same = |other: &GrainPoint| {
            other.solid == point.solid
                && other.geometry == point.geometry
                && other.collision == point.collision
                && other.tau == point.tau
                && (other.cells - point.cells).abs() < 1e-3
        };
        if !points.iter().any(same) {
            points.push(point);
        }
    }
    points.retain(|point| point.cells >= LEAST_CELLS);
    Ok(points)
}

/// The points between plates that models are fitted to.
pub fn wall_points(sweep: &[Row]) -> Vec<WallPoint> {
    sweep.iter().filter(|row| is_plain(row)).filter_map(wall_point).collect()
}

/// The plain rows of the study of arrays.
fn study() -> Result<Vec<GrainPoint>, TableError> {
    let table = Table::parse("golden/sphere_arrays/study.csv", STUDY)?;
    let plain = [("weight", "NT"), ("operator", "bounce_back"), ("shift", "quarter")];
    let table = table.with(&plain)?;
    let mut points = Vec::new();
    for i in 0..table.rows.len() {
        let row = Table { columns: table.columns.clone(), rows: vec![table.rows[i].clone()] };
        // A run that broke has no error.
        let Ok(drag_error) = row.number("relative_error") else { continue };
        let word = row.values("collision")?.pop().unwrap_or_default();
        let collision = Preset::from_word(&word)
            .ok_or_else(|| TableError(format!("collision {word:?} of study.csv")))?;
        let lattice = row.values("lattice")?.pop().unwrap_or_default();
        let fraction = row.values("solid_fraction")?.pop().unwrap_or_default();
        if row.number("Re")? > MOST_REYNOLDS {
            continue;
        }
        points.push(GrainPoint {
            solid: SolidMethod::Usual,
            geometry: format!("{lattice} {fraction}"),
            source: "golden/sphere_arrays/study.csv".to_owned(),
            collision,
            cells: row.number("cells_per_diameter")?,
            tau: row.number("tau")?,
            drag: row.number("K_exact")?,
            // K/K_exact = 1 + e, the velocity goes with 1/K.
            error: 1.0 / (1.0 + drag_error) - 1.0,
        });
    }
    Ok(points)
}
