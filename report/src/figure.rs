//! What a caller fills in: a figure, its axes and its panels.

use crate::scale::Scale;
use crate::series::Series;

/// One axis: what it measures, and how it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What the axis measures, with its unit: `velocity u (m/s)`.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// The values at the two ends; from the data, with a margin, where `None`.
    pub range: Option<(f64, f64)>,
    /// Where the labelled ticks go; chosen for the range where `None`.
    pub ticks: Option<Vec<f64>>,
    /// Words in place of numbers, from the value 1 up.
    pub names: Option<Vec<String>>,
}

impl Axis {
    /// A linear axis over the range of the data.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None, ticks: None, names: None }
    }

    /// A logarithmic axis over the range of the data.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, range: None, ticks: None, names: None }
    }

    /// Shows exactly `low..=high`. A line that leaves the range is cut at the frame; points
    /// outside it are counted in a note under the figure.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// Puts the labelled ticks at these values (grid sizes 8, 16, 32, say). Those outside the
    /// range are not drawn.
    #[must_use]
    pub fn ticks(mut self, values: &[f64]) -> Self {
        self.ticks = Some(values.to_vec());
        self
    }

    /// An axis of things instead of numbers: the value 1 is the first of `names`, 2 the second.
    #[must_use]
    pub fn of_names(names: &[&str]) -> Self {
        Self {
            names: Some(names.iter().map(|&name| name.to_owned()).collect()),
            ..Self::linear("")
        }
        .range(0.5, names.len() as f64 + 0.5)
    }
}

/// One plot of a figure; it shares the figure's x axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The y axis.
    pub y: Axis,
    /// What is drawn, in the order of the legend.
    pub series: Vec<Series>,
}

/// A figure: a title, panels over one shared x axis, and notes below.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The line above the figure.
    pub title: String,
    /// The x axis that all panels share.
    pub x: Axis,
    /// From the top down. The first is the tallest.
    pub panels: Vec<Panel>,
    /// Small lines of text under the figure.
    pub notes: Vec<String>,
    /// Width and height in pixels; where `None`, 800 x 520 and 170 more for each further panel.
    pub size: Option<(u32, u32)>,
}

impl Figure {
    /// A figure with one panel and nothing in it yet.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        let panels = vec![Panel { y, series: Vec::new() }];
        Self { title: title.into(), x, panels, notes: Vec::new(), size: None }
    }

    /// Adds a series to the lowest panel so far. A series with the label of an earlier one (the
    /// residuals of a curve, say) takes its looks and has no second entry in the legend.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        if let Some(panel) = self.panels.last_mut() {
            panel.series.push(series);
        } else {
            let y = Axis::linear("");
            self.panels.push(Panel { y, series: vec![series] });
        }
        self
    }

    /// Starts a panel under the last one, for residuals; series added next go there.
    #[must_use]
    pub fn with_panel(mut self, y: Axis) -> Self {
        self.panels.push(Panel { y, series: Vec::new() });
        self
    }

    /// Adds a small line of text under the figure.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Sets the size of the picture, in pixels.
    #[must_use]
    pub fn size(mut self, width: u32, height: u32) -> Self {
        self.size = Some((width, height));
        self
    }
}
