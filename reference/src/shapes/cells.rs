//! Solid fractions given cell by cell.

use super::Covered;
use crate::domain::Domain;
use crate::lattice::Vec3;

/// Cell and solid fraction.
type Fractions = [(usize, f64)];

pub(super) fn volume(fractions: &Fractions) -> f64 {
    fractions.iter().map(|(_, epsilon)| epsilon).sum()
}

pub(super) fn bounds(domain: &Domain, fractions: &Fractions) -> Option<[Vec3; 2]> {
    let centres = covered(domain, &Vec3::zeros(), fractions).into_iter().map(|at| at.arm);
    let boxes = centres.map(|centre| [centre.add_scalar(-0.5), centre.add_scalar(0.5)]);
    boxes.reduce(|one, two| [one[0].inf(&two[0]), one[1].sup(&two[1])])
}

pub(super) fn covered(domain: &Domain, centre: &Vec3, fractions: &Fractions) -> Vec<Covered> {
    let covered = fractions.iter().filter(|(_, epsilon)| *epsilon > 0.0);
    let at = |&(cell, epsilon): &(usize, f64)| {
        let arm = domain.centre(domain.coordinates(cell)) - centre;
        Covered { cell, epsilon, arm }
    };
    covered.map(at).collect()
}
