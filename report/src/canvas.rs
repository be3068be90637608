//! plotters' SVG backend, addressed in fractions of a pixel.
//!
//! plotters is only the canvas: without system fonts its chart builder guesses the sizes of text coarsely, so that layout,
//! ticks and legend are our own.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::error::PlotError;
use crate::layout::Point;
use crate::palette::{Dash, PAPER};

/// plotters draws at whole units, which would make steps in smooth curves: ten units make a pixel.
const UNITS: f64 = 10.0;

/// plotters' SVG backend divides font sizes by this.
const FONT_FACTOR: f64 = 1.24;

/// How a line is drawn; lengths in pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pen {
    pub(crate) colour: RGBColor,
    pub(crate) width: f64,
    pub(crate) dash: Dash,
}

impl Pen {
    pub(crate) fn solid(colour: RGBColor, width: f64) -> Self {
        Self { colour, width, dash: None }
    }

    fn style(&self) -> ShapeStyle {
        self.colour.stroke_width(units(self.width).unsigned_abs())
    }
}

/// How a text is drawn; centred unless `across` says otherwise.
#[derive(Clone, Copy)]
pub(crate) struct Font {
    pub(crate) size: f64,
    colour: RGBColor,
    bold: bool,
    across: HPos,
    upright: bool,
}

impl Font {
    pub(crate) fn new(size: f64, colour: RGBColor) -> Self {
        Self { size, colour, bold: false, across: HPos::Center, upright: false }
    }

    pub(crate) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(crate) fn across(self, across: HPos) -> Self {
        Self { across, ..self }
    }

    /// Reading upwards.
    pub(crate) fn upright(self) -> Self {
        Self { upright: true, ..self }
    }
}

/// A white sheet to draw on; positions in pixels from the top left.
pub(crate) struct Canvas<'a> {
    area: DrawingArea<SVGBackend<'a>, Shift>,
}

impl Canvas<'_> {
    /// Runs `draw` on a white sheet, and gives what it drew as SVG.
    pub(crate) fn svg(
        (width, height): (f64, f64),
        draw: impl FnOnce(&Canvas) -> Result<(), PlotError>,
    ) -> Result<String, PlotError> {
        let (wide, high) = (units(width).unsigned_abs(), units(height).unsigned_abs());
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, (wide, high)).into_drawing_area();
            area.fill(&PAPER).map_err(drawing)?;
            let canvas = Canvas { area };
            draw(&canvas)?;
            canvas.area.present().map_err(drawing)?;
        }
        // The view box stays in units; the picture's own size is in pixels.
        let head = format!("<svg width=\"{wide}\" height=\"{high}\"");
        let Some(body) = text.strip_prefix(&head) else {
            return Err(PlotError::Drawing("the SVG does not begin with its size".into()));
        };
        Ok(format!("<svg width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\"{body}"))
    }

    pub(crate) fn path(&self, points: &[Point], pen: Pen) -> Result<(), PlotError> {
        let points: Vec<_> = points.iter().map(|p| at(*p)).collect();
        let drawn = match pen.dash {
            None => self.area.draw(&PathElement::new(points, pen.style())),
            Some((dash, gap)) => {
                let (dash, gap) = (units(dash), units(gap));
                self.area.draw(&DashedPathElement::new(points, dash, gap, pen.style()))
            }
        };
        drawn.map_err(drawing)
    }

    pub(crate) fn polygon(&self, points: &[Point], colour: RGBColor) -> Result<(), PlotError> {
        let points: Vec<_> = points.iter().map(|p| at(*p)).collect();
        self.area.draw(&Polygon::new(points, colour.filled())).map_err(drawing)
    }

    pub(crate) fn disc(&self, centre: Point, r: f64, colour: RGBColor) -> Result<(), PlotError> {
        self.area.draw(&Circle::new(at(centre), units(r), colour.filled())).map_err(drawing)
    }

    pub(crate) fn circle(&self, centre: Point, r: f64, pen: Pen) -> Result<(), PlotError> {
        self.area.draw(&Circle::new(at(centre), units(r), pen.style())).map_err(drawing)
    }

    /// Draws one line of text, centred vertically on the point.
    pub(crate) fn text(&self, text: &str, point: Point, font: Font) -> Result<(), PlotError> {
        let style = if font.bold { FontStyle::Bold } else { FontStyle::Normal };
        let size = font.size * UNITS * FONT_FACTOR;
        let mut desc = FontDesc::new(FontFamily::SansSerif, size, style);
        if font.upright {
            desc = desc.transform(FontTransform::Rotate270);
        }
        let style = TextStyle::from(desc).color(&font.colour);
        let style = style.pos(Pos::new(font.across, VPos::Center));
        self.area.draw_text(text, &style, at(point)).map_err(drawing)
    }
}

fn at((x, y): Point) -> (i32, i32) {
    (units(x), units(y))
}

#[expect(clippy::cast_possible_truncation, reason = "rounded before; `as` saturates")]
fn units(pixels: f64) -> i32 {
    (pixels * UNITS).round() as i32
}

#[expect(clippy::needless_pass_by_value, reason = "the shape that map_err asks for")]
fn drawing<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> PlotError {
    PlotError::Drawing(error.to_string())
}
