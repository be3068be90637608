//! `psmrt pack`: makes a packing of grains and writes it as a list that scenes read.

use std::fs::File;
use std::io::{BufWriter, ErrorKind, IsTerminal, Write};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::packing::bed::{BedSides, SettledBed};
use crate::packing::periodic::PeriodicPacking;
use crate::packing::{Packing, PackingError, PackingReport, radius_for};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use super::plan::part;
use super::say::say;
use super::{CommandError, write};
use crate::output::{atomic, grain_list};
use crate::packing::{Amount, FOLLOWS, Grading, Sizes};
use crate::scene::check::numbers::COEFFICIENTS;

/// What `psmrt pack` is asked for; lengths in m.
#[derive(Args, Clone, Debug)]
pub struct PackRequest {
    /// Lets the grains settle into a bed on z = 0 instead of packing a periodic domain
    #[arg(long)]
    pub bed: bool,
    /// Vertical walls at the sides of a bed instead of periodic ones
    #[arg(long, requires = "bed")]
    pub walls: bool,
    /// Lengths of the domain, m; for a bed x and y
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', required = true)]
    pub size: Vec<f64>,
    /// Diameter of the grains, m
    #[arg(long, value_name = "M")]
    pub diameter: Option<f64>,
    /// Largest diameter, m: sizes are uniformly distributed by number between --diameter and it
    #[arg(long, value_name = "M", requires = "diameter")]
    pub largest_diameter: Option<f64>,
    /// A sieve curve instead of --diameter: diameters, m, each with the share of the mass that is finer, from 0 to 1:
    /// 1e-4:0,2e-4:0.4,4e-4:1
    #[arg(long, value_name = "M:SHARE,...", value_delimiter = ',', conflicts_with_all = ["diameter", "largest_diameter"], value_parser = sieve)]
    pub grading: Vec<(f64, f64)>,
    /// Number of grains
    #[arg(long, value_name = "N")]
    pub count: Option<usize>,
    /// Void volume over volume, of a periodic packing: 0.4 or 40%
    #[arg(long, value_name = "N", value_parser = |text: &str| part(text, "40% or 0.4"))]
    pub porosity: Option<f64>,
    /// Friction while a bed settles; 0 gives the densest packing
    #[arg(long, value_name = "MU", default_value_t = 0.5)]
    pub friction: f64,
    /// Density of the grains for the list, kg/m3
    #[arg(long, value_name = "KG/M3")]
    pub density: Option<f64>,
    /// Seed; the same seed gives the same list
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The list (CSV)
    #[arg(long, value_name = "FILE", default_value = "grains.csv")]
    pub out: PathBuf,
    /// Replaces a list that is there already
    #[arg(long)]
    pub force: bool,
}

/// More grains are refused: they would take days.
const MOST_GRAINS: usize = 1_000_000;

/// Makes the packing, writes it and says what it is: as text, or as one JSON object.
pub fn pack(request: &PackRequest, json: bool) -> Result<(), CommandError> {
    let radii = radii(request)?;
    may_be_written(request)?;
    let start = Instant::now();
    let bar = spinner(request, radii.len(), json);
    let made = make(request, radii);
    bar.finish_and_clear();
    let packing = made.map_err(|error| wrong(error.to_string()))?;
    let PackingReport { porosity, coordination, largest_overlap } = packing.report;
    let comments = [
        format!("{} grains by psmrt {} pack", packing.grains.len(), env!("CARGO_PKG_VERSION")),
        format!(
            "{}, size {:?} m, seed {}{}",
            if request.bed { "settled bed" } else { "periodic packing" },
            request.size,
            request.seed,
            if request.bed { format!(", friction {}", request.friction) } else { String::new() }
        ),
        format!(
            "porosity {porosity:.6}{}, mean coordination number {coordination:.4}, largest overlap \
             {largest_overlap:.3e} diameters",
            if request.bed { " (middle half)" } else { "" }
        ),
    ];
    let text = grain_list::to_csv(&packing.grains, request.density, &comments);
    save(request, &text)?;
    let seconds = start.elapsed().as_secs_f64();
    let top = packing.grains.iter().map(|grain| grain.position.z + grain.radius);
    let top = top.fold(0.0, f64::max);
    if json {
        let found = json!({
            "file": request.out.display().to_string(), "grains": packing.grains.len(), "porosity": porosity,
            "coordination": coordination, "largest_overlap": largest_overlap,
            "height_m": top, "seconds": seconds,
        });
        say(&found.to_string());
        return Ok(());
    }
    let middle = if request.bed { " (middle half of the bed)" } else { "" };
    say(&format!("grains               {}", packing.grains.len()));
    say(&format!("porosity             {porosity:.4}{middle}"));
    say(&format!("coordination number  {coordination:.3} (mean)"));
    say(&format!("largest overlap      {largest_overlap:.2e} diameters"));
    if request.bed {
        say(&format!("height               {top:.4e} m"));
    }
    say(&format!("time                 {seconds:.1} s"));
    say(&format!("list in {}", request.out.display()));
    Ok(())
}

