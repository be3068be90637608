//! The validation report: the numbers that matter, figures, claims and tables as one self-contained HTML page.

mod agreement;
mod claims;
mod front;
mod section;

use maud::{DOCTYPE, Markup, PreEscaped, html};
use pulldown_cmark::{Event, Options, Parser, html::push_html};

use crate::error::PlotError;
use crate::figure::Figure;

pub use agreement::Agreement;
pub use claims::{Found, Verdict};
pub use front::{Headline, Picture};

/// Wide enough to read, and no wider than the screen or the paper; verdicts by word and sign, not by
/// colour alone.
const STYLE: &str = include_str!("style.css");

/// Search and sorting of the claims, and unfolding of what a link leads to. All is there without it.
const SCRIPT: &str = include_str!("script.js");

/// A table as it is shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DataTable {
    /// What it shows, with units.
    pub caption: String,
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Its rows, each as long as the columns.
    pub rows: Vec<Vec<String>>,
}

/// A file beside the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// What it is called.
    pub text: String,
    /// Where it is, from the page's folder.
    pub href: String,
}

/// One case.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its name: also that of its folder and of the place on the page.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What it shows and what it is held to, a paragraph each. The first stands above the figure, the others are folded.
    pub about: Vec<String>,
    /// A picture of what is computed, before the figures.
    pub picture: Option<Picture>,
    /// A film of it, beside the page.
    pub film: Option<Link>,
    /// Its verdicts.
    pub verdicts: Vec<Verdict>,
    /// Its figures, the most telling one first; each is followed by its notes. The others are folded.
    pub figures: Vec<Figure>,
    /// Its tables.
    pub tables: Vec<DataTable>,
    /// Its scene files.
    pub scenes: Vec<Link>,
    /// The tables and pictures beside the page: what was measured, and what its figures draw.
    pub data: Vec<Link>,
    /// The command that repeats it.
    pub command: String,
    /// The command that repeats it at the full scale, and what that takes.
    pub full: String,
}

/// A text that belongs to the report, such as a list of errata.
#[derive(Clone, Debug, PartialEq)]
pub struct Appendix {
    /// The place on the page.
    pub name: String,
    /// Its text in Markdown; its first heading is its title.
    pub markdown: String,
}

/// The whole page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Page {
    /// Its title.
    pub title: String,
    /// What was validated, in a sentence or two: the first thing that is read.
    pub lead: String,
    /// The numbers that matter.
    pub headlines: Vec<Headline>,
    /// One picture of what is computed.
    pub picture: Option<Picture>,
    /// How far off numbers are, quantity by quantity.
    pub agreement: Option<Agreement>,
    /// How to read the page, a paragraph each.
    pub about: Vec<String>,
    /// The cases.
    pub sections: Vec<Section>,
    /// Texts after the cases.
    pub appendices: Vec<Appendix>,
    /// Where the time went.
    pub timings: DataTable,
    /// What it was made with: name and value.
    pub environment: Vec<(String, String)>,
}

impl Page {
    /// Whether every claim of every case holds.
    pub fn holds(&self) -> bool {
        self.sections.iter().all(Section::holds)
    }
}

impl Section {
    /// Whether every claim holds; a case without a claim does not.
    pub fn holds(&self) -> bool {
        !self.verdicts.is_empty() && self.verdicts.iter().all(Verdict::holds)
    }
}

/// The page as HTML, with its figures in it. Errors if a figure cannot be drawn.
pub fn render_page(page: &Page) -> Result<String, PlotError> {
    let sections = page.sections.iter().map(section::section).collect::<Result<Vec<_>, _>>()?;
    let agreement = page.agreement.as_ref().map(agreement::agreement).transpose()?;
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (page.title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                (front::front(page))
                (contents(page))
                @if let Some(agreement) = agreement { (agreement) }
                @for section in sections { (section) }
                (claims::all(page))
                @for appendix in &page.appendices { (self::appendix(appendix)) }
                section id="timings" {
                    h2 { "Timings" }
                    details { summary { (page.timings.caption) } (rows(&page.timings)) }
                }
                section id="environment" {
                    h2 { "Environment" }
                    details {
                        summary { "What the report was made with" }
                        table class="facts" {
                            tbody {
                                @for (name, value) in &page.environment {
                                    tr { th scope="row" { (name) } td { (value) } }
                                }
                            }
                        }
                    }
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    Ok(markup.into_string())
}

/// Links to everything on the page.
fn contents(page: &Page) -> Markup {
    html! {
        nav { "On this page: "
            @if page.agreement.is_some() { a href="#agreement" { (agreement::TITLE) } "; " }
            @for section in &page.sections { a href=(format!("#{}", section.name)) { (section.title) } "; " }
            a href="#verdicts" { "all claims" } "; "
            @for appendix in &page.appendices {
                a href=(format!("#{}", appendix.name)) { (appendix.name) } "; "
            }
            a href="#timings" { "timings" } "; " a href="#environment" { "environment" } "."
        }
    }
}

/// Its title, and its text folded, with headings one level below the page's own; HTML in it is shown, not obeyed.
fn appendix(appendix: &Appendix) -> Markup {
    let (title, body) = match appendix.markdown.trim_start().split_once('\n') {
        Some((first, rest)) if first.starts_with("# ") => (first[2..].trim(), rest),
        _ => (appendix.name.as_str(), appendix.markdown.as_str()),
    };
    let parser = Parser::new_ext(body, Options::ENABLE_TABLES);
    let events = parser.map(|event| match event {
        Event::Html(text) | Event::InlineHtml(text) => Event::Text(text),
        other => other,
    });
    let mut text = String::new();
    push_html(&mut text, events);
    let text = text
        .replace("<h2>", "<h3>")
        .replace("</h2>", "</h3>")
        .replace("<table>", "<div class=\"wide\"><table>")
        .replace("</table>", "</table></div>");
    html! {
        section id=(appendix.name) {
            h2 { (title) }
            details { summary { "The whole text" } (PreEscaped(text)) }
        }
    }
}

/// A table, scrolled sideways where it is too wide.
fn rows(table: &DataTable) -> Markup {
    html! {
        div class="wide" { table {
            thead { tr { @for column in &table.columns { th { (column) } } } }
            tbody {
                @for row in &table.rows { tr { @for value in row { (cell(value)) } } }
            }
        } }
    }
}

/// A number stays on its line, minus signs of exponents too; words may be broken between.
fn cell(value: &str) -> Markup {
    html! {
        @if value.contains(' ') { td { (value) } } @else { td class="number" { (value) } }
    }
}
