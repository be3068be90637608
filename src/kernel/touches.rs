//! The parts of cells that solids cover, as the loads are added up from them.

use std::collections::HashSet;

use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use super::bindings::Binding;
use super::buffers::Growing;
use super::coverage::Tables;
use super::device::Gpu;
use super::error::KernelError;
use super::layout::{Store, WORD};
use super::numbers::{count, single};
use super::table::Table;

/// What the device holds of the touches of all solids; row 0 is that of none.
#[derive(Debug)]
pub(super) struct Touches {
    /// Each solid with its motion (`wgsl/solid.wgsl`).
    pub(super) solids: Growing,
    /// Number of touches of each solid.
    pub(super) counts: Growing,
    /// For each touch its cell, counted from 1, and the bits of the arm from the solid's centre.
    pub(super) shares: Table,
    /// For each touch the record of its cell.
    pub(super) links: Growing,
    /// For each touch `B_s`.
    pub(super) weights: Growing,
    /// Momentum and density of each covered cell before its collision, by records.
    pub(super) moments: Table,
    /// Where the touches of each solid stand.
    pub(super) room: Vec<Room>,
}

/// A solid as the device knows it (`wgsl/solid.wgsl`).
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct Row {
    base: [i32; 3],
    radius: f32,
    offset: [f32; 3],
    first: u32,
    velocity: [f32; 3],
    rows: u32,
    angular_velocity: [f32; 3],
    side: u32,
}

/// The room that a solid has in the tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    /// The number of its first touch.
    pub(super) first: u32,
    /// How many it may have.
    pub(super) touches: u32,
    /// Its first row of cells, or its first given cell.
    pub(super) rows: u32,
    /// Cells along each side of the box about a ball.
    pub(super) side: u32,
}

impl Room {
    /// The room of all solids; and how many touches and rows of cells there are in all.
    pub(super) fn of_all(domain: &Domain, solids: &[Solid]) -> (Vec<Room>, [u32; 2]) {
        let (mut first, mut rows, mut given) = (1, 0, 0);
        let room = solids.iter().map(|solid| {
            let room = match &solid.shape {
                Shape::Cells { fractions, place } => {
                    let touches = match place {
                        Some(_) => most_given(domain, fractions),
                        None => count(fractions.len()),
                    };
                    given += touches;
                    Room { first, touches, rows: given - touches, side: 0 }
                }
                Shape::Sphere { radius } => {
                    let side = whole(2.0 * radius) + 2;
                    rows += side * side;
                    let touches = most_touches(*radius).min(side.saturating_pow(3));
                    Room { first, touches, rows: rows - side * side, side }
                }
            };
            first += room.touches;
            room
        });
        let room = room.collect();
        (room, [first - 1, rows])
    }
}

impl Room {
    /// The room of solids that have just what they need.
    fn one_after_another(counts: &[u32]) -> Vec<Room> {
        let starts = counts.iter().scan(1, |next, touches| {
            let first = *next;
            *next += touches;
            Some(first)
        });
        let room = |(first, &touches)| Room { first, touches, rows: 0, side: 0 };
        starts.zip(counts).map(room).collect()
    }
}

/// Cells that a solid touches wherever it is moved and however it is turned, at most, if these are those that it touches now.
///
/// A cell that it touches then holds a point of it. Turned back, all that lies in that cell is within the diagonal of a cell,
/// √3, of a point of the solid, and so in a cell at most two away, along each axis, from one that it touches now; and no volume grows as
/// it is turned.
fn most_given(domain: &Domain, fractions: &[(usize, f64)]) -> u32 {
    let mut near = HashSet::new();
    for &(cell, _) in fractions {
        let [x, y, z] = domain.coordinates(cell).map(|x| x as i64);
        for k in z - 2..=z + 2 {
            for j in y - 2..=y + 2 {
                near.extend((x - 2..=x + 2).map(|i| [i, j, k]));
            }
        }
    }
    count(near.len())
}

/// Cells that a ball touches, at most: they all lie in what a cube of side 2 about its points fills.
fn most_touches(radius: f64) -> u32 {
    // Steiner: 8 + 24 r + 6π r² + 4/3 π r³
    let pi = std::f64::consts::PI;
    whole(8.0 + radius * (24.0 + radius * pi * (6.0 + 4.0 / 3.0 * radius)))
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "solids fit the box")]
fn whole(number: f64) -> u32 {
    number as u32
}

