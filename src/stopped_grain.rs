//! Why a run stopped at a free grain, in SI units: what has happened to it, why probably, and what to do.

use std::fmt;

use psmrt_reference::coupling::Gravity;
use psmrt_reference::grains::hold::{self, DEEPEST, Sunk, SunkInto};
use psmrt_reference::grains::laws::Law;
use psmrt_reference::grains::setup::GrainError;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;
use thiserror::Error;

use crate::engine::{Coupled, EngineStop};
use crate::scene::check::MAX_SPEED;
use crate::scene::check::hardness::{
    Burden, IN_IMPACT, ONE_ON_ONE, harder_at_rest, harder_in_impact,
};
use crate::scene::{FreePart, Scene};

/// A run that stopped at a free grain.
#[derive(Clone, Debug, Error, PartialEq)]
pub struct GrainStop {
    /// Steps that were made.
    pub step: u64,
    /// The time then, s.
    pub si_time: f64,
    /// What has happened.
    pub failure: String,
    /// Why, probably.
    pub cause: String,
    /// What to do.
    pub remedy: String,
}

impl fmt::Display for GrainStop {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let GrainStop { step, si_time, failure, cause, remedy } = self;
        write!(
            out,
            "stopped after step {step} ({si_time:.4e} s): {failure}. Probable cause: {cause}\n  help: {remedy}"
        )
    }
}

/// The stop in SI units if a free grain is to blame.
pub(crate) fn explained(stop: &EngineStop, scene: &Scene, engine: &Coupled) -> Option<GrainStop> {
    let EngineStop::Grains(error) = stop else { return None };
    let situation = Situation { scene, part: scene.free.as_ref()?, system: engine.free_grains()? };
    let (failure, cause, remedy) = match error {
        GrainError::Sunk(sunk) => situation.sunk(sunk),
        GrainError::Thrown { grain, speed, gained, .. } => {
            situation.thrown(*grain, *speed, *gained)
        }
        GrainError::NotFinite { grain, position } => {
            let finite = |vector: &Vec3| vector.iter().all(|x| x.is_finite());
            let is_fluid = engine.loads().iter().any(|l| !(finite(&l.force) && finite(&l.torque)));
            situation.nowhere(*grain, position, is_fluid)
        }
        _ => return None,
    };
    let step = engine.steps();
    let si_time = step as f64 * scene.units.si_dt;
    Some(GrainStop { step, si_time, failure, cause, remedy })
}

/// Failure, cause and remedy.
type Words = (String, String, String);

/// A scene, and its grains when the run stopped.
struct Situation<'a> {
    scene: &'a Scene,
    part: &'a FreePart,
    system: &'a GrainSystem,
}

