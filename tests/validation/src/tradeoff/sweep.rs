//! Which runs a sweep makes: cheap ones first.

use crate::tradeoff::parameters::{Flow, Parameters, Storage};
use psmrt_reference::collision::Preset;
use psmrt_reference::coverage::CoverageRule;

use Preset::{DHumieres, Srt, Trt};

/// Relaxation times of the full sweep, and the shorter list of what is not the default.
const TAUS: [f64; 6] = [0.55, 0.6, 0.8, 1.0, 1.5, 2.0];
const FEW_TAUS: [f64; 3] = [0.6, 0.8, 1.5];

/// The runs for a flow; `quick` leaves a handful.
pub fn runs(flow: Flow, quick: bool) -> Vec<Parameters> {
    match flow {
        Flow::Poiseuille => poiseuille(quick),
        Flow::Settling => settling(quick),
        Flow::SphereDrag => sphere_drag(quick),
        Flow::Sc => arrays(flow, "0.2", &[8, 12, 16, 20, 24, 32], quick),
        Flow::Bcc => arrays(flow, "0.3", &[8, 12, 16, 20, 24, 32], quick),
        Flow::Fcc => arrays(flow, "0.45", &[8, 12, 16, 20, 24, 32], quick),
        Flow::Seepage => arrays(flow, "0.6", &[8, 12, 16, 20, 24, 32], quick),
        Flow::Random => random(quick),
    }
}

/// Operator and weight of the runs that compare operators.
pub const OPERATORS: [(&str, &str); 4] = [
    ("bounce_back", "NT"),
    ("superposition", "NT"),
    ("full_bounce_back", "NT"),
    ("graded_viscosity", "graded"),
];

/// The operators that a free grain may have, which settles in a shaft.
pub const OF_FREE_GRAINS: [(&str, &str); 2] = [OPERATORS[0], OPERATORS[2]];

/// The runs that compare operators, in fixed beds and with a free grain, on the CPU engine in double precision.
pub fn operators() -> Vec<Parameters> {
    let beds = [
        (Flow::Sc, "0.064"),
        (Flow::Sc, "0.343"),
        (Flow::Bcc, "0.343"),
        (Flow::Fcc, "0.343"),
        (Flow::Fcc, "0.6"),
        (Flow::Random, "0.2"),
        (Flow::Random, "0.45"),
    ];
    let taus = [0.55, 0.6, 0.8, 1.0, 1.5];
    let with = |runs: &[Parameters], (operator, weight): (&str, &str)| {
        changed(runs, |run| {
            operator.clone_into(&mut run.operator);
            weight.clone_into(&mut run.weight);
            "cpu".clone_into(&mut run.engine);
        })
    };
    let settling = grid(Flow::Settling, "0.25", &[4, 6, 8], &taus, &[DHumieres]);
    let mut runs: Vec<Parameters> =
        OF_FREE_GRAINS.into_iter().flat_map(|operator| with(&settling, operator)).collect();
    for cells in [12, 16, 24, 32] {
        for (flow, geometry) in beds {
            let of_size = grid(flow, geometry, &[cells], &taus, &[DHumieres]);
            let is_fine = cells == 32
                && !matches!((flow, geometry), (Flow::Sc, "0.343") | (Flow::Fcc, "0.6"));
            let with_others = grid(flow, geometry, &[cells], &taus, &[Srt, Trt]);
            for operator in OPERATORS {
                if !is_fine {
                    runs.extend(with(&of_size, operator));
                }
                if cells == 16 {
                    runs.extend(with(&with_others, operator));
                }
                if cells < 32 && operator.0 != "superposition" {
                    let mut linear = with(&of_size, operator);
                    linear.iter_mut().for_each(|run| run.coverage = CoverageRule::Linear);
                    runs.extend(linear);
                }
            }
        }
    }
    // Some of these have been asked for above.
    for run in of_tight_operators(&beds) {
        if !runs.contains(&run) {
            runs.push(run);
        }
    }
    runs
}

