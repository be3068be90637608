//! A column of spheres on springs under an upward flow: contact forces and settlements, which have a closed form.

mod figures;

use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::in_time::FaceSignal;
use psmrt::table::Table;

/// A column of spheres on springs.
pub const CASE: Case = Case {
    name: "spring_column",
    title: "A column of spheres on springs under an upward flow",
    about: &[
        "Suzuki et al. (2007) hold a DEM with flow to one dimension: a column of spheres that touch, in water that flows upwards. \
         Here ten spheres stand on a sieve in a square shaft with periodic sides, 1.5 diameters wide, their contacts linear springs \
         of one stiffness k, and the head below is held at four levels up to 0.85 of the critical one.",
        "The flow through a column that repeats itself is the same past every sphere, so that each passes on W' (1 - i/i_c): W' its weight \
         less buoyancy, i_c = (rho_s/rho_f - 1)(1 - n) Terzaghi's gradient, n the porosity of the shaft. With N - j spheres above it, \
         contact j (0: the sieve) has the force F_j = (N - j) W' (1 - i/i_c) and yields by F_j/k; the top lies N (N + 1)/2 (1 - i/i_c) W'/k \
         below its place without forces. Water that rises lifts the load off the springs and the column rises with it, on a straight line.",
        "A real column has ends: the first and the last sphere have a neighbour on one side only, and another drag. What is exact there \
         too is the balance of the slice from one plane of contact up to the top: F_j = (N - j) W' - (p_j - p_N) A, p_j the mean pressure in \
         the plane of contact j (record layers), A the section. So each contact is held to both, its force by the overlap of the spheres.",
        "Neither rests on how well the grid resolves the drag (6 cells per diameter let too much water through): drag and gradient are the \
         same forces. A first trial with spheres twice as large, Re = 1.4, was off the balance by 0.4 % of the weight, which is the flow's \
         inertia, rho U^2 over the head; these have Re = 0.2.",
    ],
    scenes: &["scene.toml"],
    literature: &["literature.csv"],
    rows: "expected.csv",
    studies: &[],
    units: "force, from_pressure: over the weight less buoyancy W' of a sphere; settlement: of the sphere above the contact, in W' over \
            the stiffness of the springs; i_over_critical and contact without units. Means over the last 2 ms of each level",
    full: "the case is whole as it is; the spheres of scene.toml are in column.csv",
    measure,
    judge,
    draw: figures::all,
};

/// Ends of the times in which the head is held, s, and over how much of each the mean is taken.
const HELD: [f64; 4] = [0.01, 0.026, 0.042, 0.058];
const SPAN: f64 = 0.002;

/// Spheres, and cells along the diameter of one.
const SPHERES: usize = 10;
const CELLS: usize = 6;

