//! Solids of any shape: flow through images, three porous bodies against an independent program and finite differences; what solid
//! fractions are worth on a grid that is coarser than the image; and the drag of a body from an STL file.

mod cylinder;
mod study;

use psmrt_report::{Axis, Figure, Series};

use super::found::found;
use super::{Bench, Case, CaseError, Claim, Golden};
pub use cylinder::Cylinder;
use psmrt::table::{Table, TableError};
pub use study::{BallImage, PorousImage};

/// Images of solids.
pub const CASE: Case = Case {
    name: "images",
    title: "Solids of any shape: the permeability of images, the drag of an STL body",
    about: &[
        "Three images of 32 x 32 x 32 voxels, made with porespy 3.2: overlapping spheres, fibres, and blobs, whose narrow throats are \
         a voxel wide. Water is driven through each along x between two pressure faces. k = nu U L/(dp/rho), with the superficial \
         velocity U and L = 32 voxels, is compared with that of finite differences on a staggered grid (golden/images/stokes.py, for \
         this purpose), refined and carried on to an infinitely fine grid (which takes 6 to 9 % off their finest value, and 27 % of the \
         blobs': that reference is known to some 9 %); and with what another lattice Boltzmann code, poromics \
         0.0.8, finds on the same grids with bounce-back at the voxels.",
        "The steps of the voxels are taken for the body's true surface here: the question is whether the flow between them is right, \
         not whether they show the body well.",
        "A simple cubic array of spheres (solid fraction 0.343) as an image of 48 x 48 x 48 voxels, whose exact drag is known, tells \
         what is lost when an image is put on a coarser grid, as any large one has to be: with the share of each cell that is solid, \
         and with cells that are solid or not (an image taken with voxels as large as the cells). Both cost the same.",
        "A cylinder of 256 flat sides from an STL file stands across a stream, 20 diameters behind the inlet and 15 from sides where the water slips.",
    ],
    scenes: &["scene.toml", "array.toml", "cylinder.toml"],
    literature: &["independent.csv", "literature.csv", "cylinder_literature.csv"],
    rows: "expected.csv",
    studies: &["study.csv", "array.csv", "cylinder.csv"],
    units: "k in squares of a voxel; porosity of the image without its clear ends, without unit",
    full: "cargo run --release -p psmrt-validation --example image_study, and --example body_study",
    measure,
    judge,
    draw,
};

/// The images.
pub const IMAGES: [&str; 3] = ["spheres", "fibres", "blobs"];

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let mut table = Table::new(&["engine", "image", "cells_per_voxel", "k_voxels2"]);
    for image in IMAGES {
        let k =
            PorousImage { image, cells: 1, operator: "graded_viscosity", tau: 0.8 }.run(bench)?;
        table.add(vec![
            bench.engine_name().word().to_owned(),
            image.to_owned(),
            "1".to_owned(),
            format!("{k:.6}"),
        ]);
    }
    Ok(table)
}

/// What finite differences give on an infinitely fine grid.
fn reference(golden: &Golden, image: &str) -> Result<f64, CaseError> {
    let rows = golden.table("independent.csv")?.with(&[
        ("image", image),
        ("program", "finite_differences"),
        ("cells_per_voxel", "inf"),
    ])?;
    Ok(rows.number("k_voxels2")?)
}

/// Permeabilities of an image over cells per voxel, over what finite differences give on an infinitely fine grid.
fn over_reference(rows: &Table, reference: f64) -> Result<Vec<(f64, f64)>, TableError> {
    let points = rows.points("cells_per_voxel", "k_voxels2")?;
    Ok(points
        .into_iter()
        .filter(|(cells, _)| cells.is_finite())
        .map(|(cells, k)| (1.0 / cells, k / reference))
        .collect())
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    let study = golden.table("study.csv")?;
    for image in IMAGES {
        let reference = reference(golden, image)?;
        for engine in rows.values("engine")? {
            let own = rows.with(&[("engine", &engine), ("image", image)])?;
            claims.push(Claim {
                what: format!("{engine}, {image}: k at a cell for each voxel, over finite differences on an infinitely fine grid"),
                measured: own.number("k_voxels2")? / reference,
                allowed: 0.75..=1.25,
                why: "throats of one to four cells: a quarter, fixed before a value was compared; on finer grids in proportion to the cell",
            });
        }
        for cells in study
            .with(&[("image", image), ("operator", "graded_viscosity")])?
            .values("cells_per_voxel")?
        {
            let kind =
                [("image", image), ("operator", "graded_viscosity"), ("cells_per_voxel", &cells)];
            let allowed = 0.25 / cells.parse::<f64>().unwrap_or(f64::NAN);
            claims.push(Claim {
                what: format!("study: {image}, {cells} cells along each edge of a voxel, k over finite differences on an infinitely fine grid"),
                measured: study.with(&kind)?.number("k_voxels2")? / reference,
                allowed: 1.0 - allowed..=1.0 + allowed,
                why: "a quarter at one cell per voxel, and in proportion to the cell; fixed before a value was compared",
            });
        }
    }
    claims.extend(of_array(golden)?);
    claims.extend(cylinder::claims(golden)?);
    Ok(claims)
}

