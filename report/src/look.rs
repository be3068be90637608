//! Which colour, dash and marker each series of a figure gets.

use plotters::style::RGBColor;

use crate::figure::Figure;
use crate::palette::{COLOURS, DASHES, Dash, FAINT_INK, MARKERS, REFERENCE_DASHES};
use crate::series::{Marker, Series, Style};

/// How a series looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Look {
    pub(crate) colour: RGBColor,
    /// The line's dash pattern; no line where `None`.
    pub(crate) line: Option<Dash>,
    pub(crate) width: f64,
    pub(crate) marker: Option<Marker>,
}

/// A look for each series of each panel. A label seen before takes its colour and marker again.
pub(crate) fn looks(figure: &Figure) -> Vec<Vec<Look>> {
    let mut hand = Hand::default();
    let mut seen: Vec<(&Series, Look)> = Vec::new();
    let mut all = Vec::new();
    for panel in &figure.panels {
        let mut looks = Vec::new();
        for series in &panel.series {
            let twin = seen.iter().find(|(s, _)| !s.label.is_empty() && s.label == series.label);
            let look = match twin {
                Some((other, look)) if other.style == series.style => *look,
                Some((_, look)) => hand.deal(series, Some(*look)),
                None => hand.deal(series, None),
            };
            seen.push((series, look));
            looks.push(look);
        }
        all.push(looks);
    }
    all
}

/// What has been dealt so far.
#[derive(Default)]
struct Hand {
    colours: usize,
    references: usize,
    dashes: Vec<Dash>,
}

impl Hand {
    fn deal(&mut self, series: &Series, twin: Option<Look>) -> Look {
        if series.style == Style::Reference {
            let dash = REFERENCE_DASHES[self.references % REFERENCE_DASHES.len()];
            self.references += 1;
            return Look { colour: FAINT_INK, line: Some(dash), width: 1.2, marker: None };
        }
        let order = self.colours;
        self.colours += usize::from(series.colour.is_none() && twin.is_none());
        let index = series.colour.unwrap_or(order);
        // From the eighth series on, colours return with other markers.
        let automatic = twin.and_then(|look| look.marker);
        let automatic =
            automatic.unwrap_or(MARKERS[(index + index / MARKERS.len()) % MARKERS.len()]);
        let line = match series.style {
            Style::Line => Some(self.dash(&DASHES)),
            Style::DashedLine => Some(self.dash(&DASHES[1..])),
            Style::LinePoints(_) => Some(None),
            Style::Points(_) | Style::Reference => None,
        };
        let marker = match series.style {
            Style::Points(marker) | Style::LinePoints(marker) => Some(marker.unwrap_or(automatic)),
            // A line through one point would be invisible.
            _ => (series.points.len() == 1).then_some(automatic),
        };
        let colour = twin.map_or(COLOURS[index % COLOURS.len()], |look| look.colour);
        Look { colour, line, width: 2.0, marker }
    }

    /// The first pattern that no line has yet; round again when all are in use.
    fn dash(&mut self, patterns: &[Dash]) -> Dash {
        let free = patterns.iter().find(|p| !self.dashes.contains(p));
        let dash = *free.unwrap_or(&patterns[self.dashes.len() % patterns.len()]);
        self.dashes.push(dash);
        dash
    }
}
