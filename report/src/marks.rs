//! Markers, error bars and samples of lines.

use crate::canvas::{Canvas, Pen};
use crate::error::PlotError;
use crate::layout::{Point, Rect};
use crate::look::Look;
use crate::palette::PAPER;
use crate::series::Marker;

/// Half the width of a marker, in pixels.
pub(crate) const MARKER: f64 = 4.5;

/// A point of a series. A thin white rim keeps it apart from lines and from its neighbours.
pub(crate) fn point(canvas: &Canvas, centre: Point, look: &Look) -> Result<(), PlotError> {
    let Some(marker) = look.marker else { return Ok(()) };
    let rim = 0.9;
    match marker {
        Marker::Circle => {
            canvas.disc(centre, MARKER + rim, PAPER)?;
            canvas.disc(centre, MARKER, look.colour)
        }
        Marker::Ring => {
            canvas.disc(centre, MARKER + rim, PAPER)?;
            canvas.disc(centre, MARKER, look.colour)?;
            canvas.disc(centre, MARKER - 1.8, PAPER)
        }
        Marker::Cross => {
            let stroke = |dx, dy| [(centre.0 - dx, centre.1 - dy), (centre.0 + dx, centre.1 + dy)];
            let strokes = [stroke(MARKER, MARKER), stroke(-MARKER, MARKER)];
            for (colour, width) in [(PAPER, 2.2 + 2.0 * rim), (look.colour, 2.2)] {
                for stroke in &strokes {
                    canvas.path(stroke, Pen::solid(colour, width))?;
                }
            }
            Ok(())
        }
        Marker::Halo => canvas.circle(centre, MARKER + 3.0, Pen::solid(look.colour, 1.4)),
        _ => {
            let corners = |r: f64| -> Vec<Point> {
                let outline = outline(marker).iter();
                outline.map(|(dx, dy)| (centre.0 + r * dx, centre.1 + r * dy)).collect()
            };
            canvas.polygon(&corners(MARKER), look.colour)?;
            let mut around = corners(MARKER + 0.6);
            around.extend(around.first().copied());
            canvas.path(&around, Pen::solid(PAPER, rim))
        }
    }
}

/// The corners of a marker of half width 1; areas are about those of the unit disc.
fn outline(marker: Marker) -> &'static [Point] {
    match marker {
        Marker::TriangleUp => &[(0.0, -1.3), (1.2, 0.85), (-1.2, 0.85)],
        Marker::TriangleDown => &[(0.0, 1.3), (1.2, -0.85), (-1.2, -0.85)],
        Marker::Diamond => &[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)],
        _ => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
    }
}

/// A vertical error bar between two heights, cut at the frame, with a cap where it is not.
pub(crate) fn error_bar(
    canvas: &Canvas,
    x: f64,
    (low, high): (f64, f64),
    frame: &Rect,
    look: &Look,
) -> Result<(), PlotError> {
    if x < frame.left || x > frame.right || low < frame.top || high > frame.bottom {
        return Ok(());
    }
    let pen = Pen::solid(look.colour, 1.3);
    canvas.path(&[(x, low.min(frame.bottom)), (x, high.max(frame.top))], pen)?;
    for y in [low, high] {
        if (frame.top..=frame.bottom).contains(&y) {
            canvas.path(&[(x - 3.5, y), (x + 3.5, y)], pen)?;
        }
    }
    Ok(())
}

/// What stands for a series in the legend: a piece of its line, its marker, its error bar.
pub(crate) fn sample(
    canvas: &Canvas,
    left: Point,
    length: f64,
    look: &Look,
    errors: bool,
) -> Result<(), PlotError> {
    let middle = (left.0 + length / 2.0, left.1);
    if let Some(dash) = look.line {
        let pen = Pen { colour: look.colour, width: look.width, dash };
        canvas.path(&[left, (left.0 + length, left.1)], pen)?;
    }
    if errors {
        let all = Rect { left: 0.0, top: 0.0, right: f64::MAX, bottom: f64::MAX };
        error_bar(canvas, middle.0, (left.1 + 8.0, left.1 - 8.0), &all, look)?;
    }
    point(canvas, middle, look)
}
