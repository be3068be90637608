//! NumPy arrays, format version 1.0, C order; fields are written in double precision, little-endian.
//!
//! Own short code ([`crate::npy`] too), checked with NumPy itself: the crates for it bring a parser generator.

use std::io::{self, Write};

use crate::npy::write_header;

/// Writes `values` as an array of that shape.
pub fn array(
    out: &mut impl Write,
    shape: &[usize],
    values: impl Iterator<Item = f64>,
) -> io::Result<()> {
    write_header(out, "<f8", shape)?;
    for value in values {
        out.write_all(&value.to_le_bytes())?;
    }
    Ok(())
}
