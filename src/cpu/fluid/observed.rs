//! What may be asked of a fluid: means, what a guard sees, what its solids would receive.

use psmrt_reference::directions::Q;
use psmrt_reference::guard::{Failure, Findings, Guard};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;
use rayon::prelude::*;

use super::{Fluid, added_up, given_back, taken};
use crate::cpu::fields::{Fields, Seen};
use crate::cpu::observe::{Judging, Sums, sum};
use crate::cpu::pass::Pass;
use crate::cpu::received::{Received, Receiving};
use crate::lanes::Real;

impl<T: Real> Fluid<T> {
    /// Calls `look(first cell, density less 1 and momentum of its cells)` for each run, where the cells are
    /// before their next collision, and gives what it returns in the order of the runs.
    fn look_at_runs<R: Send>(&self, look: impl Fn(usize, &Seen<T>) -> R + Sync) -> Vec<R> {
        let domain = &self.setup.domain;
        let cells = domain.cell_count();
        let rows = self.run / domain.cells()[0];
        let at_run = |run: usize| {
            let first = run * self.run;
            let mut copies = self.copies(run);
            let mut values = slices(&mut copies);
            self.entering.now().put(run * rows, &mut values);
            let mut spare = taken(&self.scratch, self.run);
            self.arch.dispatch(Sums { run: &values, seen: &mut spare.seen });
            let result = look(first, &spare.seen);
            given_back(&self.scratch, spare);
            result
        };
        (0..cells.div_ceil(self.run)).into_par_iter().map(at_run).collect()
    }

    /// The populations of a run, where `before` looks for them.
    pub(super) fn copies(&self, run: usize) -> Vec<Vec<T>> {
        let first = run * self.run;
        let cells = first..self.setup.domain.cell_count().min(first + self.run);
        (0..Q).map(|a| self.grid.before(a)[cells.clone()].to_vec()).collect()
    }

    /// What the solids would receive in the next step.
    pub(super) fn next_received(&self) -> (Vec<Load>, Vec<f64>) {
        let Some(coverage) = &self.coverage else { return (Vec::new(), Vec::new()) };
        let run = |run: usize| {
            if coverage.parts(run).is_empty() {
                return Vec::new();
            }
            let rows = self.run / self.setup.domain.cells()[0];
            let (mut copies, first) = (self.copies(run), run * self.run);
            let mut values = slices(&mut copies);
            self.entering.now().put(run * rows, &mut values);
            let mut spare = taken(&self.scratch, self.run);
            spare.fields.add((coverage, self.solids()), run, first, true);
            let solids = Some((&spare.fields, Some(&mut spare.seen)));
            self.arch.dispatch(Pass { rules: &self.rules, run: &mut values, solids });
            let received = self.arch.dispatch(Receiving {
                fields: &spare.fields,
                solids: self.solids(),
                seen: &spare.seen,
                gain: self.rules.gain(),
            });
            spare.fields.clear();
            given_back(&self.scratch, spare);
            received
        };
        let received: Vec<Vec<Received>> = (0..self.kept.len()).into_par_iter().map(run).collect();
        added_up(&received, self.loads.len())
    }

