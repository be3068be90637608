//! Numbers of fixed grains: drag, resistance of beds; and the flow in a duct.

use std::path::Path;

use super::{COLLISION, Number, Quantity, of_operator, table};
use crate::cases::images::IMAGES;
use crate::cases::{BED_LAWS, CaseError, drag_by_grid, in_open_water};
use psmrt::table::Table;

pub(super) fn numbers(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let mut all = ducts(golden)?;
    all.extend(arrays(golden)?);
    all.extend(spheres(golden)?);
    all.extend(beds_at_reynolds(golden)?);
    all.extend(creeping_beds(golden)?);
    all.extend(images(golden)?);
    Ok(all)
}

/// The mean velocity in a square duct.
fn ducts(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let exact = table(golden, "duct/literature.csv")?
        .with(&[("aspect_short_over_long", "1")])?
        .number("umean_mu_over_G_shortside2")?;
    let rows = table(golden, "duct/expected.csv")?;
    let grids = rows.with(&[("rates", COLLISION)])?.points("cells_across", "error_of_mean")?;
    let number = Number {
        kind: Quantity::Duct,
        of: "square duct".to_owned(),
        case: "duct",
        source: "series",
        reference: exact,
        uncertainty: 0.0,
        grids: Vec::new(),
        on_front: Some("Mean velocity in a square duct of width a, over G a²/ν"),
    };
    let grids = grids.into_iter().map(|(cells, error)| (cells, exact * (1.0 + error)));
    Ok(vec![number.with_grids(grids.collect())])
}

/// Those of the arrays that the first table shows, and what it calls them.
const ARRAYS_ON_FRONT: [(&str, &str, &str); 2] = [
    ("bcc", "0.3", "Drag of a body-centred cubic array, solid fraction 0.3, over Stokes'"),
    ("fcc", "0.45", "Drag of a face-centred cubic array, solid fraction 0.45, over Stokes'"),
];

/// The arrays that two numbers in the operator were fitted to: no evidence for it.
const FITTED: [(&str, &str); 2] = [("sc", "0.343"), ("fcc", "0.6")];

/// The drag of arrays with the operator that is the default for fixed grains.
fn arrays(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let rows = of_operator(golden, "graded_viscosity")?;
    let mut all = Vec::new();
    for lattice in ["sc", "bcc", "fcc"] {
        let of_lattice = rows.with(&[("case", lattice)])?;
        for fraction in of_lattice.values("geometry")? {
            if FITTED.contains(&(lattice, fraction.as_str())) {
                continue;
            }
            let own = of_lattice.with(&[("geometry", &fraction)])?;
            let reference = own.numbers("drag")?.first().copied().unwrap_or(f64::NAN);
            let on_front = ARRAYS_ON_FRONT
                .iter()
                .find(|(name, c, _)| *name == lattice && *c == fraction)
                .map(|&(_, _, words)| words);
            // The table has the error of the velocity under a given force.
            let errors = own.points("cells_per_diameter", "error")?.into_iter();
            let number = Number {
                kind: Quantity::Drag,
                of: format!("{lattice} array, solid fraction {fraction}"),
                case: "tradeoff",
                source: if lattice == "sc" {
                    "integral equation, which Zick & Homsy (1982) agree with"
                } else {
                    "integral equation, computed for this project"
                },
                reference,
                uncertainty: 0.0,
                grids: Vec::new(),
                on_front,
            };
            let grids = errors.map(|(cells, error)| (cells, reference / (1.0 + error)));
            all.push(number.with_grids(grids.collect()));
        }
    }
    Ok(all)
}

/// The drag of a sphere in a stream: at Re 0.1 in the paper's box, where it is known; then with the box's share taken off.
fn spheres(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let study = table(golden, "sphere_drag/study.csv")?;
    let reference = table(golden, "sphere_drag/duct.csv")?
        .with(&[("period_length_over_d", "10")])?
        .number("K_total_force_superficial_U")?;
    let creeping = Number {
        kind: Quantity::Drag,
        of: "sphere in the paper's box, Re 0.1".to_owned(),
        case: "sphere_drag",
        source: "integral equation; inertia adds less than its uncertainty",
        reference,
        uncertainty: 0.001,
        grids: Vec::new(),
        on_front: Some("Drag of a sphere in the paper's box, Re 0.1, over Stokes'"),
    };
    // C_D = 24 K/Re
    let grids = drag_by_grid(&study, "0.1")?.into_iter().map(|(n, drag)| (n, drag * 0.1 / 24.0));
    let mut all = vec![creeping.with_grids(grids.collect())];
    for reynolds in ["10", "100"] {
        let open = table(golden, "sphere_drag/literature.csv")?.with(&[("Re", reynolds)])?;
        let grids = drag_by_grid(&study, reynolds)?.into_iter();
        let grids = grids.map(|(n, drag)| Ok((n, in_open_water(&study, reynolds, drag)?)));
        let number = Number {
            kind: Quantity::Drag,
            of: format!("sphere in open water, Re {reynolds}"),
            case: "sphere_drag",
            source: "axisymmetric Navier-Stokes; the box's share taken off by its width, known to 0.3 %",
            reference: open.number("CD_computed")?,
            uncertainty: 0.003,
            grids: Vec::new(),
            on_front: (reynolds == "100")
                .then_some("Drag coefficient of a sphere in open water, Re 100"),
        };
        all.push(number.with_grids(grids.collect::<Result<_, CaseError>>()?));
    }
    Ok(all)
}

