//! Whether grains lie inside the box and apart from each other.

use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;

use super::Trouble;
use super::grains::Listed;
use crate::scene::units::Units;

/// How deep two grains may overlap, in diameters of the smaller, or a grain and a face: contacts in
/// packings from discrete-element codes are not sharp.
pub const MAX_OVERLAP: f64 = 0.01;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Errors if a grain's centre lies outside the box, or a face that is no mirror cuts through it.
pub(super) fn inside(
    key: &str,
    domain: &Domain,
    centre: &Vec3,
    radius: f64,
    units: &Units,
) -> Result<(), Trouble> {
    for axis in 0..3 {
        let length = domain.cells()[axis] as f64;
        let (si_at, si_length) = (centre[axis] * units.si_dx, length * units.si_dx);
        if !(0.0..=length).contains(&centre[axis]) {
            let problem = format!(
                "a grain's centre lies at {} = {si_at:.6e} m, outside the box (0 to {si_length:.6e} m)",
                AXES[axis]
            );
            return Err(Trouble::new(key, problem, "move it into the box"));
        }
        let stick_out = [radius - centre[axis], centre[axis] + radius - length];
        for (face, out) in domain.faces().axis(axis).into_iter().zip(stick_out) {
            let holds = matches!(face, Face::Periodic | Face::FreeSlip);
            if !(holds || out <= 2.0 * radius * MAX_OVERLAP) {
                let problem = format!(
                    "a grain at {} = {si_at:.6e} m sticks {:.3e} m out of the box (0 to \
                     {si_length:.6e} m)",
                    AXES[axis],
                    out * units.si_dx
                );
                let remedy = "move it, or make that face periodic or a mirror (`free_slip`)";
                return Err(Trouble::new(key, problem, remedy));
            }
        }
        let fits = 2.0 * radius <= length * (1.0 + MAX_OVERLAP);
        if domain.is_periodic(axis) && !fits {
            let problem = format!(
                "a grain of diameter {:.4e} m is larger than the periodic box along {} ({si_length:.4e} \
                 m): it overlaps its own image",
                2.0 * radius * units.si_dx,
                AXES[axis]
            );
            return Err(Trouble::new(key, problem, "use a larger box or a smaller grain"));
        }
    }
    Ok(())
}

/// Errors if two grains overlap by more than [`MAX_OVERLAP`].
pub(super) fn apart(domain: &Domain, grains: &[Listed], units: &Units) -> Result<(), Trouble> {
    let ball = |(number, listed): (usize, &Listed)| (number, listed.centre, listed.radius);
    let mut balls: Vec<(usize, Vec3, f64)> = grains.iter().enumerate().map(ball).collect();
    balls.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
    let reach = 2.0 * balls.iter().map(|ball| ball.2).fold(0.0, f64::max);
    let (n, length) = (balls.len(), domain.cells()[0] as f64);
    for i in 0..n {
        // Along x as far as any grain can reach, and around the end of a periodic box.
        for k in 1..n {
            let j = (i + k) % n;
            let wraps = i + k >= n;
            let ahead = balls[j].1.x - balls[i].1.x + if wraps { length } else { 0.0 };
            if ahead > reach || (wraps && !domain.is_periodic(0)) {
                break;
            }
            let (a, b) = (&balls[i], &balls[j]);
            let overlap = a.2 + b.2 - distance(domain, &a.1, &b.1);
            let is_small = overlap <= MAX_OVERLAP * 2.0 * a.2.min(b.2);
            if !is_small {
                let (first, second) = (a.0.min(b.0), a.0.max(b.0));
                let problem = format!(
                    "{} and {} overlap by {:.3e} m; {:.0} % of the smaller diameter is the limit",
                    grains[first].name(first),
                    grains[second].name(second),
                    overlap * units.si_dx,
                    100.0 * MAX_OVERLAP
                );
                let remedy = "move them apart or make them smaller";
                return Err(Trouble::new(&grains[second].key, problem, remedy));
            }
        }
    }
    Ok(())
}

/// Distance between two places, to the nearest image along periodic axes.
fn distance(domain: &Domain, a: &Vec3, b: &Vec3) -> f64 {
    let mut between = b - a;
    for axis in (0..3).filter(|&axis| domain.is_periodic(axis)) {
        let length = domain.cells()[axis] as f64;
        between[axis] -= length * (between[axis] / length).round();
    }
    between.norm()
}