    /// Mean density, mean mass flux (the mean of the momentum before and after the next collision, solid cells included)
    /// and the largest speed in any cell.
    pub fn means(&self) -> (f64, Vec3, f64) {
        let g = self.body_force();
        let parts = self.look_at_runs(|first, seen| {
            let count = self.run.min(self.setup.domain.cell_count() - first);
            let [excess, jx, jy, jz, _] = seen.of.each_ref().map(|of| sum(&of[..count]));
            let speed = |cell: usize| {
                let [excess, jx, jy, jz, _] = seen.of.each_ref().map(|of| of[cell].to_f64());
                ((Vec3::new(jx, jy, jz) + 0.5 * g) / (1.0 + excess)).norm_squared()
            };
            (excess, Vec3::new(jx, jy, jz), (0..count).map(speed).fold(0.0, f64::max))
        });
        let n = self.setup.domain.cell_count() as f64;
        let excess: f64 = parts.iter().map(|part| part.0).sum();
        let momentum: Vec3 = parts.iter().map(|part| part.1).sum();
        let (loads, displaced) = self.next_received();
        let received: Vec3 = loads.iter().map(|load| load.force).sum();
        let displaced: f64 = displaced.iter().sum();
        // The next collision changes Σ j by Σ (1 - B) G - Σ_s F_s.
        let change = (n - displaced) * g - received;
        let density = 1.0 + excess / n;
        let speed = parts.iter().map(|part| part.2).fold(0.0, f64::max).sqrt();
        (density, (momentum + 0.5 * change) / n, speed)
    }

    /// What `guard` wants to know of all cells.
    pub fn findings(&mut self, guard: &Guard) -> Findings {
        // Cells that come near the limit are looked at again by the guard, in all digits.
        let limit = self.setup.guard.max_speed * 0.999;
        let n = self.setup.domain.cell_count() as f64;
        let Fluid { setup, arch, grid, entering, is_put, run: cells, scratch, .. } = &mut *self;
        let (rows, now) = (*cells / setup.domain.cells()[0], entering.now());
        let look = |(run, (mut values, is_put)): (usize, ([&mut [T]; Q], &mut bool))| {
            // As the next step would do, to the same end.
            if !std::mem::replace(is_put, true) {
                now.put(run * rows, &mut values);
            }
            let mut spare = taken(scratch, *cells);
            let (count, seen) = (values[0].len(), &mut spare.seen);
            arch.dispatch(Sums { run: &values, seen });
            let (fastest, is_fit) = arch.dispatch(Judging { seen, count, limit });
            let found = (sum(&seen.of[0][..count]), fastest, is_fit);
            given_back(scratch, spare);
            found
        };
        let runs = grid.runs(*cells).into_par_iter();
        let parts: Vec<(f64, f64, bool)> = runs.zip(is_put).enumerate().map(look).collect();
        let suspects = parts.iter().enumerate().filter(|(_, (.., is_fit))| !is_fit);
        Findings {
            mean_density: 1.0 + parts.iter().map(|part| part.0).sum::<f64>() / n,
            max_speed: parts.iter().map(|part| part.1).fold(0.0, f64::max).sqrt(),
            broken: suspects.filter_map(|(run, _)| self.broken_in(run, guard)).next(),
        }
    }

    /// The first cell of a run that the guard finds broken.
    fn broken_in(&self, run: usize, guard: &Guard) -> Option<(usize, Failure)> {
        let first = run * self.run;
        let end = self.setup.domain.cell_count().min(first + self.run);
        let broken = |cell: usize| Some((cell, guard.failure(&self.populations(cell))?));
        (first..end).find_map(broken)
    }

    /// Total solid fraction of cells.
    pub fn solid_fractions(&self, cells: &[usize]) -> Vec<f64> {
        let Some(coverage) = &self.coverage else { return vec![0.0; cells.len()] };
        let in_run = |cells: &[usize]| {
            let run = cells[0] / self.run;
            let first = run * self.run;
            let mut fields = Fields::new(self.run);
            fields.add((coverage, self.solids()), run, first, false);
            let fraction = |cell: &usize| fields.epsilon[cell - first].to_f64().min(1.0);
            cells.iter().map(fraction).collect::<Vec<_>>()
        };
        let runs = cells.par_chunk_by(|a, b| a / self.run == b / self.run);
        runs.flat_map_iter(in_run).collect()
    }
}

/// The arrays of all directions.
pub(super) fn slices<T>(arrays: &mut [Vec<T>]) -> [&mut [T]; Q] {
    let mut arrays = arrays.iter_mut();
    std::array::from_fn(|_| arrays.next().map(Vec::as_mut_slice).unwrap_or_default())
}
