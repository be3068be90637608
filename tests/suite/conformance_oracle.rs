//! The conformance kit and its judge, tried on the oracle itself: as it is, rounded to lower
//! precision, in another order of directions, and with each mistake of the catalogue.

use crate::common::Budget;
use crate::conformance::{judged, kit};
use psmrt::conformance::judge::judge_submission;
use psmrt::conformance::judged::{Judged, LIMIT, Submission};
use psmrt::conformance::kit::Kit;
use psmrt::conformance::mistakes::CATALOGUE;
use psmrt::conformance::model::Model;
use psmrt::conformance::reference::Oracle;
use psmrt::conformance::task::{Collisions, Scene, SceneOutcome, States, Streaming, Task};
use psmrt::conformance::{Answers, Candidate, DirectionOrder, Outcome, Precision, judge};
use psmrt_reference::directions::{C, Q};
use psmrt_reference::lattice::Populations;
use psmrt_reference::solver::Solver;

/// Cell updates of the oracle in all scenes of the kit.
fn cell_updates(kit: &Kit) -> u64 {
    let updates =
        |task: &Task| if let Task::Scene(scene) = task { scene.cell_updates() } else { 0 };
    kit.problems.iter().map(|solved| updates(&solved.problem.task)).sum()
}

#[test]
fn oracle_passes_its_own_kit_without_any_error() {
    // The kit's scenes take 21,800 cell updates: once for all tests, once more and answered here, and each time
    // that the tests of its files let psmrt make it.
    Budget::oracle(660_000).spend(30 * cell_updates(kit()));
    let verdict = judge(&mut Oracle).unwrap();
    assert!(verdict.passed(), "{verdict}");
    assert_eq!(verdict.attempted(), verdict.judged.len());
    assert!(verdict.largest_error() == 0.0 && verdict.diagnosis.is_none());
}

#[test]
fn model_of_the_diagnosis_agrees_with_the_oracle() {
    let kit = kit();
    let model = Model::right();
    for solved in &kit.problems {
        let found = model.answer(&solved.problem).values;
        for expected in &solved.expected {
            let found = found.get(expected.spec.name).unwrap();
            let values = found.values.iter().zip(&expected.values.values);
            for ((found, right), gauge) in values.zip(&expected.gauges.values) {
                // Two orders of evaluation in double precision; 1.9 was measured, and the oracle's
                // scenes of 150 steps stay below 0.5.
                let bound = 4.0 * f64::EPSILON * gauge;
                let place = (solved.problem.id, expected.spec.name);
                assert!((found - right).abs() <= bound, "{place:?}: {found} {right}");
            }
        }
    }
}

/// The oracle with everything that it is given, keeps from step to step and answers rounded.
struct Rounded(Precision);

impl Rounded {
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is asked")]
    fn round(&self, value: f64) -> f64 {
        match self.0 {
            Precision::F64 => value,
            Precision::F32 => f64::from(value as f32),
            Precision::F16Storage => {
                // Eleven significant bits.
                let unit =
                    2.0_f64.powi(value.abs().max(2.0_f64.powi(-14)).log2().floor() as i32 - 10);
                (value / unit).round() * unit
            }
        }
    }

    fn cells(&self, cells: &[Populations]) -> Vec<Populations> {
        cells.iter().map(|f| f.map(|f| self.round(f))).collect()
    }

    fn answers(&self, answers: Option<Answers>) -> Option<Answers> {
        let Answers(mut answers) = answers?;
        answers.values_mut().flat_map(|array| &mut array.values).for_each(|v| *v = self.round(*v));
        Some(Answers(answers))
    }
}

impl Candidate for Rounded {
    fn name(&self) -> String {
        format!("the oracle rounded to {}", self.0.name())
    }

    fn precision(&self) -> Precision {
        self.0
    }

    fn moments(&mut self, problem: &States) -> Option<Answers> {
        let at = problem
            .at
            .iter()
            .map(|(rho, u)| (self.round(*rho), u.map(|u| self.round(u))))
            .collect();
        self.answers(Oracle.moments(&States { f: self.cells(&problem.f), at }))
    }

    fn collisions(&mut self, problem: &Collisions) -> Option<Answers> {
        let mut problem = problem.clone();
        problem.cells.iter_mut().for_each(|cell| cell.f = cell.f.map(|f| self.round(f)));
        self.answers(Oracle.collisions(&problem))
    }

    fn streaming(&mut self, problem: &Streaming) -> Option<Answers> {
        let post = self.cells(&problem.post);
        self.answers(Oracle.streaming(&Streaming { post, ..problem.clone() }))
    }

    fn scene(&mut self, problem: &Scene) -> Option<SceneOutcome> {
        let start = self.cells(&problem.populations);
        let mut solver = Solver::from_populations(problem.setup.clone(), start).ok()?;
        for _ in 0..problem.steps {
            solver.step().ok()?;
            let (setup, memory) = (solver.setup().clone(), solver.memory());
            let f = self.cells(solver.populations());
            solver = Solver::going_on_from(setup, f, memory).ok()?;
        }
        Some(SceneOutcome {
            populations: Some(solver.populations().to_vec()),
            velocity: Some(solver.velocity_field()),
            loads: Some(solver.loads().to_vec()),
        })
    }
}

