//! `cargo validate report`: every case measured on every engine at hand, judged and drawn on one page.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use psmrt_report::{
    Appendix, DataTable, Figure, Found, Page, Section, Verdict, render_page, render_svg,
};

use super::environment::environment;
use super::report_claims::{merged, print, written};
use super::report_files::{self, command, copies, measured};
use super::report_request::ReportRequest;
use crate::cases::{Bench, CASES, Case, CaseError, Claim, Golden, Settled, drawn, steadiness};
use crate::failure::Failure;
use crate::history::History;
use crate::numbers::agreement::{self, agreement};
use crate::numbers::front::{headlines, picture};
use crate::numbers::numbers;
use psmrt::command::execute::interruption;
use psmrt::command::progress::ProgressLine;
use psmrt::command::say::tell;
use psmrt::command::write;
use psmrt::engine::EngineName;
use psmrt::kernel::Gpu;
use psmrt::output::atomic;
use psmrt::provenance;
use psmrt::table::Table;

/// Makes the report. Errors if a case cannot be measured or a claim fails; the page is written first.
pub fn report(request: &ReportRequest, json: bool) -> Result<(), Failure> {
    let start = Instant::now();
    let cases = chosen(&request.cases)?;
    let gpu = if request.oracle_only { None } else { Gpu::open(None).ok() };
    let interrupted = interruption();
    let is_at_hand = |engine: &EngineName| match engine {
        EngineName::Reference => true,
        EngineName::Cpu | EngineName::CpuSingle => !request.oracle_only,
        EngineName::Wgpu => gpu.is_some(),
    };
    let engines = EngineName::ALL.into_iter().filter(is_at_hand);
    let mut benches: Vec<Bench> =
        engines.map(|engine| bench(engine, gpu.clone(), request, json, &interrupted)).collect();
    fs::create_dir_all(&request.out).map_err(CaseError::from)?;
    let history = History::committed();
    let (mut sections, mut timings, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for (number, case) in cases.iter().enumerate() {
        tell(&format!("{} of {}: {}", number + 1, cases.len(), case.title));
        let mut section = empty(case, request)?;
        match fill(&mut section, case, &mut benches, &mut timings, request, &history) {
            Err(Failure::Case(error)) if !matches!(error, CaseError::Interrupted) => {
                section.verdicts = vec![broken(&error)];
            }
            other => all.push((case.name, other?)),
        }
        sections.push(section);
    }
    let scale = if request.full { "full scale" } else { "quick scale" };
    let numbers = numbers(&request.golden)?;
    let page = Page {
        title: "psmrt: validation report".to_owned(),
        lead: "psmrt simulates grains in water, grain by grain: lattice Boltzmann with partially saturated cells, and a \
               discrete element method. This page holds it to exact solutions, published tables and experiments."
            .to_owned(),
        headlines: headlines(&numbers),
        picture: Some(picture()),
        agreement: Some(agreement(&numbers)),
        about: vec![
            "The first table: what an independent source says, what psmrt finds on its finest committed grid, and the grid's \
             uncertainty (the grid convergence index of Celik et al. 2008, from three grids; exact references have no \
             uncertainty of their own). Where the error lies outside both, the grids do not converge to the reference as the index \
             takes it: the case says why. An index above 3 % is that of a grid too coarse to say anything."
                .to_owned(),
            "Each claim says what was measured, what is allowed and why so much; an unsteady run is never judged. Each \
             case is measured on every engine at hand, and every claim is made of each: where engines share a claim, \
             their values stand in one row. Figures show the oracle's points and, as circles round them, those of the \
             kernel, or of the CPU engine in single precision where there is no adapter; those of the other engines are in \
             the tables."
                .to_owned(),
            format!(
                "Made on {} by psmrt at {}. All claims with their values as a table: claims.csv beside this page.",
                provenance::today(),
                provenance::program()
            ),
        ],
        sections,
        appendices: vec![Appendix {
            name: "errata".to_owned(),
            markdown: include_str!("../../../../reference/ERRATA.md").to_owned(),
        }],
        timings: DataTable {
            caption: format!(
                "Wall-clock time of each case's runs at the {scale}, set-up included: what this report cost on \
                 this machine, not a benchmark."
            ),
            columns: ["case", "engine", "seconds", "cell updates", "million a second"]
                .map(str::to_owned)
                .to_vec(),
            rows: timings,
        },
        environment: environment(
            gpu.as_deref(),
            &request.golden,
            scale,
            start.elapsed().as_secs_f64(),
        ),
    };
    let html = render_page(&page).map_err(CaseError::from)?;
    let index = request.out.join("index.html");
    write(&index, |path| atomic::write(path, |out| out.write_all(html.as_bytes())))?;
    write(&request.out.join("claims.csv"), |path| {
        atomic::write(path, |out| out.write_all(written(&all).to_csv().as_bytes()))
    })?;
    write(&request.out.join("agreement.csv"), |path| {
        let rows = agreement::rows(&numbers).to_csv();
        atomic::write(path, |out| out.write_all(rows.as_bytes()))
    })?;
    print(&page, &index, json);
    if request.open {
        open(&index);
    }
    if page.holds() { Ok(()) } else { Err(Failure::ClaimsFail) }
}

/// The cases of these names, all where there are none. Errors if there is no such case.
fn chosen(names: &[String]) -> Result<Vec<&'static Case>, Failure> {
    if let Some(name) = names.iter().find(|name| CASES.iter().all(|case| case.name != **name)) {
        let known: Vec<_> = CASES.iter().map(|case| case.name).collect();
        let problem = format!("--case {name}: no such case; there are {}", known.join(", "));
        return Err(Failure::usage(problem));
    }
    let wanted = |case: &&Case| names.is_empty() || names.iter().any(|name| name == case.name);
    Ok(CASES.iter().filter(wanted).collect())
}

