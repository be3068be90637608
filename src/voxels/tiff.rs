//! Images that are TIFF files: a stack in one file, or a folder with a file for each slice. The first slice has the least z,
//! the first row of a slice the least y.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use thiserror::Error;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError as Undecoded};

use crate::input::{self, InputError, has_ending};
use crate::machine;
use crate::npy;
use crate::quote;

/// No TIFF file, or none that can be used.
#[derive(Debug, Error)]
pub enum TiffError {
    /// A slice cannot be read.
    #[error("{file}: {error}")]
    Input {
        /// Its name.
        file: String,
        /// Why.
        error: InputError,
    },
    /// A slice cannot be decoded.
    #[error("{file}, slice {slice} (from 0): {error}")]
    Undecoded {
        /// Its file.
        file: String,
        /// Its number there.
        slice: usize,
        /// Why.
        error: Undecoded,
    },
    /// A slice in colours, or with fewer bits than a byte.
    #[error(
        "{file}, slice {slice} (from 0): its pixels are {pixels}; they must be one grey number of 8, 16, 32 or 64 bits"
    )]
    Pixels {
        /// Its file.
        file: String,
        /// Its number there.
        slice: usize,
        /// What they are.
        pixels: String,
    },
    /// Slices that are not all alike.
    #[error(
        "{file}, slice {slice} (from 0): it has {found}, and the first slice {first}: all must be alike"
    )]
    Unlike {
        /// Its file.
        file: String,
        /// Its number there.
        slice: usize,
        /// Its size and type.
        found: String,
        /// Those of the first.
        first: String,
    },
    /// A directory that stands for several slices.
    #[error(
        "{file}: it has {slices} slices under one entry, as ImageJ writes large stacks; save it as an image sequence, or as bare \
         numbers with `shape` and `numbers`"
    )]
    Bundled {
        /// Its file.
        file: String,
        /// How many.
        slices: u64,
    },
    /// A slice that is missing between two others.
    #[error("a slice is missing between {before} and {after}")]
    Gap {
        /// The file before it.
        before: String,
        /// The file after it.
        after: String,
    },
    /// More than what this machine can still hold.
    #[error(
        "{file}, slice {slice} (from 0): all so far make {mib:.0} MiB, more than the memory that can be had ({limit})"
    )]
    Memory {
        /// Its file.
        file: String,
        /// Its number there.
        slice: usize,
        /// MiB with this slice.
        mib: f64,
        /// What limits it.
        limit: String,
    },
    /// A folder without slices.
    #[error("there is no .tif or .tiff file in this folder")]
    NoSlices,
}

/// Size of a slice and NumPy's code of its numbers.
type Kind = (usize, usize, &'static str);

/// All slices as the bytes of a NumPy array of axes z, y, x.
pub(super) fn as_npy(path: &Path) -> Result<Vec<u8>, TiffError> {
    let mut stack = Stack { kind: None, slices: 0, values: Vec::new() };
    for file in files(path)? {
        stack.add_file(&file)?;
    }
    let Some((width, height, code)) = stack.kind else { return Err(TiffError::NoSlices) };
    let mut bytes = Vec::with_capacity(stack.values.len() + 256);
    let written = npy::write_header(&mut bytes, code, &[stack.slices, height, width]);
    written.map_err(|error| TiffError::Input { file: quote::path(path), error: error.into() })?;
    bytes.append(&mut stack.values);
    Ok(bytes)
}

/// A file itself, or the slices of a folder in the order of the numbers in their names.
fn files(path: &Path) -> Result<Vec<PathBuf>, TiffError> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let unread =
        |error: std::io::Error| TiffError::Input { file: quote::path(path), error: error.into() };
    let entries = fs::read_dir(path).map_err(unread)?;
    let paths = entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>();
    let mut slices = paths.map_err(unread)?;
    // Those that begin with a dot are what macOS puts beside a file.
    let is_hidden = |slice: &PathBuf| {
        slice.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'))
    };
    slices.retain(|slice| has_ending(slice, &["tif", "tiff"]) && !is_hidden(slice));
    let order = |slice: &PathBuf| in_order(&slice.with_extension("").to_string_lossy());
    slices.sort_by_cached_key(order);
    for pair in slices.windows(2) {
        let [one, two] = [order(&pair[0]), order(&pair[1])];
        let (Some(first), Some(second)) = (one.last(), two.last()) else { continue };
        if first.0 == second.0 && second.1 > first.1 + 1 {
            let [before, after] = [&pair[0], &pair[1]].map(|path| quote::path(path));
            return Err(TiffError::Gap { before, after });
        }
    }
    Ok(slices)
}

/// A name so that slice_9 comes before slice_10: its parts, each a text and the number after it.
fn in_order(name: &str) -> Vec<(String, u128)> {
    let mut parts: Vec<(String, u128)> = Vec::new();
    let mut was_digit = true;
    for letter in name.chars() {
        match letter.to_digit(10) {
            Some(digit) => {
                if parts.is_empty() {
                    parts.push((String::new(), 0));
                }
                if let Some((_, number)) = parts.last_mut() {
                    *number = number.saturating_mul(10).saturating_add(digit.into());
                }
                was_digit = true;
            }
            None => {
                if was_digit {
                    parts.push((String::new(), 0));
                }
                if let Some((text, _)) = parts.last_mut() {
                    text.push(letter);
                }
                was_digit = false;
            }
        }
    }
    parts
}

