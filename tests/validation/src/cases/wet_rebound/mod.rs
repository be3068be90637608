//! A sphere that falls in a viscous liquid onto a wall and rebounds, against measurements.

mod fall;
mod figures;
mod study;

use std::path::Path;

use psmrt_report::Figure;

use super::{Bench, Case, CaseError, Claim, Golden};
use fall::{Fall, JUDGED, Liquid, at};
use psmrt::table::Table;

pub use fall::WetRebound;
pub use study::wet_rebounds;

/// The wet rebound.
pub const CASE: Case = Case {
    name: "wet_rebound",
    title: "A sphere falls in a viscous liquid onto a wall and rebounds (Gondret et al. 2002)",
    about: &[
        "A steel sphere falls in silicone oil onto a plate. How much of its velocity is left after the impact depends on the Stokes \
         number St = rho_p U d/(9 mu), inertia over viscous forces: nothing below 10, nearly all of the dry restitution e_dry above \
         1000. Here the rebound is the mean velocity in the first quarter of d/U after the impact, over the velocity at a gap of one \
         diameter before it, of psmrt and of the measured course alike; measured restitutions scatter by about 0.1 round a common \
         curve, which is what is allowed.",
        "Three models take part. The grid resolves the flow down to gaps of about a cell; lubrication ([lubrication]) adds what is \
         missing down to the smallest gap, the roughness, which the measurements do not name: psmrt's default here, a thousandth of the radius. \
         A spring with e_dry makes the contact, a tenth of a time step long: lubrication acts as long as they touch, and in a contact of 10 \
         steps takes the whole rebound at St 27. With `lubrication.while_touching = false` it does not, and contacts of 10 to 40 steps come out \
         alike.",
        "What does not agree: from St 100 on the rebound is 0.1 too slow, on each grid. In a real impact, a hundred times as long as sound takes \
         across the sphere, the fluid round it turns round with it; in one shorter than a step only the sphere does, and the added mass of the \
         fluid takes a tenth of the velocity off again. A longer contact is no cure: as long as the sphere overlaps the wall, what it displaces \
         from the cells at the wall resists it both ways, by as much (figures below). The first bounds, 0.1 for each restitution, hold at St 27 and \
         100 and failed at 152 and 742; the height of the rebound at St 27, 0.56 of the measured, is at the edge of what was allowed.",
        "The quick form is the impact at St 27 on 12 cells per diameter in a narrower shaft, from two diameters above the wall; study.csv has the others, courses.csv the courses of four of them.",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv", "bounces.csv"],
    rows: "expected.csv",
    studies: &["study.csv", "courses.csv"],
    units: "time_d_over_u: since the end of the contact, in diameters over the nominal velocity; gap in diameters, velocity over the nominal one, upwards",
    full: "cargo run --release -p psmrt-validation --example wet_rebound_study made study.csv and courses.csv (half an hour; it can be cut off)",
    measure,
    judge,
    draw,
};

/// The impact of scene.toml.
pub const QUICK: WetRebound = WetRebound { shaft: [2, 4, 2], after: 0.8, ..study::BASE };

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let literature = bench.literature(CASE.name, "literature.csv")?;
    let fall = QUICK.run(bench, &literature)?;
    let mut table = Table::new(&["engine", "time_d_over_u", "gap", "velocity"]);
    for row in &fall.course {
        let mut words = vec![bench.engine_name().word().to_owned()];
        words.extend(row.iter().map(|value| format!("{value:.5}")));
        table.add(words);
    }
    Ok(table)
}

/// The measured gap over the diameter against the time since contact in units of `d/U`, where there is one.
fn measured(bounces: &Table, liquid: &Liquid, stokes: &str) -> Result<Vec<(f64, f64)>, CaseError> {
    let own = bounces.with(&[("St", stokes)])?.points("t_s", "gap_m")?;
    Ok(own.into_iter().map(|(t, gap)| (t / liquid.time(), gap / liquid.diameter)).collect())
}

/// The measured rebound as it is read off the computed ones: the sphere comes with `U`.
fn measured_restitution(measured: &[(f64, f64)], liquid: &Liquid) -> f64 {
    at(measured, JUDGED) / (JUDGED * liquid.dry)
}

/// Stokes numbers, restitutions over the dry one, and whether they are measured (else the fit's). Errors if a table cannot be
/// read.
pub fn wet_restitutions(golden: &Path) -> Result<Vec<(String, f64, bool)>, CaseError> {
    let golden = Golden::of(&CASE, golden);
    let (literature, bounces) = (golden.table("literature.csv")?, golden.table("bounces.csv")?);
    let each = literature.values("St")?.into_iter().map(|stokes| {
        let liquid = Liquid::of(&literature, &stokes)?;
        let course = measured(&bounces, &liquid, &stokes).unwrap_or_default();
        let is_measured = !course.is_empty();
        let fit = literature.with(&[("St", &stokes)])?.number("legendre")?;
        let value = if is_measured { measured_restitution(&course, &liquid) } else { fit };
        Ok((stokes, value, is_measured))
    });
    each.collect()
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let (literature, bounces) = (golden.table("literature.csv")?, golden.table("bounces.csv")?);
    let liquid = Liquid::of(&literature, QUICK.stokes)?;
    let expected = measured_restitution(&measured(&bounces, &liquid, QUICK.stokes)?, &liquid);
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let own = rows.with(&[("engine", &engine)])?;
        let [times, gaps, velocities] =
            ["time_d_over_u", "gap", "velocity"].map(|name| own.numbers(name));
        let (times, gaps, velocities) = (times?, gaps?, velocities?);
        let course = (0..times.len()).map(|row| [times[row], gaps[row], velocities[row]]).collect();
        let fall = Fall::of(course, &liquid);
        claims.push(Claim {
            what: format!("{engine}: St 27, 12 cells per diameter: restitution over the dry one, less the measured {expected:.3}"),
            measured: fall.restitution - expected,
            allowed: -0.1..=0.1,
            why: study::SCATTER,
        });
    }
    claims.extend(study::claims(&golden.table("study.csv")?, &literature, &bounces)?);
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    figures::all(golden, rows)
}
