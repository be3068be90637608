//! Solid fractions as the device finds them, one by one, so that they can be checked.

use super::bindings::Binding;
use super::buffers::Growing;
use super::device::Gpu;
use super::error::KernelError;
use super::numbers::{count, single};
use super::pipeline::Pipeline;

/// Solid fraction, 0 to 1, of the cell `-1/2..1/2`³ in each ball, given by its centre and its radius in
/// cells: as a step finds it for movable solids. Errors if the device fails.
pub fn solid_fractions_on_device(
    gpu: &Gpu,
    balls: &[([f64; 3], f64)],
) -> Result<Vec<f64>, KernelError> {
    let mut shader = format!("const COUNT = {}u;\nconst SAMPLES = 1u;\n", count(balls.len()));
    shader += include_str!("wgsl/fraction.wgsl");
    shader += include_str!("wgsl/fractions.wgsl");
    let pipeline = Pipeline::of(gpu, &shader, "fractions", vec![Binding::Balls, Binding::Seen])?;
    let rows: Vec<[f32; 4]> = balls
        .iter()
        .map(|([x, y, z], radius)| {
            [single(-0.5 - x), single(-0.5 - y), single(-0.5 - z), single(*radius)]
        })
        .collect();
    let [mut given, mut found] =
        [Growing::new(gpu, "balls to check")?, Growing::new(gpu, "fractions to check")?];
    given.fill(gpu, &rows)?;
    found.reserve(gpu, 4 * rows.len() as u64)?;
    let group = pipeline.bind(gpu, |at| match at {
        Binding::Balls => vec![given.resource()],
        _ => vec![found.resource()],
    })?;
    pipeline.run(gpu, &group, [count(rows.len().div_ceil(64)), 1, 1])?;
    let bytes = gpu.read(found.buffer(), 4 * rows.len() as u64)?;
    Ok(bytemuck::cast_slice::<u8, f32>(&bytes).iter().copied().map(f64::from).collect())
}
