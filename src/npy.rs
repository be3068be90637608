//! Reading of NumPy arrays, as numpy.lib.format describes them: any real type, either order of axes,
//! little-endian. (Written by [`crate::output::npy`].)

use thiserror::Error;

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
        "its values are of type {}: save it as float64, float32, float16 or an integer, little-endian",
        crate::quote::quoted(.0)
    )]
    Type(String),
}

/// Shape and values of an array, the values in C order (the last index runs fastest).
pub fn read(bytes: &[u8]) -> Result<(Vec<usize>, Vec<f64>), NpyError> {
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
    let fortran = header
        .split_once("'fortran_order':")
        .map(|(_, rest)| rest.trim_start().starts_with("True"))
        .ok_or(NpyError::Header("fortran_order"))?;
    let shape = shape(&header).ok_or(NpyError::Header("shape"))?;
    let (size, convert) = converter(&descr).ok_or(NpyError::Type(descr))?;
    let count = shape.iter().try_fold(1_usize, |product, &n| product.checked_mul(n));
    let needed =
        count.and_then(|count| count.checked_mul(size)).ok_or(NpyError::Header("usable shape"))?;
    if values.len() < needed {
        return Err(NpyError::Short { found: values.len(), needed });
    }
    let values: Vec<f64> = values[..needed].chunks_exact(size).map(convert).collect();
    let values = if fortran { into_c_order(&shape, &values) } else { values };
    Ok((shape, values))
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

/// Bytes of a value, and what makes a number of them.
type Converter = (usize, fn(&[u8]) -> f64);

fn converter(descr: &str) -> Option<Converter> {
    /// The first bytes of a slice that has that many.
    fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
        std::array::from_fn(|i| bytes[i])
    }
    let converter: Converter = match descr {
        "<f8" => (8, |b| f64::from_le_bytes(first(b))),
        "<f4" => (4, |b| f32::from_le_bytes(first(b)).into()),
        "<f2" => (2, |b| half(u16::from_le_bytes(first(b)))),
        "<i8" => (8, |b| i64::from_le_bytes(first(b)) as f64),
        "<u8" => (8, |b| u64::from_le_bytes(first(b)) as f64),
        "<i4" => (4, |b| i32::from_le_bytes(first(b)).into()),
        "<u4" => (4, |b| u32::from_le_bytes(first(b)).into()),
        "<i2" => (2, |b| i16::from_le_bytes(first(b)).into()),
        "<u2" => (2, |b| u16::from_le_bytes(first(b)).into()),
        "|i1" => (1, |b| i8::from_le_bytes(first(b)).into()),
        "|u1" => (1, |b| b[0].into()),
        _ => return None,
    };
    Some(converter)
}

/// A number in half precision: one bit of sign, five of exponent, ten of fraction.
fn half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f64::from(bits & 0x3ff) / 1024.0);
    match exponent {
        0 => sign * fraction * 2.0_f64.powi(-14),
        31 if fraction == 0.0 => sign * f64::INFINITY,
        31 => f64::NAN,
        _ => sign * (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
    }
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
