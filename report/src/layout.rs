//! Where everything goes; all lengths in pixels, y downwards.

use crate::error::PlotError;
use crate::figure::Figure;
use crate::span::Span;
use crate::text;
use crate::ticks::Ticks;

/// x to the right and y down, in pixels.
pub(crate) type Point = (f64, f64);

pub(crate) const TITLE: f64 = 15.0;
/// How much wider bold letters are.
pub(crate) const BOLD: f64 = 1.1;
pub(crate) const LABEL: f64 = 13.0;
pub(crate) const TICK: f64 = 12.0;
pub(crate) const NOTE: f64 = 11.0;

/// From the centre of one line of text to the next, by font size.
pub(crate) const LEADING: f64 = 1.3;
/// Length of a tick mark, and the distance between things that stand apart.
pub(crate) const TICK_MARK: f64 = 4.0;
pub(crate) const GAP: f64 = 8.0;
pub(crate) const MARGIN: f64 = 12.0;
/// Tick marks and their labels under a frame.
pub(crate) const X_TICKS: f64 = TICK_MARK + LEADING * TICK + 4.0;
/// Half a tick label may stand out beyond the frame.
const RIGHT: f64 = 26.0;
const BETWEEN_PANELS: f64 = 18.0;
/// The first panel's height, with the others' as 1.
const FIRST_PANEL: f64 = 2.4;

/// The largest picture, in pixels: the backend counts tenths of them in 32 bits.
const LARGEST: f64 = 20_000.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Rect {
    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(crate) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(crate) fn contains(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }
}

/// The plotting area of one panel.
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) rect: Rect,
    pub(crate) x: Span,
    pub(crate) y: Span,
    pub(crate) x_ticks: Ticks,
    pub(crate) y_ticks: Ticks,
    pub(crate) y_label: Vec<String>,
}

impl Frame {
    pub(crate) fn across(&self, x: f64) -> f64 {
        self.rect.left + self.x.fraction(x) * self.rect.width()
    }

    pub(crate) fn down(&self, y: f64) -> f64 {
        self.rect.bottom - self.y.fraction(y) * self.rect.height()
    }

    pub(crate) fn place(&self, (x, y): Point) -> Point {
        (self.across(x), self.down(y))
    }
}

/// The whole picture.
#[derive(Debug)]
pub(crate) struct Layout {
    pub(crate) size: (f64, f64),
    pub(crate) title: Vec<String>,
    pub(crate) x_label: Vec<String>,
    pub(crate) notes: Vec<String>,
    pub(crate) frames: Vec<Frame>,
}

/// Room for legends that stand outside: a column at the right, and a least height.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub(crate) struct Outside {
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Layout {
    pub(crate) fn new(
        figure: &Figure,
        (x, ys): (Span, &[Span]),
        notes: &[String],
        outside: Outside,
    ) -> Result<Self, PlotError> {
        let (mut width, mut height) = match figure.size {
            Some((width, height)) => (f64::from(width), f64::from(height)),
            None => (800.0, 520.0),
        };
        let free = figure.size.is_none();

        // Heights, from the texts above and below.
        let title = text::wrap(&figure.title, BOLD * TITLE, width - 2.0 * MARGIN);
        let x_label = text::wrap(&figure.x.label, LABEL, 0.75 * width);
        let wrap_note = |note: &String| text::wrap(note, NOTE, width - 2.0 * MARGIN);
        let notes: Vec<String> = notes.iter().flat_map(wrap_note).collect();
        let above = MARGIN + stack(&title, TITLE) + GAP;
        let below = X_TICKS + stack(&x_label, LABEL) + GAP + stack(&notes, NOTE) + GAP;
        let further = ys.len().saturating_sub(1) as f64;
        if free {
            height += 170.0 * further + stack(&notes, NOTE);
            height += stack(title.get(1..).unwrap_or_default(), TITLE);
            height = height.max(outside.height).ceil();
        }
        let share = (height - above - below - further * BETWEEN_PANELS) / (FIRST_PANEL + further);
        let (mut frames, left) = frames(figure, (x, ys), above, share);

        // Widths: a legend at the right may widen the picture where its size is free.
        let least = if free { 420.0 } else { 120.0 };
        let mut plot_width = width - left - RIGHT - outside.width;
        if free && plot_width < least {
            width = (width + least - plot_width).ceil();
            plot_width = least;
        }
        if plot_width < least || share < 50.0 || height < outside.height {
            return Err(bad_size(
                figure,
                (width, height),
                "its texts and legends leave no room for the plot; shorten them, or give a larger \
                 size (without one it grows as needed)",
            ));
        }
        if width.max(height) > LARGEST {
            return Err(bad_size(figure, (width, height), "at most 20000 either way can be drawn"));
        }
        for frame in &mut frames {
            frame.rect.left = left;
            frame.rect.right = left + plot_width;
            frame.x_ticks = Ticks::of(&figure.x, &x, plot_width / 75.0);
        }
        Ok(Self { size: (width, height), title, x_label, notes, frames })
    }
}

/// The panels from the top down, as yet without their widths; and the room that their labels
/// take at the left.
fn frames(figure: &Figure, (x, ys): (Span, &[Span]), above: f64, share: f64) -> (Vec<Frame>, f64) {
    let mut frames = Vec::new();
    let mut top = above;
    let mut left: f64 = 0.0;
    for (i, (panel, &y)) in figure.panels.iter().zip(ys).enumerate() {
        let height = if i == 0 { FIRST_PANEL * share } else { share };
        let y_ticks = Ticks::of(&panel.y, &y, height / 50.0);
        let y_label = text::wrap(&panel.y.label, LABEL, height);
        let widths = y_ticks.major.iter().map(|(_, label)| text::width(label, TICK));
        let ticks = widths.fold(0.0, f64::max) + TICK_MARK + 4.0;
        left = left.max(MARGIN + stack(&y_label, LABEL) + GAP + ticks);
        let rect = Rect { left: 0.0, top, right: 0.0, bottom: top + height };
        frames.push(Frame { rect, x, y, x_ticks: Ticks::default(), y_ticks, y_label });
        top += height + BETWEEN_PANELS;
    }
    (frames, left)
}

fn bad_size(figure: &Figure, (width, height): (f64, f64), reason: &str) -> PlotError {
    let (figure, reason) = (figure.title.clone(), reason.to_owned());
    PlotError::BadSize { figure, width, height, reason }
}

/// The height of some lines of text.
pub(crate) fn stack(lines: &[String], size: f64) -> f64 {
    lines.iter().map(|_| LEADING * size).sum()
}
