//! Contacts of free grains, looked at: their network, and their means.

use std::io;
use std::path::Path;

use psmrt_reference::grains::touching::{Touched, Touching, touching};
use psmrt_reference::lattice::Vec3;

use super::vtk::Array;
use super::wrapped::wrapped;
use super::{atomic, grain_means, vtk};
use crate::engine::Coupled;
use crate::scene::Scene;

/// The components of a symmetric tensor in the order of the columns: xx, yy, zz, xy, xz, yz.
const COMPONENTS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// The values of [`crate::scene::columns::CONTACT_MEAN_COLUMNS`].
pub fn row(scene: &Scene, engine: &Coupled) -> [f64; 15] {
    let mut row = [0.0; 15];
    let Some(system) = engine.free_grains() else { return row };
    let contacts = touching(system);
    let between: Vec<&Touching> =
        contacts.iter().filter(|contact| matches!(contact.other, Touched::Grain(_))).collect();
    let count = between.len() as f64;
    row[0] = count;
    let grains = system.grains().iter().zip(grain_means::contacts_of_each(&system.state()));
    let of_free: Vec<u32> = grains.filter(|(grain, _)| !grain.held).map(|(_, n)| n).collect();
    row[1] = of_free.iter().map(|&n| f64::from(n)).sum::<f64>() / of_free.len().max(1) as f64;
    let push = |contact: &Touching| -contact.force.dot(&contact.normal);
    row[2] = between.iter().map(|contact| push(contact)).sum::<f64>() / count.max(1.0)
        * scene.units.si_force();
    let cells = scene.setup.domain.cell_count() as f64;
    for (number, [i, j]) in COMPONENTS.into_iter().enumerate() {
        // F_ij = 1/N Σ n_i n_j
        let fabric: f64 = between.iter().map(|contact| contact.normal[i] * contact.normal[j]).sum();
        row[3 + number] = fabric / count.max(1.0);
        // σ_ij = -1/V Σ F_i l_j, the mean of it and of its transpose; compression is positive
        let of_contact = |contact: &Touching| {
            -0.5 * (contact.force[i] * contact.branch[j] + contact.force[j] * contact.branch[i])
        };
        let stress: f64 = contacts.iter().map(of_contact).sum();
        row[9 + number] = stress / cells * scene.units.si_pressure();
    }
    row
}

/// Writes the network of contacts as lines between the centres of grains, or from a centre to the face that it touches.
pub(super) fn network(scene: &Scene, engine: &Coupled, path: &Path) -> io::Result<()> {
    let contacts = engine.free_grains().map_or_else(Vec::new, touching);
    let (units, numbers) = (&scene.units, engine.solids_of_grains());
    let places = engine.free_grains().map_or(&[][..], |system| system.grains());
    let domain = &scene.setup.domain;
    let ends = contacts.iter().flat_map(|contact| {
        let start = places[contact.grain].position * units.si_dx;
        let start = Vec3::from(wrapped(domain, start.as_slice(), units.si_dx));
        [start, start + contact.branch * units.si_dx]
    });
    let normal = |contact: &Touching| -contact.force.dot(&contact.normal) * units.si_force();
    let tangential = |contact: &Touching| {
        let along = contact.normal * contact.force.dot(&contact.normal);
        (contact.force - along).norm() * units.si_force()
    };
    // A face has no number.
    let other = |contact: &Touching| match contact.other {
        Touched::Grain(number) => numbers[number] as f64,
        Touched::Plane(_) => -1.0,
    };
    let force = |contact: &Touching| -> [f64; 3] { (contact.force * units.si_force()).into() };
    let arrays = vec![
        Array::new("Points", 3, ends.flat_map(<[f64; 3]>::from)),
        Array::new("grain", 1, contacts.iter().map(|contact| numbers[contact.grain] as f64)),
        Array::new("other grain", 1, contacts.iter().map(other)),
        Array::new("normal force (N)", 1, contacts.iter().map(normal)),
        Array::new("tangential force (N)", 1, contacts.iter().map(tangential)),
        Array::new("force (N)", 3, contacts.iter().flat_map(force)),
    ];
    atomic::write(path, |out| vtk::lines(out, contacts.len(), arrays))
}
