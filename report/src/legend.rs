//! The legend of a panel: in a corner that is empty, or else outside at the right.

use crate::canvas::{Canvas, Font, Pen};
use crate::error::PlotError;
use crate::figure::{Figure, Panel};
use crate::layout::{Frame, GAP, LEADING, Point, Rect};
use crate::look::Look;
use crate::marks;
use crate::palette::{GRID, INK, PAPER};
use crate::text;
use plotters::style::text_anchor::HPos;

const SIZE: f64 = 12.0;
const SAMPLE: f64 = 34.0;
const PADDING: f64 = 6.0;
/// Wider entries are broken into lines.
const WIDEST: f64 = 250.0;

/// One entry.
#[derive(Debug)]
struct Entry {
    look: Look,
    errors: bool,
    lines: Vec<String>,
}

/// The entries of one panel, and the room that they need.
#[derive(Debug, Default)]
pub(crate) struct Legend {
    entries: Vec<Entry>,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Legend {
    /// A legend for each panel, without the labels that an earlier panel or series has shown.
    pub(crate) fn all(figure: &Figure, looks: &[Vec<Look>]) -> Vec<Self> {
        let mut shown: Vec<&str> = Vec::new();
        let mut all = Vec::new();
        for (panel, looks) in figure.panels.iter().zip(looks) {
            let mut entries = Vec::new();
            for (series, look) in panel.series.iter().zip(looks) {
                let lines = text::wrap(&series.label, SIZE, WIDEST);
                if !lines.is_empty() && !shown.contains(&series.label.as_str()) {
                    shown.push(&series.label);
                    entries.push(Entry { look: *look, errors: series.errors.is_some(), lines });
                }
            }
            all.push(Self::sized(entries));
        }
        all
    }

    fn sized(entries: Vec<Entry>) -> Self {
        if entries.is_empty() {
            return Self::default();
        }
        let lines = || entries.iter().flat_map(|entry| &entry.lines);
        let text = lines().map(|line| text::width(line, SIZE)).fold(0.0, f64::max);
        let width = 3.0 * PADDING + SAMPLE + text;
        let height = 2.0 * PADDING + entries.iter().map(Entry::height).sum::<f64>();
        Self { entries, width, height }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The top left of the first place in the frame that nothing of the panel crosses.
    pub(crate) fn inside(&self, frame: &Frame, panel: &Panel) -> Option<Point> {
        if self.is_empty() {
            return Some((0.0, 0.0)); // nothing will be drawn there
        }
        let Rect { left, top, right, bottom } = frame.rect;
        let (near_left, near_top) = (left + GAP, top + GAP);
        let (near_right, near_bottom) = (right - GAP - self.width, bottom - GAP - self.height);
        if near_right < near_left || near_bottom < near_top {
            return None;
        }
        let (middle_x, middle_y) = ((near_left + near_right) / 2.0, (near_top + near_bottom) / 2.0);
        let places = [
            (near_right, near_top),
            (near_left, near_top),
            (near_right, near_bottom),
            (near_left, near_bottom),
            (middle_x, near_top),
            (middle_x, near_bottom),
            (near_right, middle_y),
            (near_left, middle_y),
        ];
        let drawn = drawn(frame, panel);
        places.into_iter().find(|&(x, y)| {
            let around = marks::MARKER + 3.0;
            let rect = Rect {
                left: x - around,
                top: y - around,
                right: x + self.width + around,
                bottom: y + self.height + around,
            };
            !drawn.iter().any(|point| rect.contains(*point))
        })
    }

    pub(crate) fn draw(&self, canvas: &Canvas, (left, top): Point) -> Result<(), PlotError> {
        if self.is_empty() {
            return Ok(());
        }
        let (right, bottom) = (left + self.width, top + self.height);
        let box_ = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        canvas.polygon(&box_, PAPER)?;
        canvas.path(&box_, Pen::solid(GRID, 1.0))?;
        let font = Font::new(SIZE, INK).across(HPos::Left);
        let mut y = top + PADDING;
        for entry in &self.entries {
            let mut line_y = y + Entry::ROW / 2.0;
            marks::sample(canvas, (left + PADDING, line_y), SAMPLE, &entry.look, entry.errors)?;
            for line in &entry.lines {
                canvas.text(line, (left + 2.0 * PADDING + SAMPLE, line_y), font)?;
                line_y += LEADING * SIZE;
            }
            y += entry.height();
        }
        Ok(())
    }
}

impl Entry {
    const ROW: f64 = 20.0;

    fn height(&self) -> f64 {
        self.lines.iter().skip(1).fold(Self::ROW, |height, _| height + LEADING * SIZE)
    }
}

/// Points on everything that the panel draws, close enough together that no legend fits between.
fn drawn(frame: &Frame, panel: &Panel) -> Vec<Point> {
    let mut drawn = Vec::new();
    let mut stroke = |from: Point, to: Point| {
        let length = (to.0 - from.0).hypot(to.1 - from.1).min(4000.0);
        let mut along = 0.0;
        while along < length {
            let t = along / length;
            drawn.push((from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1)));
            along += 5.0;
        }
        drawn.push(to);
    };
    for series in &panel.series {
        let places: Vec<_> = series.points.iter().map(|p| frame.place(*p)).collect();
        if series.has_line() {
            for piece in crate::clip::path(&places, &frame.rect) {
                piece.windows(2).for_each(|pair| stroke(pair[0], pair[1]));
            }
        }
        for (i, place) in places.iter().enumerate() {
            stroke(*place, *place);
            if let Some(error) = series.errors.as_ref().and_then(|errors| errors.get(i)) {
                let y = series.points[i].1;
                let clamp = |y: f64| frame.down(y).clamp(frame.rect.top, frame.rect.bottom);
                stroke((place.0, clamp(y - error)), (place.0, clamp(y + error)));
            }
        }
    }
    drawn
}
