//! A cloud of grains in a closed box: the paper's section 7, reduced.

use std::collections::BTreeMap;

use psmrt_report::{Axis, Figure, Series};

use super::found::found;
use super::{Bench, Case, CaseError, Claim, Golden, Table};

/// A settling cloud.
pub const CASE: Case = Case {
    name: "cloud_settling",
    title: "A cloud of grains settles in a closed box (section 7, reduced)",
    about: &[
        "The paper lets 12,000 grains of 4 cells settle in a closed box, solid fraction 6.3 %, and shows that \
         the grains in the core fall faster than those near the vertical walls. Here are 122 of them in a \
         hundredth of the volume. The velocity downwards is averaged over layers one diameter thick by their \
         distance to the nearest vertical wall, after the flow has become steady (1.2 times the slowest \
         viscous time of the box) and before any grain has fallen half a diameter.",
        "full.csv holds 975 grains in a box eight times as large: the profile goes on rising inwards over eight \
         diameters.",
        "The mean velocity, beside that of single grains alone in the same box at the same distances from the wall \
         (alone.csv, same grid), is the effect of the others: hindered settling.",
        "At 4 cells per diameter and tau = 1 the drag of a grain errs by a third (golden/sphere_arrays/study.csv): \
         the profile is the claim, not the velocity itself.",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv"],
    rows: "expected.csv",
    units: "velocity_m_s in m/s, downwards; wall_distance_diameters in diameters",
    full: "cargo run --release -- report --full --case cloud_settling lets 975 grains settle, as full.csv holds; an hour. The paper's 12,000: psmrt run golden/cloud_settling/paper.toml --engine wgpu, 3 s a step on two cores",
    measure,
    judge,
    draw,
};

/// Layers by distance to the nearest vertical wall, in diameters: the last takes all beyond.
const LAYERS: [&str; 4] = ["0 to 1", "1 to 2", "2 to 3", "3 and more"];

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    // 1,000 steps of 2.67e-5 s; records only at the end. At the full scale eight times the volume, for
    // two viscous times of the box.
    let changes = if bench.is_full() {
        [
            "stop.time=0.084".to_owned(),
            "records[1].every_steps=3150".to_owned(),
            "domain.cells=[72, 72, 100]".to_owned(),
        ]
        .to_vec()
    } else {
        ["stop.time=0.0267".to_owned(), "records[1].every_steps=1000".to_owned()].to_vec()
    };
    let (run, _) = bench.run("cloud_settling/scene.toml", &changes)?;
    let loads = run.record("loads")?;
    let last = loads.values("step")?.pop().unwrap_or_default();
    let loads = loads.with(&[("step", &last)])?;
    let units = &run.scene.units;
    let [width, depth, _] = run.scene.setup.domain.cells().map(|n| n as f64 * units.si_dx);
    let [x, y, velocity, diameter] = [
        loads.numbers("x (m)")?,
        loads.numbers("y (m)")?,
        loads.numbers("velocity_z (m/s)")?,
        loads.numbers("diameter (m)")?,
    ];
    let mut layers: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for i in 0..x.len() {
        let wall = x[i].min(y[i]).min(width - x[i]).min(depth - y[i]) / diameter[i];
        let layer = (1..LAYERS.len()).rev().find(|&n| wall >= n as f64).unwrap_or(0);
        layers.entry(layer).or_default().push(-velocity[i]);
    }
    let mut table = Table::new(&["engine", "wall_distance_diameters", "grains", "velocity_m_s"]);
    for (layer, velocities) in layers {
        table.add(vec![
            bench.engine_name().word().to_owned(),
            LAYERS[layer].to_owned(),
            velocities.len().to_string(),
            format!("{:.5e}", velocities.iter().sum::<f64>() / velocities.len() as f64),
        ]);
    }
    Ok(table)
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    let alone = golden.table("alone.csv")?;
    let laws = golden.table("literature.csv")?;
    let law = |name: &str| laws.with(&[("law", name)])?.number("velocity_over_alone");
    for engine in rows.values("engine")? {
        let velocity = |layer: &str| {
            rows.with(&[("engine", &engine), ("wall_distance_diameters", layer)])?
                .number("velocity_m_s")
        };
        let [wall, next, inner, core] = [
            velocity(LAYERS[0])?,
            velocity(LAYERS[1])?,
            velocity(LAYERS[2])?,
            velocity(LAYERS[3])?,
        ];
        claims.push(Claim {
            what: format!("{engine}: velocity in the core over that beside the vertical walls"),
            measured: core / wall,
            allowed: 1.2..=2.0,
            why: "the paper's finding is its being above 1; a wall at one radius or two doubles a grain's drag \
                  at most (Faxen), and some 20 grains in a layer scatter by 10 %",
        });
        claims.push(Claim {
            what: format!("{engine}: least growth of the velocity from layer to layer inwards"),
            measured: (next / wall).min(inner / next).min(core / inner),
            allowed: 1.0..=2.0,
            why: "it grows from the wall to the core, as the paper's pictures show",
        });
        let (mut sum, mut sum_alone) = (0.0, 0.0);
        for layer in LAYERS {
            let own = rows.with(&[("engine", &engine), ("wall_distance_diameters", layer)])?;
            let grains = own.number("grains")?;
            sum += grains * own.number("velocity_m_s")?;
            let alone = alone.with(&[("wall_distance_diameters", layer)])?;
            sum_alone += grains * alone.number("velocity_m_s")?;
        }
        claims.push(Claim {
            what: format!("{engine}: mean velocity over that of single grains in the same places"),
            measured: sum / sum_alone,
            allowed: law("Batchelor 1972")?..=law("Richardson & Zaki 1954")?,
            why: "hindered settling: between Batchelor's 1 - 6.55 phi (1972, random places) and Richardson & \
                  Zaki's (1 - phi)^4.65 (1954, experiments)",
        });
    }
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut figure = Figure::new(
        "Settling cloud: velocity against distance to the vertical walls",
        Axis::linear("distance to the nearest vertical wall (diameters)").range(0.0, 9.0),
        Axis::linear("mean velocity downwards (m/s)").range(0.0, 2.2e-3),
    );
    for engine in rows.values("engine")? {
        let velocities = rows.with(&[("engine", &engine)])?.numbers("velocity_m_s")?;
        // The middle of each layer; the core reaches to 4.5 diameters.
        let points = [0.5, 1.5, 2.5, 3.75].into_iter().zip(velocities).collect();
        figure = figure.with(found("122 grains", &engine, points, None));
    }
    let full = golden.table("full.csv")?.points("layer_from_diameters", "velocity_m_s")?;
    let full = full.into_iter().map(|(from, velocity)| (from + 0.5, velocity)).collect();
    figure = figure.with(Series::line_points("975 grains, wgpu (full.csv)", full));
    Ok(vec![figure.note("4 cells per diameter, tau = 1; layers one diameter thick")])
}
