//! Free grains: from the sections of a scene to what an engine moves them with.

use psmrt_reference::coupling::{CouplingSettings, FreeGrains, Gravity, InternalFluid};
use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::motion::{SubstepError, divide};
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainError, GrainSetup, PeriodicBox};
use psmrt_reference::lattice::{Vec3, viscosity};

use super::contact::{Bodies, Laws, consistent, laws, mirror, substeps};
use super::grains::{GrainList, Listed};
use super::hardness::Burden;
use super::{Trouble, balance, effort, mirrors};
use crate::scene::format::SceneFile;
use crate::scene::format_free::{
    ContactSection, GravityForm, GravitySection, InternalFluidName, LubricationSection,
};
use crate::scene::format_grains::Motion;
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
    let gravity = file.gravity.as_ref().map(|section| gravity(section, units)).transpose()?;
    if file.gravity.as_ref().is_some_and(|section| section.balance) {
        balance::check(file, list, domain)?;
    }
    let mirrored = mirrors::centred(domain, list, gravity.as_ref(), units)?;
    let grains: Vec<Grain> = list.grains.iter().map(Listed::to_grain).collect();
    let g = gravity.as_ref().map_or_else(Vec3::zeros, Gravity::acceleration);
    let weight_asks = Burden::new(&grains, &g, domain, viscosity(tau)).stiffness();
    let bodies = Bodies { lightest, weight_asks };
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

/// Makes the set-up of the grains from the keys of `[contact]` and `[lubrication]`.
pub(super) struct Maker<'a> {
    pub grains: &'a [Grain],
    pub bodies: Bodies,
    pub domain: &'a Domain,
    /// Which faces cut grains in halves.
    pub mirrored: [[bool; 2]; 3],
    pub tau: f64,
    pub units: &'a Units,
}

impl Maker<'_> {
    /// The set-up and the faces that hold grains back. Errors at a value that cannot be used.
    pub fn make(
        &self,
        contact: &ContactSection,
        lubrication: Option<&LubricationSection>,
    ) -> Result<(GrainSetup, Vec<Plane>), Trouble> {
        let laws = laws(contact, &self.bodies, self.units)?;
        let planes = planes(self.domain, &laws, &self.mirrored);
        let length =
            |axis: usize| self.domain.is_periodic(axis).then(|| self.domain.cells()[axis] as f64);
        let setup = GrainSetup {
            sides: PeriodicBox { lengths: [length(0), length(1), length(2)] },
            lubrication: lubrication.map(|section| self.lubrication(section)).transpose()?,
            substeps: substeps(contact)?,
            ..GrainSetup::new(laws.grains)
        };
        Ok((setup, planes))
    }
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

/// Gravity in lattice units.
fn gravity(section: &GravitySection, units: &Units) -> Result<Gravity, Trouble> {
    let acceleration = super::acceleration("gravity.acceleration", section.acceleration, units)?;
    Ok(match section.form {
        GravityForm::Reduced if section.balance => Gravity::Balanced { acceleration },
        GravityForm::Reduced => Gravity::Reduced { acceleration },
        GravityForm::BodyForce => Gravity::OnFluidToo { acceleration },
    })
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
                | Face::DevelopedPressure { .. }
                | Face::NonReflectingPressure { .. } => (Vec3::zeros(), laws.walls),
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
        _ => Trouble::new("grains", error.to_string(), change),
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
            .spinning(self.angular_velocity);
        Grain { held: self.motion != Motion::Free, ..grain }
    }
}
