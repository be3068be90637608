//! Streaming and the faces of the domain.

use psmrt_reference::directions::{C, Q, number_of};
use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;

use super::super::gauged::{Gauged, dot, given};
use super::super::mistakes::Mistake;
use super::super::task::Streaming;
use super::constants::{conserved, direction, vector};
use super::{Cell, GaugedAnswers, Model};

impl Model {
    /// Populations of all cells after streaming.
    pub(super) fn stream(&self, domain: &Domain, post: &[Cell]) -> Vec<Cell> {
        let streamed = |cell| std::array::from_fn(|a| self.entering(domain, post, cell, a));
        (0..domain.cell_count()).map(|cell| streamed(domain.coordinates(cell))).collect()
    }

    /// The population that comes to cell `x` along direction `a`.
    fn entering(&self, domain: &Domain, post: &[Cell], x: [usize; 3], a: usize) -> Gauged {
        let sign = if self.has(Mistake::StreamingReversed) { 1 } else { -1 };
        let (mut place, mut turned) = ([0_i64; 3], C[a]);
        let (mut wall, mut pressure): (Option<Vec3>, Option<f64>) = (None, None);
        for axis in 0..3 {
            let n = domain.cells()[axis] as i64;
            let from = x[axis] as i64 + i64::from(sign * C[a][axis]);
            place[axis] = from.clamp(0, n - 1);
            if from == place[axis] {
                continue;
            }
            match self.face(domain, axis, usize::from(from >= n)) {
                Face::Periodic => place[axis] = from.rem_euclid(n),
                Face::FreeSlip => turned[axis] = -turned[axis],
                Face::FreeOutflow => {}
                Face::Wall { velocity } | Face::VelocityInlet { velocity } => {
                    wall = Some(wall.unwrap_or_default() + velocity);
                }
                Face::Pressure { density } => pressure = Some(density),
                Face::DevelopedPressure { .. } | Face::NonReflectingPressure { .. } => {
                    unreachable!("no problem of the kit has a developed or non-reflecting face")
                }
            }
        }
        if let Some(velocity) = wall {
            return self.bounced(domain, post, x, a, &velocity);
        }
        if let Some(density) = pressure {
            return self.at_pressure(&post[domain.index(x)], a, density);
        }
        let inside = place.map(|i| usize::try_from(i).unwrap_or(0));
        post[domain.index(inside)][number_of(turned)]
    }

    /// What a face is taken to be.
    fn face(&self, domain: &Domain, axis: usize, side: usize) -> Face {
        match domain.faces().axis(axis)[side] {
            _ if self.has(Mistake::FacesIgnored) => Face::Periodic,
            Face::FreeSlip if self.has(Mistake::FreeSlipIsNoSlip) => Face::wall(),
            face => face,
        }
    }

    /// Bounce-back at a wall.
    fn bounced(
        &self,
        domain: &Domain,
        post: &[Cell],
        x: [usize; 3],
        a: usize,
        velocity: &Vec3,
    ) -> Gauged {
        let here = &post[domain.index(x)];
        let rho =
            if self.has(Mistake::MovingWallDensityOne) { 1.0.into() } else { conserved(here).0 };
        let factor = match self.mistake {
            Some(Mistake::MovingWallWithoutTwo) => 3.0,
            Some(Mistake::MovingWallSign) => -6.0,
            _ => 6.0,
        };
        let term = dot(direction(a), vector(velocity)) * rho * (factor * self.weights[a]);
        let mut from = here;
        if self.has(Mistake::WallOnNode) {
            // The node's own population that has just streamed to it, turned round.
            let moved = std::array::from_fn(|axis| x[axis] as i64 + i64::from(C[a][axis]));
            from = domain.locate(moved).map_or(here, |inside| &post[domain.index(inside)]);
        }
        from[self.opposite[a]] + term
    }

    /// Anti-bounce-back at a face of given density.
    fn at_pressure(&self, here: &Cell, a: usize, density: f64) -> Gauged {
        let (rho, j) = conserved(here);
        let u = j.map(|j| j / rho);
        let cu = dot(direction(a), u);
        let second = cu * cu * 4.5 - dot(u, u) * 1.5;
        let one = Gauged::from(1.0);
        let bracket = if self.has(Mistake::PressureWithoutVelocity) { one } else { one + second };
        let back = here[self.opposite[a]];
        let back = if self.has(Mistake::PressureSign) { back } else { -back };
        back + bracket * (2.0 * self.weights[a] * density)
    }

    pub(super) fn streaming(&self, problem: &Streaming) -> GaugedAnswers {
        let post: Vec<Cell> = problem.post.iter().map(|f| given(*f)).collect();
        let f = self.stream(&problem.domain, &post);
        let [nx, ny, nz] = problem.domain.cells();
        GaugedAnswers::default().with("populations", &[nz, ny, nx, Q], f.as_flattened())
    }
}
