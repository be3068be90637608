//! The fluid of a domain: the order of a step.

mod gripped;
mod observed;
mod saved;

use std::sync::{Mutex, PoisonError};

use psmrt_reference::directions::{C, Q};
use psmrt_reference::drive::{Drive, DriveError};
use psmrt_reference::lattice::{Populations, Vec3};
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::{Grip, Load, Solid};
use pulp::Arch;
use rayon::prelude::*;

use crate::cpu::collision::{Rules, weight};
use crate::cpu::coverage::Coverage;
use crate::cpu::faces::Entering;
use crate::cpu::fields::{Adding, Fields, Seen};
use crate::cpu::grid::Grid;
use crate::cpu::grips::received_by;
use crate::cpu::pass::Pass;
use crate::cpu::received::{Received, Receiving};
use crate::lanes::Real;

/// Cells that a thread takes at a time, in whole rows: with what solids cover of them they stay in its own cache.
const RUN_CELLS: usize = 8192;

/// The fluid of a domain on the CPU.
#[derive(Debug)]
pub struct Fluid<T: Real> {
    setup: Setup,
    rules: Rules,
    arch: Arch,
    grid: Grid<T>,
    entering: Entering<T>,
    /// Whether what enters each run next is in its place already.
    is_put: Vec<bool>,
    /// Cells in a run.
    run: usize,
    coverage: Option<Coverage<T>>,
    /// What solids that stay where they are cover of each run.
    kept: Vec<Option<Fields<T>>>,
    scratch: Mutex<Vec<Scratch<T>>>,
    loads: Vec<Load>,
    /// How all solids hold the fluid before the next collision, if that has been asked and none is elsewhere since.
    held: Option<Vec<Grip>>,
    /// `Σ B_s` of the last step, if the loads were worked out in it and no solid has moved since.
    displaced: Option<Vec<f64>>,
}

/// Fields of one run, for use again and again.
#[derive(Debug)]
struct Scratch<T> {
    fields: Fields<T>,
    seen: Seen<T>,
}

impl<T: Real> Fluid<T> {
    /// A fluid whose density and velocity at each cell centre are `state(centre)`, in a set-up that has passed its
    /// checks; `is_free`: its solids are free to move, so that the cells that they cover start with them even if all
    /// are at rest.
    pub fn starting_from(setup: Setup, state: &dyn Fn(Vec3) -> (f64, Vec3), is_free: bool) -> Self {
        let mut fluid = Self::empty(setup);
        let has_velocity = fluid.solids().iter().any(Solid::has_velocity);
        let is_tight =
            fluid.setup.solid_phase.as_ref().is_some_and(|phase| phase.operator.is_tight());
        fluid.fill(state, is_free || has_velocity || is_tight);
        fluid.entering = Entering::new(&fluid.setup.domain, &fluid.grid);
        fluid
    }

    /// A fluid with the given populations, one set per cell, in a set-up that has passed its checks.
    ///
    /// # Panics
    /// If there are not as many sets as cells: a mistake in the calling code.
    pub fn from_populations(setup: Setup, f: &[Populations]) -> Self {
        assert_eq!(f.len(), setup.domain.cell_count(), "one set of populations per cell");
        let mut fluid = Self::empty(setup);
        for a in 0..Q {
            for (value, f) in fluid.grid.before_mut(a).iter_mut().zip(f) {
                *value = T::from_f64(f[a] - weight(a));
            }
        }
        fluid.entering = Entering::new(&fluid.setup.domain, &fluid.grid);
        fluid
    }

    /// Computes cell by cell from now on, whatever the processor can do: for a test that the results are the same.
    pub fn do_without_vectors(&mut self) {
        self.arch = Arch::Scalar;
    }

    fn empty(setup: Setup) -> Self {
        let (domain, phase) = (&setup.domain, setup.solid_phase.as_ref());
        let rules = rules_of(&setup);
        let grid = Grid::new(domain.cells());
        let nx = domain.cells()[0];
        let run = nx * (RUN_CELLS / nx).max(1);
        let coverage = phase.filter(|phase| !phase.solids.is_empty());
        let coverage =
            coverage.map(|phase| Coverage::new(domain, &phase.solids, phase.coverage, run));
        Fluid {
            rules,
            arch: Arch::new(),
            entering: Entering::new(domain, &grid),
            grid,
            run,
            kept: vec![None; domain.cell_count().div_ceil(run)],
            is_put: vec![false; domain.cell_count().div_ceil(run)],
            coverage,
            scratch: Mutex::default(),
            loads: vec![Load::default(); phase.map_or(0, |phase| phase.solids.len())],
            held: None,
            displaced: None,
            setup,
        }
    }

