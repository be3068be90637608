//! How fast the CPU engine is beside generated code, from the committed table (`docs/speed.md`).

use psmrt_report::{Axis, Figure, Series, Style};

use super::{Bench, Case, CaseError, Claim, Golden};
use psmrt::table::Table;

/// The CPU engine's speed.
pub const CASE: Case = Case {
    name: "cpu_speed",
    title: "The speed of the CPU engine",
    about: &[
        "Cell updates per second of the CPU engine over those of code that lbmpy generates for the same work, measured in \
         turns on one machine: 1 means as fast. Both update in place and move the same bytes; lbmpy's forces are not \
         added up for each solid, and are compared all the same.",
        "The table has the absolute figures, in million cell updates per second, and in its last rows the bandwidth of a \
         loop that changes numbers in place, in GB/s, measured in the same moments. A cell update moves 152 bytes in \
         single precision (38 populations) and 304 in double.",
        "The other figures: all engines on 64³ cells (engines.csv), the CPU engine from 16³ to 256³ cells (sizes.csv), and where a step of \
         the paper's 12,000 settling grains goes.",
    ],
    scenes: &[],
    literature: &[],
    rows: "rivals.csv",
    studies: &["engines.csv", "sizes.csv", PROFILE],
    units: "updates, low and high in million cell updates per second, of the loop in place in GB/s; bytes of a number",
    full: "cargo validate speed and tests/validation/rivals/lbmpy_speed.py made these rows in turns; an hour",
    measure: |bench: &mut Bench| bench.literature(CASE.name, CASE.rows),
    judge,
    draw,
};

/// Where a step of the paper's scene goes.
const PROFILE: &str = "../cloud_settling/paper_profile_cpu.csv";

/// What both have been timed at.
const WORKS: [&str; 3] = ["MRT", "PS-MRT; fixed bed of 0.6", "PS-MRT; fixed bed of 0.6; forces"];

/// Engine, bytes of a number and words.
const ENGINES: [(&str, &str, &str); 2] =
    [("cpu_single", "4", "single precision"), ("cpu", "8", "double precision")];

/// Million cell updates per second of the engine and of lbmpy.
fn both(
    rows: &Table,
    threads: &str,
    engine: &str,
    bytes: &str,
    work: &str,
) -> Result<[f64; 2], CaseError> {
    let own = |engine| {
        let wanted = [("threads", threads), ("engine", engine), ("bytes", bytes), ("work", work)];
        rows.with(&wanted)?.number("updates")
    };
    Ok([own(engine)?, own("lbmpy 2.1.1")?])
}

fn judge(_: &Golden, rows: &Table) -> Result<Vec<Claim>, CaseError> {
    let mut claims = Vec::new();
    for (engine, bytes, words) in ENGINES {
        let mut ratios = Vec::new();
        for threads in ["1", "2"] {
            for work in WORKS {
                let [own, other] = both(rows, threads, engine, bytes, work)?;
                ratios.push(own / other);
            }
        }
        claims.push(Claim {
            what: format!("CPU engine over lbmpy's code in {words}, the least of all works and threads"),
            measured: ratios.into_iter().fold(f64::INFINITY, f64::min),
            allowed: 0.5..=f64::INFINITY,
            why: "the same bytes and nearly the same arithmetic: half as fast would be a fault; less is within what forces \
                  for each solid, which lbmpy's code does not add up, and a shared machine may make",
        });
        let plain = rows.with(&[("threads", "2"), ("engine", engine), ("work", "MRT")])?;
        let bandwidth = rows.with(&[("threads", "2"), ("engine", "loop in place")])?;
        let number: f64 = if bytes == "4" { 4.0 } else { 8.0 };
        claims.push(Claim {
            what: format!("MRT in {words}: bytes moved over those of a loop in place, 2 threads"),
            measured: plain.number("updates")? * 1e-3 * 38.0 * number / bandwidth.number("updates")?,
            allowed: 0.25..=1.1,
            why: "memory cannot give more than it has, but for a tenth between one moment and the next; below a quarter of it \
                  the engine would be bound by something that it could do without",
        });
    }
    Ok(claims)
}

