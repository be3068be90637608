//! Free grains: from the sections of a scene to what an engine moves them with.

use psmrt_reference::coupling::{CouplingSettings, FreeGrains, Gravity, InternalFluid};
use psmrt_reference::domain::Domain;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::motion::{SubstepError, divide};
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainError, GrainSetup};
use psmrt_reference::lattice::{Vec3, viscosity};

use super::contact::consistent;
use super::contact_values::Bodies;
use super::grains::GrainList;
use super::hardness::Burden;
use super::listed::Listed;
use super::maker::Maker;
use super::{Trouble, balance, effort, mirrors};
use crate::in_time::Signal;
use crate::scene::format::SceneFile;
use crate::scene::format_free::{GravityForm, GravitySection, InternalFluidName};
use crate::units::Units;

/// All grains of a scene in which some are free, and how they move; lattice units. Those that are not
/// free are held by the DEM: they keep their velocity whatever acts on them.
#[derive(Clone, Debug, PartialEq)]
pub struct FreePart {
    /// Contact law, periodic sides, lubrication, sub-steps.
    pub setup: GrainSetup,
    /// The grains at the start.
    pub grains: Vec<Grain>,
    /// Which of the solids of the fluid's set-up each grain is. The others stay, or move as prescribed, and grains do
    /// not touch them.
    pub solids: Vec<usize>,
    /// The faces of the domain that hold grains back.
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

    /// Whether solid number `solid` is a grain that is free to move.
    pub fn moves_solid(&self, solid: usize) -> bool {
        self.solids.iter().zip(&self.grains).any(|(&known, grain)| known == solid && !grain.held)
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
    gravity_in_time: Option<&Signal<Vec3>>,
    domain: &Domain,
    tau: f64,
    units: &Units,
) -> Result<Option<FreePart>, Trouble> {
    let lightest = list.free().map(|listed| listed.mass()).fold(f64::INFINITY, f64::min);
    if lightest == f64::INFINITY {
        return no_free_grains(file).map(|()| None);
    }
    let contact = file.contact.clone().unwrap_or_default();
    consistent(&contact)?;
    let sectioned = file.gravity.as_ref().zip(gravity_in_time);
    let gravity = sectioned.map(|(section, signal)| form_of(section).with(signal.at(0.0)));
    // Along each axis the largest that it ever is.
    let extent = gravity_in_time.map_or_else(Vec3::zeros, |signal| {
        let corners = signal.corners().into_iter();
        corners.fold(Vec3::zeros(), |most, corner| most.sup(&corner.abs()))
    });
    if file.gravity.as_ref().is_some_and(|section| section.balance) {
        balance::check(file, &extent, list, domain)?;
    }
    let mirrored = mirrors::centred(domain, list, &extent, units)?;
    let grains: Vec<Grain> = list.grains.iter().map(Listed::to_grain).collect();
    let g = gravity_in_time.map_or_else(Vec3::zeros, |signal| signal.largest(Vec3::norm));
    let weight_asks = Burden::new(&grains, &g, domain, viscosity(tau)).stiffness();
    let of_lightest = list.free().filter(|listed| listed.mass() == lightest);
    let radius_of_lightest = of_lightest.map(|listed| listed.radius).fold(f64::INFINITY, f64::min);
    let bodies = Bodies { lightest, radius_of_lightest, weight_asks };
    let maker = Maker { grains: &grains, bodies, domain, mirrored, tau, units };
    let (setup, planes) = maker.make(&contact, file.lubrication.as_ref())?;
    effort::check(&maker, &contact, file.lubrication.as_ref())?;
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
    // All solids of a scene are grains, in the same order.
    let solids = (0..grains.len()).collect();
    let part = FreePart { setup, grains, solids, planes, settings };
    part.free_grains(domain).map_err(|error| trouble(&error, list))?;
    Ok(Some(part))
}

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

/// The form of gravity that a scene asks for, of no strength.
fn form_of(section: &GravitySection) -> Gravity {
    let acceleration = Vec3::zeros();
    match section.form {
        GravityForm::Reduced if section.balance => Gravity::Balanced { acceleration },
        GravityForm::Reduced => Gravity::Reduced { acceleration },
        GravityForm::BodyForce => Gravity::OnFluidToo { acceleration },
    }
}

/// The key to blame for grains that cannot be moved.
fn trouble(error: &GrainError, list: &GrainList) -> Trouble {
    let change = "change the value";
    match error {
        GrainError::Law(error) => super::contact_values::trouble(error),
        GrainError::BoxTooShort { .. } => Trouble::new("domain", error.to_string(), change),
        GrainError::BadGrain { grain, .. } => {
            let problem = error.to_string();
            match list.grains.get(*grain) {
                Some(listed) => listed.trouble(problem, change),
                None => Trouble::new("grains", problem, change),
            }
        }
        GrainError::Lubrication(_) => Trouble::new("lubrication", error.to_string(), change),
        _ => Trouble::new("grains", error.to_string(), change),
    }
}
