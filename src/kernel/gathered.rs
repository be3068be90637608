//! Sums over the touches of solids: the loads of the last step, and how solids hold the fluid before the next one.
//!
//! The loads come from what a step keeps of its covered cells. Grips are asked for before the step: they read the
//! populations of those cells themselves, as it will, and only of the solids that are asked for. Several workgroups
//! share a solid; their parts are added up here in double precision, always in the same order.

use nalgebra::Matrix3;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Grip;

use super::bindings::Binding;
use super::buffers::Growing;
use super::compose::{Recipe, Work};
use super::error::KernelError;
use super::fluid::Kernel;
use super::layout::{Store, WORD};
use super::numbers::count;
use super::table;

/// Columns, of four numbers each, that `wgsl/grips.wgsl` adds up.
const COLUMNS: usize = 5;

impl Recipe<'_> {
    /// The end of the shader for `work`, which adds up what the touches of a solid give.
    pub(super) fn gather(&self, work: Work) -> String {
        let reader = |binding, name| table::reader(self.layout.store, binding, name);
        let (parts, columns, sums, mut terms) = match work {
            Work::Grips { parts, .. } => (parts, COLUMNS, Binding::Seen, String::new()),
            _ => (1, 2, Binding::Loads, reader(Binding::Moments, "moments")),
        };
        terms += match work {
            Work::Grips { .. } => include_str!("wgsl/grips.wgsl"),
            _ => include_str!("wgsl/loads.wgsl"),
        };
        // A workgroup waits for its slowest part, which a software adapter does at some cost: there it has
        // but one part, eight invocations.
        let lanes = if self.layout.store == Store::Textures { 8 } else { 64 };
        let solids = self.solid_count();
        let head = format!(
            "const LANES = {lanes}u;\nconst SOLIDS = {solids}u;\nconst PARTS = {parts}u;\n\
             const COLUMNS = {columns}u;\nconst SUMS = BIND_{sums:?};\n"
        );
        let shares = reader(Binding::Shares, "shares");
        [&head, include_str!("wgsl/solid.wgsl"), &shares, &terms, include_str!("wgsl/gather.wgsl")]
            .concat()
    }
}

/// Workgroups for so many solids, `parts` to each.
fn groups(solids: u32, parts: u32) -> [u32; 3] {
    [solids.min(65_535), parts, solids.div_ceil(65_535)]
}

impl Kernel {
    /// Adds up the loads of the step that was submitted last.
    pub(super) fn submit_loads(&self) -> Result<(), KernelError> {
        let since = self.watch.begin();
        let Some(solids) = &self.solids else { return Ok(()) };
        let gather = self.pipeline(Work::Loads)?;
        let group = self.bind(self.current, &gather, None, None)?;
        gather.run(&self.gpu, &group, groups(solids.solid_count, 1))?;
        self.watch.wait(&self.gpu, since, |times| &mut times.forces)
    }

    /// How each solid holds the fluid before its next collision; of those that are not `wanted`, nothing.
    pub fn grips(&self, wanted: &[usize]) -> Result<Vec<Grip>, KernelError> {
        let Some(solids) = &self.solids else { return Ok(Vec::new()) };
        let mut grips = vec![Grip::default(); solids.solid_count as usize];
        if wanted.is_empty() {
            return Ok(grips);
        }
        let since = self.watch.begin();
        let parts = solids.movable().map_or(1, |movable| movable.parts);
        let gather = self.pipeline(Work::Grips { is_first: !self.is_collided, parts })?;
        let asked = count(wanted.len());
        let numbers: Vec<u32> =
            std::iter::once(asked).chain(wanted.iter().map(|&solid| count(solid))).collect();
        let mut list = Growing::new(&self.gpu, "solids that are asked for")?;
        list.fill(&self.gpu, &numbers)?;
        let row = 4 * COLUMNS * parts as usize;
        let bytes = WORD * (wanted.len() * row) as u64;
        self.seen.borrow_mut().reserve(&self.gpu, bytes)?;
        let group = self.bind(self.current, &gather, None, Some(list.buffer()))?;
        gather.run(&self.gpu, &group, groups(asked, parts))?;
        let bytes = self.gpu.read(self.seen.borrow().buffer(), bytes)?;
        let rows = bytemuck::cast_slice::<u8, f32>(&bytes).chunks_exact(row);
        wanted.iter().zip(rows).for_each(|(&solid, row)| grips[solid] = grip(row));
        self.watch.add(since, |times| &mut times.grips);
        Ok(grips)
    }
}

/// A grip put together from its parts.
fn grip(parts: &[f32]) -> Grip {
    let mut sums = [0.0; 4 * COLUMNS];
    for part in parts.chunks_exact(sums.len()) {
        sums.iter_mut().zip(part).for_each(|(sum, &part)| *sum += f64::from(part));
    }
    let vector = |column: usize| Vec3::from_fn(|i, _| sums[4 * column + i]);
    let (squares, mixed) = (vector(3), vector(4));
    let [xy, yz, xz] = mixed.into();
    // r² I - r rᵀ
    let inertia = Matrix3::from_diagonal_element(squares.sum())
        - Matrix3::new(squares.x, xy, xz, xy, squares.y, yz, xz, yz, squares.z);
    Grip {
        impulse: vector(0),
        moment: vector(1),
        mass: sums[7],
        mass_arm: vector(2),
        inertia,
        displaced: sums[3],
    }
}
