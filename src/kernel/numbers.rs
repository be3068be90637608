//! Numbers in double precision as the single precision of the device.

/// The nearest number in single precision.
#[expect(clippy::cast_possible_truncation, reason = "the device computes in single precision")]
pub(super) fn single(value: f64) -> f32 {
    value as f32
}

/// The same as a WGSL literal that stands for exactly this number, in brackets where it is negative.
pub(super) fn literal(value: f64) -> String {
    let value = single(value).clamp(f32::MIN, f32::MAX);
    if value.is_sign_negative() { format!("({value:e}f)") } else { format!("{value:e}f") }
}

/// A number of things of which there are fewer than cells, and so than 2^32.
pub(super) fn count(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}