/// Claims of the array of spheres as an image.
fn of_array(golden: &Golden) -> Result<Vec<Claim>, CaseError> {
    let exact = golden.table("literature.csv")?.number("k_over_edge2")?;
    let array = golden.table("array.csv")?;
    let mut claims = Vec::new();
    let graded = array.with(&[("operator", "graded_viscosity"), ("cells", "16")])?;
    for (image, allowed, why) in [
        (
            "shares",
            0.95..=1.05,
            "5 % at 14 cells per diameter, as for spheres given as such; a first look at the value (+0.4 %) came before the bound",
        ),
        (
            "binary",
            0.8..=0.95,
            "that a stair of cells is rougher and so tighter than the sphere: 5 to 20 %; a first look (-14 %) came before the bound",
        ),
    ] {
        claims.push(Claim {
            what: format!("study: array of spheres as an image, 16 cells along each edge, {image}: k over the exact one"),
            measured: graded.with(&[("image", image)])?.number("k_over_edge2")? / exact,
            allowed,
            why,
        });
    }
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    Ok(vec![of_bodies(golden, rows)?, array(golden)?, cylinder::figure(golden)?])
}

/// Permeabilities of the three bodies on finer and finer grids.
fn of_bodies(golden: &Golden, rows: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "Permeability of three images, over finite differences on an infinitely fine grid",
        Axis::linear("cell size, edges of a voxel").range(0.0, 1.05),
        Axis::linear("k over the reference").range(0.8, 2.4),
    )
    .with(Series::dashed("infinitely fine", vec![(0.0, 1.0), (1.05, 1.0)]));
    let independent = golden.table("independent.csv")?;
    let study = golden.table("study.csv")?;
    for (number, image) in IMAGES.into_iter().enumerate() {
        let reference = reference(golden, image)?;
        let of_program = |program: &str| -> Result<_, CaseError> {
            let own = independent.with(&[("image", image), ("program", program)])?;
            Ok(over_reference(&own, reference)?)
        };
        let own = study.with(&[("image", image), ("operator", "graded_viscosity")])?;
        figure = figure
            .with(
                Series::line(format!("{image}, psmrt"), over_reference(&own, reference)?)
                    .with_colour(number),
            )
            .with(
                Series::dashed(
                    format!("{image}, finite differences"),
                    of_program("finite_differences")?,
                )
                .with_colour(number),
            )
            .with(
                Series::points(format!("{image}, poromics"), of_program("poromics_0.0.8")?)
                    .with_colour(number),
            );
        for engine in rows.values("engine")? {
            let own = rows.with(&[("engine", &engine), ("image", image)])?;
            figure =
                figure.with(found(image, &engine, over_reference(&own, reference)?, Some(number)));
        }
    }
    Ok(figure.note("psmrt: graded viscosity, tau = 0.8; poromics: bounce-back, nu = 1/6"))
}

/// Errors of the array of spheres, with the share of each cell and with cells that are solid or not.
fn array(golden: &Golden) -> Result<Figure, CaseError> {
    let exact = golden.table("literature.csv")?.number("k_over_edge2")?;
    let array = golden.table("array.csv")?;
    let mut figure = Figure::new(
        "An array of spheres as an image on coarser grids: solid shares of cells, and cells that are solid or not",
        Axis::linear("cells across a sphere").range(0.0, 45.0),
        Axis::linear("error of k, %").range(-40.0, 20.0),
    )
    .with(Series::dashed("exact (Zick & Homsy)", vec![(0.0, 0.0), (45.0, 0.0)]));
    for (number, operator) in ["graded_viscosity", "bounce_back"].into_iter().enumerate() {
        for image in ["shares", "binary"] {
            let own = array.with(&[("operator", operator), ("image", image)])?;
            let points = own.points("cells_per_diameter", "k_over_edge2")?;
            let errors = points.into_iter().map(|(cells, k)| (cells, 100.0 * (k / exact - 1.0)));
            let label = format!("{operator}, {image}");
            let series = match image {
                "shares" => Series::line(label, errors.collect()),
                _ => Series::dashed(label, errors.collect()),
            };
            figure = figure.with(series.with_colour(number));
        }
    }
    Ok(figure.note("tau = 0.6; at 42 cells across a sphere image and grid are the same"))
}
