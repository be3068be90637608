//! Candidates for contact, found with a list of cells in O(N).
//!
//! Space is cut into cells no smaller than the largest distance at which two grains can be
//! candidates; grains are sorted by cell (counting sort), and each looks at the 27 cells about its
//! own. Each pair is listed once, sorted by the numbers of its grains: the list depends on where the
//! grains are and on nothing else, so that forces that are summed in its order come out the same on any
//! number of threads, as Nishiura & Sakaguchi arrange it (J. Comput. Phys. 230, 1923 (2011), the
//! paper's reference 10).
//!
//! Along a periodic axis a grain has images; a candidate names the image of its second grain, so that
//! a pair may touch through two faces at once. Positions are unbounded (never wrapped): as long as a
//! pair stays together its image stays the same.

use crate::grains::grain::Grain;
use crate::grains::parallel::for_each;
use crate::grains::setup::PeriodicBox;
use crate::lattice::Vec3;

/// Two grains that may touch: the first and the image of the second that is moved by `image` lengths
/// of the domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Candidate {
    /// Number of the first grain.
    pub first: u32,
    /// Number of the second grain, greater than the first.
    pub second: u32,
    /// By how many lengths of the domain the second is moved along x, y, z.
    pub image: [i32; 3],
}

/// The pairs of grains whose surfaces are less than `reach` (length) apart, each once, sorted.
///
/// Along periodic axes the domain must be at least as long as the largest diameter plus `reach`.
pub fn candidates(grains: &[Grain], sides: &PeriodicBox, reach: f64) -> Vec<Candidate> {
    if grains.is_empty() {
        return Vec::new();
    }
    let cells = Cells::new(grains, sides, reach);
    let of_grain = |first: usize| {
        let one = &grains[first];
        let mut found = Vec::new();
        cells.for_each_neighbour(first, |second, image| {
            let two = &grains[second];
            let offset = sides.offset(&one.position, &two.position, image);
            if offset.norm() < one.radius + two.radius + reach {
                found.push(Candidate { first: number(first), second: number(second), image });
            }
        });
        found.sort_unstable();
        found
    };
    let mut lists = vec![Vec::new(); grains.len()];
    for_each(&mut lists, |first, list| *list = of_grain(first));
    lists.concat()
}

/// A grain's number as it is stored.
#[expect(clippy::cast_possible_truncation, reason = "GrainSystem refuses 2^32 - 1 grains or more")]
fn number(grain: usize) -> u32 {
    grain as u32
}

/// The grains sorted by cell.
struct Cells {
    /// Cells along each axis.
    counts: [usize; 3],
    periodic: [bool; 3],
    /// Cell of each grain.
    cell_of: Vec<[usize; 3]>,
    /// How many lengths of the domain each grain is away from it.
    wraps: Vec<[i32; 3]>,
    /// The grains of cell `c` are `sorted[starts[c]..starts[c + 1]]`.
    starts: Vec<usize>,
    sorted: Vec<usize>,
}

impl Cells {
    fn new(grains: &[Grain], sides: &PeriodicBox, reach: f64) -> Self {
        let size = 2.0 * grains.iter().map(|grain| grain.radius).fold(0.0, f64::max) + reach;
        let (low, high) = bounds(grains);
        let lengths = sides.lengths;
        let spans: [f64; 3] = std::array::from_fn(|i| lengths[i].unwrap_or(high[i] - low[i]));
        let origin = Vec3::from_fn(|i, _| if lengths[i].is_some() { 0.0 } else { low[i] });
        let counts = cell_counts(spans, size, grains.len());

        let mut wraps = vec![[0; 3]; grains.len()];
        let mut cell_of = vec![[0; 3]; grains.len()];
        for (grain, Grain { position, .. }) in grains.iter().enumerate() {
            for axis in 0..3 {
                let mut along = position[axis] - origin[axis];
                if let Some(length) = lengths[axis] {
                    let wrap = (along / length).floor();
                    along -= wrap * length;
                    wraps[grain][axis] = whole(wrap);
                }
                // A span of zero (grains in one plane) has one cell: 0/0 becomes 0.
                let cell = along / spans[axis] * counts[axis] as f64;
                cell_of[grain][axis] = floor(cell).min(counts[axis] - 1);
            }
        }
        let periodic = lengths.map(|length| length.is_some());
        let mut cells =
            Cells { counts, periodic, cell_of, wraps, starts: Vec::new(), sorted: Vec::new() };
        cells.sort();
        cells
    }

