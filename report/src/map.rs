//! Maps: one value per cell of a plane, as colours. Cells without a value (inside grains) are grey.

use std::f64::consts::TAU;

use plotters::style::RGBColor;
use plotters::style::text_anchor::HPos;

use crate::canvas::{Canvas, Font, Pen};
use crate::clip;
use crate::error::PlotError;
use crate::figure::Axis;
use crate::layout::{
    GAP, LABEL, LEADING, MARGIN, NOTE, Point, Rect, TICK, TICK_MARK, TITLE, X_TICKS,
};
use crate::palette::{FAINT_INK, INK, map_colour};
use crate::span::{Span, bad};
use crate::ticks::Ticks;

/// A map of a plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The line above it.
    pub title: String,
    /// The axis to the right; its range must be given.
    pub x: Axis,
    /// The axis upwards; its range must be given.
    pub y: Axis,
    /// What the colours measure, with its unit; its range follows from the values where `None`.
    pub value: Axis,
    /// Cells along x.
    pub columns: usize,
    /// Values, x first, from the lower left; grey where `None`.
    pub values: Vec<Option<f64>>,
    /// Outlines over the colours: x and y of the centre and the radius of each circle, in the units
    /// of the axes.
    pub circles: Vec<[f64; 3]>,
    /// A small line of text under the map.
    pub note: String,
}

/// The longer side of the plane, in pixels.
const LONGER: f64 = 520.0;
/// The shorter side is at least this long.
const SHORTEST: f64 = 60.0;
/// Width of the scale of colours, and room for its labels.
const SCALE: f64 = 16.0;
const SCALE_LABELS: f64 = 90.0;
/// Colours that are told apart.
const LEVELS: f64 = 63.0;
/// Neighbouring cells overlap by so much, lest the paper shine through between them.
const OVERLAP: f64 = 0.6;
const NO_VALUE: RGBColor = RGBColor(0x99, 0x99, 0x99);

/// Draws a map as one self-contained SVG.
///
/// # Errors
/// No values, or not a whole number of rows; a value that is not finite; an axis without a range.
pub fn render_map(map: &Map) -> Result<String, PlotError> {
    let rows = rows(map)?;
    let mut shown: Vec<f64> = map.values.iter().copied().flatten().collect();
    if shown.is_empty() {
        shown.push(0.0); // all grey; the scale has to show something
    }
    let (x, y, value) =
        (Span::of(&map.x, &[])?, Span::of(&map.y, &[])?, Span::of(&map.value, &shown)?);
    let (wide, high) = (x.high - x.low, y.high - y.low);
    let scale = LONGER / wide.max(high);
    let left = MARGIN + LEADING * LABEL + 55.0;
    let top = MARGIN + LEADING * TITLE + GAP;
    let rect = Rect {
        left,
        top,
        right: left + (scale * wide).max(SHORTEST),
        bottom: top + (scale * high).max(SHORTEST),
    };
    let title = crate::text::width(&map.title, TITLE) * 1.1 + 2.0 * MARGIN;
    let size = (
        (rect.right + 2.0 * GAP + SCALE + SCALE_LABELS).max(title).ceil(),
        (rect.bottom + X_TICKS + LEADING * LABEL + GAP + LEADING * NOTE + GAP).ceil(),
    );
    Canvas::svg(size, |canvas| {
        cells(canvas, map, rows, &rect, &value)?;
        circles(canvas, map, &rect, (&x, &y))?;
        axes(canvas, map, &rect, (&x, &y))?;
        colours(canvas, &map.value.label, &rect, &value)?;
        canvas.text(
            &map.title,
            (size.0 / 2.0, MARGIN + TITLE / 2.0),
            Font::new(TITLE, INK).bold(),
        )?;
        let note = Font::new(NOTE, FAINT_INK).across(HPos::Left);
        canvas.text(&map.note, (MARGIN, size.1 - GAP - NOTE / 2.0), note)
    })
}

fn rows(map: &Map) -> Result<usize, PlotError> {
    let count = map.values.len();
    if count == 0 || map.columns == 0 || !count.is_multiple_of(map.columns) {
        let reason = format!("{count} values do not fill rows of {}", map.columns);
        return Err(bad(&map.value, reason));
    }
    if let Some(value) = map.values.iter().flatten().find(|value| !value.is_finite()) {
        return Err(bad(&map.value, format!("the value {value} is not finite")));
    }
    match [&map.x, &map.y].into_iter().find(|axis| axis.range.is_none()) {
        Some(axis) => Err(bad(axis, "a map needs its range".into())),
        None => Ok(count / map.columns),
    }
}

