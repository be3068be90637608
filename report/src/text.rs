//! How wide a text will be, without a font to ask.

/// Width in pixels at a font size: DejaVu Sans' widths, the widest of the usual sans-serif fonts.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let ems = |c: char| match c {
        'i' | 'j' | 'l' | '\'' | '|' => 0.30,
        ' ' | '.' | ',' | ':' | ';' | 'I' | '!' => 0.33,
        'f' | 't' | 'r' | '(' | ')' | '/' | '-' | '[' | ']' => 0.40,
        'm' | 'M' | 'W' | '%' | '@' => 0.97,
        'w' | '=' | '+' | '<' | '>' | '~' => 0.84,
        'A'..='Z' => 0.72,
        '0'..='9' => 0.64,
        c if c.is_ascii() => 0.61,
        '\u{1100}'.. => 1.0,
        _ => 0.66,
    };
    text.chars().map(ems).sum::<f64>() * size
}

/// Breaks a text at spaces into lines of at most `room` pixels, and within a word that is longer
/// than that.
pub(crate) fn wrap(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in clean(text).split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(" ", size) + width(word, size) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.extend(pieces(word, size, room)),
        }
    }
    lines
}

fn pieces(word: &str, size: f64, room: f64) -> Vec<String> {
    let mut pieces = vec![String::new()];
    for letter in word.chars() {
        match pieces.last_mut() {
            Some(piece)
                if piece.is_empty()
                    || width(piece, size) + width(&letter.to_string(), size) <= room =>
            {
                piece.push(letter);
            }
            _ => pieces.push(letter.to_string()),
        }
    }
    pieces
}

/// The text without characters that XML forbids; line breaks become spaces.
fn clean(text: &str) -> String {
    let legal = |c: char| match c {
        c if c.is_control() => ' ',
        '\u{FFFE}' | '\u{FFFF}' => '\u{FFFD}',
        c => c,
    };
    text.chars().map(legal).collect()
}
