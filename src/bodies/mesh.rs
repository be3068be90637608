//! A closed surface of triangles.

use std::sync::Arc;

use psmrt_reference::lattice::Vec3;

use super::closed::{self, MeshError};

/// A closed surface of triangles that face outward: counter-clockwise, seen from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    vertices: Vec<Vec3>,
    triangles: Arc<[[u32; 3]]>,
}

impl Mesh {
    /// A surface. Errors, with the triangle, unless it is closed, faces outward and does not cross itself.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        closed::check(&vertices, &triangles)?;
        let mesh = Mesh { vertices, triangles: triangles.into() };
        let volume = mesh.volume();
        if volume.is_nan() || volume <= 0.0 {
            return Err(MeshError::InsideOut { volume });
        }
        Ok(mesh)
    }

    /// One that is known to be closed.
    pub(super) fn known(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        Mesh { vertices, triangles: triangles.into() }
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
        Mesh {
            vertices: self.vertices.iter().map(to).collect(),
            triangles: Arc::clone(&self.triangles),
        }
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
