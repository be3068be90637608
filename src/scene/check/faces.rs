//! The six faces, and the combinations that make no sense.

use psmrt_reference::domain::{DomainError, FACE_NAMES, Face, Faces};
use psmrt_reference::drive::DriveError;
use psmrt_reference::lattice::{CS2, Vec3};
use psmrt_reference::setup::{Setup, SetupError};

use super::in_time::Files;
use super::numbers::{absent, beyond, finite, needed, shorter_step};
use super::signal_file::Subject;
use super::{Trouble, in_time, velocity};
use crate::in_time::{FaceSignal, Signal};
use crate::scene::format::{FaceKind, FaceSection, FacesSection};
use crate::scene::format_time::VectorInTime;
use crate::scene::names::FACE_KEYS;
use crate::units::Units;

/// What happens at the six faces: in the first step, and how it changes.
pub(super) fn faces(
    section: &FacesSection,
    cells: [usize; 3],
    units: &Units,
    files: &mut Files,
) -> Result<(Faces, [[FaceSignal; 2]; 3]), Trouble> {
    let given = [
        [&section.x_low, &section.x_high],
        [&section.y_low, &section.y_high],
        [&section.z_low, &section.z_high],
    ];
    let mut built = [[Face::Periodic; 2]; 3];
    let mut signals = [[(); 2]; 3].map(|axis| axis.map(|()| FaceSignal::Constant));
    for axis in 0..3 {
        for side in 0..2 {
            if let Some(section) = given[axis][side] {
                (built[axis][side], signals[axis][side]) =
                    face(FACE_KEYS[axis][side], section, cells[axis], units, files)?;
            }
        }
    }
    let [x, y, z] = built;
    Ok((Faces { x, y, z }, signals))
}

/// Errors at a face whose value makes no sense at some other time than in the first step, of which `setup` is.
pub(super) fn check_later(setup: &Setup, signals: &[[FaceSignal; 2]; 3]) -> Result<(), Trouble> {
    for axis in 0..3 {
        for side in 0..2 {
            for value in signals[axis][side].corners() {
                let mut drive = setup.drive();
                drive.faces[axis][side] = value;
                match setup.clone().set_drive(&drive) {
                    Err(DriveError::Value(SetupError::Domain(error))) => {
                        return Err(trouble(&error));
                    }
                    Err(error) => {
                        let key = format!("faces.{}", FACE_KEYS[axis][side]);
                        return Err(Trouble::new(key, error.to_string(), "change the value"));
                    }
                    Ok(()) => {}
                }
            }
        }
    }
    Ok(())
}

/// One face; `along`: cells of the domain along its normal.
fn face(
    name: &str,
    section: &FaceSection,
    along: usize,
    units: &Units,
    files: &mut Files,
) -> Result<(Face, FaceSignal), Trouble> {
    let key = |last: &str| format!("faces.{name}.{last}");
    if !matches!(section.kind, FaceKind::Wall | FaceKind::VelocityInlet) {
        let belongs = "a `wall` or a `velocity_inlet`";
        absent(&key("velocity"), section.velocity.as_ref(), belongs)?;
    }
    if section.kind != FaceKind::Pressure {
        absent(&key("pressure"), section.pressure.as_ref(), "a face of kind `pressure`")?;
        absent(&key("developed"), section.developed.as_ref(), "a face of kind `pressure`")?;
        absent(
            &key("non_reflecting"),
            section.non_reflecting.as_ref(),
            "a face of kind `pressure`",
        )?;
    }
    if section.non_reflecting != Some(true) {
        let belongs = "a `pressure` face with `non_reflecting = true`";
        absent(&key("memory"), section.memory.as_ref(), belongs)?;
    }
    let mut velocity_of = |given: &VectorInTime| {
        let key = key("velocity");
        let convert = |si_velocity| velocity(&key, si_velocity, units);
        in_time::vector(Subject::vector(&key, "m/s"), given, units, files, convert)
    };
    Ok(match section.kind {
        FaceKind::Periodic => (Face::Periodic, FaceSignal::Constant),
        FaceKind::FreeSlip => (Face::FreeSlip, FaceSignal::Constant),
        FaceKind::FreeOutflow => (Face::FreeOutflow, FaceSignal::Constant),
        FaceKind::Wall => match &section.velocity {
            Some(given) => {
                let signal = velocity_of(given)?;
                (Face::Wall { velocity: signal.at(FIRST) }, of_velocity(signal))
            }
            None => (Face::wall(), FaceSignal::Constant),
        },
        FaceKind::VelocityInlet => {
            let remedy = "add `velocity = [x, y, z]` in m/s";
            let given =
                needed(&key("velocity"), section.velocity.as_ref(), "an inlet needs it", remedy)?;
            let signal = velocity_of(given)?;
            (Face::VelocityInlet { velocity: signal.at(FIRST) }, of_velocity(signal))
        }
        FaceKind::Pressure => {
            let remedy = "add `pressure` in Pa above the pressure of the fluid at rest, often 0";
            let key_of = key("pressure");
            let given =
                needed(&key_of, section.pressure.as_ref(), "a pressure face needs it", remedy)?;
            let subject = Subject { key: &key_of, unit: "Pa", names: ["pressure"] };
            let convert = |si_pressure| density(&key_of, si_pressure, units);
            let signal = in_time::number(subject, given, units, files, convert)?;
            let density = signal.at(FIRST);
            let face = match (section.non_reflecting, section.developed) {
                (Some(true), Some(false)) => {
                    return Err(Trouble::new(
                        key("developed"),
                        "a non-reflecting face lets the shear stress through, as `developed = true` does",
                        "remove it",
                    ));
                }
                (Some(true), _) => {
                    let memory = memory(&key("memory"), section.memory, along, units)?;
                    Face::NonReflectingPressure { density, memory }
                }
                (_, Some(true)) => Face::DevelopedPressure { density },
                _ => Face::Pressure { density },
            };
            let changes = signal.varies();
            (face, if changes { FaceSignal::Density(signal) } else { FaceSignal::Constant })
        }
    })
}

