//! Where prescribed spheres go. They go straight on, whatever acts on them, so what they meet is known before
//! they move, exactly and for every engine.
//!
//! Those whose motion changes in time are followed step by step (`courses/followed.rs`).
//!
//! At periodic faces they come in again on the other side, and `free_outflow` and `pressure` faces are open
//! to them. All other faces and all spheres that are fixed or prescribed too end their way: when one is
//! deeper there than a scene may have it at the start, the run stops. (Free grains give way; whether
//! contacts hold them is looked at in each step: `psmrt_reference::grains::hold`.)

mod followed;

use psmrt_reference::domain::Face;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::neighbours::candidates;
use psmrt_reference::grains::setup::PeriodicBox;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use crate::scene::Scene;
use crate::scene::check::neighbours::MAX_OVERLAP;
use crate::scene::names::FACE_KEYS;
use followed::Followed;

/// The end of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The first step after which the overlap is too deep.
    pub step: u64,
    /// Number of the prescribed sphere.
    pub grain: usize,
    /// What it meets.
    pub obstacle: Obstacle,
}

/// What ends the way of a prescribed sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A face that is not open.
    Face {
        /// Key of the face.
        name: &'static str,
        /// What it is.
        kind: &'static str,
    },
    /// Another sphere that does not give way, by its number.
    Grain(usize),
}

impl Meeting {
    /// What happens, in words.
    pub fn said(&self, scene: &Scene) -> String {
        let Meeting { step, grain, obstacle } = self;
        let obstacle = match obstacle {
            Obstacle::Face { name, kind } => format!("the face {name} ({kind})"),
            Obstacle::Grain(other) => format!("grain {other}, which does not give way"),
        };
        format!(
            "prescribed grain {grain} (counted from 0) runs into {obstacle} and is more than {:.0} % of a diameter \
             deep after step {step} ({:.4e} s)",
            100.0 * MAX_OVERLAP,
            *step as f64 * scene.units.si_dt
        )
    }

    /// What to do about it.
    pub fn remedy(&self, scene: &Scene) -> String {
        let before = self.step.saturating_sub(1);
        let other = match self.obstacle {
            Obstacle::Face { .. } if scene.is_dry => {
                "let it move another way, or make that face periodic"
            }
            Obstacle::Face { .. } => {
                "let it move another way, or make that face periodic or open (`pressure`, `free_outflow`)"
            }
            Obstacle::Grain(_) => "let it move another way, or make the other grain free",
        };
        match before {
            0 => other.to_owned(),
            _ => format!(
                "stop the run before (stop.steps = {before}, stop.time = {:.4e}), {other}",
                0.999 * before as f64 * scene.units.si_dt
            ),
        }
    }
}

/// A prescribed sphere that passes a face.
struct Passage {
    grain: usize,
    axis: usize,
    side: usize,
    step: u64,
}

/// The spheres that are not free, as those that go straight on were at step 0 if they are where `solids` are at step
/// `start`.
fn held(scene: &Scene, start: u64, solids: &[Solid]) -> Vec<(usize, Grain)> {
    let is_free = |number: usize| scene.free.as_ref().is_some_and(|part| part.moves_solid(number));
    let since = start as f64;
    solids
        .iter()
        .enumerate()
        .filter(|&(number, _)| !is_free(number))
        .filter_map(|(number, solid)| match solid.shape {
            Shape::Sphere { radius } => {
                let at_start = solid.centre - since * solid.velocity;
                Some((number, Grain::sphere(at_start, radius, 1.0).moving(solid.velocity)))
            }
            // They stay, and grains pass through them: contacts are those of spheres.
            Shape::Cells { .. } => None,
        })
        .collect()
}

