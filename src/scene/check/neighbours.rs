//! Whether grains lie inside the domain and apart from each other.

use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;

use super::Trouble;
use super::listed::Listed;
use crate::units::Units;

/// How deep two grains may overlap, in diameters of the smaller, or a grain and a face: contacts in
/// packings from discrete-element codes are not sharp.
pub const MAX_OVERLAP: f64 = 0.01;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Errors if a grain's centre lies outside the domain, or a face that is no mirror cuts through it.
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
                "a grain's centre lies at {} = {si_at:.6e} m, outside the domain (0 to {si_length:.6e} m)",
                AXES[axis]
            );
            return Err(Trouble::new(key, problem, "move it into the domain"));
        }
        let stick_out = [radius - centre[axis], centre[axis] + radius - length];
        for (face, out) in domain.faces().axis(axis).into_iter().zip(stick_out) {
            let holds = matches!(face, Face::Periodic | Face::FreeSlip);
            if !(holds || out <= 2.0 * radius * MAX_OVERLAP) {
                let problem = format!(
                    "a grain at {} = {si_at:.6e} m extends {:.3e} m beyond the domain (0 to \
                     {si_length:.6e} m)",
                    AXES[axis],
                    out * units.si_dx
                );
                let remedy = "move it, or make that face periodic or a mirror plane (`free_slip`)";
                return Err(Trouble::new(key, problem, remedy));
            }
        }
        let fits = 2.0 * radius <= length * (1.0 + MAX_OVERLAP);
        if domain.is_periodic(axis) && !fits {
            let problem = format!(
                "a grain of diameter {:.4e} m is larger than the periodic domain along {} ({si_length:.4e} \
                 m): it overlaps its own image",
                2.0 * radius * units.si_dx,
                AXES[axis]
            );
            return Err(Trouble::new(key, problem, "use a larger domain or a smaller grain"));
        }
    }
    Ok(())
}

/// Errors if two grains overlap by more than [`MAX_OVERLAP`].
///
/// Grains are entered one by one into cells of space, and compared with those that are there already.
/// As long as none overlap, only so many fit about one, small or large: N grains take a time in
/// proportion to N, whatever the shape of the domain.
pub(super) fn apart(domain: &Domain, grains: &[Listed], units: &Units) -> Result<(), Trouble> {
    let mut space = Space::new(domain, grains);
    for (number, grain) in grains.iter().enumerate() {
        for cell in space.touched(&grain.centre, grain.radius) {
            for &other in &space.cells[cell] {
                let between = distance(domain, &grains[other].centre, &grain.centre);
                let (a, b) = (grains[other].radius, grain.radius);
                let overlap = a + b - between;
                // So that what is no number is an overlap too.
                let is_small = overlap <= MAX_OVERLAP * 2.0 * a.min(b);
                if !is_small {
                    let problem = format!(
                        "{} and {} overlap by {:.3e} m; {:.0} % of the smaller diameter is the limit",
                        grains[other].name(other),
                        grain.name(number),
                        overlap * units.si_dx,
                        100.0 * MAX_OVERLAP
                    );
                    let remedy = "move them apart or make them smaller";
                    return Err(Trouble::new(&grain.key, problem, remedy));
                }
            }
            space.cells[cell].push(number);
        }
    }
    Ok(())
}

/// The domain cut into cells about as large as a grain, each with the grains that touch it.
struct Space {
    counts: [usize; 3],
    /// Their sides.
    sides: [f64; 3],
    periodic: [bool; 3],
    cells: Vec<Vec<usize>>,
}

impl Space {
    fn new(domain: &Domain, grains: &[Listed]) -> Self {
        let lengths = domain.cells().map(|cells| cells as f64);
        let mean = grains.iter().map(|g| 2.0 * g.radius).sum::<f64>() / grains.len().max(1) as f64;
        // No more cells than twice the grains, or a few: an empty domain costs nothing.
        let room = lengths.iter().product::<f64>() / (2.0 * grains.len() as f64 + 8.0);
        let side = mean.max(room.cbrt());
        let counts = lengths.map(|length| whole(length / side).max(1));
        Space {
            counts,
            sides: std::array::from_fn(|axis| lengths[axis] / counts[axis] as f64),
            periodic: std::array::from_fn(|axis| domain.is_periodic(axis)),
            cells: vec![Vec::new(); counts.iter().product()],
        }
    }

    /// The cells that the cube around a grain touches, each once.
    fn touched(&self, centre: &Vec3, radius: f64) -> Vec<usize> {
        let [x, y, z] = std::array::from_fn(|axis| self.along(axis, centre[axis], radius));
        let (nx, ny) = (self.counts[0], self.counts[1]);
        let rows = z.iter().flat_map(|z| y.iter().map(move |y| nx * (y + ny * z)));
        rows.flat_map(|row| x.iter().map(move |x| x + row)).collect()
    }

    /// The same along one axis.
    fn along(&self, axis: usize, centre: f64, radius: f64) -> Vec<usize> {
        let n = self.counts[axis];
        let last = n as f64 - 1.0;
        let [low, high] =
            [centre - radius, centre + radius].map(|x| (x / self.sides[axis]).floor());
        if low <= 0.0 && high >= last || high - low >= last {
            (0..n).collect()
        } else if self.periodic[axis] {
            let wrapped = |cell: f64| whole(cell.rem_euclid(n as f64));
            (0..=whole(high - low)).map(|i| wrapped(low + i as f64)).collect()
        } else {
            (whole(low.max(0.0))..=whole(high.min(last))).collect()
        }
    }
}

/// A number without its fraction.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts of cells")]
fn whole(number: f64) -> usize {
    number as usize
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