impl Touches {
    pub(super) fn new(gpu: &Gpu, store: Store) -> Result<Self, KernelError> {
        let buffer = |label| Growing::new(gpu, label);
        let table = |label| Table::new(gpu, store, label);
        Ok(Touches {
            solids: buffer("motion of solids")?,
            counts: buffer("numbers of touches")?,
            shares: table("cells and arms of touches")?,
            links: buffer("records of touches")?,
            weights: buffer("weights of touches")?,
            moments: table("moments of covered cells")?,
            room: Vec::new(),
        })
    }

    /// What a shader is bound to there; nothing if it is not among these.
    pub(super) fn resource(&self, at: Binding) -> Option<wgpu::BindingResource<'_>> {
        Some(match at {
            Binding::Solids => self.solids.resource(),
            Binding::Counts => self.counts.resource(),
            Binding::Shares => self.shares.resource(),
            Binding::Links => self.links.resource(),
            Binding::Weights => self.weights.resource(),
            Binding::Moments => self.moments.resource(),
            _ => return None,
        })
    }

    /// Makes room for `rows` touches, the row of none among them, of solids that have `room` of them.
    pub(super) fn reserve(
        &mut self,
        gpu: &Gpu,
        rows: usize,
        room: Vec<Room>,
    ) -> Result<(), KernelError> {
        self.shares.reserve(gpu, rows)?;
        self.moments.reserve(gpu, rows)?;
        self.links.reserve(gpu, 4 * rows as u64)?;
        self.weights.reserve(gpu, 4 * rows as u64)?;
        self.counts.reserve(gpu, 4 * room.len() as u64)?;
        self.room = room;
        Ok(())
    }

    /// Uploads the touches of solids that stay where they are.
    pub(super) fn fill(&mut self, gpu: &Gpu, tables: &Tables) -> Result<(), KernelError> {
        self.room = Room::one_after_another(&tables.counts);
        self.moments.reserve(gpu, tables.shares.len())?;
        self.shares.fill(gpu, &tables.shares)?;
        self.links.fill(gpu, &tables.links)?;
        self.weights.fill(gpu, &tables.weights)?;
        self.counts.fill(gpu, &tables.counts)
    }

    /// Uploads where the solids are and how they move.
    pub(super) fn place(&mut self, gpu: &Gpu, solids: &[Solid]) -> Result<(), KernelError> {
        debug_assert_eq!(solids.len(), self.room.len(), "as many solids as before");
        let placed = solids.iter().zip(&self.room);
        let rows: Vec<Row> = placed.map(|(solid, room)| row(solid, room)).collect();
        self.solids.fill(gpu, &rows)
    }

    /// `Σ B_s` over the touches of each solid.
    pub(super) fn displaced(&self, gpu: &Gpu) -> Result<Vec<f64>, KernelError> {
        let Some(last) = self.room.last() else { return Ok(Vec::new()) };
        let words = u64::from(last.first + last.touches);
        let weights = gpu.read(self.weights.buffer(), WORD * words)?;
        let counts = gpu.read(self.counts.buffer(), WORD * self.room.len() as u64)?;
        let weights: &[f32] = bytemuck::cast_slice(&weights);
        let counts: &[u32] = bytemuck::cast_slice(&counts);
        let sum = |(room, &count): (&Room, &u32)| -> f64 {
            let first = room.first as usize;
            weights[first..first + count as usize].iter().map(|&weight| f64::from(weight)).sum()
        };
        Ok(self.room.iter().zip(counts).map(sum).collect())
    }
}

/// A solid with its room. Places are told against a cell near the solid, so that they keep their digits.
fn row(solid: &Solid, room: &Room) -> Row {
    let narrow = |v: Vec3| [single(v.x), single(v.y), single(v.z)];
    let (radius, low, side) = match &solid.shape {
        Shape::Sphere { radius } => (*radius, solid.centre.add_scalar(-radius), room.side),
        Shape::Cells { fractions, .. } => (0.0, solid.centre, count(fractions.len())),
    };
    let base = low.map(cell_at);
    let offset = base.map(|i| f64::from(i) + 0.5) - solid.centre;
    Row {
        base: base.into(),
        radius: single(radius),
        offset: narrow(offset),
        first: room.first,
        velocity: narrow(solid.velocity),
        rows: room.rows,
        angular_velocity: narrow(solid.angular_velocity),
        side,
    }
}

/// The cell of a coordinate.
#[expect(clippy::cast_possible_truncation, reason = "coordinates of solids are far below 2^31")]
fn cell_at(coordinate: f64) -> i32 {
    coordinate.floor() as i32
}
