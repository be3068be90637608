//! Surfaces of triangles for tests: balls, and STL files of them.

use psmrt::bodies::mesh::Mesh;
use psmrt_reference::lattice::Vec3;

/// A ball of 20·4^level triangles: an icosahedron, each triangle split in four `level` times, its corners on the sphere.
pub fn ball(radius: f64, level: u32) -> Mesh {
    let g = 0.5 * (1.0 + 5.0_f64.sqrt());
    let mut corners: Vec<Vec3> = Vec::new();
    for (one, golden) in [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)] {
        corners.push(Vec3::new(one, golden, 0.0));
    }
    for (one, golden) in [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)] {
        corners.push(Vec3::new(0.0, one, golden));
    }
    for (one, golden) in [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)] {
        corners.push(Vec3::new(golden, 0.0, one));
    }
    // Of all triples of corners those 2 apart from each other.
    let near = |a: usize, b: usize| ((corners[a] - corners[b]).norm() - 2.0).abs() < 1e-9;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let out = corners[a].dot(&corners[b].cross(&corners[c])) > 0.0;
                    triangles.push(if out { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..level {
        let mut halves = std::collections::HashMap::new();
        let mut split = Vec::new();
        for [a, b, c] in triangles {
            let mut half = |i: usize, j: usize| {
                *halves.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    corners.push(0.5 * (corners[i] + corners[j]));
                    corners.len() - 1
                })
            };
            let [ab, bc, ca] = [half(a, b), half(b, c), half(c, a)];
            split.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = split;
    }
    let corners = corners.iter().map(|corner| radius * corner.normalize()).collect();
    let number = |n: usize| u32::try_from(n).unwrap();
    Mesh::new(corners, triangles.into_iter().map(|one| one.map(number)).collect()).unwrap()
}

/// As STL files have it.
#[expect(clippy::cast_possible_truncation, reason = "rounded")]
fn single(corner: &Vec3) -> [f32; 3] {
    [corner.x as f32, corner.y as f32, corner.z as f32]
}

/// A text STL file.
pub fn ascii(mesh: &Mesh) -> String {
    let mut text = "solid test\n".to_owned();
    for corners in mesh.corners() {
        text += "facet normal 0 0 0\nouter loop\n";
        for corner in corners {
            let [x, y, z] = single(&corner);
            text += &format!("vertex {x:e} {y:e} {z:e}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid test\n"
}

/// A binary STL file.
pub fn binary(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(u32::try_from(mesh.triangles().len()).unwrap().to_le_bytes());
    for corners in mesh.corners() {
        bytes.extend([0; 12]);
        for corner in corners {
            single(&corner).iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}
