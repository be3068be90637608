//! The keys of an image of solids.

use schemars::JsonSchema;
use serde::Deserialize;

use super::format_run::AxisName;
use super::triple::Triple;

/// An image of solids, voxel by voxel: a segmented or a grey CT scan. The solid fraction of a cell is the exact share of the
/// solid voxels in it, however voxels and cells lie to each other; a grid coarser than the image keeps what it can of it. Say
/// what is solid by exactly one of `solid`, `solid_above` and `grey`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImageSection {
    /// The file, relative to the scene: a NumPy array (`.npy`) of three axes, a TIFF stack (`.tif`, `.tiff`), a folder of TIFF
    /// slices in the order of the numbers in their names, or bare numbers in any other file, with `shape` and `numbers`.
    pub file: String,
    /// Edge of a voxel, m.
    pub voxel: f64,
    /// Numbers of the voxels that are solid.
    pub solid: Option<Vec<f64>>,
    /// Voxels with larger numbers are solid.
    pub solid_above: Option<f64>,
    /// The numbers of a voxel without solid and of one that is all solid; in between the solid share follows the number in
    /// proportion.
    pub grey: Option<[f64; 2]>,
    /// In which order an array has its axes: `zyx` (the default: `image[k, j, i]`, as a stack of slices and as the fields that a
    /// run writes) or `xyz` (`image[i, j, k]`). Not with TIFF files, whose slices follow z and whose rows follow y.
    pub axes: Option<AxisOrderName>,
    /// The first voxel along x, y, z that is used, from 0; the first of all where absent.
    pub crop_from: Option<[i64; 3]>,
    /// The first voxel along x, y, z that is no longer used; behind the last of all where absent.
    pub crop_to: Option<[i64; 3]>,
    /// Axes along which the mirror image is put behind the image, so that its ends fit to each other in a periodic domain.
    pub mirror: Option<Vec<AxisName>>,
    /// Where the lowest corner of the image lies, m; the domain's where absent.
    pub corner: Option<Triple>,
    /// With bare numbers: how many along x, y, z.
    pub shape: Option<[i64; 3]>,
    /// With bare numbers: their type.
    pub numbers: Option<NumberName>,
    /// With bare numbers: `little` (the default) or `big`, the end of a number that stands first.
    pub byte_order: Option<ByteOrderName>,
    /// With bare numbers: bytes before the first one; 0 where absent.
    pub header_bytes: Option<i64>,
}

/// The order of the axes of an array.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum AxisOrderName {
    /// x runs fastest in C order.
    Zyx,
    /// z runs fastest in C order.
    Xyz,
}

/// A type of number.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum NumberName {
    /// 8 bits, from 0.
    U8,
    /// 8 bits, with a sign.
    I8,
    /// 16 bits, from 0.
    U16,
    /// 16 bits, with a sign.
    I16,
    /// 32 bits, from 0.
    U32,
    /// 32 bits, with a sign.
    I32,
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

impl NumberName {
    /// As scenes spell it.
    pub fn word(self) -> &'static str {
        match self {
            NumberName::U8 => "u8",
            NumberName::I8 => "i8",
            NumberName::U16 => "u16",
            NumberName::I16 => "i16",
            NumberName::U32 => "u32",
            NumberName::I32 => "i32",
            NumberName::F32 => "f32",
            NumberName::F64 => "f64",
        }
    }
}

/// Which end of a number stands first.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum ByteOrderName {
    /// The least significant byte.
    Little,
    /// The most significant byte.
    Big,
}
