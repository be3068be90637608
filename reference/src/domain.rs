//! The domain, a domain of cells, and its six faces: vocabulary that every engine shares.
//!
//! A domain of `n` cells along an axis spans `0..n` in lattice units; cell `i` has its centre, where
//! its node lies, at `i + 1/2`. Faces lie half a cell outside the outermost nodes. Cells are
//! numbered with x fastest: `index = x + nx (y + ny z)`.

use crate::lattice::Vec3;
use std::ops::RangeInclusive;
use thiserror::Error;

/// What happens at one face of the domain. Velocities and densities in lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Face {
    /// What leaves here enters at the opposite face.
    Periodic,
    /// No-slip wall, half-way bounce-back; `velocity` must lie in the plane of the wall.
    Wall {
        /// Velocity of the wall.
        velocity: Vec3,
    },
    /// Free-slip wall: a mirror plane.
    FreeSlip,
    /// Fluid of a given velocity enters.
    VelocityInlet {
        /// Velocity at the face.
        velocity: Vec3,
    },
    /// Free outflow: zero gradient along the normal.
    FreeOutflow,
    /// Outlet (or inlet) at constant pressure `density/3`.
    Pressure {
        /// Density at the face.
        density: f64,
    },
    /// The same for a flow that does not change along the normal: shear stress is let through.
    DevelopedPressure {
        /// Density at the face.
        density: f64,
    },
    /// The same, and sound leaves through it: for a while the density at the face follows the wave that arrives.
    NonReflectingPressure {
        /// Density at the face over times longer than `memory`.
        density: f64,
        /// Steps over which the face holds `density` again, at least 1.
        memory: f64,
    },
}

impl Face {
    /// The density that the face holds, if it holds one.
    pub fn held_density(&self) -> Option<f64> {
        match *self {
            Face::Pressure { density }
            | Face::DevelopedPressure { density }
            | Face::NonReflectingPressure { density, .. } => Some(density),
            _ => None,
        }
    }

    /// A no-slip wall at rest.
    pub const fn wall() -> Self {
        Face::Wall { velocity: Vec3::new(0.0, 0.0, 0.0) }
    }
}

/// The faces of the three axes, each `[low, high]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Faces {
    /// Faces `-x` and `+x`.
    pub x: [Face; 2],
    /// Faces `-y` and `+y`.
    pub y: [Face; 2],
    /// Faces `-z` and `+z`.
    pub z: [Face; 2],
}

impl Faces {
    /// All six faces periodic.
    pub const PERIODIC: Faces =
        Faces { x: [Face::Periodic; 2], y: [Face::Periodic; 2], z: [Face::Periodic; 2] };

    /// The two faces of axis 0, 1 or 2.
    pub fn axis(&self, axis: usize) -> [Face; 2] {
        [self.x, self.y, self.z][axis]
    }
}

/// Names of the faces, `FACE_NAMES[axis][side]`, as scenes spell them.
pub const FACE_NAMES: [[&str; 2]; 3] = [["-x", "+x"], ["-y", "+y"], ["-z", "+z"]];

/// A domain or a combination of faces that makes no sense.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DomainError {
    /// No cells along an axis.
    #[error("the domain of {cells:?} cells is empty: each axis needs at least 1 cell")]
    Empty {
        /// Cells along x, y, z as given.
        cells: [usize; 3],
    },
    /// More cells than can be numbered.
    #[error(
        "the domain of {cells:?} cells is too large to be numbered: use fewer than 2^32 - 1 cells"
    )]
    TooLarge {
        /// Cells along x, y, z as given.
        cells: [usize; 3],
    },
    /// One face of a pair is periodic, the other is not.
    #[error("face {face} is periodic but face {opposite} is not: make both periodic or neither")]
    UnpairedPeriodic {
        /// The periodic face.
        face: &'static str,
        /// Its opposite.
        opposite: &'static str,
    },
    /// A wall that moves through itself.
    #[error(
        "the wall at face {face} has the velocity {normal} along its normal: a wall moves in its \
         own plane only; use a velocity inlet to push fluid through a face"
    )]
    WallThroughItself {
        /// The face.
        face: &'static str,
        /// Component of the velocity along the axis.
        normal: f64,
    },
    /// A velocity, density or memory that is not a number, or a density or memory that is too small.
    #[error("face {face} has {key} = {value}: it must be finite{and_positive}")]
    BadValue {
        /// The face.
        face: &'static str,
        /// Name of the value.
        key: &'static str,
        /// The value as given.
        value: f64,
        /// What is asked of it besides, for example " and positive".
        and_positive: &'static str,
    },
    /// Fluid enters and cannot leave, or the reverse.
    #[error(
        "face {face} is a velocity inlet but no face lets the fluid out: make one face a free \
         outflow or a pressure outlet"
    )]
    InletWithoutOutlet {
        /// The inlet.
        face: &'static str,
    },
    /// A zero-gradient outlet with nothing that drives the flow to it.
    #[error(
        "face {face} is a free outflow but no face is a velocity inlet or holds a pressure: \
         nothing determines the flow; add an inlet or use a pressure outlet"
    )]
    OutflowWithoutInlet {
        /// The outflow.
        face: &'static str,
    },
}

/// The domain: its cells and what happens at its faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain {
    cells: [usize; 3],
    faces: Faces,
}

