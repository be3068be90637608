//! Where results come from: the commit that this program was built from, and the day. What is not known is
//! said to be unknown: a record that names a commit it was not made from cannot be repeated.

use std::path::Path;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

/// The commit; `None` if the program was built outside a checkout.
pub const COMMIT: Option<&str> = option_env!("PSMRT_COMMIT");

/// Whether the sources had been changed since the commit; `None` if git could not be asked.
pub fn sources_changed() -> Option<bool> {
    option_env!("PSMRT_MODIFIED").map(|text| text == "true")
}

/// Whether files of a folder that a command reads (scenes, literature) differ from those of the commit,
/// whatever is checked out now; `None` if git cannot say.
pub fn files_changed(folder: &Path, files: &[&str]) -> Option<bool> {
    differ(folder, COMMIT?, files)
}

/// The program alone, as a header of results says it.
pub fn program() -> String {
    words(COMMIT, &[sources_changed()])
}

/// The program and the files that it has read.
pub fn program_and_files(folder: &Path, files: &[&str]) -> String {
    words(COMMIT, &[sources_changed(), files_changed(folder, files)])
}

fn words(commit: Option<&str>, changed: &[Option<bool>]) -> String {
    let Some(commit) = commit else {
        return "an unknown commit (built outside a checkout)".to_owned();
    };
    if changed.contains(&Some(true)) {
        format!("commit {commit} + changes")
    } else if changed.contains(&None) {
        format!("commit {commit}, perhaps with changes (git cannot say)")
    } else {
        format!("commit {commit}")
    }
}

fn differ(folder: &Path, commit: &str, files: &[&str]) -> Option<bool> {
    // To git no files are all files.
    if files.is_empty() {
        return Some(false);
    }
    let git = |arguments: &[&str]| {
        let mut git = Command::new("git");
        git.current_dir(folder).arg("--no-optional-locks").args(arguments).arg("--").args(files);
        // 0: nothing found, 1: something, else: no git, no checkout, no such commit.
        git.output().ok()?.status.code().filter(|code| *code < 2).map(|code| code == 1)
    };
    // Files that git does not know, which `diff` does not see. Outside a checkout this fails, where `diff`
    // would compare the names of files.
    Some(git(&["ls-files", "--error-unmatch"])? || git(&["diff", "--quiet", commit])?)
}

/// Today, UTC: `2026-11-22`.
pub fn today() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
    let (year, month, day) = date(seconds / 86_400);
    format!("{year}-{month:02}-{day:02}")
}

/// Year, month and day of a number of days after 1970-01-01, in the Gregorian calendar.
fn date(days: u64) -> (u64, u64, u64) {
    // Years that begin in March, so that the odd day is their last; 719,468 days lie between 0000-03-01 and
    // 1970-01-01, and 146,097 in 400 years.
    let days = days + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    // Five months from March or August on have 153 days.
    let month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let (month, next_year) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    (400 * era + year_of_era + next_year, month, day)
}

#[cfg(test)]
mod tests {
    use super::{date, differ, words};
    use std::path::Path;
    use std::process::Command;

    #[test]
    fn days_become_dates_in_leap_years_too() {
        let known = [
            (0, (1970, 1, 1)),
            (11_016, (2000, 2, 29)),
            (11_017, (2000, 3, 1)),
            (19_722, (2023, 12, 31)),
            (19_782, (2024, 2, 29)),
            (47_540, (2100, 2, 28)),
            (47_541, (2100, 3, 1)),
        ];
        known.iter().for_each(|&(days, expected)| assert_eq!(date(days), expected));
    }

    #[test]
    fn a_commit_is_named_alone_only_if_nothing_has_changed() {
        assert_eq!(words(Some("a1"), &[Some(false), Some(false)]), "commit a1");
        assert_eq!(words(Some("a1"), &[Some(false), Some(true)]), "commit a1 + changes");
        assert_eq!(words(Some("a1"), &[Some(true), None]), "commit a1 + changes");
        assert!(words(Some("a1"), &[Some(false), None]).contains("perhaps with changes"));
        assert!(words(None, &[None]).contains("unknown"));
    }

    fn git(folder: &Path, arguments: &[&str]) -> String {
        let who = ["-c", "user.name=a", "-c", "user.email=a@b"];
        let output = Command::new("git").current_dir(folder).args(who).args(arguments).output();
        String::from_utf8(output.unwrap().stdout).unwrap().trim().to_owned()
    }

    #[test]
    fn files_are_compared_with_the_commit_and_not_with_what_is_checked_out() {
        let temp = tempfile::tempdir().unwrap();
        let folder = temp.path();
        assert_eq!(differ(folder, "HEAD", &["a"]), None, "outside a checkout git cannot say");
        git(folder, &["init", "--quiet"]);
        std::fs::write(folder.join("a"), "1").unwrap();
        git(folder, &["add", "a"]);
        git(folder, &["commit", "--quiet", "-m", "one"]);
        let first = git(folder, &["rev-parse", "HEAD"]);
        assert_eq!(differ(folder, &first, &["a"]), Some(false));
        std::fs::write(folder.join("b"), "1").unwrap();
        assert_eq!(differ(folder, &first, &["a", "b"]), Some(true), "git does not know b");
        std::fs::write(folder.join("a"), "2").unwrap();
        assert_eq!(differ(folder, &first, &["a"]), Some(true), "not committed");
        git(folder, &["commit", "--quiet", "-a", "-m", "two"]);
        assert_eq!(differ(folder, &first, &["a"]), Some(true), "committed later");
        assert_eq!(differ(folder, "HEAD", &["a"]), Some(false));
        assert_eq!(differ(folder, &first, &[]), Some(false), "no files are not all files");
        assert_eq!(differ(folder, "0123456789", &["a"]), None, "no such commit");
    }
}
