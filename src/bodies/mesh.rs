//! A closed surface of triangles.

use psmrt_reference::lattice::Vec3;
use thiserror::Error;

use super::closed;

/// A closed surface of triangles that face outward: counter-clockwise, seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

/// Triangles that are no closed surface. Triangles are counted from 0, in the order in which they are given.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshError {
    /// None.
    #[error("it has no triangles")]
    Empty,
    /// Too many to be counted.
    #[error("it has {count} triangles; fewer than 2^31 are read")]
    TooMany {
        /// How many.
        count: usize,
    },
    /// An edge with a triangle on one side only.
    #[error(
        "it has a hole: no triangle joins triangle {triangle} (from 0) along its edge from {from:?} to {to:?}"
    )]
    Open {
        /// The triangle on the one side.
        triangle: usize,
        /// Begin of the edge.
        from: [f64; 3],
        /// End of the edge.
        to: [f64; 3],
    },
    /// Neighbours of which one faces inward.
    #[error(
        "triangles {first} and {second} (from 0) run along the edge that they share in the same direction: one of them is turned over"
    )]
    TurnedOver {
        /// One.
        first: usize,
        /// The other.
        second: usize,
    },
    /// All face inward.
    #[error("its triangles face inward: it has a volume of {volume:.4e} of its cubic units")]
    InsideOut {
        /// The volume.
        volume: f64,
    },
    /// Triangles that cross.
    #[error("triangles {first} and {second} (from 0) cross each other")]
    Crossing {
        /// One.
        first: usize,
        /// The other.
        second: usize,
    },
}

impl Mesh {
    /// A surface. Errors, with the triangle, unless it is closed, faces outward and does not cross itself.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        let mesh = Mesh { vertices, triangles };
        closed::check(&mesh)?;
        let volume = mesh.volume();
        if volume.is_nan() || volume <= 0.0 {
            return Err(MeshError::InsideOut { volume });
        }
        Ok(mesh)
    }

    /// One that is known to be closed.
    pub(super) fn known(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        Mesh { vertices, triangles }
    }

    /// The corners.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// The triangles, by the numbers of their corners.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of each triangle.
    pub fn corners(&self) -> impl Iterator<Item = [Vec3; 3]> {
        self.triangles.iter().map(|triangle| triangle.map(|n| self.vertices[n as usize]))
    }

    /// The same with each corner moved.
    pub fn mapped(&self, to: impl Fn(&Vec3) -> Vec3) -> Self {
        Mesh { vertices: self.vertices.iter().map(to).collect(), triangles: self.triangles.clone() }
    }

    /// Volume.
    pub fn volume(&self) -> f64 {
        // V = 1/6 Σ (a - o)·(b - o) × (c - o), by tetrahedra about a point near by
        let o = self.vertices[0];
        let six = |[a, b, c]: [Vec3; 3]| (a - o).dot(&(b - o).cross(&(c - o)));
        self.corners().map(six).sum::<f64>() / 6.0
    }

    /// Centre of its volume.
    pub fn middle(&self) -> Vec3 {
        let o = self.vertices[0];
        let (mut six, mut moment) = (0.0, Vec3::zeros());
        for corners in self.corners() {
            let [a, b, c] = corners.map(|corner| corner - o);
            let volume = a.dot(&b.cross(&c));
            six += volume;
            // The middle of a tetrahedron is the mean of its corners.
            moment += volume / 4.0 * (a + b + c);
        }
        o + moment / six
    }

    /// The corners, lowest and highest, of the box along the axes that just holds it.
    pub fn bounds(&self) -> [Vec3; 2] {
        let first = [self.vertices[0]; 2];
        self.vertices.iter().fold(first, |[low, high], v| [low.inf(v), high.sup(v)])
    }

    /// The largest distance of a corner from a point.
    pub fn reach(&self, from: &Vec3) -> f64 {
        self.vertices.iter().map(|vertex| (vertex - from).norm()).fold(0.0, f64::max)
    }
}
