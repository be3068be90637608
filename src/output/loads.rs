//! Rows of a record of loads: where each solid is, how it moves, and what acts on it.

use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

use crate::engine::Coupled;
use crate::scene::Scene;

/// The values of the columns of a record of loads, grain by grain.
pub fn load_rows(scene: &Scene, engine: &Coupled) -> Vec<[f64; 20]> {
    rows_of(scene, engine, &engine.loads())
}

/// The same of these loads.
pub(super) fn rows_of(scene: &Scene, engine: &Coupled, loads: &[Load]) -> Vec<[f64; 20]> {
    let units = &scene.units;
    let mut rows = Vec::new();
    let solids = engine.solids();
    // G Σ B_s
    let displaced: Vec<Vec3> = match engine.body_force_of_last_step() {
        Some(g) => engine.displaced().into_iter().map(|volume| volume * g).collect(),
        None => vec![Vec3::zeros(); solids.len()],
    };
    for (number, (solid, load)) in solids.iter().zip(loads).enumerate() {
        let mut row = [0.0; 20];
        row[0] = number as f64;
        row[4] = solid.diameter() * units.si_dx;
        for (first, vector) in [
            (1, solid.centre * units.si_dx),
            (5, solid.velocity * units.si_velocity()),
            (8, solid.angular_velocity * units.si_angular_velocity()),
            (11, load.force * units.si_force()),
            (14, load.torque * units.si_torque()),
            (17, displaced[number] * units.si_force()),
        ] {
            row[first..first + 3].copy_from_slice(vector.as_slice());
        }
        rows.push(row);
    }
    rows
}
