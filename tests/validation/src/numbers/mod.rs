//! The numbers that matter, which the report opens with: what an independent source says, what psmrt finds on its finest
//! committed grid, and how uncertain both are.

use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use psmrt::table::Table;
use psmrt_report::{Headline, Picture};

use crate::cases::{BED_LAWS, CaseError, drag_by_grid, in_open_water};
use psmrt::convergence::convergence;

/// One number: the reference, and psmrt's value on grids from coarse to fine.
struct Number {
    quantity: &'static str,
    case: &'static str,
    source: &'static str,
    reference: f64,
    /// Relative uncertainty of the reference; 0 where it is exact.
    uncertainty: f64,
    /// Cells and value.
    grids: Vec<(f64, f64)>,
}

/// All of them, from the committed tables of `golden`. Errors if one of these lacks what is needed.
pub fn headlines(golden: &Path) -> Result<Vec<Headline>, CaseError> {
    let numbers = [
        duct(golden)?,
        array(
            golden,
            ("sc", "0.343"),
            "Drag of a simple cubic array, solid fraction 0.343, over Stokes'",
        )?,
        array(
            golden,
            ("fcc", "0.6"),
            "Drag of a face-centred cubic array, solid fraction 0.6, over Stokes'",
        )?,
        sphere(golden, Sphere::Creeping)?,
        sphere(golden, Sphere::Re100)?,
        settling(golden)?,
        ten_cate(golden)?,
        seepage(golden)?,
    ];
    Ok(numbers.into_iter().map(headline).collect())
}

/// A picture of what is computed.
pub fn picture() -> Picture {
    Picture {
        png_base64: STANDARD.encode(include_bytes!("../../../docs/grains_in_water.png")),
        caption: "Grains that settle, coloured by how fast they fall, and the vertical velocity of the water between them \
                  (docs/grains_in_water.toml)"
            .to_owned(),
    }
}

fn headline(number: Number) -> Headline {
    let Number { quantity, case, source, reference, uncertainty, mut grids } = number;
    // Tables grow run by run, in any order.
    grids.sort_by(|a, b| a.0.total_cmp(&b.0));
    grids.dedup();
    let (cells, found) = grids.last().copied().unwrap_or((f64::NAN, f64::NAN));
    let error = found / reference - 1.0;
    let gci = convergence(&grids).map_or(f64::NAN, |found| found.gci);
    let percent = |share: f64| format!("{:.2} %", 100.0 * share);
    Headline {
        quantity: quantity.to_owned(),
        reference: match uncertainty {
            0.0 => format!("{reference:.4}"),
            _ => format!("{reference:.4} ± {:.1} %", 100.0 * uncertainty),
        },
        source: source.to_owned(),
        found: format!("{found:.4} ({cells:.0} cells)"),
        error: format!("{:+.2} %", 100.0 * error),
        uncertainty: percent(gci),
        is_within: error.abs() <= (uncertainty.powi(2) + gci.powi(2)).sqrt(),
        case: case.to_owned(),
    }
}

fn table(golden: &Path, file: &str) -> Result<Table, CaseError> {
    Ok(Table::read(&golden.join(file))?)
}

/// The mean velocity in a square duct.
fn duct(golden: &Path) -> Result<Number, CaseError> {
    let exact = table(golden, "duct/literature.csv")?
        .with(&[("aspect_short_over_long", "1")])?
        .number("umean_mu_over_G_shortside2")?;
    let rows = table(golden, "duct/expected.csv")?.with(&[("rates", "MRT_dHumieres")])?;
    let grids = rows.points("cells_across", "error_of_mean")?;
    Ok(Number {
        quantity: "Mean velocity in a square duct, over G a²/ν",
        case: "duct",
        source: "series",
        reference: exact,
        uncertainty: 0.0,
        grids: grids.into_iter().map(|(cells, error)| (cells, exact * (1.0 + error))).collect(),
    })
}

/// The relaxation time at which fixed beds are compared.
const TAU: &str = "0.6";

/// The drag of an array with the most accurate operator.
fn array(
    golden: &Path,
    (flow, fraction): (&str, &str),
    quantity: &'static str,
) -> Result<Number, CaseError> {
    let rows = table(golden, "tradeoff/operators.csv")?.with(&[
        ("case", flow),
        ("geometry", fraction),
        ("tau", TAU),
        ("collision", "MRT_dHumieres"),
        ("operator", "graded_viscosity"),
        ("coverage", "exact"),
    ])?;
    let reference = rows.numbers("drag")?.first().copied().unwrap_or(f64::NAN);
    // The table has the error of the velocity under a given force.
    let grids = rows.points("cells_per_diameter", "error")?.into_iter();
    Ok(Number {
        quantity,
        case: "tradeoff",
        source: "integral equation, which Zick & Homsy (1982) agree with",
        reference,
        uncertainty: 0.0,
        grids: grids.map(|(cells, error)| (cells, reference / (1.0 + error))).collect(),
    })
}

