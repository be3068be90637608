//! A problem of the kit: what is asked, and what it is about.

use super::task::Task;

/// Names of the stages, by number.
pub const STAGES: [&str; 9] = [
    "constants of the lattice",
    "moments and equilibria",
    "collisions of single cells",
    "solid fractions and weights",
    "streaming and faces",
    "force and torque on spheres",
    "contacts of grains",
    "whole scenes, some steps",
    "observables",
];

/// A problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Unique name, also that of its folder.
    pub id: &'static str,
    /// Stage, 0 to 8.
    pub stage: usize,
    /// What is asked, in a line.
    pub title: &'static str,
    /// What to mind.
    pub notes: &'static str,
    /// The equations to look at.
    pub equation: &'static str,
    /// What it exercises, for those who want to leave something out.
    pub flags: &'static [&'static str],
    /// The question.
    pub task: Task,
}