/// Further runs of the two operators that let no fluid through, for their error models: with the relaxation times and beds
/// that a comparison can do without.
fn of_tight_operators(compared: &[(Flow, &str)]) -> Vec<Parameters> {
    let more = [
        (Flow::Sc, "0.1"),
        (Flow::Sc, "0.2"),
        (Flow::Bcc, "0.3"),
        (Flow::Fcc, "0.45"),
        (Flow::Fcc, "0.7"),
    ];
    let (full, graded) = (OPERATORS[2], OPERATORS[3]);
    let taus = [0.51, 0.55, 0.6, 0.8, 1.0, 1.5, 2.0];
    let with = |runs: &[Parameters], (operator, weight): (&str, &str)| {
        changed(runs, |run| {
            operator.clone_into(&mut run.operator);
            weight.clone_into(&mut run.weight);
            "cpu".clone_into(&mut run.engine);
        })
    };
    let all: Vec<(Flow, &str)> = compared.iter().chain(&more).copied().collect();
    let mut runs = Vec::new();
    for cells in [8, 12, 16, 24] {
        // The finer, the longer flows take to become steady, and the less there is to see.
        let (own, of_others) = match cells {
            24 => (&taus[1..], &[0.55, 0.8, 1.5][..]),
            _ => (&taus[..], &taus[..]),
        };
        for &(flow, geometry) in &all {
            let of_size = grid(flow, geometry, &[cells], own, &[DHumieres]);
            runs.extend(with(&of_size, graded));
            runs.extend(with(&of_size, full));
            if cells > 8 {
                let of_size = grid(flow, geometry, &[cells], of_others, &[Srt, Trt]);
                runs.extend(with(&of_size, graded));
            }
        }
    }
    for (flow, geometry) in [more[1], more[2], more[3]] {
        let finest = grid(flow, geometry, &[32], &[0.6, 1.0, 1.5], &[DHumieres]);
        runs.extend(with(&finest, graded));
        runs.extend(with(&finest, full));
    }
    let duct = grid(Flow::SphereDrag, "0.00418879", &[20, 30], &[0.8, 1.5, 2.0], &[DHumieres]);
    runs.extend(with(&duct, graded));
    runs.extend(with(&duct, full));
    let duct = grid(Flow::SphereDrag, "0.00418879", &[30], &[0.8, 1.5], &[Srt, Trt]);
    runs.extend(with(&duct, graded));
    // A shaft of two diameters is eight times as cheap as the one above.
    let narrow = grid(Flow::Settling, "0.5", &[4, 6, 8], &taus[2..], &[DHumieres]);
    runs.extend(with(&narrow, full));
    runs.extend(with(&grid(Flow::Settling, "0.5", &[12], &[0.8, 1.5], &[DHumieres]), full));
    runs.extend(with(&grid(Flow::Settling, "0.25", &[4, 6, 8], &[2.0], &[DHumieres]), full));
    runs
}

/// Every number of cells with every relaxation time and collision.
fn grid(
    flow: Flow,
    geometry: &str,
    cells: &[u32],
    taus: &[f64],
    collisions: &[Preset],
) -> Vec<Parameters> {
    let mut runs = Vec::new();
    for &cells in cells {
        for &tau in taus {
            for &collision in collisions {
                runs.push(Parameters::new(flow, geometry, cells, tau, collision));
            }
        }
    }
    runs
}

/// The same runs with a change to each.
fn changed(runs: &[Parameters], change: impl Fn(&mut Parameters)) -> Vec<Parameters> {
    let mut runs = runs.to_vec();
    runs.iter_mut().for_each(change);
    runs
}

fn on_kernel(parameters: &mut Parameters) {
    parameters.engine = "wgpu".to_owned();
    parameters.storage = Storage::F32Shifted;
}

