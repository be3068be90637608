//! Grains, planes and domain together: the order of operations in a sub-step.

use crate::grains::contact::{ContactMemory, Motion, PairForce};
use crate::grains::grain::Grain;
use crate::grains::interaction::{between_grains, with_plane};
use crate::grains::motion::{Course, divide, drift, kick};
use crate::grains::neighbours::Candidate;
use crate::grains::pairs::{Pair, PairContact, PairList};
use crate::grains::parallel::for_each;
use crate::grains::plane::Plane;
use crate::grains::setup::{GrainError, GrainSetup};
use crate::lattice::Vec3;
use crate::solids::Load;

/// What a grain that touches a plane remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneContact {
    /// Number of the grain.
    pub grain: usize,
    /// Number of the plane.
    pub plane: usize,
    /// Springs and normal, which points from the grain to the plane.
    pub memory: ContactMemory,
}

/// All that changes in time, for checkpoints: a system that goes on from it gives the same bits as one
/// that was never stopped.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainState {
    /// The grains.
    pub grains: Vec<Grain>,
    /// The planes.
    pub planes: Vec<Plane>,
    /// What touching pairs remember, sorted by pair.
    pub pair_contacts: Vec<PairContact>,
    /// What grains that touch planes remember, sorted by grain and plane.
    pub plane_contacts: Vec<PlaneContact>,
    /// Force and torque of all contacts on each grain at the end of the last sub-step.
    pub contact_loads: Vec<Load>,
}

/// Grains that move, touch each other and touch planes.
#[derive(Clone, Debug)]
pub struct GrainSystem {
    setup: GrainSetup,
    grains: Vec<Grain>,
    planes: Vec<Plane>,
    list: PairList,
    /// Memories and forces of all grains at all planes, those of a grain side by side.
    at_planes: Vec<(Option<ContactMemory>, Option<PairForce>)>,
    contact_loads: Vec<Load>,
    courses: Vec<Course>,
    shortest_time: f64,
}

impl GrainSystem {
    /// Grains and planes at the start, their springs at rest. Errors if they cannot be moved.
    pub fn new(
        setup: GrainSetup,
        grains: Vec<Grain>,
        planes: Vec<Plane>,
    ) -> Result<Self, GrainError> {
        let contact_loads = vec![Load::default(); grains.len()];
        let (pair_contacts, plane_contacts) = (Vec::new(), Vec::new());
        let state = GrainState { grains, planes, pair_contacts, plane_contacts, contact_loads };
        let mut system = Self::resume(setup, state)?;
        system.compute_contacts(0.0);
        Ok(system)
    }

    /// Goes on from a state. Errors if its grains cannot be moved.
    ///
    /// # Panics
    /// If there are not as many loads as grains, or a contact names a grain or plane that is not
    /// there: a mistake in the calling code.
    pub fn resume(setup: GrainSetup, state: GrainState) -> Result<Self, GrainError> {
        let GrainState { grains, planes, pair_contacts, plane_contacts, contact_loads } = state;
        setup.check(&grains, &planes)?;
        assert_eq!(contact_loads.len(), grains.len(), "one load per grain");
        let reaches = [setup.range(), setup.skin(&grains)];
        let list = PairList::new(&grains, &setup.sides, reaches, &pair_contacts);
        let mut at_planes = vec![(None, None); grains.len() * planes.len()];
        for PlaneContact { grain, plane, memory } in plane_contacts {
            at_planes[grain * planes.len() + plane].0 = Some(memory);
        }
        let courses = grains.iter().map(Course::now).collect();
        let shortest_time = setup.shortest_time(&grains, &planes);
        Ok(GrainSystem {
            setup,
            grains,
            planes,
            list,
            at_planes,
            contact_loads,
            courses,
            shortest_time,
        })
    }

    /// All that changes in time.
    pub fn state(&self) -> GrainState {
        GrainState {
            grains: self.grains.clone(),
            planes: self.planes.clone(),
            pair_contacts: self.list.memories(),
            plane_contacts: self.plane_contacts(),
            contact_loads: self.contact_loads.clone(),
        }
    }

    /// A step of length `dt` in as many sub-steps as the set-up asks, under `loads` from outside, one
    /// per grain and constant during the step (empty: none). Returns the number of sub-steps. Errors
    /// if the sub-steps would be too long or the motion breaks down.
    pub fn step(&mut self, dt: f64, loads: &[Load]) -> Result<u32, GrainError> {
        let (count, substep) = divide(dt, self.shortest_time, self.setup.substeps)?;
        for _ in 0..count {
            self.substep(substep, loads)?;
        }
        Ok(count)
    }

    /// One sub-step of a length `dt` that the caller answers for; otherwise as [`Self::step`].
    pub fn substep(&mut self, dt: f64, loads: &[Load]) -> Result<(), GrainError> {
        self.drift(dt, loads); // v → v', x → x + v' dt
        for plane in &mut self.planes {
            plane.point += plane.velocity * dt;
        }
        if self.list.is_outdated(&self.grains) {
            self.look_for_neighbours()?;
        }
        self.compute_contacts(dt); // forces at the new x
        self.kick(dt, loads); // v' → v
        Ok(())
    }

    /// Changes grains and planes by hand (not their number). Springs of pairs that no longer touch
    /// are forgotten. Errors if the changed ones cannot be moved.
    pub fn edit(
        &mut self,
        change: impl FnOnce(&mut [Grain], &mut [Plane]),
    ) -> Result<(), GrainError> {
        change(&mut self.grains, &mut self.planes);
        self.setup.check(&self.grains, &self.planes)?;
        self.shortest_time = self.setup.shortest_time(&self.grains, &self.planes);
        self.look_for_neighbours()?;
        self.courses = self.grains.iter().map(Course::now).collect();
        self.compute_contacts(0.0);
        Ok(())
    }

