//! The claims of a report: merged over the engines, as a table, and printed.

use std::ops::RangeInclusive;
use std::path::Path;

use psmrt::command::say::say;
use psmrt::engine::EngineName;
use psmrt::table::Table;
use psmrt_report::{Found, Page, Verdict};
use serde_json::json;

use crate::cases::Claim;
use crate::history::History;

/// The engine that a claim is of, and what is claimed of it; no engine where a study or a table is judged.
fn split(claim: &Claim) -> (Option<EngineName>, &str) {
    let split = claim.what.split_once(": ");
    let of = split.and_then(|(word, rest)| Some((EngineName::from_word(word)?, rest)));
    of.map_or((None, claim.what.as_str()), |(engine, rest)| (Some(engine), rest))
}

/// The claims of a case as verdicts, in their order: those that engines share are one, if as much is allowed of each.
pub(super) fn merged(case: &str, claims: &[Claim], history: &History) -> Vec<Verdict> {
    let mut verdicts: Vec<Verdict> = Vec::new();
    for claim in claims {
        let (engine, what) = split(claim);
        let by = engine.map_or("", EngineName::word);
        let mut before = history.of(case, what, by);
        before.push(claim.measured);
        let found = Found {
            by: by.to_owned(),
            measured: short(claim.measured),
            holds: claim.holds(),
            history: before,
        };
        let allowed = allowed(&claim.allowed);
        let is_same = |verdict: &&mut Verdict| {
            engine.is_some()
                && verdict.claim == what
                && verdict.allowed == allowed
                && verdict.why == claim.why
                && verdict.found.iter().all(|other| !other.by.is_empty() && other.by != found.by)
        };
        if let Some(verdict) = verdicts.iter_mut().find(is_same) {
            verdict.found.push(found);
        } else {
            verdicts.push(Verdict {
                claim: what.to_owned(),
                found: vec![found],
                allowed,
                why: claim.why.to_owned(),
            });
        }
    }
    verdicts
}

/// All claims of the cases, with their numbers as they are.
pub(super) fn written(all: &[(&str, Vec<Claim>)]) -> Table {
    let mut table =
        Table::new(&["case", "claim", "engine", "measured", "at_least", "at_most", "holds"]);
    for (case, claims) in all {
        for claim in claims {
            let (engine, what) = split(claim);
            let (low, high) = (claim.allowed.start(), claim.allowed.end());
            table.add(vec![
                (*case).to_owned(),
                what.to_owned(),
                engine.map_or("", EngineName::word).to_owned(),
                format!("{:.6e}", claim.measured),
                low.to_string(),
                high.to_string(),
                claim.holds().to_string(),
            ]);
        }
    }
    table
}

/// A range as a reader says it: both ends, or the one that there is.
fn allowed(range: &RangeInclusive<f64>) -> String {
    let (low, high) = (*range.start(), *range.end());
    if low == high {
        format!("exactly {}", short(low))
    } else if high == f64::INFINITY {
        format!("at least {}", short(low))
    } else {
        format!("{} to {}", short(low), short(high))
    }
}

/// A number in a few characters.
fn short(value: f64) -> String {
    if value.is_finite() && value != 0.0 && !(0.001..1e4).contains(&value.abs()) {
        return format!("{value:.1e}");
    }
    let text = format!("{value:.4}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Says every verdict, and where the page is.
pub(super) fn print(page: &Page, index: &Path, json: bool) {
    let verdicts = || page.sections.iter().flat_map(|s| s.verdicts.iter().map(|v| (&s.name, v)));
    if json {
        let all: Vec<_> = verdicts()
            .flat_map(|(case, v)| v.found.iter().map(move |found| (case, v, found)))
            .map(|(case, v, found)| {
                json!({ "case": case, "claim": v.claim, "engine": found.by, "measured": found.measured,
                        "allowed": v.allowed, "holds": found.holds })
            })
            .collect();
        say(&json!({ "page": index.display().to_string(), "holds": page.holds(), "claims": all })
            .to_string());
        return;
    }
    for (case, v) in verdicts() {
        let word = if v.holds() { "holds" } else { "FAILS" };
        let found: Vec<_> =
            v.found.iter().map(|found| format!("{} {}", found.measured, found.by)).collect();
        let found = found.iter().map(|text| text.trim_end()).collect::<Vec<_>>().join("; ");
        say(&format!("{word}  {case}: {}: {found} ({})", v.claim, v.allowed));
    }
    say(&format!("report in {}", index.display()));
}

#[cfg(test)]
mod tests {
    use super::{merged, written};
    use crate::cases::Claim;
    use crate::history::History;

    fn claim(what: &str, measured: f64, most: f64) -> Claim {
        Claim { what: what.to_owned(), measured, allowed: 0.0..=most, why: "it is so" }
    }

    #[test]
    fn a_claim_that_engines_share_is_one_row_and_fails_with_the_worst_of_them() {
        let claims = [
            claim("reference: error", 0.1, 0.2),
            claim("study: error", 0.1, 0.2),
            claim("cpu: error", 0.3, 0.2),
            claim("wgpu: error", 0.1, 0.3),
        ];
        let rows = merged("duct", &claims, &History::default());
        let names: Vec<_> = rows.iter().map(|row| (row.claim.as_str(), row.found.len())).collect();
        assert_eq!(
            names,
            [("error", 2), ("study: error", 1), ("error", 1)],
            "one with other bounds stays apart"
        );
        assert!(!rows[0].holds() && rows[0].found[0].holds && rows[2].holds());
        assert_eq!(written(&[("duct", claims.to_vec())]).rows.len(), 4, "the table has each");
    }
}
