//! How figures show what the engines found: the oracle's points filled, the kernel's as wide circles round
//! them, because the two nearly always lie on each other.

use psmrt_report::{Marker, Series, Style};

use psmrt::engine::EngineName;

/// The palette's black.
const BLACK: usize = 6;

/// Points that `engine` found; `kind` says which of several, and may be empty. `colour` is that of the
/// oracle's; by its order where `None`.
pub fn found(kind: &str, engine: &str, points: Vec<(f64, f64)>, colour: Option<usize>) -> Series {
    if engine == EngineName::Reference.word() {
        let label = if kind.is_empty() { engine.to_owned() } else { format!("{kind}, {engine}") };
        return Series { colour, ..Series::points(label, points) };
    }
    let label = format!("{engine}, each");
    Series::new(label, Style::Points(Some(Marker::Halo)), points).with_colour(BLACK)
}
