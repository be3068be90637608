//! What can go wrong with an adapter, and what to do about it.

use thiserror::Error;

/// A device that cannot be had, or that fails.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum KernelError {
    /// There is no adapter.
    #[error(
        "no adapter: the engine wgpu needs a GPU with a Vulkan, Metal or DX12 driver; install the \
         driver, or Mesa's software Vulkan (Debian and Ubuntu: apt install mesa-vulkan-drivers), or \
         use --engine reference"
    )]
    NoAdapter,
    /// No adapter has this name.
    #[error("adapter = {wanted:?}: there is none of this name; there are {known}")]
    NoSuchAdapter {
        /// The name as given.
        wanted: String,
        /// The names that there are.
        known: String,
    },
    /// The adapter refuses to be used.
    #[error("the adapter {adapter} cannot be used: {reason}; update its driver or name another")]
    Refused {
        /// Its name.
        adapter: String,
        /// Why, in the driver's words.
        reason: String,
    },
    /// The scene needs more than the adapter has.
    #[error(
        "{what} needs {needed} bytes, the adapter {adapter} offers {available}: use a larger dx, a \
         smaller box, another adapter (psmrt info lists them), or --engine reference"
    )]
    TooLarge {
        /// What needs it.
        what: &'static str,
        /// Bytes needed.
        needed: u64,
        /// Bytes that there are.
        available: u64,
        /// Name of the adapter.
        adapter: String,
    },
    /// The scene needs more bindings than the adapter has.
    #[error(
        "the scene needs {needed} storage bindings, the adapter {adapter} offers {available}: use a \
         larger dx, a smaller box, grains that stay where they are, another adapter (psmrt info lists \
         them), or --engine reference"
    )]
    TooManyBindings {
        /// Bindings needed.
        needed: u32,
        /// Bindings that there are.
        available: u32,
        /// Name of the adapter.
        adapter: String,
    },
    /// The device fails at its work.
    #[error(
        "the adapter {adapter} failed: {reason}; the last checkpoint is whole: resume from it, on \
         another adapter if it happens again"
    )]
    Failed {
        /// Its name.
        adapter: String,
        /// Why, in the driver's words.
        reason: String,
    },
}
