//! How far off numbers are, quantity by quantity.

use maud::{Markup, PreEscaped, html};

use super::{DataTable, rows};
use crate::error::PlotError;
use crate::figure::Figure;
use crate::render::render_svg;

pub(super) const TITLE: &str = "Bias and scatter, quantity by quantity";

/// How far off numbers are, over all cases.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Agreement {
    /// What is shown, a paragraph each.
    pub about: Vec<String>,
    /// A row a quantity.
    pub table: DataTable,
    /// The figures; all but the first are folded.
    pub figures: Vec<Figure>,
}

/// Its section.
pub(super) fn agreement(agreement: &Agreement) -> Result<Markup, PlotError> {
    let figures = agreement.figures.iter().map(render_svg).collect::<Result<Vec<_>, _>>()?;
    let (first, others) = figures.split_at(figures.len().min(1));
    Ok(html! {
        section id="agreement" {
            h2 { (TITLE) }
            @for paragraph in &agreement.about { p { (paragraph) } }
            @for figure in first { figure { (PreEscaped(figure)) } }
            (rows(&agreement.table))
            @if !others.is_empty() {
                details { summary { "Values against their references" }
                    @for figure in others { figure { (PreEscaped(figure)) } }
                }
            }
            p { "All numbers with their sources: " a href="agreement.csv" { code { "agreement.csv" } } "." }
        }
    })
}
