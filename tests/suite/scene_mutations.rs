//! No scene file, however mangled, makes the reader panic.

use std::path::Path;

use proptest::prelude::*;
use psmrt::scene::Scene;

const SCENES: [&str; 4] = [
    include_str!("../../golden/poiseuille/scene.toml"),
    include_str!("../../golden/sphere_arrays/scene.toml"),
    include_str!("../../golden/stokes_settling/scene.toml"),
    include_str!("../../golden/cloud_settling/scene.toml"),
];

/// Pieces that are put in: valid and less valid TOML.
const PIECES: [&str; 29] = [
    "nan",
    "-inf",
    "1e400",
    "-1",
    "0",
    "9223372036854775807",
    "\"\"",
    "[",
    "]",
    "[[",
    "{",
    "}",
    "=",
    ".",
    "\n",
    "\"",
    "'",
    "#",
    "[[grains]]\n",
    "kind = \"csv\"\nfile = \"/\"\n",
    "\u{0}",
    "é",
    "🦀",
    "steps = 3\n",
    "[contact]\nduration = 1e-4\n",
    "[lubrication]\n",
    "kind = \"random\"\ncount = 30\n",
    "kind.free_slip",
    "form = \"body_force\"\n",
];

/// One change of a text.
#[derive(Clone, Debug)]
enum Change {
    Insert(usize, usize),
    Delete(usize, usize),
    SwapLines(usize, usize),
    Replace(usize, char),
    DuplicateLine(usize),
}

fn change() -> impl Strategy<Value = Change> {
    let place = || 0..4096_usize;
    prop_oneof![
        (place(), 0..PIECES.len()).prop_map(|(at, piece)| Change::Insert(at, piece)),
        (place(), 1..40_usize).prop_map(|(at, length)| Change::Delete(at, length)),
        (place(), place()).prop_map(|(a, b)| Change::SwapLines(a, b)),
        (place(), any::<char>()).prop_map(|(at, c)| Change::Replace(at, c)),
        place().prop_map(Change::DuplicateLine),
    ]
}

fn apply(text: &str, change: &Change) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    let n = chars.len().max(1);
    match *change {
        Change::Insert(at, piece) => {
            let at = at % n;
            chars.splice(at..at, PIECES[piece].chars());
        }
        Change::Delete(at, length) => {
            let at = (at % n).min(chars.len());
            chars.drain(at..(at + length).min(chars.len()));
        }
        Change::Replace(at, c) => {
            if let Some(slot) = chars.get_mut(at % n) {
                *slot = c;
            }
        }
        Change::SwapLines(a, b) => {
            let mut lines: Vec<&str> = text.split('\n').collect();
            let n = lines.len();
            lines.swap(a % n, b % n);
            return lines.join("\n");
        }
        Change::DuplicateLine(at) => {
            let mut lines: Vec<&str> = text.split('\n').collect();
            let at = at % lines.len();
            lines.insert(at, lines[at]);
            return lines.join("\n");
        }
    }
    chars.into_iter().collect()
}

fn read(bytes: Vec<u8>, changes: &[String]) {
    if let Err(error) = Scene::from_bytes("scene.toml", bytes, Path::new("."), changes) {
        let said = error.to_string();
        assert!(said.contains("scene.toml") || said.contains("--set"), "{said}");
        assert!(said.contains("help: "), "{said}");
    }
}

/// Inputs of each kind: 4,000, or as many as `PROPTEST_CASES` says (400,000 were tried
/// once, and 200,000 with the scenes of free grains).
fn cases() -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(4000)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    #[test]
    fn mangled_scenes_are_read_or_refused(
        scene in 0..SCENES.len(),
        changes in prop::collection::vec(change(), 1..6),
    ) {
        let text = changes.iter().fold(SCENES[scene].to_owned(), |text, c| apply(&text, c));
        read(text.into_bytes(), &[]);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        read(bytes, &[]);
    }

    #[test]
    fn any_change_is_made_or_refused(key in "[a-z_.\\[\\]0-9]{0,20}", value in "\\PC{0,12}") {
        read(SCENES[1].as_bytes().to_vec(), &[format!("{key}={value}")]);
    }
}
