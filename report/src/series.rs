//! One set of points and how it is drawn.

use crate::scale::Scale;

/// The shape of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Circle,
    /// A square.
    Square,
    /// A triangle, point up.
    TriangleUp,
    /// A square on its corner.
    Diamond,
    /// A triangle, point down.
    TriangleDown,
    /// An open circle.
    Ring,
    /// An x.
    Cross,
    /// A wide open circle round another marker, which stays in sight.
    Halo,
}

/// How a series is drawn. Colour, dashes and, where no marker is named, the marker follow from
/// the order of the series, so that two differ in print without colour too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A line: the first of a figure solid, each further one with its own dashes.
    Line,
    /// A line that is never solid.
    DashedLine,
    /// Points alone.
    Points(Option<Marker>),
    /// Points joined by a solid line.
    LinePoints(Option<Marker>),
    /// A thin grey dashed line, for slopes and limits to compare with.
    Reference,
}

/// One set of points with its label.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its entry in the legend; none where empty.
    pub label: String,
    /// How it is drawn.
    pub style: Style,
    /// x and y, in the order in which a line joins them.
    pub points: Vec<(f64, f64)>,
    /// Half the length of a vertical error bar at each point.
    pub errors: Option<Vec<f64>>,
    /// Which colour of the palette it takes, counted from 0; by its order where `None`.
    pub colour: Option<usize>,
}

impl Series {
    /// A series in the given style.
    pub fn new(label: impl Into<String>, style: Style, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), style, points, errors: None, colour: None }
    }

    /// A line: theory, or a record with many rows.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Style::Line, points)
    }

    /// A dashed line.
    pub fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Style::DashedLine, points)
    }

    /// Points: measurements, or a simulation's nodes.
    pub fn points(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Style::Points(None), points)
    }

    /// Points joined by a line.
    pub fn line_points(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Style::LinePoints(None), points)
    }

    /// Adds vertical error bars of plus and minus `errors`, one a point. On a log axis a bar that
    /// reaches zero or less is drawn down to the frame, and a note says so.
    #[must_use]
    pub fn with_errors(mut self, errors: Vec<f64>) -> Self {
        self.errors = Some(errors);
        self
    }

    /// Takes colour `index` of the palette (modulo its size), to pair a line with its points.
    #[must_use]
    pub fn with_colour(mut self, index: usize) -> Self {
        self.colour = Some(index);
        self
    }

    /// Whether a line joins the points.
    pub(crate) fn has_line(&self) -> bool {
        !matches!(self.style, Style::Points(_))
    }

    /// The y that its points and error bars reach, as far as the scale can show them.
    pub(crate) fn reach(&self, scale: Scale) -> Vec<f64> {
        let mut reach: Vec<f64> = self.points.iter().map(|p| p.1).collect();
        for ((_, y), error) in self.points.iter().zip(self.errors.iter().flatten()) {
            reach.extend([y - error, y + error]);
        }
        reach.retain(|y| scale == Scale::Linear || *y > 0.0);
        reach
    }
}
