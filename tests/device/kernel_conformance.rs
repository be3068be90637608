//! The kernel answers the conformance kit like anyone else's: single cells, spheres, and whole scenes,
//! judged in single precision. Constants and moments are inside its shaders, and grains in contact are not
//! its own: not attempted.

use crate::common::Budget;
use crate::conformance::{judged, kit};
use crate::trials::{self, Claim};
use psmrt::ball::solid_fraction;
use psmrt::conformance::folder::{read, write};
use psmrt::conformance::judge::judge_submission;
use psmrt::conformance::judged::Submission;
use psmrt::conformance::task::{Collisions, Scene, SceneOutcome, Spheres, Streaming, Task};
use psmrt::conformance::{Answers, Array, Candidate, Precision};
use psmrt::kernel::Kernel;
use psmrt_reference::collision::Collision;
use psmrt_reference::coverage::CoverageRule;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::forcing::forced_velocity;
use psmrt_reference::lattice::{Populations, Vec3, W, density, momentum};
use psmrt_reference::partial_saturation::Weighting;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::{Load, Solid};

/// What is claimed here.
pub const CLAIMS: &[Claim] = &[
    ("kernel_passes_the_conformance_kit", kernel_passes_the_conformance_kit),
    ("kernel_that_weighs_by_solid_fraction_is_found_out", wrong_weight_is_found_out),
];

/// The kernel as a candidate; `spoil` may change a set-up before it gets it.
struct KernelCandidate {
    budget: Budget,
    spoil: fn(&mut Setup),
    /// Whether it leaves out what has no solid.
    solids_only: bool,
}

impl KernelCandidate {
    /// Runs a set-up from `start` for `steps` steps, the solids moving as prescribed.
    fn run(
        &mut self,
        mut setup: Setup,
        start: &[Populations],
        steps: u64,
    ) -> (Vec<Populations>, Vec<Load>) {
        (self.spoil)(&mut setup);
        let phase = setup.solid_phase.as_ref();
        let moves = phase.is_some_and(|phase| phase.solids.iter().any(Solid::moves));
        let mut kernel = Kernel::new(&trials::gpu().unwrap(), setup, moves).unwrap();
        kernel.set_populations(start).unwrap();
        for _ in 0..steps {
            self.budget.advance(&mut kernel, 1);
            if moves {
                let mut solids = kernel.setup().solid_phase.as_ref().unwrap().solids.clone();
                solids.iter_mut().for_each(|solid| solid.centre += solid.velocity);
                kernel.place_solids(solids).unwrap();
            }
        }
        let all: Vec<usize> = (0..start.len()).collect();
        (kernel.populations(&all).unwrap(), kernel.loads().unwrap())
    }
}

impl Candidate for KernelCandidate {
    fn name(&self) -> String {
        "psmrt's kernel".to_owned()
    }

    fn precision(&self) -> Precision {
        Precision::F32
    }

    fn collisions(&mut self, problem: &Collisions) -> Option<Answers> {
        if self.solids_only && problem.cells[0].solid.is_none() {
            return None;
        }
        let (mut post, mut forces) = (Vec::new(), Vec::new());
        for cell in &problem.cells {
            // In a periodic box of one cell streaming changes nothing.
            let mut setup =
                Setup::fluid(Domain::new([1, 1, 1], Faces::PERIODIC).unwrap(), cell.collision);
            setup.body_force = cell.body_force;
            setup.solid_phase = cell.solid.map(|(epsilon, velocity)| SolidPhase {
                solids: vec![Solid { velocity, ..Solid::fixed_cells(vec![(0, epsilon)]) }],
                weighting: problem.weighting,
                operator: problem.operator,
                coverage: CoverageRule::Exact,
            });
            let (f, loads) = self.run(setup, &[cell.f], 1);
            post.push(f[0]);
            forces.extend(loads.first().map(|load| load.force));
        }
        let answers = Answers::new().with("post", Array::cells(&post));
        let solid = !forces.is_empty();
        Some(if solid { answers.with("force", Array::vectors(&forces)) } else { answers })
    }

