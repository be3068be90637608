//! Stokes drag of sphere arrays against resolution, relaxation time, collision, weight and operator.
//!
//! Prints one row per run as it goes; half an hour on two cores.
//!
//! ```text
//! cargo run --release -p psmrt-reference --example array_study > golden/sphere_arrays/study.csv
//! ```

#![allow(dead_code, reason = "the tests use more of the shared module")]

#[path = "../../tests/common/arrays.rs"]
mod arrays;

use arrays::{Array, Lattice, Part};
use psmrt_reference::collision::Preset;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use std::io::{self, Write};

const SRT: Preset = Preset::Srt;
const MRT: Preset = Preset::DHumieres;
const TRT: Preset = Preset::Trt;

const NT: (&str, Weighting) = ("NT", Weighting::NobleTorczynski);
const EPS: (&str, Weighting) = ("eps", Weighting::SolidFraction);
const BB: (&str, SolidOperator) = ("bounce_back", SolidOperator::NonEquilibriumBounceBack);
const SUP: (&str, SolidOperator) = ("superposition", SolidOperator::Superposition);

/// Reynolds number of all runs that do not study it.
const SLOW: f64 = 0.005;

/// The models that one set of grids and relaxation times is run with.
struct Models {
    presets: &'static [Preset],
    weights: &'static [(&'static str, Weighting)],
    operators: &'static [(&'static str, SolidOperator)],
}

const ALL: Models =
    Models { presets: &[SRT, MRT, TRT], weights: &[NT, EPS], operators: &[BB, SUP] };
const BOTH_WEIGHTS: Models =
    Models { presets: &[SRT, MRT, TRT], weights: &[NT, EPS], operators: &[BB] };
const PRESETS: Models = Models { presets: &[SRT, MRT, TRT], weights: &[NT], operators: &[BB] };
const ONE: Models = Models { presets: &[MRT], weights: &[NT], operators: &[BB] };
const ONE_EPS: Models = Models { presets: &[MRT], weights: &[EPS], operators: &[BB] };

/// A row of the literature: lattice, solid fraction, exact `K`.
#[derive(Clone, Copy)]
struct Exact {
    lattice: Lattice,
    solid_fraction: f64,
    k: f64,
}

fn main() -> io::Result<()> {
    let sc = exact(Lattice::Sc, "0.06544984695")?;
    let sc_dense = exact(Lattice::Sc, "0.343")?;
    let bcc = exact(Lattice::Bcc, "0.0850218452")?;
    let bcc_dense = exact(Lattice::Bcc, "0.6")?;
    let fcc = exact(Lattice::Fcc, "0.09256006121")?;
    let fcc_dense = exact(Lattice::Fcc, "0.6")?;
    header();

    // Everything with everything, at 4, 6 and 8 cells per diameter (side 8, 12, 16).
    grid(sc, &[8], &[0.51, 0.55, 0.6, 0.8, 1.0, 1.5, 2.0], &ALL)?;
    grid(sc, &[12], &[0.55, 0.6, 0.8, 1.0, 1.5, 2.0], &ALL)?;
    grid(sc, &[16], &[0.6, 0.8, 1.0, 1.5, 2.0], &ALL)?;
    // Denser arrays, and the other lattices.
    grid(sc_dense, &[8, 12, 16], &[0.6, 0.8, 1.0, 1.5], &PRESETS)?;
    grid(bcc, &[12, 16], &[0.6, 0.8, 1.0, 1.5], &PRESETS)?;
    grid(bcc_dense, &[8, 12, 16, 20], &[0.6, 0.8, 1.0, 1.5], &PRESETS)?;
    grid(fcc, &[12, 16], &[0.6, 0.8, 1.0, 1.5], &PRESETS)?;
    grid(fcc_dense, &[12, 16, 20, 24], &[0.6, 0.8, 1.0, 1.5], &PRESETS)?;
    // Where between the nodes the sphere lies.
    for side in [8, 12, 16] {
        for shift in [[0.0; 3], [0.5; 3], [0.25; 3], [0.5, 0.0, 0.0], [0.3, 0.1, 0.4]] {
            row(sc, side, Part::Whole { shift }, SLOW, (1.0, MRT), NT, BB)?;
        }
    }
    // The Reynolds number.
    for reynolds in [0.001, 0.01, 0.1, 1.0] {
        row(sc, 16, Part::Quarter, reynolds, (0.8, MRT), NT, BB)?;
    }
    // Finer grids.
    grid(bcc, &[24, 32], &[0.8, 1.0], &ONE)?;
    grid(fcc, &[24, 32], &[0.8, 1.0], &ONE)?;
    grid(sc, &[24], &[0.8, 1.0, 1.5], &BOTH_WEIGHTS)?;
    grid(sc, &[16], &[0.55], &BOTH_WEIGHTS)?;
    grid(sc, &[32], &[1.5, 1.0, 0.8], &ONE)?;
    grid(sc, &[32], &[0.8], &ONE_EPS)
}

