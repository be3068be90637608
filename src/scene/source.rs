//! The text of a scene file: parsed, and searched for the place of a key.

use std::ops::Range;

use toml_edit::{Document, DocumentMut, Item};

use super::path::Path;
use super::trouble::{SceneError, Trouble};
use super::{changes, shape};
use crate::quote;

/// A scene file that is valid TOML.
#[derive(Clone, Debug)]
pub struct Source {
    /// How the user named the file.
    pub file: String,
    /// Its text, with the changes of `--set`.
    pub text: String,
    document: Document<String>,
}

impl Source {
    /// Parses `bytes` and applies `changes`, each `key=value`.
    pub fn new(file: &str, bytes: Vec<u8>, changes: &[String]) -> Result<Self, Box<SceneError>> {
        let text = String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            let problem = format!("this is not a text file: byte {at} is not UTF-8");
            SceneError::whole_file(file, problem, "give the name of a scene file (TOML, UTF-8)")
        })?;
        if text.trim().is_empty() {
            let remedy =
                "start from a scene under golden/, for example golden/poiseuille/scene.toml";
            return Err(SceneError::whole_file(file, "the file is empty", remedy));
        }
        let (mut file, mut text) = (file.to_owned(), text);
        if !changes.is_empty() {
            let document =
                text.parse::<DocumentMut>().map_err(|error| syntax(&file, &text, &error))?;
            text = changes::applied(document, changes)?;
            file.push_str(" (with --set)");
        }
        let document =
            Document::parse(text.clone()).map_err(|error| syntax(&file, &text, &error))?;
        Ok(Source { file, text, document })
    }

    /// Reads the document into a type. Errors name the key and the place.
    pub fn read<T: serde::de::DeserializeOwned>(&self) -> Result<T, Box<SceneError>> {
        shape::check(self.document.as_table()).map_err(|misfit| {
            let span = misfit.span.unwrap_or_else(|| self.span_of(&misfit.key));
            self.error_at(&misfit.key, span, misfit.problem, misfit.remedy)
        })?;
        toml_edit::de::from_document(self.document.clone()).map_err(|error| {
            let remedy = "see `psmrt schema` for what a scene may hold".to_owned();
            let problem = quote::shown(error.message());
            self.error_at("", error.span().unwrap_or(0..0), problem, remedy)
        })
    }

    /// The error for trouble with a key: looks up its place and its value.
    pub fn error(&self, trouble: Trouble) -> Box<SceneError> {
        let span = self.span_of(&trouble.key);
        self.error_at(&trouble.key, span, trouble.problem, trouble.remedy)
    }

    fn error_at(
        &self,
        key: &str,
        span: Range<usize>,
        problem: String,
        remedy: String,
    ) -> Box<SceneError> {
        let line = self.text[..span.start].matches('\n').count() + 1;
        let value = quote::shown(self.text.get(span.clone()).unwrap_or(""));
        let is_value = Path::parse(key)
            .and_then(|path| path.walk(self.document.as_item()).cloned())
            .is_some_and(|item| item.is_value() && item.span().as_ref() == Some(&span));
        Box::new(SceneError {
            file: self.file.clone(),
            line: Some(line),
            key: quote::shown(key),
            value: is_value.then_some(value),
            problem,
            remedy,
            place: Some((self.text.clone(), span)),
        })
    }

    /// The place of a key's value, or of the closest table around it.
    fn span_of(&self, key: &str) -> Range<usize> {
        let mut path = Path::parse(key).unwrap_or(Path(Vec::new()));
        while !path.0.is_empty() {
            if let Some(span) = path.walk(self.document.as_item()).and_then(Item::span) {
                return span;
            }
            path.0.pop();
        }
        0..self.text.lines().next().map_or(0, str::len)
    }
}

/// The error for text that is not TOML.
fn syntax(file: &str, text: &str, error: &toml_edit::TomlError) -> Box<SceneError> {
    let span = error.span().unwrap_or(0..0);
    let end = span.end.min(text.len());
    let start = span.start.min(end);
    let found = quote::shown(text.get(start..end).unwrap_or(""));
    let (problem, remedy) = match error.message() {
        "integer number overflowed" => (
            format!("{found} is too large for a whole number: 9223372036854775807 is the limit"),
            "write a smaller one; where any number may stand, 1e30 is one",
        ),
        "floating-point number overflowed" => (
            format!("{found} is too large for a number: 1.8e308 is the limit"),
            "write a smaller one",
        ),
        message => (
            format!("this is not valid TOML: {}", quote::shown(message)),
            "a line is `key = value`, a section starts with [name]; text needs \"quotes\"",
        ),
    };
    Box::new(SceneError {
        file: file.to_owned(),
        line: Some(text[..start].matches('\n').count() + 1),
        key: String::new(),
        value: None,
        problem,
        remedy: remedy.to_owned(),
        place: Some((text.to_owned(), start..end)),
    })
}
