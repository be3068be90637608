//! What solids cover of one run of cells, as fields that a pass can read vector by vector.

use psmrt_reference::directions::{C, OPPOSITE, Q};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Solid;
use pulp::{Simd, WithSimd};

use super::collision::{Rules, weight};
use super::coverage::Coverage;
use super::rigid::{Along, EIGHT, Rigid};
use crate::lanes::Real;

/// Cells that are told apart together: if one of them is covered, all are collided as if they were. (Where a cell is
/// not, that makes no difference: the weight of the solid's part is 0, that of the fluid's 1.)
const BLOCK: usize = 8;

/// Cells that are left out together, if solids at rest fill all of them: as many as the longest vector has, so that the
/// results are those of any other.
const WHOLE: usize = 16;

/// Sums over the solids in each cell of a run.
///
/// Behind the last cell of a run there is room for eight more: what is done to a row is done to eight cells at a time.
#[derive(Clone, Debug)]
pub(super) struct Fields<T> {
    /// `Σ ε_s`
    pub(super) epsilon: Vec<T>,
    /// `Σ ε_s u_s`, component by component; empty until a solid has a velocity.
    motion: [Vec<T>; 3],
    has_motion: bool,
    /// For each block, whether solids cover some of it.
    covered: Vec<bool>,
    /// For each [`WHOLE`] cells, whether solids at rest fill them; empty unless [`Self::find_filled`] has looked.
    filled: Vec<bool>,
    /// Row by row, solid by solid, what each solid covers; and its solid fractions there, one row behind the other, each
    /// filled up with zeros to whole eights.
    rows: Vec<RowOf>,
    fractions: Vec<[T; EIGHT]>,
    meetings: Vec<Meeting>,
    /// For each cell the number of its meeting, after one of none; empty until solids meet.
    meeting_of: Vec<u32>,
}

/// Cells of a row, one behind the other, that a solid covers.
#[derive(Clone, Debug)]
pub(super) struct RowOf {
    pub(super) solid: usize,
    /// The first, counted from the first of the run.
    start: usize,
    /// How many times eight.
    eights: usize,
    /// From the solid's centre to that of the first cell.
    pub(super) arm: Vec3,
}

/// A cell in which solids meet.
#[derive(Clone, Debug)]
struct Meeting {
    cell: usize,
    /// `Σ ε_s u_s u_sᵀ`: xx, yy, zz, xy, xz, yz.
    squares: [f64; 6],
}

/// What loads are made of in covered cells: density and momentum before the collision, times `B/Σ ε_s`, and that itself.
/// (Where only cells are looked at: density less 1, and momentum.)
#[derive(Clone, Debug)]
pub(super) struct Seen<T> {
    pub(super) of: [Vec<T>; 5],
}

/// [`Fields::add`], to be dispatched.
pub(super) struct Adding<'a, T> {
    pub(super) fields: &'a mut Fields<T>,
    pub(super) of: (&'a Coverage<T>, &'a [Solid]),
    pub(super) run: usize,
    pub(super) first: usize,
    /// Whether somebody asks how fast they are.
    pub(super) with_motion: bool,
}

impl<T: Real> WithSimd for Adding<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Adding { fields, of, run, first, with_motion } = self;
        fields.add(of, run, first, with_motion);
    }
}

impl<T: Real> Seen<T> {
    pub(super) fn new(cells: usize) -> Self {
        Seen { of: std::array::from_fn(|_| vec![T::default(); cells + EIGHT]) }
    }

    /// Those of eight cells from `at` on.
    #[inline(always)]
    pub(super) fn eight(&self, at: usize) -> Option<[&[T; EIGHT]; 5]> {
        let [a, b, c, d, e] = self.of.each_ref().map(|of| of[at..].first_chunk::<EIGHT>());
        Some([a?, b?, c?, d?, e?])
    }
}

impl<T: Real> Fields<T> {
    /// Those of a run without solids.
    pub(super) fn new(cells: usize) -> Self {
        Fields {
            epsilon: vec![T::default(); cells.next_multiple_of(BLOCK) + EIGHT],
            motion: Default::default(),
            has_motion: false,
            covered: vec![false; cells.div_ceil(BLOCK)],
            filled: Vec::new(),
            rows: Vec::new(),
            fractions: Vec::new(),
            meetings: Vec::new(),
            meeting_of: Vec::new(),
        }
    }

    /// Whether solids cover some of the blocks in which `count` cells from `at` on lie.
    #[inline(always)]
    pub(super) fn is_covered(&self, at: usize, count: usize) -> bool {
        let (first, last) = (at / BLOCK, (at + count - 1) / BLOCK);
        self.covered[first] || (last > first && self.covered[last])
    }

    /// Looks which cells solids at rest fill.
    pub(super) fn find_filled(&mut self, cells: usize) {
        if !self.has_motion {
            let one = T::from_f64(1.0);
            let is_filled = |cells: &[T; WHOLE]| cells.iter().all(|epsilon| *epsilon == one);
            self.filled = self.epsilon[..cells].as_chunks().0.iter().map(is_filled).collect();
        }
    }

    /// Whether solids at rest fill the cells of a vector from `at` on.
    #[inline(always)]
    pub(super) fn is_filled(&self, at: usize) -> bool {
        self.filled.get(at / WHOLE).copied().unwrap_or(false)
    }

    /// `Σ ε_s u_s`, if any of the solids has a velocity.
    pub(super) fn motion(&self) -> Option<[&[T]; 3]> {
        self.has_motion.then(|| self.motion.each_ref().map(Vec::as_slice))
    }

