//! The runs with grains at relaxation times below those of the other models: the sweep, the study of arrays, and
//! the beds of the study of seepage.

use super::evidence::all_grain_points;
use super::row::Row;
use psmrt::advice::tradeoff::model::{LEAST_TAU, SolidMethod};
use psmrt::advice::tradeoff::runs::GrainPoint;
use psmrt::table::{Table, TableError};
use psmrt_reference::collision::Preset;

const SEEPAGE: &str = include_str!("../../../../golden/seepage/study.csv");
const FILE: &str = "golden/seepage/study.csv";
const ARRAYS: &str = include_str!("../../../../golden/sphere_arrays/literature.csv");

/// What the ordered beds of the study are called in the sweep, so that both count as one geometry.
const ORDERED: &str = "seepage 0.6";

/// The grid and relaxation time whose flow gives the drag of a random packing: the finest with beds of both
/// kinds.
const FINEST: [f64; 2] = [16.0, 0.51];

/// The points, with d'Humieres' rates and the usual collision of solid cells.
pub fn low_points(sweep: &[Row]) -> Result<Vec<GrainPoint>, TableError> {
    let mut points = all_grain_points(sweep)?;
    points.extend(beds()?);
    points.retain(|point| {
        point.tau < LEAST_TAU
            && point.collision == Preset::DHumieres
            && point.solid == SolidMethod::Usual
    });
    // Some configurations are in two tables, or were run by both engines.
    let mut own: Vec<GrainPoint> = Vec::new();
    for point in points {
        let same = |other: &GrainPoint| {
            other.geometry == point.geometry
                && (other.tau - point.tau).abs() < 1e-9
                && (other.cells - point.cells).abs() < 1e-3
        };
        if !own.iter().any(same) {
            own.push(point);
        }
    }
    Ok(own)
}

/// A bed of the study: packing, cells per diameter, relaxation time, solid fraction and permeability in d².
struct StudyBed {
    packing: String,
    cells: f64,
    tau: f64,
    fraction: f64,
    permeability: f64,
}

impl StudyBed {
    /// The point of a bed whose permeability should be `exact`.
    fn point(&self, exact: f64) -> GrainPoint {
        GrainPoint {
            solid: SolidMethod::Usual,
            geometry: if self.packing == "fcc" { ORDERED.to_owned() } else { self.packing.clone() },
            source: FILE.to_owned(),
            collision: Preset::DHumieres,
            cells: self.cells,
            tau: self.tau,
            // Force per volume n 3π μ d U K with n = c/(π d³/6):  k/d² = 1/(18 c K)
            drag: 1.0 / (18.0 * self.fraction * exact),
            error: self.permeability / exact - 1.0,
        }
    }

    fn is_finest(&self) -> bool {
        (self.cells - FINEST[0]).abs() < 0.5 && (self.tau - FINEST[1]).abs() < 1e-9
    }
}

/// The beds with Re up to 1. The drag of the ordered one is known; that of a random packing is taken from its
/// finest grid, less the error of the ordered bed there (below 1 %).
fn beds() -> Result<Vec<GrainPoint>, TableError> {
    let table = Table::parse(FILE, SEEPAGE)?;
    let table = table
        .with(&[("collision", Preset::DHumieres.word()), ("weighting", "noble_torczynski")])?;
    let mut beds = Vec::new();
    for i in 0..table.rows.len() {
        let row = Table { columns: table.columns.clone(), rows: vec![table.rows[i].clone()] };
        if row.number("Re_wanted")? > 1.0 {
            continue;
        }
        let word = |name: &str| Ok::<_, TableError>(row.values(name)?.pop().unwrap_or_default());
        let packing = word("packing")?;
        let packing =
            if packing == "fcc" { packing } else { format!("{packing}, seed {}", word("seed")?) };
        beds.push(StudyBed {
            packing,
            cells: row.number("cells_per_diameter")?,
            tau: row.number("tau")?,
            fraction: 1.0 - row.number("porosity")?,
            permeability: row.number("permeability_d2")?,
        });
    }
    let arrays = Table::parse("golden/sphere_arrays/literature.csv", ARRAYS)?;
    let arrays = arrays.with(&[("lattice", "FCC"), ("solid_fraction_c", "0.6")])?;
    let ordered = 1.0 / (18.0 * 0.6 * arrays.number("K_computed")?);
    let finest = beds.iter().find(|bed| bed.packing == "fcc" && bed.is_finest());
    let left = finest.map_or(0.0, |bed| bed.permeability / ordered - 1.0);
    Ok(beds
        .iter()
        .filter_map(|bed| {
            if bed.packing == "fcc" {
                return Some(bed.point(ordered));
            }
            let own =
                beds.iter().find(|other| other.packing == bed.packing && other.is_finest())?;
            Some(bed.point(own.permeability / (1.0 + left)))
        })
        .collect())
}
