//! What the solids cover: for each solid the cells that it touches, cut up by runs of cells.

use std::ops::{Range, RangeInclusive};

use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};
use rayon::prelude::*;

use crate::ball::{cells_about, rows_of_fractions, sampled_fraction};
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
    pub(super) epsilons: &'a [T],
    /// From the image's centre to that of the first cell.
    pub(super) arm: Vec3,
}

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
        let images = solids.par_iter().map(|solid| images(domain, solid, rule, run)).collect();
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
        let moved: Vec<(usize, Vec<Image<T>>)> = solids
            .par_iter()
            .enumerate()
            .filter(|(number, solid)| before[*number].centre != solid.centre)
            .map(|(number, solid)| (number, images(domain, solid, rule, run)))
            .collect();
        let others = solids.iter().zip(before).enumerate().filter(|(_, (now, then))| {
            now.velocity != then.velocity || now.angular_velocity != then.angular_velocity
        });
        for (number, _) in others {
            self.mark(number);
        }
        if moved.is_empty() {
            return;
        }
        for (number, images) in moved {
            self.mark(number);
            self.images[number] = images;
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

    /// The cells of a part, row by row, in the run whose first cell is `first`.
    pub(super) fn rows(&self, part: &Part, first: usize) -> impl Iterator<Item = Row<'_, T>> {
        let image = &self.images[part.solid][part.image];
        image.spans[part.spans.clone()].iter().map(move |span| {
            let (start, count) = (span.start as usize, span.count as usize);
            Row {
                start: span.cell as usize - first,
                epsilons: &image.epsilons[start..start + count],
                arm: Vec3::from(span.at.map(|x| f64::from(x) + 0.5)) - image.centre,
            }
        })
    }
}

/// A solid and its images, each with what it touches.
fn images<T: Real>(
    domain: &Domain,
    solid: &Solid,
    rule: CoverageRule,
    run: usize,
) -> Vec<Image<T>> {
    match &solid.shape {
        Shape::Cells { fractions } => {
            let mut touches: Vec<(usize, f64)> =
                fractions.iter().filter(|(_, epsilon)| *epsilon > 0.0).copied().collect();
            touches.sort_by_key(|&(cell, _)| cell);
            let mut image = Image::empty(solid.centre);
            for (cell, epsilon) in touches {
                image.extend(domain, run, domain.coordinates(cell), &[epsilon]);
            }
            vec![image]
        }
        Shape::Sphere { radius } => images_of_sphere(domain, solid.centre, *radius, rule, run),
    }
}

impl<T: Real> Image<T> {
    fn empty(centre: Vec3) -> Self {
        Image { centre, epsilons: Vec::new(), spans: Vec::new(), runs: Vec::new() }
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

/// The images of a sphere that reach into the domain.
fn images_of_sphere<T: Real>(
    domain: &Domain,
    centre: Vec3,
    radius: f64,
    rule: CoverageRule,
    run: usize,
) -> Vec<Image<T>> {
    let ranges = cells_about(centre.into(), radius);
    // Along each axis the stretches of cells between faces, with how far they are from the domain.
    let stretches: [Vec<(i64, RangeInclusive<i64>)>; 3] = std::array::from_fn(|axis| {
        let n = i64::try_from(domain.cells()[axis]).unwrap_or(i64::MAX);
        let (first, last) = (*ranges[axis].start(), *ranges[axis].end());
        let turns =
            if domain.is_periodic(axis) { first.div_euclid(n)..=last.div_euclid(n) } else { 0..=0 };
        let stretch = |turn: i64| {
            let offset = turn * n;
            (offset, (first - offset).max(0)..=(last - offset).min(n - 1))
        };
        turns.map(stretch).filter(|(_, cells)| !cells.is_empty()).collect()
    });
    let mut images = Vec::new();
    for (oz, z) in &stretches[2] {
        for (oy, y) in &stretches[1] {
            for (ox, x) in &stretches[0] {
                let centre = centre - Vec3::new(*ox as f64, *oy as f64, *oz as f64);
                let mut image = Image::empty(centre);
                let cells = [x, y, z].map(Clone::clone);
                let mut tell = |at: [i64; 3], epsilons: &[f64]| {
                    // All of them are cells of the domain.
                    let at = at.map(|x| usize::try_from(x).unwrap_or_default());
                    image.extend(domain, run, at, epsilons);
                };
                match rule {
                    CoverageRule::Exact => {
                        rows_of_fractions(centre.into(), radius, &cells, &mut tell);
                    }
                    CoverageRule::Sampled { n } => {
                        for z in z.clone() {
                            for y in y.clone() {
                                for x in x.clone() {
                                    let from =
                                        Vec3::new(x as f64, y as f64, z as f64).add_scalar(0.5);
                                    let epsilon =
                                        sampled_fraction((centre - from).into(), radius, n);
                                    if epsilon > 0.0 {
                                        tell([x, y, z], &[epsilon]);
                                    }
                                }
                            }
                        }
                    }
                }
                if !image.spans.is_empty() {
                    images.push(image);
                }
            }
        }
    }
    images
}
