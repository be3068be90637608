//! One message about one thing that is wrong with a scene file.

use std::fmt;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use serde::Serialize;

use crate::quote;

/// What a check has found, before anyone has looked up where in the file it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// Dotted path of the key, for example `faces.x_low.velocity` or `records[1].axis`.
    pub key: String,
    /// What is wrong with it, and what would be allowed.
    pub problem: String,
    /// What to do about it.
    pub remedy: String,
}

impl Trouble {
    /// Trouble with the key at `key`.
    pub fn new(
        key: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Trouble { key: key.into(), problem: problem.into(), remedy: remedy.into() }
    }

    /// The same about a line of the file that the key names.
    pub(super) fn on_line(self, line: Option<usize>) -> Self {
        match line {
            Some(line) => Trouble { problem: format!("line {line}: {}", self.problem), ..self },
            None => self,
        }
    }
}

/// A scene that cannot be run: the one message that the user gets. Exit code 2.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneError {
    /// The file, as it was named.
    pub file: String,
    /// Line of the value, from 1; `None` if no place in the file is to blame.
    pub line: Option<usize>,
    /// Dotted path of the key; empty if it is the file as a whole.
    pub key: String,
    /// The value as written.
    pub value: Option<String>,
    /// What is wrong, and what would be allowed.
    pub problem: String,
    /// What to do.
    pub remedy: String,
    /// The text of the file, and the place in it.
    #[serde(skip)]
    pub(super) place: Option<(String, Range<usize>)>,
}

impl std::error::Error for SceneError {}

impl SceneError {
    /// Trouble with a file as a whole.
    pub fn whole_file(
        file: &str,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Box<Self> {
        Box::new(SceneError {
            file: file.to_owned(),
            line: None,
            key: String::new(),
            value: None,
            problem: problem.into(),
            remedy: remedy.into(),
            place: None,
        })
    }

    /// `key = value` as the file has it, or the key alone.
    fn subject(&self) -> String {
        match &self.value {
            Some(value) => format!("{} = {value}", self.key),
            None => self.key.clone(),
        }
    }

    /// The message, with the lines of the file that it is about.
    pub fn render(&self, renderer: &Renderer) -> String {
        let subject = self.subject();
        let title = if subject.is_empty() {
            self.problem.clone()
        } else {
            format!("{subject}: {}", self.problem)
        };
        let group = Level::ERROR.primary_title(quote::lines(&title));
        let group = match &self.place {
            Some((text, span)) => group.element(
                Snippet::source(text)
                    .path(&self.file)
                    .annotation(AnnotationKind::Primary.span(span.clone())),
            ),
            None if self.file.starts_with("--") => {
                group.element(Level::NOTE.message(format!("on the command line, {}", self.file)))
            }
            None => group.element(Level::NOTE.message(format!("in the scene file {}", self.file))),
        };
        renderer.render(&[group.element(Level::HELP.message(quote::lines(&self.remedy)))])
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.render(&Renderer::plain()))
    }
}
