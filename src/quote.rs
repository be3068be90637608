//! How text of the user's (keys, values, cells of lists, names of files) stands in messages: of a sane
//! length, and with what no terminal should be sent written out as an escape.

use std::path::Path;

/// Characters of a key, a value or a cell that are shown.
pub const LONGEST: usize = 60;

/// Characters of a line of a message: paths are shown whole up to this.
const LONGEST_LINE: usize = 1000;

/// A key, a value or a word of the user's, without quotation marks around it.
pub fn shown(text: &str) -> String {
    cut(text, LONGEST)
}

/// The same in quotation marks, where its ends would not be seen otherwise.
pub fn quoted(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        None => format!("\"{}\"", cut(text, LONGEST)),
        Some((end, _)) => {
            format!("\"{}\"... ({} bytes)", cut(&text[..end], LONGEST), text.len())
        }
    }
}

/// The name of a file.
pub fn path(path: &Path) -> String {
    cut(&path.to_string_lossy(), LONGEST_LINE)
}

/// A whole message: its lines stay lines.
pub fn lines(text: &str) -> String {
    text.split('\n').map(|line| cut(line, LONGEST_LINE)).collect::<Vec<_>>().join("\n")
}

fn cut(text: &str, most: usize) -> String {
    let mut out: String = text.chars().take(most).map(escaped).collect();
    if text.chars().nth(most).is_some() {
        out.push_str(&format!("... ({} bytes)", text.len()));
    }
    out
}

/// A character as it may be printed: control characters move the cursor or ring bells, those of
/// formatting hide or turn around what stands beside them.
fn escaped(c: char) -> String {
    let of_formatting = matches!(
        c,
        '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
    );
    if c.is_control() || of_formatting { c.escape_default().to_string() } else { c.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_terminal_should_get_is_written_out() {
        assert_eq!(shown("a\u{1b}[31mb\r\n\u{202e}é🦀"), "a\\u{1b}[31mb\\r\\n\\u{202e}é🦀");
        assert_eq!(quoted("two"), "\"two\"");
        assert_eq!(lines("a\nb\u{7}"), "a\nb\\u{7}");
    }

    #[test]
    fn long_text_is_cut_and_its_length_told() {
        let long = "é".repeat(100_000);
        assert_eq!(shown(&long), format!("{}... (200000 bytes)", "é".repeat(60)));
        assert_eq!(quoted(&long), format!("\"{}\"... (200000 bytes)", "é".repeat(60)));
        assert!(lines(&long).len() < 2100);
    }
}
