//! `cargo validate stability`: where the method is stable and where it is accurate.

use std::path::PathBuf;

use clap::Args;

use crate::failure::Failure;
use crate::stability::record::RunLog;
use crate::stability::{FLOWS, Flow, Lab, map};
use psmrt::command::say::say;
use psmrt::engine::EngineName;
use psmrt::kernel::Gpu;

/// What `cargo validate stability` is asked for.
#[derive(Args, Clone, Debug)]
pub struct StabilityRequest {
    /// Flow to map, several times for several; all where absent
    #[arg(value_name = "FLOW")]
    pub flows: Vec<String>,
    /// Folder of the records; runs that are already there are not made again
    #[arg(long, value_name = "DIR", default_value = "out/stability")]
    pub out: PathBuf,
    /// Only the oracle, even where there is an adapter
    #[arg(long)]
    pub oracle_only: bool,
}

/// Maps the flows, on both engines where there is an adapter. Errors if a name is no flow, a record cannot
/// be used or the device fails.
pub fn stability(request: &StabilityRequest) -> Result<(), Failure> {
    let wanted =
        |flow: &&Flow| request.flows.is_empty() || request.flows.iter().any(|w| w == flow.name);
    if let Some(unknown) = request.flows.iter().find(|w| FLOWS.iter().all(|flow| flow.name != **w))
    {
        let known: Vec<&str> = FLOWS.iter().map(|flow| flow.name).collect();
        let problem = format!("there is no flow {unknown:?}; there are {}", known.join(", "));
        return Err(Failure::usage(problem));
    }
    let gpu = if request.oracle_only { None } else { Gpu::open(None).ok() };
    if gpu.is_none() {
        say("without an adapter: the oracle alone");
    }
    let lab = Lab { gpu };
    for flow in FLOWS.iter().filter(wanted) {
        let mut record = RunLog::open(flow, &request.out)?;
        for engine in [EngineName::Reference, EngineName::Wgpu] {
            if engine == EngineName::Reference || lab.gpu.is_some() {
                map(flow, engine, &lab, &mut record, |row| say(&format!("{}: {row}", flow.name)))?;
            }
        }
    }
    Ok(())
}