/// Each prescribed sphere that goes straight on at each face that it moves to: when it is too deep in it.
fn passages(scene: &Scene, start: u64, solids: &[Solid]) -> Vec<Passage> {
    let domain = &scene.setup.domain;
    let mut passages = Vec::new();
    let changing = scene.drives.iter().flat_map(|drives| &drives.prescribed);
    let changes = |number: &usize| changing.clone().any(|all| all.solids.contains(number));
    for (number, grain) in held(scene, start, solids) {
        if changes(&number) {
            continue;
        }
        for axis in (0..3).filter(|&axis| !domain.is_periodic(axis)) {
            let speed = grain.velocity[axis];
            if speed == 0.0 {
                continue;
            }
            let length = domain.cells()[axis] as f64;
            let (side, gap) = match speed > 0.0 {
                true => (1, length - grain.position[axis] - grain.radius),
                false => (0, grain.position[axis] - grain.radius),
            };
            // v n > gap + allowed
            let way = gap + 2.0 * grain.radius * MAX_OVERLAP;
            let step = first_step_beyond(way / speed.abs());
            passages.push(Passage { grain: number, axis, side, step });
        }
    }
    passages
}

/// The first step, from 1, after which more than `time` has passed.
fn first_step_beyond(time: f64) -> u64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e18")]
    let step = (time.floor() + 1.0).clamp(1.0, 1e18) as u64;
    step
}

/// Whether a face ends the way of a prescribed sphere, and what it is called then.
fn closed(face: &Face) -> Option<&'static str> {
    match face {
        Face::Wall { .. } => Some("wall"),
        Face::FreeSlip => Some("mirror, free_slip"),
        Face::VelocityInlet { .. } => Some("velocity_inlet"),
        Face::Periodic
        | Face::FreeOutflow
        | Face::Pressure { .. }
        | Face::DevelopedPressure { .. }
        | Face::NonReflectingPressure { .. } => None,
    }
}

/// The solids at the start.
fn at_start(scene: &Scene) -> &[Solid] {
    scene.setup.solid_phase.as_ref().map_or(&[], |phase| &phase.solids)
}

/// Prescribed spheres that go straight on and leave through open faces within the run: number, face, step.
pub fn leavings(scene: &Scene) -> Vec<(usize, &'static str, u64)> {
    let faces = scene.setup.domain.faces();
    let open = |passage: &Passage| closed(&faces.axis(passage.axis)[passage.side]).is_none();
    let all = passages(scene, 0, at_start(scene)).into_iter().filter(open);
    let in_time = all.filter(|passage| passage.step <= scene.stop.steps);
    in_time.map(|p| (p.grain, FACE_KEYS[p.axis][p.side], p.step)).collect()
}

/// Looks ahead along the ways of prescribed spheres.
#[derive(Clone, Debug)]
pub struct Lookout {
    /// The first meeting with a face, if there is one.
    at_face: Option<Meeting>,
    /// The spheres that are not free at step 0, and their numbers.
    grains: Vec<Grain>,
    numbers: Vec<usize>,
    sides: PeriodicBox,
    /// Distance up to which pairs are listed; `None` if no two move against each other.
    reach: Option<f64>,
    /// Steps for which a list is good.
    window: u64,
    /// All meetings of pairs before this step are known.
    known: u64,
    /// The first meeting of a pair, once it is known.
    of_pair: Option<Meeting>,
    /// Instead of all that, where the motion of some changes.
    followed: Option<Followed>,
}

impl Lookout {
    /// A lookout from the start of a scene.
    pub fn from_start(scene: &Scene) -> Self {
        Self::new(scene, 0, at_start(scene))
    }

    /// A lookout from step `start` on, at which the solids are so.
    pub fn new(scene: &Scene, start: u64, solids: &[Solid]) -> Self {
        let domain = &scene.setup.domain;
        let faces = domain.faces();
        let at_face = passages(scene, start, solids).into_iter().filter_map(|passage| {
            let Passage { grain, axis, side, step } = passage;
            let kind = closed(&faces.axis(axis)[side])?;
            let obstacle = Obstacle::Face { name: FACE_KEYS[axis][side], kind };
            Some(Meeting { step, grain, obstacle })
        });
        let at_face = at_face.min_by_key(|meeting| meeting.step);
        let (numbers, grains): (Vec<usize>, Vec<Grain>) =
            held(scene, start, solids).into_iter().unzip();
        let length = |axis: usize| domain.is_periodic(axis).then(|| domain.cells()[axis] as f64);
        let sides = PeriodicBox { lengths: [length(0), length(1), length(2)] };
        let reach = reach(&grains, &sides);
        let fastest = grains.iter().map(|grain| grain.velocity.norm()).fold(0.0, f64::max);
        // Two that come towards each other close the distance in this time.
        let window = reach.map_or(u64::MAX, |reach| {
            first_step_beyond(reach / (2.0 * fastest)).saturating_sub(1).max(1)
        });
        let followed = Followed::new(scene, start, solids);
        let known = start;
        Lookout { at_face, grains, numbers, sides, reach, window, known, of_pair: None, followed }
    }

