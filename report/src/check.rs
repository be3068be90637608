//! What a figure must satisfy before anything is drawn.

use crate::error::PlotError;
use crate::figure::{Axis, Figure};
use crate::scale::Scale;
use crate::series::Series;
use crate::span::bad;

/// Refuses what cannot be drawn, naming the series and the value.
pub(crate) fn figure(figure: &Figure) -> Result<(), PlotError> {
    let no_series = |panel| PlotError::NoSeries { figure: figure.title.clone(), panel };
    if figure.panels.is_empty() {
        return Err(no_series(1));
    }
    ticks(&figure.x)?;
    for (i, panel) in figure.panels.iter().enumerate() {
        ticks(&panel.y)?;
        if panel.series.is_empty() {
            return Err(no_series(i + 1));
        }
        for (j, one) in panel.series.iter().enumerate() {
            series(one, &name(one, j), &figure.x, &panel.y)?;
        }
    }
    Ok(())
}

/// What an error calls a series.
fn name(series: &Series, index: usize) -> String {
    if series.label.trim().is_empty() {
        format!("number {} (without a label)", index + 1)
    } else {
        format!("\"{}\"", series.label)
    }
}

fn series(one: &Series, name: &str, x: &Axis, y: &Axis) -> Result<(), PlotError> {
    let series = || name.to_owned();
    if one.points.is_empty() {
        return Err(PlotError::EmptySeries { series: series() });
    }
    for (i, &(px, py)) in one.points.iter().enumerate() {
        coordinate('x', px, x, name, i + 1)?;
        coordinate('y', py, y, name, i + 1)?;
    }
    let Some(errors) = &one.errors else { return Ok(()) };
    if errors.len() != one.points.len() {
        let (points, errors) = (one.points.len(), errors.len());
        return Err(PlotError::ErrorCount { series: series(), points, errors });
    }
    for (i, (&value, (_, y))) in errors.iter().zip(&one.points).enumerate() {
        if !(value >= 0.0 && (y + value).is_finite() && (y - value).is_finite()) {
            return Err(PlotError::BadError { series: series(), point: i + 1, value });
        }
    }
    Ok(())
}

fn coordinate(
    axis: char,
    value: f64,
    drawn_on: &Axis,
    series: &str,
    point: usize,
) -> Result<(), PlotError> {
    let series = series.to_owned();
    if !value.is_finite() {
        return Err(PlotError::NotFinite { series, axis, point, value });
    }
    if drawn_on.scale == Scale::Log && value <= 0.0 {
        let label = drawn_on.label.clone();
        return Err(PlotError::NotPositive { series, axis, label, point, value });
    }
    Ok(())
}

fn ticks(axis: &Axis) -> Result<(), PlotError> {
    for value in axis.ticks.iter().flatten() {
        if !value.is_finite() {
            return Err(bad(axis, format!("a tick at {value:?} is not finite")));
        }
        if axis.scale == Scale::Log && *value <= 0.0 {
            return Err(bad(axis, format!("a tick at {value:?} has no place on a log axis")));
        }
    }
    Ok(())
}
