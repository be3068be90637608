//! How fast the engines are, measured side by side.
//!
//! | file | what it does |
//! |---|---|
//! | `work.rs` | what is computed: plain fluid, beds that stay, beds on the move |
//! | `clock.rs` | measures in turns, each time with the bandwidth of the moment |

pub mod clock;
pub mod work;
