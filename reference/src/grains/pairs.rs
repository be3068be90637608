//! The list of pairs: what each remembers, its force, and how the forces are gathered.
//!
//! As in Nishiura & Sakaguchi (J. Comput. Phys. 230, 1923 (2011)): the force of each pair is computed
//! once and on its own, in parallel; then each grain, in parallel, gathers the forces of its pairs in
//! the order of the list. No sum depends on the number of threads.

use crate::grains::contact::{ContactMemory, PairForce};
use crate::grains::grain::Grain;
use crate::grains::neighbours::{Candidate, candidates};
use crate::grains::parallel::for_each;
use crate::grains::setup::PeriodicBox;
use crate::lattice::Vec3;
use crate::solids::Load;

/// What a touching pair remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairContact {
    /// The two grains.
    pub pair: Candidate,
    /// Its springs and normal.
    pub memory: ContactMemory,
}

/// A candidate with what it remembers and the force of the present sub-step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The two grains.
    pub candidate: Candidate,
    /// Springs and normal, while they touch.
    pub memory: Option<ContactMemory>,
    /// Force and torques, while there are any.
    pub force: Option<PairForce>,
}

/// The pairs that may touch until some grain has moved by half the reach of the list.
#[derive(Clone, Debug)]
pub struct PairList {
    pairs: Vec<Pair>,
    /// The pairs of grain `g` are `of_grain[starts[g]..starts[g + 1]]`, in the order of the list.
    starts: Vec<usize>,
    of_grain: Vec<usize>,
    built_at: Vec<Vec3>,
    /// Distance that a grain may move before the list must be made anew, length.
    allowance: f64,
    builds: u64,
}

impl PairList {
    /// A list of the pairs closer than `range + skin`, good for finding all that are closer than
    /// `range` until a grain has moved by `skin/2`. `memories` are what touching pairs remember,
    /// sorted by candidate.
    pub fn new(
        grains: &[Grain],
        sides: &PeriodicBox,
        [range, skin]: [f64; 2],
        memories: &[PairContact],
    ) -> Self {
        let candidates = candidates(grains, sides, range + skin);
        let mut old = memories.iter().peekable();
        let pairs = candidates.into_iter().map(|candidate| {
            // Both lists are sorted: step through them together.
            while old.next_if(|known| known.pair < candidate).is_some() {}
            let memory = old.next_if(|known| known.pair == candidate).map(|known| known.memory);
            Pair { candidate, memory, force: None }
        });
        let pairs: Vec<Pair> = pairs.collect();
        let (starts, of_grain) = pairs_of_grains(&pairs, grains.len());
        let built_at = grains.iter().map(|grain| grain.position).collect();
        PairList { pairs, starts, of_grain, built_at, allowance: 0.5 * skin, builds: 1 }
    }

    /// Whether some grain may have come into reach that the list does not know.
    pub fn is_outdated(&self, grains: &[Grain]) -> bool {
        let allowed = self.allowance * self.allowance;
        let near = |(now, then): (&Grain, &Vec3)| (now.position - then).norm_squared() < allowed;
        // Also outdated if a position is no number.
        !grains.iter().zip(&self.built_at).all(near)
    }

    /// Makes the list anew; what touching pairs remember is kept.
    pub fn rebuild(&mut self, grains: &[Grain], sides: &PeriodicBox, reaches: [f64; 2]) {
        let builds = self.builds + 1;
        *self = PairList::new(grains, sides, reaches, &self.memories());
        self.builds = builds;
    }

    /// Computes the force of each pair with `force`, which also moves what the pair remembers.
    pub fn compute_forces(
        &mut self,
        force: impl Fn(&Candidate, &mut Option<ContactMemory>) -> Option<PairForce> + Sync,
    ) {
        for_each(&mut self.pairs, |_, pair| {
            pair.force = force(&pair.candidate, &mut pair.memory);
        });
    }

    /// Sum of what the pairs of `grain` exert on it.
    pub fn gather(&self, grain: usize) -> Load {
        let mut load = Load::default();
        for &number in &self.of_grain[self.starts[grain]..self.starts[grain + 1]] {
            let pair = &self.pairs[number];
            let Some(PairForce { force, torques }) = pair.force else { continue };
            if pair.candidate.first as usize == grain {
                load.force += force;
                load.torque += torques[0];
            } else {
                load.force -= force;
                load.torque += torques[1];
            }
        }
        load
    }

    /// The pairs, sorted.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// What the touching pairs remember, sorted.
    pub fn memories(&self) -> Vec<PairContact> {
        let touching =
            |pair: &Pair| pair.memory.map(|memory| PairContact { pair: pair.candidate, memory });
        self.pairs.iter().filter_map(touching).collect()
    }

    /// How often the list has been made.
    pub fn builds(&self) -> u64 {
        self.builds
    }
}

/// For each grain the numbers of its pairs, as `starts` and one long list.
fn pairs_of_grains(pairs: &[Pair], grains: usize) -> (Vec<usize>, Vec<usize>) {
    let ends = |pair: &Pair| [pair.candidate.first as usize, pair.candidate.second as usize];
    let mut starts = vec![0; grains + 1];
    for grain in pairs.iter().flat_map(ends) {
        starts[grain + 1] += 1;
    }
    for grain in 0..grains {
        starts[grain + 1] += starts[grain];
    }
    let mut next = starts.clone();
    let mut of_grain = vec![0; 2 * pairs.len()];
    for (number, pair) in pairs.iter().enumerate() {
        for grain in ends(pair) {
            of_grain[next[grain]] = number;
            next[grain] += 1;
        }
    }
    (starts, of_grain)
}
