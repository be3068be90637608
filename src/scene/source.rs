//! The text of a scene file: parsed, changed by `--set`, and searched for the place of a key.

use std::ops::Range;

use toml_edit::{Document, DocumentMut, Item, Table, TableLike, Value};

use super::trouble::{SceneError, Trouble};

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
            let mut document =
                text.parse::<DocumentMut>().map_err(|error| syntax(&file, &text, &error))?;
            for change in changes {
                set(&mut document, change).map_err(|trouble| {
                    SceneError::whole_file("--set", trouble.problem, trouble.remedy)
                })?;
            }
            text = document.to_string();
            file.push_str(" (with --set)");
        }
        let document =
            Document::parse(text.clone()).map_err(|error| syntax(&file, &text, &error))?;
        Ok(Source { file, text, document })
    }

    /// Reads the document into a type. Errors name the key and the place.
    pub fn read<T: serde::de::DeserializeOwned>(&self) -> Result<T, Box<SceneError>> {
        toml_edit::de::from_document(self.document.clone()).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            let (key, problem, remedy) =
                super::words::of_serde(error.message(), &self.key_at(&span), self.slice(&span));
            self.error_at(key, span, problem, remedy)
        })
    }

    /// The error for trouble with a key: looks up its place and its value.
    pub fn error(&self, trouble: Trouble) -> Box<SceneError> {
        let span = self.span_of(&trouble.key);
        self.error_at(trouble.key, span, trouble.problem, trouble.remedy)
    }

    fn error_at(
        &self,
        key: String,
        span: Range<usize>,
        problem: String,
        remedy: String,
    ) -> Box<SceneError> {
        let line = self.text[..span.start].matches('\n').count() + 1;
        let (path, value) = (Path::of(&key), self.slice(&span).to_owned());
        let is_value = path
            .walk(&self.document)
            .is_some_and(|item| item.is_value() && item.span().as_ref() == Some(&span));
        Box::new(SceneError {
            file: self.file.clone(),
            line: Some(line),
            key,
            value: is_value.then_some(value),
            problem,
            remedy,
            place: Some((self.text.clone(), span)),
        })
    }

    fn slice(&self, span: &Range<usize>) -> &str {
        self.text.get(span.clone()).unwrap_or("")
    }

    /// The place of a key's value, or of the closest table around it.
    fn span_of(&self, key: &str) -> Range<usize> {
        let mut path = Path::of(key);
        loop {
            if let Some(span) = path.walk(&self.document).and_then(Item::span) {
                return span;
            }
            if path.0.pop().is_none() {
                return 0..self.text.lines().next().map_or(0, str::len);
            }
        }
    }

    /// The dotted path of the innermost key whose name or value contains `span`.
    fn key_at(&self, span: &Range<usize>) -> String {
        let mut path = String::new();
        descend(self.document.as_table(), span, &mut path);
        path
    }
}

/// Appends the path of the innermost key in `table` that contains `span`.
fn descend(table: &dyn TableLike, span: &Range<usize>, path: &mut String) {
    let holds = |outer: Option<Range<usize>>| {
        outer.is_some_and(|outer| outer.start <= span.start && span.end <= outer.end)
    };
    for (name, item) in table.iter() {
        let key_span = table.get_key_value(name).and_then(|(key, _)| key.span());
        let length = path.len();
        if !path.is_empty() {
            path.push('.');
        }
        path.push_str(name);
        if holds(key_span) {
            return;
        }
        match item {
            Item::ArrayOfTables(tables) => {
                for (number, table) in tables.iter().enumerate() {
                    let length = path.len();
                    path.push_str(&format!("[{number}]"));
                    let before = path.len();
                    descend(table, span, path);
                    if path.len() > before || holds(table.span()) {
                        return;
                    }
                    path.truncate(length);
                }
            }
            Item::Table(_) | Item::Value(Value::InlineTable(_)) => {
                let before = path.len();
                if let Some(inner) = item.as_table_like() {
                    descend(inner, span, path);
                }
                if path.len() > before || holds(item.span()) {
                    return;
                }
            }
            _ if holds(item.span()) => return,
            _ => {}
        }
        path.truncate(length);
    }
}

/// A dotted path: `records[1].axis` is `records`, 1, `axis`.
struct Path(Vec<Step>);

enum Step {
    Name(String),
    Number(usize),
}

impl Path {
    fn of(key: &str) -> Self {
        let mut steps = Vec::new();
        for part in key.split('.').filter(|part| !part.is_empty()) {
            let mut pieces = part.split('[');
            steps.extend(pieces.next().map(|name| Step::Name(name.trim().to_owned())));
            let numbers = pieces.filter_map(|piece| piece.strip_suffix(']')?.parse().ok());
            steps.extend(numbers.map(Step::Number));
        }
        Path(steps)
    }

    fn walk<'a>(&self, document: &'a Document<String>) -> Option<&'a Item> {
        self.0.iter().try_fold(document.as_item(), |item, step| match step {
            Step::Name(name) => item.get(name),
            Step::Number(number) => item.get(number),
        })
    }
}

/// The error for text that is not TOML.
fn syntax(file: &str, text: &str, error: &toml_edit::TomlError) -> Box<SceneError> {
    let span = error.span().unwrap_or(0..0);
    let end = span.end.min(text.len());
    let start = span.start.min(end);
    Box::new(SceneError {
        file: file.to_owned(),
        line: Some(text[..start].matches('\n').count() + 1),
        key: String::new(),
        value: None,
        problem: format!("this is not valid TOML: {}", error.message()),
        remedy: "a line is `key = value`, a section starts with [name]; text needs \"quotes\""
            .to_owned(),
        place: Some((text.to_owned(), start..end)),
    })
}

/// Applies one `key=value` of the command line.
fn set(document: &mut DocumentMut, change: &str) -> Result<(), Trouble> {
    let remedy = "write it as --set fluid.density=998 or --set collision.rates=magic";
    let bad = |problem: String| Trouble::new("", problem, remedy);
    let Some((key, value)) = change.split_once('=') else {
        return Err(bad(format!("--set {change} has no `=`")));
    };
    // What is not a TOML value (a bare word) is taken for text.
    let value =
        value.trim().parse::<Value>().unwrap_or_else(|_| Value::from(value.trim().to_owned()));
    let Path(steps) = Path::of(key);
    let Some((last, parents)) = steps.split_last() else {
        return Err(bad(format!("--set {change} names no key")));
    };
    let mut item = document.as_item_mut();
    for step in parents {
        item = match step {
            Step::Name(name) => item
                .as_table_like_mut()
                .map(|table| table.entry(name).or_insert(Item::Table(Table::new()))),
            Step::Number(number) => item.get_mut(number),
        }
        .ok_or_else(|| bad(format!("--set {change}: the scene has no such section")))?;
    }
    let slot = match last {
        Step::Name(name) => {
            item.as_table_like_mut().map(|table| table.entry(name).or_insert(Item::None))
        }
        Step::Number(number) => item.get_mut(number),
    };
    let slot = slot.ok_or_else(|| bad(format!("--set {change}: the scene has no such key")))?;
    *slot = Item::Value(value);
    Ok(())
}
