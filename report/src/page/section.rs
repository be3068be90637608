//! One case: what it shows, its first figure, and the rest folded.

use maud::{Markup, PreEscaped, html};

use super::claims::{Verdict, of_section};
use super::{Link, Section, front, rows};
use crate::error::PlotError;
use crate::render::render_svg;

/// A case on the page. What fails is not folded.
pub(super) fn section(section: &Section) -> Result<Markup, PlotError> {
    let figures = section.figures.iter().map(render_svg).collect::<Result<Vec<_>, _>>()?;
    let (lead, rest) = section.about.split_at(section.about.len().min(1));
    let (first, others) = figures.split_at(figures.len().min(1));
    let hold = section.verdicts.iter().filter(|verdict| Verdict::holds(verdict)).count();
    let all = section.verdicts.len();
    let more = match others.len() {
        1 => "One more figure".to_owned(),
        count => format!("{count} more figures"),
    };
    Ok(html! {
        section id=(section.name) {
            h2 { (section.title) }
            @for paragraph in lead { p { (paragraph) } }
            @if let Some(picture) = &section.picture { (front::picture(picture)) }
            @if let Some(film) = &section.film {
                details { summary { (film.text) }
                    video controls preload="none" src=(film.href) { a href=(film.href) { (film.href) } }
                }
            }
            @for figure in first { figure { (PreEscaped(figure)) } }
            @if !others.is_empty() {
                details { summary { (more) }
                    @for figure in others { figure { (PreEscaped(figure)) } }
                }
            }
            details open[!section.holds()] {
                summary { (format!("{hold} of {all} claims hold: what was measured, what is allowed, and why so much")) }
                (of_section(section))
            }
            @if !rest.is_empty() {
                details { summary { "How it is done" } @for paragraph in rest { p { (paragraph) } } }
            }
            @for table in &section.tables {
                details { summary { (table.caption) } (rows(table)) }
            }
            details { summary { "Scenes, data, and the command that repeats it" }
                p class="repeat" {
                    "Scenes: " (links(&section.scenes)) ". Data: " (links(&section.data))
                    ". To repeat: " code { (section.command) }
                    ". Full scale: " (section.full) "."
                }
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
