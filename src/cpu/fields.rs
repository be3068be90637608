//! What solids cover of one run of cells, as fields that a pass can read vector by vector; and, after the pass, what
//! the fluid has given to each of them.

use psmrt_reference::directions::{C, OPPOSITE, Q};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Load, Solid};

use super::collision::{Rules, weight};
use super::coverage::{Coverage, Part};
use crate::lanes::Real;

/// Cells that are told apart together: if one of them is covered, all are collided as if they were. A multiple of
/// the lanes of every vector, so that results do not depend on their number.
pub(super) const BLOCK: usize = 16;

/// Sums over the solids in each cell of a run.
#[derive(Clone, Debug)]
pub(super) struct Fields<T> {
    /// `Σ ε_s`
    pub(super) epsilon: Vec<T>,
    /// `Σ ε_s u_s`, component by component; empty until a solid has a velocity.
    motion: [Vec<T>; 3],
    has_motion: bool,
    /// For each block, whether solids cover some of it.
    pub(super) covered: Vec<bool>,
    meetings: Vec<Meeting>,
    /// For each cell the number of its meeting, after one of none; empty until solids meet.
    meeting_of: Vec<u32>,
}

/// A cell in which solids meet.
#[derive(Clone, Debug)]
struct Meeting {
    cell: usize,
    /// `Σ ε_s u_s u_sᵀ`: xx, yy, zz, xy, xz, yz.
    squares: [f64; 6],
}

/// What loads are made of in covered cells: density less 1 and momentum before the collision, and `B/Σ ε_s`.
#[derive(Clone, Debug)]
pub(super) struct Seen<T> {
    pub(super) of: [Vec<T>; 5],
}

/// What one solid has received in one run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Received {
    pub(super) solid: usize,
    pub(super) load: Load,
    /// `Σ B_s`
    pub(super) displaced: f64,
}

impl<T: Real> Seen<T> {
    pub(super) fn new(cells: usize) -> Self {
        Seen { of: std::array::from_fn(|_| vec![T::default(); cells]) }
    }
}

impl<T: Real> Fields<T> {
    /// Those of a run without solids.
    pub(super) fn new(cells: usize) -> Self {
        Fields {
            epsilon: vec![T::default(); cells],
            motion: Default::default(),
            has_motion: false,
            covered: vec![false; cells.div_ceil(BLOCK)],
            meetings: Vec::new(),
            meeting_of: Vec::new(),
        }
    }

    /// `Σ ε_s u_s`, if any of the solids has a velocity.
    pub(super) fn motion(&self) -> Option<[&[T]; 3]> {
        self.has_motion.then(|| self.motion.each_ref().map(Vec::as_slice))
    }

    /// Adds what the solids cover of run number `run`, the first cell of which is `first`.
    pub(super) fn add(
        &mut self,
        coverage: &Coverage<T>,
        solids: &[Solid],
        run: usize,
        first: usize,
    ) {
        let parts = coverage.parts(run);
        self.has_motion = parts.iter().any(|part| solids[part.solid].has_velocity());
        let mut meets = false;
        for part in parts {
            for row in coverage.rows(part, first) {
                let cells = row.start..row.start + row.epsilons.len();
                self.covered[cells.start / BLOCK..=(cells.end - 1) / BLOCK].fill(true);
                for (at, epsilon) in cells.zip(row.epsilons) {
                    meets |= self.has_motion && self.epsilon[at] != T::default() && self.meet(at);
                    self.epsilon[at] = self.epsilon[at].plus(*epsilon);
                }
            }
        }
        if !self.has_motion {
            return;
        }
        for motion in &mut self.motion {
            motion.resize(self.epsilon.len(), T::default());
        }
        for part in parts {
            let rigid = Rigid::of(&solids[part.solid]);
            for row in coverage.rows(part, first) {
                let along = rigid.along(&row.arm);
                for (x, epsilon) in row.epsilons.iter().enumerate() {
                    let (at, epsilon) = (row.start + x, epsilon.to_f64());
                    let u_s = along.velocity(x as f64);
                    for axis in 0..3 {
                        let sum = &mut self.motion[axis][at];
                        *sum = sum.plus(T::from_f64(epsilon * u_s[axis]));
                    }
                    if meets && self.meeting_of[at] > 0 {
                        let squares = &mut self.meetings[self.meeting_of[at] as usize - 1].squares;
                        for (sum, [i, j]) in squares.iter_mut().zip(AXES) {
                            *sum += epsilon * u_s[i] * u_s[j];
                        }
                    }
                }
            }
        }
    }

    /// Notes that solids meet in a cell.
    fn meet(&mut self, at: usize) -> bool {
        self.meeting_of.resize(self.epsilon.len(), 0);
        if self.meeting_of[at] == 0 {
            self.meetings.push(Meeting { cell: at, squares: [0.0; 6] });
            self.meeting_of[at] = u32::try_from(self.meetings.len()).unwrap_or(u32::MAX);
        }
        true
    }

