//! Reading of NumPy arrays, as numpy.lib.format describes them: any real type, either order of axes and
//! of bytes; and their header, for those who write them.

use std::io::{self, Write};

use thiserror::Error;

use crate::number_type::NumberType;

/// A file that is no array that can be used.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum NpyError {
    /// Not an NPY file.
    #[error("it is no .npy file (numpy.save writes them)")]
    Foreign,
    /// Cut off.
    #[error("it ends early: {found} bytes of values, its shape needs {needed}")]
    Short {
        /// Bytes there are.
        found: usize,
        /// Bytes that there should be.
        needed: usize,
    },
    /// A header that says something else than a header should.
    #[error("its header has no {0}")]
    Header(&'static str),
    /// A type of values that is not read.
    #[error(
        "its values are of type {}: save it as float64, float32, float16, an integer or bool",
        crate::quote::quoted(.0)
    )]
    Type(String),
}

/// What stands before the values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// Lengths of the axes.
    pub shape: Vec<usize>,
    /// Whether the first index runs fastest; else the last.
    pub is_fortran: bool,
    /// Type of the values.
    pub number: NumberType,
    /// Bytes before the first value.
    pub start: usize,
}

/// The header of an array. Errors too if its values are not all there.
pub fn header(bytes: &[u8]) -> Result<Header, NpyError> {
    let rest = bytes.strip_prefix(b"\x93NUMPY").ok_or(NpyError::Foreign)?;
    let (length, rest) = match rest {
        [1, _, a, b, rest @ ..] => (usize::from(u16::from_le_bytes([*a, *b])), rest),
        [2 | 3, _, a, b, c, d, rest @ ..] => {
            (usize::try_from(u32::from_le_bytes([*a, *b, *c, *d])).unwrap_or(usize::MAX), rest)
        }
        _ => return Err(NpyError::Foreign),
    };
    let (header, values) = rest.split_at_checked(length).ok_or(NpyError::Foreign)?;
    let header = String::from_utf8_lossy(header);
    let descr = quoted(&header, "'descr':").ok_or(NpyError::Header("descr"))?;
    let is_fortran = header
        .split_once("'fortran_order':")
        .map(|(_, rest)| rest.trim_start().starts_with("True"))
        .ok_or(NpyError::Header("fortran_order"))?;
    let shape = shape(&header).ok_or(NpyError::Header("shape"))?;
    let number = NumberType::of_numpy(&descr).ok_or(NpyError::Type(descr))?;
    let count = shape.iter().try_fold(1_usize, |product, &n| product.checked_mul(n));
    let needed = count
        .and_then(|count| count.checked_mul(number.size()))
        .ok_or(NpyError::Header("usable shape"))?;
    if values.len() < needed {
        return Err(NpyError::Short { found: values.len(), needed });
    }
    Ok(Header { shape, is_fortran, number, start: bytes.len() - values.len() })
}

/// Shape and values of an array, the values in C order (the last index runs fastest).
pub fn read(bytes: &[u8]) -> Result<(Vec<usize>, Vec<f64>), NpyError> {
    let Header { shape, is_fortran, number, start } = header(bytes)?;
    let count = shape.iter().product::<usize>();
    let values = bytes[start..].chunks_exact(number.size()).take(count);
    let values: Vec<f64> = values.map(|value| number.read(value)).collect();
    let values = if is_fortran { into_c_order(&shape, &values) } else { values };
    Ok((shape, values))
}

/// Writes what stands before the values of an array; `code` is NumPy's for their type.
pub fn write_header(out: &mut impl Write, code: &str, shape: &[usize]) -> io::Result<()> {
    let shape: String = shape.iter().map(|length| format!("{length}, ")).collect();
    let mut header =
        format!("{{'descr': '{code}', 'fortran_order': False, 'shape': ({}), }}", shape.trim_end());
    // Magic (6), version (2), length (2), header and a newline fill a multiple of 64 bytes.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    header.push_str(&" ".repeat(length - header.len() - 1));
    header.push('\n');
    out.write_all(b"\x93NUMPY\x01\x00")?;
    let length = u16::try_from(length).map_err(io::Error::other)?;
    out.write_all(&length.to_le_bytes())?;
    out.write_all(header.as_bytes())
}

/// The quoted text after `key`.
fn quoted(header: &str, key: &str) -> Option<String> {
    let (_, rest) = header.split_once(key)?;
    Some(rest.split('\'').nth(1)?.to_owned())
}

fn shape(header: &str) -> Option<Vec<usize>> {
    let (_, rest) = header.split_once("'shape':")?;
    let (_, rest) = rest.split_once('(')?;
    let (list, _) = rest.split_once(')')?;
    let lengths = list.split(',').map(str::trim).filter(|length| !length.is_empty());
    lengths.map(|length| length.parse().ok()).collect()
}

/// Values whose first index runs fastest, put so that the last one does.
fn into_c_order(shape: &[usize], values: &[f64]) -> Vec<f64> {
    let place = |mut position: usize| {
        // Indices from the last axis to the first, then their place with the first one fastest.
        let mut indices: Vec<usize> = Vec::new();
        for &length in shape.iter().rev() {
            indices.push(position % length);
            position /= length;
        }
        indices
            .iter()
            .zip(shape.iter().rev())
            .fold(0, |place, (&index, &length)| place * length + index)
    };
    (0..values.len()).map(|position| values[place(position)]).collect()
}
