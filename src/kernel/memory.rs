//! Whether a scene fits, before anything is allocated.

use super::device::AdapterFacts;
use super::error::KernelError;
use super::layout::Layout;

/// Errors if the populations cannot fit. A software adapter has the machine's memory; what a graphics
/// card has its driver does not say beforehand: there the allocation itself is what fails, with an
/// error too.
pub(super) fn check(adapter: &AdapterFacts, layout: &Layout) -> Result<(), KernelError> {
    let needed = layout.bytes_of_both();
    match crate::machine::available() {
        Some(left) if adapter.is_software() && needed > left.bytes => Err(KernelError::TooLarge {
            what: "two copies of the populations",
            needed,
            available: left.bytes,
            adapter: adapter.name.clone(),
        }),
        _ => Ok(()),
    }
}
