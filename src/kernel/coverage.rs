//! Which cells the solids cover, and what the device must know of it.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::setup::SolidPhase;
use psmrt_reference::solids::{Shape, Solid};
use rayon::prelude::*;

use super::numbers::{count, single};
use super::sphere::{sampled_fraction, solid_fraction};

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

/// What the solids cover.
#[derive(Clone, Debug)]
pub(super) struct Coverage {
    covers: Vec<Cover>,
    /// Per cell the number of its record, counted from 1; 0 for none.
    slots: Vec<u32>,
    /// The cell of each record.
    cells: Vec<u32>,
    /// The sums of each record.
    sums: Vec<Sums>,
    /// Records in which several solids meet; they come first.
    many: usize,
}

/// Sums over the solids of one cell.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    shares: u32,
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
    /// Two rows for each record in which several solids meet: what `Σ B_s u_s u_s` is above that of the
    /// mean velocity.
    pub(super) excess: Vec<[f32; 4]>,
    /// For each share, solid by solid: cell, solid, and the bits of `B_s` and the arm.
    pub(super) shares: Vec<[u32; 6]>,
    /// First share of each solid, and the number of all.
    pub(super) starts: Vec<u32>,
    /// Velocity and spin of each solid.
    pub(super) motions: Vec<[f32; 4]>,
}

impl Coverage {
    pub(super) fn new(cell_count: u32) -> Self {
        Coverage {
            covers: Vec::new(),
            slots: vec![0; cell_count as usize],
            cells: Vec::new(),
            sums: Vec::new(),
            many: 0,
        }
    }

    /// Lists again what the solids cover that have moved since, and sums up each cell.
    pub(super) fn update(&mut self, domain: &Domain, phase: &SolidPhase) {
        self.covers.resize_with(phase.solids.len(), Cover::default);
        self.covers.par_iter_mut().zip(&phase.solids).for_each(|(cover, solid)| {
            if cover.centre != Some(solid.centre) {
                cover.centre = Some(solid.centre);
                cover.touches.clear();
                list(domain, solid, phase.coverage, &mut cover.touches);
            }
        });
        self.sum_up(&phase.solids);
    }

    fn sum_up(&mut self, solids: &[Solid]) {
        for &cell in &self.cells {
            self.slots[cell as usize] = 0;
        }
        self.cells.clear();
        self.sums.clear();
        for (cover, solid) in self.covers.iter().zip(solids) {
            for touch in &cover.touches {
                let slot = &mut self.slots[touch.cell as usize];
                if *slot == 0 {
                    self.cells.push(touch.cell);
                    self.sums.push(Sums::default());
                    *slot = count(self.cells.len());
                }
                let u = solid.velocity_at(&touch.arm);
                let (sums, epsilon) = (&mut self.sums[*slot as usize - 1], touch.epsilon);
                sums.shares += 1;
                sums.epsilon += epsilon;
                sums.velocity += epsilon * u;
                sums.square += epsilon * u.component_mul(&u);
                sums.mixed += epsilon * Vec3::new(u.x * u.y, u.y * u.z, u.x * u.z);
            }
        }
        self.put_shared_cells_first();
    }

    /// Renumbers the records so that those of several solids come first.
    fn put_shared_cells_first(&mut self) {
        self.many = 0;
        for record in 0..self.cells.len() {
            if self.sums[record].shares > 1 {
                self.cells.swap(record, self.many);
                self.sums.swap(record, self.many);
                self.slots[self.cells[record] as usize] = count(record + 1);
                self.slots[self.cells[self.many] as usize] = count(self.many + 1);
                self.many += 1;
            }
        }
    }

    /// Total solid fraction of a cell, at most 1.
    pub(super) fn solid_fraction(&self, cell: u32) -> f64 {
        match self.slots[cell as usize] {
            0 => 0.0,
            slot => self.sums[slot as usize - 1].epsilon.min(1.0),
        }
    }

    /// The cells of the cells that solids touch; those in which several meet come first.
    pub(super) fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// The number of cells in which several solids meet.
    pub(super) fn many(&self) -> usize {
        self.many
    }

    /// Per cell the number of its record, 0 for none.
    pub(super) fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// The weight `B` at each cell.
    pub(super) fn weights(&self, weighting: Weighting, tau: f64) -> Vec<f32> {
        let mut weights = vec![0.0; self.slots.len()];
        for (&cell, sums) in self.cells.iter().zip(&self.sums) {
            weights[cell as usize] = single(weight(weighting, sums.epsilon, tau));
        }
        weights
    }

    /// The tables for the device.
    pub(super) fn tables(&self, phase: &SolidPhase, tau: f64) -> Tables {
        let factor = |sums: &Sums| weight(phase.weighting, sums.epsilon, tau) / sums.epsilon;
        let row = |w: f64, v: Vec3| [single(w), single(v.x), single(v.y), single(v.z)];
        let mut tables = Tables { records: vec![[0.0; 4]], ..Tables::default() };
        tables.records.par_extend(self.sums.par_iter().map(|sums| {
            let factor = factor(sums);
            row(factor * sums.epsilon, factor * sums.velocity)
        }));
        for sums in &self.sums[..self.many] {
            let (factor, mean) = (factor(sums), sums.velocity / sums.epsilon);
            let u = sums.velocity;
            let square = factor * (sums.square - u.component_mul(&mean));
            let mixed = Vec3::new(u.x * mean.y, u.y * mean.z, u.x * mean.z);
            let mixed = factor * (sums.mixed - mixed);
            for v in [square, mixed] {
                tables.excess.push([single(v.x), single(v.y), single(v.z), 0.0]);
            }
        }
        tables.starts.push(0);
        for (solid, (cover, motion)) in self.covers.iter().zip(&phase.solids).enumerate() {
            for touch in &cover.touches {
                let sums = &self.sums[self.slots[touch.cell as usize] as usize - 1];
                let numbers = row(factor(sums) * touch.epsilon, touch.arm).map(f32::to_bits);
                let [w, x, y, z] = numbers;
                tables.shares.push([touch.cell, count(solid), w, x, y, z]);
            }
            tables.starts.push(count(tables.shares.len()));
            tables.motions.push(row(0.0, motion.velocity));
            tables.motions.push(row(0.0, motion.spin));
        }
        for motion in &mut tables.motions {
            motion.rotate_left(1);
        }
        tables
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
    let range = |axis: usize| floor(centre[axis] - radius)..=floor(centre[axis] + radius);
    for z in range(2) {
        for y in range(1) {
            for x in range(0) {
                let Some(inside) = domain.locate([x, y, z]) else { continue };
                // Of this image: the cell before it is wrapped round the box.
                let middle = Vec3::new(x as f64 + 0.5, y as f64 + 0.5, z as f64 + 0.5);
                let arm = middle - centre;
                let from_cell = (-arm).into();
                let epsilon = match rule {
                    CoverageRule::Exact => solid_fraction(from_cell, radius),
                    CoverageRule::Sampled { n } => sampled_fraction(from_cell, radius, n),
                };
                if epsilon > 0.0 {
                    touches.push(Touch { cell: count(domain.index(inside)), epsilon, arm });
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