    /// Puts each cell into equilibrium with `state` and, if `with_solids`, where solids cover it with their
    /// velocity: by volume, the mean velocity of what fills it.
    fn fill(&mut self, state: &dyn Fn(Vec3) -> (f64, Vec3), with_solids: bool) {
        let domain = self.setup.domain.clone();
        let g = self.setup.body_force.unwrap_or_else(Vec3::zeros);
        let solids = self.solids().to_vec();
        let cells = domain.cell_count();
        for run in 0..cells.div_ceil(self.run) {
            let first = run * self.run;
            let mut fields = Fields::new(self.run);
            if let Some(coverage) = self.coverage.as_ref().filter(|_| with_solids) {
                fields.add((coverage, &solids), run, first, true);
            }
            let motion = fields.motion();
            for cell in first..cells.min(first + self.run) {
                let (rho, u) = state(domain.centre(domain.coordinates(cell)));
                // With a body force the momentum before a collision is half a step behind.
                let mut u = u - g * (0.5 / rho);
                let sum = fields.epsilon[cell - first].to_f64();
                if sum > 0.0 {
                    let moved = motion.map_or_else(Vec3::zeros, |motion| {
                        Vec3::from(motion.map(|m| m[cell - first].to_f64())) / sum
                    });
                    let total = sum.min(1.0);
                    // (1 - ε_t) u + ε_t Σ_s (ε_s/Σ ε_s) u_s
                    u = (1.0 - total) * u + total * moved;
                }
                for a in 0..Q {
                    let c = Vec3::from(C[a].map(f64::from));
                    let cu = c.dot(&u);
                    let change = rho * (3.0 * cu + 4.5 * cu * cu - 1.5 * u.dot(&u));
                    let value = weight(a) * ((rho - 1.0) + change);
                    self.grid.before_mut(a)[cell] = T::from_f64(value);
                }
            }
        }
    }

