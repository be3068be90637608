//! What a set of grains is set up with, and the checks that it makes sense.

use crate::grains::grain::Grain;
use crate::grains::law::LawError;
use crate::grains::laws::Law;
use crate::grains::lubrication::{Lubrication, LubricationError};
use crate::grains::motion::{SubstepError, Substeps};
use crate::grains::plane::{Plane, PlaneError};
use crate::grains::sunk::Sunk;
use crate::lattice::Vec3;
use thiserror::Error;

/// Which axes are periodic: along these the domain spans `0..length`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PeriodicBox {
    /// Length of the domain along x, y, z; `None`: not periodic.
    pub lengths: [Option<f64>; 3],
}

impl PeriodicBox {
    /// Periodic along all three axes.
    pub fn all(lengths: [f64; 3]) -> Self {
        PeriodicBox { lengths: lengths.map(Some) }
    }

    /// The place inside the domain of which `position` is an image.
    pub fn wrap(&self, position: &Vec3) -> Vec3 {
        Vec3::from_fn(|i, _| {
            let length = self.lengths[i];
            length
                .map_or(position[i], |length| position[i] - (position[i] / length).floor() * length)
        })
    }

    /// From `first` to `second` moved by `image` lengths of the domain.
    pub fn offset(&self, first: &Vec3, second: &Vec3, image: [i32; 3]) -> Vec3 {
        // x₂ + k L - x₁
        let moved = Vec3::from_fn(|i, _| {
            self.lengths[i].map_or(0.0, |length| f64::from(image[i]) * length)
        });
        (second - first) + moved
    }
}

/// Everything but the grains and planes themselves, in any consistent units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainSetup {
    /// How grains touch each other. (Each plane has a law of its own.)
    pub law: Law,
    /// Gravity, length/time²: acts on each grain with its mass. Buoyancy is for the caller to take
    /// off, here or in the loads.
    pub gravity: Vec3,
    /// Periodic axes.
    pub sides: PeriodicBox,
    /// Lubrication correction; `None`: none.
    pub lubrication: Option<Lubrication>,
    /// How sub-steps are chosen.
    pub substeps: Substeps,
}

/// Grains that cannot be moved.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GrainError {
    /// A value of a grain.
    #[error("grain {grain} has {key} = {value}: {allowed}")]
    BadGrain {
        /// Number of the grain.
        grain: usize,
        /// Name of the value.
        key: &'static str,
        /// The value as given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Gravity that is not finite.
    #[error("gravity = {value:?}: each component must be finite")]
    Gravity {
        /// The vector as given.
        value: [f64; 3],
    },
    /// More grains than can be numbered.
    #[error("{count} grains are too many to be numbered: use fewer than 2^32 - 1")]
    TooMany {
        /// Their number.
        count: usize,
    },
    /// A grain would touch its own image.
    #[error(
        "the box is {length} long along its periodic axis {axis}: it must be longer than \
         {diameter}, the largest diameter (with the reach of lubrication), or a grain would touch \
         its own image; lengthen the box"
    )]
    BoxTooShort {
        /// The axis, x, y or z.
        axis: char,
        /// Length as given.
        length: f64,
        /// What it must exceed.
        diameter: f64,
    },
    /// The contact law.
    #[error(transparent)]
    Law(#[from] LawError),
    /// A plane.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// Lubrication.
    #[error(transparent)]
    Lubrication(#[from] LubricationError),
    /// The sub-step.
    #[error(transparent)]
    Substep(#[from] SubstepError),
    /// A contact that does not hold.
    #[error(transparent)]
    Sunk(#[from] Sunk),
    /// A contact that has thrown a grain.
    #[error(
        "grain {grain} moves at {speed} lengths per step, past the limit of {limit}, and contacts have given it \
         {gained} of that in the last step"
    )]
    Thrown {
        /// Number of the grain.
        grain: usize,
        /// Its speed, cells per time step.
        speed: f64,
        /// What contacts have given it in the last step, cells per time step.
        gained: f64,
        /// The limit, cells per time step.
        limit: f64,
    },
    /// The motion has broken down.
    #[error(
        "grain {grain} is at {position:?}: its motion has broken down; look for two grains at the \
         same place at the start, for loads that are not finite, and for a time step too long"
    )]
    NotFinite {
        /// Number of the grain.
        grain: usize,
        /// Where it is.
        position: [f64; 3],
    },
}

