//! One run: its error against the truth, and what it cost.

use std::f64::consts::PI;
use std::path::Path;
use std::time::Instant;

use psmrt::engine::EngineName;
use psmrt_reference::lattice::viscosity;

use super::setting::{Literature, Setting};
use super::storage::rounded;
use crate::cases::{Bench, CaseError, Finished};
use crate::tradeoff::parameters::{Flow, Parameters};
use crate::tradeoff::row::Row;
use psmrt::exact::Comparison;
use psmrt::kernel::Gpu;
use psmrt::output::records::profile_rows;
use psmrt::run::{End, RunError};
use psmrt::scene::check::record_kinds::middle;
use std::sync::Arc;

/// Runs settings on the engines at hand.
pub struct Runner {
    oracle: Bench,
    cpu: Bench,
    kernel: Option<Bench>,
    literature: Literature,
    machine: String,
}

impl Runner {
    /// With the files of the folder `golden`, and the kernel on the device `gpu` if there is one.
    pub fn new(golden: &Path, gpu: Option<Arc<Gpu>>) -> Result<Self, CaseError> {
        let oracle = Bench::new(golden, EngineName::Reference, None, |_| {});
        let literature = Literature::of(&oracle)?;
        let kernel = gpu.map(|gpu| Bench::new(golden, EngineName::Wgpu, Some(gpu), |_| {}));
        let cpu = Bench::new(golden, EngineName::Cpu, None, |_| {});
        Ok(Runner { oracle, cpu, kernel, literature, machine: super::machine_words() })
    }

    /// Whether it can run these parameters here.
    pub fn can(&self, parameters: &Parameters) -> bool {
        parameters.engine != "wgpu" || self.kernel.is_some()
    }

    /// Makes one run. A run that breaks or does not become steady is a row too, without an error.
    pub fn measure(&mut self, parameters: &Parameters) -> Result<Row, CaseError> {
        let Setting { scene, changes, drag } = Setting::new(parameters, &self.literature)?;
        let on_kernel = parameters.engine == "wgpu";
        let bench = match &mut self.kernel {
            Some(kernel) if on_kernel => kernel,
            None if on_kernel => {
                return Err(CaseError::table("there is no adapter for engine wgpu".to_owned()));
            }
            _ if parameters.engine == "cpu" => &mut self.cpu,
            _ => &mut self.oracle,
        };
        let emulated = parameters.is_emulated();
        let start = Instant::now();
        let ended = if emulated {
            let scene = bench.load(&scene, &changes)?;
            let engine = rounded(&scene, parameters.storage)
                .map_err(|error| CaseError::table(error.to_string()))?;
            bench.run_on(scene, engine)
        } else {
            bench.run(&scene, &changes)
        };
        let seconds = start.elapsed().as_secs_f64();
        let mut row = Row {
            parameters: parameters.clone(),
            drag,
            error: None,
            end: String::new(),
            cells: 0,
            steps: 0,
            seconds,
            mebibytes: 0.0,
            machine: self.machine.clone(),
        };
        let (finished, end) = match ended {
            Ok(ended) => ended,
            Err(CaseError::Run(RunError::Stopped(stopped))) => {
                let text = stopped.to_string();
                let first = text.lines().next().unwrap_or("").replace([',', '"'], ";");
                row.end = format!("broken: {first}");
                return Ok(row);
            }
            Err(error) => return Err(error),
        };
        // A grain in a shaft is stopped after a time that its flow needs; all else must be steady.
        let steady = matches!(end, End::Steady { .. }) || parameters.flow == Flow::Settling;
        row.end = if steady { "steady" } else { "limit" }.to_owned();
        row.cells = finished.scene.setup.domain.cell_count() as u64;
        row.steps = finished.engine.steps();
        let bytes = EngineName::from_word(&parameters.engine).map_or(f64::NAN, |engine| {
            19.0 * f64::from(engine.copies()) * f64::from(engine.bytes_of_number())
        });
        row.mebibytes = row.cells as f64 * bytes / f64::from(1 << 20);
        if steady || emulated {
            row.error = Some(error(parameters, drag, &finished)?).filter(|error| error.is_finite());
        }
        Ok(row)
    }
}

/// The error: between plates that of the profile (relative L2), in arrays and ducts that of the
/// superficial velocity under a given force (which is that of the permeability), of a grain that of its
/// settling velocity; relative, signed but between plates.
fn error(parameters: &Parameters, drag: f64, run: &Finished) -> Result<f64, CaseError> {
    let setup = &run.scene.setup;
    let missing = |what: &str| CaseError::table(format!("{}: {what}", parameters.flow.word()));
    match parameters.flow {
        Flow::Poiseuille => {
            let exact = run.scene.exact.as_ref().ok_or_else(|| missing("no exact solution"))?;
            let middle = middle(&setup.domain);
            let profile = profile_rows(&run.scene, &run.engine, exact.across, middle);
            let along: Vec<f64> = profile.iter().map(|row| row[2 + exact.along]).collect();
            Ok(Comparison::new(exact, &along).relative_l2)
        }
        Flow::Settling => {
            let free = run.engine.free_grains().ok_or_else(|| missing("no free grain"))?;
            let grain = free.grains().first().ok_or_else(|| missing("no grain"))?;
            // The parameter is Stokes' velocity; walls divide it by the drag.
            Ok(-grain.velocity.z / parameters.lattice_velocity * drag - 1.0)
        }
        Flow::Sc | Flow::Bcc | Flow::Fcc | Flow::Seepage | Flow::SphereDrag | Flow::Random => {
            let d = parameters.cells_per_diameter().ok_or_else(|| missing("no diameter"))?;
            let count = parameters.flow.lattice().map_or(1, |(_, count)| count);
            let force = setup.body_force.map_or(0.0, |force| force.x);
            let means = run.engine.box_means();
            let velocity = means.mass_flux.x / means.density;
            // U = G V/(n 6π ν a K)
            let stokes = f64::from(count) * 3.0 * PI * viscosity(parameters.tau) * d;
            let exact = force * f64::from(parameters.cells).powi(3) / (stokes * drag);
            Ok(velocity / exact - 1.0)
        }
    }
}
