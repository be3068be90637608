//! The lines under a figure: the caller's, and what the axes leave out.

use crate::figure::{Figure, Panel};
use crate::scale::Scale;
use crate::series::Series;
use crate::span::Span;

/// The caller's notes, then one for whatever of a series is not shown in full.
pub(crate) fn all(figure: &Figure, x: &Span, ys: &[Span]) -> Vec<String> {
    let mut notes = figure.notes.clone();
    for (panel, y) in figure.panels.iter().zip(ys) {
        for series in &panel.series {
            notes.extend(outside(series, x, y));
            notes.extend(cut_errors(series, panel));
        }
    }
    notes
}

/// Points beyond the axes. A line that leaves the frame shows that by itself.
fn outside(series: &Series, x: &Span, y: &Span) -> Option<String> {
    let shown = |p: &&(f64, f64)| x.contains(p.0) && y.contains(p.1);
    let all = series.points.len();
    let outside = all - series.points.iter().filter(shown).count();
    let told = if series.has_line() { outside == all } else { outside > 0 };
    let name = name(series);
    told.then(|| format!("{name}: {outside} of {all} points lie outside the axes."))
}

fn cut_errors(series: &Series, panel: &Panel) -> Option<String> {
    let errors = series.errors.iter().flatten();
    let reaches_zero = series.points.iter().zip(errors).any(|((_, y), error)| y - error <= 0.0);
    let name = name(series);
    (reaches_zero && panel.y.scale == Scale::Log)
        .then(|| format!("{name}: error bars that reach zero or less end at the frame."))
}

fn name(series: &Series) -> &str {
    if series.label.trim().is_empty() { "a series without a label" } else { &series.label }
}
