//! Values that change in time, in lattice units and steps: what they are (`signal.rs`), and which of a scene's values
//! change (`drives.rs`).
//!
//! A value is a function of the step alone, so that a run that goes on from a checkpoint sees the same bits. Step `n`
//! takes the fluid from time `n` to `n + 1`, and each value acts in it at the moment that makes it second-order in time
//! (`psmrt_reference::drive`; `tests/suite/in_time.rs` measures it):
//!
//! | value | in step `n` | why |
//! |---|---|---|
//! | body force | that of `n` | the collision is at `n`; the velocity that is observed has half of it |
//! | velocity and pressure of a face | that of `n + 1/2` | populations pass the face half-way between nodes |
//! | velocity and angular velocity of a prescribed grain | those of `n` | it is in the collision that it acts |
//! | path of a prescribed grain | `x += (u(n) + u(n + 1))/2` | the trapezoidal rule |
//! | weight of free grains | the mean of `n` and `n + 1` | fluid and grains then gain the same, also under a body force of gravity |

mod drives;
mod signal;

pub use drives::{Drives, FaceSignal, Prescribed};
pub use signal::Signal;
