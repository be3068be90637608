//! Free grains at mirror planes (`free_slip` faces): whole, or cut in halves by the plane.

use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;

use super::Trouble;
use super::grains::GrainList;
use super::neighbours::MAX_OVERLAP;
use crate::scene::format_grains::MotionKind;
use crate::units::Units;

/// A centre that lies this close to a mirror plane, in cells, lies on it.
const ON_PLANE: f64 = 1e-6;

/// Which faces (`[axis][side]`) cut free grains in halves. Puts the centres of these exactly on the
/// plane. Errors if a grain is cut off its middle, would leave the plane, or can be touched there by
/// a grain that is not cut alike (of which the mirror image would be missing). `gravity`: along each axis the largest that
/// it ever is.
pub(super) fn centred(
    domain: &Domain,
    list: &mut GrainList,
    gravity: &Vec3,
    units: &Units,
) -> Result<[[bool; 2]; 3], Trouble> {
    let mut found = [[false; 2]; 3];
    for axis in 0..3 {
        for side in 0..2 {
            if domain.faces().axis(axis)[side] != Face::FreeSlip {
                continue;
            }
            let plane = if side == 0 { 0.0 } else { domain.cells()[axis] as f64 };
            for listed in list.grains.iter_mut().filter(|listed| listed.motion == MotionKind::Free)
            {
                let distance = (listed.centre[axis] - plane).abs();
                let is_clear = listed.radius - distance <= MAX_OVERLAP * listed.radius;
                if distance <= ON_PLANE {
                    listed.centre[axis] = plane;
                    found[axis][side] = true;
                } else if !is_clear {
                    let problem = format!(
                        "a free grain overlaps its own image at the mirror plane {} = {:.4e} m",
                        ["x", "y", "z"][axis],
                        plane * units.si_dx
                    );
                    let remedy = "move it away, or put its centre on the plane: half of it is then \
                                  computed";
                    return Err(listed.trouble(problem, remedy));
                }
            }
            if found[axis][side] {
                alone(list, axis, plane, gravity)?;
            }
        }
    }
    Ok(found)
}

/// Errors unless all grains stay on the plane across `axis` at `plane`.
fn alone(list: &GrainList, axis: usize, plane: f64, gravity: &Vec3) -> Result<(), Trouble> {
    let name = ["x", "y", "z"][axis];
    if gravity[axis] != 0.0 {
        let problem = format!(
            "gravity pulls along {name} at a free grain whose centre lies on a mirror plane across \
             {name}: the image would be pulled the other way"
        );
        let remedy = "set that component to 0, or move the grain off the plane";
        return Err(Trouble::new("gravity.acceleration", problem, remedy));
    }
    for (number, listed) in list.grains.iter().enumerate() {
        let is_on_it = (listed.centre[axis] - plane).abs() <= ON_PLANE;
        if !is_on_it {
            let problem = format!(
                "another grain's centre lies on a mirror plane across {name}, this one's does not: \
                 if they touched, the mirror image of the contact would be missing"
            );
            let remedy = "put all centres on the plane or none";
            return Err(listed.trouble(problem, remedy));
        }
        // The image has the opposite velocity along the normal, and the opposite angular velocity across it.
        let leaves = |(velocity, angular_velocity): &(Vec3, Vec3)| {
            let across = (0..3).any(|other| other != axis && angular_velocity[other] != 0.0);
            velocity[axis] != 0.0 || across
        };
        if list.motions(number).iter().any(leaves) {
            let problem = format!(
                "its centre lies on a mirror plane across {name}: it can neither move along {name} \
                 nor spin about another axis"
            );
            let remedy = "set these components to 0, or move the grain off the plane";
            return Err(listed.trouble(problem, remedy));
        }
    }
    Ok(())
}