    /// The set-up, with the solids where they are now and the drive of now.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    fn solids(&self) -> &[Solid] {
        self.setup.solid_phase.as_ref().map_or(&[], |phase| &phase.solids)
    }

    /// One step.
    fn step(&mut self, with_loads: bool) {
        let held = self.held.take();
        let is_seen = with_loads && held.is_none();
        let Fluid { setup, rules, arch, grid, entering, is_put, run: cells, kept, scratch, .. } =
            self;
        let (domain, coverage) = (&setup.domain, self.coverage.as_ref());
        let solids = setup.solid_phase.as_ref().map_or(&[][..], |phase| &phase.solids);
        let rows = *cells / domain.cells()[0];
        let (now, next) = entering.split(rows);
        let collide = |run: usize, values: &mut [&mut [T]; Q], kept: &mut Option<Fields<T>>| {
            let covered = coverage.filter(|coverage| !coverage.parts(run).is_empty());
            let Some(coverage) = covered else {
                *kept = None;
                arch.dispatch(Pass { rules, run: values, solids: None });
                return Vec::new();
            };
            let first = run * *cells;
            let mut spare = taken(scratch, *cells);
            let moves = coverage.has_changed[run];
            if moves {
                *kept = None;
                arch.dispatch(Adding {
                    fields: &mut spare.fields,
                    of: (coverage, solids),
                    run,
                    first,
                    with_motion: true,
                });
            } else if kept.is_none() {
                let mut fields = Fields::new(*cells);
                fields.add((coverage, solids), run, first, true);
                fields.find_filled(values[0].len());
                *kept = Some(fields);
            }
            let fields = kept.as_ref().unwrap_or(&spare.fields);
            let seen = is_seen.then_some(&mut spare.seen);
            arch.dispatch(Pass { rules, run: values, solids: Some((fields, seen)) });
            fields.correct_meetings(rules, values);
            let received = if is_seen {
                let (seen, gain) = (&spare.seen, rules.gain());
                arch.dispatch(Receiving { fields, solids, seen, gain })
            } else {
                Vec::new()
            };
            if moves {
                spare.fields.clear();
            }
            given_back(scratch, spare);
            received
        };
        type OfRun<'a, T> = (([&'a mut [T]; Q], Vec<&'a mut [T]>), &'a mut Option<Fields<T>>);
        let pass = |(run, ((mut values, mut next), kept)): (usize, OfRun<'_, T>)| {
            if !is_put[run] {
                now.put(run * rows, &mut values);
            }
            let received = collide(run, &mut values, kept);
            now.take(domain, run * rows, &values, &mut next);
            received
        };
        let runs = grid.runs(*cells);
        let received: Vec<Vec<Received>> = if runs.len() < 2 {
            runs.into_iter().zip(next).zip(kept.iter_mut()).enumerate().map(pass).collect()
        } else {
            runs.into_par_iter().zip(next).zip(kept.par_iter_mut()).enumerate().map(pass).collect()
        };
        is_put.fill(false);
        grid.passed();
        entering.fill(domain, grid);
        if let Some(coverage) = &mut self.coverage {
            coverage.has_changed.fill(false);
        }
        if with_loads {
            let (loads, displaced) = match held {
                Some(grips) => grips.iter().zip(solids).map(received_by).unzip(),
                None => added_up(&received, solids.len()),
            };
            self.loads = loads;
            self.displaced = Some(displaced);
        }
    }

    /// The populations of one cell before its next collision.
    pub fn populations(&self, cell: usize) -> [f64; Q] {
        let value = |a: usize| {
            let entering = self.entering.now().value(a, self.setup.domain.coordinates(cell));
            entering.unwrap_or_else(|| self.grid.before(a)[cell]).to_f64()
        };
        std::array::from_fn(|a| value(a) + weight(a))
    }

    /// The body force; zero where there is none.
    pub fn body_force(&self) -> Vec3 {
        self.setup.body_force.unwrap_or_else(Vec3::zeros)
    }

    /// Lets `drive` drive the fluid from now on. Errors, and changes nothing, as [`Setup::set_drive`].
    pub fn set_drive(&mut self, drive: &Drive) -> Result<(), DriveError> {
        self.setup.set_drive(drive)?;
        self.rules = rules_of(&self.setup);
        Ok(())
    }

    /// Puts the solids elsewhere. They are as many as before, and of the same shapes.
    pub fn place_solids(&mut self, solids: Vec<Solid>) {
        if let (Some(phase), Some(coverage)) = (&mut self.setup.solid_phase, &mut self.coverage) {
            coverage.update(&self.setup.domain, &phase.solids, &solids, phase.coverage);
            if phase.solids.iter().zip(&solids).any(|(then, now)| now.covers_other_cells(then)) {
                self.held = None;
            }
            phase.solids = solids;
            self.displaced = None;
        }
    }

    /// Makes `steps` steps, the solids staying where they are; loads are worked out at the last, if `with_loads`.
    pub fn advance(&mut self, steps: u64, with_loads: bool) {
        (0..steps).for_each(|step| self.step(with_loads && step + 1 == steps));
    }

    /// Force and torque on each solid during the last step in which they were worked out.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// `Σ B_s` over the cells of each solid, in cells: those of the last step until a solid is placed elsewhere.
    pub fn displaced(&self) -> Vec<f64> {
        self.displaced.clone().unwrap_or_else(|| self.next_received().1)
    }
}

fn rules_of(setup: &Setup) -> Rules {
    let phase = setup.solid_phase.as_ref();
    let (operator, weighting) =
        phase.map(|phase| (phase.operator, phase.weighting)).unwrap_or_default();
    Rules::new(&setup.collision, setup.body_force, operator, weighting)
}

/// Fields of a run, from the stock or new.
fn taken<T: Real>(stock: &Mutex<Vec<Scratch<T>>>, cells: usize) -> Scratch<T> {
    let from_stock = stock.lock().unwrap_or_else(PoisonError::into_inner).pop();
    from_stock.unwrap_or_else(|| Scratch { fields: Fields::new(cells), seen: Seen::new(cells) })
}

fn given_back<T: Real>(stock: &Mutex<Vec<Scratch<T>>>, scratch: Scratch<T>) {
    stock.lock().unwrap_or_else(PoisonError::into_inner).push(scratch);
}

/// Loads and `Σ B_s` of each solid, added up in the order of the runs.
fn added_up(received: &[Vec<Received>], solids: usize) -> (Vec<Load>, Vec<f64>) {
    let (mut loads, mut all) = (vec![Load::default(); solids], vec![0.0; solids]);
    for Received { solid, load, displaced } in received.iter().flatten() {
        loads[*solid].force += load.force;
        loads[*solid].torque += load.torque;
        all[*solid] += displaced;
    }
    (loads, all)
}
