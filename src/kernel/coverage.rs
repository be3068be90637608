//! Which cells the solids cover, and what the device must know of it.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::{Shape, Solid};
use rayon::prelude::*;

use super::numbers::{count, single};
use super::sphere::{sampled_fraction, solid_fractions};

/// One cell that a solid touches.
#[derive(Clone, Copy, Debug)]
struct Touch {
    cell: u32,
    epsilon: f64,
    /// From the solid's centre, or its image, to the centre of the cell.
    arm: Vec3,
}

/// What one solid covers, and where it was when that was listed.
#[derive(Clone, Debug, Default)]
struct Cover {
    centre: Option<Vec3>,
    touches: Vec<Touch>,
}

/// What the solids cover. The part of a cell that one solid covers is a touch; touches are numbered from
/// 1, solid by solid. The record of a cell has the number of its first touch.
#[derive(Clone, Debug)]
pub(super) struct Coverage {
    covers: Vec<Cover>,
    /// Number of the last touch before each solid, and that of the last of all.
    starts: Vec<u32>,
    /// Per cell the number of its record; 0 for none.
    slots: Vec<u32>,
    /// The cells that are covered, each once.
    cells: Vec<u32>,
    /// Cells in which several solids meet, with each of their touches, in order.
    meetings: Vec<(u32, u32)>,
}

/// Sums over the solids of one cell.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// Σ ε_s
    epsilon: f64,
    /// Σ ε_s u_s
    velocity: Vec3,
    /// Σ ε_s u_s,i u_s,i
    square: Vec3,
    /// Σ ε_s u_s,i u_s,j (xy, yz, xz)
    mixed: Vec3,
}

/// The tables that the device works with.
#[derive(Clone, Debug, Default)]
pub(super) struct Tables {
    /// `(B, Σ B_s u_s)` of each record, after one of zeros.
    pub(super) records: Vec<[f32; 4]>,
    /// Two rows for each cell in which several solids meet: what `Σ B_s u_s u_s` is above that of the
    /// mean velocity.
    pub(super) excess: Vec<[f32; 4]>,
    /// For each touch the number of its cell's record and the bits of the arm.
    pub(super) shares: Vec<[u32; 4]>,
    /// For each touch `B_s`.
    pub(super) weights: Vec<f32>,
    /// Velocity and spin of each solid.
    pub(super) motions: Vec<[f32; 4]>,
}

impl Coverage {
    pub(super) fn new(cell_count: u32) -> Self {
        Coverage {
            covers: Vec::new(),
            starts: Vec::new(),
            slots: vec![0; cell_count as usize],
            cells: Vec::new(),
            meetings: Vec::new(),
        }
    }

    /// Lists again what the solids cover that have moved since, and which cells have several.
    pub(super) fn update(&mut self, domain: &Domain, phase: &SolidPhase) {
        self.covers.resize_with(phase.solids.len(), Cover::default);
        self.covers.par_iter_mut().zip(&phase.solids).for_each(|(cover, solid)| {
            if cover.centre != Some(solid.centre) {
                cover.centre = Some(solid.centre);
                cover.touches.clear();
                list(domain, solid, phase.coverage, &mut cover.touches);
            }
        });
        for &cell in &self.cells {
            self.slots[cell as usize] = 0;
        }
        self.cells.clear();
        self.starts.clear();
        self.meetings.clear();
        let mut number = 0;
        for cover in &self.covers {
            self.starts.push(number);
            for touch in &cover.touches {
                number += 1;
                let slot = &mut self.slots[touch.cell as usize];
                if *slot == 0 {
                    *slot = number;
                    self.cells.push(touch.cell);
                } else {
                    self.meetings.extend([(touch.cell, *slot), (touch.cell, number)]);
                }
            }
        }
        self.starts.push(number);
        self.meetings.sort_unstable();
        self.meetings.dedup();
    }

    /// The solid of a touch, and the touch.
    fn touch(&self, number: u32) -> (usize, &Touch) {
        let solid = self.starts.partition_point(|&start| start < number) - 1;
        (solid, &self.covers[solid].touches[(number - 1 - self.starts[solid]) as usize])
    }

    /// The touches of a cell in which several solids meet; empty for other cells.
    fn met(&self, cell: u32) -> &[(u32, u32)] {
        let start = self.meetings.partition_point(|&(other, _)| other < cell);
        let end = self.meetings.partition_point(|&(other, _)| other <= cell);
        &self.meetings[start..end]
    }

    /// Total solid fraction of a cell, at most 1.
    pub(super) fn solid_fraction(&self, cell: u32) -> f64 {
        let epsilon = |number: u32| self.touch(number).1.epsilon;
        match (self.slots[cell as usize], self.met(cell)) {
            (0, _) => 0.0,
            (slot, []) => epsilon(slot),
            (_, all) => all.iter().map(|&(_, number)| epsilon(number)).sum::<f64>().min(1.0),
        }
    }

