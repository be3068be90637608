//! SI units and lattice units. What carries the prefix `si_` is in SI units, all else in cells,
//! time steps and multiples of the fluid's reference density.

use psmrt_reference::lattice::{CS2, Vec3};

/// The three scales that turn lattice units into SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Edge of a cell, m.
    pub si_dx: f64,
    /// Time step, s.
    pub si_dt: f64,
    /// Density of the fluid, kg/m3.
    pub si_density: f64,
}

impl Units {
    /// One cell per time step, m/s.
    pub fn si_velocity(&self) -> f64 {
        self.si_dx / self.si_dt
    }

    /// One cell per time step squared, m/s2.
    pub fn si_acceleration(&self) -> f64 {
        self.si_dx / self.si_dt / self.si_dt
    }

    /// One unit of kinematic viscosity, m2/s.
    pub fn si_viscosity(&self) -> f64 {
        self.si_dx * self.si_dx / self.si_dt
    }

    /// One radian per time step, rad/s.
    pub fn si_angular_velocity(&self) -> f64 {
        1.0 / self.si_dt
    }

    /// One unit of pressure, Pa.
    pub fn si_pressure(&self) -> f64 {
        self.si_density * self.si_velocity() * self.si_velocity()
    }

    /// One unit of force, N.
    pub fn si_force(&self) -> f64 {
        self.si_pressure() * self.si_dx * self.si_dx
    }

    /// One unit of torque, N m.
    pub fn si_torque(&self) -> f64 {
        self.si_force() * self.si_dx
    }

    /// One unit of mass, kg.
    pub fn si_mass(&self) -> f64 {
        self.si_density * self.si_dx.powi(3)
    }

    /// One unit of stiffness, N/m.
    pub fn si_stiffness(&self) -> f64 {
        self.si_mass() / (self.si_dt * self.si_dt)
    }

    /// One unit of damping, N s/m.
    pub fn si_damping(&self) -> f64 {
        self.si_mass() / self.si_dt
    }

    /// All of them, SI units.
    pub fn si_all(&self) -> [f64; 10] {
        [
            self.si_velocity(),
            self.si_acceleration(),
            self.si_viscosity(),
            self.si_angular_velocity(),
            self.si_pressure(),
            self.si_force(),
            self.si_torque(),
            self.si_mass(),
            self.si_stiffness(),
            self.si_damping(),
        ]
    }

    /// Lattice density at a pressure (Pa) above that of density 1.
    pub fn density_at(&self, si_pressure: f64) -> f64 {
        // p = c_s² ρ
        1.0 + si_pressure / self.si_pressure() / CS2
    }

    /// Pressure (Pa) above that of density 1 at a lattice density.
    pub fn si_gauge_pressure(&self, density: f64) -> f64 {
        CS2 * (density - 1.0) * self.si_pressure()
    }

    /// A vector in SI units divided by `si_unit`.
    pub fn to_lattice(si_vector: [f64; 3], si_unit: f64) -> Vec3 {
        Vec3::from(si_vector) / si_unit
    }
}
