//! Which cells the solids cover, in double precision: what the device is told where none of them can move
//! (where they can, it finds out by itself, `movable.rs`), and whose motion covered cells start with. What is seen
//! from outside is the weight that the device collides with (`observed.rs`).

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::{Shape, Solid};
use rayon::prelude::*;

use super::numbers::{count, single};
use crate::ball::{cells_about, solid_fractions};

/// One cell that a solid touches.
#[derive(Clone, Copy, Debug)]
struct Touch {
    cell: u32,
    epsilon: f64,
    /// From the solid's centre, or its image, to the centre of the cell.
    arm: Vec3,
}

/// What the solids cover. The part of a cell that one solid covers is a touch; touches are numbered from
/// 1, solid by solid. The record of a cell has the number of its first touch.
#[derive(Clone, Debug)]
pub(super) struct Coverage {
    /// The touches of each solid.
    covers: Vec<Vec<Touch>>,
    /// Number of the last touch before each solid, and that of the last of all.
    starts: Vec<u32>,
    /// Per cell the number of its record; 0 for none.
    slots: Vec<u32>,
    /// The cells that are covered, each once.
    cells: Vec<u32>,
    /// Cells in which several solids meet, with each of their touches, in order.
    meetings: Vec<(u32, u32)>,
}

/// The tables that the device works with where no solid moves.
#[derive(Clone, Debug, Default)]
pub(super) struct Tables {
    /// For each touch, after one of none, its cell, counted from 1, and the bits of the arm.
    pub(super) shares: Vec<[u32; 4]>,
    /// The same: the number of its cell's record.
    pub(super) links: Vec<u32>,
    /// The same: `B_s`.
    pub(super) weights: Vec<f32>,
    /// Number of touches of each solid.
    pub(super) counts: Vec<u32>,
}

impl Coverage {
    /// What the solids of `phase` cover where they are.
    pub(super) fn of(domain: &Domain, phase: &SolidPhase) -> Self {
        let touches_of = |solid: &Solid| {
            let mut touches = Vec::new();
            list(domain, solid, phase.coverage, &mut touches);
            touches
        };
        let mut coverage = Coverage {
            covers: phase.solids.par_iter().map(touches_of).collect(),
            starts: Vec::new(),
            slots: vec![0; domain.cell_count()],
            cells: Vec::new(),
            meetings: Vec::new(),
        };
        let mut number = 0;
        for touches in &coverage.covers {
            coverage.starts.push(number);
            for touch in touches {
                number += 1;
                let slot = &mut coverage.slots[touch.cell as usize];
                if *slot == 0 {
                    *slot = number;
                    coverage.cells.push(touch.cell);
                } else {
                    coverage.meetings.extend([(touch.cell, *slot), (touch.cell, number)]);
                }
            }
        }
        coverage.starts.push(number);
        coverage.meetings.sort_unstable();
        coverage.meetings.dedup();
        coverage
    }

    /// The solid of a touch, and the touch.
    fn touch(&self, number: u32) -> (usize, &Touch) {
        let solid = self.starts.partition_point(|&start| start < number) - 1;
        (solid, &self.covers[solid][(number - 1 - self.starts[solid]) as usize])
    }

    /// The covered cells with the sum of their solid fractions and `Σ ε_s u_s`, the velocity of each solid
    /// there taken as often as it fills the cell.
    pub(super) fn motions(&self, phase: &SolidPhase) -> Vec<(u32, f64, Vec3)> {
        let mut parts = Vec::new();
        for (cover, solid) in self.covers.iter().zip(&phase.solids) {
            for Touch { cell, epsilon, arm } in cover {
                // u_s = U + ω × r
                let velocity = solid.velocity + solid.angular_velocity.cross(arm);
                parts.push((*cell, *epsilon, *epsilon * velocity));
            }
        }
        parts.sort_by_key(|&(cell, ..)| cell);
        let whole = |parts: &[(u32, f64, Vec3)]| {
            let sums = parts.iter().fold((0.0, Vec3::zeros()), |(epsilon, motion), part| {
                (epsilon + part.1, motion + part.2)
            });
            (parts[0].0, sums.0, sums.1)
        };
        parts.chunk_by(|a, b| a.0 == b.0).map(whole).collect()
    }

