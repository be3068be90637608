//! Scenes without fluid: which keys they cannot have, and what stands where a fluid's values would.

use psmrt_reference::coupling::{CouplingSettings, Gravity, InternalFluid};

use super::numbers::{beyond, needed, positive, sane, shorter_step};
use super::{MAX_SPEED, Trouble};
use crate::scene::format::{FaceKind, FaceSection, SceneFile, TimeSection};
use crate::scene::format_free::GravityForm;
use crate::scene::format_grains::GrainsKind;
use crate::scene::format_run::RecordKind;
use crate::scene::format_time::VectorInTime;
use crate::scene::hints::example;
use crate::scene::names::FACE_KEYS;
use crate::units::Units;

/// The unit of density, kg/m3: any would do.
const SI_DENSITY: f64 = 1000.0;

/// The relaxation time of the collision that the set-up then has and nobody asks for.
pub(super) const NOMINAL_TAU: f64 = 1.0;

/// Errors at a key that only a fluid has.
pub(super) fn check(file: &SceneFile) -> Result<(), Trouble> {
    let time = &file.time;
    let sections = [
        ("time.tau", time.tau.is_some()),
        ("time.lattice_velocity", time.lattice_velocity.is_some()),
        ("time.reference_velocity", time.reference_velocity.is_some()),
        ("collision", file.collision.is_some()),
        ("body_force", file.body_force.is_some()),
        ("initial", file.initial.is_some()),
        ("solid", file.solid.is_some()),
        ("lubrication", file.lubrication.is_some()),
        ("coupling", file.coupling.is_some()),
        ("compare", file.compare.is_some()),
    ];
    if let Some((key, _)) = sections.into_iter().find(|(_, is_given)| *is_given) {
        return Err(of_fluid(key, "it belongs to the fluid, and the scene has none"));
    }
    faces(file)?;
    for (number, section) in file.grains.iter().enumerate() {
        if section.kind == GrainsKind::Voxels {
            let problem = "an image is a body in the fluid, which grains do not touch, and the scene has no fluid";
            return Err(of_fluid(&format!("grains[{number}].kind"), problem));
        }
    }
    if let Some(gravity) = &file.gravity {
        if gravity.balance {
            let problem = "a pressure gradient of the fluid would balance the weight, and the scene has no fluid";
            return Err(of_fluid("gravity.balance", problem));
        }
        if gravity.form == GravityForm::BodyForce {
            let problem = "it is a body force on the fluid too, and the scene has no fluid";
            return Err(of_fluid("gravity.form", problem));
        }
    }
    for (number, section) in file.records.iter().enumerate() {
        let key = format!("records[{number}].kind");
        match section.kind {
            RecordKind::Grains
            | RecordKind::GrainMeans
            | RecordKind::Contacts
            | RecordKind::ContactMeans
            | RecordKind::Walls => {}
            RecordKind::Loads => {
                let problem =
                    "it holds the force of the fluid on grains, and the scene has no fluid";
                let remedy = "take `kind = \"grains\"`, which has the contact forces, or `kind = \"grain_means\"`";
                return Err(Trouble::new(key, problem, remedy));
            }
            RecordKind::Box
            | RecordKind::Profile
            | RecordKind::Slice
            | RecordKind::Fields
            | RecordKind::Layers
            | RecordKind::Permeability => {
                let problem = "it is taken from the cells of the fluid, and the scene has no fluid";
                return Err(of_fluid(&key, problem));
            }
        }
    }
    Ok(())
}

