//! The text of a list of grains: its encoding, its lines and their cells, as other programs write them.

use crate::scene::format_lists::DelimiterName;

/// What is wrong, and what to do.
pub(super) type Fault = (String, String);

/// The text of a file. UTF-8, with or without a byte-order mark.
pub(super) fn decoded(bytes: &[u8]) -> Result<&str, Fault> {
    let fault = |problem: String, remedy: &str| Err((problem, remedy.to_owned()));
    let start = &bytes[..bytes.len().min(64)];
    let zeros = start.iter().filter(|&&byte| byte == 0).count();
    let marked = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    // Latin letters in UTF-16 have a zero in each second byte.
    if marked || (3 * zeros > start.len() && 3 * zeros < 2 * start.len()) {
        let remedy = "save it as UTF-8 (\"CSV UTF-8\" in spreadsheets), or convert it: \
                      iconv -f UTF-16 -t UTF-8 old.csv > new.csv";
        return fault("it is UTF-16 text, of which only UTF-8 is read".to_owned(), remedy);
    }
    if let Some(at) = bytes.iter().position(|&byte| byte == 0) {
        let remedy = "give the name of a list of grains: a text file (CSV)";
        return fault(format!("it is not a text file: byte {at} is zero"), remedy);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    std::str::from_utf8(text).or_else(|error| {
        let line = lines_in(&text[..error.valid_up_to()]);
        let remedy = "save it as UTF-8 (\"CSV UTF-8\" in spreadsheets), or convert it: \
                      iconv -f LATIN1 -t UTF-8 old.csv > new.csv";
        fault(format!("it is not UTF-8 text: see line {line}"), remedy)
    })
}

/// The number of the line that `bytes` end in.
fn lines_in(bytes: &[u8]) -> usize {
    let ends = bytes.iter().enumerate().filter(|&(i, &byte)| match byte {
        b'\n' => true,
        b'\r' => bytes.get(i + 1) != Some(&b'\n'),
        _ => false,
    });
    ends.count() + 1
}

/// The lines with their numbers in the file, from 1. They end in LF, CRLF or CR.
pub(super) fn numbered_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut rest = Some(text);
    let mut number = 0;
    std::iter::from_fn(move || {
        let text = rest?;
        number += 1;
        let Some(end) = text.find(['\n', '\r']) else {
            rest = None;
            return Some((number, text));
        };
        let ending = if text[end..].starts_with("\r\n") { 2 } else { 1 };
        rest = Some(&text[end + ending..]);
        Some((number, &text[..end]))
    })
}

/// The cells of a line: separated by commas outside of quotation marks, which are taken off, as are
/// blanks around them.
pub(super) fn cells(line: &str) -> Vec<&str> {
    cells_between(line, DelimiterName::Comma)
}

/// The same between other signs. Blanks separate however many there are.
pub(super) fn cells_between(line: &str, delimiter: DelimiterName) -> Vec<&str> {
    let mut quoted = false;
    let separator = |c: char| {
        quoted ^= c == '"';
        let separates = match delimiter {
            DelimiterName::Comma => c == ',',
            DelimiterName::Semicolon => c == ';',
            DelimiterName::Tab => c == '\t',
            DelimiterName::Blanks => c.is_whitespace(),
        };
        separates && !quoted
    };
    let cells = line.split(separator);
    let cells = cells.filter(|cell| delimiter != DelimiterName::Blanks || !cell.is_empty());
    cells.map(|cell| cell.trim().trim_matches('"').trim()).collect()
}

/// Whether a cell is a number.
pub(super) fn is_number(cell: &str) -> bool {
    cell.parse::<f64>().is_ok() || as_fortran(cell).is_some() || as_decimal_comma(cell).is_some()
}

/// A number of Fortran's double precision, `5.0D-05`, with the E that everyone reads.
pub(super) fn as_fortran(cell: &str) -> Option<String> {
    let with_e = cell.replace(['d', 'D'], "E");
    (with_e != cell && with_e.parse::<f64>().is_ok()).then_some(with_e)
}

/// A number with a decimal comma, with a point.
pub(super) fn as_decimal_comma(cell: &str) -> Option<String> {
    let with_point = cell.replacen(',', ".", 1);
    (with_point != cell && with_point.parse::<f64>().is_ok()).then_some(with_point)
}
