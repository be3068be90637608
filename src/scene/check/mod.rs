//! Values that make sense: each section of a scene becomes its checked form in lattice units, or
//! one [`Trouble`] that names the key, what is allowed, and the remedy.

mod apart;
mod arrays;
pub mod attachment;
mod balance;
mod bodies;
mod body_forms;
pub mod checkpoint;
mod collision;
pub mod contact;
pub mod contact_values;
pub mod domain;
mod dry;
mod effort;
mod faces;
mod foreign_lists;
pub mod free;
mod generated;
mod grain_kinds;
pub mod grain_list;
pub mod grains;
pub(crate) mod hardness;
mod hertz;
mod implicit;
mod in_time;
pub mod initial;
mod list_header;
mod list_text;
mod listed;
mod lubrication;
mod maker;
mod mapped_columns;
mod mirrors;
pub(crate) mod neighbours;
pub(crate) mod numbers;
pub mod permeability;
mod placed_images;
pub mod record_kinds;
pub mod records;
mod signal_file;
mod solid;
pub mod stop;
mod time;
mod voxels;
mod vtk_file;
mod vtk_list;

use std::path::Path;

use psmrt_reference::coupling::{Gravity, balancing_force};
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::{Setup, SetupError};

use super::format::{FluidSection, SceneFile};
use super::format_run::{EngineSection, ExactName};
use super::format_time::VectorInTime;
use super::{EngineKind, Precision, Scene, Trouble};
use crate::exact::PlanePoiseuille;
use crate::in_time::{Drives, Signal};
use crate::units::Units;
use attachment::Attachment;
use free::FreePart;
use grains::GrainList;
use in_time::Files;
use numbers::{beyond, finite, positive, sane, shorter_step};
use signal_file::Subject;
use voxels::ListedImage;

/// Largest speed in lattice units that a scene may set: a Mach number of 0.35, beyond which the
/// error of compressibility is above a tenth.
pub const MAX_SPEED: f64 = 0.2;

