//! What the solids cover: for each solid the cells that it touches, cut up by runs of cells.

use std::ops::{Range, RangeInclusive};

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};
use rayon::prelude::*;

use super::prefetch::ask_first;
use crate::ball::{cells_about, rows_of_fractions};
use crate::lanes::Real;

/// A solid, or an image of it across periodic faces, with the cells that it touches in their order.
#[derive(Clone, Debug)]
struct Image<T> {
    /// The point that arms are measured from.
    centre: Vec3,
    /// Solid fractions of the cells, span by span.
    epsilons: Vec<T>,
    spans: Vec<Span>,
    /// Which of the spans lie in which run of cells.
    runs: Vec<(u32, Range<u32>)>,
}

/// Cells of one row, one behind the other, that an image touches.
#[derive(Clone, Copy, Debug)]
struct Span {
    /// The first, and its coordinates.
    cell: u32,
    at: [u32; 3],
    /// Where its solid fraction is, and those of the others after it.
    start: u32,
    count: u32,
}

/// The spans of one image that lie in one run of cells.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) solid: usize,
    image: usize,
    spans: Range<usize>,
}

/// The cells of one span for whoever works on them.
pub(super) struct Row<'a, T> {
    /// The first, counted from the first of the run.
    pub(super) start: usize,
    pub(super) count: usize,
    /// Their solid fractions.
    pub(super) epsilons: &'a [T],
    /// From the image's centre to that of the first cell.
    pub(super) arm: Vec3,
}

/// Solids that a thread takes at a time.
const BATCH: usize = 64;

/// What all solids cover.
#[derive(Clone, Debug)]
pub(super) struct Coverage<T> {
    run: usize,
    images: Vec<Vec<Image<T>>>,
    /// The parts of all runs, each with its solids in order, and where those of each run begin.
    parts: Vec<Part>,
    begins: Vec<usize>,
    /// Whether solids in a run have moved since the last pass.
    pub(super) has_changed: Vec<bool>,
}

impl<T: Real> Coverage<T> {
    /// That of `solids`, for runs of `run` cells.
    pub(super) fn new(domain: &Domain, solids: &[Solid], rule: CoverageRule, run: usize) -> Self {
        let runs = domain.cell_count().div_ceil(run);
        let images = |solid| images(domain, solid, rule, run, Vec::new());
        let images = solids.par_iter().map(images).collect();
        let mut coverage = Coverage {
            run,
            images,
            parts: Vec::new(),
            begins: Vec::new(),
            has_changed: vec![false; runs],
        };
        coverage.sort();
        coverage
    }

    /// The same for solids of which some have moved or changed their velocities.
    pub(super) fn update(
        &mut self,
        domain: &Domain,
        before: &[Solid],
        solids: &[Solid],
        rule: CoverageRule,
    ) {
        let run = self.run;
        let has_moved = |number: usize| solids[number].covers_other_cells(&before[number]);
        let changes_velocity = |number: usize| {
            let (now, then) = (&solids[number], &before[number]);
            now.velocity != then.velocity || now.angular_velocity != then.angular_velocity
        };
        for number in (0..solids.len()).filter(|&n| has_moved(n) || changes_velocity(n)) {
            self.mark(number);
        }
        let numbered = self.images.par_iter_mut().with_min_len(BATCH).enumerate();
        numbered.filter(|(number, _)| has_moved(*number)).for_each(|(number, of_solid)| {
            let old = std::mem::take(of_solid);
            *of_solid = images(domain, &solids[number], rule, run, old);
        });
        let moved: Vec<usize> = (0..solids.len()).filter(|&number| has_moved(number)).collect();
        if moved.is_empty() {
            return;
        }
        for number in moved {
            self.mark(number);
        }
        self.sort();
    }

    fn mark(&mut self, solid: usize) {
        for image in &self.images[solid] {
            for (run, _) in &image.runs {
                self.has_changed[*run as usize] = true;
            }
        }
    }

    /// Lists the parts by runs.
    fn sort(&mut self) {
        let mut counts = vec![0; self.has_changed.len() + 1];
        for image in self.images.iter().flatten() {
            image.runs.iter().for_each(|(run, _)| counts[*run as usize + 1] += 1);
        }
        for run in 1..counts.len() {
            counts[run] += counts[run - 1];
        }
        self.begins.clone_from(&counts);
        self.parts.clear();
        self.parts.resize(counts[self.has_changed.len()], Part { solid: 0, image: 0, spans: 0..0 });
        for (solid, images) in self.images.iter().enumerate() {
            for (number, image) in images.iter().enumerate() {
                for (run, spans) in &image.runs {
                    let slot = &mut counts[*run as usize];
                    let spans = spans.start as usize..spans.end as usize;
                    self.parts[*slot] = Part { solid, image: number, spans };
                    *slot += 1;
                }
            }
        }
    }

    /// The parts that lie in a run.
    pub(super) fn parts(&self, run: usize) -> &[Part] {
        &self.parts[self.begins[run]..self.begins[run + 1]]
    }