fn measure(bench: &mut Bench) -> Result<Table, CaseError> {
    let (run, _) = bench.run("spring_column/scene.toml", &[])?;
    let scene = &run.scene;
    let (Some(part), Some(FaceSignal::Density(head))) =
        (&scene.free, scene.drives.as_ref().map(|drives| &drives.faces[2][0]))
    else {
        return Err(CaseError::table("the scene needs free grains and a head that changes"));
    };
    let units = &scene.units;
    let [nx, ny, _] = scene.setup.domain.cells().map(|n| n as f64 * units.si_dx);
    let gravity = part.settings.gravity.map_or(0.0, |gravity| gravity.acceleration().norm());
    let Some(one) = part.grains.first() else {
        return Err(CaseError::table("the scene needs spheres"));
    };
    // (m_s - m_f) g
    let weight = psmrt_reference::grains::grain::sphere_volume(one.radius);
    let si_weight = (one.mass - weight) * gravity * units.si_force();
    let Some(law) = part.setup.law.linear() else {
        return Err(CaseError::table("the scene needs linear contacts"));
    };
    let si_stiffness = law.stiffness * units.si_stiffness();
    let si_diameter = 2.0 * one.radius * units.si_dx;
    let (loads, layers) = (run.record("loads")?, run.record("layers")?);
    let mut table = Table::new(&[
        "engine",
        "i_over_critical",
        "contact",
        "force",
        "from_pressure",
        "settlement",
    ]);
    for until in HELD {
        let held = |time: f64| (until - SPAN..until + 0.5 * units.si_dt).contains(&time);
        let si_head = units.si_gauge_pressure(head.at(until / units.si_dt));
        let ratio = si_head * nx * ny / si_weight / SPHERES as f64;
        let z = means(&loads, "z (m)", SPHERES, &held)?;
        let si_pressure = means(&layers, "pressure (Pa)", scene.setup.domain.cells()[2], &held)?;
        let plane = |contact: usize| match contact {
            0 => si_head,
            // Between the layers of cells on either side.
            _ => 0.5 * (si_pressure[contact * CELLS - 1] + si_pressure[contact * CELLS]),
        };
        let mut settlement = 0.0;
        for contact in 0..SPHERES {
            let gap = match contact {
                0 => z[0] - 0.5 * si_diameter,
                _ => z[contact] - z[contact - 1] - si_diameter,
            };
            let force = -gap * si_stiffness / si_weight;
            settlement += force;
            let above = (SPHERES - contact) as f64;
            let lift = (plane(contact) - plane(SPHERES)) * nx * ny / si_weight;
            table.add(vec![
                bench.engine_name().word().to_owned(),
                format!("{ratio:.5}"),
                contact.to_string(),
                format!("{force:.5}"),
                format!("{:.5}", above - lift),
                format!("{settlement:.5}"),
            ]);
        }
    }
    Ok(table)
}

/// Means over the times that are `held` of a column whose rows come in groups of `count`, one a time.
fn means(
    rows: &Table,
    column: &str,
    count: usize,
    held: &dyn Fn(f64) -> bool,
) -> Result<Vec<f64>, CaseError> {
    let (times, values) = (rows.numbers("time (s)")?, rows.numbers(column)?);
    let (mut sums, mut groups) = (vec![0.0; count], 0.0);
    for (times, values) in times.chunks(count).zip(values.chunks(count)) {
        if times.first().is_some_and(|&time| held(time)) {
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            groups += 1.0;
        }
    }
    Ok(sums.into_iter().map(|sum| sum / groups).collect())
}

/// Contacts at one level of the head, from the sieve up.
struct Level {
    ratio: f64,
    force: Vec<f64>,
    from_pressure: Vec<f64>,
    settlement: Vec<f64>,
}

fn levels(rows: &Table) -> Result<Vec<Level>, CaseError> {
    let each = rows.values("i_over_critical")?.into_iter().map(|ratio| {
        let own = rows.with(&[("i_over_critical", &ratio)])?;
        let values = |column| own.numbers(column);
        Ok(Level {
            ratio: own.numbers("i_over_critical")?[0],
            force: values("force")?,
            from_pressure: values("from_pressure")?,
            settlement: values("settlement")?,
        })
    });
    each.collect()
}

/// The closed form at the level of the same number: forces and settlements.
fn exact(golden: &Golden) -> Result<Vec<[Vec<f64>; 2]>, CaseError> {
    let table = golden.table("literature.csv")?;
    let each = table.values("i_over_critical")?.into_iter().map(|ratio| {
        let own = table.with(&[("i_over_critical", &ratio)])?;
        Ok([own.numbers("force")?, own.numbers("settlement")?])
    });
    each.collect()
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    // A NaN stays one: `max` would drop it.
    values
        .into_iter()
        .fold(0.0, |most: f64, value| if value > most || value.is_nan() { value } else { most })
}

