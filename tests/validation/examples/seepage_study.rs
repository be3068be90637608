//! The full form of seepage: Reynolds numbers, beds, relaxation time and resolution, and how fast a flow
//! stays stable.
//!
//! Adds one row per run to `golden/seepage/study.csv` and `golden/seepage/stability.csv` as it goes; runs that
//! have a row are left out, so that it can be cut off and started again. An hour or two on one core.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example seepage_study [stability]
//! ```

use psmrt::engine::EngineName;
use psmrt_reference::collision::Preset;
use std::error::Error;
use std::path::Path;

use psmrt::kernel::Gpu;
use psmrt_validation::cases::{BedRun, Bench, Packing, Study};

const STUDY: &str = "golden/seepage/study.csv";
const STABILITY: &str = "golden/seepage/stability.csv";

/// A bed of 31 spheres at 8 cells per diameter and tau = 0.51.
const BED: BedRun = BedRun {
    collision: Preset::DHumieres,
    weighting: "noble_torczynski",
    packing: Packing::Random { side: 3.0, count: 31, seed: 1 },
    reynolds: 1.0,
    side_cells: 24,
    tau: 0.51,
    tolerance: 1e-4,
};

/// Tolerance for flows that creep.
const CREEPING: f64 = 1e-5;

/// A small one of 9, for fine grids and many runs.
const SMALL: BedRun = BedRun { packing: Packing::SMALL, side_cells: 16, ..BED };

fn main() -> Result<(), Box<dyn Error>> {
    if std::env::args().nth(1).is_some_and(|word| word == "stability") {
        stability()
    } else {
        study()
    }
}

fn study() -> Result<(), Box<dyn Error>> {
    add_rows(
        &mut Bench::new(Path::new("golden"), EngineName::Reference, None, |_| {}),
        &oracle_runs(),
    )?;
    let gpu = Gpu::open(None)?;
    add_rows(
        &mut Bench::new(Path::new("golden"), EngineName::Wgpu, Some(gpu), |_| {}),
        &kernel_runs(),
    )
}

fn add_rows(bench: &mut Bench, runs: &[BedRun]) -> Result<(), Box<dyn Error>> {
    for bed in runs {
        let start = bed.start(bench.engine_name().word()).join(",") + ",";
        if Study::new(STUDY).row(&start)?.is_none() {
            add(STUDY, &bed.row(bench)?)?;
        }
    }
    Ok(())
}

/// Other beds of 31 spheres.
fn beds(seeds: std::ops::RangeInclusive<u32>, numbers: &[f64]) -> Vec<BedRun> {
    let packings = seeds.map(|seed| Packing::Random { side: 3.0, count: 31, seed });
    let one = |packing| {
        let of = move |&reynolds| BedRun { packing, reynolds, ..BED };
        numbers.iter().map(of)
    };
    packings.flat_map(one).collect()
}

/// Resolution: of an ordered bed, whose permeability is known, and of a small random one.
fn grids(taus: &[f64], ordered: &[u32], random: &[u32]) -> Vec<BedRun> {
    let mut runs = Vec::new();
    for &tau in taus {
        let fcc = |&side_cells| BedRun { packing: Packing::Fcc, side_cells, tau, ..BED };
        runs.extend(ordered.iter().map(fcc));
        runs.extend(random.iter().map(|&side_cells| BedRun { side_cells, tau, ..SMALL }));
    }
    runs
}

/// The oracle's runs, the cheap ones first.
fn oracle_runs() -> Vec<BedRun> {
    let mut runs = Vec::new();
    // Reynolds numbers.
    for collision in [Preset::DHumieres, Preset::Srt] {
        for reynolds in [0.1, 1.0, 3.0, 10.0, 30.0, 60.0, 100.0] {
            runs.push(BedRun { collision, reynolds, ..BED });
        }
    }
    // Relaxation time.
    for tau in [0.503, 0.505, 0.52, 0.55, 0.6, 0.8, 1.0] {
        // Beds that leak or let little through approach their flow in many small steps.
        let tolerance = if tau < 0.6 { BED.tolerance } else { CREEPING };
        for collision in [Preset::DHumieres, Preset::Srt] {
            runs.push(BedRun { collision, tau, tolerance, ..BED });
        }
        if tau != 0.505 {
            runs.push(BedRun { weighting: "solid_fraction", tau, tolerance, ..BED });
        }
    }
    runs.extend(grids(&[0.55, 0.52, 0.51], &[12, 16, 24], &[16]));
    runs.extend(grids(&[0.55, 0.52], &[], &[24]));
    runs.extend(beds(2..=4, &[1.0, 30.0]));
    runs
}

