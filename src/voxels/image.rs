//! The numbers of an image, as they stand in the file: not one is converted before it is asked for, so that an image
//! takes the memory that the file does.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use thiserror::Error;

use super::tiff::{self, TiffError};
use crate::input::{self, InputError, MIB};
use crate::machine;
use crate::npy::{self, NpyError};
use crate::number_type::NumberType;

/// In which order the axes of an array stand in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AxisOrder {
    /// `image[k, j, i]`: z, y, x, as a stack of slices and as the fields that a run writes.
    #[default]
    Zyx,
    /// `image[i, j, k]`: x, y, z.
    Xyz,
}

/// How the numbers of a raw file are to be read: it does not say so itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RawLayout {
    /// Voxels along x, y, z.
    pub counts: [usize; 3],
    /// Their type.
    pub number: NumberType,
    /// Bytes before the first number.
    pub start: usize,
}

/// An image of numbers.
#[derive(Clone, PartialEq)]
pub struct Image {
    counts: [usize; 3],
    /// Numbers from one voxel to the next along x, y, z.
    strides: [usize; 3],
    number: NumberType,
    start: usize,
    bytes: Arc<Vec<u8>>,
}

/// A file that is no image that can be used.
#[derive(Debug, Error)]
pub enum ImageError {
    /// It cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// No NumPy array that can be used.
    #[error(transparent)]
    Npy(#[from] NpyError),
    /// No TIFF file that can be used.
    #[error(transparent)]
    Tiff(#[from] TiffError),
    /// An array of another dimension than 3.
    #[error("its shape is {0:?}; an image has three axes")]
    Axes(Vec<usize>),
    /// A raw file that is not as long as its shape says.
    #[error("it has {found} bytes; {counts:?} numbers of {size} bytes after {start} make {needed}")]
    Length {
        /// Bytes there are.
        found: usize,
        /// Bytes that there should be.
        needed: usize,
        /// Numbers along x, y, z.
        counts: [usize; 3],
        /// Bytes of a number.
        size: usize,
        /// Bytes before the first.
        start: usize,
    },
    /// An image without voxels.
    #[error("it has no voxels: its shape is {0:?}")]
    Empty([usize; 3]),
    /// Larger than what this machine can still hold.
    #[error("it has {:.0} MiB; {:.0} MiB of memory can be had ({limit})", *bytes as f64 / MIB as f64, *left as f64 / MIB as f64)]
    Memory {
        /// Bytes of the file or the folder.
        bytes: u64,
        /// Bytes that can be had.
        left: u64,
        /// What limits them.
        limit: String,
    },
}

impl Image {
    /// Reads a NumPy array, a TIFF file or a folder of TIFF slices, by the name; with `raw` a file of bare numbers.
    pub fn read(path: &Path, order: AxisOrder, raw: Option<RawLayout>) -> Result<Self, ImageError> {
        let bytes = size(path)?;
        if let Some(available) = machine::available().filter(|left| left.bytes < bytes) {
            let (left, limit) = (available.bytes, available.limit);
            return Err(ImageError::Memory { bytes, left, limit });
        }
        if let Some(raw) = raw {
            return Self::of_raw(input::read(path, u64::MAX - 1)?, raw, order);
        }
        if path.is_dir() || input::has_ending(path, &["tif", "tiff"]) {
            return Self::of_npy(tiff::as_npy(path)?, AxisOrder::Zyx);
        }
        Self::of_npy(input::read(path, u64::MAX - 1)?, order)
    }

    /// Of a NumPy file's bytes.
    pub fn of_npy(bytes: Vec<u8>, order: AxisOrder) -> Result<Self, ImageError> {
        let npy::Header { shape, is_fortran, number, start } = npy::header(&bytes)?;
        let [a, b, c] = shape[..] else { return Err(ImageError::Axes(shape)) };
        if shape.contains(&0) {
            return Err(ImageError::Empty([a, b, c]));
        }
        // From one number to the next along each axis of the array.
        let steps = if is_fortran { [1, a, a * b] } else { [b * c, c, 1] };
        let (counts, strides) = match order {
            AxisOrder::Xyz => ([a, b, c], steps),
            AxisOrder::Zyx => ([c, b, a], [steps[2], steps[1], steps[0]]),
        };
        Self { counts, strides, number, start, bytes: Arc::new(bytes) }.not_empty()
    }

    /// Of bare numbers; x runs fastest with [`AxisOrder::Zyx`], z with [`AxisOrder::Xyz`].
    pub fn of_raw(bytes: Vec<u8>, raw: RawLayout, order: AxisOrder) -> Result<Self, ImageError> {
        let RawLayout { counts, number, start } = raw;
        let [nx, ny, nz] = counts;
        let size = number.size();
        let count = counts.iter().try_fold(size, |product, &n| product.checked_mul(n));
        let needed = count.and_then(|count| count.checked_add(start)).unwrap_or(usize::MAX);
        if bytes.len() != needed {
            let found = bytes.len();
            return Err(ImageError::Length { found, needed, counts, size, start });
        }
        let strides = match order {
            AxisOrder::Zyx => [1, nx, nx * ny],
            AxisOrder::Xyz => [ny * nz, nz, 1],
        };
        Self { counts, strides, number, start, bytes: Arc::new(bytes) }.not_empty()
    }

    fn not_empty(self) -> Result<Self, ImageError> {
        if self.counts.contains(&0) { Err(ImageError::Empty(self.counts)) } else { Ok(self) }
    }

    /// Voxels along x, y, z.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// The type of its numbers.
    pub fn number_type(&self) -> NumberType {
        self.number
    }

    /// The number of a voxel.
    pub fn number(&self, at: [usize; 3]) -> f64 {
        let place: usize = (0..3).map(|axis| at[axis] * self.strides[axis]).sum();
        self.number.read(&self.bytes[self.start + place * self.number.size()..])
    }

    /// The file as it was read; a TIFF file or folder as a NumPy array.
    pub fn bytes(&self) -> Arc<Vec<u8>> {
        Arc::clone(&self.bytes)
    }
}

/// Bytes of a file, or of all files in a folder.
fn size(path: &Path) -> Result<u64, ImageError> {
    let metadata = fs::metadata(path).map_err(InputError::Io)?;
    if !metadata.is_dir() {
        return Ok(metadata.len());
    }
    let entries = fs::read_dir(path).map_err(InputError::Io)?;
    Ok(entries.flatten().filter_map(|entry| entry.metadata().ok()).map(|file| file.len()).sum())
}