    /// Counting sort of the grains by cell; within a cell they stay in the order of their numbers.
    fn sort(&mut self) {
        let cell_count: usize = self.counts.iter().product();
        self.starts = vec![0; cell_count + 1];
        for &cell in &self.cell_of {
            self.starts[index(self.counts, cell) + 1] += 1;
        }
        for cell in 0..cell_count {
            self.starts[cell + 1] += self.starts[cell];
        }
        let mut next = self.starts.clone();
        self.sorted = vec![0; self.cell_of.len()];
        for (grain, &cell) in self.cell_of.iter().enumerate() {
            let place = &mut next[index(self.counts, cell)];
            self.sorted[*place] = grain;
            *place += 1;
        }
    }

    /// Calls `found(second, image)` for the grains of greater number in the 27 cells about grain
    /// `first`. A cell that the domain shows several times is looked at once for each of its images.
    fn for_each_neighbour(&self, first: usize, mut found: impl FnMut(usize, [i32; 3])) {
        let [x, y, z] = std::array::from_fn(|axis| self.steps(axis, self.cell_of[first][axis]));
        for &(cell_z, wrap_z) in z.iter().flatten() {
            for &(cell_y, wrap_y) in y.iter().flatten() {
                for &(cell_x, wrap_x) in x.iter().flatten() {
                    let cell = index(self.counts, [cell_x, cell_y, cell_z]);
                    for &second in &self.sorted[self.starts[cell]..self.starts[cell + 1]] {
                        if second > first {
                            let wrap = [wrap_x, wrap_y, wrap_z];
                            let (one, two) = (self.wraps[first], self.wraps[second]);
                            found(second, std::array::from_fn(|i| wrap[i] + one[i] - two[i]));
                        }
                    }
                }
            }
        }
    }

    /// The cells before, at and after `cell` along an axis, each with the lengths of the domain by
    /// which it is moved; `None` outside a domain that is not periodic.
    fn steps(&self, axis: usize, cell: usize) -> [Option<(usize, i32)>; 3] {
        let last = self.counts[axis] - 1;
        let periodic = self.periodic[axis];
        let before = if cell > 0 { Some((cell - 1, 0)) } else { periodic.then_some((last, -1)) };
        let after = if cell < last { Some((cell + 1, 0)) } else { periodic.then_some((0, 1)) };
        [before, Some((cell, 0)), after]
    }
}

/// Cells along each axis: at least `size` long, and not many more in all than there are grains.
fn cell_counts(spans: [f64; 3], size: f64, grains: usize) -> [usize; 3] {
    let mut counts = spans.map(|span| floor((span / size).min(1e6)).max(1));
    while counts.iter().product::<usize>() > 8 * grains + 27 {
        // Far-flung grains: halve the longest axis.
        let longest = counts.into_iter().fold(1, usize::max);
        counts = counts.map(|count| if count == longest { count.div_ceil(2) } else { count });
    }
    counts
}

/// Number of a cell, x fastest.
fn index(counts: [usize; 3], [x, y, z]: [usize; 3]) -> usize {
    x + counts[0] * (y + counts[1] * z)
}

/// Lowest and highest coordinates of the centres.
fn bounds(grains: &[Grain]) -> (Vec3, Vec3) {
    let start = grains[0].position;
    let widen = |(low, high): (Vec3, Vec3), p: Vec3| (low.inf(&p), high.sup(&p));
    grains.iter().map(|grain| grain.position).fold((start, start), widen)
}

/// A number rounded down; 0 if it is negative or no number.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates as said")]
fn floor(number: f64) -> usize {
    number as usize
}

/// A whole number that was kept as a floating-point one.
#[expect(clippy::cast_possible_truncation, reason = "saturates beyond 2^31 lengths of the box")]
fn whole(number: f64) -> i32 {
    number as i32
}
