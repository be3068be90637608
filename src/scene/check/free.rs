//! Free grains: from the sections of a scene to what an engine moves them with.

use psmrt_reference::coupling::{CouplingSettings, FreeGrains, Gravity, InternalFluid};
use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::lubrication::Lubrication;
use psmrt_reference::grains::motion::{SubstepError, divide};
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainError, GrainSetup, PeriodicBox};
use psmrt_reference::lattice::{Vec3, viscosity};

use super::contact::{Laws, laws, mirror, substeps};
use super::grains::{GrainList, Listed};
use super::{Trouble, mirrors};
use crate::scene::format::SceneFile;
use crate::scene::format_free::{GravityForm, GravitySection, InternalFluidName};
use crate::scene::format_grains::Motion;
use crate::scene::units::Units;

/// All grains of a scene in which some are free, and how they move; lattice units. Those that are not
/// free are held by the DEM: they keep their velocity whatever acts on them.
#[derive(Clone, Debug, PartialEq)]
pub struct FreePart {
    /// Contact law, periodic sides, lubrication, sub-steps.
    pub setup: GrainSetup,
    /// The grains at the start, in the order of the solids of the fluid's set-up.
    pub grains: Vec<Grain>,
    /// The faces of the box that hold grains back.
    pub planes: Vec<Plane>,
    /// Gravity, the fluid inside the grains, averaging.
    pub settings: CouplingSettings,
}

impl FreePart {
    /// The grains, ready to be moved by the loads of whatever engine computes the fluid in `domain`.
    /// Errors if they cannot be moved.
    pub fn free_grains(&self, domain: &Domain) -> Result<FreeGrains, GrainError> {
        let (grains, planes) = (self.grains.clone(), self.planes.clone());
        FreeGrains::new(domain, self.setup, grains, planes, self.settings)
    }

    /// Sub-steps of the grains in a time step.
    pub fn substeps(&self) -> Result<u32, SubstepError> {
        let shortest = self.setup.shortest_time(&self.grains, &self.planes);
        divide(1.0, shortest, self.setup.substeps).map(|(count, _)| count)
    }
}

/// The free grains, if there are any.
pub(super) fn free_part(
    file: &SceneFile,
    list: &mut GrainList,
    domain: &Domain,
    tau: f64,
    units: &Units,
) -> Result<Option<FreePart>, Trouble> {
    let lightest = list.free().map(|listed| listed.mass()).fold(f64::INFINITY, f64::min);
    if lightest == f64::INFINITY {
        return no_free_grains(file).map(|()| None);
    }
    let contact = file.contact.clone().unwrap_or_default();
    let laws = laws(&contact, lightest, units)?;
    let gravity = file.gravity.as_ref().map(|section| gravity(section, units)).transpose()?;
    let mirrored = mirrors::centred(domain, list, gravity.as_ref(), units)?;
    let planes = planes(domain, &laws, &mirrored);
    let lubrication = lubrication(file, list, domain, &mirrored, tau, units)?;
    let length = |axis: usize| domain.is_periodic(axis).then(|| domain.cells()[axis] as f64);
    let setup = GrainSetup {
        sides: PeriodicBox { lengths: [length(0), length(1), length(2)] },
        lubrication,
        substeps: substeps(&contact)?,
        ..GrainSetup::new(laws.grains)
    };
    let coupling = file.coupling.clone().unwrap_or_default();
    let settings = CouplingSettings {
        internal_fluid: match coupling.internal_fluid {
            InternalFluidName::Lagged => InternalFluid::Lagged,
            InternalFluidName::Kept => InternalFluid::Kept,
        },
        gravity,
        average_loads: coupling.average_loads,
        ..CouplingSettings::default()
    };
    let grains = list.grains.iter().map(Listed::to_grain).collect();
    let part = FreePart { setup, grains, planes, settings };
    part.free_grains(domain).map_err(|error| trouble(&error, list))?;
    let count = part.substeps().map_err(|error| substep_trouble(&error))?;
    if count > MOST_SUBSTEPS {
        let key =
            if contact.stiffness.is_some() { "contact.stiffness" } else { "contact.duration" };
        let problem = format!("contacts are so short that a time step needs {count} sub-steps");
        let remedy = "give a longer duration or a lower stiffness: 10 time steps are usual";
        return Err(Trouble::new(key, problem, remedy));
    }
    Ok(Some(part))
}

/// More sub-steps in a time step are refused: the contacts would last less than a hundredth of it.
const MOST_SUBSTEPS: u32 = 2500;

