//! What a reader sees first: what this is, the numbers that matter, a picture, how many claims hold.

use maud::{Markup, html};

use super::Page;
use super::claims::Verdict;

/// One of the numbers that matter, as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Headline {
    /// What it is, of which flow.
    pub quantity: String,
    /// What it should be, with its uncertainty.
    pub reference: String,
    /// Where that comes from.
    pub source: String,
    /// What psmrt finds.
    pub found: String,
    /// Relative error.
    pub error: String,
    /// Numerical uncertainty, of the grid.
    pub uncertainty: String,
    /// Whether the error lies within both uncertainties, the reference's and the grid's.
    pub is_within: bool,
    /// Place of the case on the page.
    pub case: String,
}

/// A picture, inside the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The file's bytes as base 64, of a PNG.
    pub png_base64: String,
    /// What it shows.
    pub caption: String,
}

/// The first screen.
pub(super) fn front(page: &Page) -> Markup {
    html! {
        header {
            h1 { (page.title) }
            p class="lead" { (page.lead) }
            p class="summary" { (summary(page)) " " a href="#verdicts" { "All claims" } "." }
        }
        div class="front" {
            @if !page.headlines.is_empty() { (headlines(&page.headlines)) }
            @if let Some(picture) = &page.picture {
                figure class="picture" {
                    img alt=(picture.caption) src=(format!("data:image/png;base64,{}", picture.png_base64));
                    figcaption { (picture.caption) }
                }
            }
        }
        details { summary { "How to read this page" } @for paragraph in &page.about { p { (paragraph) } } }
    }
}

/// How many claims hold, each engine's counted.
fn summary(page: &Page) -> String {
    let verdicts = || page.sections.iter().flat_map(|section| &section.verdicts);
    let found = || verdicts().flat_map(|verdict| &verdict.found);
    let hold = found().filter(|found| found.holds).count();
    let claims = verdicts().filter(|verdict| Verdict::holds(verdict)).count();
    format!(
        "{claims} of {} claims hold ({hold} of {} with each engine's counted).",
        verdicts().count(),
        found().count()
    )
}

fn headlines(headlines: &[Headline]) -> Markup {
    html! {
        div class="wide" { table class="headlines" {
            thead { tr {
                th { "quantity" } th { "reference" } th { "psmrt" } th { "error" } th { "grid uncertainty" } th { "error within both" }
            } }
            tbody {
                @for one in headlines {
                    tr {
                        td class="quantity" {
                            a href=(format!("#{}", one.case)) { (one.quantity) }
                            " " span class="source" { "Reference: " (one.source) "." }
                        }
                        td class="number" { (one.reference) }
                        td class="number" { (one.found) }
                        td class="number" { (one.error) }
                        td class="number" { (one.uncertainty) }
                        @if one.is_within { td class="holds" { "✓ yes" } } @else { td { "no" } }
                    }
                }
            }
        } }
    }
}