impl Domain {
    /// A domain of `cells` along x, y, z. Errors if it is empty, too large, or its faces contradict
    /// each other.
    pub fn new(cells: [usize; 3], faces: Faces) -> Result<Self, DomainError> {
        if cells.contains(&0) {
            return Err(DomainError::Empty { cells });
        }
        let count = cells.iter().try_fold(1_usize, |product, &n| product.checked_mul(n));
        if count.is_none_or(|count| count >= u32::MAX as usize) {
            return Err(DomainError::TooLarge { cells });
        }
        check_faces(&faces)?;
        Ok(Domain { cells, faces })
    }

    /// Cells along x, y, z.
    pub fn cells(&self) -> [usize; 3] {
        self.cells
    }

    /// What happens at the faces.
    pub fn faces(&self) -> &Faces {
        &self.faces
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.cells.iter().product()
    }

    /// Number of the cell at `[x, y, z]`.
    pub fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.cells[0] * (y + self.cells[1] * z)
    }

    /// Coordinates of the cell of number `index`.
    pub fn coordinates(&self, index: usize) -> [usize; 3] {
        let [nx, ny, _] = self.cells;
        [index % nx, index / nx % ny, index / (nx * ny)]
    }

    /// Centre of the cell at `[x, y, z]`.
    pub fn centre(&self, [x, y, z]: [usize; 3]) -> Vec3 {
        Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5)
    }

    /// Whether axis 0, 1 or 2 is periodic.
    pub fn is_periodic(&self, axis: usize) -> bool {
        self.faces.axis(axis)[0] == Face::Periodic
    }

    /// Those of `cells` along an axis that the domain has: all of them where it is periodic.
    pub fn within(&self, axis: usize, cells: RangeInclusive<i64>) -> RangeInclusive<i64> {
        let n = i64::try_from(self.cells[axis]).unwrap_or(i64::MAX);
        if self.is_periodic(axis) {
            cells
        } else {
            (*cells.start()).max(0)..=(*cells.end()).min(n - 1)
        }
    }

    /// The cell at unbounded coordinates: wrapped along periodic axes, `None` outside the domain.
    pub fn locate(&self, unbounded: [i64; 3]) -> Option<[usize; 3]> {
        let mut inside = [0; 3];
        for axis in 0..3 {
            let n = i64::try_from(self.cells[axis]).ok()?;
            let along = unbounded[axis];
            let wrapped = if self.is_periodic(axis) { along.rem_euclid(n) } else { along };
            inside[axis] = usize::try_from(wrapped).ok().filter(|&x| x < self.cells[axis])?;
        }
        Some(inside)
    }
}

/// The combinations of faces that make no sense, each with its own message.
fn check_faces(faces: &Faces) -> Result<(), DomainError> {
    let all = || (0..3).flat_map(|axis| [0, 1].map(|side| (axis, side)));
    let any = |wanted: fn(&Face) -> bool| {
        all()
            .find(|&(axis, side)| wanted(&faces.axis(axis)[side]))
            .map(|(axis, side)| FACE_NAMES[axis][side])
    };
    for (axis, side) in all() {
        let name = FACE_NAMES[axis][side];
        match faces.axis(axis)[side] {
            Face::Periodic if faces.axis(axis)[1 - side] != Face::Periodic => {
                let opposite = FACE_NAMES[axis][1 - side];
                return Err(DomainError::UnpairedPeriodic { face: name, opposite });
            }
            Face::Wall { velocity } => {
                check_velocity(name, &velocity)?;
                if velocity[axis] != 0.0 {
                    return Err(DomainError::WallThroughItself {
                        face: name,
                        normal: velocity[axis],
                    });
                }
            }
            Face::VelocityInlet { velocity } => check_velocity(name, &velocity)?,
            Face::Pressure { density }
            | Face::DevelopedPressure { density }
            | Face::NonReflectingPressure { density, .. }
                if !(density > 0.0 && density.is_finite()) =>
            {
                return Err(DomainError::BadValue {
                    face: name,
                    key: "density",
                    value: density,
                    and_positive: " and positive",
                });
            }
            Face::NonReflectingPressure { memory, .. }
                if !(1.0..f64::INFINITY).contains(&memory) =>
            {
                return Err(DomainError::BadValue {
                    face: name,
                    key: "memory",
                    value: memory,
                    and_positive: " and at least 1 step",
                });
            }
            Face::Periodic
            | Face::FreeSlip
            | Face::FreeOutflow
            | Face::Pressure { .. }
            | Face::DevelopedPressure { .. }
            | Face::NonReflectingPressure { .. } => {}
        }
    }
    let inlet = any(|face| matches!(face, Face::VelocityInlet { .. }));
    let outflow = any(|face| matches!(face, Face::FreeOutflow));
    let pressure = any(|face| face.held_density().is_some());
    match (inlet, outflow, pressure) {
        (Some(face), None, None) => Err(DomainError::InletWithoutOutlet { face }),
        (None, Some(face), None) => Err(DomainError::OutflowWithoutInlet { face }),
        _ => Ok(()),
    }
}

/// Errors unless every component is finite.
fn check_velocity(face: &'static str, velocity: &Vec3) -> Result<(), DomainError> {
    match velocity.iter().find(|component| !component.is_finite()) {
        Some(&value) => {
            Err(DomainError::BadValue { face, key: "velocity", value, and_positive: "" })
        }
        None => Ok(()),
    }
}