/// The kernel's runs: other beds, finer grids. The first is one of the oracle's too.
fn kernel_runs() -> Vec<BedRun> {
    let mut runs = beds(1..=1, &[1.0]);
    runs.extend(beds(2..=5, &[1.0, 10.0, 30.0, 100.0]));
    // Larger ones.
    for (side, count, side_cells) in [(4.0, 73, 32), (5.0, 143, 40)] {
        let packing = Packing::Random { side, count, seed: 1 };
        runs.extend([1.0, 10.0, 30.0, 100.0].map(|reynolds| BedRun {
            packing,
            reynolds,
            side_cells,
            ..BED
        }));
    }
    // Re = 100 more slowly, in cells per step.
    let fast = BedRun { reynolds: 100.0, ..BED };
    runs.extend([0.505, 0.503].map(|tau| BedRun { tau, ..fast }));
    // Finer grids, all of them at the speed in cells per step of 8 cells and tau = 0.51, or slower.
    for side_cells in [36, 48] {
        runs.push(BedRun { side_cells, ..fast });
        runs.extend([1.0, 10.0, 30.0].map(|reynolds| BedRun { reynolds, side_cells, ..BED }));
    }
    runs.extend([BED, fast].map(|bed| BedRun { side_cells: 36, tau: 0.505, ..bed }));
    runs.extend(grids(&[0.51], &[], &[24]));
    runs.extend(grids(&[0.505], &[12, 16, 24], &[16, 24]));
    runs.extend(grids(&[0.55, 0.52, 0.51, 0.505], &[32], &[32]));
    runs.push(BedRun { side_cells: 72, ..fast });
    runs
}

/// Doubles the force until the flow breaks, or the Reynolds number is past 200.
fn stability() -> Result<(), Box<dyn Error>> {
    let mut oracle = Bench::new(Path::new("golden"), EngineName::Reference, None, |_| {});
    let mut kernel =
        Bench::new(Path::new("golden"), EngineName::Wgpu, Some(Gpu::open(None)?), |_| {});
    for (tau, collisions) in [
        (0.6, &[Preset::Srt, Preset::DHumieres, Preset::Trt] as &[Preset]),
        (0.55, &[Preset::Srt, Preset::DHumieres, Preset::Trt]),
        (0.53, &[Preset::Srt, Preset::DHumieres, Preset::Trt]),
        (0.51, &[Preset::Srt, Preset::DHumieres, Preset::Trt]),
        (0.505, &[Preset::Srt, Preset::DHumieres, Preset::Trt]),
    ] {
        for weighting in ["noble_torczynski", "solid_fraction"] {
            for &collision in collisions {
                let bed = BedRun { collision, weighting, tau, ..SMALL };
                climb(&mut oracle, bed)?;
                if weighting == "noble_torczynski" && collision != Preset::Trt && tau < 0.52 {
                    climb(&mut kernel, bed)?;
                }
            }
        }
    }
    for collision in [Preset::Srt, Preset::DHumieres] {
        climb(&mut kernel, BedRun { collision, tau: 0.501, ..SMALL })?;
    }
    // As fine as the paper's bed.
    for tau in [0.51, 0.505] {
        for collision in [Preset::Srt, Preset::DHumieres] {
            climb(&mut kernel, BedRun { collision, tau, side_cells: 32, ..SMALL })?;
        }
    }
    Ok(())
}

/// Begins where a flow is stable by experience, and halves the force first if this one is not.
fn climb(bench: &mut Bench, bed: BedRun) -> Result<(), Box<dyn Error>> {
    // With B = epsilon and tau near 1/2 the bed is hardly permeable: much force for little flow.
    let mut reynolds = match (bed.tau < 0.52, bed.weighting) {
        (false, _) => 2.0,
        (true, "solid_fraction") => 256.0,
        (true, _) => 32.0,
    };
    let mut down = false;
    loop {
        let (stable, found) = survives(bench, BedRun { reynolds, ..bed })?;
        if stable && (down || found > 200.0) {
            return Ok(());
        }
        if !stable && !down && known(bench, BedRun { reynolds: 0.5 * reynolds, ..bed })?.is_some() {
            return Ok(());
        }
        down = down || !stable;
        reynolds *= if down { 0.5 } else { 2.0 };
        if !(0.1..1e6).contains(&reynolds) {
            return Ok(());
        }
    }
}

/// Whether a flow is stable, and its Reynolds number.
fn survives(bench: &mut Bench, bed: BedRun) -> Result<(bool, f64), Box<dyn Error>> {
    let row = match known(bench, bed)? {
        Some(row) => row,
        None => {
            // Five viscous times, in which a slow flow becomes steady to 1 %; a fast one sooner. Near tau = 1/2 a
            // flow takes as many steps to break: SRT at 0.501 and Re = 277 does so after 6,464.
            let most = if bed.tau < 0.503 { 25_000.0 } else { 6000.0 };
            let steps = (5.0 * bed.viscous_time()).clamp(1000.0, most);
            let row = bed.row_after(bench, format!("{steps:.0}").parse()?)?;
            add(STABILITY, &row)?;
            row
        }
    };
    let [outcome, found] = ["outcome", "Re"].map(|name| {
        BedRun::COLUMNS.iter().position(|column| *column == name).map_or("", |i| &row[i])
    });
    Ok((outcome == "stable", found.parse()?))
}

/// The row of a run that was made already.
fn known(bench: &Bench, bed: BedRun) -> Result<Option<Vec<String>>, Box<dyn Error>> {
    let start = bed.start(bench.engine_name().word()).join(",") + ",";
    let row = Study::new(STABILITY).row(&start)?;
    Ok(row.map(|line| line.split(',').map(str::to_owned).collect()))
}

fn add(file: &str, row: &[String]) -> Result<(), Box<dyn Error>> {
    let line = row.join(",");
    Study::new(file).add(&line)?;
    println!("{line}");
    Ok(())
}