    /// Adds what the solids cover of run number `run`, the first cell of which is `first`; their velocities only
    /// `with_motion`.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        (coverage, solids): (&Coverage<T>, &[Solid]),
        run: usize,
        first: usize,
        with_motion: bool,
    ) {
        coverage.fetch(run);
        let parts = coverage.parts(run);
        self.has_motion = with_motion && parts.iter().any(|part| solids[part.solid].has_velocity());
        if self.has_motion {
            let cells = self.epsilon.len();
            self.motion.iter_mut().for_each(|motion| motion.resize(cells, T::default()));
        }
        for part in parts {
            let rigid = Rigid::of(&solids[part.solid]);
            for row in coverage.rows(part, first) {
                for block in row.start / BLOCK..=(row.start + row.count - 1) / BLOCK {
                    self.covered[block] = true;
                }
                let along = rigid.along(&row.arm);
                let (eights, rest) = row.epsilons.as_chunks::<EIGHT>();
                for (number, fractions) in eights.iter().enumerate() {
                    self.add_eight(
                        row.start + number * EIGHT,
                        *fractions,
                        &along.from(number * EIGHT),
                    );
                }
                if !rest.is_empty() {
                    let mut fractions = [T::default(); EIGHT];
                    fractions[..rest.len()].copy_from_slice(rest);
                    let number = eights.len();
                    self.add_eight(
                        row.start + number * EIGHT,
                        fractions,
                        &along.from(number * EIGHT),
                    );
                }
                self.rows.push(RowOf {
                    solid: part.solid,
                    start: row.start,
                    eights: row.count.div_ceil(EIGHT),
                    arm: row.arm,
                });
            }
        }
    }

    /// Adds what a solid covers of eight cells from `at` on.
    #[inline(always)]
    fn add_eight(&mut self, at: usize, added: [T; EIGHT], along: &Along) {
        self.fractions.push(added);
        let Some(sum) = self.epsilon[at..].first_chunk_mut::<EIGHT>() else { return };
        let no = T::default();
        let (before, mut meets) = (*sum, false);
        for x in 0..EIGHT {
            meets |= (before[x] != no) & (added[x] != no);
            sum[x] = before[x] + added[x];
        }
        if !self.has_motion {
            return;
        }
        let u_s = along.eight();
        if meets {
            for x in 0..EIGHT {
                if before[x] != no && added[x] != no {
                    let u_s = [u_s[0][x], u_s[1][x], u_s[2][x]];
                    self.meet(at + x, before[x].to_f64(), added[x].to_f64(), &u_s);
                }
            }
        }
        for axis in 0..3 {
            let Some(sum) = self.motion[axis][at..].first_chunk_mut::<EIGHT>() else { return };
            for x in 0..EIGHT {
                sum[x] = sum[x] + T::from_f64(added[x].to_f64() * u_s[axis][x]);
            }
        }
    }

    /// The rows that solids cover, solid by solid, each with its cells from the first on, eight at a time: where they
    /// start, and the solid fractions.
    #[inline(always)]
    pub(super) fn rows(
        &self,
    ) -> impl Iterator<Item = (&RowOf, impl Iterator<Item = (usize, &[T; EIGHT])>)> {
        let mut behind = self.fractions.as_slice();
        self.rows.iter().map(move |row| {
            let (fractions, others) = behind.split_at(row.eights);
            behind = others;
            (row, fractions.iter().enumerate().map(|(n, eight)| (row.start + n * EIGHT, eight)))
        })
    }

    /// Notes that one more solid, `epsilon` of it with the velocity `u_s`, meets others in a cell, which fill `before`.
    fn meet(&mut self, at: usize, before: f64, epsilon: f64, u_s: &[f64; 3]) {
        self.meeting_of.resize(self.epsilon.len(), 0);
        if self.meeting_of[at] == 0 {
            // So far there was one.
            let motion = self.motion.each_ref().map(|motion| motion[at].to_f64());
            let squares = AXES.map(|[i, j]| motion[i] * motion[j] / before);
            self.meetings.push(Meeting { cell: at, squares });
            self.meeting_of[at] = u32::try_from(self.meetings.len()).unwrap_or(u32::MAX);
        }
        let squares = &mut self.meetings[self.meeting_of[at] as usize - 1].squares;
        for (sum, [i, j]) in squares.iter_mut().zip(AXES) {
            *sum += epsilon * u_s[i] * u_s[j];
        }
    }

    /// Takes away what [`Self::add`] has added.
    pub(super) fn clear(&mut self) {
        let zeros = [T::default(); BLOCK];
        let motion = self.motion.iter_mut().filter(|_| self.has_motion);
        let mut sums: Vec<&mut [[T; BLOCK]]> =
            motion.chain([&mut self.epsilon]).map(|sum| sum.as_chunks_mut::<BLOCK>().0).collect();
        for (block, covered) in self.covered.iter_mut().enumerate() {
            if std::mem::take(covered) {
                sums.iter_mut().for_each(|sum| sum[block] = zeros);
            }
        }
        self.rows.clear();
        self.fractions.clear();
        for Meeting { cell, .. } in self.meetings.drain(..) {
            self.meeting_of[cell] = 0;
        }
    }

    /// Where solids with different velocities meet, the pass has taken the mean of these. The equilibria of the
    /// solids are squares of the velocities: adds what the mean of the squares is more than the square of the mean.
    pub(super) fn correct_meetings(&self, rules: &Rules, run: &mut [&mut [T]; Q]) {
        if !rules.has_squares() {
            return;
        }
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
}

/// The axes of the six components of a symmetric matrix.
const AXES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];
