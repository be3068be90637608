//! Lines cut at the frame.

use crate::layout::{Point, Rect};

/// The pieces of a path that lie in the rectangle. Steps too small to see are merged, so that a
/// record of a million rows does not become a million vertices.
pub(crate) fn path(points: &[Point], rect: &Rect) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut kept = Vec::<Point>::new();
    for (i, &point) in points.iter().enumerate() {
        let last = i + 1 == points.len();
        if last || kept.last().is_none_or(|k| far(*k, point)) {
            kept.push(point);
        }
    }
    for pair in kept.windows(2) {
        let Some((from, to)) = segment(pair[0], pair[1], rect) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

fn far(a: Point, b: Point) -> bool {
    (a.0 - b.0).abs() > 0.1 || (a.1 - b.1).abs() > 0.1
}

/// The part of a segment in the rectangle (Liang and Barsky 1984).
fn segment(from: Point, to: Point, rect: &Rect) -> Option<(Point, Point)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let edges = [
        (-dx, from.0 - rect.left),
        (dx, rect.right - from.0),
        (-dy, from.1 - rect.top),
        (dy, rect.bottom - from.1),
    ];
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (towards, room) in edges {
        if towards == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if towards < 0.0 {
            enter = enter.max(room / towards);
        } else {
            leave = leave.min(room / towards);
        }
    }
    let at = |t: f64| match t {
        0.0 => from,
        1.0 => to,
        t => (from.0 + t * dx, from.1 + t * dy),
    };
    (enter <= leave).then(|| (at(enter), at(leave)))
}
