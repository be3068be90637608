//! Bodies of any shape that move as prescribed: before each step every fluid engine is told which cells they fill.

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::solids::{Shape, Solid};

use super::EngineStop;
use super::coupled::Coupled;
use crate::bodies::filled::{Common, Filled};
use crate::bodies::moving::{Bodies, BodyStop, MovingBody};

impl Coupled {
    /// Lets these bodies move from now on.
    pub(super) fn move_bodies(&mut self, moving: &[MovingBody]) {
        if moving.is_empty() {
            return;
        }
        let domain = &self.setup().domain;
        let mut filled = Filled::none(domain.cell_count());
        for (number, solid) in self.solids().iter().enumerate() {
            if moving.iter().any(|body| body.solid == number) {
                continue;
            }
            let covered = solid.covered(domain, CoverageRule::Exact);
            let cells: Vec<_> = covered.iter().map(|at| (at.cell, at.epsilon)).collect();
            // It stays.
            let _ = filled.add(number, &cells);
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
        let place = Some(self.steps);
        let Some(Bodies { moving, filled }) = &mut self.bodies else { return Ok(()) };
        let mut added = Vec::new();
        let mut put = |body: &MovingBody| {
            let solid = &mut solids[body.solid];
            let shares = body.shares(&solid.centre, cells)?;
            if let Some(Common { other, share }) = filled.common(&shares) {
                return Err(BodyStop::Into { section: body.section, other, common: share });
            }
            // The next one must keep out of it too.
            added.push(filled.add(body.solid, &shares));
            solid.shape = Shape::Cells { fractions: shares.into(), place };
            Ok(())
        };
        let all_put = moving.iter().try_for_each(&mut put);
        for last in added.into_iter().rev() {
            filled.remove(last);
        }
        Ok(all_put?)
    }
}