    /// The first meeting up to `step`, found by looking at `most_work` places of spheres at most.
    pub fn meeting_until(&mut self, step: u64, most_work: u64) -> Option<Meeting> {
        if let Some(followed) = &mut self.followed {
            return followed.meeting_until(step, most_work);
        }
        let mut work = 0;
        while self.of_pair.is_none() && self.known < step && work <= most_work {
            let Some(reach) = self.reach else { break };
            self.look(reach);
            work += self.grains.len() as u64;
        }
        let found = [self.at_face, self.of_pair].into_iter().flatten();
        found.filter(|meeting| meeting.step <= step).min_by_key(|meeting| meeting.step)
    }

    /// Looks for meetings of pairs in the next window.
    fn look(&mut self, reach: f64) {
        let now = self.known as f64;
        let moved =
            |grain: &Grain| Grain { position: grain.position + now * grain.velocity, ..*grain };
        let grains: Vec<Grain> = self.grains.iter().map(moved).collect();
        let end = self.known.saturating_add(self.window);
        let meet = |pair: psmrt_reference::grains::neighbours::Candidate| {
            let (first, second) = (pair.first as usize, pair.second as usize);
            let (one, two) = (&grains[first], &grains[second]);
            let offset = self.sides.offset(&one.position, &two.position, pair.image);
            let allowed = 2.0 * one.radius.min(two.radius) * MAX_OVERLAP;
            let closest = one.radius + two.radius - allowed;
            let time = meeting_time(&offset, &(two.velocity - one.velocity), closest)?;
            let step = self.known.saturating_add(first_step_beyond(time));
            // Of the two, the one that moves.
            let (mover, other) =
                if one.velocity == Vec3::zeros() { (second, first) } else { (first, second) };
            let obstacle = Obstacle::Grain(self.numbers[other]);
            (step <= end).then_some(Meeting { step, grain: self.numbers[mover], obstacle })
        };
        let found = candidates(&grains, &self.sides, reach).into_iter().filter_map(meet);
        self.of_pair = found.min_by_key(|meeting| meeting.step);
        self.known = end;
    }
}

/// How far pairs are listed: as far as the domain leaves room for. `None` if no two spheres move against each
/// other, or one fills the domain.
fn reach(grains: &[Grain], sides: &PeriodicBox) -> Option<f64> {
    let first = grains.first()?;
    if grains.iter().all(|grain| grain.velocity == first.velocity) {
        return None;
    }
    let largest = grains.iter().map(|grain| grain.radius).fold(0.0, f64::max);
    let room = |length: &f64| length - 2.0 * largest;
    let reach = sides.lengths.iter().flatten().map(room).fold(2.0 * largest, f64::min);
    (reach > 0.0).then_some(reach)
}

/// When two that are `offset` apart and move against each other come closer than `closest`, if they do.
fn meeting_time(offset: &Vec3, velocity: &Vec3, closest: f64) -> Option<f64> {
    // |x + v t|² = c²: the smaller root, reached while they approach
    let (a, b) = (velocity.norm_squared(), offset.dot(velocity));
    let c = offset.norm_squared() - closest * closest;
    if b >= 0.0 {
        return None;
    }
    let root = b * b - a * c;
    (root > 0.0).then(|| ((-b - root.sqrt()) / a).max(0.0))
}