fn header() {
    println!(
        "# Stokes drag of periodic sphere arrays by psmrt-reference {}, lattice units.",
        env!("CARGO_PKG_VERSION")
    );
    println!("# Written by `cargo run --release -p psmrt-reference --example array_study`.");
    println!(
        "# K = G V/(n 6 pi mu a U), U from the mass flux; K_force: from the force on the spheres"
    );
    println!(
        "# plus the buoyancy G phi V (tests/common/arrays.rs says why K is the one to judge by)."
    );
    println!(
        "# K_exact: golden/sphere_arrays/literature.csv. Exact solid fractions. Reynolds number"
    );
    println!(
        "# 2 a U/nu. shift: of the spheres off the corners of the grid, in cells; `quarter`: none,"
    );
    println!(
        "# and a quarter of the cell between mirror planes. Steady to 1e-6. imbalance: force on the"
    );
    println!("# spheres over the sum of (1 - B) G, less one.");
    println!(
        "lattice,solid_fraction,cells_per_side,cells_per_diameter,tau,collision,weight,operator,\
         shift,Re,K,K_force,K_exact,relative_error,relative_error_force,imbalance,steps,cell_updates"
    );
}

/// Runs every side with every relaxation time and model.
fn grid(exact: Exact, sides: &[usize], taus: &[f64], models: &Models) -> io::Result<()> {
    for &side in sides {
        for &tau in taus {
            for &preset in models.presets {
                for &weight in models.weights {
                    for &operator in models.operators {
                        row(exact, side, Part::Quarter, SLOW, (tau, preset), weight, operator)?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// Runs one array and prints its row.
fn row(
    exact: Exact,
    side: usize,
    part: Part,
    reynolds: f64,
    (tau, preset): (f64, Preset),
    (weight, weighting): (&str, Weighting),
    (operator_name, operator): (&str, SolidOperator),
) -> io::Result<()> {
    let Exact { lattice, solid_fraction, k: k_exact } = exact;
    let collision = preset.collision(tau).map_err(io::Error::other)?;
    let array =
        Array { lattice, solid_fraction, side, part, collision, weighting, operator, reynolds };
    let shift = match part {
        Part::Quarter => "quarter".to_owned(),
        Part::Whole { shift } => shift.map(|s| s.to_string()).join(" "),
    };
    let diameter = 2.0 * array.radius();
    let name = lattice.name();
    print!(
        "{name},{solid_fraction},{side},{diameter:.4},{tau},{},{weight},{operator_name},{shift},",
        preset.word()
    );
    match array.flow(k_exact, 1e-6, |solver, steps| solver.run(steps)) {
        Ok(flow) => println!(
            "{:.3e},{:.6},{:.6},{k_exact},{:.6},{:.6},{:.1e},{},{}",
            flow.reynolds,
            flow.k,
            flow.k_from_force,
            flow.k / k_exact - 1.0,
            flow.k_from_force / k_exact - 1.0,
            flow.imbalance,
            flow.steps,
            flow.cell_updates
        ),
        Err(stopped) => println!("{reynolds:e},,,{k_exact},,,,,{stopped:?}"),
    }
    io::stdout().flush()
}

/// Looks up `K` of a lattice and a solid fraction, spelled as in the table.
fn exact(lattice: Lattice, solid_fraction: &str) -> io::Result<Exact> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../golden/sphere_arrays/literature.csv");
    let table = std::fs::read_to_string(path)?;
    let number = |text: &str| text.parse::<f64>().map_err(io::Error::other);
    for line in table.lines() {
        let fields: Vec<&str> = line.split(',').collect();
        if fields[0] == lattice.name() && fields[1] == solid_fraction {
            return Ok(Exact {
                lattice,
                solid_fraction: number(solid_fraction)?,
                k: number(fields[3])?,
            });
        }
    }
    Err(io::Error::other(format!("no row {} {solid_fraction} in {path}", lattice.name())))
}