fn make(request: &PackRequest, radii: Vec<f64>) -> Result<Packing, PackingError> {
    if !request.bed {
        let lengths = std::array::from_fn(|axis| request.size[axis]);
        return PeriodicPacking::new(lengths, radii, request.seed).make();
    }
    let lengths = std::array::from_fn(|axis| request.size[axis]);
    let sides = if request.walls { BedSides::Walls } else { BedSides::Periodic };
    let (friction, seed) = (request.friction, request.seed);
    SettledBed { lengths, sides, radii, friction, seed }.make()
}

/// Radii of the grains; errors at options that make no sense.
fn radii(request: &PackRequest) -> Result<Vec<f64>, CommandError> {
    let positive = |name: &str, value: f64| match value > 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(wrong(format!("--{name} {value}: it must be positive and finite"))),
    };
    request.size.iter().try_for_each(|&length| positive("size", length))?;
    request.diameter.iter().try_for_each(|&diameter| positive("diameter", diameter))?;
    request.density.iter().try_for_each(|&density| positive("density", density))?;
    if !COEFFICIENTS.contains(&request.friction) {
        let (low, high) = (COEFFICIENTS.start(), COEFFICIENTS.end());
        let problem =
            format!("--friction {}: it must lie between {low} and {high}", request.friction);
        return Err(wrong(format!("{problem}; 0 packs dense, 0.5 is usual for sand")));
    }
    let axes = if request.bed { 2..=3 } else { 3..=3 };
    if !axes.contains(&request.size.len()) {
        return Err(wrong("--size: give the lengths x,y,z in m (for a bed x,y)".to_owned()));
    }
    if request.count.is_some_and(|count| count == 0 || count > MOST_GRAINS) {
        return Err(wrong(format!("--count must lie between 1 and {MOST_GRAINS}")));
    }
    let volume: f64 = request.size.iter().product();
    let amount = match (request.count, request.porosity) {
        (_, Some(_)) if request.bed => {
            let problem = "--porosity: a bed finds its own; --friction sets how dense it gets";
            return Err(wrong(problem.to_owned()));
        }
        (None, Some(porosity)) if porosity > 0.0 && porosity < 1.0 => {
            Amount::Volume { volume: (1.0 - porosity) * volume, most: MOST_GRAINS }
        }
        (_, Some(porosity)) if !(porosity > 0.0 && porosity < 1.0) => {
            return Err(wrong(format!("--porosity {porosity}: it must lie between 0 and 1")));
        }
        (Some(count), porosity) => match (request.diameter, porosity) {
            (None, Some(_)) if !request.grading.is_empty() => {
                let problem =
                    "--count, --porosity and --grading: give --grading and one of the others";
                return Err(wrong(problem.to_owned()));
            }
            (None, Some(porosity)) => {
                return Ok(vec![radius_for(porosity, count, volume); count]);
            }
            (Some(_), Some(_)) => {
                let problem = "--count, --porosity and --diameter: give two of them";
                return Err(wrong(problem.to_owned()));
            }
            (_, None) => Amount::Count(count),
        },
        (None, _) => return Err(wrong("give --count, or --porosity".to_owned())),
    };
    let none = || {
        wrong(format!(
            "there would be no grain, or more than {MOST_GRAINS}: change size or diameter"
        ))
    };
    if !request.grading.is_empty() {
        let grading = Grading::new(&request.grading)
            .map_err(|problem| wrong(format!("--grading: {problem}")))?;
        let (radii, scale) = grading.radii(amount, request.seed).ok_or_else(none)?;
        if (scale - 1.0).abs() > FOLLOWS {
            return Err(wrong(format!(
                "--grading: {} grains do not follow so wide a curve: their diameters come out {:.0} % off; take more, or cut its \
                 coarse end off",
                radii.len(),
                100.0 * (scale - 1.0).abs()
            )));
        }
        return Ok(radii);
    }
    let Some(low) = request.diameter else {
        return Err(wrong("give --diameter, in m, or --grading".to_owned()));
    };
    let high = request.largest_diameter.unwrap_or(low);
    if !(high >= low && high.is_finite()) {
        return Err(wrong(format!("--largest-diameter {high}: it must be at least {low}")));
    }
    let sizes = Sizes { diameters: [low, high], seed: request.seed };
    sizes.radii(amount).ok_or_else(none)
}

