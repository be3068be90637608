//! Periodic arrays of spheres in slow flow: set-up and what is measured. Shared by the acceptance
//! tests and `reference/examples/array_study.rs`.
//!
//! A body force `G` along x drives the fluid through fixed spheres, one, two or four to a cubic cell.
//! The steady flow obeys two balances:
//!
//! ```text
//!   whole cell, what G puts in and the solids take out:   Σ F_s = Σ_cells (1 - B) G    (1)
//!   the law to be tested:                                 G V = n 6π μ a K U            (2)
//! ```
//!
//! `K` is taken from (2), in which the force per sphere is that of a pressure gradient `G` on all of
//! the cell's volume: a statement about the flow alone, as in the tables (`|dP/dz| V_cell`). The other
//! reading, the measured force on the spheres plus the buoyancy `G φ V` that a pressure gradient would
//! add ([`Flow::k_from_force`]), has the same limit, but by (1) it differs by
//! `(φ - Σ B/V) G V`: the sum of the weights `B` instead of the volume. That is an error of the
//! bookkeeping, of first order in the cell size, and says nothing of the flow.

use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::guard::Stopped;
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;
use std::f64::consts::PI;

/// Simple, body-centred and face-centred cubic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lattice {
    Sc,
    Bcc,
    Fcc,
}

impl Lattice {
    pub fn name(self) -> &'static str {
        match self {
            Lattice::Sc => "SC",
            Lattice::Bcc => "BCC",
            Lattice::Fcc => "FCC",
        }
    }

    /// Centres of the spheres in units of the cell's side.
    pub fn centres(self) -> &'static [[f64; 3]] {
        match self {
            Lattice::Sc => &[[0.0, 0.0, 0.0]],
            Lattice::Bcc => &[[0.0, 0.0, 0.0], [0.5, 0.5, 0.5]],
            Lattice::Fcc => &[[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]],
        }
    }
}

/// Which part of the cubic cell is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// All of it, the spheres moved off the corners of the grid by this much.
    Whole { shift: [f64; 3] },
    /// The quarter between the mirror planes through the centres, y = 0, L/2 and z = 0, L/2.
    Quarter,
}

/// An array and how its flow is computed.
#[derive(Clone, Copy, Debug)]
pub struct Array {
    pub lattice: Lattice,
    pub solid_fraction: f64,
    /// Cells along the side of the cubic cell; even.
    pub side: usize,
    pub part: Part,
    pub collision: Collision,
    pub weighting: Weighting,
    pub operator: SolidOperator,
    /// Reynolds number `2 a U/nu` that the exact drag would give.
    pub reynolds: f64,
}

/// What the steady flow says.
#[derive(Clone, Copy, Debug)]
pub struct Flow {
    /// `K` from the balance (2) of the module.
    pub k: f64,
    /// `K` from the force on the spheres plus buoyancy.
    pub k_from_force: f64,
    /// Force on the spheres over `Σ (1 - B) G`, less one: the balance (1).
    pub imbalance: f64,
    /// Reynolds number of the flow found.
    pub reynolds: f64,
    pub steps: u64,
    pub cell_updates: u64,
}

impl Array {
    /// Radius of the spheres in cells.
    pub fn radius(&self) -> f64 {
        // n 4/3 π a³ = φ L³
        let n = self.lattice.centres().len() as f64;
        self.side as f64 * (3.0 * self.solid_fraction / (4.0 * PI * n)).cbrt()
    }

    /// Drives the fluid until its flux changes by less than `tolerance` of itself in each of three
    /// windows; `k_exact` sets the scale of force and time. `run` makes the steps.
    #[expect(clippy::cast_possible_truncation, reason = "numbers of steps are far below 2^53")]
    pub fn flow(
        &self,
        k_exact: f64,
        tolerance: f64,
        mut run: impl FnMut(&mut Solver, u64) -> Result<(), Stopped>,
    ) -> Result<Flow, Stopped> {
        let (a, nu, n) = (self.radius(), self.viscosity(), self.lattice.centres().len() as f64);
        let volume = (self.side as f64).powi(3);
        let u_exact = self.reynolds * nu / (2.0 * a);
        let stokes = n * 6.0 * PI * nu * a; // Σ F/(K U) at density 1
        let g = stokes * k_exact * u_exact / volume;
        let mut solver = self.solver(g, u_exact);
        let flux = |solver: &Solver| {
            let field = solver.mass_flux_field();
            field.iter().map(|j| j.x).sum::<f64>() / field.len() as f64
        };

        // The drag stops the fluid in V/(n 6π ν a K) steps: the slowest time of the array. With three
        // windows of half of it below `tolerance`, about half of `tolerance` is left to go.
        let window = (0.5 * volume / (stokes * k_exact)).ceil() as u64 + 8;
        let (mut last, mut steady) = (0.0, 0);
        while steady < 3 {
            run(&mut solver, window)?;
            let now = flux(&solver);
            steady = if (now - last).abs() <= tolerance * now.abs() { steady + 1 } else { 0 };
            last = now;
        }

        let cells = solver.domain().cell_count();
        let share = volume / cells as f64;
        let u = last / (solver.density_field().iter().sum::<f64>() / cells as f64);
        let force: f64 = share * solver.loads().iter().map(|load| load.force.x).sum::<f64>();
        let weights: f64 = share * self.weights(&solver);
        Ok(Flow {
            k: g * volume / (stokes * u),
            k_from_force: (force + g * self.solid_fraction * volume) / (stokes * u),
            imbalance: force / ((volume - weights) * g) - 1.0,
            reynolds: 2.0 * a * u / nu,
            steps: solver.steps(),
            cell_updates: solver.steps() * cells as u64,
        })
    }

    pub fn viscosity(&self) -> f64 {
        viscosity(self.collision.tau())
    }

    fn solver(&self, g: f64, u: f64) -> Solver {
        let side = self.side;
        let (cells, faces, shift) = match self.part {
            Part::Whole { shift } => ([side; 3], Faces::PERIODIC, shift),
            Part::Quarter => {
                let mirror = [Face::FreeSlip; 2];
                let faces = Faces { y: mirror, z: mirror, ..Faces::PERIODIC };
                ([side, side / 2, side / 2], faces, [0.0; 3])
            }
        };
        let place = |c: &[f64; 3]| Vec3::from(*c) * side as f64 + Vec3::from(shift);
        let spheres = self.lattice.centres().iter().map(place);
        let spheres = spheres.map(|centre| Solid::fixed_sphere(centre, self.radius()));
        let domain = Domain::new(cells, faces).unwrap();
        let setup = Setup::fluid(domain, self.collision)
            .with_body_force(Vec3::new(g, 0.0, 0.0))
            .with_solids(SolidPhase {
                solids: spheres.collect(),
                weighting: self.weighting,
                operator: self.operator,
                ..SolidPhase::default()
            });
        Solver::starting_from(setup, |_| (1.0, Vec3::new(u, 0.0, 0.0))).unwrap()
    }

    /// Sum of the weights `B` over the cells.
    fn weights(&self, solver: &Solver) -> f64 {
        let coverage = solver.coverage().unwrap();
        (0..solver.domain().cell_count())
            .map(|cell| coverage.solid_fraction(cell))
            .map(|epsilon| self.weighting.weight(epsilon, self.collision.tau()))
            .sum()
    }
}
