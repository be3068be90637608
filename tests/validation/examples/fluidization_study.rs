//! The full form of fluidization: beds of 110 grains of fine, medium and coarse sand, to their onset and expanded.
//!
//! Adds a row for each level of each run to `golden/fluidization/study.csv` as it goes; runs that have rows are left out, so
//! that it can be cut off and started again. Half an hour on two cores.
//!
//! ```text
//! cargo run --release -p psmrt-validation --example fluidization_study
//! ```
//!
//! `--changes NAME` prints the changes of `golden/fluidization/bed.toml` that make a run, one a line, as `psmrt run --set` takes them; with
//! the folder of such a run and its name it adds that run's rows instead:
//!
//! ```text
//! cargo run --release -p psmrt-validation --example fluidization_study out/medium "medium sand"
//! ```

use std::error::Error;
use std::path::Path;

use psmrt::engine::EngineName;
use psmrt::scene::Scene;
use psmrt::table::Table;
use psmrt_validation::cases::{
    BedRecords, Bench, FLUIDIZED_BEDS, FluidizedBed, Study, rows_of_bed,
};

const STUDY: &str = "golden/fluidization/study.csv";

fn main() -> Result<(), Box<dyn Error>> {
    let engine = EngineName::CpuSingle;
    let study = Study::new(STUDY);
    let named = |name: &str| {
        FLUIDIZED_BEDS
            .iter()
            .find(|run| run.name == name)
            .ok_or_else(|| format!("no run is named {name:?}"))
    };
    match &std::env::args().skip(1).collect::<Vec<_>>()[..] {
        [word, name] if word == "--changes" => {
            named(name)?.changes().iter().for_each(|change| println!("{change}"));
        }
        [folder, name] => add(&study, &of_folder(Path::new(folder), named(name)?)?)?,
        _ => {
            let mut bench = Bench::new(Path::new("golden"), engine, None, |_| {});
            for run in &FLUIDIZED_BEDS {
                if study.row(&format!("{},{},", engine.word(), run.name))?.is_none() {
                    add(&study, &run.rows(&mut bench)?)?;
                }
            }
        }
    }
    Ok(())
}

fn add(study: &Study, rows: &[Vec<String>]) -> Result<(), Box<dyn Error>> {
    let lines: Vec<String> = rows.iter().map(|row| row.join(",")).collect();
    study.add(&lines.join("\n"))?;
    println!("{}", lines.join("\n"));
    Ok(())
}

/// The rows of a run that `psmrt run` has made. Errors if its folder holds another scene.
fn of_folder(folder: &Path, run: &FluidizedBed) -> Result<Vec<Vec<String>>, Box<dyn Error>> {
    let scene = Scene::load(&folder.join("scene.toml"), &[])?;
    let wanted = Scene::load(Path::new("golden/fluidization/bed.toml"), &run.changes())?;
    if scene.setup != wanted.setup || scene.drives != wanted.drives {
        return Err(
            format!("the scene of {} is not that of {:?}", folder.display(), run.name).into()
        );
    }
    let record = |name: &str| Table::read(&folder.join(format!("{name}.csv")));
    let records =
        BedRecords { walls: record("walls")?, means: record("means")?, layers: record("layers")? };
    Ok(rows_of_bed(&scene, &records, (EngineName::CpuSingle.word(), run.name))?)
}
