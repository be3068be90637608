//! All that the commands print. A reader who has gone away, or a disk that is full, is no reason for a run
//! to fail: what cannot be printed is lost, and the results are not.

use std::io::Write;

/// Prints a line.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Prints text as it is, for what is made for other programs.
pub fn say_bytes(bytes: &[u8]) {
    let mut out = std::io::stdout();
    let _ = out.write_all(bytes).and_then(|()| out.flush());
}

/// Prints a line where messages go.
pub fn tell(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