/// The cells, neighbours of one colour in one piece.
fn cells(
    canvas: &Canvas,
    map: &Map,
    rows: usize,
    rect: &Rect,
    value: &Span,
) -> Result<(), PlotError> {
    let (dx, dy) = (rect.width() / map.columns as f64, rect.height() / rows as f64);
    let colour = |value_here: &Option<f64>| match value_here {
        Some(v) => map_colour((value.fraction(*v) * LEVELS).round() / LEVELS),
        None => NO_VALUE,
    };
    for (row, values) in map.values.chunks(map.columns).enumerate() {
        let bottom = rect.bottom - row as f64 * dy;
        let mut column = 0;
        for piece in values.chunk_by(|a, b| colour(a) == colour(b)) {
            let left = rect.left + column as f64 * dx;
            column += piece.len();
            let right = (rect.left + column as f64 * dx + OVERLAP).min(rect.right);
            let top = (bottom - dy - OVERLAP).max(rect.top);
            let corners = [(left, bottom), (right, bottom), (right, top), (left, top)];
            canvas.polygon(&corners, colour(&piece[0]))?;
        }
    }
    Ok(())
}

/// Corners of a circle.
const CORNERS: u8 = 72;

/// The outlines, cut at the frame.
fn circles(
    canvas: &Canvas,
    map: &Map,
    rect: &Rect,
    (x, y): (&Span, &Span),
) -> Result<(), PlotError> {
    for &[right, up, radius] in &map.circles {
        let corner = |number: u8| {
            let (sine, cosine) = (TAU * f64::from(number) / f64::from(CORNERS)).sin_cos();
            (
                rect.left + x.fraction(right + radius * cosine) * rect.width(),
                rect.bottom - y.fraction(up + radius * sine) * rect.height(),
            )
        };
        let points: Vec<Point> = (0..=CORNERS).map(corner).collect();
        if !points.iter().all(|point| point.0.is_finite() && point.1.is_finite()) {
            return Err(bad(&map.x, format!("the circle at ({right}, {up}) is not finite")));
        }
        for piece in clip::path(&points, rect) {
            canvas.path(&piece, Pen::solid(INK, 1.0))?;
        }
    }
    Ok(())
}

fn axes(canvas: &Canvas, map: &Map, rect: &Rect, (x, y): (&Span, &Span)) -> Result<(), PlotError> {
    let (ink, font) = (Pen::solid(INK, 1.0), Font::new(TICK, INK));
    for (at, label) in Ticks::round(x, (rect.width() / 90.0).max(2.0)).major {
        let at = rect.left + x.fraction(at) * rect.width();
        canvas.path(&[(at, rect.bottom), (at, rect.bottom + TICK_MARK)], ink)?;
        canvas.text(&label, (at, rect.bottom + TICK_MARK + 0.75 * TICK), font)?;
    }
    for (at, label) in Ticks::round(y, (rect.height() / 60.0).max(2.0)).major {
        let at = rect.bottom - y.fraction(at) * rect.height();
        canvas.path(&[(rect.left - TICK_MARK, at), (rect.left, at)], ink)?;
        canvas.text(&label, (rect.left - TICK_MARK - 4.0, at), font.across(HPos::Right))?;
    }
    frame(canvas, rect)?;
    let font = Font::new(LABEL, INK);
    let middle = ((rect.left + rect.right) / 2.0, (rect.top + rect.bottom) / 2.0);
    canvas.text(&map.x.label, (middle.0, rect.bottom + X_TICKS + LABEL / 2.0), font)?;
    canvas.text(&map.y.label, (MARGIN + LABEL / 2.0, middle.1), font.upright())
}

/// The scale of colours at the right.
fn colours(canvas: &Canvas, label: &str, rect: &Rect, value: &Span) -> Result<(), PlotError> {
    let bar = Rect { left: rect.right + 2.0 * GAP, right: rect.right + 2.0 * GAP + SCALE, ..*rect };
    let step = bar.height() / (LEVELS + 1.0);
    let mut level = 0.0;
    while level <= LEVELS {
        let bottom = bar.bottom - level * step;
        let top = (bottom - step - OVERLAP).max(bar.top);
        let corners = [(bar.left, bottom), (bar.right, bottom), (bar.right, top), (bar.left, top)];
        canvas.polygon(&corners, map_colour(level / LEVELS))?;
        level += 1.0;
    }
    frame(canvas, &bar)?;
    let font = Font::new(TICK, INK).across(HPos::Left);
    for (at, label) in Ticks::round(value, (bar.height() / 60.0).max(2.0)).major {
        let at = bar.bottom - value.fraction(at) * bar.height();
        canvas.path(&[(bar.right, at), (bar.right + TICK_MARK, at)], Pen::solid(INK, 1.0))?;
        canvas.text(&label, (bar.right + TICK_MARK + 4.0, at), font)?;
    }
    let middle = (bar.right + SCALE_LABELS - LABEL, (bar.top + bar.bottom) / 2.0);
    canvas.text(label, middle, Font::new(LABEL, INK).upright())
}

fn frame(canvas: &Canvas, rect: &Rect) -> Result<(), PlotError> {
    let Rect { left, top, right, bottom } = *rect;
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
    canvas.path(&corners, Pen::solid(INK, 1.0))
}
