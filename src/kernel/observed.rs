//! What can be seen of the fluid: loads, populations, sums over the box.

use psmrt_reference::directions::Q;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::solids::Load;

use super::buffers::Growing;
use super::compose::Work;
use super::coverage::graded_drag;
use super::error::KernelError;
use super::fluid::Kernel;
use super::layout::Layout;
use super::numbers::count;
use super::pipeline::Pipeline;
use super::steps::groups_of;
use super::streaming::weight;

/// Numbers that are read of a cell: its populations and its weight `B`.
const SEEN: usize = Q + 1;

/// Cells whose populations are read at once.
const SLICE: usize = 1 << 18;

impl Kernel {
    /// Force and torque on each solid during the last step.
    pub fn loads(&self) -> Result<Vec<Load>, KernelError> {
        Ok(self.loads_with_displaced()?.0)
    }

    /// The same, and `Σ B_s` over the cells that each solid had in that step: the volume in which a body
    /// force did not act on the fluid.
    pub fn loads_with_displaced(&self) -> Result<(Vec<Load>, Vec<f64>), KernelError> {
        let Some(solids) = &self.solids else { return Ok(Default::default()) };
        let since = self.watch.begin();
        let bytes = self.gpu.read(solids.loads.buffer(), 32 * u64::from(solids.solid_count))?;
        self.watch.add(since, |times| &mut times.transfers);
        let rows: &[[f32; 4]] = bytemuck::cast_slice(&bytes);
        let vector = |row: &[f32; 4]| Vec3::new(row[0].into(), row[1].into(), row[2].into());
        let each = |load: &[[f32; 4]]| {
            let [force, torque] = [vector(&load[0]), vector(&load[1])];
            (Load { force, torque }, f64::from(load[0][3]))
        };
        Ok(rows.chunks_exact(2).map(each).unzip())
    }

    /// `Σ B_s` over the cells of each solid, where it is now.
    pub fn displaced(&self) -> Result<Vec<f64>, KernelError> {
        self.solids.as_ref().map_or(Ok(Vec::new()), |solids| solids.touches.displaced(&self.gpu))
    }

    /// Populations of the cells of the given numbers before their next collision, in their order.
    pub fn populations(&self, cells: &[usize]) -> Result<Vec<[f64; Q]>, KernelError> {
        Ok(self.states(cells)?.into_iter().map(|(f, _)| f).collect())
    }

    /// The same, and the total solid fraction of each cell, at most 1: the one that its next collision uses.
    pub fn states(&self, cells: &[usize]) -> Result<Vec<([f64; Q], f64)>, KernelError> {
        let observe = self.pipeline(Work::Observe)?;
        let mut found = Vec::with_capacity(cells.len());
        let most = usize::try_from(self.gpu.facts().max_binding_bytes).unwrap_or(usize::MAX);
        for slice in cells.chunks(SLICE.min(most / (4 * SEEN)).max(1)) {
            let numbers: Vec<u32> = slice.iter().map(|&cell| count(cell)).collect();
            let mut list = Growing::new(&self.gpu, "list of cells")?;
            list.fill(&self.gpu, &numbers)?;
            let bytes = (slice.len() * SEEN * 4) as u64;
            self.seen.borrow_mut().reserve(&self.gpu, bytes)?;
            let count = count(slice.len());
            self.look(&observe, &list, [count, 1, u32::from(self.is_collided), 0], count)?;
            let bytes = self.gpu.read(self.seen.borrow().buffer(), bytes)?;
            let values: &[f32] = bytemuck::cast_slice(&bytes);
            found.extend(values.chunks_exact(SEEN).map(|seen| {
                let f = std::array::from_fn(|a| f64::from(seen[a]) + weight(a));
                (f, self.fraction_of(seen[Q].into()))
            }));
        }
        Ok(found)
    }

    /// The solid fraction of a cell of weight `B`.
    fn fraction_of(&self, b: f64) -> f64 {
        match self.setup.solid_phase.as_ref().map(|phase| phase.weighting) {
            // B = ε (τ - 1/2) / [(1 - ε) + (τ - 1/2)], so that ε = B [1 + (τ - 1/2)] / [B + (τ - 1/2)]
            Some(Weighting::NobleTorczynski) => {
                let excess = self.setup.collision.tau() - 0.5;
                (b * (1.0 + excess) / (b + excess)).min(1.0)
            }
            // B = k ε / [(1 - ε) + k ε], so that ε = B / [B + k (1 - B)]
            Some(Weighting::Graded) => {
                let k = graded_drag(self.setup.collision.tau());
                if b == 0.0 { 0.0 } else { (b / (b + k * (1.0 - b))).min(1.0) }
            }
            Some(Weighting::SolidFraction) | None => b,
        }
    }

    /// Runs a pipeline that reads the state into `seen`.
    fn look(
        &self,
        pipeline: &Pipeline,
        list: &Growing,
        task: [u32; 4],
        count: u32,
    ) -> Result<(), KernelError> {
        self.gpu.queue.write_buffer(&self.tasks.observed, 0, bytemuck::bytes_of(&task));
        let task = Some(&self.tasks.observed);
        let group = self.bind(self.current, pipeline, task, Some(list.buffer()))?;
        pipeline.run(&self.gpu, &group, groups_of(count))
    }

    /// Sums and extremes over the box.
    pub fn summary(&self) -> Result<Summary, KernelError> {
        let summary = self.pipeline(Work::Summary)?;
        let strands = self.recipe().strands();
        let bytes = u64::from(strands) * 32;
        self.seen.borrow_mut().reserve(&self.gpu, bytes)?;
        let task = [self.layout.count, 0, u32::from(self.is_collided), 0];
        self.look(&summary, &self.list, task, strands)?;
        let bytes = self.gpu.read(self.seen.borrow().buffer(), bytes)?;
        Ok(Summary::of(bytemuck::cast_slice(&bytes), &self.layout))
    }
}

/// Sums and extremes over the box, lattice units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Mean density.
    pub density: f64,
    /// Mean of the momentum before and after the next collision.
    pub mass_flux: Vec3,
    /// Largest `|j|/ρ`.
    pub bare_speed: f64,
    /// Largest `|j + G/2|/ρ`.
    pub speed: f64,
    /// The first cell that is broken: not finite, without density, or faster than the guard allows.
    pub broken: Option<usize>,
}

impl Summary {
    fn of(parts: &[[u32; 8]], layout: &Layout) -> Self {
        let real = |bits: u32| f64::from(f32::from_bits(bits));
        let n = layout.cells.iter().map(|&n| f64::from(n)).product::<f64>();
        let sum = |column: usize| parts.iter().map(|part| real(part[column])).sum::<f64>();
        let most = |column: usize| parts.iter().map(|part| real(part[column])).fold(0.0, f64::max);
        let broken = parts.iter().map(|part| part[6]).min().filter(|&cell| cell != u32::MAX);
        Summary {
            density: 1.0 + sum(0) / n,
            mass_flux: Vec3::new(sum(1), sum(2), sum(3)) / n,
            bare_speed: most(4).sqrt(),
            speed: most(5).sqrt(),
            broken: broken.map(|cell| cell as usize),
        }
    }
}
