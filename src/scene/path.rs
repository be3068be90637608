//! The dotted path of a key in a document.

use toml_edit::Item;

/// A dotted path: `records[1].axis` is `records`, 1, `axis`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Path(pub Vec<Step>);

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Name(String),
    Number(usize),
}

impl Path {
    /// Reads a path; `None` if it is none.
    pub fn parse(key: &str) -> Option<Self> {
        let mut steps = Vec::new();
        for part in key.split('.') {
            let mut pieces = part.trim().split('[');
            let name = pieces.next().unwrap_or("").trim();
            if name.is_empty() {
                return None;
            }
            steps.push(Step::Name(name.to_owned()));
            for piece in pieces {
                steps.push(Step::Number(piece.trim().strip_suffix(']')?.parse().ok()?));
            }
        }
        Some(Path(steps))
    }

    /// What it leads to.
    pub fn walk<'a>(&self, root: &'a Item) -> Option<&'a Item> {
        self.0.iter().try_fold(root, |item, step| match step {
            Step::Name(name) => item.get(name),
            Step::Number(number) => item.get(number),
        })
    }

    /// The same, to be changed.
    pub fn walk_mut<'a>(&self, root: &'a mut Item) -> Option<&'a mut Item> {
        self.0.iter().try_fold(root, |item, step| match step {
            Step::Name(name) => item.get_mut(name),
            Step::Number(number) => item.get_mut(number),
        })
    }
}
