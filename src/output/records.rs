//! Records: what an engine is asked for, turned into rows in SI units or files of their own.

use std::io;
use std::path::{Path, PathBuf};

use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

use super::csv::{Mark, TableFile, Value};
use super::load_means::LoadSums;
use super::loads::rows_of;
use super::{between, contacts, grain_means, layers, snapshots, walls};
use crate::engine::{Block, CellState, Coupled};
use crate::scene::columns::{
    BOX_COLUMNS, CONTACT_MEAN_COLUMNS, Column, GRAIN_MEAN_COLUMNS, LAYER_COLUMNS, LOAD_COLUMNS,
    PERMEABILITY_COLUMNS, PROFILE_COLUMNS, WALL_COLUMNS,
};
use crate::scene::{Record, Scene, What, names};
use crate::seepage::permeability::{Seepage, seepage};

/// Takes one record.
#[derive(Debug)]
pub struct Recorder {
    /// What it is.
    pub record: Record,
    /// The row that was taken last, of those records of which a column may become steady.
    pub watched: Option<Vec<f64>>,
    /// Of averaged loads: what has been summed since the row before.
    pub sums: LoadSums,
    folder: PathBuf,
    /// The file of a record that is a table.
    table: Option<TableFile>,
}

impl Recorder {
    /// Begins a record in `folder`.
    pub fn create(record: &Record, folder: &Path) -> io::Result<Self> {
        let path = table_path(record, folder);
        let table = columns(record).map(|columns| named(&path, TableFile::create(&path, &columns)));
        let table = table.transpose()?;
        Ok(Self::of(record, folder, table))
    }

    fn of(record: &Record, folder: &Path, table: Option<TableFile>) -> Self {
        let (record, folder) = (record.clone(), folder.to_owned());
        Recorder { record, watched: None, sums: LoadSums::default(), folder, table }
    }

    /// Opens a record whose table began with what `mark` says; errors if it does not any more. Changes
    /// nothing: [`Recorder::go_on`] drops what came after.
    pub fn reopen(record: &Record, folder: &Path, mark: Mark) -> io::Result<Self> {
        let path = table_path(record, folder);
        let table =
            columns(record).map(|_| named(&path, TableFile::reopen(&path, mark))).transpose()?;
        Ok(Self::of(record, folder, table))
    }

    /// Goes on after [`Recorder::reopen`].
    pub fn go_on(&mut self) -> io::Result<()> {
        let path = table_path(&self.record, &self.folder);
        self.table.as_mut().map_or(Ok(()), |table| named(&path, table.cut()))
    }

    /// Copies a table into `folder`, also after its own has gone.
    pub fn copy_to(&mut self, folder: &Path) -> io::Result<()> {
        let path = table_path(&self.record, folder);
        self.table.as_mut().map_or(Ok(()), |table| named(&path, table.copy_to(&path)))
    }

    /// Takes it for now.
    pub fn take(&mut self, scene: &Scene, engine: &Coupled) -> io::Result<()> {
        let path = table_path(&self.record, &self.folder);
        match self.table {
            Some(_) => {
                named(&path, self.take_rows(scene, engine))?;
                // An open file takes rows also when it has been removed, and loses them at the end.
                named(&path, path.metadata().map(|_| ()))
            }
            None => {
                let taken = snapshots::take(&self.record, scene, engine, &self.folder);
                named(&self.folder.join(&self.record.name), taken)
            }
        }
    }

    fn take_rows(&mut self, scene: &Scene, engine: &Coupled) -> io::Result<()> {
        let Some(table) = &mut self.table else { return Ok(()) };
        let steps = engine.steps();
        let now = [Value::Real(steps as f64 * scene.units.si_dt), Value::Whole(steps)];
        let mut add = |start: &[Value], values: &[f64]| {
            let values: Vec<_> = values.iter().map(|&value| Value::Real(value)).collect();
            table.add(&[&now, start, &values].concat())
        };
        match &self.record.what {
            What::Box | What::GrainMeans | What::ContactMeans | What::Permeability { .. } => {
                self.watched = watched_row(&self.record.what, scene, engine);
                add(&[], self.watched.as_deref().unwrap_or_default())?;
            }
            What::Profile { axis, through } => {
                for row in profile_rows(scene, engine, *axis, *through) {
                    add(&[], &row)?;
                }
            }
            What::Layers { axis, count } => {
                for row in layers::rows(scene, engine, *axis, *count) {
                    add(&[], &row)?;
                }
            }
            What::Walls => {
                for forces in walls::forces(scene, engine) {
                    add(&[Value::Word(forces.face)], &[forces.fluid, forces.grains].concat())?;
                }
            }
            What::Loads => {
                let loads = self.sums.take().unwrap_or_else(|| engine.loads());
                self.watched = Some(summed(scene, &loads).to_vec());
                for (grain, row) in (0..).zip(rows_of(scene, engine, &loads)) {
                    add(&[Value::Whole(grain)], &row[1..])?;
                }
            }
            What::Fields { .. } | What::Slice { .. } | What::Grains | What::Contacts => {}
        }
        table.flush()
    }

