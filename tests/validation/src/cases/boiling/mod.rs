//! A bed that boils: the upward gradient at which nothing rests on the sieve below it any more.

use psmrt_report::{Axis, Figure, Series};

use super::found::found;
use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::in_time::FaceSignal;
use psmrt::table::Table;

/// A boiling bed.
pub const CASE: Case = Case {
    name: "boiling",
    title: "A bed of sand boils at Terzaghi's critical gradient",
    about: &[
        "Water flows upwards through a bed of free grains on a sieve, between periodic sides; the pressure below is raised in steps \
         beyond the critical one and lowered again. Whatever the packing, the weight less buoyancy that still rests on the sieve \
         is F = W' - dP A (dP the drop of pressure, A the area): it falls on a straight line and is gone at dP = W'/A, which is \
         Terzaghi's critical gradient i_c = (rho_s/rho_f - 1)(1 - n), n the porosity (Erdbaumechanik, 1925). Then the bed rises \
         as a plug.",
        "What the contacts press on the sieve with comes from the springs of the grains, the drop from the two faces: the balance \
         between them goes through every cell that grains cover, so that it fails if the fluid's force on a grain is wrong by \
         a thousandth. It does not depend on how well the grid resolves the grains (8 cells per diameter).",
        "i/i_c is dP A/W'. Rise: of the mean height of the grains above that at the start of the flow, in diameters.",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv"],
    rows: "expected.csv",
    studies: &[],
    units: "time_s in seconds; i_over_critical, base_over_weight and rise_diameters without units",
    full: "the case is whole as it is",
    measure,
    judge,
    draw,
};

/// When the head begins to rise, s.
const START: f64 = 0.03;

/// Ends of the times in which the head is held, s, before the bed lifts, after that, and after the head is lowered again.
const HELD: [f64; 3] = [0.03, 0.06, 0.09];
const LIFTED: f64 = 0.12;
const HIGHEST: f64 = 0.15;
const LOWERED: f64 = 0.24;

/// A mean at the end of such a time is over so much of it, s: what swings dies away or averages out.
const SPAN: f64 = 0.01;

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let (run, _) = bench.run("boiling/scene.toml", &[])?;
    let scene = &run.scene;
    let Some(part) = &scene.free else {
        return Err(CaseError::table("the scene needs free grains".to_owned()));
    };
    let units = &scene.units;
    let Some(FaceSignal::Density(head)) = scene.drives.as_ref().map(|drives| &drives.faces[2][0])
    else {
        return Err(CaseError::table("the scene needs a head that changes in time".to_owned()));
    };
    let [nx, ny, _] = scene.setup.domain.cells().map(|n| n as f64 * units.si_dx);
    let gravity = part.settings.gravity.map_or(0.0, |gravity| gravity.acceleration().norm());
    let volume = |radius: f64| psmrt_reference::grains::grain::sphere_volume(radius);
    // (m_s - m_f) g
    let weights = part.grains.iter().map(|grain| (grain.mass - volume(grain.radius)) * gravity);
    let si_weight = weights.sum::<f64>() * units.si_force();
    let diameter = part.grains.first().map_or(f64::NAN, |grain| 2.0 * grain.radius * units.si_dx);
    let walls = run.record("walls")?.with(&[("face", "z_low")])?;
    let times = walls.numbers("time (s)")?;
    let base = walls.numbers("grain_force_z (N)")?;
    let heights = run.record("means")?.numbers("z (m)")?;
    let start = times.iter().position(|&time| time >= START).unwrap_or(0);
    let mut table =
        Table::new(&["engine", "time_s", "i_over_critical", "base_over_weight", "rise_diameters"]);
    for (number, &time) in times.iter().enumerate() {
        let si_head = units.si_gauge_pressure(head.at(time / units.si_dt));
        let ratio = si_head * nx * ny / si_weight;
        table.add(vec![
            bench.engine_name().word().to_owned(),
            format!("{time:.5e}"),
            format!("{ratio:.5}"),
            format!("{:.6}", -base[number] / si_weight),
            format!("{:.6}", (heights[number] - heights[start]) / diameter),
        ]);
    }
    Ok(table)
}