/// Checks a scene; files that it names are looked for in `folder`.
pub fn scene(file: &SceneFile, folder: &Path) -> Result<Scene, Trouble> {
    let images = voxels::images(&file.grains, folder)?;
    let si_image = images.first().map(ListedImage::si_size);
    let is_dry = file.fluid.is_none();
    if is_dry {
        dry::check(file)?;
    }
    let cells = domain::cells(&file.domain, si_image, is_dry)?;
    let (units, tau) = match &file.fluid {
        Some(fluid) => {
            check_fluid(fluid)?;
            time::units_and_tau(&file.time, fluid, file.domain.dx)?
        }
        None => {
            let units = dry::units(&file.time, file.domain.dx)?;
            dry::slow_enough(file, &units)?;
            (units, dry::NOMINAL_TAU)
        }
    };
    let collision = collision::collision(&file.collision.clone().unwrap_or_default(), tau)?;
    let mut files = Files { folder, attachments: Vec::new() };
    let (faces, face_signals) = faces::faces(&file.faces, cells, &units, &mut files)?;
    let domain = Domain::new(cells, faces).map_err(|error| faces::trouble(&error))?;
    let mut setup = Setup::fluid(domain, collision);
    faces::check_later(&setup, &face_signals)?;
    let body_force = file.body_force.as_ref().map(|section| {
        let key = "body_force.acceleration";
        acceleration_in_time(key, &section.acceleration, &units, &mut files)
    });
    let body_force = body_force.transpose()?;
    setup.body_force = body_force.as_ref().map(|signal| signal.at(0.0));
    let initial = initial::initial(file.initial.as_ref(), &setup.domain, &units, &mut files)?;
    let mut list = GrainList::new(&file.grains, &mut files, (&setup.domain, &units), is_dry)?;
    placed_images::add(&images, &mut list, &mut files, (&setup.domain, &units))?;
    let moving_bodies = bodies::add(&file.grains, &mut list, &mut files, (&setup.domain, &units))?;
    apart::check(&list, &setup.domain)?;
    let gravity = file.gravity.as_ref().map(|section| {
        acceleration_in_time("gravity.acceleration", &section.acceleration, &units, &mut files)
    });
    let gravity = gravity.transpose()?;
    let free = free::free_part(file, &mut list, gravity.as_ref(), &setup.domain, tau, &units)?;
    if is_dry {
        dry::has_free(free.is_some())?;
    }
    let gravity_on_fluid = free.as_ref().and_then(|part| gravity_on_fluid(part, &setup.domain));
    if let (Some(part), Some(gravity)) = (gravity_on_fluid, &gravity) {
        setup.body_force =
            Some(setup.body_force.unwrap_or_else(Vec3::zeros) + part * gravity.at(0.0));
    }
    let still = Signal::Constant(Vec3::zeros());
    let drives = Drives {
        faces: face_signals,
        body_force: body_force.unwrap_or_else(|| still.clone()),
        gravity: gravity.unwrap_or(still),
        gravity_on_fluid: gravity_on_fluid.unwrap_or(0.0),
        prescribed: std::mem::take(&mut list.prescribed),
    };
    let drives = Some(drives).filter(Drives::varies);
    let moves = free.is_some() || drives.as_ref().is_some_and(|all| !all.prescribed.is_empty());
    let solids = (list.solids(), moves);
    setup.solid_phase = solid::solid_phase(file.solid.as_ref(), solids, free.is_some())?;
    setup.check().map_err(|error| setup_trouble(&error))?;
    placed_images::check_pores(&images, &setup)?;
    implicit::check(&setup, free.as_ref())?;
    let records = records::records(&file.records, &setup, free.as_ref(), &units)?;
    let stop = stop::stop(&file.stop, &records, &units)?;
    let exact = match file.compare.as_ref().map(|section| section.exact) {
        Some(ExactName::PlanePoiseuille) if drives.is_some() => {
            let problem = "it is a steady flow, and values of this scene change in time";
            let remedy = "remove [compare], or make them constant";
            return Err(Trouble::new("compare.exact", problem, remedy));
        }
        Some(ExactName::PlanePoiseuille) => Some(
            PlanePoiseuille::of(&setup, &units)
                .map_err(|(problem, remedy)| Trouble::new("compare.exact", problem, remedy))?,
        ),
        None => None,
    };
    let others = (exact.is_some(), free.is_some());
    records::files_differ(&records, &files.attachments, others)?;
    Ok(Scene {
        title: file.title.clone().unwrap_or_default(),
        text: String::new(),
        attachments: files.attachments,
        units,
        si_reference_velocity: file.time.reference_velocity,
        checkpoint: checkpoint::interval(file.checkpoint.as_ref())?,
        keeps_last_state: file.checkpoint.as_ref().is_none_or(|s| s.at_end != Some(false)),
        setup,
        is_dry,
        free,
        moving_bodies,
        drives,
        operator_is_chosen: !is_dry
            && file.solid.as_ref().is_none_or(|section| section.operator.is_none()),
        initial,
        records,
        stop,
        exact,
        engine: file.engine.as_ref().map(|section| section.kind).unwrap_or_default(),
        precision: precision(file.engine.as_ref())?,
        adapter: file.engine.as_ref().and_then(|section| section.adapter.clone()),
    })
}

/// Errors unless density and viscosity are those of a fluid.
fn check_fluid(fluid: &FluidSection) -> Result<(), Trouble> {
    positive("fluid.density", fluid.density, "kg/m3, for example 1000")?;
    sane("fluid.density", fluid.density, 1e-6..=1e9, "kg/m3")?;
    let key = "fluid.kinematic_viscosity";
    positive(key, fluid.kinematic_viscosity, "m2/s, water has 1e-6")?;
    sane(key, fluid.kinematic_viscosity, 1e-15..=1e15, "m2/s")
}

