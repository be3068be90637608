//! The figures: convergence of arrays to exact values, and random beds beside laws.

use psmrt_report::{Axis, Figure, Series};

use super::beds::{NAMES, exact};
use super::of_grids;
use crate::cases::found::{drawn, found};
use crate::cases::{CaseError, Golden};
use psmrt::seepage::permeability::BESIDE;
use psmrt::table::Table;

pub(super) fn all(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    Ok(vec![arrays(golden, &drawn(rows))?, random(&golden.table("study.csv")?)?])
}

fn arrays(golden: &Golden, rows: &Table) -> Result<Figure, CaseError> {
    let literature = golden.table("../sphere_arrays/literature.csv")?;
    let mut figure = Figure::new(
        "Cubic arrays of solid fraction 0.343: permeability against resolution",
        Axis::linear("cells per diameter"),
        Axis::linear("k over the exact one"),
    );
    for engine in rows.values("engine")? {
        for (colour, packing) in ["SC", "BCC", "FCC"].into_iter().enumerate() {
            let own = rows.with(&[("engine", &engine), ("packing", packing), ("axis", "x")])?;
            let exact = exact(&literature, packing)?;
            let points = own.points("cells_per_diameter", "kx")?;
            let points = points.into_iter().map(|(d, k)| (d, k / exact)).collect();
            figure = figure.with(found(packing, &engine, points, Some(colour)));
        }
    }
    Ok(figure)
}

fn random(study: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Random beds: permeability against porosity",
        Axis::linear("porosity"),
        Axis::log("k/d2"),
    );
    for law in BESIDE {
        let curve = (0..=40).map(|i| {
            let porosity = 0.34 + 0.13 * f64::from(i) / 40.0;
            (porosity, law.permeability(porosity, 0.0))
        });
        figure = figure.with(Series::line(law.name, curve.collect()));
    }
    let mut points = Vec::new();
    for seed in study.values("seed")? {
        let bed = study.with(&[("seed", &seed)])?;
        let porosity = bed.numbers("porosity")?[0];
        for axis in NAMES {
            points.push((porosity, of_grids(&bed, axis)?.extrapolated));
        }
    }
    Ok(figure.with(Series::points("psmrt, three axes, extrapolated", points)))
}
