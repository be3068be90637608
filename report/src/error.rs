//! What can go wrong, in words that name the series, the value and the remedy.

use std::path::PathBuf;

/// Why a figure was not drawn or not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// A figure without panels, or a panel without series.
    #[error("figure \"{figure}\": panel {panel} has no series; add one with `Figure::with`")]
    NoSeries {
        /// The figure's title.
        figure: String,
        /// The panel, counted from 1.
        panel: usize,
    },

    /// A series without points.
    #[error("series {series} has no points; leave it out, or check where its values come from")]
    EmptySeries {
        /// The series, by label.
        series: String,
    },

    /// A coordinate that is NaN or infinite.
    #[error(
        "series {series}: {axis} = {value:?} at point {point} is not finite; \
         leave the point out, or find out why it was computed so"
    )]
    NotFinite {
        /// The series, by label.
        series: String,
        /// `x` or `y`.
        axis: char,
        /// The point, counted from 1.
        point: usize,
        /// The offending value.
        value: f64,
    },

    /// A value of zero or less on a log axis.
    #[error(
        "series {series}: {axis} = {value:?} at point {point} has no place on the log axis \
         \"{label}\"; leave the point out, or use a linear axis"
    )]
    NotPositive {
        /// The series, by label.
        series: String,
        /// `x` or `y`.
        axis: char,
        /// The axis' label.
        label: String,
        /// The point, counted from 1.
        point: usize,
        /// The offending value.
        value: f64,
    },

    /// Not one error per point.
    #[error("series {series} has {points} points but {errors} errors; give one error a point")]
    ErrorCount {
        /// The series, by label.
        series: String,
        /// How many points it has.
        points: usize,
        /// How many errors came with them.
        errors: usize,
    },

    /// An error bar of negative or non-finite length.
    #[error(
        "series {series}: the error at point {point} is {value:?}; \
         it must be finite and not negative"
    )]
    BadError {
        /// The series, by label.
        series: String,
        /// The point, counted from 1.
        point: usize,
        /// The offending error.
        value: f64,
    },

    /// A range or tick that its axis cannot show.
    #[error("axis \"{label}\": {reason}")]
    BadAxis {
        /// The axis' label.
        label: String,
        /// What is wrong with it, with the values.
        reason: String,
    },

    /// The picture has no room for what it should show.
    #[error("figure \"{figure}\" of {width} x {height} pixels: {reason}")]
    BadSize {
        /// The figure's title.
        figure: String,
        /// Its width, in pixels.
        width: f64,
        /// Its height, in pixels.
        height: f64,
        /// What does not fit, and what would help.
        reason: String,
    },

    /// Points through which no power law can be laid.
    #[error("no power law fits: {0}")]
    NoFit(String),

    /// The drawing library failed; it writes to memory, so this is not expected.
    #[error("the drawing library failed: {0}")]
    Drawing(String),

    /// The file could not be written.
    #[error("cannot write the figure to {path}: {reason}")]
    Write {
        /// The path that was asked for.
        path: PathBuf,
        /// What is in the way, and what would help.
        reason: String,
    },
}