    /// The cells that solids cover.
    pub(super) fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// The cells in which several solids meet.
    pub(super) fn meeting_cells(&self) -> impl Iterator<Item = u32> {
        self.meetings.chunk_by(|a, b| a.0 == b.0).map(|all| all[0].0)
    }

    /// Whether several solids meet in a cell.
    pub(super) fn is_meeting(&self, cell: u32) -> bool {
        self.slots[cell as usize] > 0 && !self.met(cell).is_empty()
    }

    /// Per cell the number of its record, 0 for none.
    pub(super) fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// Number of the last touch before each solid, and that of the last of all.
    pub(super) fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// The weight `B` of each cell.
    pub(super) fn weights(&self, weighting: Weighting, tau: f64) -> Vec<f32> {
        let mut weights = vec![0.0; self.slots.len()];
        for touch in self.covers.iter().flat_map(|cover| &cover.touches) {
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
        let weigh = |touch: &Touch| weight(phase.weighting, touch.epsilon, tau);
        let row = |w: f64, v: Vec3| [single(w), single(v.x), single(v.y), single(v.z)];
        let mut tables = Tables { records: vec![[0.0; 4]], ..Tables::default() };
        let solids = || self.covers.par_iter().zip(&phase.solids);
        tables.records.par_extend(solids().flat_map_iter(|(cover, solid)| {
            cover.touches.iter().map(move |touch| {
                let b = weigh(touch);
                row(b, b * solid.velocity_at(&touch.arm))
            })
        }));
        (tables.shares, tables.weights) = solids()
            .flat_map_iter(|(cover, _)| {
                cover.touches.iter().map(|touch| {
                    let [_, x, y, z] = row(0.0, touch.arm).map(f32::to_bits);
                    ([self.slots[touch.cell as usize], x, y, z], single(weigh(touch)))
                })
            })
            .unzip();
        for all in self.meetings.chunk_by(|a, b| a.0 == b.0) {
            self.share_out(all, phase, tau, &mut tables);
        }
        for motion in &phase.solids {
            for v in [motion.velocity, motion.spin] {
                tables.motions.push([single(v.x), single(v.y), single(v.z), 0.0]);
            }
        }
        tables
    }

    /// The tables of a cell in which several solids meet.
    fn share_out(&self, all: &[(u32, u32)], phase: &SolidPhase, tau: f64, tables: &mut Tables) {
        let mut sums = Sums::default();
        for &(_, number) in all {
            let (solid, touch) = self.touch(number);
            let (u, epsilon) = (phase.solids[solid].velocity_at(&touch.arm), touch.epsilon);
            sums.epsilon += epsilon;
            sums.velocity += epsilon * u;
            sums.square += epsilon * u.component_mul(&u);
            sums.mixed += epsilon * Vec3::new(u.x * u.y, u.y * u.z, u.x * u.z);
        }
        let factor = weight(phase.weighting, sums.epsilon, tau) / sums.epsilon;
        let narrow = |w: f64, v: Vec3| [single(v.x), single(v.y), single(v.z), single(w)];
        let [x, y, z, b] = narrow(factor * sums.epsilon, factor * sums.velocity);
        tables.records[self.slots[all[0].0 as usize] as usize] = [b, x, y, z];
        let (u, mean) = (sums.velocity, sums.velocity / sums.epsilon);
        let square = factor * (sums.square - u.component_mul(&mean));
        let mixed = Vec3::new(u.x * mean.y, u.y * mean.z, u.x * mean.z);
        tables.excess.extend([narrow(0.0, square), narrow(0.0, factor * (sums.mixed - mixed))]);
        for &(_, number) in all {
            let share = factor * self.touch(number).1.epsilon;
            tables.weights[number as usize - 1] = single(share);
        }
    }
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
    }
}

/// The cells that one solid covers, by their numbers.
fn list(domain: &Domain, solid: &Solid, rule: CoverageRule, touches: &mut Vec<Touch>) {
    match &solid.shape {
        Shape::Cells { fractions } => {
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
    let mut add = |[x, y, z]: [i64; 3], epsilon: f64| {
        if let Some(inside) = domain.locate([x, y, z]) {
            // Of this image: the cell before it is wrapped round the box.
            let arm = Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5) - centre;
            touches.push(Touch { cell: count(domain.index(inside)), epsilon, arm });
        }
    };
    let CoverageRule::Sampled { n } = rule else {
        return solid_fractions((*centre).into(), radius, add);
    };
    let range = |axis: usize| floor(centre[axis] - radius)..=floor(centre[axis] + radius);
    for z in range(2) {
        for y in range(1) {
            for x in range(0) {
                let middle = Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5);
                let epsilon = sampled_fraction((centre - middle).into(), radius, n);
                if epsilon > 0.0 {
                    add([x, y, z], epsilon);
                }
            }
        }
    }
}

/// The cell of a coordinate.
#[expect(clippy::cast_possible_truncation, reason = "coordinates of solids are far below 2^63")]
fn floor(coordinate: f64) -> i64 {
    coordinate.floor() as i64
}