fn poiseuille(quick: bool) -> Vec<Parameters> {
    let grid = |cells: &[u32], taus: &[f64], collisions: &[Preset]| {
        grid(Flow::Poiseuille, "", cells, taus, collisions)
    };
    if quick {
        return grid(&[8, 16], &[0.6, 1.5], &Preset::ALL);
    }
    let some = grid(&[8, 16], &FEW_TAUS, &Preset::ALL);
    let mut runs = grid(&[8, 12, 16, 24], &TAUS, &Preset::ALL);
    for velocity in [0.03, 0.1, 0.2] {
        runs.extend(changed(&some, |parameters| parameters.lattice_velocity = velocity));
    }
    runs.extend(changed(&some, on_kernel));
    let mrt = grid(&[8, 16], &FEW_TAUS, &[DHumieres, Trt]);
    for storage in [Storage::F32, Storage::F16Shifted] {
        runs.extend(changed(&mrt, |parameters| parameters.storage = storage));
    }
    runs
}

fn arrays(flow: Flow, fraction: &str, cells: &[u32], quick: bool) -> Vec<Parameters> {
    let grid = |cells: &[u32], taus: &[f64], collisions: &[Preset]| {
        grid(flow, fraction, cells, taus, collisions)
    };
    if quick {
        return grid(&[8, 12], &[0.6, 1.5], &[Srt, DHumieres]);
    }
    let coarse = grid(&[8, 12, 16], &FEW_TAUS, &[DHumieres]);
    let mut runs = grid(cells, &TAUS, &[DHumieres]);
    runs.extend(grid(&[8, 12, 16, 24], &[0.6, 0.8, 1.0, 1.5], &[Srt, Trt]));
    let mut solid = coarse.clone();
    solid.extend(grid(&[8, 12, 16], &[1.0, 2.0], &[DHumieres]));
    solid.extend(grid(&[24], &[0.6, 0.8, 1.0, 1.5], &[DHumieres]));
    runs.extend(changed(&solid, |parameters| "eps".clone_into(&mut parameters.weight)));
    runs.extend(changed(&solid, |parameters| "superposition".clone_into(&mut parameters.operator)));
    runs.extend(changed(&grid(&[8, 16], &FEW_TAUS, &[DHumieres]), on_kernel));
    let sampled: &[usize] = if flow == Flow::Sc { &[1, 2, 3, 5, 10] } else { &[2, 5] };
    for &samples in sampled {
        runs.extend(changed(&coarse, |run| run.coverage = CoverageRule::Sampled { n: samples }));
    }
    if flow != Flow::Sc {
        return runs;
    }
    let few = grid(&[8, 12], &FEW_TAUS, &[DHumieres]);
    for velocity in [1e-3, 3e-3, 1e-2] {
        let faster = changed(&few, |parameters| parameters.lattice_velocity = velocity);
        runs.extend(faster.iter().cloned());
        for storage in [Storage::F32, Storage::F16Shifted] {
            runs.extend(changed(&faster, |parameters| parameters.storage = storage));
        }
    }
    for storage in [Storage::F32, Storage::F16Shifted] {
        runs.extend(changed(&few, |parameters| parameters.storage = storage));
    }
    runs
}

fn random(quick: bool) -> Vec<Parameters> {
    let grid = |cells: &[u32], taus: &[f64], collisions: &[Preset]| {
        let all = ["0.2", "0.45"];
        all.map(|fraction| self::grid(Flow::Random, fraction, cells, taus, collisions)).concat()
    };
    if quick {
        return grid(&[12], &[0.8, 1.5], &[DHumieres]);
    }
    let mut runs = grid(&[12, 16, 24, 32], &[0.6, 0.8, 1.0, 1.5, 2.0], &[DHumieres]);
    runs.extend(grid(&[12, 16, 24], &FEW_TAUS, &[Srt, Trt]));
    let solid = grid(&[12, 16, 24], &FEW_TAUS, &[DHumieres]);
    runs.extend(changed(&solid, |parameters| "eps".clone_into(&mut parameters.weight)));
    runs.extend(changed(&solid, |parameters| "superposition".clone_into(&mut parameters.operator)));
    runs
}

