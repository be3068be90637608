//! The runs that `psmrt permeability` is made of: the scene on one grid after the other, driven along one axis after the
//! other.

use nalgebra::Matrix3;
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, value};

use super::CommandError;
use crate::scene::Scene;
use crate::scene::edit::{put_on_grid, scale_steps, section, set_tau};
use crate::scene::initial::Initial;
use crate::seepage::bed::layer;
use crate::seepage::permeability::Seepage;

/// Steps between two rows of the record of the coarsest grid.
const EVERY: i64 = 20;

/// How steady k is to be where the scene does not say: far below what a grid errs by.
const TOLERANCE: f64 = 1e-4;

pub(super) const NAMES: [&str; 3] = ["x", "y", "z"];

/// A grid: the cells along the axes and how many times as fine as that of the scene it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    pub cells: [usize; 3],
    pub finer: f64,
}

/// The grids, from coarse to fine: the scene's own, and with `refine` a third one that is as many times as fine and one
/// between them, as near to their geometric mean as whole numbers of cells allow.
pub(super) fn grids(cells: [usize; 3], refine: Option<usize>) -> Result<Vec<Grid>, CommandError> {
    let mut grids = vec![Grid { cells, finer: 1.0 }];
    let Some(refine) = refine else { return Ok(grids) };
    let common = cells.into_iter().fold(0, gcd);
    let mean = common as f64 * (refine as f64).sqrt();
    let between = (common + 1..common * refine)
        .min_by(|a, b| (*a as f64 - mean).abs().total_cmp(&(*b as f64 - mean).abs()));
    let Some(between) = between else {
        return Err(CommandError::Usage(format!(
            "--refine {refine}: there is no grid between the scene's and one {refine} times as fine, since its {} x {} x {} \
             cells share no divisor; take --refine 3, or a domain whose sides do",
            cells[0], cells[1], cells[2]
        )));
    };
    for parts in [between, common * refine] {
        let cells = cells.map(|n| n / common * parts);
        grids.push(Grid { cells, finer: parts as f64 / common as f64 });
    }
    Ok(grids)
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The text of a scene that is run along an axis on a grid: its own records make way for one of permeability, whose
/// steadiness ends the run. With `si_force` a body force of that size drives it (m/s2), else what drives the scene.
pub(super) fn text(
    scene: &Scene,
    grid: &Grid,
    axis: usize,
    si_force: Option<f64>,
) -> Result<String, toml_edit::TomlError> {
    let mut document = scene.text.parse::<DocumentMut>()?;
    if let Some(size) = si_force {
        let along = |other: usize| if other == axis { size } else { 0.0 };
        let force: Array = [0, 1, 2].map(along).into_iter().collect();
        section(&mut document, "body_force").insert("acceleration", value(force));
    }
    document.remove("records");
    document.remove("compare");
    if let Initial::Cells(_) | Initial::Run(_) = scene.initial {
        // It fits one grid only, and the flow that comes of it is the same.
        document.remove("initial");
    }
    let tolerance = scene.stop.steady.as_ref().map_or(TOLERANCE, |s| s.tolerance.min(TOLERANCE));
    let mut steady = toml_edit::InlineTable::new();
    steady.insert("record", "permeability".into());
    steady.insert("column", "permeability".into());
    steady.insert("tolerance", tolerance.into());
    section(&mut document, "stop").insert("steady", value(steady));
    if grid.finer > 1.0 {
        put_on_grid(&mut document, grid.cells, scene.units.si_dx / grid.finer);
        // dt goes with dx² at the same tau.
        set_tau(&mut document, scene.setup.collision.tau());
        scale_steps(&mut document, grid.finer * grid.finer);
    }
    let mut record = Table::new();
    record.insert("name", value("permeability"));
    record.insert("kind", value("permeability"));
    record.insert("axis", value(NAMES[axis]));
    record.insert("every_steps", value(EVERY));
    let mut records = ArrayOfTables::new();
    records.push(record);
    document.insert("records", Item::ArrayOfTables(records));
    Ok(document.to_string())
}

/// The size of the force that drives each axis of a tensor, m/s2. Errors if the domain is not a periodic piece of a bed.
pub(super) fn force_of_tensor(scene: &Scene) -> Result<f64, String> {
    let setup = &scene.setup;
    if let Some(axis) = (0..3).find(|&axis| !setup.domain.is_periodic(axis)) {
        return Err(format!(
            "the domain is not periodic along {}; leave out [faces], or --tensor",
            NAMES[axis]
        ));
    }
    if let Some(axis) = (0..3).find(|&axis| layer(setup, axis).is_told) {
        return Err(format!(
            "the grains do not fill the domain along {}; take a domain that the bed fills, or leave out --tensor",
            NAMES[axis]
        ));
    }
    let force = setup.body_force.map_or(0.0, |force| force.norm());
    if force == 0.0 {
        return Err("no body force drives the fluid; add [body_force], of which the size is used along each axis"
            .to_owned());
    }
    Ok(force * scene.units.si_acceleration())
}

/// Whether both grids have the same grains.
pub(super) fn same_grains(one: &Scene, other: &Scene) -> bool {
    let places = |scene: &Scene| -> Vec<[f64; 4]> {
        let dx = scene.units.si_dx;
        let solids = scene.setup.solid_phase.iter().flat_map(|phase| &phase.solids);
        solids
            .map(|solid| {
                let [x, y, z]: [f64; 3] = solid.centre.into();
                [x * dx, y * dx, z * dx, solid.diameter() * dx]
            })
            .collect()
    };
    let (one_places, others) = (places(one), places(other));
    let size = one.units.si_dx * one.setup.domain.cells().into_iter().max().unwrap_or(1) as f64;
    one_places.len() == others.len()
        && one_places
            .iter()
            .flatten()
            .zip(others.iter().flatten())
            .all(|(a, b)| (a - b).abs() < 1e-9 * size)
}

/// A run that has ended.
#[derive(Clone, Debug)]
pub(super) struct Done {
    pub axis: usize,
    pub grid: Grid,
    pub seepage: Seepage,
    /// Superficial velocity, m/s.
    pub si_velocity: [f64; 3],
    pub is_steady: bool,
    /// Error that `plan` predicts, and what 95 % lie between.
    pub predicted: Option<[f64; 3]>,
    pub steps: u64,
    /// Edge of a cell, m.
    pub si_dx: f64,
    pub folder: String,
}

impl Done {
    /// Cells across the mean diameter.
    pub fn cells_per_diameter(&self) -> f64 {
        self.seepage.si_diameter / self.si_dx
    }

    /// The column of the tensor that this run gives, m2.
    fn column(&self) -> [f64; 3] {
        // k_ij = μ U_i/(dP/L)_j
        let s = &self.seepage;
        self.si_velocity.map(|u| s.si_density * s.si_viscosity * u / s.si_gradient)
    }
}

/// The tensor, its symmetric part's principal values from large to small with their directions, and how far it is from
/// symmetric: the largest difference of two mirrored entries over the largest principal value.
#[derive(Clone, Debug)]
pub(super) struct Tensor {
    pub k: Matrix3<f64>,
    pub principal: [(f64, [f64; 3]); 3],
    pub asymmetry: f64,
}

/// The tensor of three runs along x, y and z.
pub(super) fn tensor(runs: [&Done; 3]) -> Tensor {
    let columns = runs.map(Done::column);
    let k = Matrix3::from_fn(|i, j| columns[j][i]);
    let eigen = (0.5 * (k + k.transpose())).symmetric_eigen();
    let mut principal = [0, 1, 2].map(|number| {
        (
            eigen.eigenvalues[number],
            <[f64; 3]>::from(eigen.eigenvectors.column(number).into_owned()),
        )
    });
    principal.sort_by(|a, b| b.0.total_cmp(&a.0));
    let asymmetry = (k - k.transpose()).amax() / principal[0].0;
    Tensor { k, principal, asymmetry }
}