    /// Asks for the memory of what each part of a run covers, of all at once: one after the other, each would be waited
    /// for.
    pub(super) fn fetch(&self, run: usize) {
        for part in self.parts(run) {
            let image = &self.images[part.solid][part.image];
            let spans = &image.spans[part.spans.clone()];
            spans.chunks(2).for_each(ask_first);
            let (Some(first), Some(last)) = (spans.first(), spans.last()) else { continue };
            let epsilons = first.start as usize..(last.start + last.count) as usize;
            image.epsilons[epsilons].chunks(16).for_each(ask_first);
        }
    }

    /// The cells of a part, row by row, in the run whose first cell is `first`.
    pub(super) fn rows(&self, part: &Part, first: usize) -> impl Iterator<Item = Row<'_, T>> {
        let image = &self.images[part.solid][part.image];
        image.spans[part.spans.clone()].iter().map(move |span| {
            let (start, count) = (span.start as usize, span.count as usize);
            Row {
                start: span.cell as usize - first,
                count,
                epsilons: &image.epsilons[start..start + count],
                arm: Vec3::from(span.at.map(|x| f64::from(x) + 0.5)) - image.centre,
            }
        })
    }
}

/// A solid and its images, each with what it touches, in the memory of old ones.
fn images<T: Real>(
    domain: &Domain,
    solid: &Solid,
    rule: CoverageRule,
    run: usize,
    mut old: Vec<Image<T>>,
) -> Vec<Image<T>> {
    let mut images = Vec::with_capacity(old.len());
    match &solid.shape {
        Shape::Cells { fractions, .. } => {
            let mut touches: Vec<(usize, f64)> =
                fractions.iter().filter(|(_, epsilon)| *epsilon > 0.0).copied().collect();
            touches.sort_by_key(|&(cell, _)| cell);
            let mut image = Image::empty(solid.centre, old.pop());
            for (cell, epsilon) in touches {
                image.extend(domain, run, domain.coordinates(cell), &[epsilon]);
            }
            images.extend(image.finished());
        }
        Shape::Sphere { radius } => {
            in_images(domain, solid.centre, *radius, |centre, cells| {
                let mut image = Image::empty(centre, old.pop());
                rows_of_fractions(rule, centre.into(), *radius, cells, |at, epsilons| {
                    // All of them are cells of the domain.
                    let at = at.map(|x| usize::try_from(x).unwrap_or_default());
                    image.extend(domain, run, at, epsilons);
                });
                images.extend(image.finished());
            });
        }
    }
    images
}

impl<T: Real> Image<T> {
    /// One that touches nothing, in the memory of an old one.
    fn empty(centre: Vec3, old: Option<Self>) -> Self {
        let Some(Image { mut epsilons, mut spans, mut runs, .. }) = old else {
            return Image { centre, epsilons: Vec::new(), spans: Vec::new(), runs: Vec::new() };
        };
        epsilons.clear();
        spans.clear();
        runs.clear();
        Image { centre, epsilons, spans, runs }
    }

    /// The image, if it touches a cell.
    fn finished(self) -> Option<Self> {
        (!self.spans.is_empty()).then_some(self)
    }

    /// Adds cells of a row from `at` on, which come after all others.
    fn extend(&mut self, domain: &Domain, run: usize, at: [usize; 3], epsilons: &[f64]) {
        let cell = number(domain.index(at));
        let start = number(self.epsilons.len());
        self.epsilons.extend(epsilons.iter().map(|&epsilon| T::from_f64(epsilon)));
        let count = number(epsilons.len());
        match self.spans.last_mut() {
            Some(span) if span.cell + span.count == cell && at[0] > 0 => span.count += count,
            _ => {
                self.spans.push(Span { cell, at: at.map(number), start, count });
                let (run, end) = (cell / number(run), number(self.spans.len()));
                match self.runs.last_mut() {
                    Some((of, spans)) if *of == run => spans.end = end,
                    _ => self.runs.push((run, end - 1..end)),
                }
            }
        }
    }
}

/// The number of a cell or a touch: a domain has fewer than 2^32 - 1 cells.
fn number(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

/// Calls `visit` with the centre of each image of a sphere that reaches into the domain, and the cells about it there.
fn in_images(
    domain: &Domain,
    centre: Vec3,
    radius: f64,
    mut visit: impl FnMut(Vec3, &[RangeInclusive<i64>; 3]),
) {
    let ranges = cells_about(centre.into(), radius);
    let extents = domain.cells().map(|n| i64::try_from(n).unwrap_or(i64::MAX));
    // How often, along each axis, the domain is repeated between the origin and the cells.
    let turns = [0, 1, 2].map(|axis| {
        let [first, last] = [ranges[axis].start(), ranges[axis].end()]
            .map(|cell| if domain.is_periodic(axis) { cell.div_euclid(extents[axis]) } else { 0 });
        first..=last
    });
    let [along_x, along_y, along_z] = turns;
    for z in along_z {
        for y in along_y.clone() {
            for x in along_x.clone() {
                let offset = [x * extents[0], y * extents[1], z * extents[2]];
                let cells = [0, 1, 2].map(|axis| {
                    let [first, last] = [ranges[axis].start(), ranges[axis].end()];
                    (first - offset[axis]).max(0)..=(last - offset[axis]).min(extents[axis] - 1)
                });
                visit(centre - Vec3::from(offset.map(|cells| cells as f64)), &cells);
            }
        }
    }
}
