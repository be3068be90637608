//! Exact solutions to compare a run with.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::Face;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::Setup;

use crate::units::Units;

/// Steady flow between two parallel walls at rest, driven by a body force along them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePoiseuille {
    /// Axis of the flow: 0, 1 or 2.
    pub along: usize,
    /// Axis from wall to wall.
    pub across: usize,
    /// Distance between the walls, m.
    pub si_gap: f64,
    /// Body force per mass along the flow, m/s2.
    pub si_acceleration: f64,
    /// Kinematic viscosity, m2/s.
    pub si_viscosity: f64,
    /// Velocity that the half-way bounce-back wall adds everywhere, m/s: known in closed form.
    pub si_wall_slip: f64,
}

impl PlanePoiseuille {
    /// The solution of a set-up; if the set-up is no such flow, why not and what to change.
    pub fn of(setup: &Setup, units: &Units) -> Result<Self, (String, String)> {
        let no = |why: &str, remedy: &str| {
            Err((format!("this scene is no plane Poiseuille flow: {why}"), remedy.to_owned()))
        };
        let faces = setup.domain.faces();
        let walls: Vec<_> = (0..3).filter(|&i| faces.axis(i) == [Face::wall(); 2]).collect();
        let open = (0..3).filter(|&axis| faces.axis(axis) == [Face::Periodic; 2]).count();
        let (&[across], 2) = (walls.as_slice(), open) else {
            return no(
                "it needs walls at rest at both faces of one axis, all else periodic",
                "set the two faces of one axis to `kind = \"wall\"`, or remove [compare]",
            );
        };
        if setup.solid_phase.is_some() {
            return no("there are grains in it", "remove them, or remove [compare]");
        }
        let Some(force) = setup.body_force else {
            return no("no body force drives it", "add [body_force], or remove [compare]");
        };
        let driven: Vec<_> = (0..3).filter(|&axis| force[axis] != 0.0).collect();
        let &[along] = driven.as_slice() else {
            return no("the body force must act along one axis", "set the others to 0");
        };
        if along == across {
            return no("the body force pushes at the walls", "let it act along the walls");
        }
        let tau = setup.collision.tau();
        let si_viscosity = psmrt_reference::lattice::viscosity(tau) * units.si_viscosity();
        Ok(PlanePoiseuille {
            along,
            across,
            si_gap: setup.domain.cells()[across] as f64 * units.si_dx,
            si_acceleration: force[along] * units.si_acceleration(),
            si_viscosity,
            si_wall_slip: wall_slip(&setup.collision, force[along]) * units.si_velocity(),
        })
    }

    /// Velocity along the flow at the distance `si_y` from the lower wall, m/s.
    pub fn si_velocity(&self, si_y: f64) -> f64 {
        // u = a y (H - y)/(2 ν)
        self.si_acceleration / (2.0 * self.si_viscosity) * si_y * (self.si_gap - si_y)
    }

    /// Largest velocity, m/s.
    pub fn si_top_velocity(&self) -> f64 {
        self.si_velocity(0.5 * self.si_gap)
    }
}

/// Velocity that half-way bounce-back adds to the exact profile, lattice units.
///
/// Source: Ginzburg & d'Humières, Phys. Rev. E 68, 066614 (2003).
fn wall_slip(collision: &Collision, body_force: f64) -> f64 {
    // u_slip = G (16 L - 3)/(24 ν)
    let nu = psmrt_reference::lattice::viscosity(collision.tau());
    body_force * (16.0 * magic_parameter(collision) - 3.0) / (24.0 * nu)
}

/// The parameter `L` of a collision on which the place of a plane wall depends; 3/16 is exact.
///
/// Source: Ginzburg & d'Humières, Phys. Rev. E 68, 066614 (2003).
pub fn magic_parameter(collision: &Collision) -> f64 {
    let (tau, q, m) = match collision {
        Collision::Srt { tau } => (*tau, 1.0 / tau, 1.0 / tau),
        Collision::Mrt { rates: rates @ Rates { q, m, .. } } => (rates.tau(), *q, *m),
    };
    // L = (τ - 1/2) [(1/s_q - 1/2) + 3 (1/s_m - 1/2)]/4
    (tau - 0.5) * ((1.0 / q - 0.5) + 3.0 * (1.0 / m - 0.5)) / 4.0
}

/// How far computed velocities are from the exact ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Distance from the wall (m), computed velocity (m/s), exact velocity (m/s).
    pub si_rows: Vec<[f64; 3]>,
    /// `sqrt(sum (u - exact)^2 / sum exact^2)`
    pub relative_l2: f64,
    /// Largest difference over the largest exact velocity.
    pub relative_max: f64,
    /// The relative L2 error that the wall's known slip alone would make.
    pub explained_l2: f64,
}

impl Comparison {
    /// Compares the velocities along the flow (m/s) in the cells from wall to wall.
    pub fn new(exact: &PlanePoiseuille, si_velocities: &[f64]) -> Self {
        let n = si_velocities.len() as f64;
        let si_rows: Vec<[f64; 3]> = (0..)
            .zip(si_velocities)
            .map(|(i, &u)| {
                let si_y = (f64::from(i) + 0.5) / n * exact.si_gap;
                [si_y, u, exact.si_velocity(si_y)]
            })
            .collect();
        let gauge = si_rows.iter().map(|[_, _, e]| e * e).sum::<f64>().sqrt();
        let norm = si_rows.iter().map(|[_, u, e]| (u - e).powi(2)).sum::<f64>().sqrt();
        let max = si_rows.iter().map(|[_, u, e]| (u - e).abs()).fold(0.0, f64::max);
        Comparison {
            relative_l2: norm / gauge,
            relative_max: max / exact.si_top_velocity().abs(),
            explained_l2: exact.si_wall_slip.abs() * n.sqrt() / gauge,
            si_rows,
        }
    }
}
