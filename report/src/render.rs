//! From a figure to SVG.

use plotters::style::text_anchor::HPos;

use crate::canvas::{Canvas, Font, Pen};
use crate::error::PlotError;
use crate::figure::{Figure, Panel};
use crate::layout::{
    Frame, GAP, LABEL, LEADING, Layout, MARGIN, NOTE, Outside, Point, Rect, TICK, TICK_MARK, TITLE,
    X_TICKS, stack,
};
use crate::legend::Legend;
use crate::look::{Look, looks};
use crate::palette::{FAINT_GRID, FAINT_INK, GRID, INK, ZERO};
use crate::span::Span;
use crate::{check, clip, marks, notes, text};

/// Draws a figure as one self-contained SVG. The same figure gives the same bytes.
///
/// # Errors
/// A series that is empty, not finite, or not positive on a log axis; a range that its axis
/// cannot show; a size without room for the plot.
pub fn render_svg(figure: &Figure) -> Result<String, PlotError> {
    check::figure(figure)?;
    let (x, ys) = spans(figure)?;
    let notes = notes::all(figure, &x, &ys);
    let looks = looks(figure);
    let legends = Legend::all(figure, &looks);
    let (layout, places) = arrange(figure, (x, &ys), &notes, &legends)?;
    Canvas::svg(layout.size, |canvas| {
        texts(canvas, &layout)?;
        let lowest = layout.frames.len() - 1;
        for (i, frame) in layout.frames.iter().enumerate() {
            axes(canvas, frame, i == lowest)?;
            data(canvas, frame, &figure.panels[i], &looks[i])?;
            legends[i].draw(canvas, places[i])?;
        }
        Ok(())
    })
}

/// The shown range of the shared x axis, and of each y axis.
fn spans(figure: &Figure) -> Result<(Span, Vec<Span>), PlotError> {
    let all = || figure.panels.iter().flat_map(|panel| &panel.series);
    let xs: Vec<f64> = all().flat_map(|s| s.points.iter().map(|p| p.0)).collect();
    let ys = figure.panels.iter().map(|panel| {
        let values: Vec<f64> = panel.series.iter().flat_map(|s| s.reach(panel.y.scale)).collect();
        Span::of(&panel.y, &values)
    });
    Ok((Span::of(&figure.x, &xs)?, ys.collect::<Result<_, _>>()?))
}

/// The layout, and the top left of each panel's legend: inside its frame if all legends find an
/// empty place there, and otherwise all in a column at the right.
fn arrange(
    figure: &Figure,
    spans: (Span, &[Span]),
    notes: &[String],
    legends: &[Legend],
) -> Result<(Layout, Vec<Point>), PlotError> {
    let layout = Layout::new(figure, spans, notes, Outside::default())?;
    let all = layout.frames.iter().zip(&figure.panels).zip(legends);
    let inside = all.map(|((frame, panel), legend)| legend.inside(frame, panel));
    if let Some(places) = inside.collect() {
        return Ok((layout, places));
    }
    let top = layout.frames.first().map_or(0.0, |frame| frame.rect.top);
    let width = legends.iter().map(|legend| legend.width).fold(0.0, f64::max) + GAP;
    let height = top + legends.iter().map(|legend| legend.height + GAP).sum::<f64>();
    let layout = Layout::new(figure, spans, notes, Outside { width, height })?;
    let left = layout.frames.first().map_or(0.0, |frame| frame.rect.right) + 2.0 * GAP;
    let mut next = top;
    let below = legends.iter().map(|legend| {
        let place = (left, next);
        next += if legend.is_empty() { 0.0 } else { legend.height + GAP };
        place
    });
    let places = below.collect();
    Ok((layout, places))
}

/// Title, x label and notes.
fn texts(canvas: &Canvas, layout: &Layout) -> Result<(), PlotError> {
    let (width, height) = layout.size;
    let title = Font::new(TITLE, INK).bold();
    lines(canvas, &layout.title, (width / 2.0, MARGIN), title)?;
    let note = Font::new(NOTE, FAINT_INK).across(HPos::Left);
    let notes_top = height - GAP - stack(&layout.notes, NOTE);
    lines(canvas, &layout.notes, (MARGIN, notes_top), note)?;
    if let Some(Frame { rect, .. }) = layout.frames.last() {
        let middle = (rect.left + rect.right) / 2.0;
        lines(canvas, &layout.x_label, (middle, rect.bottom + X_TICKS), Font::new(LABEL, INK))?;
    }
    Ok(())
}