fn draw(golden: &Golden, rows: &Table) -> Result<Vec<Figure>, CaseError> {
    let mut names: Vec<String> = Vec::new();
    for work in WORKS.iter().rev() {
        for threads in ["2", "1"] {
            let word = if threads == "1" { "thread" } else { "threads" };
            names.push(format!("{work}, {threads} {word}"));
        }
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut figure = Figure::new(
        "The CPU engine over code that lbmpy generates",
        Axis::linear("cell updates per second over lbmpy's"),
        Axis::of_names(&names),
    )
    .size(800, 420);
    for (engine, bytes, words) in ENGINES {
        let mut points = Vec::new();
        for work in WORKS.iter().rev() {
            for threads in ["2", "1"] {
                let [own, other] = both(rows, threads, engine, bytes, work)?;
                points.push((own / other, points.len() as f64 + 1.0));
            }
        }
        figure = figure.with(Series::points(words, points));
    }
    let ends = vec![(1.0, 0.5), (1.0, names.len() as f64 + 0.5)];
    let figure = figure.with(Series::new("as fast", Style::Reference, ends));
    Ok(vec![
        figure
            .note("128³ cells, AVX-512; absolute figures and the memory's bandwidth in the table"),
        engines(&golden.table("engines.csv")?)?,
        sizes(&golden.table("sizes.csv")?)?,
        profile(&golden.table(PROFILE)?)?,
    ])
}

/// All engines, work by work.
fn engines(table: &Table) -> Result<Figure, CaseError> {
    let two = table.with(&[("threads", "2")])?;
    let mut works = two.with(&[("engine", "cpu")])?.values("work")?;
    works.reverse();
    let names: Vec<&str> = works.iter().map(String::as_str).collect();
    let mut figure = Figure::new(
        "All engines, 64³ cells, 2 threads",
        Axis::log("million cell updates per second"),
        Axis::of_names(&names),
    )
    .size(900, 480);
    for (engine, words) in [
        ("cpu_single", "CPU engine, single precision"),
        ("cpu", "CPU engine, double precision"),
        ("reference", "the oracle"),
    ] {
        let own = two.with(&[("engine", engine)])?;
        let each = works.iter().enumerate().map(|(place, work)| {
            Ok((own.with(&[("work", work)])?.number("updates")?, place as f64 + 1.0))
        });
        figure = figure.with(Series::points(words, each.collect::<Result<_, CaseError>>()?));
    }
    Ok(figure)
}

/// The CPU engine against the size of a cube.
fn sizes(table: &Table) -> Result<Figure, CaseError> {
    let mut figure = Figure::new(
        "The CPU engine by the size of a cube, 2 threads",
        Axis::log("cells along an edge").ticks(&[16.0, 32.0, 64.0, 128.0, 256.0]),
        Axis::linear("million cell updates per second").range(0.0, 320.0),
    );
    for (engine, _, words) in ENGINES {
        for work in table.values("work")? {
            let own = table.with(&[("engine", engine), ("work", &work)])?;
            let label = format!("{work}, {words}");
            figure = figure.with(Series::line_points(label, own.points("side", "updates")?));
        }
    }
    Ok(figure.note("median of three rounds; a machine that was shared while they ran"))
}

/// Where the time of a step of the paper's settling scene goes.
fn profile(table: &Table) -> Result<Figure, CaseError> {
    let ways = table.values("coverage")?;
    let mut figure = Figure::new(
        "A step of the paper's settling scene: 12,000 grains in 6.4 million cells",
        Axis::of_names(&ways.iter().map(String::as_str).collect::<Vec<_>>()),
        Axis::linear("seconds on the clock"),
    );
    for part in table.values("part")? {
        let own = table.with(&[("part", &part)])?;
        let each = own.numbers("seconds_on_the_clock")?;
        let points = each.into_iter().enumerate().map(|(place, s)| (place as f64 + 1.0, s));
        figure = figure.with(Series::points(part, points.collect()));
    }
    Ok(figure.note("by how solid fractions are found, and with which solid operator; CPU engine, single precision, 2 threads"))
}
