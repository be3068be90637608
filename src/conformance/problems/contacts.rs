//! Stage 6: forces of single contacts.

use psmrt_reference::grains::contact::{ContactMemory, Motion};
use psmrt_reference::grains::law::{ContactLaw, Friction, Rolling};
use psmrt_reference::lattice::Vec3;

use super::super::problem::Problem;
use super::super::random::Random;
use super::super::task::{Contacts, Task, TouchingPair};
use super::MakeError;

pub(super) fn problems() -> Result<Vec<Problem>, MakeError> {
    let contact = |id, title, flags, plane, friction, rolling, seed| {
        pairs(seed, plane, friction, rolling).map(|pairs| Problem {
            id,
            stage: 6,
            title,
            notes: "One instant: the springs are given and move only where Coulomb's limit is passed. \
                    Any consistent units. Force on the first body; torques on both about their centres.",
            equation: "F_n = max(0, k delta + gamma u.n); F_t = -(k_t xi + gamma_t u_t), |F_t| <= mu F_n; \
                       arms R - delta/2; T = arm n x F",
            flags,
            task: Task::Contacts(Contacts { plane, pairs }),
        })
    };
    Ok(vec![
        contact("contact_smooth", "smooth spheres", &[], false, false, false, 600)?,
        contact(
            "contact_friction",
            "spheres with friction",
            &["friction"],
            false,
            true,
            false,
            601,
        )?,
        contact(
            "contact_rolling",
            "spheres with friction and rolling resistance",
            &["friction", "rolling"],
            false,
            true,
            true,
            602,
        )?,
        contact(
            "contact_plane",
            "spheres on planes",
            &["friction", "plane"],
            true,
            true,
            false,
            603,
        )?,
    ])
}

fn pairs(
    seed: u64,
    plane: bool,
    friction: bool,
    rolling: bool,
) -> Result<Vec<TouchingPair>, MakeError> {
    let mut random = Random(seed);
    let mut pairs = Vec::new();
    for number in 0..8 {
        let radii = [random.between(0.8, 1.2), if plane { 0.0 } else { random.between(0.5, 1.5) }];
        let mut law = ContactLaw::new(random.between(90.0, 110.0), random.between(4.0, 8.0))?;
        law.friction = friction.then_some(Friction {
            coefficient: 0.4,
            stiffness: random.between(25.0, 35.0),
            damping: random.between(1.0, 2.0),
        });
        law.rolling =
            rolling.then_some(Rolling { coefficient: 0.2, stiffness: 40.0, damping: 2.0 });
        let direction = random.vector(1.0).normalize();
        let overlap = 0.05 * (radii[0] + radii[1]);
        let offset = direction * (radii[0] + radii[1] - overlap);
        // The last pair parts so fast that spring and dashpot together would pull.
        let parting = if number == 7 { -3.0 } else { 0.0 };
        // Every second pair is near rest against its springs, so it sticks; the others slip.
        let speed = if number % 2 == 0 { 0.2 } else { 1.5 };
        let velocity = direction * parting + random.vector(speed);
        let still = Motion { velocity: Vec3::zeros(), angular_velocity: Vec3::zeros() };
        let first = Motion { velocity, angular_velocity: random.vector(speed) };
        let second =
            Motion { velocity: random.vector(speed), angular_velocity: random.vector(speed) };
        let mut across = || {
            let vector = random.vector(0.02);
            vector - direction * vector.dot(&direction)
        };
        let (spring, rolling) = (across(), across());
        let springs = ContactMemory { normal: direction, spring, rolling, overlap };
        let motions = [first, if plane { still } else { second }];
        pairs.push(TouchingPair { law, radii, offset, motions, springs });
    }
    Ok(pairs)
}