/// Lines of text from a top down.
fn lines(canvas: &Canvas, lines: &[String], top: Point, font: Font) -> Result<(), PlotError> {
    let leading = LEADING * font.size;
    let mut y = top.1 + leading / 2.0;
    for line in lines {
        canvas.text(line, (top.0, y), font)?;
        y += leading;
    }
    Ok(())
}

/// Grid, frame, ticks and labels of one panel.
fn axes(canvas: &Canvas, frame: &Frame, lowest: bool) -> Result<(), PlotError> {
    let Rect { left, top, right, bottom } = frame.rect;
    let upright = |x: f64, colour| canvas.path(&[(x, top), (x, bottom)], Pen::solid(colour, 1.0));
    let level = |y: f64, colour| canvas.path(&[(left, y), (right, y)], Pen::solid(colour, 1.0));
    for x in &frame.x_ticks.minor {
        upright(frame.across(*x), FAINT_GRID)?;
    }
    for y in &frame.y_ticks.minor {
        level(frame.down(*y), FAINT_GRID)?;
    }
    for (x, _) in &frame.x_ticks.major {
        upright(frame.across(*x), GRID)?;
    }
    for (y, _) in &frame.y_ticks.major {
        level(frame.down(*y), if *y == 0.0 { ZERO } else { GRID })?;
    }

    let ink = Pen::solid(INK, 1.0);
    let font = Font::new(TICK, INK);
    let mut taken = f64::NEG_INFINITY;
    for (x, label) in &frame.x_ticks.major {
        let x = frame.across(*x);
        canvas.path(&[(x, bottom), (x, bottom + TICK_MARK)], ink)?;
        let half = text::width(label, TICK) / 2.0;
        if lowest && x - half > taken {
            canvas.text(label, (x, bottom + TICK_MARK + 0.75 * TICK), font)?;
            taken = x + half + 4.0;
        }
    }
    let mut taken = f64::INFINITY;
    for (y, label) in &frame.y_ticks.major {
        let y = frame.down(*y);
        canvas.path(&[(left - TICK_MARK, y), (left, y)], ink)?;
        if y < taken {
            let place = (left - TICK_MARK - 4.0, y);
            canvas.text(label, place, font.across(HPos::Right))?;
            taken = y - TICK;
        }
    }
    canvas.path(&[(left, top), (right, top), (right, bottom), (left, bottom), (left, top)], ink)?;

    let mut x = MARGIN + LEADING * LABEL / 2.0;
    for line in &frame.y_label {
        canvas.text(line, (x, (top + bottom) / 2.0), Font::new(LABEL, INK).upright())?;
        x += LEADING * LABEL;
    }
    Ok(())
}

/// Lines first, so that points lie on them.
fn data(canvas: &Canvas, frame: &Frame, panel: &Panel, looks: &[Look]) -> Result<(), PlotError> {
    for (series, look) in panel.series.iter().zip(looks) {
        let Some(dash) = look.line else { continue };
        let places: Vec<_> = series.points.iter().map(|p| frame.place(*p)).collect();
        for piece in clip::path(&places, &frame.rect) {
            canvas.path(&piece, Pen { colour: look.colour, width: look.width, dash })?;
        }
    }
    for (series, look) in panel.series.iter().zip(looks) {
        for ((x, y), error) in series.points.iter().zip(series.errors.iter().flatten()) {
            let ends = (frame.down(y - error), frame.down(y + error));
            marks::error_bar(canvas, frame.across(*x), ends, &frame.rect, look)?;
        }
        for (x, y) in &series.points {
            if frame.x.contains(*x) && frame.y.contains(*y) {
                marks::point(canvas, frame.place((*x, *y)), look)?;
            }
        }
    }
    Ok(())
}
