//! The conformance kit: problems for other people's kernels, a verdict and a diagnosis of their answers.
//!
//! | module | what it does |
//! |---|---|
//! | [`problem`], [`task`], [`problems`] | what is asked |
//! | [`spec`], [`given`], [`parameters`] | names and shapes of what is answered and given |
//! | [`candidate`] | what a Rust engine implements to be judged |
//! | [`mod@reference`] | the oracle's answers |
//! | [`model`], [`mistakes`] | a second implementation with gauges, and a switch for each mistake |
//! | [`kit`] | problems, answers and gauges together |
//! | [`mod@judge`], [`diagnosis`], [`residual`], [`report`] | the verdict, its reasons, its text |
//! | [`files`], [`manifest`], [`checksums`] | the kit as files |
//! | [`folder`] | a candidate's answers as files |

pub mod array;
pub mod candidate;
pub mod checksums;
pub mod diagnosis;
pub mod files;
pub mod folder;
pub mod gauged;
pub mod given;
pub mod judge;
pub mod judged;
pub mod kit;
pub mod manifest;
pub mod mistakes;
pub mod model;
pub mod order;
pub mod parameters;
pub mod precision;
pub mod problem;
pub mod problems;
mod random;
pub mod reference;
pub mod report;
pub mod residual;
pub mod spec;
pub mod task;

pub use array::{Answers, Array};
pub use candidate::Candidate;
pub use judge::{Verdict, judge};
pub use judged::Outcome;
pub use order::DirectionOrder;
pub use precision::Precision;

/// Version of the kit. Raise it whenever a value, a name or a shape in the kit changes, and commit the
/// new checksums (`golden/conformance/README.md`); a test holds the two together.
pub const KIT_VERSION: u32 = 3;
