//! Whether triangles are a closed surface: each edge has a triangle on either side, neighbours face the same way, and no two
//! triangles cross.

use std::collections::HashMap;

use psmrt_reference::lattice::Vec3;
use thiserror::Error;

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

/// Errors unless it is closed and does not cross itself.
pub(super) fn check(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let count = triangles.len();
    if count == 0 {
        return Err(MeshError::Empty);
    }
    if count >= 1 << 31 {
        return Err(MeshError::TooMany { count });
    }
    edges(vertices, triangles)?;
    crossings(vertices, triangles)
}

/// Each edge must be run along as often one way as the other. (More than once each way: parts that touch there.)
fn edges(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    // By its ends, the smaller number first: how often it is run along upward less downward, and the triangles that do.
    let mut known: HashMap<[u32; 2], (i32, [Option<usize>; 2])> = HashMap::new();
    for (number, &[a, b, c]) in triangles.iter().enumerate() {
        if a == b || b == c || c == a {
            continue; // a line, which joins its neighbours: it has nothing inside
        }
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let (sign, ends) = if from < to { (1, [from, to]) } else { (-1, [to, from]) };
            let (sum, by) = known.entry(ends).or_default();
            *sum += sign;
            let way = usize::from(sign < 0);
            if by[way].is_some() && by[1 - way].is_none() && sum.abs() == 2 {
                let first = by[way].unwrap_or(number);
                return Err(MeshError::TurnedOver { first, second: number });
            }
            by[way] = Some(number);
        }
    }
    let mut open: Vec<_> = known.into_iter().filter(|(_, (sum, _))| *sum != 0).collect();
    open.sort_by_key(|(_, (_, by))| by.iter().flatten().min().copied());
    let Some(([low, high], (sum, by))) = open.first() else { return Ok(()) };
    let [low, high] = [low, high].map(|&n| <[f64; 3]>::from(vertices[n as usize]));
    let (way, [from, to]) = if *sum > 0 { (0, [low, high]) } else { (1, [high, low]) };
    Err(MeshError::Open { triangle: by[way].unwrap_or(0), from, to })
}

/// Triangles without a common corner must not cross. Boxes of space, about as large as triangles are, tell which are near.
fn crossings(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let of_triangle = |triangle: &[u32; 3]| triangle.map(|n| vertices[n as usize]);
    let corners: Vec<[Vec3; 3]> = triangles.iter().map(of_triangle).collect();
    let first = [vertices[0]; 2];
    let [low, high] = vertices.iter().fold(first, |[low, high], v| [low.inf(v), high.sup(v)]);
    let edges = corners.iter().map(|[a, b, c]| (b - a).norm().max((c - a).norm()));
    let mean = edges.sum::<f64>() / corners.len() as f64;
    // No more boxes along an axis than a thousand.
    let side = mean.max((high - low).amax() / 1000.0).max(f64::MIN_POSITIVE);
    let place = |v: &Vec3| {
        #[expect(clippy::cast_possible_truncation, reason = "at most a thousand")]
        <[f64; 3]>::from((v - low) / side).map(|x| x.floor() as i32)
    };
    let mut boxes: HashMap<[i32; 3], Vec<usize>> = HashMap::new();
    for (number, [a, b, c]) in corners.iter().enumerate() {
        let [first, last] = [place(&a.inf(b).inf(c)), place(&a.sup(b).sup(c))];
        for x in first[0]..=last[0] {
            for y in first[1]..=last[1] {
                for z in first[2]..=last[2] {
                    let near = boxes.entry([x, y, z]).or_default();
                    for &other in near.iter() {
                        if cross(triangles, &corners, other, number) {
                            return Err(MeshError::Crossing { first: other, second: number });
                        }
                    }
                    near.push(number);
                }
            }
        }
    }
    Ok(())
}

/// Whether an edge of one goes through the inside of the other; not of neighbours, which share a corner.
fn cross(triangles: &[[u32; 3]], corners: &[[Vec3; 3]], one: usize, other: usize) -> bool {
    let [first, second] = [one, other].map(|n| triangles[n]);
    if first.iter().any(|corner| second.contains(corner)) {
        return false;
    }
    let [first, second] = [one, other].map(|n| &corners[n]);
    let edges = |[a, b, c]: &[Vec3; 3]| [[*a, *b], [*b, *c], [*c, *a]];
    edges(first).iter().any(|edge| goes_through(edge, second))
        || edges(second).iter().any(|edge| goes_through(edge, first))
}

/// Whether a line from `p` to `q` goes through the inside of a triangle.
fn goes_through([p, q]: &[Vec3; 2], [a, b, c]: &[Vec3; 3]) -> bool {
    let volume = |u: &Vec3, v: &Vec3, w: &Vec3, x: &Vec3| (v - u).dot(&(w - u).cross(&(x - u)));
    // The ends lie on different sides of the plane, and the line passes the three edges on the same side.
    if volume(a, b, c, p) * volume(a, b, c, q) >= 0.0 {
        return false;
    }
    let [at_ab, at_bc, at_ca] = [[a, b], [b, c], [c, a]].map(|[u, v]| volume(p, q, u, v));
    at_ab * at_bc > 0.0 && at_bc * at_ca > 0.0
}