    /// The cells that solids cover.
    pub(super) fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// Per cell the number of its record, 0 for none.
    pub(super) fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// The weight `B` of each cell.
    pub(super) fn weights(&self, weighting: Weighting, tau: f64) -> Vec<f32> {
        let mut weights = vec![0.0; self.slots.len()];
        for touch in self.covers.iter().flatten() {
            weights[touch.cell as usize] = single(weight(weighting, touch.epsilon, tau));
        }
        for all in self.meetings.chunk_by(|a, b| a.0 == b.0) {
            let epsilon = all.iter().map(|&(_, number)| self.touch(number).1.epsilon).sum();
            weights[all[0].0 as usize] = single(weight(weighting, epsilon, tau));
        }
        weights
    }

    /// The tables for the device.
    pub(super) fn tables(&self, phase: &SolidPhase, tau: f64) -> Tables {
        let none = Tables {
            shares: vec![[0; 4]],
            links: vec![0],
            weights: vec![0.0],
            counts: self.covers.iter().map(|cover| count(cover.len())).collect(),
        };
        let mut tables = none;
        for touch in self.covers.iter().flatten() {
            let [x, y, z] = [touch.arm.x, touch.arm.y, touch.arm.z].map(|x| single(x).to_bits());
            tables.shares.push([touch.cell + 1, x, y, z]);
            tables.links.push(self.slots[touch.cell as usize]);
            tables.weights.push(single(weight(phase.weighting, touch.epsilon, tau)));
        }
        // Solids that meet in a cell share its weight by their fractions.
        for all in self.meetings.chunk_by(|a, b| a.0 == b.0) {
            let epsilon = |number: u32| self.touch(number).1.epsilon;
            let sum = all.iter().map(|&(_, number)| epsilon(number)).sum::<f64>();
            let factor = weight(phase.weighting, sum, tau) / sum;
            for &(_, number) in all {
                tables.weights[number as usize] = single(factor * epsilon(number));
            }
        }
        tables
    }
}

/// `k` in `B/(1 - B) = k ε/(1 - ε)` of graded viscosity.
pub(super) fn graded_drag(tau: f64) -> f64 {
    0.25 * (tau - 0.5).powi(2) / (tau - 0.4)
}

/// The weight `B` of a cell in which the solid fractions add up to `sum`.
fn weight(weighting: Weighting, sum: f64, tau: f64) -> f64 {
    let epsilon = sum.min(1.0);
    match weighting {
        Weighting::SolidFraction => epsilon,
        // B = ε (τ - 1/2) / [(1 - ε) + (τ - 1/2)]
        Weighting::NobleTorczynski => {
            let excess = tau - 0.5;
            epsilon * excess / (1.0 - epsilon + excess)
        }
        // B = k ε / [(1 - ε) + k ε]
        Weighting::Graded => {
            let solid = graded_drag(tau) * epsilon;
            solid / (1.0 - epsilon + solid)
        }
    }
}

/// The cells that one solid covers, by their numbers.
fn list(domain: &Domain, solid: &Solid, rule: CoverageRule, touches: &mut Vec<Touch>) {
    match &solid.shape {
        Shape::Cells { fractions, .. } => {
            for &(cell, epsilon) in fractions.iter().filter(|(_, epsilon)| *epsilon > 0.0) {
                let arm = domain.centre(domain.coordinates(cell)) - solid.centre;
                touches.push(Touch { cell: count(cell), epsilon, arm });
            }
        }
        Shape::Sphere { radius } => list_sphere(domain, &solid.centre, *radius, rule, touches),
    }
}

fn list_sphere(
    domain: &Domain,
    centre: &Vec3,
    radius: f64,
    rule: CoverageRule,
    touches: &mut Vec<Touch>,
) {
    let add = |[x, y, z]: [i64; 3], epsilon: f64| {
        if let Some(inside) = domain.locate([x, y, z]) {
            // Of this image: the cell before it is wrapped round the box.
            let arm = Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5) - centre;
            touches.push(Touch { cell: count(domain.index(inside)), epsilon, arm });
        }
    };
    let [x_range, y_range, z_range] = cells_about((*centre).into(), radius);
    let cells = [domain.within(0, x_range), domain.within(1, y_range), domain.within(2, z_range)];
    solid_fractions(rule, (*centre).into(), radius, &cells, add);
}