#[test]
fn oracle_rounded_to_single_and_half_precision_passes_by_these_and_fails_by_a_higher() {
    let mut budget = Budget::oracle(200_000);
    let kit = kit();
    for precision in [Precision::F64, Precision::F32, Precision::F16Storage] {
        let verdict = judged(&mut Rounded(precision));
        budget.spend(2 * cell_updates(kit));
        assert!(verdict.passed(), "{verdict}");
        // What an honest candidate needs of the limit of 8.
        assert!(verdict.largest_error() < 3.0, "{verdict}");
        let stages = |wanted: fn(&Judged) -> bool| {
            verdict.judged.iter().filter(|judged| wanted(judged)).count()
        };
        // Stages 0, 3, 6 and one problem of 8 were left out: not attempted, not failed.
        assert_eq!(stages(|judged| judged.outcome == Outcome::NotAttempted), 6 + 3 + 8 + 3);
    }
    let mut too_proud = Submission::of(kit, &mut Rounded(Precision::F32));
    too_proud.precision = Precision::F64;
    let verdict = judge_submission(kit, &too_proud);
    assert!(!verdict.passed());
    let diagnosis = verdict.diagnosis.unwrap();
    assert_eq!(diagnosis.named(), None);
    // It says at least where it looks.
    assert!(
        !diagnosis.places.is_empty() && diagnosis.places.iter().all(|p| !p.findings.is_empty())
    );
}

/// The oracle for those who number the directions from the last to the first.
struct Backwards;

impl Backwards {
    fn turn(answers: Option<Answers>) -> Option<Answers> {
        let Answers(mut answers) = answers?;
        for (name, array) in &mut answers {
            if matches!(name.as_str(), "post" | "populations") {
                array.values.chunks_exact_mut(Q).for_each(<[f64]>::reverse);
            }
        }
        Some(Answers(answers))
    }
}

impl Candidate for Backwards {
    fn name(&self) -> String {
        "backwards".to_owned()
    }

    fn order(&self) -> DirectionOrder {
        let mut directions = C;
        directions.reverse();
        DirectionOrder::new(&directions).unwrap()
    }

    fn constants(&mut self, problem: &psmrt::conformance::task::Constants) -> Option<Answers> {
        let Answers(mut answers) = Oracle.constants(problem)?;
        for (name, array) in &mut answers {
            match name.as_str() {
                "weights" => array.values.reverse(),
                "directions" => {
                    array.values = C.iter().rev().flatten().map(|&c| f64::from(c)).collect();
                }
                // Number k of the kit is number 18 - k here.
                "opposites" => {
                    array.values.reverse();
                    array.values.iter_mut().for_each(|a| *a = 18.0 - *a);
                }
                "moment_matrix" => array.values.chunks_exact_mut(Q).for_each(<[f64]>::reverse),
                _ => {}
            }
        }
        Some(Answers(answers))
    }

    fn collisions(&mut self, problem: &Collisions) -> Option<Answers> {
        Self::turn(Oracle.collisions(problem))
    }

    fn streaming(&mut self, problem: &Streaming) -> Option<Answers> {
        Self::turn(Oracle.streaming(problem))
    }
}

#[test]
fn any_order_of_directions_is_sorted_by_the_judge() {
    let verdict = judged(&mut Backwards);
    assert!(verdict.passed() && verdict.largest_error() == 0.0, "{verdict}");
    assert_eq!(verdict.attempted(), 6 + 24 + 7);
}

#[test]
fn every_mistake_shows_and_is_named_when_the_model_makes_it() {
    let kit = kit();
    for entry in &CATALOGUE {
        let model = Model::mistaken(entry.mistake, &DirectionOrder::default());
        let mut submission = Submission::gather(kit, |problem| Some(model.answer(problem).values));
        submission.precision = Precision::F32;
        let verdict = judge_submission(kit, &submission);
        // Also in single precision a mistake stands out: its largest error is beyond the limit.
        assert!(!verdict.passed() && verdict.largest_error() > LIMIT, "{verdict}");
        let diagnosis = verdict.diagnosis.as_ref().unwrap();
        assert_eq!(diagnosis.named(), Some(entry.mistake), "{verdict}");
        assert_eq!(diagnosis.single.len(), 1, "{verdict}");
    }
}

#[test]
fn each_mistake_has_a_name_of_its_own() {
    assert!(CATALOGUE.len() >= 25);
    for entry in &CATALOGUE {
        let of_that_name = CATALOGUE.iter().filter(|other| other.name == entry.name).count();
        assert_eq!(of_that_name, 1, "{}", entry.name);
    }
}

