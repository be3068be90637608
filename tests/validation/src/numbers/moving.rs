//! Numbers of grains that move.

use std::path::Path;

use super::{COLLISION, Number, Quantity, TAU, of_operator, table};
use crate::cases::{CaseError, onsets, viscosity, wet_restitutions};

pub(super) fn numbers(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let mut all = vec![torque(golden)?];
    all.extend(shafts(golden)?);
    all.extend(tanks(golden)?);
    all.extend(suspensions(golden)?);
    all.extend(lifted(golden)?);
    all.push(viscosity_of_a_sphere(golden)?);
    all.extend(rebounds(golden)?);
    Ok(all)
}

/// The torque on a sphere that turns in still water, with the operator that is the default of moving grains.
fn torque(golden: &Path) -> Result<Number, CaseError> {
    let rows = table(golden, "operators/spinning.csv")?.with(&[
        ("collision", COLLISION),
        ("tau", TAU),
        ("operator", "bounce_back"),
    ])?;
    let errors = rows.points("cells_per_diameter", "error")?.into_iter();
    let number = Number {
        kind: Quantity::Torque,
        of: "sphere turning in a cube".to_owned(),
        case: "operators",
        source: "of a simple cubic array, 8 pi mu a³ omega/(1 - phi)",
        reference: 1.0,
        uncertainty: 0.0,
        grids: Vec::new(),
        on_front: Some("Torque on a sphere that turns in a cube two diameters wide, over theory"),
    };
    Ok(number.with_grids(errors.map(|(cells, error)| (cells, 1.0 + error)).collect()))
}

/// The velocity of a free grain in a shaft.
fn shafts(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let rows = of_operator(golden, "full_bounce_back")?.with(&[("case", "settling")])?;
    let each = rows.values("geometry")?.into_iter().map(|width| {
        let own = rows.with(&[("geometry", &width)])?;
        let reference = 1.0 / own.numbers("drag")?.first().copied().unwrap_or(f64::NAN);
        let errors = own.points("cells_per_diameter", "error")?.into_iter();
        let number = Number {
            kind: Quantity::Settling,
            of: format!("grain in a shaft, {width} of its width"),
            case: "stokes_settling",
            source: "method of fundamental solutions",
            reference,
            uncertainty: 0.0,
            grids: Vec::new(),
            on_front: (width == "0.25").then_some(
                "Settling velocity of a grain in a shaft of four diameters, over Stokes'",
            ),
        };
        let grids = errors.map(|(cells, error)| (cells, reference * (1.0 + error)));
        Ok(number.with_grids(grids.collect()))
    });
    each.collect()
}

/// The largest velocity of the spheres of ten Cate and others.
fn tanks(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let measured = table(golden, "ten_cate/literature.csv")?;
    let study = table(golden, "ten_cate/study.csv")?;
    let each = ["E1", "E2", "E3", "E4"].into_iter().map(|case| {
        let number = Number {
            kind: Quantity::Settling,
            of: format!("sphere in a tank, {case} of ten Cate et al."),
            case: "ten_cate",
            source: "experiment, ten Cate et al. 2002; digitised to 2 %",
            reference: measured.with(&[("case", case)])?.number("umax_exp_m_s")?,
            // Of the digitised curves; the experiment's own is not stated.
            uncertainty: 0.02,
            grids: Vec::new(),
            on_front: (case == "E1")
                .then_some("Largest velocity of a sphere that settles in a tank, Re 1.5, m/s"),
        };
        let own = study.with(&[("case", case)])?;
        Ok(number.with_grids(own.points("cells_per_diameter", "largest_velocity_m_s")?))
    });
    each.collect()
}

/// Cells across a grain of the suspensions, which were made on one grid.
const SUSPENSION_CELLS: f64 = 6.0;

/// The mean velocity in dilute suspensions, beside the far field of the same spheres.
fn suspensions(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let study = table(golden, "suspension/study.csv")?.with(&[("tau", "0.7"), ("grains", "40")])?;
    let mut all = Vec::new();
    for fraction in ["0.02", "0.05", "0.1"] {
        let own = study.with(&[("wanted_solid_fraction", fraction)])?;
        for (velocity, far) in own.points("velocity", "far_field_box")? {
            all.push(Number {
                kind: Quantity::Settling,
                of: format!("40 spheres at random, solid fraction {fraction}"),
                case: "suspension",
                source: "far field of the same spheres, which leaves out what close ones do to each other",
                reference: far,
                uncertainty: 0.05,
                grids: vec![(SUSPENSION_CELLS, velocity)],
                on_front: None,
            });
        }
    }
    Ok(all)
}

/// The velocity at which water lifts a bed.
fn lifted(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let number = |(bed, cells, found, law): (String, f64, f64, f64)| Number {
        kind: Quantity::Fluidization,
        of: bed,
        case: "fluidization",
        source: "Tang et al. 2015 at the bed's porosity; laws of this kind differ by up to a fifth at these Reynolds numbers",
        reference: law,
        uncertainty: 0.2,
        grids: vec![(cells, found)],
        on_front: None,
    };
    Ok(onsets(golden)?.into_iter().map(number).collect())
}

/// What a sphere alone adds to the viscosity of sheared water, with the same operator.
fn viscosity_of_a_sphere(golden: &Path) -> Result<Number, CaseError> {
    let found = viscosity::of_a_sphere_alone(&table(golden, "viscosity/study.csv")?)?;
    let own = found
        .into_iter()
        .filter(|([operator, tau, _], ..)| operator == "bounce_back" && tau == "1");
    let number = Number {
        kind: Quantity::Viscosity,
        of: "sphere in sheared water".to_owned(),
        case: "viscosity",
        source: "Einstein 1911",
        reference: table(golden, "viscosity/literature.csv")?.number("intrinsic_viscosity")?,
        uncertainty: 0.0,
        grids: Vec::new(),
        on_front: Some("Intrinsic viscosity of a sphere alone in sheared water"),
    };
    Ok(number.with_grids(own.map(|(_, cells, value)| (cells, value)).collect()))
}

/// By how much measured restitutions scatter round a common curve (golden/wet_rebound/literature.csv).
const SCATTER_OF_REBOUNDS: f64 = 0.1;

/// The restitution of a wet impact over the dry one: measured ones where a course is at hand, else the fit.
fn rebounds(golden: &Path) -> Result<Vec<Number>, CaseError> {
    let study = table(golden, "wet_rebound/study.csv")?;
    let each = wet_restitutions(golden)?.into_iter().map(|(stokes, reference, is_measured)| {
        let rows = study.with(&[
            ("St", &stokes),
            ("lubrication", "always"),
            ("cutoff_cells", "1"),
            ("smallest_over_radius", "0.001"),
            ("contact_steps", "0.1"),
            ("cells_per_step", "0.1"),
        ])?;
        let number = Number {
            kind: Quantity::Rebound,
            of: format!("sphere on a wall, St {stokes}"),
            case: "wet_rebound",
            source: if is_measured {
                "experiment, Gondret et al. 2002"
            } else {
                "Legendre et al. 2005: exp(-35/St), about which experiments scatter"
            },
            reference,
            uncertainty: SCATTER_OF_REBOUNDS / reference,
            grids: Vec::new(),
            on_front: None,
        };
        Ok(number.with_grids(rows.points("cells_per_diameter", "restitution")?))
    });
    each.collect()
}
