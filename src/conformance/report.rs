//! The verdict as a table for people and as JSON for programs.

use std::fmt;

use serde_json::{Value, json};

use super::diagnosis::Diagnosis;
use super::judge::Verdict;
use super::judged::{Judged, LIMIT, Outcome};
use super::problem::STAGES;
use crate::quote;

/// Problems that the diagnosis goes into; the rest is in the JSON.
const PLACES_SHOWN: usize = 6;

impl fmt::Display for Verdict {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Verdict { candidate, precision, judged, .. } = self;
        writeln!(
            out,
            "{candidate}, judged as {}: errors in epsilon ({:.3e}) times gauge, up to {LIMIT} passes\n",
            precision.name(),
            precision.epsilon()
        )?;
        writeln!(
            out,
            "  stage                              answers  right  wrong  largest error  verdict"
        )?;
        for (stage, title) in STAGES.iter().enumerate() {
            let of: Vec<&Judged> = judged.iter().filter(|judged| judged.stage == stage).collect();
            let tried = of.iter().filter(|j| j.outcome != Outcome::NotAttempted).count();
            let failed = of.iter().filter(|j| j.failed()).count();
            let largest = of.iter().filter_map(|j| error(&j.outcome)).fold(0.0, f64::max);
            let verdict = match (tried, failed) {
                (0, _) => "not attempted".to_owned(),
                (_, 0) if tried < of.len() => {
                    format!("passed ({} not attempted)", of.len() - tried)
                }
                (_, 0) => "passed".to_owned(),
                _ => "FAILED".to_owned(),
            };
            writeln!(
                out,
                "  {stage} {title:<32} {:>7} {:>6} {failed:>6}  {:>13}  {verdict}",
                of.len(),
                tried - failed,
                figure(largest),
            )?;
        }
        let failed: Vec<&Judged> = judged.iter().filter(|judged| judged.failed()).collect();
        if !failed.is_empty() {
            writeln!(out, "\n  wrong answers")?;
        }
        for Judged { problem, answer, outcome, .. } in failed {
            let why = match outcome {
                Outcome::Unusable(reason) => reason.clone(),
                outcome => format!("error {}", figure(error(outcome).unwrap_or(0.0))),
            };
            writeln!(out, "    {problem}/{answer}: {why}")?;
        }
        for name in self.unasked.iter().map(|name| quote::shown(name)) {
            writeln!(out, "  warning: {name} is no answer that the kit asks for: ignored")?;
        }
        if let Some(diagnosis) = &self.diagnosis {
            write!(out, "\n{diagnosis}")?;
        }
        let (attempted, word) = (self.attempted(), if self.passed() { "passed" } else { "FAILED" });
        write!(out, "\n{word}: {attempted} of {} answers attempted", judged.len())
    }
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let [first, rest @ ..] = &self.single[..] {
            let entry = first.mistake.entry();
            writeln!(out, "diagnosis: {}", entry.name)?;
            writeln!(
                out,
                "  {}; with this mistake alone all wrong answers come out as yours",
                entry.what
            )?;
            writeln!(out, "  look at: {}", entry.look_at)?;
            if !first.contradicted.is_empty() {
                let list: Vec<String> = first
                    .contradicted
                    .iter()
                    .map(|(problem, answer)| format!("{problem}/{answer}"))
                    .collect();
                writeln!(
                    out,
                    "  it would have changed these too, which you have right: {}",
                    list.join(", ")
                )?;
            }
            for fit in rest {
                let entry = fit.mistake.entry();
                writeln!(out, "  or, with the same numbers: {}: {}", entry.name, entry.what)?;
            }
            return Ok(());
        }
        writeln!(out, "diagnosis: no single mistake of the catalogue explains all wrong answers")?;
        for (problem, mistakes) in
            self.by_problem.iter().filter(|(_, mistakes)| !mistakes.is_empty())
        {
            writeln!(out, "  {problem} by itself:")?;
            for mistake in mistakes {
                let entry = mistake.entry();
                writeln!(out, "    {}: {}; look at: {}", entry.name, entry.what, entry.look_at)?;
            }
        }
        for place in self.places.iter().take(PLACES_SHOWN) {
            writeln!(out, "  {}/{}: {}", place.problem, place.answer, place.findings.join("; "))?;
        }
        let hidden = self.places.len().saturating_sub(PLACES_SHOWN);
        if hidden > 0 {
            writeln!(out, "  and {hidden} more answers: put the first ones right, or see --json")?;
        }
        Ok(())
    }
}

/// The error of an outcome that has one.
fn error(outcome: &Outcome) -> Option<f64> {
    match outcome {
        Outcome::Right(error) | Outcome::Wrong(error) => Some(*error),
        Outcome::NotAttempted | Outcome::Unusable(_) => None,
    }
}

/// An error with three figures.
fn figure(error: f64) -> String {
    if error < 1e4 { format!("{error:.2}") } else { format!("{error:.2e}") }
}

impl Verdict {
    /// The verdict as one JSON object.
    pub fn to_json(&self) -> Value {
        let answer = |judged: &Judged| {
            let (word, reason) = match &judged.outcome {
                Outcome::NotAttempted => ("not attempted", None),
                Outcome::Right(_) => ("right", None),
                Outcome::Wrong(_) => ("wrong", None),
                Outcome::Unusable(reason) => ("unusable", Some(reason)),
            };
            // JSON has no infinity: a number that is none has no error, only a verdict.
            let error = error(&judged.outcome).filter(|error| error.is_finite());
            json!({
                "stage": judged.stage, "problem": judged.problem, "answer": judged.answer,
                "outcome": word, "error": error, "reason": reason,
            })
        };
        json!({
            "candidate": self.candidate,
            "precision": self.precision.name(),
            "epsilon": self.precision.epsilon(),
            "limit": LIMIT,
            "passed": self.passed(),
            "answers": self.judged.iter().map(answer).collect::<Value>(),
            "unasked": self.unasked,
            "diagnosis": self.diagnosis.as_ref().map(to_json),
        })
    }
}

fn to_json(diagnosis: &Diagnosis) -> Value {
    let single = diagnosis.single.iter().map(|fit| {
        let entry = fit.mistake.entry();
        let contradicted: Vec<String> = fit
            .contradicted
            .iter()
            .map(|(problem, answer)| format!("{problem}/{answer}"))
            .collect();
        json!({
            "mistake": entry.name, "what": entry.what, "look_at": entry.look_at,
            "contradicted": contradicted,
        })
    });
    let by_problem = diagnosis.by_problem.iter().map(|(problem, mistakes)| {
        let names: Vec<&str> = mistakes.iter().map(|mistake| mistake.entry().name).collect();
        json!({ "problem": problem, "mistakes": names })
    });
    let places = diagnosis.places.iter().map(|place| {
        json!({ "problem": place.problem, "answer": place.answer, "findings": place.findings })
    });
    json!({
        "single": single.collect::<Value>(),
        "by_problem": by_problem.collect::<Value>(),
        "places": places.collect::<Value>(),
    })
}