/// Errors at a section that only free grains have.
fn no_free_grains(file: &SceneFile) -> Result<(), Trouble> {
    let given = [
        ("gravity", file.gravity.is_some()),
        ("contact", file.contact.is_some()),
        ("lubrication", file.lubrication.is_some()),
        ("coupling", file.coupling.is_some()),
    ];
    let Some((name, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
    let problem = "it acts on free grains, and no grain of the scene is free";
    let remedy = match name {
        "gravity" => "add `motion = \"free\"` to grains, or drive the fluid by [body_force]",
        _ => "add `motion = \"free\"` to grains, or remove the section",
    };
    Err(Trouble::new(name, problem, remedy))
}

/// Gravity in lattice units.
fn gravity(section: &GravitySection, units: &Units) -> Result<Gravity, Trouble> {
    let acceleration = super::acceleration("gravity.acceleration", section.acceleration, units)?;
    Ok(match section.form {
        GravityForm::Reduced => Gravity::Reduced { acceleration },
        GravityForm::BodyForce => Gravity::OnFluidToo { acceleration },
    })
}

/// The acceleration of either form.
pub(super) fn acceleration(gravity: &Gravity) -> Vec3 {
    match *gravity {
        Gravity::Reduced { acceleration } | Gravity::OnFluidToo { acceleration } => acceleration,
    }
}

/// The faces as planes: walls with their velocity, mirrors as what they mirror, and inlets, outflows
/// and pressure faces as sieves, which let the fluid pass and hold grains back.
fn planes(domain: &Domain, laws: &Laws, mirrored: &[[bool; 2]; 3]) -> Vec<Plane> {
    let mut planes = Vec::new();
    for axis in 0..3 {
        for (side, face) in domain.faces().axis(axis).into_iter().enumerate() {
            let (velocity, law) = match face {
                Face::Periodic => continue,
                // Grains whose centres lie on it are cut in halves: they touch nothing there.
                Face::FreeSlip if mirrored[axis][side] => continue,
                Face::FreeSlip => (Vec3::zeros(), mirror(&laws.grains)),
                Face::Wall { velocity } => (velocity, laws.walls),
                Face::VelocityInlet { .. }
                | Face::FreeOutflow
                | Face::Pressure { .. }
                | Face::DevelopedPressure { .. } => (Vec3::zeros(), laws.walls),
            };
            let mut point = Vec3::zeros();
            let mut inward = Vec3::zeros();
            (point[axis], inward[axis]) =
                if side == 0 { (0.0, 1.0) } else { (domain.cells()[axis] as f64, -1.0) };
            planes.push(Plane { velocity, ..Plane::fixed(point, inward, law) });
        }
    }
    planes
}

/// The smallest gap of lubrication over the smallest radius, where a scene says nothing.
const ROUGHNESS: f64 = 1e-3;

fn lubrication(
    file: &SceneFile,
    list: &GrainList,
    domain: &Domain,
    mirrored: &[[bool; 2]; 3],
    tau: f64,
    units: &Units,
) -> Result<Option<Lubrication>, Trouble> {
    let Some(section) = &file.lubrication else { return Ok(None) };
    for axis in 0..3 {
        for (side, face) in domain.faces().axis(axis).into_iter().enumerate() {
            if face == Face::FreeSlip && !mirrored[axis][side] {
                let problem = "a mirror plane (`free_slip`) would get the lubrication of a wall, \
                               four times that between a grain and its mirror image";
                let remedy = "make that face a wall or periodic, or remove [lubrication]";
                return Err(Trouble::new("lubrication", problem, remedy));
            }
        }
    }
    let smallest = list.grains.iter().map(|listed| listed.radius).fold(f64::INFINITY, f64::min);
    let given = |si_gap: Option<f64>, default: f64| si_gap.map_or(default, |gap| gap / units.si_dx);
    let lubrication = Lubrication {
        viscosity: viscosity(tau),
        cutoff_gap: given(section.cutoff_gap, 1.0),
        smallest_gap: given(section.smallest_gap, ROUGHNESS * smallest),
    };
    let checked = lubrication.checked().map(Some);
    checked.map_err(|_| {
        let key = if section.smallest_gap.is_some() { "smallest_gap" } else { "cutoff_gap" };
        let problem = format!(
            "the gaps are {:.3e} m (smallest) and {:.3e} m (cut-off); the smallest must be above 0 \
             and below the cut-off",
            lubrication.smallest_gap * units.si_dx,
            lubrication.cutoff_gap * units.si_dx
        );
        let remedy = "common are a thousandth of a radius and the edge of a cell";
        Trouble::new(format!("lubrication.{key}"), problem, remedy)
    })
}

/// The key to blame for grains that cannot be moved.
fn trouble(error: &GrainError, list: &GrainList) -> Trouble {
    let change = "change the value";
    match error {
        GrainError::Law(error) => super::contact::trouble(error),
        GrainError::BoxTooShort { .. } => Trouble::new("domain", error.to_string(), change),
        GrainError::BadGrain { grain, .. } => {
            let problem = error.to_string();
            match list.grains.get(*grain) {
                Some(listed) => listed.trouble(problem, change),
                None => Trouble::new("grains", problem, change),
            }
        }
        GrainError::Lubrication(_) => Trouble::new("lubrication", error.to_string(), change),
        GrainError::Substep(error) => substep_trouble(error),
        _ => Trouble::new("grains", error.to_string(), change),
    }
}

fn substep_trouble(error: &SubstepError) -> Trouble {
    match error {
        SubstepError::TooLong { shortest_time, needed, .. } => {
            let problem = format!(
                "the sub-steps would be too long: the shortest contact takes {shortest_time:.3} \
                 time steps and needs 10 sub-steps or more"
            );
            let remedy = format!(
                "give {needed} sub-steps or more, leave `substeps` out, or make contacts last longer"
            );
            Trouble::new("contact.substeps", problem, remedy)
        }
        _ => Trouble::new("contact", error.to_string(), "make contacts last longer"),
    }
}

impl Listed {
    /// Mass in lattice units.
    fn mass(&self) -> f64 {
        Grain::sphere(self.centre, self.radius, self.density).mass
    }

    fn to_grain(&self) -> Grain {
        let grain = Grain::sphere(self.centre, self.radius, self.density)
            .moving(self.velocity)
            .spinning(self.spin);
        Grain { held: self.motion != Motion::Free, ..grain }
    }
}
