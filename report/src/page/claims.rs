//! Claims with their verdicts: those of a case, and all of them in one table that can be searched and sorted.

use maud::{Markup, html};

use super::{Page, Section};

/// One claim with its verdict. Whether it holds is for the caller to say.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What is claimed, in words.
    pub claim: String,
    /// What was measured, engine by engine.
    pub found: Vec<Found>,
    /// What is allowed, as it is shown.
    pub allowed: String,
    /// Why so much is allowed.
    pub why: String,
}

/// What one engine, or a study, has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The engine; empty where the claim is of none.
    pub by: String,
    /// The number, as it is shown.
    pub measured: String,
    /// Whether it is allowed.
    pub holds: bool,
    /// What earlier reports found, the oldest first, and this one.
    pub history: Vec<f64>,
}

impl Verdict {
    /// Whether it holds for all who were asked; a claim of which nothing was measured does not.
    pub fn holds(&self) -> bool {
        !self.found.is_empty() && self.found.iter().all(|found| found.holds)
    }
}

/// The claims of a case.
pub(super) fn of_section(section: &Section) -> Markup {
    html! {
        table class="claims" {
            thead { tr { th { "claim" } th { "measured" } th { "allowed" } th { "verdict" } th { "why so much" } } }
            tbody {
                @for (number, verdict) in section.verdicts.iter().enumerate() {
                    tr id=(place(section, number)) {
                        td class="claim" { (verdict.claim) }
                        (numbers(verdict))
                        (word(verdict.holds()))
                        td class="why" { (verdict.why) }
                    }
                }
            }
        }
    }
}

/// All claims of the page.
pub(super) fn all(page: &Page) -> Markup {
    html! {
        section id="verdicts" {
            h2 { "All claims" }
            details {
                summary { "Every claim of every case, to search and to sort" }
                label class="search" { "Search: " input type="search" data-search="claims-all"; }
                div class="wide" { table class="claims" id="claims-all" {
                    thead { tr { th { "verdict" } th { "case" } th { "claim" } th { "measured" } th { "allowed" } } }
                    tbody {
                        @for section in &page.sections {
                            @for (number, verdict) in section.verdicts.iter().enumerate() {
                                tr {
                                    (word(verdict.holds()))
                                    td class="case" { a href=(format!("#{}", section.name)) { (section.name) } }
                                    td class="claim" { a href=(format!("#{}", place(section, number))) { (verdict.claim) } }
                                    (numbers(verdict))
                                }
                            }
                        }
                    }
                } }
            }
        }
    }
}

/// The place of a claim on the page.
fn place(section: &Section, number: usize) -> String {
    format!("{}-{}", section.name, number + 1)
}

/// What was measured and what is allowed, in two cells that the style sheet names where there is no head.
fn numbers(verdict: &Verdict) -> Markup {
    html! {
        td class="measured" {
            @for found in &verdict.found {
                div {
                    (found.measured)
                    @if !found.by.is_empty() { " " span class="by" { (found.by) } }
                    @if found.history.len() > 1 { " " (small_line(&found.history)) }
                    @if !found.holds && verdict.found.len() > 1 { " " span class="fails" { "✗ FAILS" } }
                }
            }
        }
        td class="allowed" { (verdict.allowed) }
    }
}

/// Width and height of a small line, in pixels.
const SMALL: [f64; 2] = [60.0, 14.0];

/// A line through values, from the smallest to the largest; one that does not change is flat.
fn small_line(values: &[f64]) -> Markup {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [width, height] = SMALL;
    let step = (width - 2.0) / (values.len() - 1) as f64;
    let level = |value: f64| match most - least {
        range if range > 0.0 => (value - least) / range,
        _ => 0.5,
    };
    let points: Vec<String> = values
        .iter()
        .enumerate()
        .map(|(i, &value)| {
            format!(
                "{:.1},{:.1}",
                1.0 + i as f64 * step,
                1.0 + (height - 2.0) * (1.0 - level(value))
            )
        })
        .collect();
    let what = format!("{} reports, from {least:.4e} to {most:.4e}", values.len());
    html! {
        svg class="small" width=(width) height=(height) viewBox=(format!("0 0 {width} {height}")) role="img" {
            title { (what) }
            polyline points=(points.join(" ")) fill="none" stroke="currentColor" {}
        }
    }
}

/// The verdict in one cell of a table.
fn word(holds: bool) -> Markup {
    html! {
        @if holds { td class="holds" { "✓ holds" } } @else { td class="fails" { "✗ FAILS" } }
    }
}
