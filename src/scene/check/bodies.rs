//! Bodies that are no spheres, put into the domain as solids of it.

use nalgebra::UnitQuaternion;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use super::Trouble;
use super::body_forms::{Endless, Form, form};
use super::grains::{GrainList, check_speed, motion};
use super::in_time::Files;
use super::numbers::{absent, finite, needed};
use crate::bodies::mesh::Mesh;
use crate::bodies::moving::MovingBody;
use crate::bodies::pose::Pose;
use crate::bodies::shares::solid_shares;
use crate::in_time::Prescribed;
use crate::scene::format_grains::{GrainsKind, GrainsSection, MotionKind};
use crate::units::Units;

/// How far a body may reach across a periodic face, cells: what rounding of lengths leaves.
const REACHES_OUT: f64 = 1e-6;

/// Directions whose sine or cosine is below this are parallel or at right angles.
const PARALLEL: f64 = 1e-12;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Puts the bodies of all sections behind the other solids of a list; those of them that move. Errors at the first that cannot be.
pub(super) fn add(
    sections: &[GrainsSection],
    list: &mut GrainList,
    files: &mut Files,
    (domain, units): (&Domain, &Units),
) -> Result<Vec<MovingBody>, Trouble> {
    let mut all_moving = Vec::new();
    for (number, section) in sections.iter().enumerate() {
        if section.kind != GrainsKind::Body {
            continue;
        }
        let at = |key: &str| format!("grains[{number}].{key}");
        if section.motion == MotionKind::Free {
            let problem = "only spheres can be free";
            return Err(Trouble::new(at("motion"), problem, "use \"fixed\" or \"prescribed\""));
        }
        absent(&at("density"), section.density.as_ref(), "grains that are free")?;
        let remedy = "add `body = { shape = \"stl\", file = \"stone.stl\", scale = 1e-3 }`";
        let because = "grains of kind `body` need it";
        let body = needed(&at("body"), section.body.as_ref(), because, remedy)?;
        let remedy = "add `centre = [x, y, z]` in m";
        let si_centre = needed(&at("centre"), section.centre, "a body needs it", remedy)?;
        finite(&at("centre"), &si_centre, "m")?;
        let centre = Units::to_lattice(si_centre, units.si_dx);
        let form = form((body, &centre), number, files, (domain, units))?;
        let (velocity, spin) = motion(section, &at, units, files)?;
        let moves = section.motion == MotionKind::Prescribed;
        if moves && form.endless != Endless::No {
            let problem = "a body without end cannot move";
            let remedy = "give it a `length` (a pipe also a `wall`), or make it \"fixed\"";
            return Err(Trouble::new(at("motion"), problem, remedy));
        }
        let fastest = (velocity.largest(Vec3::norm), spin.largest(Vec3::norm));
        let reach = form.mesh.reach(&Vec3::zeros());
        check_speed(&at("spin"), &fastest.0, &fastest.1, reach, units)?;
        let placed = Pose { centre, turn: UnitQuaternion::identity() }.place(&form.mesh);
        crosses_no_period(&at("body"), (&form.endless, &centre), &placed, domain)?;
        let shares = solid_shares(&placed, domain.cells()).map_err(|wrong| {
            let remedy = "join the parts of the surface to one in the program that made it (a boolean union)";
            Trouble::new(at("body"), wrong.to_string(), remedy)
        })?;
        is_there(&at("centre"), &shares, (&form, moves), (domain, units))?;
        let solid = list.grains.len() + list.bodies.len();
        if velocity.varies() || spin.varies() {
            list.prescribed.push(Prescribed {
                solids: solid..solid + 1,
                section: number,
                velocity: velocity.clone(),
                angular_velocity: spin.clone(),
            });
        }
        let shape = Shape::Cells { fractions: shares.into(), place: moves.then_some(0) };
        let (velocity, angular_velocity) = (velocity.at(0.0), spin.at(0.0));
        list.bodies.push(Solid { shape, centre, velocity, angular_velocity });
        list.body_keys.push(at("body"));
        if moves {
            all_moving.push(MovingBody::new(solid, number, form.mesh));
        }
    }
    Ok(all_moving)
}

/// Errors if a body reaches across a periodic face and does not go on beyond it as it comes in on the other side.
fn crosses_no_period(
    key: &str,
    (endless, centre): (&Endless, &Vec3),
    placed: &Mesh,
    domain: &Domain,
) -> Result<(), Trouble> {
    let [low, high] = placed.bounds();
    for axis in (0..3).filter(|&axis| domain.is_periodic(axis)) {
        let mut unit = Vec3::zeros();
        unit[axis] = 1.0;
        let end = domain.cells()[axis] as f64;
        let is_within = |low: f64, high: f64| low >= -REACHES_OUT && high <= end + REACHES_OUT;
        // Whether it is the same a period further on.
        let goes_on = match endless {
            Endless::No => false,
            Endless::Along(along) => along.cross(&unit).norm() < PARALLEL,
            Endless::Across(normal) => normal.dot(&unit).abs() < PARALLEL,
            // All is solid at the faces that the bore does not come to.
            Endless::Around { axis: along, bore } => {
                along.cross(&unit).norm() < PARALLEL
                    || (along.dot(&unit).abs() < PARALLEL
                        && is_within(centre[axis] - bore, centre[axis] + bore))
            }
        };
        if goes_on || is_within(low[axis], high[axis]) {
            continue;
        }
        let problem = format!(
            "it reaches across a periodic face along {}, and would be cut off there",
            AXES[axis]
        );
        let remedy = "make it smaller, move it (`centre`), or take faces that are not periodic";
        return Err(Trouble::new(key, problem, remedy));
    }
    Ok(())
}

/// Errors unless something of it lies in the domain and leaves room for fluid; all of it, if it moves.
fn is_there(
    key: &str,
    shares: &[(usize, f64)],
    (form, moves): (&Form, bool),
    (domain, units): (&Domain, &Units),
) -> Result<(), Trouble> {
    let inside: f64 = shares.iter().map(|(_, share)| share).sum();
    let [x, y, z] = domain.cells().map(|n| n as f64 * units.si_dx);
    if shares.is_empty() {
        let problem =
            format!("nothing of the body lies in the domain ({x:.4e} x {y:.4e} x {z:.4e} m)");
        return Err(Trouble::new(
            key,
            problem,
            "lengths are in metres; move it, or look at `scale` and `origin`",
        ));
    }
    if inside >= domain.cell_count() as f64 * (1.0 - 1e-9) {
        let problem = "the body fills the whole domain, no fluid is left";
        return Err(Trouble::new(
            key,
            problem,
            "lengths are in metres; make it smaller, or turn `normal` round",
        ));
    }
    let volume = form.mesh.volume();
    if moves && inside < volume * (1.0 - 1e-6) {
        let problem = format!(
            "{:.1} % of a body that moves lie outside of the domain ({x:.4e} x {y:.4e} x {z:.4e} m)",
            100.0 * (1.0 - inside / volume)
        );
        return Err(Trouble::new(key, problem, "move it, or make the domain larger"));
    }
    Ok(())
}