/// Which flow past a sphere.
#[derive(Clone, Copy, PartialEq)]
enum Sphere {
    /// Re = 0.1, in the paper's box, where the drag is known.
    Creeping,
    /// Re = 100, with the box's share taken off.
    Re100,
}

fn sphere(golden: &Path, flow: Sphere) -> Result<Number, CaseError> {
    let study = table(golden, "sphere_drag/study.csv")?;
    if flow == Sphere::Creeping {
        let reference = table(golden, "sphere_drag/duct.csv")?
            .with(&[("period_length_over_d", "10")])?
            .number("K_total_force_superficial_U")?;
        return Ok(Number {
            quantity: "Drag of a sphere in the paper's box, Re 0.1, over Stokes'",
            case: "sphere_drag",
            source: "integral equation; inertia adds less than its uncertainty",
            reference,
            uncertainty: 0.001,
            // C_D = 24 K/Re
            grids: drag_by_grid(&study, "0.1")?
                .into_iter()
                .map(|(n, drag)| (n, drag * 0.1 / 24.0))
                .collect(),
        });
    }
    let open = table(golden, "sphere_drag/literature.csv")?.with(&[("Re", "100")])?;
    let grids = drag_by_grid(&study, "100")?.into_iter();
    let grids = grids.map(|(n, drag)| Ok((n, in_open_water(&study, "100", drag)?)));
    Ok(Number {
        quantity: "Drag coefficient of a sphere in open water, Re 100",
        case: "sphere_drag",
        source: "axisymmetric Navier-Stokes; the box's share taken off by its width",
        reference: open.number("CD_computed")?,
        uncertainty: 0.003,
        grids: grids.collect::<Result<_, CaseError>>()?,
    })
}

/// The velocity of a free grain in a shaft.
fn settling(golden: &Path) -> Result<Number, CaseError> {
    let rows = table(golden, "tradeoff/operators.csv")?.with(&[
        ("case", "settling"),
        ("geometry", "0.25"),
        ("tau", TAU),
        ("collision", "MRT_dHumieres"),
        ("operator", "full_bounce_back"),
        ("coverage", "exact"),
    ])?;
    let reference = 1.0 / rows.numbers("drag")?.first().copied().unwrap_or(f64::NAN);
    let grids = rows.points("cells_per_diameter", "error")?.into_iter();
    Ok(Number {
        quantity: "Settling velocity of a grain in a shaft of four diameters, over Stokes'",
        case: "stokes_settling",
        source: "method of fundamental solutions",
        reference,
        uncertainty: 0.0,
        grids: grids.map(|(cells, error)| (cells, reference * (1.0 + error))).collect(),
    })
}

/// The largest velocity of the sphere of ten Cate and others, case E4.
fn ten_cate(golden: &Path) -> Result<Number, CaseError> {
    let measured = table(golden, "ten_cate/literature.csv")?.with(&[("case", "E4")])?;
    let study = table(golden, "ten_cate/study.csv")?.with(&[("case", "E4")])?;
    Ok(Number {
        quantity: "Largest velocity of a sphere that settles in a tank, Re 32, m/s",
        case: "ten_cate",
        source: "experiment, ten Cate et al. 2002; digitised to 2 %",
        reference: measured.number("umax_exp_m_s")?,
        // Of the digitised curves; the experiment's own is not stated.
        uncertainty: 0.02,
        grids: study.points("cells_per_diameter", "largest_velocity_m_s")?,
    })
}

/// The resistance of a random bed.
fn seepage(golden: &Path) -> Result<Number, CaseError> {
    let rows = table(golden, "seepage/study.csv")?.with(&[
        ("collision", "MRT_dHumieres"),
        ("weighting", "noble_torczynski"),
        ("spheres", "31"),
        ("seed", "1"),
        ("Re_wanted", "10"),
        ("tau", "0.51"),
        ("outcome", "steady"),
    ])?;
    let grids = rows.points("cells_per_diameter", "psi_Re")?;
    let last = |name: &str| rows.numbers(name).map(|all| all.last().copied().unwrap_or(f64::NAN));
    let reference = (BED_LAWS[3].psi_re)(1.0 - last("porosity")?, last("Re")?);
    Ok(Number {
        quantity: "Resistance psi Re of a random bed of spheres, porosity 0.40, Re 10",
        case: "seepage",
        source: "Beetstra et al. 2007, from particle-resolved computations",
        reference,
        // Of beds as small as this one, about the law: golden/seepage/study.csv.
        uncertainty: 0.1,
        grids,
    })
}
