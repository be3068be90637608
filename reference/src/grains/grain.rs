//! A grain: a rigid sphere with its motion.

use crate::lattice::Vec3;
use nalgebra::UnitQuaternion;
use std::f64::consts::PI;

/// A spherical grain, in any consistent units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Its centre, length. Along periodic axes it is never wrapped: a grain that leaves the domain goes
    /// on counting; see [`crate::grains::setup::PeriodicBox::wrap`].
    pub position: Vec3,
    /// Velocity of the centre, length/time.
    pub velocity: Vec3,
    /// Angular velocity, 1/time.
    pub angular_velocity: Vec3,
    /// How the grain has turned since the start; for output only, no force depends on it.
    pub orientation: UnitQuaternion<f64>,
    /// Radius, length.
    pub radius: f64,
    /// Mass.
    pub mass: f64,
    /// Moment of inertia about any axis through the centre, mass · length².
    pub inertia: f64,
    /// Keeps its velocity and angular velocity whatever acts on it.
    pub held: bool,
}

impl Grain {
    /// A solid sphere at rest; `density` is mass/length³.
    pub fn sphere(position: Vec3, radius: f64, density: f64) -> Self {
        // m = (4/3) π R³ ρ,  I = (2/5) m R²
        let mass = sphere_volume(radius) * density;
        Grain {
            position,
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
            orientation: UnitQuaternion::identity(),
            radius,
            mass,
            inertia: 0.4 * mass * radius * radius,
            held: false,
        }
    }

    /// The same with a velocity, length/time.
    #[must_use]
    pub fn moving(self, velocity: Vec3) -> Self {
        Grain { velocity, ..self }
    }

    /// The same with an angular velocity, 1/time.
    #[must_use]
    pub fn spinning(self, angular_velocity: Vec3) -> Self {
        Grain { angular_velocity, ..self }
    }

    /// Kinetic energy of translation and rotation, mass · length²/time².
    pub fn kinetic_energy(&self) -> f64 {
        // (m v² + I ω²)/2
        0.5 * (self.mass * self.velocity.norm_squared()
            + self.inertia * self.angular_velocity.norm_squared())
    }
}

/// Volume of a sphere of `radius`.
pub fn sphere_volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}
