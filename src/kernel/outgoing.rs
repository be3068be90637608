//! Pressure faces that let sound out: the density at the face follows the wave that arrives.
//!
//! A cell at such a face keeps what its outward velocity `u` is beyond the slow mean of it, the excess `d`, and the
//! velocity itself, both of the step before:
//!
//! ```text
//! ρ_w = ρ_0 + √3 ρ d               density at the face; else the rule of a developed face
//! d(t) = d(t-1) - d(t-1)/T + u(t) - u(t-1)
//! ```
//!
//! which is a slow mean `m = u - d` with `dm/dt = d/T`. Kept so, single precision loses nothing however long `T` is:
//! the mean itself would no longer move where `d/T` is less than its last digit.

use std::io;

use psmrt_reference::directions::{C, Q};
use psmrt_reference::domain::{Domain, Face};

use super::buffers::Growing;
use super::device::Gpu;
use super::driven;
use super::error::KernelError;
use super::numbers::{count, literal, single};

/// Storage bindings that such faces need.
pub(super) const BINDINGS: u32 = 2;

/// A face that lets sound out.
#[derive(Clone, Copy, Debug)]
struct OpenFace {
    axis: usize,
    is_high: bool,
    memory: f64,
    /// Number of its first cell among those of all such faces.
    first: usize,
}

/// The faces of a box that let sound out, and how many cells they have.
fn open_faces(domain: &Domain) -> (Vec<OpenFace>, usize) {
    let (mut faces, mut first) = (Vec::new(), 0);
    for axis in 0..3 {
        for (face, is_high) in domain.faces().axis(axis).into_iter().zip([false, true]) {
            if let Face::NonReflectingPressure { memory, .. } = face {
                faces.push(OpenFace { axis, is_high, memory, first });
                first += domain.cell_count() / domain.cells()[axis];
            }
        }
    }
    (faces, first)
}

/// Whether a box has a face that lets sound out.
pub(super) fn has_any(domain: &Domain) -> bool {
    !open_faces(domain).0.is_empty()
}

/// Excess and velocity of the cells at such faces, twice: a step reads one copy and writes the other.
#[derive(Debug)]
pub(super) struct Outgoing {
    copies: [Growing; 2],
    cells: usize,
}

impl Outgoing {
    /// Room for them; `None` if no face of the box lets sound out. Errors if the device has none.
    pub(super) fn new(gpu: &Gpu, domain: &Domain) -> Result<Option<Self>, KernelError> {
        let (_, cells) = open_faces(domain);
        if cells == 0 {
            return Ok(None);
        }
        let copy = || Growing::new(gpu, "velocities at faces that let sound out");
        let mut outgoing = Outgoing { copies: [copy()?, copy()?], cells };
        outgoing.write(gpu, &vec![[0.0; 2]; cells])?;
        Ok(Some(outgoing))
    }

