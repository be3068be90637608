//! Whether triangles are a closed surface: each edge has a triangle on either side, neighbours face the same way, and no two
//! triangles cross.

use std::collections::HashMap;

use psmrt_reference::lattice::Vec3;
use thiserror::Error;

use super::tree::Tree;

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
    /// A triangle that is there twice.
    #[error(
        "triangles {first} and {second} (from 0) have the same corners: all or a part of the surface is there twice"
    )]
    Twice {
        /// One.
        first: usize,
        /// The other.
        second: usize,
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
    copies(triangles)?;
    crossings(vertices, triangles)
}

/// The triangles that run along an edge, upward and downward by the numbers of its ends: how many, and the first two.
#[derive(Default)]
struct Sides {
    counts: [u32; 2],
    first: [[Option<usize>; 2]; 2],
}

/// Each edge must be run along as often one way as the other. (More than once each way: parts that touch there.)
fn edges(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut known: HashMap<[u32; 2], Sides> = HashMap::new();
    for (number, &[a, b, c]) in triangles.iter().enumerate() {
        if a == b || b == c || c == a {
            continue; // a line, which joins its neighbours: it has nothing inside
        }
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let (way, ends) = if from < to { (0, [from, to]) } else { (1, [to, from]) };
            let sides = known.entry(ends).or_default();
            if let Some(place) = sides.first[way].get_mut(sides.counts[way] as usize) {
                *place = Some(number);
            }
            sides.counts[way] += 1;
        }
    }
    let bad = known.into_iter().filter(|(_, sides)| sides.counts[0] != sides.counts[1]);
    // The first of the triangles, so that the message is the same each time.
    let least = |sides: &Sides| sides.first.as_flattened().iter().flatten().min().copied();
    let Some((ends, sides)) = bad.min_by_key(|(_, sides)| least(sides)) else { return Ok(()) };
    let way = usize::from(sides.counts[1] > sides.counts[0]);
    if let ([Some(first), Some(second)], 0) = (sides.first[way], sides.counts[1 - way]) {
        return Err(MeshError::TurnedOver { first, second });
    }
    let [low, high] = ends.map(|n| <[f64; 3]>::from(vertices[n as usize]));
    let [from, to] = if way == 0 { [low, high] } else { [high, low] };
    Err(MeshError::Open { triangle: sides.first[way][0].unwrap_or(0), from, to })
}

/// No two triangles may be the same.
fn copies(triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut known = HashMap::new();
    for (second, triangle) in triangles.iter().enumerate() {
        let mut corners = *triangle;
        corners.sort_unstable();
        if corners[0] == corners[1] || corners[1] == corners[2] {
            continue;
        }
        if let Some(first) = known.insert(corners, second) {
            return Err(MeshError::Twice { first, second });
        }
    }
    Ok(())
}

/// Triangles without a common corner must not cross.
fn crossings(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let of_triangle = |triangle: &[u32; 3]| triangle.map(|n| vertices[n as usize]);
    let corners: Vec<[Vec3; 3]> = triangles.iter().map(of_triangle).collect();
    let found = Tree::of(&corners).first_pair(|one, other| cross(triangles, &corners, one, other));
    match found {
        Some([one, other]) => {
            Err(MeshError::Crossing { first: one.min(other), second: one.max(other) })
        }
        None => Ok(()),
    }
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
