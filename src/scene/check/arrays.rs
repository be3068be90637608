//! Regular arrays of spheres that fill the domain.

use std::f64::consts::PI;

use psmrt_reference::domain::Domain;

use super::Trouble;
use super::listed::Ball;
use super::numbers::{count, needed, positive};
use crate::scene::format_grains::{GrainsSection, LatticeName};
use crate::units::Units;

/// Places in the unit cell, in edges: none lies on the cell's faces.
fn sites(lattice: LatticeName) -> &'static [[f64; 3]] {
    match lattice {
        LatticeName::Sc => &[[0.5, 0.5, 0.5]],
        LatticeName::Bcc => &[[0.25, 0.25, 0.25], [0.75, 0.75, 0.75]],
        LatticeName::Fcc => {
            &[[0.25, 0.25, 0.25], [0.75, 0.75, 0.25], [0.75, 0.25, 0.75], [0.25, 0.75, 0.75]]
        }
    }
}

/// The spheres of an array.
pub(super) fn balls(
    section: &GrainsSection,
    at: &impl Fn(&str) -> String,
    domain: &Domain,
    units: &Units,
) -> Result<Vec<Ball>, Trouble> {
    let remedy = "add `lattice = \"sc\"`, \"bcc\" or \"fcc\"";
    let lattice = needed(&at("lattice"), section.lattice, "an array needs it", remedy)?;
    let counts = unit_cells(section, at, domain)?;
    let si_edge = domain.cells()[0] as f64 * units.si_dx / counts[0] as f64;
    let sites = sites(lattice);
    let si_diameter = match (section.diameter, section.solid_fraction) {
        (Some(si_diameter), None) => {
            positive(&at("diameter"), si_diameter, "m")?;
            si_diameter
        }
        (None, Some(fraction)) => {
            if !(fraction > 0.0 && fraction < 1.0) {
                let problem = "it must lie between 0 and 1 (exclusive)";
                let remedy = "touching spheres have 0.5236 (sc), 0.6802 (bcc), 0.7405 (fcc)";
                return Err(Trouble::new(at("solid_fraction"), problem, remedy));
            }
            // φ = n π d³/6 / edge³
            si_edge * (6.0 * fraction / (PI * sites.len() as f64)).cbrt()
        }
        (Some(_), Some(_)) => {
            let problem = "the array has both `diameter` and `solid_fraction`";
            return Err(Trouble::new(at("solid_fraction"), problem, "give one of them"));
        }
        (None, None) => {
            let problem = "it is missing: an array needs `diameter` (m) or `solid_fraction`";
            return Err(Trouble::new(at("diameter"), problem, "add one of them"));
        }
    };
    let mut balls = Vec::new();
    for z in 0..counts[2] {
        for y in 0..counts[1] {
            for x in 0..counts[0] {
                balls.extend(sites.iter().map(|site| {
                    let corner = [x as f64, y as f64, z as f64];
                    let si_centre = std::array::from_fn(|i| (corner[i] + site[i]) * si_edge);
                    Ball::of(si_centre, si_diameter)
                }));
            }
        }
    }
    Ok(balls)
}

/// Unit cells along each axis; errors unless they are cubes of at least two cells.
fn unit_cells(
    section: &GrainsSection,
    at: &impl Fn(&str) -> String,
    domain: &Domain,
) -> Result<[u64; 3], Trouble> {
    let key = at("counts");
    let mut counts = [1; 3];
    for (slot, given) in counts.iter_mut().zip(section.counts.unwrap_or([1; 3])) {
        *slot = count(&key, given)?;
    }
    let cells = domain.cells();
    let edges: [f64; 3] = std::array::from_fn(|axis| cells[axis] as f64 / counts[axis] as f64);
    if edges.iter().any(|edge| *edge < 2.0) {
        let problem = format!("the unit cells are {edges:?} cells in size; at least 2 are needed");
        return Err(Trouble::new(key, problem, "use fewer unit cells or a smaller `domain.dx`"));
    }
    if edges.iter().all(|edge| (edge - edges[0]).abs() < 1e-9 * edges[0]) {
        return Ok(counts);
    }
    let problem = format!("the unit cells are {edges:?} cells in size; they must be cubes");
    Err(Trouble::new(key, problem, "change `counts` or the domain"))
}