fn judge(golden: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let exact = exact(golden)?;
    let mut claims = Vec::new();
    for engine in rows.values("engine")? {
        let levels = levels(&rows.with(&[("engine", &engine)])?)?;
        if levels.len() != exact.len() {
            return Err(CaseError::table(format!("{engine}: {} levels", levels.len())));
        }
        let whole = SPHERES as f64;
        let both = || levels.iter().zip(&exact);
        claims.push(Claim {
            what: format!("{engine}: force on the sieve, largest distance from N W' (1 - i/i_c), over N W'"),
            measured: largest(both().map(|(found, known)| (found.force[0] - known[0][0]).abs() / whole)),
            allowed: 0.0..=2e-3,
            why: "exact whatever the ends; rho U^2 is some 5e-4 of the head at Re = 0.2, and what still swings is as much",
        });
        let off = |level: &Level| {
            largest(level.force.iter().zip(&level.from_pressure).map(|(f, p)| (f - p).abs()))
        };
        claims.push(Claim {
            what: format!("{engine}: contact forces, largest distance from the balance with the measured pressures, over N W'"),
            measured: largest(levels.iter().map(off)) / whole,
            allowed: 0.0..=1e-2,
            why: "exact but for the mean pressure of a plane of contact, which lies between two layers of cells in which the drop per cell is \
                  1.7 % of the whole: half of that",
        });
        let apart = |(found, known): (&Level, &[Vec<f64>; 2])| {
            largest(found.force.iter().zip(&known[0]).map(|(f, k)| (f - k).abs())) / found.ratio
        };
        claims.push(Claim {
            what: format!("{engine}: contact forces under flow, largest distance from the closed form, over the drag of a sphere W' i/i_c"),
            measured: largest(both().skip(1).map(apart)),
            allowed: 0.0..=0.5,
            why: "the closed form has no ends: a sphere at an end has a neighbour on one side only, and so up to half of its drag may be \
                  different. All that the ends do to the column is to shift this much from one contact to another",
        });
        claims.push(Claim {
            what: format!("{engine}: largest difference of the drags of spheres that are neither at an end nor next to it, over W' i/i_c"),
            measured: largest(levels.iter().skip(1).map(interior)),
            allowed: 0.0..=0.03,
            why: "in a shaft of width w what an end does dies away as exp(-2 pi z/w), to 1.5 % over a sphere with w = 1.5 d, of the half of a drag \
                  above; the rest is what still swings",
        });
        claims.push(Claim {
            what: format!(
                "{engine}: settlement of the top under its own weight, over N (N + 1)/2 W'/k"
            ),
            measured: levels[0].settlement[SPHERES - 1] / exact[0][1][SPHERES - 1],
            allowed: 0.995..=1.005,
            why: "springs under known forces: exact but for what still swings",
        });
        let last = SPHERES - 1;
        let rise = |found: &Level| levels[0].settlement[last] - found.settlement[last];
        let known = |known: &[Vec<f64>; 2]| exact[0][1][last] - known[1][last];
        claims.push(Claim {
            what: format!("{engine}: rise of the top under flow over that of the closed form, the one that is off most"),
            measured: both().skip(1).map(|(found, closed)| rise(found) / known(closed)).fold(1.0, |worst: f64, ratio| {
                if (ratio - 1.0).abs() > (worst - 1.0).abs() || ratio.is_nan() { ratio } else { worst }
            }),
            allowed: 0.91..=1.09,
            why: "half a drag too much or too little in each of N contacts, of N (N + 1)/2 drags: 1/(N + 1)",
        });
    }
    Ok(claims)
}

/// The largest difference of the drags of spheres 2 to N - 3, over `W' i/i_c`.
fn interior(level: &Level) -> f64 {
    // A sphere takes from the force what its drag does not carry: D_j = W' - (F_j - F_(j+1)).
    let drag = |j: usize| (1.0 - (level.force[j] - level.force[j + 1])) / level.ratio;
    let drags: Vec<f64> = (2..SPHERES - 2).map(drag).collect();
    let most = drags.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = drags.iter().copied().fold(f64::INFINITY, f64::min);
    most - least
}
