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
    /// Whether the error lies within both uncertainties, the reference's and the grid's; `None` if the grid's is too large to
    /// say.
    pub is_within: Option<bool>,
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
            @if let Some(picture) = &page.picture { (self::picture(picture)) }
        }
        details { summary { "How to read this page" } @for paragraph in &page.about { p { (paragraph) } } }
    }
}

/// A picture above what it shows.
pub(super) fn picture(picture: &Picture) -> Markup {
    html! {
        figure class="picture" {
            img alt=(picture.caption) src=(format!("data:image/png;base64,{}", picture.png_base64));
            figcaption { (picture.caption) }
        }
    }
}

/// How many claims hold; and how many of them are of runs that engines made for the page.
fn summary(page: &Page) -> String {
    let verdicts = || page.sections.iter().flat_map(|section| &section.verdicts);
    let hold = verdicts().filter(|verdict| Verdict::holds(verdict)).count();
    let is_run = |verdict: &&Verdict| verdict.found.iter().any(|found| !found.by.is_empty());
    let runs = verdicts().filter(is_run).count();
    format!(
        "{hold} of {} claims hold: {runs} are about runs made for this page, on each engine, the others about longer runs \
         whose results are kept.",
        verdicts().count(),
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
                        td class="number" data-name="reference" { (one.reference) }
                        td class="number" data-name="psmrt" { (one.found) }
                        td class="number" data-name="error" { (one.error) }
                        td class="number" data-name="grid uncertainty" { (one.uncertainty) }
                        td data-name="error within both" class=[(one.is_within == Some(true)).then_some("holds")] {
                            (match one.is_within { Some(true) => "✓ yes", Some(false) => "no", None => "grid too coarse to say" })
                        }
                    }
                }
            }
        } }
    }
}
