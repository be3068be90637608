//! Places of grains that have left through periodic faces.

use psmrt_reference::domain::Domain;

/// A place (m) moved into the domain along periodic axes.
pub(super) fn wrapped(domain: &Domain, si_place: &[f64], si_dx: f64) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let si_length = domain.cells()[axis] as f64 * si_dx;
        let periods = (si_place[axis] / si_length).floor();
        si_place[axis] - if domain.is_periodic(axis) { periods * si_length } else { 0.0 }
    })
}
