//! `cargo validate speed`: cell updates per second of the engines, in turns.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use psmrt::command::say::{say, tell};
use psmrt::command::{CommandError, write};
use psmrt::engine::EngineName;
use psmrt::kernel::Gpu;
use psmrt::output::atomic;
use psmrt::{machine, provenance};

use crate::failure::Failure;
use crate::speed::clock::{Stream, seconds_of, spread};
use crate::speed::work::{Work, advance, bytes_per_update, start, works};

/// What `cargo validate speed` is asked for.
#[derive(Args, Clone, Debug)]
pub struct SpeedRequest {
    /// Cells along each edge of the domain
    #[arg(long, value_name = "CELLS", default_value_t = 128)]
    pub side: usize,
    /// Threads, one number after the other [default: 1 and all]
    #[arg(long, value_name = "N")]
    pub threads: Vec<usize>,
    /// Rounds, in each of which everything is measured once
    #[arg(long, value_name = "N", default_value_t = 5)]
    pub rounds: usize,
    /// Also the kernel, on this adapter (a part of its name) or the fastest kind
    #[arg(long, value_name = "ADAPTER", num_args = 0..=1, default_missing_value = "")]
    pub wgpu: Option<String>,
    /// Leave the oracle out
    #[arg(long)]
    pub no_oracle: bool,
    /// Only works whose name contains this
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
    /// File for the table
    #[arg(long, value_name = "FILE", default_value = "out/speed.csv")]
    pub out: PathBuf,
}

/// Seconds that one measurement takes, at least.
const SECONDS: f64 = 0.3;

/// One line of the table.
struct Line<'a> {
    engine: EngineName,
    work: &'a Work,
    /// Million cell updates per second, and the share of the bandwidth that they move, round by round.
    speeds: Vec<f64>,
    shares: Vec<f64>,
}

/// Measures, and writes the table. Errors if an engine cannot be started or fails.
pub fn speed(request: &SpeedRequest) -> Result<(), Failure> {
    let works = works(request.side).map_err(|error| Failure::usage(error.to_string()))?;
    let works: Vec<Work> = works
        .into_iter()
        .filter(|work| request.only.as_ref().is_none_or(|text| work.name.contains(text.as_str())))
        .collect();
    let mut engines = vec![EngineName::CpuSingle, EngineName::Cpu];
    let mut gpu = None;
    if let Some(name) = &request.wgpu {
        let adapter = Some(name.as_str()).filter(|name| !name.is_empty());
        gpu = Some(Gpu::open(adapter).map_err(CommandError::from)?);
        engines.push(EngineName::Wgpu);
    }
    if !request.no_oracle {
        engines.push(EngineName::Reference);
    }
    let all = machine::threads();
    let threads = match request.threads.as_slice() {
        [] if all > 1 => vec![1, all],
        [] => vec![1],
        threads => threads.to_vec(),
    };
    let mut text = format!(
        "# Million cell updates per second, {side}^3 cells: median, smallest and largest of {rounds} rounds; share: bytes\n\
         # moved (populations read and written) over what a loop in place moved in the same moment, median.\n\
         # Made by: cargo validate speed --side {side}, {program}, {today}\n\
         # Processor: {processor}, {all} threads\n\
         threads,engine,bytes,work,updates,low,high,share,gigabytes_per_second\n",
        side = request.side,
        rounds = request.rounds,
        program = provenance::program(),
        today = provenance::today(),
        processor = machine::processor().unwrap_or_else(|| "unknown".to_owned()),
    );
    for threads in threads {
        text += &table(request, threads, &engines, gpu.as_ref(), &works)?;
    }
    say(text.trim_end());
    write(&request.out, |file| atomic::write(file, |out| out.write_all(text.as_bytes())))?;
    tell(&format!("written: {}", request.out.display()));
    Ok(())
}

/// The lines for a number of threads.
fn table(
    request: &SpeedRequest,
    threads: usize,
    engines: &[EngineName],
    gpu: Option<&Arc<Gpu>>,
    works: &[Work],
) -> Result<String, Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Failure::usage(format!("--threads {threads}: {error}")))?;
    let cells = request.side.pow(3);
    let mut lines: Vec<Line> = works
        .iter()
        .flat_map(|work| engines.iter().map(move |&engine| (engine, work)))
        .map(|(engine, work)| Line { engine, work, speeds: Vec::new(), shares: Vec::new() })
        .collect();
    let mut stream = Stream::new(19 * 4 * cells);
    let mut bandwidths = Vec::new();
    for _ in 0..request.rounds {
        for line in &mut lines {
            let Line { engine, work, speeds, shares } = line;
            let before = stream.bandwidth(&pool);
            let updates = pool.install(|| measured(*engine, gpu, work, cells))?;
            let now = before.max(stream.bandwidth(&pool));
            bandwidths.push(now);
            speeds.push(updates / 1e6);
            shares.push(updates * bytes_per_update(*engine) as f64 / now);
        }
    }
    let mut text = String::new();
    for Line { engine, work, speeds, shares } in lines {
        let [updates, low, high] = spread(speeds);
        let [share, ..] = spread(shares);
        let moved = updates * 1e6 * bytes_per_update(engine) as f64 / 1e9;
        let (name, bytes) = (engine.word(), engine.bytes_of_number());
        let work = work.name.replace(',', ";");
        // A String takes everything.
        let _ = writeln!(
            text,
            "{threads},{name},{bytes},{work},{updates:.1},{low:.1},{high:.1},{share:.2},{moved:.1}"
        );
    }
    let [median, low, high] = spread(bandwidths).map(|bytes| bytes / 1e9);
    let _ = writeln!(text, "{threads},loop in place,4,bandwidth,,{low:.1},{high:.1},1,{median:.1}");
    Ok(text)
}

/// Cell updates per second.
fn measured(
    engine: EngineName,
    gpu: Option<&Arc<Gpu>>,
    work: &Work,
    cells: usize,
) -> Result<f64, Failure> {
    let failed =
        |error: String| Failure::usage(format!("{} on {}: {error}", work.name, engine.word()));
    let mut fluid = start(engine, gpu, &work.setup).map_err(|error| failed(error.to_string()))?;
    let mut steps = 1;
    // A run that has broken is over at once, however many steps it is asked for.
    let mut run = |steps: u64| {
        let mut end = Ok(());
        let seconds = seconds_of(|| end = advance(&mut fluid, work, steps));
        end.map(|()| seconds).map_err(|error| failed(error.to_string()))
    };
    // Memory is touched, shaders are compiled.
    run(2)?;
    let mut seconds = run(steps)?;
    while seconds < SECONDS {
        steps *= if seconds < 0.25 * SECONDS { 4 } else { 2 };
        seconds = run(steps)?;
    }
    Ok(cells as f64 * steps as f64 / seconds)
}