/// Runs scenes on one engine, with a bar for each.
fn bench(
    engine: EngineName,
    gpu: Option<Arc<Gpu>>,
    request: &ReportRequest,
    json: bool,
    interrupted: &Arc<AtomicBool>,
) -> Bench {
    let interrupted = Arc::clone(interrupted);
    let bench = Bench::new(&request.golden, engine, gpu, |what| tell(&format!("  {what}")))
        .watched(Box::new(move |scene| {
            Box::new(ProgressLine::new(scene, json, Arc::clone(&interrupted)))
        }));
    if request.full { bench.at_full_scale(&request.out.join("runs")) } else { bench }
}

/// What the section of a case holds whatever its runs do.
fn empty(case: &Case, request: &ReportRequest) -> Result<Section, Failure> {
    Ok(Section {
        picture: None,
        film: None,
        name: case.name.to_owned(),
        title: case.title.to_owned(),
        about: case.about.iter().map(|&text| text.to_owned()).collect(),
        verdicts: Vec::new(),
        figures: Vec::new(),
        tables: Vec::new(),
        scenes: report_files::scenes(case, request)?,
        data: Vec::new(),
        command: command(case, request),
        full: case.full.to_owned(),
    })
}

/// Measures a case, judges it and draws it, and returns its claims. The section stays as it was if that fails.
fn fill(
    section: &mut Section,
    case: &Case,
    benches: &mut [Bench],
    timings: &mut Vec<Vec<String>>,
    request: &ReportRequest,
    history: &History,
) -> Result<Vec<Claim>, Failure> {
    let golden = Golden::of(case, &request.golden);
    (section.picture, section.film) = report_files::media(case, request)?;
    let (mut rows, mut read) = (Table::default(), BTreeSet::new());
    let (mut steady, mut settled) = (Vec::new(), Table::new(&SETTLED));
    for bench in benches {
        // What is judged from committed results is the same on every engine.
        if case.scenes.is_empty() && bench.engine_name() != EngineName::Reference {
            continue;
        }
        let (start, updates) = (Instant::now(), bench.cell_updates());
        rows.append(bench.measure(case)?);
        read.extend(bench.tables_read());
        let (seconds, updates) = (start.elapsed().as_secs_f64(), bench.cell_updates() - updates);
        if updates > 0 {
            timings.push(vec![
                case.name.to_owned(),
                bench.engine_name().word().to_owned(),
                format!("{seconds:.1}"),
                updates.to_string(),
                format!("{:.1}", updates as f64 / seconds / 1e6),
            ]);
        }
        let (engine, runs) = (bench.engine_name().word(), bench.settled());
        steady.extend(steadiness(engine, &runs));
        runs.iter().for_each(|run| settled.add(settled_row(engine, run)));
    }
    let mut claims = (case.judge)(&golden, &rows)?;
    claims.extend(steady);
    let shown = if case.scenes.is_empty() { rows.clone() } else { drawn(&rows) };
    let (figures, undrawn) = drawable((case.draw)(&golden, &shown)?);
    section.data.push(measured(case, &rows, &read, request)?);
    read.extend(golden.tables_read());
    read.extend(case.literature.iter().map(|&file| file.to_owned()));
    section.data.extend(copies(case, read.iter().map(String::as_str), request)?);
    section.data.extend(report_files::figures(case, &figures, &request.out)?);
    section.verdicts = merged(case.name, &claims, history).into_iter().chain(undrawn).collect();
    section.figures = figures;
    section.tables = [("What was measured", rows), ("How steady the runs were", settled)]
        .into_iter()
        .filter(|(_, table)| !table.rows.is_empty())
        .map(|(caption, Table { columns, rows })| DataTable {
            caption: caption.to_owned(),
            columns,
            rows,
        })
        .collect();
    Ok(claims)
}

