//! The drag of a sphere in a stream: the paper's section 5.

pub(super) mod figures;
pub(super) mod others;
mod paper;
pub(super) mod stream;
pub(super) mod study;

use psmrt_reference::collision::Preset;
use psmrt_report::{Figure, PowerLaw};

use super::{Bench, Case, CaseError, Claim, Golden, Stream};

use psmrt::table::Table;

/// A sphere in a stream.
pub const CASE: Case = Case {
    name: "sphere_drag",
    title: "Drag of a sphere in a stream (section 5)",
    about: &[
        "The paper's box, 5 x 10 x 5 diameters: water enters through one face at a given velocity (half-way \
         bounce-back) and leaves through the opposite one freely (zero gradient). What the paper leaves open \
         is chosen so: the sphere is in the middle; the four sides are free of friction, which for this flow \
         is the same as periodic; a quarter of the box is computed, between mirror planes through the sphere's \
         centre. Weight of Noble and Torczynski, exact solid fractions, MRT with d'Humieres' rates unless \
         SRT is named. C_D = F/(1/2 rho U2 pi d2/4), rho U being the mean mass flux; Re = U d/nu.",
        "Two yardsticks. In so narrow a box the drag is larger than in open water; for Re -> 0 by a factor known \
         to eight digits, K = 1.40446 (integral equation, computed for this project). For the other Reynolds \
         numbers the drag in open water is known to 0.1 % (axisymmetric Navier-Stokes, computed for this project); \
         White's formula, which the paper compares with, is itself 9 % high at Re = 100. What the box adds is \
         found by varying its width (study.csv) and taken off.",
        "Steady: the force on the sphere changes by less than 3e-4 of itself (study: 3e-5 below 12 cells) in three consecutive samples; a \
         row is a third of the time in which a wave as long as the box is wide dies down, or a tenth of that in \
         which the stream passes through. tau is the same on all grids of a Reynolds number and so near to 1/2 \
         (0.7 to 0.51) that the inlet's velocity is below 0.09 cells per step. Quick rows have 4 and 6 cells \
         per diameter, the study 4 to 16, the paper 30, on which paper.csv has its Reynolds numbers with both collisions (engine cpu in single \
         precision; steady to 1e-3 of the force).",
        "Open water is found from the finest two grids in the paper's box, extrapolated as second order, and from \
         boxes of up to 16 diameters, the four widest of which are extrapolated by a power of their width. At Re 30, 50 and 150 the box was not varied: \
         its share is taken between those of Re 10 and 100.",
        "SRT at 6 cells per diameter is steady up to Re = 50. At Re = 100 and 150 (tau = 0.515 and 0.51) it is stable, but its \
         force still changes after 10,800 steps, four times what MRT needs: here the paper, which finds both stable up \
         to 150 and shows no difference, is not reproduced (reference/ERRATA.md).",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv", "duct.csv"],
    rows: "expected.csv",
    studies: &["study.csv", "paper.csv"],
    units: "width_d in diameters; lattice_velocity and max_speed in cells per step; the rest without units",
    full: "cargo validate report --full --case sphere_drag goes on to 12 cells per diameter (a quarter of an hour); cargo run --release -p psmrt-validation --example sphere_drag_study made study.csv (hours; it can be cut off); the paper's own grid, 30 cells: cargo run --release -p psmrt-validation --example paper_drag made paper.csv (an hour and a half)",
    measure,
    judge,
    draw,
};

/// Drag over Stokes' for Re -> 0 in a duct 5 diameters wide with sides free of friction, periods of 10
/// diameters: golden/sphere_drag/duct.csv.
const DUCT: &str = "duct.csv";

/// Collision, Reynolds number, cells per diameter, relaxation time.
const RUNS: [(Preset, f64, u32, f64); 6] = [
    (Preset::DHumieres, 0.1, 4, 0.7),
    (Preset::DHumieres, 0.1, 6, 0.7),
    (Preset::DHumieres, 10.0, 4, 0.6),
    (Preset::Srt, 10.0, 4, 0.6),
    (Preset::DHumieres, 10.0, 6, 0.6),
    (Preset::DHumieres, 100.0, 6, 0.515),
];

/// More of them at the full scale.
const FULL_RUNS: [(Preset, f64, u32, f64); 4] = [
    (Preset::DHumieres, 0.1, 8, 0.7),
    (Preset::DHumieres, 10.0, 8, 0.6),
    (Preset::DHumieres, 10.0, 12, 0.6),
    (Preset::DHumieres, 100.0, 12, 0.515),
];

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let mut table = Table::new(&Stream::COLUMNS);
    let more = if bench.is_full() { &FULL_RUNS[..] } else { &[] };
    for &(collision, reynolds, cells, tau) in RUNS.iter().chain(more) {
        let (operator, width, tolerance) = ("bounce_back", 5.0, 3e-4);
        let stream = Stream { collision, operator, reynolds, cells, tau, width, tolerance };
        table.add(stream.row(bench)?);
    }
    Ok(table)
}

