//! The names of all that a run makes in its folder. They are known before it starts, and differ.

use super::{Attachment, Record, What};

/// Keys of the faces, `FACE_KEYS[axis][side]`.
pub(crate) const FACE_KEYS: [[&str; 2]; 3] =
    [["x_low", "x_high"], ["y_low", "y_high"], ["z_low", "z_high"]];

/// Lock of a run's folder.
pub const LOCK: &str = "run.lock";

/// Which run a folder belongs to.
pub const ID: &str = "run.id";

/// Copy of the scene.
pub const SCENE: &str = "scene.toml";

/// Folder of the checkpoints.
pub const CHECKPOINTS: &str = "checkpoints";

/// What `psmrt run` says about itself.
pub const FACTS: &str = "run.json";

/// List of the free grains where a run has left them.
pub const GRAINS_AT_END: &str = "grains_at_end.csv";

/// Table and picture of the comparison with an exact solution.
pub const COMPARISON: [&str; 2] = ["comparison.csv", "comparison.svg"];

/// From which run and step a run goes on that did not begin at step 0: it alone has one.
pub const ORIGIN: &str = "origin.json";

/// What makes a file or folder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MadeBy {
    /// Every run.
    Run,
    /// The file of this number among those that the scene names: its copy.
    Copy(usize),
    /// `[compare]`.
    Comparison,
    /// The record of this number.
    Record(usize),
}

/// A file or folder that a run makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// Its name in the folder of the run.
    pub name: String,
    /// Whether it is a folder.
    pub is_folder: bool,
    /// What makes it.
    pub by: MadeBy,
}

/// All files and folders that a run makes in its folder. What lies in the folder of a record is called after
/// the step and cannot meet anything else; whether it is compared with an exact solution and has free grains is given; half-written files have names of their own.
pub fn all(
    records: &[Record],
    copies: &[Attachment],
    (compares, has_free_grains): (bool, bool),
) -> Vec<Made> {
    let file = |by: MadeBy, name: String| Made { name, is_folder: false, by };
    let folder = |by: MadeBy, name: &str| Made { name: name.to_owned(), is_folder: true, by };
    let run = [LOCK, ID, SCENE, FACTS];
    let mut made: Vec<Made> = run.map(|name| file(MadeBy::Run, name.to_owned())).into();
    made.push(folder(MadeBy::Run, CHECKPOINTS));
    if has_free_grains {
        made.push(file(MadeBy::Run, GRAINS_AT_END.to_owned()));
    }
    let numbered = copies.iter().enumerate();
    made.extend(numbered.map(|(number, copy)| file(MadeBy::Copy(number), copy.file_name.clone())));
    if compares {
        made.extend(COMPARISON.map(|name| file(MadeBy::Comparison, name.to_owned())));
    }
    for (number, record) in records.iter().enumerate() {
        let (by, name) = (MadeBy::Record(number), &record.name);
        match record.what {
            What::Walls => made.push(file(by, table(name))),
            What::Box
            | What::Profile { .. }
            | What::Loads
            | What::GrainMeans
            | What::Layers { .. }
            | What::ContactMeans
            | What::Permeability { .. } => {
                made.push(file(by, table(name)));
                made.push(file(by, picture(name)));
            }
            What::Fields { .. } | What::Grains | What::Contacts => {
                made.push(folder(by, name));
                made.push(file(by, series(name)));
            }
            What::Slice { .. } => made.push(folder(by, name)),
        }
    }
    made
}

/// The table of the record of that name.
pub fn table(record: &str) -> String {
    format!("{record}.csv")
}

/// The picture of the table of the record of that name.
pub fn picture(record: &str) -> String {
    format!("{record}.svg")
}

/// The list of the files of the record of that name and their times.
pub fn series(record: &str) -> String {
    format!("{record}.pvd")
}

/// Two that would be the same file, the later one second. Case does not count: on many systems it does not.
pub fn meeting(made: &[Made]) -> Option<[&Made; 2]> {
    made.iter().enumerate().find_map(|(number, later)| {
        let same = |earlier: &&Made| earlier.name.eq_ignore_ascii_case(&later.name);
        Some([made[..number].iter().find(same)?, later])
    })
}
