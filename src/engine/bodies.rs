//! Bodies of any shape that move as prescribed: before each step every fluid engine is told which cells they fill.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::solids::{Shape, Solid};

use super::EngineStop;
use super::coupled::Coupled;
use crate::bodies::moving::{Bodies, MovingBody};

impl Coupled {
    /// Lets these bodies move from now on.
    pub(super) fn move_bodies(&mut self, moving: &[MovingBody]) {
        if moving.is_empty() {
            return;
        }
        let domain = &self.setup().domain;
        let mut filled = vec![0.0; domain.cell_count()];
        for (number, solid) in self.solids().iter().enumerate() {
            if moving.iter().any(|body| body.solid == number) {
                continue;
            }
            for covered in solid.covered(domain, CoverageRule::Exact) {
                #[expect(clippy::cast_possible_truncation, reason = "a share")]
                let share = covered.epsilon as f32;
                filled[covered.cell] += share;
            }
        }
        self.bodies = Some(Bodies { moving: moving.to_vec(), filled });
    }

    /// Turns the bodies on by the step that has just been counted, and finds the cells that they fill now.
    pub(super) fn turn_bodies(&mut self, solids: &mut [Solid]) -> Result<(), EngineStop> {
        let Some(Bodies { moving, .. }) = &mut self.bodies else { return Ok(()) };
        let last = self.steps - 1;
        for body in moving {
            let prescribed = self.drives.iter().flat_map(|drives| &drives.prescribed);
            let changing = prescribed.into_iter().find(|all| all.solids.contains(&body.solid));
            let own = solids[body.solid].angular_velocity;
            body.turn_on(&changing.map_or(own, |all| all.through(last).angular_velocity));
        }
        self.shape_bodies(solids)
    }

    /// Finds the cells that the bodies fill where `solids` are. Errors if one leaves the domain or runs into another solid.
    pub(super) fn shape_bodies(&mut self, solids: &mut [Solid]) -> Result<(), EngineStop> {
        let cells = self.setup().domain.cells();
        let Some(Bodies { moving, filled }) = &mut self.bodies else { return Ok(()) };
        let mut put = Vec::new();
        let mut found = Ok(());
        for body in moving {
            let solid = &mut solids[body.solid];
            let shares = match body.shares(&solid.centre, cells) {
                Ok(shares) => shares,
                Err(stop) => {
                    found = Err(stop);
                    break;
                }
            };
            found = body.keeps_out_of(filled, &shares);
            if found.is_err() {
                break;
            }
            // The next one must keep out of it too.
            for &(cell, share) in &shares {
                put.push((cell, filled[cell]));
                #[expect(clippy::cast_possible_truncation, reason = "a share")]
                let share = share as f32;
                filled[cell] += share;
            }
            solid.shape = Shape::Cells { fractions: shares.into(), place: Some(self.steps) };
        }
        for (cell, before) in put.into_iter().rev() {
            filled[cell] = before;
        }
        Ok(found?)
    }
}
