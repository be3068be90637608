//! What a plan must know of a scene: how long its grains are in cells, how crowded they are, how fast the
//! flow is, and how much there is to compute.

use std::f64::consts::PI;

use psmrt_reference::domain::Face;
use psmrt_reference::lattice::viscosity;
use psmrt_reference::partial_saturation::{SolidOperator, Weighting};
use psmrt_reference::solids::Solid;

use crate::cases::{CaseError, Table};
use crate::estimate::si_velocity;
use crate::estimate::spheres::spheres;
use crate::estimate::warnings::stability::mapped;
use crate::scene::Scene;
use crate::stability::limits::Measured;
use crate::tradeoff::evidence::SolidKnob;

const ARRAYS: &str = include_str!("../../golden/sphere_arrays/literature.csv");
const SHAFTS: &str = include_str!("../../golden/stokes_settling/literature.csv");

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
    /// Its walls; there are no grains.
    Plates {
        /// Cells from wall to wall.
        cells: f64,
    },
}

/// The facts of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// What limits it.
    pub limit: Limit,
    /// How its solid cells collide.
    pub solid: SolidKnob,
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
    /// The flow of the maps of stability that it is held to, and its velocity there, m/s; `None` if no
    /// velocity is known.
    pub mapped: Option<(Measured, f64)>,
    /// Longest time that the scene may run, s.
    pub si_time: f64,
}

impl Facts {
    /// The facts of a scene; if nothing in it limits the accuracy in a known way, why not.
    pub fn of(scene: &Scene) -> Result<Result<Self, String>, CaseError> {
        let setup = &scene.setup;
        let cells = setup.domain.cells();
        let units = &scene.units;
        let flat = [0, 1, 2].map(|axis| cells[axis] == 1 && setup.domain.is_periodic(axis));
        let spheres = spheres(scene);
        let nu = viscosity(setup.collision.tau());
        let mut velocity = si_velocity(scene).map(|(si_velocity, _)| si_velocity);
        let limit = if spheres.is_empty() {
            let gap = (0..3).filter(|&axis| {
                let faces = setup.domain.faces().axis(axis);
                faces.iter().all(|face| matches!(face, Face::Wall { .. }))
            });
            let Some(gap) = gap.map(|axis| cells[axis]).min() else {
                return Ok(Err(
                    "it has neither grains nor two walls that face each other: there is \
                               no error that the evidence knows"
                        .to_owned(),
                ));
            };
            Limit::Plates { cells: gap as f64 }
        } else {
            let smallest = spheres.iter().map(|s| 2.0 * s.1).fold(f64::INFINITY, f64::min);
            let (drag, because) = drag(scene, &spheres)?;
            if let (Some(force), None) = (setup.body_force, velocity) {
                // U = G V/(n 6π ν a K)
                let stokes: f64 = spheres.iter().map(|s| s.2 * 6.0 * PI * nu * s.1).sum();
                let volume = setup.domain.cell_count() as f64;
                velocity = Some(force.norm() * volume / (stokes * drag) * units.si_velocity());
            } else if scene.free.is_some() {
                // Neighbours and walls slow a grain that Stokes' law lets fall alone.
                velocity = velocity.map(|si_velocity| si_velocity / drag);
            }
            Limit::Grains { cells: smallest, drag, because }
        };
        let phase = setup.solid_phase.as_ref().map(|phase| (phase.weighting, phase.operator));
        let solid = match phase.unwrap_or_default() {
            (Weighting::NobleTorczynski, SolidOperator::NonEquilibriumBounceBack) => {
                SolidKnob::Usual
            }
            (Weighting::NobleTorczynski, SolidOperator::Superposition) => SolidKnob::Superposition,
            (Weighting::SolidFraction, SolidOperator::NonEquilibriumBounceBack) => {
                SolidKnob::SolidFraction
            }
            (Weighting::SolidFraction, SolidOperator::Superposition) => {
                let why = "it has both B = epsilon and the superposition operator, which no run of the \
                           evidence has";
                return Ok(Err(why.to_owned()));
            }
        };
        Ok(Ok(Facts {
            limit,
            solid,
            cells,
            flat,
            si_dx: units.si_dx,
            si_viscosity: nu * units.si_viscosity(),
            tau: setup.collision.tau(),
            si_velocity: velocity,
            mapped: mapped(scene)
                .map(|(measured, _, speed, _)| (measured, speed * units.si_velocity())),
            si_time: scene.stop.steps as f64 * units.si_dt,
        }))
    }
}

/// Drag over Stokes' drag: that of a face-centred array as crowded, or of a shaft as narrow, whichever is
/// larger; and what it was taken from.
fn drag(scene: &Scene, spheres: &[(&Solid, f64, f64)]) -> Result<(f64, String), CaseError> {
    let domain = &scene.setup.domain;
    let volume: f64 = spheres.iter().map(|s| s.2 * 4.0 / 3.0 * PI * s.1.powi(3)).sum();
    let fraction = volume / domain.cell_count() as f64;
    let crowd = interpolated(
        &Table::parse("golden/sphere_arrays/literature.csv", ARRAYS)?
            .with(&[("lattice", "FCC")])?,
        ["solid_fraction_c", "K_computed"],
        fraction,
    )?;
    let largest = spheres.iter().map(|s| s.1).fold(0.0, f64::max);
    // A mirror plane halves the shaft; a wall on one side only counts as one on both.
    let half = |axis: usize| {
        let faces = domain.faces().axis(axis);
        let walls = faces.iter().filter(|face| matches!(face, Face::Wall { .. })).count();
        let mirrors = faces.iter().filter(|face| **face == Face::FreeSlip).count();
        let length = domain.cells()[axis] as f64;
        match (walls, mirrors) {
            (0, _) => f64::INFINITY,
            (1, 1) => length,
            _ => 0.5 * length,
        }
    };
    let narrowest = (0..3).map(half).fold(f64::INFINITY, f64::min);
    let shaft = interpolated(
        &Table::parse("golden/stokes_settling/literature.csv", SHAFTS)?
            .with(&[("section", "square")])?,
        ["a_over_halfwidth", "K1_translating_in_still_fluid"],
        largest / narrowest,
    )?;
    Ok(if shaft > crowd {
        let width = narrowest / largest;
        (shaft, format!("a square shaft {width:.1} diameters wide, like the walls"))
    } else {
        (crowd, format!("a regular array of solid fraction {fraction:.3}, like the grains"))
    })
}

/// A column of the literature at a value of another: linear in the logarithm between rows, from 1 at
/// nothing up, and the last row's beyond.
fn interpolated(table: &Table, [x, y]: [&str; 2], at: f64) -> Result<f64, CaseError> {
    let mut before = (0.0, 1.0_f64);
    for (x, y) in table.points(x, y)? {
        if at <= x {
            // Both grow with the third root of the solid fraction, or with the width.
            let share = (at - before.0) / (x - before.0);
            return Ok((before.1.ln() + share * (y.ln() - before.1.ln())).exp());
        }
        before = (x, y);
    }
    Ok(before.1)
}
