//! Seepage through a packed bed of spheres: the paper's section 6.

pub(super) mod bed;
pub(super) mod figures;
pub(super) mod full_size;
mod inlet;
pub(super) mod study;

use psmrt_reference::collision::Preset;
use psmrt_report::Figure;

use super::{BED_LAWS, BedRun, Bench, Case, CaseError, Claim, Golden, Packing};
use bed::FCC_FRACTION;
use psmrt::table::Table;

/// A packed bed.
pub const CASE: Case = Case {
    name: "seepage",
    title: "Seepage through a random bed of spheres (section 6)",
    about: &[
        "A body force drives water through a bed of equal spheres at random places that repeats itself without \
         end; it stands for the pressure gradient. The paper drives 1,000 spheres by a velocity inlet with free \
         outflow (paper.toml; paper_size.csv); without ends and walls every sphere of the bed counts, and density stays constant. \
         psi = (dP/L) d eps3/(rho U2 (1 - eps)) and Re = U d/(nu (1 - eps)), with d the diameter, eps the \
         porosity by the volumes of the spheres, and U the superficial velocity: the mean mass flux over the \
         density, solid cells included.",
        "Lines: the paper's Blake-Kozeny (150/Re) and Ergun (150/Re + 1.75), and, since particle-resolved \
         computations agree on 180 rather than 150 at low Re, Carman-Kozeny with 180 and the laws of Beetstra \
         et al. (2007) and Tang et al. (2015), of which the second lies 17 % above the first at Re = 10. Real beds scatter about any of them by 10 to 15 %. The one exact \
         value is that of the ordered bed (face-centred cubic at the same porosity of 0.4).",
        "What the paper leaves open is chosen so: tau = 0.51, since the spheres of partially saturated cells leak, \
         the more the larger tau; 8 cells per diameter in the quick rows (9 spheres), 8 to 24 in the study (study.csv, \
         31 spheres), 16 in the paper; Noble and Torczynski's weight, exact solid fractions, \
         MRT with d'Humieres' rates unless SRT is named. Steady: U changes by less than 3e-4 of itself (study: 1e-4) \
         in three consecutive samples, a fifth of the time d2/(4 pi2 nu) apart. The force, not tau, sets Re.",
        "8 cells are few. In the ordered bed psi errs by -16 % there at tau = 0.51 and -35 % at 0.55, and at 0.505 it is too \
         large by up to 11 %: water that leaks through the spheres lowers psi, throats a cell wide raise it, and at one \
         tau the two cancel. The limit for fine grids is the same for each tau, which is claimed.",
        "At Re = 100 coarse grids give too little: over Beetstra's law 0.82 at 8 cells per diameter, 0.95 at 12, 1.02 at \
         16 and 1.04 at 24, where at Re = 1 one finds 1.00 at 8, 12 and 16. It is the grid, which at 8 cells has one cell for a boundary layer, \
         d/sqrt(U d/nu). It is not the size of the bed: with 8 cells 73 and 143 spheres have 0.82 and 0.74, five beds \
         of 31 0.71 to 0.82. It is not the velocity of 0.23 cells per step at its peak: with half of it (tau = 0.505) \
         psi over the law at Re = 100, over the same at Re = 1, gains 2 % at 8 cells and at 12. And it is not the law: Tang's and Ergun's \
         are within 4 % of it there.",
        "Up to what velocity a flow is stable (stability.csv): the force is doubled until the guard stops the run. The \
         paper says Re = 2 for SRT and 30 for MRT and gives neither tau nor its weight; the case stability finds with \
         which of them that is so. The last figure shows the \
         limits found, and what a velocity inlet adds to them (inlet.csv): through the paper's bed, 218 cells long, it \
         needs a pressure that at large tau doubles the density of the fluid. 18 spheres at 8 cells per diameter \
         (inlet.toml) need as much, with either collision.",
        "At its own size, 16 cells per diameter (paper_size.csv), the paper's bed rests on a sieve a diameter above the inlet. On the inlet \
         itself it must not lie: between a plane that water enters through and a sphere that touches it the pressure has no bound (12 mu U R3/r4 at \
         distance r from the contact). On 16 cells, MRT, Re = 10 and tau = 0.51, such a run was stopped after 8,895 steps by a cell there; at Re = 1 \
         the force on the bed had not settled after 9,780; on 8 cells it was 10 % too large. psmrt check warns of it. The eight runs of the table took some 35 minutes of two cores in all.",
    ],
    scenes: &["scene.toml", "ordered.toml", "inlet.toml", "paper.toml"],
    literature: &["literature.csv"],
    rows: "expected.csv",
    studies: &[
        "study.csv",
        "stability.csv",
        "inlet.csv",
        "paper_size.csv",
        "../sphere_arrays/literature.csv",
    ],
    units: "permeability_d2 in squares of the diameter; largest_overlap in diameters; lattice_velocity and max_speed \
            in cells per step; the rest without units",
    full: "cargo run --release -p psmrt-validation --example seepage_study made study.csv and stability.csv (hours; it can be cut off); --example paper_seepage made paper_size.csv (a run takes some 8 minutes)",
    measure,
    judge,
    draw,
};

