//! Snapshots: all cells, a plane, or all grains, at one time, each in files of its own.

use std::io::{self, Write};
use std::path::Path;

use psmrt_reference::domain::Domain;
use psmrt_reference::solids::Load;

use super::vtk::Array;
use super::{atomic, grain_means, names, npy, vtk};
use crate::engine::{CellState, Engine};
use crate::scene::format_run::FieldFormat;
use crate::scene::{Record, Rhythm, Scene, What};

/// Writes what `record` wants for now into `folder/<its name>/`, and its list of times.
pub fn take(record: &Record, scene: &Scene, engine: &dyn Engine, folder: &Path) -> io::Result<()> {
    let name = &record.name;
    let folder_of_files = folder.join(name);
    let step = engine.steps();
    let suffix = match &record.what {
        What::Grains => {
            grains(scene, engine, &folder_of_files.join(file(name, step, "vtp")))?;
            "vtp"
        }
        What::Slice { normal, at, quantity, si_range } => {
            let path = folder_of_files.join(file(name, step, "svg"));
            let map = super::slice::map(scene, engine, (*normal, *at), *quantity, *si_range);
            let svg = psmrt_report::render_map(&map).map_err(io::Error::other)?;
            return atomic::write(&path, |out| out.write_all(svg.as_bytes()));
        }
        What::Fields { formats } => {
            if formats.contains(&FieldFormat::Npy) {
                arrays(scene, engine, &folder_of_files)?;
            }
            if !formats.contains(&FieldFormat::Vti) {
                return Ok(());
            }
            image(scene, engine, &folder_of_files.join(file(name, step, "vti")))?;
            "vti"
        }
        What::Box | What::Profile { .. } | What::Loads | What::GrainMeans => return Ok(()),
    };
    let times: Vec<u64> = match record.rhythm {
        Rhythm::Every(interval) => (0..=step / interval).map(|i| i * interval).collect(),
        Rhythm::AtEnd => vec![step],
    };
    let entry = |&step: &u64| {
        (scene.units.si_dt * step as f64, format!("{name}/{}", file(name, step, suffix)))
    };
    let entries: Vec<_> = times.iter().map(entry).collect();
    atomic::write(&folder.join(names::series(name)), |out| vtk::series(out, &entries))
}

fn file(name: &str, step: u64, suffix: &str) -> String {
    format!("{name}_{step:012}.{suffix}")
}

/// A value of all cells, x fastest, asked from the engine plane by plane.
fn cells<'a, const N: usize>(
    scene: &Scene,
    engine: &'a dyn Engine,
    value: impl Fn(&CellState) -> [f64; N] + 'a,
) -> impl Iterator<Item = f64> + 'a {
    let [nx, ny, nz] = scene.setup.domain.cells();
    (0..nz).flat_map(move |z| {
        let plane: Vec<usize> = (z * nx * ny..(z + 1) * nx * ny).collect();
        engine.cells(&plane).iter().flat_map(&value).collect::<Vec<f64>>()
    })
}

fn image(scene: &Scene, engine: &dyn Engine, path: &Path) -> io::Result<()> {
    let units = scene.units;
    let mut arrays = vec![
        Array::new("pressure (Pa)", 1, cells(scene, engine, pressure(scene))),
        Array::new("velocity (m/s)", 3, cells(scene, engine, velocity(scene))),
    ];
    if scene.setup.solid_phase.is_some() {
        let values = cells(scene, engine, |cell| [cell.solid_fraction]);
        arrays.push(Array::new("solid fraction", 1, values));
    }
    atomic::write(path, |out| vtk::image(out, scene.setup.domain.cells(), units.si_dx, arrays))
}

fn arrays(scene: &Scene, engine: &dyn Engine, folder: &Path) -> io::Result<()> {
    let [nx, ny, nz] = scene.setup.domain.cells();
    let path = |name: &str| folder.join(file(name, engine.steps(), "npy"));
    atomic::write(&path("pressure"), |out| {
        npy::array(out, &[nz, ny, nx], cells(scene, engine, pressure(scene)))
    })?;
    atomic::write(&path("velocity"), |out| {
        npy::array(out, &[nz, ny, nx, 3], cells(scene, engine, velocity(scene)))
    })?;
    if scene.setup.solid_phase.is_none() {
        return Ok(());
    }
    atomic::write(&path("solid_fraction"), |out| {
        npy::array(out, &[nz, ny, nx], cells(scene, engine, |cell| [cell.solid_fraction]))
    })
}

fn pressure(scene: &Scene) -> impl Fn(&CellState) -> [f64; 1] + use<> {
    let units = scene.units;
    move |cell| [units.si_gauge_pressure(cell.density)]
}

fn velocity(scene: &Scene) -> impl Fn(&CellState) -> [f64; 3] + use<> {
    let si_unit = scene.units.si_velocity();
    move |cell| (cell.velocity * si_unit).into()
}

/// A place (m) moved into the domain along periodic axes.
fn wrapped(domain: &Domain, si_place: &[f64], si_dx: f64) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let si_length = domain.cells()[axis] as f64 * si_dx;
        let periods = (si_place[axis] / si_length).floor();
        si_place[axis] - if domain.is_periodic(axis) { periods * si_length } else { 0.0 }
    })
}

fn grains(scene: &Scene, engine: &dyn Engine, path: &Path) -> io::Result<()> {
    let rows = super::records::load_rows(scene, engine);
    let domain = &scene.setup.domain;
    let places = rows.iter().flat_map(|row| wrapped(domain, &row[1..4], scene.units.si_dx));
    let columns = |range: std::ops::Range<usize>| {
        rows.iter().flat_map(move |row| row[range.clone()].iter().copied())
    };
    let mut arrays = vec![
        Array::new("Points", 3, places),
        Array::new("grain", 1, columns(0..1)),
        Array::new("diameter (m)", 1, columns(4..5)),
        Array::new("velocity (m/s)", 3, columns(5..8)),
        Array::new("spin (rad/s)", 3, columns(8..11)),
        Array::new("force (N)", 3, columns(11..14)),
        Array::new("torque (N m)", 3, columns(14..17)),
    ];
    if let Some(system) = engine.free_grains() {
        let counts = grain_means::contacts_of_each(&system.state());
        let si_force = scene.units.si_force();
        let force = move |load: &Load| <[f64; 3]>::from(load.force * si_force);
        arrays.push(Array::new("contacts", 1, counts.into_iter().map(f64::from)));
        let forces = system.contact_loads().iter().flat_map(force);
        arrays.push(Array::new("contact force (N)", 3, forces));
    }
    atomic::write(path, |out| vtk::points(out, rows.len(), arrays))
}
