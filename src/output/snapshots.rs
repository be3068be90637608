//! Snapshots: all cells, a plane, or all grains, at one time, each in files of its own.

use std::io::{self, Write};
use std::path::Path;

use psmrt_reference::grains::grain::{Grain, sphere_volume};

use super::vtk::Array;
use super::wrapped::wrapped;
use super::{atomic, contacts, grain_means, npy, vtk};
use crate::engine::{Block, CellState, Coupled};
use crate::scene::format_run::FieldFormat;
use crate::scene::names;
use crate::scene::{OutputInterval, Record, Scene, What};

/// Writes what `record` wants for now into `folder/<its name>/`, and its list of times.
pub fn take(record: &Record, scene: &Scene, engine: &Coupled, folder: &Path) -> io::Result<()> {
    let name = &record.name;
    let folder_of_files = folder.join(name);
    let step = engine.steps();
    let suffix = match &record.what {
        What::Grains => {
            grains(scene, engine, &folder_of_files.join(file(name, step, "vtp")))?;
            "vtp"
        }
        What::Contacts => {
            contacts::network(scene, engine, &folder_of_files.join(file(name, step, "vtp")))?;
            "vtp"
        }
        What::Slice { normal, at, quantity, si_range } => {
            let path = folder_of_files.join(file(name, step, "svg"));
            let map = super::slice::map(scene, engine, (*normal, *at), *quantity, *si_range);
            let svg = psmrt_report::render_map(&map).map_err(io::Error::other)?;
            return atomic::write(&path, |out| out.write_all(svg.as_bytes()));
        }
        What::Fields { formats } => {
            let fields = Fields::of(scene, engine);
            if formats.contains(&FieldFormat::Npy) {
                arrays(scene, step, &fields, &folder_of_files)?;
            }
            if !formats.contains(&FieldFormat::Vti) {
                return Ok(());
            }
            image(scene, &fields, &folder_of_files.join(file(name, step, "vti")))?;
            "vti"
        }
        What::Box
        | What::Profile { .. }
        | What::Loads
        | What::GrainMeans
        | What::Layers { .. }
        | What::Walls
        | What::ContactMeans
        | What::Permeability { .. } => return Ok(()),
    };
    let times: Vec<u64> = match record.interval {
        OutputInterval::Every(interval) => (0..=step / interval).map(|i| i * interval).collect(),
        OutputInterval::AtEnd => vec![step],
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

/// The fields of all cells in SI units, x fastest; asked from the engine once, plane by plane.
struct Fields {
    /// Pa above the reference.
    pressure: Vec<f64>,
    /// m/s, three components a cell.
    velocity: Vec<f64>,
    /// Where there is a solid phase.
    solid_fraction: Option<Vec<f64>>,
}

/// Bytes that the fields of a cell take.
pub const BYTES_OF_FIELDS: u64 = 5 * size_of::<f64>() as u64;

impl Fields {
    fn of(scene: &Scene, engine: &Coupled) -> Self {
        let (domain, units) = (&scene.setup.domain, scene.units);
        let count = domain.cell_count();
        let mut fields = Fields {
            pressure: Vec::with_capacity(count),
            velocity: Vec::with_capacity(3 * count),
            solid_fraction: scene.setup.solid_phase.is_some().then(|| Vec::with_capacity(count)),
        };
        let si_velocity = units.si_velocity();
        for z in 0..domain.cells()[2] {
            let plane = engine.cells(Block::plane(domain, z));
            for CellState { density, velocity, solid_fraction } in plane {
                fields.pressure.push(units.si_gauge_pressure(density));
                fields.velocity.extend((velocity * si_velocity).iter());
                if let Some(values) = &mut fields.solid_fraction {
                    values.push(solid_fraction);
                }
            }
        }
        fields
    }
}

fn image(scene: &Scene, fields: &Fields, path: &Path) -> io::Result<()> {
    let mut arrays = vec![
        Array::new("pressure (Pa)", 1, fields.pressure.iter().copied()),
        Array::new("velocity (m/s)", 3, fields.velocity.iter().copied()),
    ];
    if let Some(values) = &fields.solid_fraction {
        arrays.push(Array::new("solid fraction", 1, values.iter().copied()));
    }
    let (cells, si_dx) = (scene.setup.domain.cells(), scene.units.si_dx);
    atomic::write(path, |out| vtk::image(out, cells, si_dx, arrays))
}

fn arrays(scene: &Scene, step: u64, fields: &Fields, folder: &Path) -> io::Result<()> {
    let [nx, ny, nz] = scene.setup.domain.cells();
    let write = |name: &str, shape: &[usize], values: &[f64]| {
        atomic::write(&folder.join(file(name, step, "npy")), |out| {
            npy::array(out, shape, values.iter().copied())
        })
    };
    write("pressure", &[nz, ny, nx], &fields.pressure)?;
    write("velocity", &[nz, ny, nx, 3], &fields.velocity)?;
    match &fields.solid_fraction {
        Some(values) => write("solid_fraction", &[nz, ny, nx], values),
        None => Ok(()),
    }
}

fn grains(scene: &Scene, engine: &Coupled, path: &Path) -> io::Result<()> {
    let rows = super::loads::load_rows(scene, engine);
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
    ];
    if !scene.is_dry {
        arrays.push(Array::new("force (N)", 3, columns(11..14)));
        arrays.push(Array::new("torque (N m)", 3, columns(14..17)));
    }
    if let Some(system) = engine.free_grains() {
        // Those that are not free have no density.
        if rows.len() == system.grains().len() && system.grains().iter().all(|grain| !grain.held) {
            let si_density =
                |grain: &Grain| grain.mass / sphere_volume(grain.radius) * scene.units.si_density;
            let values = system.grains().iter().map(si_density);
            arrays.push(Array::new("density (kg/m3)", 1, values));
        }
        // A solid that is no grain has no contacts.
        let (mut counts, mut forces) = (vec![0.0; rows.len()], vec![[0.0; 3]; rows.len()]);
        let of_grains = grain_means::contacts_of_each(&system.state());
        let contacts = of_grains.into_iter().zip(system.contact_loads());
        for (&solid, (count, load)) in engine.solids_of_grains().iter().zip(contacts) {
            counts[solid] = f64::from(count);
            forces[solid] = (load.force * scene.units.si_force()).into();
        }
        arrays.push(Array::new("contacts", 1, counts.into_iter()));
        arrays.push(Array::new("contact force (N)", 3, forces.into_iter().flatten()));
    }
    atomic::write(path, |out| vtk::points(out, rows.len(), arrays))
}