/// Errors at a face that only a fluid passes or feels.
fn faces(file: &SceneFile) -> Result<(), Trouble> {
    for (name, face) in faces_of(file) {
        let Some(FaceSection { kind, velocity, .. }) = face else { continue };
        if !matches!(kind, FaceKind::Periodic | FaceKind::Wall | FaceKind::FreeSlip) {
            let problem = "only fluid passes it, and the scene has none; it may be `periodic`, `wall` or `free_slip`";
            let remedy = format!(
                "write `kind = \"wall\"`, or add the section, for example\n{}",
                example("fluid")
            );
            return Err(Trouble::new(format!("faces.{name}.kind"), problem, remedy));
        }
        if matches!(velocity, Some(VectorInTime::Changing(_))) {
            let problem = "grains feel a wall of constant velocity only";
            return Err(Trouble::new(
                format!("faces.{name}.velocity"),
                problem,
                "give three numbers, or let prescribed grains shake the others",
            ));
        }
    }
    Ok(())
}

/// The faces with their names.
fn faces_of(file: &SceneFile) -> Vec<(&'static str, Option<&FaceSection>)> {
    let faces = &file.faces;
    let given = [
        [&faces.x_low, &faces.x_high],
        [&faces.y_low, &faces.y_high],
        [&faces.z_low, &faces.z_high],
    ];
    let given = given.as_flattened().iter().map(|face| face.as_ref());
    FACE_KEYS.as_flattened().iter().copied().zip(given).collect()
}

/// Trouble with a key of the fluid.
fn of_fluid(key: &str, problem: &str) -> Trouble {
    let remedy = format!("remove it, or add the section, for example\n{}", example("fluid"));
    Trouble::new(key, problem, remedy)
}

/// Errors unless a grain is free: nothing else moves by what acts on it.
pub(super) fn has_free(is_there: bool) -> Result<(), Trouble> {
    if is_there {
        return Ok(());
    }
    let problem = "without it only free grains are computed, and no grain of the scene is free";
    let remedy = format!(
        "add `motion = \"free\"` to grains, or the section, for example\n{}",
        example("fluid")
    );
    Err(Trouble::new("fluid", problem, remedy))
}

/// The scales.
pub(super) fn units(section: &TimeSection, si_dx: f64) -> Result<Units, Trouble> {
    let because = "without fluid nothing else says how long a time step is";
    let remedy = "add `dt`, in s: contacts take as many sub-steps in it as they need, and in a step a grain should move by \
                  less than a fifth of `domain.dx`";
    let si_dt = needed("time.dt", section.dt, because, remedy)?;
    positive("time.dt", si_dt, "s")?;
    sane("time.dt", si_dt, 1e-15..=1e9, "s")?;
    Ok(Units { si_dx, si_dt, si_density: SI_DENSITY })
}

/// Errors at a velocity with which something moves too far in a step for its contacts to be seen in time.
pub(super) fn slow_enough(file: &SceneFile, units: &Units) -> Result<(), Trouble> {
    let grains =
        file.grains.iter().enumerate().map(|(number, section)| {
            (format!("grains[{number}].velocity"), section.velocity.as_ref())
        });
    let faces = faces_of(file).into_iter().map(|(name, face)| {
        (format!("faces.{name}.velocity"), face.and_then(|face| face.velocity.as_ref()))
    });
    for (key, velocity) in grains.chain(faces) {
        let Some(VectorInTime::Constant(si_velocity)) = velocity else { continue };
        let speed = Units::to_lattice(*si_velocity, units.si_velocity()).norm();
        if speed > MAX_SPEED {
            let problem = format!(
                "it is {} times `domain.dx` in a time step; at most {MAX_SPEED} is allowed",
                beyond(speed, MAX_SPEED)
            );
            let remedy =
                shorter_step(units, 0.5 * MAX_SPEED / speed) + ", or take a larger `domain.dx`";
            return Err(Trouble::new(key, problem, remedy));
        }
    }
    Ok(())
}

/// How grains move where no fluid acts on them: all their weight does, and they hold no fluid.
pub(super) fn settings(gravity: Option<Gravity>) -> CouplingSettings {
    CouplingSettings {
        internal_fluid: InternalFluid::Kept,
        gravity,
        average_loads: false,
        fluid_density: 0.0,
    }
}
