//! All that two bodies exert on each other: contact, and lubrication if there is any.

use crate::grains::contact::{ContactMemory, Geometry, Motion, PairForce, Relative, contact_force};
use crate::grains::grain::Grain;
use crate::grains::law::ContactLaw;
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
    let contact = contact_force(&setup.law, &geometry, [&middle, &end], dt, memory);
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
    let law: &ContactLaw = &plane.law;
    let contact = contact_force(law, &geometry, [&middle, &end], dt, memory);
    let drag = setup.lubrication.map(|law| law.at_plane(-geometry.overlap, grain.radius));
    with_lubrication(contact, drag, &geometry.normal, &end)
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