/// The time of the first step at which faces have their value.
const FIRST: f64 = 0.5;

fn of_velocity(signal: Signal<Vec3>) -> FaceSignal {
    if signal.varies() { FaceSignal::Velocity(signal) } else { FaceSignal::Constant }
}

/// Memory of a non-reflecting face where a scene gives none, in times that sound takes across the domain: the flow
/// between an inlet and such a face then settles fastest (`reference/src/non_reflecting.rs`).
const CROSSINGS: f64 = 4.0;

/// Longest memory, steps: single precision still sees what a step takes off, and few runs wait as long for a pressure.
const LONGEST_MEMORY: f64 = 1e6;

/// Memory of a non-reflecting face, steps.
fn memory(key: &str, si_memory: Option<f64>, along: usize, units: &Units) -> Result<f64, Trouble> {
    let Some(si_memory) = si_memory else {
        return Ok((CROSSINGS * along as f64 / CS2.sqrt()).min(LONGEST_MEMORY));
    };
    finite(key, &[si_memory], "s")?;
    let memory = si_memory / units.si_dt;
    if (1.0..=LONGEST_MEMORY).contains(&memory) {
        return Ok(memory);
    }
    let [shortest, longest] = [1.0, LONGEST_MEMORY].map(|steps| steps * units.si_dt);
    let problem = format!(
        "it is {memory:.3e} time steps; 1 to {LONGEST_MEMORY:e} are allowed, {shortest:.3e} to {longest:.3e} s"
    );
    let remedy = format!(
        "remove it: {CROSSINGS} times the time that sound takes along the domain, {:.3e} s, stands for it",
        CROSSINGS * along as f64 / CS2.sqrt() * units.si_dt
    );
    Err(Trouble::new(key, problem, remedy))
}

/// How far the density at a face may be from 1: beyond, the flow is not nearly incompressible.
const MAX_DENSITY_CHANGE: f64 = 0.1;

fn density(key: &str, si_pressure: f64, units: &Units) -> Result<f64, Trouble> {
    finite(key, &[si_pressure], "Pa")?;
    let density = units.density_at(si_pressure);
    if (density - 1.0).abs() <= MAX_DENSITY_CHANGE {
        return Ok(density);
    }
    let limit = units.si_gauge_pressure(1.0 + MAX_DENSITY_CHANGE);
    let problem = format!(
        "it changes the density by {} of itself; -{limit:.3e} to {limit:.3e} Pa are allowed",
        beyond(density - 1.0, (density - 1.0).signum() * MAX_DENSITY_CHANGE)
    );
    // The unit of pressure goes with the inverse square of the time step.
    let factor = (0.5 * MAX_DENSITY_CHANGE / (density - 1.0).abs()).sqrt();
    let remedy = shorter_step(units, factor) + ", or use a smaller pressure difference";
    Err(Trouble::new(key, problem, remedy))
}

/// The key to blame for a combination that makes no sense.
pub(super) fn trouble(error: &DomainError) -> Trouble {
    let key_of = |wanted: &str| {
        let (names, keys) = (FACE_NAMES.as_flattened(), FACE_KEYS.as_flattened());
        let found = names.iter().zip(keys).find(|(name, _)| **name == wanted);
        found.map_or_else(|| "faces".to_owned(), |(_, key)| format!("faces.{key}"))
    };
    match *error {
        DomainError::UnpairedPeriodic { face, opposite } => Trouble::new(
            key_of(opposite),
            format!(
                "the face opposite, {}, is periodic (as are all that are absent)",
                key_of(face)
            ),
            "make both periodic or neither",
        ),
        DomainError::WallThroughItself { face, normal } => Trouble::new(
            key_of(face) + ".velocity",
            format!(
                "the wall moves along its own normal ({normal:.3e} cells per time step); a wall \
                 moves in its own plane only"
            ),
            "set that component to 0, or use a `velocity_inlet` to push fluid through the face",
        ),
        DomainError::InletWithoutOutlet { face } => Trouble::new(
            key_of(face),
            "fluid enters here and no face lets it out",
            "make one face `free_outflow` or `pressure`",
        ),
        DomainError::OutflowWithoutInlet { face } => Trouble::new(
            key_of(face),
            "fluid may leave here, but no face is a `velocity_inlet` or holds a `pressure`: nothing \
             determines the flow",
            "add an inlet, or make this face `pressure`",
        ),
        DomainError::BadValue { face, key, .. } => {
            Trouble::new(format!("{}.{key}", key_of(face)), error.to_string(), "change it")
        }
        DomainError::Empty { .. } | DomainError::TooLarge { .. } => {
            Trouble::new("domain", error.to_string(), "change the number of cells")
        }
    }
}
