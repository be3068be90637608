//! Bodies of any shape: closed surfaces of triangles, from STL files or made by a formula, and the exact part of each cell
//! that they fill.
//!
//! | file | what it does |
//! |---|---|
//! | `mesh.rs` | [`Mesh`](mesh::Mesh): a closed surface of triangles; volume, middle, bounds |
//! | `closed.rs` | whether triangles are such a surface: no hole, none turned over, none that cross |
//! | `tree.rs` | which triangles may touch |
//! | `stl.rs` | reading STL files |
//! | `formula.rs` | boxes, cylinders, pipes and half-spaces as meshes |
//! | `shares.rs` | the share of each cell that a mesh fills, exactly |
//! | `filled.rs` | which solids fill which cells, so that no two fill the same |
//! | `pose.rs` | where a body is and how it is turned |
//! | `moving.rs` | bodies that move as prescribed |

pub mod closed;
pub mod filled;
pub mod formula;
pub mod mesh;
pub mod moving;
pub mod pose;
pub mod shares;
pub mod stl;
mod tree;