    /// Waits until all rows are on the disk; returns what the table holds, nothing for a record that is
    /// none.
    pub fn sync(&mut self) -> io::Result<Mark> {
        let path = table_path(&self.record, &self.folder);
        self.table.as_mut().map_or(Ok(Mark::default()), |table| named(&path, table.sync()))
    }
}

fn table_path(record: &Record, folder: &Path) -> PathBuf {
    folder.join(names::table(&record.name))
}

/// Names the file in an error.
fn named<T>(path: &Path, result: io::Result<T>) -> io::Result<T> {
    result.map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", path.display())))
}

/// The columns of a record that is a table.
pub fn columns(record: &Record) -> Option<Vec<Column>> {
    let own: &[Column] = match record.what {
        What::Box => &BOX_COLUMNS,
        What::Profile { .. } => &PROFILE_COLUMNS,
        What::Loads => &LOAD_COLUMNS,
        What::GrainMeans => &GRAIN_MEAN_COLUMNS,
        What::Layers { .. } => &LAYER_COLUMNS,
        What::Walls => &WALL_COLUMNS,
        What::ContactMeans => &CONTACT_MEAN_COLUMNS,
        What::Permeability { .. } => &PERMEABILITY_COLUMNS,
        What::Fields { .. } | What::Slice { .. } | What::Grains | What::Contacts => return None,
    };
    let first = [Column::new("time", "s"), Column::new("step", "")];
    Some([first.as_slice(), own].concat())
}

/// The values of [`BOX_COLUMNS`].
pub fn box_row(scene: &Scene, engine: &Coupled) -> [f64; 5] {
    let (means, units) = (engine.box_means(), &scene.units);
    // The superficial velocity is the mass flux over the reference density, 1. That of a collision, which cells
    // with solids in them brake, does not exist before the first one: the start has the flux that was set.
    let flux = if engine.steps() == 0 { flux_at_start(scene, engine) } else { means.mass_flux };
    let superficial = flux * units.si_velocity();
    [
        means.density * units.si_density,
        superficial.x,
        superficial.y,
        superficial.z,
        means.max_speed * units.si_velocity(),
    ]
}

/// Mean of the momentum with half a step of the body force, `j + G/2`.
fn flux_at_start(scene: &Scene, engine: &Coupled) -> Vec3 {
    let domain = &scene.setup.domain;
    let of_plane = |z: usize| -> Vec3 {
        let cells = engine.cells(Block::plane(domain, z));
        cells.iter().map(|cell| cell.density * cell.velocity).sum()
    };
    (0..domain.cells()[2]).map(of_plane).sum::<Vec3>() / domain.cell_count() as f64
}

/// The values of [`crate::scene::columns::FORCE_COLUMNS`], summed over all grains.
pub fn force_row(scene: &Scene, engine: &Coupled) -> [f64; 3] {
    summed(scene, &engine.loads())
}

fn summed(scene: &Scene, loads: &[Load]) -> [f64; 3] {
    let force: Vec3 = loads.iter().map(|load| load.force).sum();
    (force * scene.units.si_force()).into()
}

/// The row of a record of which a column may become steady: of `loads` the forces, summed over all grains. None of
/// other records.
pub fn watched_row(what: &What, scene: &Scene, engine: &Coupled) -> Option<Vec<f64>> {
    match what {
        What::Box => Some(box_row(scene, engine).to_vec()),
        What::GrainMeans => Some(grain_means::row(scene, engine).to_vec()),
        What::Loads => Some(force_row(scene, engine).to_vec()),
        What::ContactMeans => Some(contacts::row(scene, engine).to_vec()),
        What::Permeability { axis, si_gravity } => {
            Some(seepage_now(scene, engine, (*axis, *si_gravity)).row().to_vec())
        }
        What::Profile { .. }
        | What::Layers { .. }
        | What::Walls
        | What::Fields { .. }
        | What::Slice { .. }
        | What::Grains
        | What::Contacts => None,
    }
}

/// The bed and the flow through it along an axis, with a gravity for heads (m/s2): what `permeability` has.
pub fn seepage_now(scene: &Scene, engine: &Coupled, flow: (usize, f64)) -> Seepage {
    let [_, x, y, z, _] = box_row(scene, engine);
    seepage(scene, engine, flow, [x, y, z][flow.0])
}

/// The values of the columns of a profile along `axis` through a point (in cells): at each centre of a cell along
/// the axis, first that place, at the end the point.
pub fn profile_rows(
    scene: &Scene,
    engine: &Coupled,
    axis: usize,
    through: [f64; 3],
) -> Vec<[f64; 8]> {
    let (domain, units) = (&scene.setup.domain, &scene.units);
    let row = |(i, state): (usize, CellState)| {
        let velocity = state.velocity * units.si_velocity();
        let position = (i as f64 + 0.5) * units.si_dx;
        let pressure = units.si_gauge_pressure(state.density);
        let mut point = through.map(|place| place * units.si_dx);
        point[axis] = position;
        let [x, y, z] = point;
        [position, pressure, velocity.x, velocity.y, velocity.z, x, y, z]
    };
    let states = between::states(engine, domain, between::line(axis, through));
    states.into_iter().enumerate().map(row).collect()
}