/// Nine spheres, or the ordered bed, on 16 cells.
const BED: BedRun = BedRun {
    collision: Preset::DHumieres,
    weighting: "noble_torczynski",
    packing: Packing::SMALL,
    reynolds: 1.0,
    side_cells: 16,
    tau: 0.51,
    tolerance: 3e-4,
};

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let mut table = Table::new(&BedRun::COLUMNS);
    for reynolds in [1.0, 10.0, 30.0] {
        table.add(BedRun { reynolds, ..BED }.row(bench)?);
    }
    table.add(BedRun { collision: Preset::Srt, ..BED }.row(bench)?);
    table.add(BedRun { packing: Packing::Fcc, ..BED }.row(bench)?);
    if bench.is_full() {
        let packing = Packing::Random { side: 3.0, count: 31, seed: 1 };
        for reynolds in [1.0, 10.0, 30.0, 100.0] {
            table.add(BedRun { packing, reynolds, side_cells: 36, ..BED }.row(bench)?);
        }
    }
    Ok(table)
}

/// psi Re of the ordered bed for Re -> 0.
pub(super) fn ordered(golden: &Golden) -> Result<f64, CaseError> {
    let exact = golden.table("../sphere_arrays/literature.csv")?;
    let exact = exact.with(&[("lattice", "FCC"), ("solid_fraction_c", "0.6")])?;
    // psi Re = 18 ε³ K/φ
    Ok(18.0 * (1.0 - FCC_FRACTION).powi(3) / FCC_FRACTION * exact.number("K_computed")?)
}

/// psi Re of each row over the law of Beetstra et al. at its Re and porosity.
pub(super) fn over_law(rows: &Table) -> Result<Vec<f64>, CaseError> {
    over(BED_LAWS[3].psi_re, rows)
}

/// psi Re of each row over a law at its Re and porosity.
pub(super) fn over(law: fn(f64, f64) -> f64, rows: &Table) -> Result<Vec<f64>, CaseError> {
    let [re, psi_re, porosity] =
        [rows.numbers("Re")?, rows.numbers("psi_Re")?, rows.numbers("porosity")?];
    Ok((0..re.len()).map(|i| psi_re[i] / law(1.0 - porosity[i], re[i])).collect())
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let exact = ordered(golden)?;
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?;
        let random = own.with(&[("packing", "random 2")])?;
        let mrt = random.with(&[("collision", Preset::DHumieres.word())])?;
        for (reynolds, ratio) in mrt.values("Re_wanted")?.into_iter().zip(over_law(&mrt)?) {
            claims.push(Claim {
                what: format!("{engine}: 9 spheres, Re about {reynolds}: psi over Beetstra et al."),
                measured: ratio,
                allowed: 0.8..=1.2,
                why: "beds scatter about any law by 10 to 15 %, one of nine spheres no less; Tang's law is 5, 17 and 16 % above \
                      Beetstra's at these Re; 8 cells at tau = 0.51 are worth 1 % at Re = 1, where leaking and narrowed \
                      throats cancel, and 8 % at Re = 30 (study.csv)",
            });
        }
        // At the full scale only.
        let larger = own.with(&[("packing", "random 3")])?;
        for (reynolds, ratio) in larger.values("Re_wanted")?.into_iter().zip(over_law(&larger)?) {
            claims.push(Claim {
                what: format!(
                    "{engine}: 31 spheres at 12 cells, Re about {reynolds}: psi over Beetstra et al."
                ),
                measured: ratio,
                allowed: 0.9..=1.1,
                why: "one bed, of a kind that scatters by 6 % (study.csv); from 12 to 16 cells psi rises by 0.1, 0.5, 2 and \
                      7 % at Re = 1, 10, 30 and 100. Tang's law is 5, 17, 16 and 2 % above Beetstra's",
            });
        }
        let slow = |collision: &str| {
            random.with(&[("collision", collision), ("Re_wanted", "1")])?.number("psi_Re")
        };
        claims.push(Claim {
            what: format!("{engine}: 9 spheres, Re about 1: psi with SRT over that with MRT"),
            measured: slow(Preset::Srt.word())? / slow(Preset::DHumieres.word())?,
            allowed: 0.9..=1.1,
            why: "they differ in how the surface errs, 5 to 10 % where a throat is a cell wide",
        });
        let found = own.with(&[("packing", "fcc")])?.number("psi_Re")?;
        claims.push(Claim {
            what: format!("{engine}: ordered bed, 10.5 cells: psi over the exact one"),
            measured: found / exact,
            allowed: 0.9..=1.1,
            why: "exact to eight digits (golden/sphere_arrays); leaking takes 2.25 nu K/a2 = 3 % off at this \
                  tau, throats of 2 cells add about as much as that to either side; study.csv shows the limit",
        });
    }
    let (study, stability) = (golden.table("study.csv")?, golden.table("stability.csv")?);
    claims.extend(study::claims(&study, &stability, exact)?);
    claims.extend(inlet::claims(&golden.table("inlet.csv")?)?);
    claims.extend(full_size::claims(&golden.table("paper_size.csv")?)?);
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let (study, stability) = (golden.table("study.csv")?, golden.table("stability.csv")?);
    let inlet = golden.table("inlet.csv")?;
    let full_size = golden.table("paper_size.csv")?;
    figures::all(rows, &study, [&stability, &inlet, &full_size], ordered(golden)?)
}