/// The number of slices that the entry which is read stands for, if it says more than one: ImageJ's `images=N`, or the tag of SGI.
fn bundled(decoder: &mut Decoder<Cursor<Vec<u8>>>) -> Option<u64> {
    /// ImageDepth
    const DEPTH: Tag = Tag::Unknown(32_997);
    let depth = decoder.find_tag(DEPTH).ok().flatten().and_then(|depth| depth.into_u64().ok());
    let text = decoder.get_tag_ascii_string(Tag::ImageDescription).unwrap_or_default();
    let images = text.lines().find_map(|line| line.trim().strip_prefix("images=")?.parse().ok());
    depth.into_iter().chain(images).find(|&slices: &u64| slices > 1)
}

/// Slices one behind the other.
struct Stack {
    kind: Option<Kind>,
    slices: usize,
    values: Vec<u8>,
}

impl Stack {
    fn add_file(&mut self, path: &Path) -> Result<(), TiffError> {
        let file = quote::path(path);
        let bytes = input::read(path, u64::MAX - 1)
            .map_err(|error| TiffError::Input { file: file.clone(), error })?;
        let mut slice = 0;
        let undecoded = |slice, error| TiffError::Undecoded { file: file.clone(), slice, error };
        let mut decoder = Decoder::new(Cursor::new(bytes))
            .map_err(|error| undecoded(slice, error))?
            .with_limits(Limits::unlimited());
        loop {
            let size = decoder.dimensions().map_err(|error| undecoded(slice, error))?;
            self.has_room(&file, slice, size)?;
            let described = bundled(&mut decoder).filter(|_| slice == 0);
            let found =
                decoder.colortype().and_then(|colour| Ok((colour, size, decoder.read_image()?)));
            let (colour, (width, height), pixels) =
                found.map_err(|error| undecoded(slice, error))?;
            let wrong = |pixels: String| TiffError::Pixels { file: file.clone(), slice, pixels };
            match colour {
                ColorType::Gray(bits) if bits >= 8 => {}
                ColorType::Gray(bits) => return Err(wrong(format!("grey numbers of {bits} bits"))),
                other => return Err(wrong(format!("{other:?}"))),
            }
            let Some(code) = self.add(&pixels) else {
                return Err(wrong("of a type that is not read".to_owned()));
            };
            let kind = (width as usize, height as usize, code);
            let first = *self.kind.get_or_insert(kind);
            if kind != first {
                let [found, first] = [kind, first].map(|(width, height, code)| {
                    format!("{width} x {height} numbers of type {code}")
                });
                return Err(TiffError::Unlike { file, slice, found, first });
            }
            self.slices += 1;
            if !decoder.more_images() {
                return match described {
                    Some(slices) => Err(TiffError::Bundled { file, slices }),
                    None => Ok(()),
                };
            }
            slice += 1;
            decoder.next_image().map_err(|error| undecoded(slice, error))?;
        }
    }

    /// Errors if there is no memory for another slice of this size, of two bytes a number, say, and for what it is decoded from.
    fn has_room(
        &self,
        file: &str,
        slice: usize,
        (width, height): (u32, u32),
    ) -> Result<(), TiffError> {
        let more = 4 * u64::from(width) * u64::from(height);
        // The numbers are moved once, behind a header.
        let most = self.values.len() as u64 + more;
        match machine::available() {
            Some(left) if left.bytes < most => Err(TiffError::Memory {
                file: file.to_owned(),
                slice,
                mib: most as f64 / input::MIB as f64,
                limit: left.limit,
            }),
            _ => Ok(()),
        }
    }

    /// Adds the numbers of a slice, least significant byte first, and says of what type they are.
    fn add(&mut self, pixels: &DecodingResult) -> Option<&'static str> {
        let values = &mut self.values;
        Some(match pixels {
            DecodingResult::U8(all) => {
                values.extend_from_slice(all);
                "|u1"
            }
            DecodingResult::I8(all) => {
                values.extend(all.iter().flat_map(|one| one.to_le_bytes()));
                "|i1"
            }
            DecodingResult::U16(all) => {
                values.extend(all.iter().flat_map(|one| one.to_le_bytes()));
                "<u2"
            }
            DecodingResult::I16(all) => {
                values.extend(all.iter().flat_map(|one| one.to_le_bytes()));
                "<i2"
            }
            DecodingResult::U32(all) => {
                values.extend(all.iter().flat_map(|one| one.to_le_bytes()));
                "<u4"
            }
            DecodingResult::I32(all) => {
                values.extend(all.iter().flat_map(|one| one.to_le_bytes()));
                "<i4"
            }
            DecodingResult::F32(all) => {
                values.extend(all.iter().flat_map(|one| one.to_le_bytes()));
                "<f4"
            }
            DecodingResult::F64(all) => {
                values.extend(all.iter().flat_map(|one| one.to_le_bytes()));
                "<f8"
            }
            _ => return None,
        })
    }
}