    /// What a shader that works on copy `copy` of the populations is bound to.
    pub(super) fn resource(&self, copy: usize) -> wgpu::BindingResource<'_> {
        self.copies[copy].resource()
    }

    /// Starts from populations less their weights, `h(a, cell)`: no excess, at the velocities that they have.
    pub(super) fn start(
        &mut self,
        gpu: &Gpu,
        domain: &Domain,
        h: impl Fn(usize, usize) -> f32,
    ) -> Result<(), KernelError> {
        let mut rows = Vec::with_capacity(self.cells);
        for face in open_faces(domain).0 {
            let sign = if face.is_high { 1.0 } else { -1.0 };
            let outermost = if face.is_high { domain.cells()[face.axis] - 1 } else { 0 };
            for cell in 0..domain.cell_count() {
                if domain.coordinates(cell)[face.axis] == outermost {
                    let sum = |part: &dyn Fn(usize) -> f64| {
                        (0..Q).map(|a| part(a) * f64::from(h(a, cell))).sum::<f64>()
                    };
                    let momentum = sum(&|a| f64::from(C[a][face.axis]));
                    rows.push([0.0, single(sign * momentum / (1.0 + sum(&|_| 1.0)))]);
                }
            }
        }
        self.write(gpu, &rows)
    }

    /// Puts `rows` into both copies: the first step of a run leaves them as they are.
    fn write(&mut self, gpu: &Gpu, rows: &[[f32; 2]]) -> Result<(), KernelError> {
        self.copies.iter_mut().try_for_each(|copy| copy.fill(gpu, rows))
    }

    /// The bits of copy `copy`, to be saved.
    pub(super) fn read(&self, gpu: &Gpu, copy: usize) -> Result<Vec<u8>, KernelError> {
        gpu.read(self.copies[copy].buffer(), 8 * self.cells as u64)
    }

    /// Goes on from what [`Self::read`] gave, which `row` puts where it is told.
    pub(super) fn restore(
        &mut self,
        gpu: &Gpu,
        row: impl FnOnce(&mut [u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut rows = vec![[0.0_f32; 2]; self.cells];
        row(bytemuck::cast_slice_mut(&mut rows))?;
        self.write(gpu, &rows).map_err(io::Error::other)
    }
}

/// Name of the function that gives the density at a face, less 1, from its cell's populations and place.
pub(super) fn function(axis: usize, is_high: bool) -> String {
    format!("drho_{}_{}", ["x", "y", "z"][axis], if is_high { "high" } else { "low" })
}

/// WGSL: for each such face of the box the function [`function`] and, if the shader makes steps, `keep_outgoing`,
/// which writes excess and velocity of a cell for the next one.
pub(super) fn text(domain: &Domain, writes: bool) -> String {
    let (faces, _) = open_faces(domain);
    if faces.is_empty() {
        return String::new();
    }
    let mut text =
        "@group(0) @binding(BIND_Outgoing) var<storage, read> outgoing: array<vec2<f32>>;\n"
            .to_owned();
    for face in &faces {
        text += &of_face(face);
    }
    if writes {
        text += "@group(0) @binding(BIND_NewOutgoing) var<storage, read_write> new_outgoing: array<vec2<f32>>;\n";
        text += "fn keep_outgoing(at: vec3<u32>) {\n";
        for &OpenFace { axis, is_high, .. } in &faces {
            let (x, n) = (["x", "y", "z"][axis], ["NX", "NY", "NZ"][axis]);
            let outermost = if is_high { format!("{n} - 1u") } else { "0u".to_owned() };
            let name = function(axis, is_high);
            text += &format!(
                "    if (at.{x} == {outermost}) {{\n        new_outgoing[number_{name}(at)] = \
                 excess_{name}(own(at.x, at.y, at.z), at);\n    }}\n"
            );
        }
        text += "}\n";
    }
    text
}

/// WGSL of one face.
fn of_face(face: &OpenFace) -> String {
    let &OpenFace { axis, is_high, memory, first } = face;
    let name = function(axis, is_high);
    let sign = if is_high { "" } else { "-" };
    let x = ["x", "y", "z"][axis];
    let number = ["at.y + NY * at.z", "at.x + NX * at.z", "at.x + NX * at.y"][axis];
    let (first, drho_0) = (count(first), driven::face(axis, is_high) + ".w");
    let (rate, root) = (literal(1.0 / memory), literal(3.0_f64.sqrt()));
    format!(
        "
fn number_{name}(at: vec3<u32>) -> u32 {{
    return {first}u + {number};
}}

// Of a cell at the face: the excess of its outward velocity over the slow mean, and the velocity.
fn excess_{name}(h: array<f32, 19>, at: vec3<u32>) -> vec2<f32> {{
    let last = outgoing[number_{name}(at)];
    let u = {sign}momentum(h).{x} / (1.0 + sum(h));
    // d(t) = d(t-1) - d(t-1)/T + u(t) - u(t-1)
    return vec2<f32>((last.x - {rate} * last.x) + (u - last.y), u);
}}

// Density at the face, less 1.
fn {name}(h: array<f32, 19>, at: vec3<u32>) -> f32 {{
    // ρ_w = ρ_0 + √3 ρ d
    return {drho_0} + {root} * (1.0 + sum(h)) * excess_{name}(h, at).x;
}}
"
    )
}
