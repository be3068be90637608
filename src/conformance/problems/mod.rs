//! The problems of the kit, in the order of its stages.
//!
//! **Changing any of them, or adding one, changes the kit: raise [`super::KIT_VERSION`].**

mod cells;
mod contacts;
mod observables;
mod solids;
mod streaming;
mod whole;

use super::problem::Problem;

/// A problem that cannot be made: a mistake in this folder.
pub type MakeError = Box<dyn std::error::Error + Send + Sync>;

/// All problems, by stage.
pub fn all() -> Result<Vec<Problem>, MakeError> {
    let mut problems = cells::problems()?;
    problems.extend(solids::problems());
    problems.extend(streaming::problems()?);
    problems.extend(solids::loads()?);
    problems.extend(contacts::problems()?);
    problems.extend(whole::problems()?);
    problems.extend(observables::problems()?);
    Ok(problems)
}
