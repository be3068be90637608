//! No two files of a package need each other, directly or by way of others: each can be read after those that it uses.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The module of a file: the names from the root of its package.
type Module = Vec<String>;

/// The files of a package with their modules.
fn modules(folder: &Path) -> BTreeMap<Module, PathBuf> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(inside) = folders.pop() {
        for entry in fs::read_dir(inside).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                let name = path.strip_prefix(folder).unwrap().with_extension("");
                let mut module: Module =
                    name.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
                if ["mod", "lib", "main"].contains(&module[module.len() - 1].as_str()) {
                    module.pop();
                }
                found.insert(module, path);
            }
        }
    }
    found
}

/// What a text names by a path from `crate`, `super` or `self`, as names from the root.
fn named(text: &str, module: &Module) -> Vec<Module> {
    let code: Vec<&str> =
        text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let code = code.join("\n");
    // Tests inside a file may look at anything.
    let code = code.split("#[cfg(test)]").next().unwrap();
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut found = Vec::new();
    for (at, _) in code.match_indices("::") {
        let before = &code[..at];
        let start = before.rfind(|c| !is_word(c)).map_or(0, |place| place + 1);
        // The first name of its path only.
        if before[..start].ends_with("::") {
            continue;
        }
        let mut from: Module = match &before[start..] {
            "crate" => Vec::new(),
            "self" => module.clone(),
            "super" => module[..module.len().saturating_sub(1)].to_vec(),
            _ => continue,
        };
        let mut rest = &code[at + 2..];
        while let Some(after) = rest.strip_prefix("super::") {
            from.pop();
            rest = after;
        }
        let end = rest.find(|c| !is_word(c) && c != ':').unwrap_or(rest.len());
        let path = rest[..end].trim_end_matches(':').split("::").filter(|name| !name.is_empty());
        from.extend(path.map(str::to_owned));
        match rest[end..].strip_prefix('{') {
            Some(list) => {
                for name in list.split('}').next().unwrap().split(',') {
                    let names =
                        name.trim().split("::").map(|name| name.trim_matches('{').to_owned());
                    found.push(from.iter().cloned().chain(names).collect());
                }
            }
            None => found.push(from),
        }
    }
    found
}

/// Which modules each uses.
fn uses(modules: &BTreeMap<Module, PathBuf>) -> BTreeMap<&Module, BTreeSet<&Module>> {
    let used_by = |(module, path): (&Module, &PathBuf)| -> BTreeSet<Module> {
        let text = fs::read_to_string(path).unwrap();
        let file_of = |name: Module| {
            // The file in which it stands: the longest part of its path that is one.
            (0..=name.len())
                .rev()
                .map(|length| name[..length].to_vec())
                .find(|part| modules.contains_key(part))
        };
        named(&text, module).into_iter().filter_map(file_of).filter(|used| used != module).collect()
    };
    modules
        .iter()
        .map(|entry| {
            let used = used_by(entry);
            (entry.0, modules.keys().filter(|module| used.contains(*module)).collect())
        })
        .collect()
}

/// The modules that remain when those that use none of the others are taken away, again and again.
fn in_circles(folder: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let modules = modules(&root.join(folder));
    let mut left = uses(&modules);
    let count: usize = left.values().map(BTreeSet::len).sum();
    assert!(
        count > modules.len(),
        "{folder}: only {count} uses were found: has their form changed?"
    );
    loop {
        let free: Vec<&Module> =
            left.iter().filter(|(_, used)| used.is_empty()).map(|(&module, _)| module).collect();
        if free.is_empty() {
            break;
        }
        left.retain(|module, _| !free.contains(module));
        left.values_mut().for_each(|used| used.retain(|module| !free.contains(module)));
    }
    let named = |(module, used): (&Module, BTreeSet<&Module>)| {
        let used: Vec<_> = used.into_iter().map(|module| module.join("::")).collect();
        format!("{} uses {}", module.join("::"), used.join(", "))
    };
    left.into_iter().map(named).collect()
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    for folder in ["src", "reference/src", "report/src", "tests/validation/src"] {
        let circles = in_circles(folder);
        assert!(
            circles.is_empty(),
            "{folder}: these files are in a circle of uses, or use one that is (move what both need into a file of \
             its own):\n{}",
            circles.join("\n")
        );
    }
}