    /// Each grain's course under the old forces, and its place at the end of the sub-step.
    fn drift(&mut self, dt: f64, loads: &[Load]) {
        let (gravity, contacts, grains) = (self.setup.gravity, &self.contact_loads, &self.grains);
        for_each(&mut self.courses, |number, course| {
            let load = sum(&contacts[number], loads.get(number));
            *course = Course::ahead(&grains[number], &load, &gravity, dt);
        });
        let courses = &self.courses;
        for_each(&mut self.grains, |number, grain| drift(grain, &courses[number], dt));
    }

    /// Each grain's velocity at the end of the sub-step, under the new forces.
    fn kick(&mut self, dt: f64, loads: &[Load]) {
        let (gravity, contacts, courses) = (self.setup.gravity, &self.contact_loads, &self.courses);
        for_each(&mut self.grains, |number, grain| {
            let load = sum(&contacts[number], loads.get(number));
            kick(grain, &courses[number], &load, &gravity, dt);
        });
    }

    /// Makes the list of pairs anew.
    fn look_for_neighbours(&mut self) -> Result<(), GrainError> {
        let broken = |grain: &Grain| !grain.position.iter().all(|x| x.is_finite());
        if let Some(grain) = self.grains.iter().position(broken) {
            let position = self.grains[grain].position.into();
            return Err(GrainError::NotFinite { grain, position });
        }
        let reaches = [self.setup.range(), self.setup.skin(&self.grains)];
        self.list.rebuild(&self.grains, &self.setup.sides, reaches);
        Ok(())
    }

    /// Forces of all contacts at the end of a sub-step `dt`, each on its own; then their sum on each
    /// grain, in the order of the list and of the planes.
    fn compute_contacts(&mut self, dt: f64) {
        let (setup, grains, courses) = (&self.setup, &self.grains, &self.courses);
        let planes = &self.planes;
        self.list.compute_forces(|Candidate { first, second, image }, memory| {
            let (one, two) = (*first as usize, *second as usize);
            let (both, ways) = ([&grains[one], &grains[two]], [&courses[one], &courses[two]]);
            between_grains(setup, both, ways, *image, dt, memory)
        });
        for_each(&mut self.at_planes, |place, (memory, force)| {
            let (grain, plane) = (place / planes.len(), &planes[place % planes.len()]);
            *force = with_plane(setup, &grains[grain], &courses[grain], plane, dt, memory);
        });
        let (list, at_planes) = (&self.list, &self.at_planes);
        for_each(&mut self.contact_loads, |grain, load| {
            *load = list.gather(grain);
            let own = &at_planes[grain * planes.len()..(grain + 1) * planes.len()];
            for PairForce { force, torques } in own.iter().filter_map(|(_, force)| *force) {
                load.force += force;
                load.torque += torques[0];
            }
        });
    }

    /// Gives a held grain another motion from now on; any other keeps its own.
    pub fn prescribe(&mut self, grain: usize, motion: &Motion) {
        if let Some(grain) = self.grains.get_mut(grain).filter(|grain| grain.held) {
            grain.velocity = motion.velocity;
            grain.angular_velocity = motion.angular_velocity;
        }
    }

    /// The grains.
    pub fn grains(&self) -> &[Grain] {
        &self.grains
    }

    /// The planes.
    pub fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// The set-up.
    pub fn setup(&self) -> &GrainSetup {
        &self.setup
    }

    /// The pairs that may touch, sorted, with their forces and memories.
    pub fn pairs(&self) -> &[Pair] {
        self.list.pairs()
    }

    /// What grains that touch planes remember, sorted by grain and plane.
    pub fn plane_contacts(&self) -> Vec<PlaneContact> {
        let remembered = |(place, entry): (usize, &(Option<ContactMemory>, _))| {
            let (grain, plane) = (place / self.planes.len(), place % self.planes.len());
            entry.0.map(|memory| PlaneContact { grain, plane, memory })
        };
        self.at_planes.iter().enumerate().filter_map(remembered).collect()
    }

    /// How often the list of pairs has been made.
    pub fn list_builds(&self) -> u64 {
        self.list.builds()
    }

    /// Force and torque of all contacts on each grain at the end of the last sub-step.
    pub fn contact_loads(&self) -> &[Load] {
        &self.contact_loads
    }

    /// Force of all grains on plane number `plane` at the end of the last sub-step.
    pub fn force_on_plane(&self, plane: usize) -> Vec3 {
        let column = self.at_planes.iter().skip(plane).step_by(self.planes.len().max(1));
        column.filter_map(|(_, force)| *force).fold(Vec3::zeros(), |sum, pair| sum - pair.force)
    }

    /// The shortest time scale that sub-steps must resolve.
    pub fn shortest_time(&self) -> f64 {
        self.shortest_time
    }

    /// Kinetic energy of all grains, mass · length²/time².
    pub fn kinetic_energy(&self) -> f64 {
        self.grains.iter().map(Grain::kinetic_energy).sum()
    }
}

/// Contact load and load from outside together.
fn sum(contact: &Load, outside: Option<&Load>) -> Load {
    let Some(outside) = outside else { return *contact };
    Load { force: contact.force + outside.force, torque: contact.torque + outside.torque }
}