impl Situation<'_> {
    /// A grain too deep in an obstacle.
    fn sunk(&self, sunk: &Sunk) -> Words {
        let units = &self.scene.units;
        let grain = &self.system.grains()[sunk.grain];
        let (obstacle, mass, weaker) = match sunk.obstacle {
            SunkInto::Plane(plane) => (self.face(plane), grain.mass, sunk.grain),
            SunkInto::Grain(other) => {
                let two = &self.system.grains()[other];
                let mass = match two.held {
                    true => grain.mass,
                    // What presses is the heavier one: the lighter may stand on something.
                    false => grain.mass.max(two.mass),
                };
                let weaker = if two.radius < grain.radius { other } else { sunk.grain };
                (format!("grain {other}"), mass, weaker)
            }
        };
        let is_through = matches!(sunk.obstacle, SunkInto::Plane(_)) && sunk.overlap > sunk.radius;
        let failure = format!(
            "grain {} (counted from 0) {} {obstacle}: by {:.3e} m, {:.2} times the radius of grain {weaker}; \
             the limit is {DEEPEST}",
            sunk.grain,
            if is_through { "has passed through" } else { "overlaps" },
            sunk.overlap * units.si_dx,
            sunk.depth(),
        );
        let law = &self.part.setup.law;
        let diameter = 2.0 * sunk.radius;
        let overlaps = self.burden().overlaps(law);
        let at_rest = overlaps.in_bed.max(overlaps.one_on_one);
        let speed = grain.velocity.norm();
        let arrives = sunk.approach.max(0.0);
        // R* of both: a plane has no curvature.
        let radius = match sunk.obstacle {
            SunkInto::Plane(_) => grain.radius,
            SunkInto::Grain(other) => {
                let other = self.system.grains()[other].radius;
                grain.radius * other / (grain.radius + other)
            }
        };
        let stopping = law.overlap_of_impact(arrives, radius, mass);
        if let Some(words) = self.overlap_at_start(sunk.grain, speed) {
            return (failure, words.0, words.1);
        }
        // What would have held it: at rest, in the impact, and against what has pressed it in.
        let asked = self.burden().asks_of(law);
        let pressed = harder_at_rest(law, sunk.overlap / (ONE_ON_ONE * diameter));
        let impact = harder_in_impact(law, stopping / (IN_IMPACT * diameter));
        let harder = self.harder(asked.max(pressed).max(impact));
        let hardness = self.hardness();
        if at_rest > 0.5 * DEEPEST {
            let cause = format!(
                "contacts are too soft: at a {hardness} weight causes overlaps of {at_rest:.2e} of a diameter"
            );
            return (failure, cause, harder);
        }
        let substep = 1.0 / f64::from(self.part.substeps().unwrap_or(1));
        if speed * substep > 0.5 * sunk.radius {
            let cause = format!(
                "the sub-step is too long: the grain moves {:.2} of its radius in one, and the contact is seen too late",
                speed * substep / grain.radius
            );
            return (failure, cause, self.shorter(speed));
        }
        if speed > MAX_SPEED {
            let why = match self.scene.is_dry {
                true => "too fast for its contacts to be seen in time",
                false => "at which the flow around it is unstable",
            };
            let cause = format!("the grain moves at {speed:.2} cells per time step, {why}");
            return (failure, cause, self.shorter(speed));
        }
        let cause = if stopping > 0.1 * sunk.radius {
            format!(
                "contacts are too soft for the speed at which it arrives ({:.3e} m/s): at a {hardness} they stop it in \
                 {:.1e} m",
                arrives * units.si_velocity(),
                stopping * units.si_dx
            )
        } else {
            format!(
                "contacts are too soft ({hardness}) for the {:.2e} N with which {} press on it",
                law.at(sunk.overlap, radius, mass).stiffness * sunk.overlap * units.si_force(),
                if self.scene.is_dry { "other grains" } else { "fluid and other grains" }
            )
        };
        (failure, cause, harder)
    }

    /// A grain that contacts have thrown.
    fn thrown(&self, grain: usize, speed: f64, gained: f64) -> Words {
        let si = self.scene.units.si_velocity();
        let failure = format!(
            "grain {grain} (counted from 0) moves at {:.3e} m/s, {speed:.2} cells per time step, and contacts have given \
             it {:.3e} m/s in the last step",
            speed * si,
            gained * si
        );
        let (cause, remedy) = self.overlap_at_start(grain, speed).unwrap_or_else(|| {
            let cause = "a contact was compressed too far and has rebounded".to_owned();
            (cause, self.shorter(speed))
        });
        (failure, cause, remedy)
    }

    /// A grain that is nowhere.
    fn nowhere(&self, grain: usize, position: &[f64; 3], is_fluid: bool) -> Words {
        let failure = match position.iter().all(|x| x.is_finite()) {
            true => {
                format!("grain {grain} (counted from 0) is too far away for cells to be numbered")
            }
            false => format!("the position of grain {grain} (counted from 0) is not a number"),
        };
        match is_fluid {
            true => {
                let cause =
                    "the hydrodynamic force on a grain is not a number: the flow is unstable"
                        .to_owned();
                (failure, cause, "use a shorter time step or a finer grid".to_owned())
            }
            false => {
                let cause = match self.scene.is_dry {
                    true => "contacts: nothing else acts on it but its weight".to_owned(),
                    false => "contacts: all hydrodynamic forces are finite".to_owned(),
                };
                let remedy = "look for grains at the same position at the start, and leave [contact] out to have it \
                              chosen";
                (failure, cause, remedy.to_owned())
            }
        }
    }

    /// Whether an overlap at the start explains the speed of a grain: cause and remedy.
    fn overlap_at_start(&self, grain: usize, speed: f64) -> Option<(String, String)> {
        let FreePart { setup, grains, planes, .. } = self.part;
        let start = GrainSystem::new(*setup, grains.clone(), planes.clone()).ok()?;
        let at_start = hold::deepest_of(&start, grain)?;
        // A part of it is enough to blame it.
        let overlap = at_start.overlap.max(0.0);
        let thrown = setup.law.speed_of_release(overlap, at_start.radius, grains[grain].mass);
        if at_start.overlap <= 0.0 || speed == 0.0 || thrown < 0.5 * speed {
            return None;
        }
        let units = &self.scene.units;
        let cause = format!(
            "an overlap of {:.2e} m at the start, whose spring accelerates it to up to {:.2e} m/s",
            at_start.overlap * units.si_dx,
            thrown * units.si_velocity()
        );
        let softer = match setup.law {
            Law::Linear(_) => "make contacts longer (`contact.duration`)",
            Law::Hertz(_) => "take a smaller `contact.youngs_modulus`",
        };
        Some((cause, format!("move the grains apart at the start, or {softer}")))
    }

    fn burden(&self) -> Burden {
        let g = self.part.settings.gravity.as_ref().map_or_else(Vec3::zeros, Gravity::acceleration);
        let setup = &self.scene.setup;
        Burden::new(&self.part.grains, &g, &setup.domain, self.scene.around())
    }

    /// The remedy of contacts that are so many times as stiff.
    fn harder(&self, times: f64) -> String {
        let (law, units) = (&self.part.setup.law, &self.scene.units);
        match law {
            Law::Linear(linear) => {
                let chosen = match self.burden().asks_of(law) > 1.0 / 0.99 {
                    true => {
                        "leave `stiffness` and `duration` of [contact] out to have them chosen, or "
                    }
                    false => "",
                };
                let si_stiffness = 1.01 * times * linear.stiffness * units.si_stiffness();
                format!("{chosen}use contact.stiffness = {si_stiffness:.2e} (N/m) or more")
            }
            Law::Hertz(law) => {
                let si_modulus = 1.01 * times * law.material.youngs_modulus * units.si_pressure();
                format!("use contact.youngs_modulus = {si_modulus:.2e} (Pa) or more")
            }
        }
    }

    /// How hard contacts are, in words.
    fn hardness(&self) -> String {
        let units = &self.scene.units;
        match &self.part.setup.law {
            Law::Linear(law) => {
                format!("stiffness of {:.3e} N/m", law.stiffness * units.si_stiffness())
            }
            Law::Hertz(law) => {
                let si_modulus = law.material.youngs_modulus * units.si_pressure();
                format!("modulus of {si_modulus:.3e} Pa")
            }
        }
    }

    /// The remedy of a shorter time step, with which a grain of this speed is slow enough.
    fn shorter(&self, speed: f64) -> String {
        let si_dt = self.scene.units.si_dt * (0.5 * MAX_SPEED / speed).min(0.5);
        format!("use a shorter time step: time.dt = {si_dt:.2e} (s) or less")
    }

    /// The face of a plane, in words.
    fn face(&self, plane: usize) -> String {
        let normal = self.system.planes()[plane].normal;
        let axis = normal.iamax();
        let side = if normal[axis] > 0.0 { "low" } else { "high" };
        format!("the face {}_{side}", ["x", "y", "z"][axis])
    }
}
