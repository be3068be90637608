//! The manifests of a kit and of a candidate, and their JSON schemas.

use std::collections::BTreeMap;

use psmrt_reference::directions::{C, ORDER};
use psmrt_reference::moments::NAMES;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::KIT_VERSION;
use super::array::Array;
use super::given::inputs;
use super::judged::LIMIT;
use super::kit::{Kit, Solved};
use super::parameters::{kind, parameters};
use super::precision::Precision;
use super::problem::STAGES;

/// Arrays of up to this many values are there as CSV too.
pub(super) const CSV_VALUES: usize = 64;

/// What `format` says in a kit's manifest.
pub(super) const FORMAT: &str = "psmrt-conformance-kit";

/// The manifest of a kit: `manifest.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Manifest {
    /// What this is: `psmrt-conformance-kit`.
    pub format: String,
    /// Version of the kit; any change of a value raises it.
    pub kit_version: u32,
    /// Largest error that passes, in the candidate's epsilon times the gauge.
    pub limit: f64,
    /// Name of the kit's order of directions.
    pub direction_order: String,
    /// The directions in the kit's order, cells/step.
    pub directions: Vec<[i32; 3]>,
    /// Names of the moments, in the order of the rows of M.
    pub moment_names: Vec<String>,
    /// Titles of the stages, by number.
    pub stages: Vec<String>,
    /// What the flags of problems mean.
    pub flags: BTreeMap<String, String>,
    /// The problems.
    pub problems: Vec<ProblemEntry>,
}

/// A problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ProblemEntry {
    /// Its name, unique in the kit; answers go to a folder of this name.
    pub id: String,
    /// Its stage, 0 to 8.
    pub stage: usize,
    /// Its kind: problems of a kind have the same arrays.
    pub kind: String,
    /// What is asked.
    pub title: String,
    /// What to mind.
    pub notes: String,
    /// The equations to look at.
    pub equation: String,
    /// What it exercises.
    pub flags: Vec<String>,
    /// What is given besides arrays.
    pub parameters: Value,
    /// Arrays that are given.
    pub given: Vec<ArrayEntry>,
    /// Arrays that are asked, with the expected values.
    pub asked: Vec<ArrayEntry>,
}

/// An array.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ArrayEntry {
    /// Its name.
    pub name: String,
    /// Its file in the kit, relative to the kit's folder.
    pub file: String,
    /// The same as CSV, for small arrays: one value a line, in C order.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub csv: Option<String>,
    /// The file of the gauges of an asked array.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub gauge: Option<String>,
    /// Lengths of its axes; empty for a single number.
    pub shape: Vec<usize>,
    /// Names of its axes; the judge sorts the axis `direction` by the candidate's order.
    pub axes: Vec<String>,
    /// What it is, with its unit.
    pub what: String,
    /// Its values are numbers of directions.
    #[serde(skip_serializing_if = "std::ops::Not::not", default)]
    pub numbers_directions: bool,
}

/// The manifest of a candidate: `manifest.json` in its folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CandidateManifest {
    /// A name for reports.
    pub name: String,
    /// The precision by which the candidate is judged.
    #[serde(default)]
    pub precision: Precision,
    /// The candidate's order of directions; left out: the kit's.
    #[serde(default)]
    pub directions: Option<Vec<[i32; 3]>>,
    /// Version of the kit that was answered.
    pub kit_version: u32,
}

/// What the flags of problems mean.
const FLAGS: [(&str, &str); 26] = [
    ("body_force", "a body force acts on the fluid"),
    ("corners", "faces of different kinds meet in edges and corners"),
    ("exact_coverage", "needs exact solid fractions of your own; leave it out if you sample"),
    (
        "full_bounce_back",
        "bounce-back of the whole populations about the solid's velocity instead of the paper's Eq. 5",
    ),
    ("formulas", "no code of a solver is needed"),
    ("free_slip", "a free-slip face"),
    ("friction", "contacts with friction"),
    (
        "graded_viscosity",
        "cut cells as fluid of graded viscosity, full cells bounced back, instead of the paper's Eq. 5",
    ),
    ("inlet", "a velocity inlet"),
    ("moving_solid", "a solid that changes cells"),
    ("moving_wall", "a wall that moves in its plane"),
    ("mrt", "multiple relaxation times"),
    ("outflow", "a zero-gradient outflow"),
    ("periodic", "periodic faces only"),
    ("periodic_image", "a solid that crosses a periodic face"),
    ("plane", "contacts with planes"),
    ("pressure", "a face of given pressure"),
    ("rolling", "contacts with rolling resistance"),
    ("shared_cells", "cells with two solids"),
    ("solid", "a solid: the PS term"),
    ("spin", "a solid that spins"),
    ("srt", "single relaxation time"),
    ("steady", "steady at the end to round-off"),
    ("superposition", "the superposition operator instead of the paper's Eq. 5"),
    ("viscosity", "the viscosity is given, not tau"),
    ("wall", "a no-slip wall"),
];

impl Manifest {
    /// The manifest of a kit.
    pub fn new(kit: &Kit) -> Self {
        let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
        Manifest {
            format: FORMAT.to_owned(),
            kit_version: KIT_VERSION,
            limit: LIMIT,
            direction_order: ORDER.to_owned(),
            directions: C.to_vec(),
            moment_names: owned(&NAMES),
            stages: owned(&STAGES),
            flags: FLAGS.iter().map(|&(flag, what)| (flag.to_owned(), what.to_owned())).collect(),
            problems: kit.problems.iter().map(entry).collect(),
        }
    }
}

fn entry(solved: &Solved) -> ProblemEntry {
    let problem = &solved.problem;
    let folder = format!("problems/{}", problem.id);
    let array = |kind: &str, name: &str, array: &Array, axes: &[&str], what: &str| {
        let file = format!("{folder}/{kind}/{name}");
        ArrayEntry {
            name: name.to_owned(),
            file: format!("{file}.npy"),
            csv: (array.values.len() <= CSV_VALUES).then(|| format!("{file}.csv")),
            gauge: (kind == "expected").then(|| format!("{folder}/gauge/{name}.npy")),
            shape: array.shape.clone(),
            axes: axes.iter().map(|&axis| axis.to_owned()).collect(),
            what: what.to_owned(),
            numbers_directions: false,
        }
    };
    let given = inputs(&problem.task);
    ProblemEntry {
        id: problem.id.to_owned(),
        stage: problem.stage,
        kind: kind(&problem.task).to_owned(),
        title: problem.title.to_owned(),
        notes: problem.notes.to_owned(),
        equation: problem.equation.to_owned(),
        flags: problem.flags.iter().map(|&flag| flag.to_owned()).collect(),
        parameters: parameters(&problem.task),
        given: given.iter().map(|i| array("given", i.name, &i.array, &i.axes, i.what)).collect(),
        asked: solved
            .expected
            .iter()
            .map(|expected| {
                let spec = &expected.spec;
                let entry = array("expected", spec.name, &expected.values, &spec.axes, spec.what);
                ArrayEntry { numbers_directions: spec.numbers_directions, ..entry }
            })
            .collect(),
    }
}

/// The JSON schema of a kit's manifest.
pub fn kit_schema() -> Value {
    schemars::schema_for!(Manifest).to_value()
}

/// The JSON schema of a candidate's manifest.
pub fn candidate_schema() -> Value {
    schemars::schema_for!(CandidateManifest).to_value()
}