    /// Takes away what [`Self::add`] has added.
    pub(super) fn clear(&mut self, coverage: &Coverage<T>, run: usize, first: usize) {
        for part in coverage.parts(run) {
            for row in coverage.rows(part, first) {
                let cells = row.start..row.start + row.epsilons.len();
                self.covered[cells.start / BLOCK..=(cells.end - 1) / BLOCK].fill(false);
                self.epsilon[cells.clone()].fill(T::default());
                if self.has_motion {
                    self.motion.iter_mut().for_each(|sum| sum[cells.clone()].fill(T::default()));
                }
            }
        }
        for Meeting { cell, .. } in self.meetings.drain(..) {
            self.meeting_of[cell] = 0;
        }
    }

    /// Where solids with different velocities meet, the pass has taken the mean of these. The equilibria of the
    /// solids are squares of the velocities: adds what the mean of the squares is more than the square of the mean.
    pub(super) fn correct_meetings(&self, rules: &Rules, run: &mut [&mut [T]; Q]) {
        for Meeting { cell, squares } in &self.meetings {
            let sum = self.epsilon[*cell].to_f64();
            let mean = self.motion.each_ref().map(|motion| motion[*cell].to_f64() / sum);
            let b_t = rules.weight_of(sum.min(1.0));
            // Σ_s B_s (u_s - ū)(u_s - ū)ᵀ
            let spread: [f64; 6] = std::array::from_fn(|k| {
                let [i, j] = AXES[k];
                b_t * (squares[k] / sum - mean[i] * mean[j])
            });
            let [xx, yy, zz, ..] = spread;
            // No collision changes the density. Where that of f_a was, there is now f*_-a.
            let rho: f64 = 1.0 + (0..Q).map(|a| run[a][*cell].to_f64()).sum::<f64>();
            for a in 0..Q {
                let c = C[a].map(f64::from);
                let along: f64 = spread
                    .iter()
                    .zip(AXES)
                    .map(
                        |(value, [i, j])| {
                            if i == j { value * c[i] * c[j] } else { 2.0 * value * c[i] * c[j] }
                        },
                    )
                    .sum();
                // w ρ Σ_s B_s [9/2 (c·(u_s - ū))² - 3/2 (u_s - ū)²]
                let gain = weight(a) * rho * (4.5 * along - 1.5 * (xx + yy + zz));
                let value = &mut run[OPPOSITE[a]][*cell];
                *value = T::from_f64(value.to_f64() + gain);
            }
        }
    }

    /// What each solid has received in this run.
    pub(super) fn receive(
        (coverage, solids): (&Coverage<T>, &[Solid]),
        (run, first): (usize, usize),
        seen: &Seen<T>,
    ) -> Vec<Received> {
        let of_part = |part: &Part| {
            let rigid = Rigid::of(&solids[part.solid]);
            let mut received =
                Received { solid: part.solid, load: Load::default(), displaced: 0.0 };
            for row in coverage.rows(part, first) {
                let cells = row.start..row.start + row.epsilons.len();
                let along = rigid.along(&row.arm);
                let [excess, jx, jy, jz, share] = seen.of.each_ref().map(|of| &of[cells.clone()]);
                for x in 0..row.epsilons.len() {
                    // B_s = B_t ε_s / Σ ε_s
                    let weight = share[x].to_f64() * row.epsilons[x].to_f64();
                    let (rho, u_s) = (1.0 + excess[x].to_f64(), along.velocity(x as f64));
                    let j = [jx[x].to_f64(), jy[x].to_f64(), jz[x].to_f64()];
                    // F_s = -B_s Σ_a Λ_a c_a = B_s (j - ρ u_s)
                    let [fx, fy, fz] = [0, 1, 2].map(|axis| weight * (j[axis] - rho * u_s[axis]));
                    let (rx, ry, rz) = (row.arm.x + x as f64, row.arm.y, row.arm.z);
                    received.load.force += Vec3::new(fx, fy, fz);
                    received.load.torque +=
                        Vec3::new(ry * fz - rz * fy, rz * fx - rx * fz, rx * fy - ry * fx);
                    received.displaced += weight;
                }
            }
            received
        };
        coverage.parts(run).iter().map(of_part).collect()
    }
}

/// The axes of the six components of a symmetric matrix.
const AXES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// The motion of a solid.
struct Rigid {
    velocity: [f64; 3],
    angular: [f64; 3],
}

/// Its velocity along a row of cells: linear in x.
struct Along {
    first: [f64; 3],
    per_cell: [f64; 3],
}

impl Rigid {
    fn of(solid: &Solid) -> Self {
        Rigid { velocity: solid.velocity.into(), angular: solid.angular_velocity.into() }
    }

    /// Along the row whose first cell is at `arm` from the centre.
    #[inline]
    fn along(&self, arm: &Vec3) -> Along {
        let [wx, wy, wz] = self.angular;
        let [ux, uy, uz] = self.velocity;
        // u_s = U + ω × r
        Along {
            first: [
                ux + (wy * arm.z - wz * arm.y),
                uy + (wz * arm.x - wx * arm.z),
                uz + (wx * arm.y - wy * arm.x),
            ],
            per_cell: [0.0, wz, -wy],
        }
    }
}

impl Along {
    #[inline]
    fn velocity(&self, x: f64) -> [f64; 3] {
        let ([a, b, c], [_, q, r]) = (self.first, self.per_cell);
        [a, b + q * x, c + r * x]
    }
}