/// The precision that is asked for, if the engine has it.
fn precision(section: Option<&EngineSection>) -> Result<Option<Precision>, Trouble> {
    let Some(EngineSection { kind, precision, .. }) = section else { return Ok(None) };
    let (has, other) = match (kind, precision) {
        (EngineKind::Reference, Some(Precision::Single)) => ("double", "cpu"),
        (EngineKind::Wgpu, Some(Precision::Double)) => ("single", "cpu"),
        _ => return Ok(*precision),
    };
    let problem = format!("engine {} computes in {has} precision only", kind.word());
    let remedy = format!("leave it out, or take engine.kind = \"{other}\", which has both");
    Err(Trouble::new("engine.precision", problem, remedy))
}

/// A velocity in lattice units, if it is slow enough.
fn velocity(key: &str, si_velocity: [f64; 3], units: &Units) -> Result<Vec3, Trouble> {
    finite(key, &si_velocity, "m/s")?;
    let velocity = Units::to_lattice(si_velocity, units.si_velocity());
    let speed = velocity.norm();
    if speed <= MAX_SPEED {
        return Ok(velocity);
    }
    let problem = format!(
        "its speed is {} cells per time step (Mach {:.2}); at most {MAX_SPEED} is allowed",
        beyond(speed, MAX_SPEED),
        speed * 3.0_f64.sqrt()
    );
    let remedy = shorter_step(units, 0.5 * MAX_SPEED / speed)
        + " (or a smaller `time.tau`), or use a smaller `domain.dx` with the same tau";
    Err(Trouble::new(key, problem, remedy))
}

/// An acceleration in lattice units, if it is weak enough.
fn acceleration(key: &str, si_acceleration: [f64; 3], units: &Units) -> Result<Vec3, Trouble> {
    finite(key, &si_acceleration, "m/s2")?;
    let acceleration = Units::to_lattice(si_acceleration, units.si_acceleration());
    let gain = acceleration.norm();
    if gain <= MAX_SPEED {
        return Ok(acceleration);
    }
    let problem = format!(
        "it gains {} cells per time step in each step; at most {MAX_SPEED} is allowed",
        beyond(gain, MAX_SPEED)
    );
    // What a step gains goes with its square.
    let remedy = shorter_step(units, (0.5 * MAX_SPEED / gain).sqrt()) + ", or use a weaker one";
    Err(Trouble::new(key, problem, remedy))
}

/// An acceleration that may change in time, in lattice units.
fn acceleration_in_time(
    key: &str,
    given: &VectorInTime,
    units: &Units,
    files: &mut Files,
) -> Result<Signal<Vec3>, Trouble> {
    let convert = |si_acceleration| acceleration(key, si_acceleration, units);
    in_time::vector(Subject::vector(key, "m/s2"), given, units, files, convert)
}

/// The part of gravity that is a body force on the fluid, if one is.
fn gravity_on_fluid(part: &FreePart, domain: &Domain) -> Option<f64> {
    match part.settings.gravity? {
        Gravity::Reduced { .. } => None,
        Gravity::Balanced { .. } => {
            let density = part.settings.fluid_density;
            Some(balancing_force(domain, &part.grains, density, Vec3::x()).x)
        }
        Gravity::OnFluidToo { .. } => Some(1.0),
    }
}

/// What the sections' own checks have let through: said in the reference's words.
fn setup_trouble(error: &SetupError) -> Trouble {
    let key = match error {
        SetupError::Domain(_) => "domain",
        SetupError::Rates(_) => "collision",
        SetupError::Solid(_) => "grains",
        SetupError::BodyForce { .. } => "body_force",
        SetupError::NoSamples | SetupError::GradedWeight | SetupError::TooSmallForLinear { .. } => {
            "solid"
        }
    };
    Trouble::new(key, error.to_string(), "change the value")
}
