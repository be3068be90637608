//! What a plan must know of a scene: how long its grains are in cells, how crowded they are, how fast the
//! flow is, and how much there is to compute.

use psmrt_reference::coupling::InternalFluid;
use psmrt_reference::domain::Face;
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::lattice::viscosity;
use psmrt_reference::solids::Solid;

use super::drag::{Drag, drag};
use super::duct::Duct;
use crate::advice::estimate::grains::free;
use crate::advice::estimate::mapped::mapped;
use crate::advice::estimate::velocity::si_velocity;
use crate::advice::stability::limits::Measured;
use crate::advice::tradeoff::model::SolidMethod;
use crate::scene::Scene;
use crate::seepage::spheres::{has_image, spheres};
use crate::table::TableError;

/// What limits the accuracy of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Limit {
    /// Its grains.
    Grains {
        /// Cells across the smallest grain.
        cells: f64,
        /// Drag over Stokes' drag, about.
        drag: f64,
        /// Where that comes from.
        because: String,
    },
    /// Two plates between which a force drives the flow; there are no grains.
    Plates {
        /// Cells from wall to wall.
        cells: f64,
    },
    /// Two plates of which one moves along at least, and nothing else drives the flow; there are no grains.
    Shear {
        /// Cells from wall to wall.
        cells: f64,
    },
    /// Four walls of a duct, along which a force drives the flow; there are no grains.
    Duct {
        /// Cells across its short side.
        cells: f64,
        /// Its long side over its short one, and what follows from it.
        ratio: f64,
        /// What the error rests on.
        duct: Duct,
    },
}

impl Limit {
    /// Cells across the smallest grain, or from wall to wall.
    pub fn cells(&self) -> f64 {
        match *self {
            Limit::Grains { cells, .. }
            | Limit::Plates { cells }
            | Limit::Shear { cells }
            | Limit::Duct { cells, .. } => cells,
        }
    }
}

/// The facts of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// What limits it.
    pub limit: Limit,
    /// How its solid cells collide.
    pub solid: SolidMethod,
    /// Cells along the axes.
    pub cells: [usize; 3],
    /// Axes of one cell, along which nothing changes.
    pub flat: [bool; 3],
    /// Edge of a cell, m.
    pub si_dx: f64,
    /// Kinematic viscosity, m2/s.
    pub si_viscosity: f64,
    /// Relaxation time.
    pub tau: f64,
    /// Largest velocity that is known beforehand, m/s.
    pub si_velocity: Option<f64>,
    /// Acceleration of the body force, m/s2.
    pub si_acceleration: f64,
    /// The flow of the maps of stability that it is held to, and its velocity there, m/s; `None` if no
    /// velocity is known.
    pub mapped: Option<(Measured, f64)>,
    /// Whether all grains are fixed.
    pub is_fixed: bool,
    /// Density of the lightest free grain over the fluid's, and what becomes of the fluid inside.
    pub lightest: Option<(f64, InternalFluid)>,
    /// Longest time that the scene may run, s.
    pub si_time: f64,
}

impl Facts {
    /// The facts of a scene; if nothing in it limits the accuracy in a known way, why not.
    pub fn of(scene: &Scene) -> Result<Result<Self, String>, TableError> {
        let setup = &scene.setup;
        let cells = setup.domain.cells();
        let units = &scene.units;
        let flat = [0, 1, 2].map(|axis| cells[axis] == 1 && setup.domain.is_periodic(axis));
        let spheres = spheres(scene);
        let nu = viscosity(setup.collision.tau());
        if has_image(setup) {
            let why = "it has an image or a body of another shape, and the evidence is of spheres and of flows between walls";
            return Ok(Err(why.to_owned()));
        }
        let limit = if spheres.is_empty() {
            match walls(scene) {
                Ok(limit) => limit,
                Err(why) => return Ok(Err(why)),
            }
        } else {
            let smallest = spheres.iter().map(|s| 2.0 * s.1).fold(f64::INFINITY, f64::min);
            let Drag { factor, because, .. } = drag(scene)?;
            Limit::Grains { cells: smallest, drag: factor, because }
        };
        let phase = setup.solid_phase.as_ref().map(|phase| (phase.weighting, phase.operator));
        let (weighting, operator) = phase.unwrap_or_default();
        let Some(solid) = SolidMethod::of(weighting, operator) else {
            let why = "it has a weight B = epsilon and an operator of solid cells that no run of the evidence has \
                       together";
            return Ok(Err(why.to_owned()));
        };
        Ok(Ok(Facts {
            limit,
            solid,
            cells,
            flat,
            si_dx: units.si_dx,
            si_viscosity: nu * units.si_viscosity(),
            tau: setup.collision.tau(),
            si_velocity: si_velocity(scene).map(|(si_velocity, _)| si_velocity),
            si_acceleration: setup.body_force.map_or(0.0, |force| force.norm())
                * units.si_acceleration(),
            mapped: mapped(scene)
                .map(|(measured, _, speed, _)| (measured, speed * units.si_velocity())),
            is_fixed: scene.free.is_none()
                && !setup
                    .solid_phase
                    .iter()
                    .any(|phase| phase.solids.iter().any(Solid::has_velocity)),
            lightest: lightest(scene),
            si_time: scene.stop.steps as f64 * units.si_dt,
        }))
    }
}

