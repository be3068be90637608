//! Images of solids, voxel by voxel: segmented CT scans, or grey ones.
//!
//! | file | what it does |
//! |---|---|
//! | `image.rs` | the numbers of an image, as they stand in the file |
//! | `tiff.rs` | images that are TIFF files |
//! | `phase.rs` | which numbers are solid, and how much |
//! | `body.rs` | the part of an image that is used, cropped and mirrored |
//! | `shares.rs` | the share of each cell that is solid |
//! | `pores.rs` | whether the pores let fluid through |

pub mod body;
pub mod image;
pub mod phase;
pub mod pores;
pub mod shares;
mod tiff;