/// The share of what carrying finite differences on to an infinitely fine grid takes off their finest value that may be wrong: the
/// orders that they show, 1.2 to 1.3, are those of flow round edges, and may be up to 0.2 off.
const CARRIED_ON: f64 = 0.25;

/// The resistance of porous bodies that images show.
fn images(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let study = table(golden, "images/study.csv")?.with(&[("operator", "graded_viscosity")])?;
    let independent =
        table(golden, "images/independent.csv")?.with(&[("program", "finite_differences")])?;
    let each = IMAGES.into_iter().map(|image| {
        let own = independent.with(&[("image", image)])?;
        let [finest, k] =
            ["3", "inf"].map(|cells| own.with(&[("cells_per_voxel", cells)])?.number("k_voxels2"));
        let (finest, k) = (finest?, k?);
        let number = Number {
            kind: Quantity::Resistance,
            of: format!("image of {image}"),
            case: "images",
            source: "finite differences, computed for this project",
            reference: 1.0 / k,
            uncertainty: CARRIED_ON * (finest / k - 1.0),
            grids: Vec::new(),
            on_front: (image == "spheres")
                .then_some("Resistance of an image of overlapping spheres, voxel²/k"),
        };
        let grids = study.with(&[("image", image)])?.points("cells_per_voxel", "k_voxels2")?;
        Ok(number.with_grids(grids.into_iter().map(|(cells, k)| (cells, 1.0 / k)).collect()))
    });
    each.collect()
}

/// By how much beds of so few spheres scatter about a law (golden/permeability, golden/seepage).
const SCATTER_OF_BEDS: f64 = 0.15;

/// The resistance of a random bed at several Reynolds numbers.
fn beds_at_reynolds(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let rows = table(golden, "seepage/study.csv")?.with(&[
        ("collision", COLLISION),
        ("weighting", "noble_torczynski"),
        ("spheres", "31"),
        ("seed", "1"),
        ("tau", "0.51"),
        ("outcome", "steady"),
    ])?;
    let each = ["1", "10", "30", "100"].into_iter().map(|reynolds| {
        let own = rows.with(&[("Re_wanted", reynolds)])?;
        // Of the finest grid, wherever its row stands.
        let last = |name: &str| -> Result<f64, CaseError> {
            let points = own.points("cells_per_diameter", name)?.into_iter();
            let finest = points.max_by(|a, b| a.0.total_cmp(&b.0));
            Ok(finest.map_or(f64::NAN, |(_, value)| value))
        };
        let [beetstra, tang] =
            [3, 4].map(|law: usize| Ok::<f64, CaseError>((BED_LAWS[law].psi_re)(1.0 - last("porosity")?, last("Re")?)));
        let (beetstra, tang) = (beetstra?, tang?);
        let number = Number {
            kind: Quantity::Resistance,
            of: format!("resistance of a bed of 31 spheres, porosity 0.40, Re {reynolds}"),
            case: "seepage",
            source: "Beetstra et al. 2007; Tang et al. 2015 and the scatter of small beds make the uncertainty",
            reference: beetstra,
            // The two newest laws differ by more where inertia counts.
            uncertainty: (tang / beetstra - 1.0).abs().max(SCATTER_OF_BEDS),
            grids: Vec::new(),
            on_front: (reynolds == "10")
                .then_some("Resistance psi Re of a random bed of spheres, porosity 0.40, Re 10"),
        };
        Ok(number.with_grids(own.points("cells_per_diameter", "psi_Re")?))
    });
    each.collect()
}

/// The resistance of random beds to creeping flow: one over the mean permeability along three axes.
fn creeping_beds(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let study = table(golden, "permeability/study.csv")?.with(&[("packing", "random")])?;
    let each = study.values("seed")?.into_iter().map(|seed| {
        let bed = study.with(&[("seed", &seed)])?;
        let of_axis =
            |own: &Table, axis: &str| own.with(&[("axis", axis)])?.number(&format!("k{axis}"));
        let cells = bed.values("cells_per_diameter")?;
        let grids = cells.into_iter().map(|cells| {
            let own = bed.with(&[("cells_per_diameter", &cells)])?;
            let sum = of_axis(&own, "x")? + of_axis(&own, "y")? + of_axis(&own, "z")?;
            Ok((cells.parse().unwrap_or(f64::NAN), 3.0 / sum))
        });
        let first =
            |name: &str| bed.numbers(name).map(|all| all.first().copied().unwrap_or(f64::NAN));
        let number = Number {
            kind: Quantity::Resistance,
            of: format!("d²/k of a random bed, porosity {:.3}", first("porosity")?),
            case: "permeability",
            source: "Beetstra et al. 2007; beds of so few spheres scatter",
            reference: 1.0 / first("beetstra")?,
            uncertainty: SCATTER_OF_BEDS,
            grids: Vec::new(),
            on_front: None,
        };
        Ok(number.with_grids(grids.collect::<Result<_, CaseError>>()?))
    });
    each.collect()
}
