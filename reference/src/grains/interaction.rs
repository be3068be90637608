//! All that two bodies exert on each other: contact, and lubrication if there is any.

use crate::grains::contact::{ContactMemory, Geometry, Motion, PairForce, Relative};
use crate::grains::grain::Grain;
use crate::grains::motion::Course;
use crate::grains::plane::Plane;
use crate::grains::setup::GrainSetup;
use crate::lattice::Vec3;

/// Force between two grains at the end of a sub-step `dt`; the second is the image moved by `image`.
pub fn between_grains(
    setup: &GrainSetup,
    [one, two]: [&Grain; 2],
    [course_one, course_two]: [&Course; 2],
    image: [i32; 3],
    dt: f64,
    memory: &mut Option<ContactMemory>,
) -> Option<PairForce> {
    let offset = setup.sides.offset(&one.position, &two.position, image);
    let radii = [one.radius, two.radius];
    // Most candidates are apart: find that out without a square root.
    let reach = radii[0] + radii[1] + setup.range();
    if offset.norm_squared() >= reach * reach {
        *memory = None;
        return None;
    }
    let geometry = Geometry::of_spheres(&offset, radii);
    let middle = Relative::new(&geometry, [&course_one.middle, &course_two.middle]);
    let end = Relative::new(&geometry, [&course_one.end, &course_two.end]);
    let masses = moving_masses([one, two]);
    let contact = setup.law.force(masses, &geometry, [&middle, &end], dt, memory);
    let drag = setup.lubrication.map(|law| law.between_spheres(-geometry.overlap, radii));
    with_lubrication(contact, drag, &geometry.normal, &end)
}

/// Force between a grain and a plane at the end of a sub-step `dt`.
pub fn with_plane(
    setup: &GrainSetup,
    grain: &Grain,
    course: &Course,
    plane: &Plane,
    dt: f64,
    memory: &mut Option<ContactMemory>,
) -> Option<PairForce> {
    let height = plane.height(&grain.position);
    if height >= grain.radius + setup.range() {
        *memory = None;
        return None;
    }
    let geometry = Geometry::on_plane(height, &plane.normal, grain.radius);
    let motion = Motion { velocity: plane.velocity, angular_velocity: Vec3::zeros() };
    let middle = Relative::new(&geometry, [&course.middle, &motion]);
    let end = Relative::new(&geometry, [&course.end, &motion]);
    let masses = [grain.mass, f64::INFINITY];
    let contact = plane.law.force(masses, &geometry, [&middle, &end], dt, memory);
    let drag = setup.lubrication.map(|law| law.at_plane(-geometry.overlap, grain.radius));
    with_lubrication(contact, drag, &geometry.normal, &end)
}

/// The masses that a contact moves: a grain that is held gives way like an infinite one. (Between two of
/// those nothing moves, and their own masses give a finite force to look at.)
pub fn moving_masses([one, two]: [&Grain; 2]) -> [f64; 2] {
    match (one.held, two.held) {
        (true, false) => [f64::INFINITY, two.mass],
        (false, true) => [one.mass, f64::INFINITY],
        _ => [one.mass, two.mass],
    }
}

/// A contact's force with lubrication added: `drag` (force · time/length) times the speed of approach,
/// along the normal. Unlike a contact it also resists parting.
fn with_lubrication(
    contact: Option<PairForce>,
    drag: Option<f64>,
    normal: &Vec3,
    end: &Relative,
) -> Option<PairForce> {
    let Some(drag) = drag.filter(|&drag| drag > 0.0) else { return contact };
    let PairForce { force, torques } = contact.unwrap_or_default();
    Some(PairForce { force: force - normal * (drag * end.velocity.dot(normal)), torques })
}
