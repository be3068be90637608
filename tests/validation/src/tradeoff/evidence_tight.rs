//! The runs with grains and an operator that lets no fluid through: graded viscosity, full bounce-back.

use super::evidence::{LEAST_CELLS, grain_point, is_plain};
use super::row::Row;
use psmrt::advice::tradeoff::model::SolidMethod;
use psmrt::advice::tradeoff::runs::GrainPoint;
use psmrt::table::{Table, TableError};

const OPERATORS: &str = include_str!("../../../../golden/tradeoff/operators.csv");
const FILE: &str = "golden/tradeoff/operators.csv";

/// The points. Random beds are among them whatever their error, since to drop the small ones would tilt the fit: what is not
/// known of their drag, 1 %, is within the least error that the models tell.
pub fn tight_points() -> Result<Vec<GrainPoint>, TableError> {
    let rows = Row::of_table(&Table::parse(FILE, OPERATORS)?)?;
    let mut points: Vec<GrainPoint> =
        rows.iter().filter(|row| is_plain(row)).filter_map(grain_point).collect();
    points.retain(|point| {
        matches!(point.solid, SolidMethod::Graded | SolidMethod::FullBounceBack)
            && point.cells >= LEAST_CELLS
    });
    for point in &mut points {
        FILE.clone_into(&mut point.source);
    }
    Ok(points)
}