/// A sieve of `--grading`.
fn sieve(text: &str) -> Result<(f64, f64), String> {
    let numbers = text.split_once(':').and_then(|(diameter, share)| {
        Some((diameter.trim().parse().ok()?, share.trim().parse().ok()?))
    });
    numbers.ok_or_else(|| "give DIAMETER:SHARE, for example 2e-4:0.4".to_owned())
}

/// Errors if the list may not have the name that was asked for.
fn may_be_written(request: &PackRequest) -> Result<(), CommandError> {
    let out = &request.out;
    let name = out.display();
    let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        let folder = folder.display();
        return Err(wrong(format!("--out {name}: there is no folder {folder}: make it first")));
    }
    // Of a link this is the link itself: it would be replaced, and not what it leads to.
    let found = match out.symlink_metadata() {
        Ok(found) => found.file_type(),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) => return Err(wrong(format!("--out {name}: {error}"))),
    };
    let problem = if found.is_symlink() {
        "is a link: name the file that it leads to"
    } else if found.is_dir() {
        "is a folder: name a file in it"
    } else if !found.is_file() {
        "is a device, pipe or socket and no file: name a file"
    } else if !request.force {
        "is there already: name another file, or add --force"
    } else {
        return Ok(());
    };
    Err(wrong(format!("--out {name} {problem}")))
}

/// Writes the list. What has appeared under its name in the meantime stays, unless it may be replaced; the
/// list then gets the next free name.
fn save(request: &PackRequest, text: &str) -> Result<(), CommandError> {
    let out = &request.out;
    let fill = |file: &mut BufWriter<File>| file.write_all(text.as_bytes());
    if request.force {
        may_be_written(request)?;
        return write(out, |path| atomic::write(path, fill));
    }
    let is_there = |error: &std::io::Error| error.kind() == ErrorKind::AlreadyExists;
    match atomic::write_new(out, fill) {
        Err(error) if is_there(&error) => {}
        written => return write(out, |_| written),
    }
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let suffix = out.extension().map_or_else(String::new, |s| format!(".{}", s.to_string_lossy()));
    for number in 2_u64.. {
        let other = out.with_file_name(format!("{stem}-{number}{suffix}"));
        match atomic::write_new(&other, fill) {
            Err(error) if is_there(&error) => {}
            written => {
                write(&other, |_| written)?;
                return Err(wrong(format!(
                    "--out {} has appeared while the grains were packed and stays; the list is in {}",
                    out.display(),
                    other.display()
                )));
            }
        }
    }
    Err(wrong(format!("--out {}: every number is taken", out.display())))
}

/// Shows that it works, and for how long; how long it will take is not known.
fn spinner(request: &PackRequest, count: usize, json: bool) -> ProgressBar {
    if json || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed} so far") {
        bar.set_style(style);
    }
    let what = if request.bed { "grains settle" } else { "grains are pushed apart" };
    bar.set_message(format!("{count} {what}"));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

fn wrong(problem: String) -> CommandError {
    CommandError::Usage(problem)
}