fn settling(quick: bool) -> Vec<Parameters> {
    let grid = |cells: &[u32], taus: &[f64], collisions: &[Preset]| {
        grid(Flow::Settling, "0.25", cells, taus, collisions)
    };
    if quick {
        return grid(&[4, 6], &[0.8, 1.5], &[DHumieres]);
    }
    let mut runs = grid(&[4, 6], &TAUS, &[DHumieres]);
    runs.extend(grid(&[4, 6], &FEW_TAUS, &[Srt, Trt]));
    let coarse = grid(&[4, 6], &FEW_TAUS, &[DHumieres]);
    runs.extend(changed(&coarse, |parameters| "eps".clone_into(&mut parameters.weight)));
    runs.extend(changed(&coarse, on_kernel));
    for samples in [2, 5] {
        runs.extend(changed(&coarse, |run| run.coverage = CoverageRule::Sampled { n: samples }));
    }
    runs.extend(grid(&[8], &[2.0, 1.5, 1.0, 0.8, 0.6], &[DHumieres]));
    runs.extend(grid(&[8], &[1.5, 0.8], &[Srt, Trt]));
    runs.extend(changed(&grid(&[8], &[1.5, 0.8], &[DHumieres]), on_kernel));
    runs.extend(grid(&[12], &[2.0, 1.5, 1.0], &[DHumieres]));
    // Twice as narrow and so eight times as cheap: finer grids.
    let narrow = |cells: &[u32], taus: &[f64], collisions: &[Preset]| {
        self::grid(Flow::Settling, "0.5", cells, taus, collisions)
    };
    runs.extend(narrow(&[4, 6, 8, 12], &[2.0, 1.5, 0.8, 0.6], &[DHumieres]));
    runs.extend(narrow(&[4, 8, 12], &[1.5, 0.8], &[Srt, Trt]));
    let solid = narrow(&[6, 8, 12], &FEW_TAUS, &[DHumieres]);
    runs.extend(changed(&solid, |parameters| "eps".clone_into(&mut parameters.weight)));
    runs.extend(changed(&coarse, |parameters| {
        "superposition".clone_into(&mut parameters.operator);
    }));
    runs.extend(narrow(&[16], &[2.0, 1.5, 1.0, 0.8], &[DHumieres]));
    runs.extend(grid(&[16], &[2.0, 1.5], &[DHumieres]));
    runs
}

fn sphere_drag(quick: bool) -> Vec<Parameters> {
    let grid = |cells: &[u32], taus: &[f64], collisions: &[Preset]| {
        grid(Flow::SphereDrag, "0.00418879", cells, taus, collisions)
    };
    if quick {
        return grid(&[20], &[0.8, 1.5], &[DHumieres]);
    }
    let mut runs = grid(&[20], &[2.0, 1.5, 1.0, 0.8], &[DHumieres]);
    let coarse = grid(&[20], &[1.5], &[DHumieres]);
    runs.extend(changed(&coarse, on_kernel));
    runs.extend(changed(&coarse, |parameters| "eps".clone_into(&mut parameters.weight)));
    runs.extend(grid(&[20], &[1.5], &[Srt, Trt]));
    runs.extend(grid(&[24], &[2.0], &[DHumieres]));
    runs.extend(changed(&coarse, |parameters| {
        "superposition".clone_into(&mut parameters.operator);
    }));
    runs.extend(grid(&[30], &[2.0, 1.5, 1.0], &[DHumieres]));
    runs.extend(grid(&[30], &[1.5], &[Srt, Trt]));
    runs.extend(changed(&grid(&[30], &[1.5], &[DHumieres]), |parameters| {
        "eps".clone_into(&mut parameters.weight);
    }));
    runs.extend(grid(&[40], &[2.0, 1.5, 1.0], &[DHumieres]));
    runs
}