    fn solid_fractions(&mut self, problem: &Spheres) -> Option<Answers> {
        let fraction = |(offset, radius): &(Vec3, f64)| solid_fraction((*offset).into(), *radius);
        let fractions = problem.spheres.iter().map(fraction).collect();
        Some(Answers::new().with("solid_fraction", Array::list(fractions)))
    }

    fn streaming(&mut self, problem: &Streaming) -> Option<Answers> {
        if self.solids_only {
            return None;
        }
        // The kernel keeps populations after their collision, less their weights; looking at them is
        // streaming, with the faces.
        let collision = Collision::Srt { tau: 1.0 };
        let setup = Setup::fluid(problem.domain.clone(), collision);
        let mut kernel = Kernel::new(&trials::gpu().unwrap(), setup, false).unwrap();
        let mut direction = 0;
        let fill = |row: &mut [u8]| {
            // The row after those of the directions is that of the face values: they stay those of the set-up.
            if direction == W.len() {
                return Ok(());
            }
            for (bits, f) in row.chunks_exact_mut(4).zip(&problem.post) {
                #[expect(clippy::cast_possible_truncation, reason = "what the kernel keeps")]
                let kept = (f[direction] - W[direction]) as f32;
                bits.copy_from_slice(&kept.to_ne_bytes());
            }
            direction += 1;
            Ok(())
        };
        kernel.load(true, &[], fill).unwrap();
        let all: Vec<usize> = (0..problem.post.len()).collect();
        let f = kernel.populations(&all).unwrap();
        Some(Answers::new().with("populations", Array::populations(problem.domain.cells(), &f)))
    }

    fn scene(&mut self, problem: &Scene) -> Option<SceneOutcome> {
        let (f, loads) = self.run(problem.setup.clone(), &problem.populations, problem.steps);
        let g = problem.setup.body_force.unwrap_or_default();
        let velocity = f.iter().map(|f| forced_velocity(density(f), &momentum(f), &g)).collect();
        Some(SceneOutcome { populations: Some(f), velocity: Some(velocity), loads: Some(loads) })
    }
}

fn kernel_passes_the_conformance_kit() {
    // Through files, as anyone else's answers come.
    let kit = kit();
    let folder = tempfile::tempdir().unwrap();
    let mut candidate =
        KernelCandidate { budget: Budget::kernel(27_000), spoil: |_| {}, solids_only: false };
    let submission = Submission::of(kit, &mut candidate);
    write(kit, &submission, folder.path()).unwrap();
    let verdict = judge_submission(kit, &read(kit, folder.path()).unwrap());
    println!("{verdict}");
    assert!(verdict.passed(), "{verdict}");
    // Stages 2, 4, 5 and 7 whole, one answer of stage 3, the six of stage 8 that are measured in scenes.
    assert_eq!(verdict.attempted(), 24 + 7 + 1 + 10 + 19 + 6);
    let scenes = kit.problems.iter();
    let scenes = scenes.filter(|solved| matches!(solved.problem.task, Task::Scene(_))).count();
    assert_eq!(scenes, 5 + 9 + 5);
}

fn wrong_weight_is_found_out() {
    let spoil = |setup: &mut Setup| {
        // Graded viscosity has a weight of its own.
        if let Some(phase) = &mut setup.solid_phase
            && phase.weighting == Weighting::NobleTorczynski
        {
            phase.weighting = Weighting::SolidFraction;
        }
    };
    // What has no solid is spoilt by nothing, and each cell and scene is a shader of its own to be translated.
    let verdict =
        judged(&mut KernelCandidate { budget: Budget::kernel(27_000), spoil, solids_only: true });
    let named = verdict.diagnosis.as_ref().and_then(|diagnosis| diagnosis.named());
    assert_eq!(named.map(|mistake| mistake.entry().name), Some("b_is_epsilon"), "{verdict}");
}
