//! Prescribed spheres whose motion changes in time: followed step by step, as the run moves them.

use psmrt_reference::domain::Domain;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::neighbours::{Candidate, candidates};
use psmrt_reference::grains::setup::PeriodicBox;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use super::{FACE_KEYS, MAX_OVERLAP, Meeting, Obstacle, closed, first_step_beyond};
use crate::in_time::Prescribed;
use crate::scene::Scene;

/// The spheres that are not free, as they go.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    domain: Domain,
    sides: PeriodicBox,
    /// The spheres where they are after `step` steps, and their numbers.
    spheres: Vec<Grain>,
    numbers: Vec<usize>,
    /// Which motion each has, if it changes.
    changing: Vec<Option<usize>>,
    motions: Vec<Prescribed>,
    step: u64,
    /// The largest speed of any of them at any time.
    fastest: f64,
    /// Pairs that may meet before this step.
    pairs: Vec<Candidate>,
    listed_until: u64,
    met: Option<Meeting>,
}

impl Followed {
    /// Those of a scene from step `start` on, at which the solids are so; `None` if the motion of none changes.
    pub fn new(scene: &Scene, start: u64, solids: &[Solid]) -> Option<Self> {
        let motions = &scene.drives.as_ref()?.prescribed;
        if motions.is_empty() {
            return None;
        }
        let domain = scene.setup.domain.clone();
        let length = |axis: usize| domain.is_periodic(axis).then(|| domain.cells()[axis] as f64);
        let sides = PeriodicBox { lengths: [length(0), length(1), length(2)] };
        let is_free =
            |number: usize| scene.free.as_ref().is_some_and(|part| part.moves_solid(number));
        let (mut spheres, mut numbers, mut changing) = (Vec::new(), Vec::new(), Vec::new());
        for (number, solid) in solids.iter().enumerate().filter(|(number, _)| !is_free(*number)) {
            if let Shape::Sphere { radius } = solid.shape {
                spheres.push(Grain::sphere(solid.centre, radius, 1.0).moving(solid.velocity));
                numbers.push(number);
                changing.push(motions.iter().position(|all| all.solids.contains(&number)));
            }
        }
        let constant = spheres.iter().map(|sphere| sphere.velocity.norm());
        let changed = motions.iter().map(|all| all.velocity.largest(Vec3::norm).norm());
        let fastest = constant.chain(changed).fold(0.0, f64::max);
        let motions = motions.clone();
        let (pairs, listed_until) = (Vec::new(), start);
        let step = start;
        Some(Followed {
            domain,
            sides,
            spheres,
            numbers,
            changing,
            motions,
            step,
            fastest,
            pairs,
            listed_until,
            met: None,
        })
    }

    /// The first meeting up to `step`, found by looking at `most_work` places of spheres at most.
    pub fn meeting_until(&mut self, step: u64, most_work: u64) -> Option<Meeting> {
        let mut work = 0;
        while self.met.is_none() && self.step < step && work <= most_work {
            self.go_on();
            work += self.spheres.len() as u64;
        }
        self.met.filter(|meeting| meeting.step <= step)
    }

    /// Makes a step and looks for what is met.
    fn go_on(&mut self) {
        if self.step >= self.listed_until {
            self.list();
        }
        for (sphere, changing) in self.spheres.iter_mut().zip(&self.changing) {
            if let Some(motion) = changing {
                sphere.velocity = self.motions[*motion].through(self.step).velocity;
            }
            sphere.position += sphere.velocity;
        }
        self.step += 1;
        let at_face = (0..self.spheres.len()).find_map(|sphere| self.at_face(sphere));
        self.met = at_face.or_else(|| self.pairs.iter().find_map(|pair| self.pair(pair)));
    }

    /// Lists the pairs that may meet, and until when these are all.
    fn list(&mut self) {
        let largest = self.spheres.iter().map(|sphere| sphere.radius).fold(0.0, f64::max);
        let room = |length: &f64| length - 2.0 * largest;
        let reach = self.sides.lengths.iter().flatten().map(room).fold(2.0 * largest, f64::min);
        if self.spheres.len() < 2 || reach <= 0.0 {
            self.listed_until = u64::MAX;
            return;
        }
        self.pairs = candidates(&self.spheres, &self.sides, reach);
        // Two that come towards each other close the distance in this time.
        let window = first_step_beyond(reach / (2.0 * self.fastest).max(1e-18)).saturating_sub(1);
        self.listed_until = self.step.saturating_add(window.max(1));
    }

    /// What face a sphere is too deep in, if it is in one.
    fn at_face(&self, sphere: usize) -> Option<Meeting> {
        let Grain { position, velocity, radius, .. } = &self.spheres[sphere];
        for axis in (0..3).filter(|&axis| !self.domain.is_periodic(axis)) {
            let length = self.domain.cells()[axis] as f64;
            let depths = [radius - position[axis], position[axis] + radius - length];
            for (side, depth) in depths.into_iter().enumerate() {
                let outwards = if side == 0 { -velocity[axis] } else { velocity[axis] };
                let face = closed(&self.domain.faces().axis(axis)[side]);
                if let Some(kind) =
                    face.filter(|_| depth > 2.0 * radius * MAX_OVERLAP && outwards > 0.0)
                {
                    let obstacle = Obstacle::Face { name: FACE_KEYS[axis][side], kind };
                    return Some(Meeting {
                        step: self.step,
                        grain: self.numbers[sphere],
                        obstacle,
                    });
                }
            }
        }
        None
    }

    /// Whether the spheres of a pair are too deep in each other.
    fn pair(&self, pair: &Candidate) -> Option<Meeting> {
        let (first, second) = (pair.first as usize, pair.second as usize);
        let (one, two) = (&self.spheres[first], &self.spheres[second]);
        let offset = self.sides.offset(&one.position, &two.position, pair.image);
        let allowed = 2.0 * one.radius.min(two.radius) * MAX_OVERLAP;
        let approach = (two.velocity - one.velocity).dot(&offset);
        if approach >= 0.0 || offset.norm() >= one.radius + two.radius - allowed {
            return None;
        }
        // Of the two, the one that moves.
        let (mover, other) =
            if one.velocity == Vec3::zeros() { (second, first) } else { (first, second) };
        let obstacle = Obstacle::Grain(self.numbers[other]);
        Some(Meeting { step: self.step, grain: self.numbers[mover], obstacle })
    }
}