impl Facts {
    /// The same scene with another operator of solid cells.
    pub fn with(&self, solid: SolidMethod) -> Self {
        let mapped = self.mapped.map(|(measured, si_velocity)| match measured {
            Measured::Bed(_) => (Measured::Bed(solid.weighting()), si_velocity),
            Measured::Fluid => (measured, si_velocity),
        });
        Facts { solid, mapped, ..self.clone() }
    }

    /// The operator that is more accurate for grains like these, if the scene has another one. Graded viscosity is for
    /// fixed grains; of those that move as prescribed there is no evidence.
    pub fn better_operator(&self) -> Option<SolidMethod> {
        let best = match (&self.limit, self.is_fixed, self.lightest) {
            (Limit::Grains { .. }, true, _) => SolidMethod::Graded,
            (Limit::Grains { .. }, false, Some(_)) => SolidMethod::FullBounceBack,
            _ => return None,
        };
        (best != self.solid).then_some(best)
    }
}

/// The walls that limit a scene without grains; if they do so in no way that is known, why not.
fn walls(scene: &Scene) -> Result<Limit, String> {
    let domain = &scene.setup.domain;
    let faces = [0, 1, 2].map(|axis| domain.faces().axis(axis));
    let is_open = |face: &Face| {
        matches!(face, Face::VelocityInlet { .. } | Face::FreeOutflow)
            || face.held_density().is_some()
    };
    if faces.iter().flatten().any(is_open) {
        return Err("fluid enters or leaves through its faces, which changes a flow between walls by more than \
                    the grid does (reference/ERRATA.md): the evidence has periodic flows that a force or a \
                    moving wall drives"
            .to_owned());
    }
    // From wall to wall; a mirror stands in the middle.
    let gap = |axis: usize| {
        let walls = faces[axis].iter().filter(|face| matches!(face, Face::Wall { .. })).count();
        let mirrors = faces[axis].iter().filter(|face| **face == Face::FreeSlip).count();
        let cells = domain.cells()[axis] as f64;
        match (walls, mirrors) {
            (2, 0) => Some(cells),
            (1, 1) => Some(2.0 * cells),
            _ => None,
        }
    };
    let gaps = [0, 1, 2].map(gap);
    let rests = |face: &Face| match face {
        Face::Wall { velocity } => velocity.norm() == 0.0,
        _ => true,
    };
    let all_rest = faces.iter().flatten().all(rests);
    let across: Vec<f64> = gaps.iter().copied().flatten().collect();
    match across[..] {
        [] => Err(
            "it has neither grains nor two walls that face each other: there is no error that the \
                   evidence knows"
                .to_owned(),
        ),
        [cells] => match (scene.setup.body_force.is_some_and(|force| force.norm() > 0.0), all_rest) {
            (true, _) => Ok(Limit::Plates { cells }),
            (false, false) => Ok(Limit::Shear { cells }),
            (false, true) => Err("neither a force nor a moving wall drives the fluid between its walls: there is no \
                                  error that the evidence knows"
                .to_owned()),
        },
        [a, b] => {
            let is_along = scene.setup.body_force.is_some_and(|force| {
                (0..3).all(|axis| gaps[axis].is_none() == (force[axis] != 0.0))
            });
            if !is_along || !all_rest {
                return Err("it has walls along two axes, and not just a force along the third that drives \
                            the flow of a duct: there is no error that the evidence knows"
                    .to_owned());
            }
            let ratio = a.max(b) / a.min(b);
            Ok(Limit::Duct { cells: a.min(b), ratio, duct: Duct::new(ratio) })
        }
        _ => Err("it has walls on all sides: there is no error that the evidence knows".to_owned()),
    }
}

/// The density of the lightest free grain over that of the fluid, and what becomes of the fluid inside.
pub(crate) fn lightest(scene: &Scene) -> Option<(f64, InternalFluid)> {
    let part = scene.free.as_ref()?;
    let ratio =
        |grain: &Grain| grain.mass / (part.settings.fluid_density * sphere_volume(grain.radius));
    let lightest = free(part).map(ratio).reduce(f64::min)?;
    Some((lightest, part.settings.internal_fluid))
}
