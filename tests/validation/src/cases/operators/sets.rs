//! The tables of the case.

use super::set::Set;
use super::{beds, falls, limits, spinning, stream, towed};

/// All of them, what is cheap first.
pub const SETS: [Set; 7] = [
    spinning::SET,
    towed::SET,
    stream::SET,
    beds::AT_REYNOLDS,
    falls::SET,
    limits::SET,
    beds::CREEPING,
];
