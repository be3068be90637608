//! Scientific figures as SVG: numbers in, one self-contained picture out.
//!
//! It runs no physics and knows no solvers. A [`Figure`] is a title, one x axis, and one or more
//! panels stacked under it (a profile, and its residuals below); each [`Panel`] holds [`Series`].
//! Values that cannot be drawn (not finite, or not positive on a log axis) are a [`PlotError`]
//! that names the series and the value; nothing is dropped in silence.
//!
//! ```
//! use psmrt_report::{Axis, Figure, PowerLaw, Series, render_svg};
//!
//! let errors = vec![(8.0, 3.1e-2), (16.0, 7.9e-3), (32.0, 2.0e-3), (64.0, 5.0e-4)];
//! let fit = PowerLaw::fit(&errors)?;
//! let figure = Figure::new(
//!     "Poiseuille flow: error against resolution",
//!     Axis::log("cells across the gap, N").ticks(&[8.0, 16.0, 32.0, 64.0]),
//!     Axis::log("relative L2 error of u"),
//! )
//! .with(Series::points("MRT, tau = 0.8", errors))
//! .with(fit.series(format!("fit: order {:.2}", -fit.order), (8.0, 64.0)))
//! .note("magic rates; walls by half-way bounce-back");
//! let svg = render_svg(&figure)?;
//! assert!(svg.starts_with("<svg"));
//! # Ok::<(), psmrt_report::PlotError>(())
//! ```
//!
//! | file | what it holds |
//! |---|---|
//! | `figure.rs`, `series.rs` | what a caller fills in |
//! | `fit.rs` | power laws: reference slopes and fitted orders |
//! | `map.rs` | maps of a plane, value by value |
//! | `check.rs`, `error.rs` | what is refused, and the words for it |
//! | `span.rs`, `ticks.rs`, `decimal.rs` | values to positions; tick marks and their labels |
//! | `layout.rs`, `legend.rs`, `text.rs` | where things go |
//! | `notes.rs` | the lines under a figure, with what the axes leave out |
//! | `look.rs`, `palette.rs` | which colour, dash and marker a series gets |
//! | `page/` | the validation report: headlines, figures, claims and tables as one HTML page |
//! | `render.rs`, `marks.rs`, `clip.rs`, `canvas.rs`, `write.rs` | drawing, on plotters' SVG backend |
//!
//! Positions are ours and not those of plotters' `ChartBuilder`: without a font plotters guesses
//! text sizes too coarsely to keep labels and legends apart, and its tick labels carry float noise.

#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod canvas;
mod check;
mod clip;
mod decimal;
mod error;
mod figure;
mod fit;
mod layout;
mod legend;
mod look;
mod map;
mod marks;
mod notes;
mod page;
mod palette;
mod render;
mod scale;
mod series;
mod span;
mod text;
mod ticks;
mod write;

pub use error::PlotError;
pub use figure::{Axis, Figure, Panel};
pub use fit::PowerLaw;
pub use map::{Map, render_map};
pub use page::{
    Agreement, Appendix, DataTable, Found, Headline, Link, Page, Picture, Section, Verdict,
    render_page,
};
pub use render::render_svg;
pub use scale::Scale;
pub use series::{Marker, Series, Style};
pub use write::write_svg;