#[test]
fn two_mistakes_at_once_are_explained_problem_by_problem() {
    let kit = kit();
    let mistakes = ["force_sign", "wall_on_node"].map(|name| {
        let entry = CATALOGUE.iter().find(|entry| entry.name == name).unwrap();
        Model::mistaken(entry.mistake, &DirectionOrder::default())
    });
    let submission = Submission::gather(kit, |problem| {
        let model = if problem.stage == 4 { &mistakes[1] } else { &mistakes[0] };
        Some(model.answer(problem).values)
    });
    let diagnosis = judge_submission(kit, &submission).diagnosis.unwrap();
    assert!(diagnosis.single.is_empty());
    let of = |id: &str| {
        let (_, mistakes) =
            diagnosis.by_problem.iter().find(|(problem, _)| *problem == id).unwrap();
        mistakes.iter().map(|mistake| mistake.entry().name).collect::<Vec<_>>()
    };
    assert_eq!(of("walls"), ["wall_on_node"]);
    assert_eq!(of("ps_mrt"), ["force_sign"]);
}

/// The findings on one answer of the oracle after `spoil` has changed its values.
fn findings(problem: &str, answer: &str, spoil: impl Fn(&mut [f64])) -> String {
    let kit = kit();
    let submission = Submission::gather(kit, |asked| {
        let solved = kit.problems.iter().find(|solved| solved.problem.id == asked.id)?;
        let expected = solved.expected.iter().find(|expected| expected.spec.name == answer)?;
        let mut array = expected.values.clone();
        spoil(&mut array.values);
        (asked.id == problem).then(|| Answers::new().with(answer, array))
    });
    let diagnosis = judge_submission(kit, &submission).diagnosis.unwrap();
    assert!(diagnosis.single.is_empty(), "{diagnosis}");
    assert_eq!((diagnosis.places.len(), diagnosis.places[0].problem), (1, problem));
    diagnosis.places[0].findings.join("; ")
}

#[test]
fn error_that_no_mistake_explains_is_placed_in_moments_directions_and_cells() {
    // The direction -x of the first cell.
    let direction = findings("srt", "post", |f| f[2] *= 1.001);
    for words in ["1 of 152 values", "only at cell 0", "only at direction 2 (-1+0+0)"] {
        assert!(direction.contains(words), "{direction}");
    }
    // The moment q_x of all cells, whose row of M has the squared length 40.
    let matrix = psmrt_reference::moments::moment_matrix();
    let moment = findings("mrt", "post", |f| {
        f.iter_mut().enumerate().for_each(|(i, f)| *f += 1e-3 * matrix[(4, i % Q)] / 40.0);
    });
    assert!(moment.contains("in the moments qx; mass and momentum are right"), "{moment}");
    // Cells 0 and 1 are bare and full: in the kit's PS problems the rest has solid in it.
    let solid = findings("ps_srt", "post", |f| f[Q..].iter_mut().for_each(|f| *f += 1e-3));
    assert!(solid.contains("only in cells with solid in them"), "{solid}");
    // 4 x 3 x 5 cells with walls across y: y = 1 is the only row not beside them.
    let faces = findings("walls", "populations", |f| {
        let row = |cell: usize| cell / 4 % 3;
        f.iter_mut().enumerate().filter(|(i, _)| row(i / Q) != 1).for_each(|(_, f)| *f += 1e-3);
    });
    assert!(faces.contains("only in cells beside faces that are not periodic"), "{faces}");
    assert!(faces.contains("only at y 0, 2"), "{faces}");
    let factor = findings("sphere_at_rest", "force", |f| f.iter_mut().for_each(|f| *f *= 0.7));
    assert!(factor.contains("all values are 0.700000 times what they should be"), "{factor}");
}

#[test]
fn wrong_shapes_and_names_from_an_engine_are_a_verdict_with_its_reason() {
    struct Careless;
    impl Candidate for Careless {
        fn name(&self) -> String {
            "careless".to_owned()
        }
        fn weights(&mut self, _: &psmrt::conformance::task::SolidCells) -> Option<Answers> {
            let array = psmrt::conformance::Array::number(1.0);
            Some(Answers::new().with("weight", array.clone()).with("wieght", array))
        }
    }
    let verdict = judged(&mut Careless);
    assert!(!verdict.passed() && verdict.diagnosis.is_none());
    assert_eq!(verdict.unasked, ["weights/wieght"]);
    let text = verdict.to_string();
    assert!(text.contains("weights/weight: its shape is [], asked is [25] (cell)"), "{text}");
    struct Silent;
    impl Candidate for Silent {
        fn name(&self) -> String {
            "silent".to_owned()
        }
    }
    // Nothing attempted is nothing passed.
    assert!(!judged(&mut Silent).passed());
}

#[test]
fn model_of_the_diagnosis_shares_no_arithmetic_with_the_reference() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/conformance/model");
    let mut files = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        // Modules of the reference that compute what the model computes for itself.
        for module in [
            "equilibrium",
            "forcing",
            "boundary",
            "streaming",
            "solver",
            "cell_collision",
            "grains",
        ] {
            let mention = format!("psmrt_reference::{module}");
            assert!(!text.contains(&mention), "{} uses {mention}", path.display());
        }
        for name in
            ["CollisionOperator", "share_weight", "OPPOSITE", "velocity_at(&arm)", "lattice::W"]
        {
            assert!(!text.contains(name), "{} uses {name}", path.display());
        }
        files += 1;
    }
    assert_eq!(files, 7);
}
