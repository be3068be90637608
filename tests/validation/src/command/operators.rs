//! `cargo validate operators`: the operators of the solid beside each other.

use std::fs;
use std::path::PathBuf;

use clap::Args;

use crate::cases::operators::SETS;
use crate::failure::Failure;
use psmrt::command::say::say;

/// What `cargo validate operators` is asked for.
#[derive(Args, Clone, Debug)]
pub struct OperatorsRequest {
    /// Table to make, several times for several: spinning, towed, stream, beds, ten_cate, limits, arrays; all where absent
    #[arg(value_name = "TABLE")]
    pub tables: Vec<String>,
    /// Folder of the tables; runs that are already there are not made again
    #[arg(long, value_name = "DIR", default_value = "out/operators")]
    pub out: PathBuf,
    /// Folder of the cases
    #[arg(long, value_name = "DIR", default_value = "golden")]
    pub golden: PathBuf,
}

/// Makes the tables. Errors if a name is none of theirs, a file cannot be used or a run cannot be made.
pub fn operators(request: &OperatorsRequest) -> Result<(), Failure> {
    let is_unknown = |name: &&String| SETS.iter().all(|set| set.name != **name);
    if let Some(unknown) = request.tables.iter().find(is_unknown) {
        let known: Vec<&str> = SETS.iter().map(|set| set.name).collect();
        let problem = format!("there is no table {unknown:?}; there are {}", known.join(", "));
        return Err(Failure::usage(problem));
    }
    fs::create_dir_all(&request.out).map_err(crate::cases::CaseError::from)?;
    for set in &SETS {
        if request.tables.is_empty() || request.tables.iter().any(|name| name == set.name) {
            let file = request.out.join(set.file());
            (set.make)(&request.golden, &file, &|row| say(&format!("{}: {row}", set.name)))?;
        }
    }
    Ok(())
}