/// Columns of the table of steady runs: relative changes of the column that the scene names.
const SETTLED: [&str; 6] =
    ["engine", "run", "steps", "tolerance", "change in the last window", "still to go"];

fn settled_row(engine: &str, run: &Settled) -> Vec<String> {
    let Settled { run, steps, tolerance, change, left } = run;
    let numbers = [tolerance, change, left].map(|value| format!("{value:.1e}"));
    [vec![engine.to_owned(), run.clone(), steps.to_string()], numbers.to_vec()].concat()
}

/// The figures that can be drawn, and a red verdict for each that cannot: results that are badly wrong, such as
/// a drag of 0 on a logarithmic axis, must not take the page with them.
fn drawable(figures: Vec<Figure>) -> (Vec<Figure>, Vec<Verdict>) {
    let (mut drawn, mut undrawn) = (Vec::new(), Vec::new());
    for figure in figures {
        match render_svg(&figure) {
            Ok(_) => drawn.push(figure),
            Err(error) => undrawn.push(Verdict {
                claim: format!("the figure {:?} can be drawn", figure.title),
                found: red(error.to_string()),
                allowed: "every point has a place on its axes".to_owned(),
                why: "a figure without what was found would hide it".to_owned(),
            }),
        }
    }
    (drawn, undrawn)
}

/// The verdict on a case that could not be measured: red, with the reason.
fn broken(error: &CaseError) -> Verdict {
    Verdict {
        claim: "it can be measured".to_owned(),
        found: red(error.to_string()),
        allowed: "runs to its end".to_owned(),
        why: "a run that stops has no result".to_owned(),
    }
}

/// Instead of a number.
fn red(measured: String) -> Vec<Found> {
    vec![Found { by: String::new(), measured, holds: false, history: Vec::new() }]
}

/// Opens the page; a machine without a browser still has the file.
fn open(index: &Path) {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(target_os = "windows") {
        "explorer"
    } else {
        "xdg-open"
    };
    if let Err(error) = std::process::Command::new(program).arg(index).spawn() {
        tell(&format!("the page cannot be opened with {program}: {error}"));
    }
}

#[cfg(test)]
mod tests {
    use super::drawable;
    use psmrt_report::{Axis, Figure, Series};

    #[test]
    fn a_figure_that_cannot_be_drawn_is_a_red_verdict_and_the_others_stay() {
        let figure = |title: &str, y: f64| {
            let empty = Figure::new(title, Axis::linear("Re"), Axis::log("C_D"));
            empty.with(Series::points("found", vec![(1.0, 1.0), (2.0, y)]))
        };
        let (drawn, undrawn) = drawable(vec![figure("good", 2.0), figure("bad", 0.0)]);
        assert_eq!(drawn.len(), 1);
        assert_eq!(drawn[0].title, "good");
        assert_eq!(undrawn.len(), 1);
        assert!(!undrawn[0].holds() && undrawn[0].claim.contains("bad"), "{}", undrawn[0].claim);
    }
}
