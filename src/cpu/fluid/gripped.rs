//! How solids hold a fluid before its next collision.

use psmrt_reference::directions::Q;
use psmrt_reference::solids::Grip;
use rayon::prelude::*;

use super::{Fluid, Scratch, given_back, taken};
use crate::cpu::fields::Adding;
use crate::cpu::grips::{Gripping, Held, Looking, added_up};
use crate::lanes::Real;

impl<T: Real> Fluid<T> {
    /// How each solid holds the fluid before the next collision; of those that are not `wanted`, nothing need be right.
    pub fn grips(&mut self, wanted: &[usize]) -> Vec<Grip> {
        let Fluid {
            setup, rules, arch, grid, entering, is_put, run: cells, coverage, scratch, ..
        } = self;
        let solids = setup.solid_phase.as_ref().map_or(&[][..], |phase| &phase.solids);
        let Some(coverage) = coverage else { return vec![Grip::default(); solids.len()] };
        let mut is_wanted = vec![false; solids.len()];
        wanted.iter().for_each(|&solid| is_wanted[solid] = true);
        let (rows, now, gain) = (*cells / setup.domain.cells()[0], entering.now(), rules.gain());
        let look = |(run, (mut values, is_put)): (usize, ([&mut [T]; Q], &mut bool))| {
            if !coverage.parts(run).iter().any(|part| is_wanted[part.solid]) {
                return Vec::new();
            }
            // As the next step would do, to the same end.
            now.put(run * rows, &mut values);
            *is_put = true;
            let Scratch { mut fields, mut seen } = taken(scratch, *cells);
            let (of, first) = ((&*coverage, solids), run * *cells);
            arch.dispatch(Adding { fields: &mut fields, of, run, first, with_motion: false });
            let run = &values;
            arch.dispatch(Looking { rules, run, fields: &fields, seen: &mut seen });
            let held = arch.dispatch(Gripping { fields: &fields, seen: &seen, gain });
            fields.clear();
            given_back(scratch, Scratch { fields, seen });
            held
        };
        let runs = grid.runs(*cells);
        let held: Vec<Vec<Held>> = if runs.len() < 2 {
            runs.into_iter().zip(is_put).enumerate().map(look).collect()
        } else {
            runs.into_par_iter().zip(is_put).enumerate().map(look).collect()
        };
        let grips = added_up(&held, solids.len());
        if is_wanted.iter().all(|&is_wanted| is_wanted) {
            self.held = Some(grips.clone());
        }
        grips
    }
}