/// The rows of an engine as (time, i/i_c, F/W', rise).
fn course(rows: &Table, engine: &str) -> Result<Vec<[f64; 4]>, CaseError> {
    let own = rows.with(&[("engine", engine)])?;
    let [time, ratio, base, rise] =
        ["time_s", "i_over_critical", "base_over_weight", "rise_diameters"]
            .map(|name| own.numbers(name));
    let (time, ratio, base, rise) = (time?, ratio?, base?, rise?);
    Ok((0..time.len()).map(|i| [time[i], ratio[i], base[i], rise[i]]).collect())
}

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let course = course(rows, &engine)?;
        let mean = |until: f64, value: fn(&[f64; 4]) -> f64| {
            let held = course.iter().filter(|row| (until - SPAN..=until).contains(&row[0]));
            let (sum, count) = held.fold((0.0, 0.0), |(sum, n), row| (sum + value(row), n + 1.0));
            sum / count
        };
        let off = |row: &[f64; 4]| row[2] - (1.0 - row[1]);
        claims.push(Claim {
            what: format!(
                "{engine}: largest distance of the force on the sieve from the straight line at 0, 0.5 and 0.98 i_c, over the weight"
            ),
            measured: HELD.into_iter().map(|until| mean(until, off).abs()).fold(0.0, f64::max),
            allowed: 0.0..=1e-3,
            why: "exact at rest; what still swings and the water that still gains momentum average out to less than a thousandth",
        });
        claims.push(Claim {
            what: format!("{engine}: force on the sieve at 1.02 i_c, over the weight"),
            measured: mean(LIFTED, |row| row[2]),
            allowed: 0.0..=1e-3,
            why: "Terzaghi's gradient to 2 %: at 0.98 the line leaves 0.02, at 1.02 the bed has lifted",
        });
        claims.push(Claim {
            what: format!("{engine}: rise of the bed at 1.37 i_c, in diameters"),
            measured: course.iter().rfind(|row| row[0] <= HIGHEST).map_or(f64::NAN, |row| row[3]),
            allowed: 0.02..=2.0,
            why: "the plug rises with k g/nu (i - i_c), 0.02 diameters in 0.02 s for Kozeny and Carman's 4e-11 m2, faster as it \
                  loosens. It is what tells a bed that boils from one that stays, not a measure of how fast",
        });
        claims.push(Claim {
            what: format!("{engine}: distance from the straight line after the head is lowered again, over the weight"),
            measured: mean(LOWERED, off).abs(),
            allowed: 0.0..=5e-3,
            why: "the bed falls back on the sieve until 0.05 s before; a mean over 0.01 s of what still swings",
        });
    }
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut figure = Figure::new(
        "What rests on the sieve as the head rises and falls",
        Axis::linear("i/i_c").range(0.0, 1.4),
        Axis::linear("force on the sieve over weight less buoyancy").range(-0.05, 1.05),
    )
    .with(Series::dashed(
        "exact: 1 - i/i_c",
        golden.table("literature.csv")?.points("i_over_critical", "base_over_weight")?,
    ));
    let engines = rows.values("engine")?;
    // Every tenth row: marks side by side.
    let thinned = |engine: &str, column: usize| -> Result<Vec<(f64, f64)>, CaseError> {
        let rows = course(rows, engine)?;
        let flows = rows.iter().filter(|row| row[0] >= START).step_by(10);
        Ok(flows.map(|row| (row[1], row[column])).collect())
    };
    for engine in &engines {
        figure = figure.with(found("", engine, thinned(engine, 2)?, None));
    }
    figure = figure.with_panel(Axis::linear("rise (diameters)"));
    for engine in &engines {
        figure = figure.with(found("", engine, thinned(engine, 3)?, None));
    }
    Ok(vec![figure.note(
        "18 grains of 8 cells; head raised to 0.5, 0.98, 1.02 and 1.37 i_c, held 0.02 s each, and lowered to 0.27 i_c",
    )])
}
