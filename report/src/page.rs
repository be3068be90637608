//! The validation report: verdicts, figures and tables as one self-contained HTML page.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use pulldown_cmark::{Event, Options, Parser, html::push_html};

use crate::error::PlotError;
use crate::figure::Figure;
use crate::render::render_svg;

/// Wide enough to read, and no wider than the screen or the paper; verdicts by word and sign, not by
/// colour alone.
const STYLE: &str = include_str!("page.css");

/// One claim with its verdict. Whether it holds is for the caller to say.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What is claimed, in words.
    pub claim: String,
    /// What was measured, as it is shown.
    pub measured: String,
    /// What is allowed, as it is shown.
    pub allowed: String,
    /// Why so much is allowed.
    pub why: String,
    /// Whether it holds.
    pub holds: bool,
}

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
    /// What it shows and what it is held to, a paragraph each.
    pub about: Vec<String>,
    /// Its verdicts.
    pub verdicts: Vec<Verdict>,
    /// Its figures; each is followed by its notes.
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
    /// What it is, a paragraph each.
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
        !self.verdicts.is_empty() && self.verdicts.iter().all(|verdict| verdict.holds)
    }
}

/// The page as HTML, with its figures in it. Errors if a figure cannot be drawn.
pub fn render_page(page: &Page) -> Result<String, PlotError> {
    let sections = page.sections.iter().map(section).collect::<Result<Vec<_>, _>>()?;
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
                h1 { (page.title) }
                @for paragraph in &page.about { p { (paragraph) } }
                h2 id="verdicts" { "All claims" }
                p class="summary" { (summary(page)) }
                (contents(page))
                (all_verdicts(page))
                @for section in sections { (section) }
                @for appendix in &page.appendices { (self::appendix(appendix)) }
                h2 id="timings" { "Timings" }
                p { (page.timings.caption) }
                (rows(&page.timings))
                h2 id="environment" { "Environment" }
                table class="facts" {
                    tbody {
                        @for (name, value) in &page.environment {
                            tr { th scope="row" { (name) } td { (value) } }
                        }
                    }
                }
            }
        }
    };
    Ok(markup.into_string())
}

fn summary(page: &Page) -> String {
    let verdicts = || page.sections.iter().flat_map(|section| &section.verdicts);
    let (all, hold) = (verdicts().count(), verdicts().filter(|verdict| verdict.holds).count());
    format!("{hold} of {all} claims hold.")
}

/// Links to everything on the page.
fn contents(page: &Page) -> Markup {
    html! {
        nav { "On this page: "
            @for section in &page.sections { a href=(format!("#{}", section.name)) { (section.title) } "; " }
            @for appendix in &page.appendices {
                a href=(format!("#{}", appendix.name)) { (appendix.name) } "; "
            }
            a href="#timings" { "timings" } "; " a href="#environment" { "environment" } "."
        }
    }
}

/// Its headings one level lower, below the page's own; HTML in it is shown, not obeyed.
fn appendix(appendix: &Appendix) -> Markup {
    let parser = Parser::new_ext(&appendix.markdown, Options::ENABLE_TABLES);
    let events = parser.map(|event| match event {
        Event::Html(text) | Event::InlineHtml(text) => Event::Text(text),
        other => other,
    });
    let mut text = String::new();
    push_html(&mut text, events);
    let text = text
        .replace("<h2>", "<h3>")
        .replace("</h2>", "</h3>")
        .replace("<h1>", "<h2>")
        .replace("</h1>", "</h2>")
        .replace("<table>", "<div class=\"wide\"><table>")
        .replace("</table>", "</table></div>");
    html! { section id=(appendix.name) { (PreEscaped(text)) } }
}

fn all_verdicts(page: &Page) -> Markup {
    html! {
        table class="claims" {
            thead { tr { th { "verdict" } th { "case" } th { "claim" } th { "measured" } th { "allowed" } } }
            tbody {
                @for section in &page.sections {
                    @for verdict in &section.verdicts {
                        tr {
                            (word(verdict.holds))
                            td class="case" { a href=(format!("#{}", section.name)) { (section.name) } }
                            td class="claim" { (verdict.claim) }
                            (numbers(verdict))
                        }
                    }
                }
            }
        }
    }
}

/// What was measured and what is allowed, in two cells that the style sheet names where there is no head.
fn numbers(verdict: &Verdict) -> Markup {
    html! {
        td class="measured" { (verdict.measured) }
        td class="allowed" { (verdict.allowed) }
    }
}

/// The verdict in one cell of a table.
fn word(holds: bool) -> Markup {
    html! {
        @if holds { td class="holds" { "✓ holds" } } @else { td class="fails" { "✗ FAILS" } }
    }
}

fn section(section: &Section) -> Result<Markup, PlotError> {
    let figures = section.figures.iter().map(render_svg).collect::<Result<Vec<_>, _>>()?;
    Ok(html! {
        section id=(section.name) {
            h2 { (section.title) }
            @for paragraph in &section.about { p { (paragraph) } }
            @for figure in figures { figure { (PreEscaped(figure)) } }
            table class="claims" {
                thead { tr { th { "claim" } th { "measured" } th { "allowed" } th { "verdict" } th { "why so much" } } }
                tbody {
                    @for verdict in &section.verdicts {
                        tr {
                            td class="claim" { (verdict.claim) }
                            (numbers(verdict))
                            (word(verdict.holds))
                            td class="why" { (verdict.why) }
                        }
                    }
                }
            }
            @for table in &section.tables { (data_table(table)) }
            p class="repeat" {
                "Scenes: " (links(&section.scenes)) ". Data: " (links(&section.data))
                ". To repeat: " code { (section.command) }
                ". Full scale: " (section.full) "."
            }
        }
    })
}

fn links(links: &[Link]) -> Markup {
    html! {
        @for (i, link) in links.iter().enumerate() {
            @if i > 0 { ", " }
            a href=(link.href) { code { (link.text) } }
        }
        @if links.is_empty() { "none" }
    }
}

fn data_table(table: &DataTable) -> Markup {
    html! {
        details {
            summary { (table.caption) }
            (rows(table))
        }
    }
}

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