impl GrainSetup {
    /// Grains that touch by `law`; no gravity, no periodic axes, no lubrication.
    pub fn new(law: impl Into<Law>) -> Self {
        GrainSetup {
            law: law.into(),
            gravity: Vec3::zeros(),
            sides: PeriodicBox::default(),
            lubrication: None,
            substeps: Substeps::Automatic,
        }
    }

    /// Gap at which grains begin to act on each other, length.
    pub fn range(&self) -> f64 {
        self.lubrication.map_or(0.0, |lubrication| lubrication.cutoff_gap)
    }

    /// Errors unless these grains and planes can be moved.
    pub fn check(&self, grains: &[Grain], planes: &[Plane]) -> Result<(), GrainError> {
        self.law.checked()?;
        if let Some(lubrication) = self.lubrication {
            lubrication.checked()?;
        }
        if !self.gravity.iter().all(|value| value.is_finite()) {
            return Err(GrainError::Gravity { value: self.gravity.into() });
        }
        if grains.len() >= u32::MAX as usize {
            return Err(GrainError::TooMany { count: grains.len() });
        }
        let periodic = self.sides.lengths.map(|length| length.is_some());
        for (number, plane) in planes.iter().enumerate() {
            plane.check(number, periodic)?;
        }
        for (number, grain) in grains.iter().enumerate() {
            check_grain(number, grain)?;
        }
        let diameter = 2.0 * grains.iter().map(|grain| grain.radius).fold(0.0, f64::max);
        let diameter = diameter + self.range();
        for (axis, length) in ['x', 'y', 'z'].into_iter().zip(self.sides.lengths) {
            if let Some(length) = length.filter(|&l| !(l > diameter && l.is_finite())) {
                return Err(GrainError::BoxTooShort { axis, length, diameter });
            }
        }
        Ok(())
    }

    /// Distance beyond the range up to which the list of pairs looks ahead, length: a fifth of the
    /// smallest diameter, or what the domain leaves room for.
    pub fn skin(&self, grains: &[Grain]) -> f64 {
        let radii = || grains.iter().map(|grain| grain.radius);
        let (smallest, largest) =
            (radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max));
        let room = |length: &f64| length - 2.0 * largest - self.range();
        let rooms = self.sides.lengths.iter().flatten().map(room);
        rooms.fold(0.4 * smallest, f64::min)
    }

    /// The shortest time scale that a sub-step must resolve: of contacts between free grains or between
    /// these and planes, and of lubrication.
    pub fn shortest_time(&self, grains: &[Grain], planes: &[Plane]) -> f64 {
        let free = || grains.iter().filter(|grain| !grain.held);
        let among_grains = self.law.shortest_time(grains);
        let on_planes = planes.iter().map(|plane| plane.law.shortest_time_on_plane(grains));
        // A dashpot of strength c stops a mass in m/c; a sub-step of a fifth of that is safe.
        let calming = |grain: &Grain| {
            self.lubrication
                .map(|law| 5.0 * grain.mass / law.at_plane(law.smallest_gap, grain.radius))
        };
        on_planes.chain(free().filter_map(calming)).fold(among_grains, f64::min)
    }
}

/// Errors unless the values of grain number `grain` can be used.
fn check_grain(grain: usize, values: &Grain) -> Result<(), GrainError> {
    let bad = |key, value, allowed| Err(GrainError::BadGrain { grain, key, value, allowed });
    let vectors = [
        ("position", values.position),
        ("velocity", values.velocity),
        ("spin", values.angular_velocity),
    ];
    for (key, vector) in vectors {
        if let Some(&value) = vector.iter().find(|component| !component.is_finite()) {
            return bad(key, value, "it must be finite");
        }
    }
    let sizes =
        [("radius", values.radius), ("mass", values.mass), ("moment of inertia", values.inertia)];
    for (key, value) in sizes {
        if !(value > 0.0 && value.is_finite()) {
            return bad(key, value, "it must be positive and finite");
        }
    }
    Ok(())
}
