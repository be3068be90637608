//! Reading STL files, text or binary.

use std::collections::HashMap;
use std::io::Cursor;

use psmrt_reference::lattice::Vec3;
use thiserror::Error;

use super::closed::MeshError;
use super::mesh::Mesh;

/// Bytes before the triangles of a binary file: a comment and their number.
const HEAD: usize = 84;
const COMMENT: usize = 80;

/// Bytes of a triangle.
const TRIANGLE: usize = 50;

/// An STL file that cannot be used.
#[derive(Debug, Error)]
pub enum StlError {
    /// It is none.
    #[error("it is no STL file, or is damaged: {0}")]
    Format(#[from] std::io::Error),
    /// A corner that is nowhere.
    #[error("triangle {triangle} (from 0) has a corner at {corner:?}")]
    NotFinite {
        /// The triangle.
        triangle: usize,
        /// Its corner.
        corner: [f32; 3],
    },
    /// Its triangles are no closed surface.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// The surface in an STL file, in the units of the file. Corners with the same coordinates are one. Errors unless it is closed,
/// faces outward and does not cross itself.
pub fn mesh(mut bytes: Vec<u8>) -> Result<Mesh, StlError> {
    // Some programs begin binary files with the word that texts begin with: the length tells which it is.
    if let Some(count) = bytes.get(COMMENT..HEAD).and_then(|four| <[u8; 4]>::try_from(four).ok()) {
        let triangles = u64::from(u32::from_le_bytes(count));
        if bytes.len() as u64 == HEAD as u64 + triangles * TRIANGLE as u64 {
            bytes[..COMMENT].fill(0);
        }
    }
    let mut from = Cursor::new(bytes);
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let mut known = HashMap::new();
    for (number, triangle) in stl_io::create_stl_reader(&mut from)?.enumerate() {
        let mut of_triangle = [0; 3];
        for (corner, place) in of_triangle.iter_mut().zip(triangle?.vertices) {
            // -0 is 0.
            let place = <[f32; 3]>::from(place).map(|x| x + 0.0);
            if place.iter().any(|x| !x.is_finite()) {
                return Err(StlError::NotFinite { triangle: number, corner: place });
            }
            *corner = *known.entry(place.map(f32::to_bits)).or_insert_with(|| {
                vertices.push(Vec3::from(place.map(f64::from)));
                // Three of each triangle at most, and fewer than 2^31 of those are taken.
                u32::try_from(vertices.len() - 1).unwrap_or(u32::MAX)
            });
        }
        triangles.push(of_triangle);
    }
    Ok(Mesh::new(vertices, triangles)?)
}