/// What is known of the drag.
pub(super) struct Known {
    /// `K` in the duct for Re -> 0.
    pub duct: f64,
    /// Re and C_D in open water.
    pub open: Table,
}

impl Known {
    fn of(golden: &Golden) -> Result<Self, CaseError> {
        let duct = golden.table(DUCT)?.with(&[("period_length_over_d", "10")])?;
        let duct = duct.number("K_total_force_superficial_U")?;
        Ok(Known { duct, open: golden.table("literature.csv")? })
    }

    /// C_D in open water.
    pub fn open(&self, reynolds: &str) -> Result<f64, CaseError> {
        Ok(self.open.with(&[("Re", reynolds)])?.number("CD_computed")?)
    }
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let known = Known::of(golden)?;
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        claims.extend(quick(&engine, &known, rows)?);
    }
    let study = golden.table("study.csv")?;
    claims.extend(full(&known, &study)?);
    claims.extend(paper::claims(&golden.table("paper.csv")?, &study, &known)?);
    Ok(claims)
}

/// The claims of one engine.
fn quick(engine: &str, known: &Known, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let of = |collision: &str, reynolds: &str, cells: &str, column: &str| {
        let wanted = [("engine", engine), ("collision", collision), ("Re", reynolds)];
        let found = rows.with(&wanted)?.with(&[("cells_per_diameter", cells)])?;
        found.number(column)
    };
    let fine = of(Preset::DHumieres.word(), "0.1", "6", "K")? / known.duct - 1.0;
    let slow =
        rows.with(&[("engine", engine), ("collision", Preset::DHumieres.word()), ("Re", "0.1")])?;
    let sizes = slow.points("cells_per_diameter", "K")?.into_iter();
    let sizes: Vec<_> = sizes.map(|(d, k)| (d, (k / known.duct - 1.0).abs())).collect();
    let order = PowerLaw::fit(&sizes)?.order;
    Ok(vec![
        Claim {
            what: format!(
                "{engine}: Re 0.1, 6 cells: error of the drag against the exact one of this box"
            ),
            measured: fine,
            allowed: -0.06..=0.0,
            why: "a sphere of 3 cells' radius at tau = 0.7 leaks away 2.25 nu K/a2 = 2.3 % of its drag \
                  (reference/ERRATA.md), and its surface is as coarse as its cells: 2 to 3 % more; never \
                  too large",
        },
        Claim {
            what: format!("{engine}: Re 0.1: order of that error over {} grids", sizes.len()),
            measured: -order,
            allowed: 1.7..=2.7,
            why: "second order, by the leak and by the grid; two coarse grids leave some of the next order",
        },
        Claim {
            what: format!("{engine}: Re 10, 6 cells: C_D over that in open water"),
            measured: of(Preset::DHumieres.word(), "10", "6", "CD")? / known.open("10")?,
            allowed: 1.0..=1.1,
            why: "computed to 0.1 %; the box adds 7 % (study.csv, by its width), the grid takes off 2 %",
        },
        Claim {
            what: format!("{engine}: Re 100, 6 cells: C_D over that in open water"),
            measured: of(Preset::DHumieres.word(), "100", "6", "CD")? / known.open("100")?,
            allowed: 1.1..=1.3,
            why: "the boundary layer, d/sqrt(Re) = 0.6 cells, is not resolved, which makes the drag too large; \
                  study.csv shows how it falls with the grid. Held here against drift and between engines",
        },
        Claim {
            what: format!("{engine}: Re 10, 4 cells: C_D with SRT over that with MRT"),
            measured: of(Preset::Srt.word(), "10", "4", "CD")?
                / of(Preset::DHumieres.word(), "10", "4", "CD")?,
            allowed: 0.97..=1.03,
            why: "the paper finds no remarkable difference; the two differ only in how the surface errs, \
                  which at 4 cells is a few percent",
        },
    ])
}

/// The claims of the study.
fn full(known: &Known, study: &Table) -> Result<Vec<Claim>, CaseError> {
    let open = |reynolds: &str| known.open(reynolds);
    let mut claims = study::claims(study, known.duct, open)?;
    claims.extend(others::claims(study, open)?);
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let (known, study) = (Known::of(golden)?, golden.table("study.csv")?);
    figures::all(&known, rows, &study, &golden.table("paper.csv")?)
}
