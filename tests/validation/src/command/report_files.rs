//! The files beside the page of `cargo validate report`: figures, rows and copies of what the cases are made from, so
//! that its folder can be moved, and read without the project.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use psmrt_report::{Figure, Link, Picture, write_svg};

use super::report_request::ReportRequest;
use crate::cases::{Case, CaseError, MEDIA};
use crate::failure::Failure;
use psmrt::command::write;
use psmrt::output::atomic;
use psmrt::provenance;
use psmrt::table::Table;

/// Where the copies are, from the page.
const COPIES: &str = "data";

/// Copies files of the folder of a case; their names may lead to another case's folder (`../CASE/FILE`).
pub(super) fn copies<'a>(
    case: &Case,
    files: impl IntoIterator<Item = &'a str>,
    request: &ReportRequest,
) -> Result<Vec<Link>, Failure> {
    let copy = |file: &str| {
        let own = format!("{}/{file}", case.name);
        let name = file.strip_prefix("../").unwrap_or(&own);
        let from = request.golden.join(name);
        let href = format!("{COPIES}/{name}");
        write(&request.out.join(&href), |to| {
            to.parent().map_or(Ok(()), fs::create_dir_all)?;
            let bytes = fs::read(&from).map_err(|error| {
                std::io::Error::new(error.kind(), format!("{}: {error}", from.display()))
            })?;
            atomic::write(to, |out| out.write_all(&bytes))
        })?;
        Ok(Link { text: format!("golden/{name}"), href })
    };
    files.into_iter().map(copy).collect()
}

/// Copies the scene files of a case: those that it runs, then the others of its folder.
pub(super) fn scenes(case: &Case, request: &ReportRequest) -> Result<Vec<Link>, Failure> {
    let folder = fs::read_dir(request.golden.join(case.name)).map_err(CaseError::from)?;
    let names = folder.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let is_other = |name: &String| name.ends_with(".toml") && !case.scenes.contains(&name.as_str());
    let others: BTreeSet<String> = names.filter(is_other).collect();
    copies(case, case.scenes.iter().copied().chain(others.iter().map(String::as_str)), request)
}

/// The picture of a case, and a copy of its film, if it has them.
pub(super) fn media(
    case: &Case,
    request: &ReportRequest,
) -> Result<(Option<Picture>, Option<Link>), Failure> {
    let Some(media) = MEDIA.iter().find(|media| media.case == case.name) else {
        return Ok((None, None));
    };
    let png = fs::read(request.golden.join(case.name).join(media.picture));
    let picture = Picture {
        png_base64: STANDARD.encode(png.map_err(CaseError::from)?),
        caption: media.caption.to_owned(),
    };
    let film = copies(case, [media.film], request)?.pop();
    let film = film.map(|film| Link { text: media.film_caption.to_owned(), ..film });
    Ok((Some(picture), film))
}

/// Writes the figures of a case.
pub(super) fn figures(case: &Case, figures: &[Figure], out: &Path) -> Result<Vec<Link>, Failure> {
    let draw = |(number, figure)| {
        let name = format!("{}_{}.svg", case.name, number + 1);
        write(&out.join(&name), |path| write_svg(figure, path))?;
        Ok(Link { text: name.clone(), href: name })
    };
    figures.iter().enumerate().map(draw).collect()
}

/// Writes the rows that a case has measured, under what a reader of them must know. `read` are the tables of
/// its folder that they come from or needed.
pub(super) fn measured(
    case: &Case,
    rows: &Table,
    read: &BTreeSet<String>,
    request: &ReportRequest,
) -> Result<Link, Failure> {
    let name = format!("{}.csv", case.name);
    let text = header(case, rows, read, request) + &rows.to_csv();
    write(&request.out.join(&name), |path| {
        atomic::write(path, |out| out.write_all(text.as_bytes()))
    })?;
    Ok(Link { text: name.clone(), href: name })
}

fn header(case: &Case, rows: &Table, read: &BTreeSet<String>, request: &ReportRequest) -> String {
    let day = provenance::today();
    let files: Vec<_> =
        case.scenes.iter().copied().chain(read.iter().map(String::as_str)).collect();
    let origin = provenance::program_and_files(&request.golden.join(case.name), &files);
    let made = if case.scenes.is_empty() {
        // Nothing has run: the rows come from committed tables, whose own headers say who made them.
        let tables: Vec<_> =
            read.iter().map(|file| format!("golden/{}/{file}", case.name)).collect();
        format!(
            "Read, not computed, by: {}, at {origin}, {day}; from {}",
            command(case, request),
            tables.join(", ")
        )
    } else {
        let engines: BTreeSet<_> = rows.values("engine").unwrap_or_default().into_iter().collect();
        let engines: Vec<_> = engines.into_iter().collect();
        let scale = if request.full { "full" } else { "quick" };
        format!(
            "Made by: {}, at {origin}, {day}; {scale} scale; engines: {}",
            command(case, request),
            engines.join(", ")
        )
    };
    format!(
        "# {}: what the report holds to its claims.\n# {made}.\n# Units: {}.\n",
        case.title, case.units
    )
}

/// The command that makes the section of a case again.
pub(super) fn command(case: &Case, request: &ReportRequest) -> String {
    let option = |is_given: bool, option: &'static str| if is_given { option } else { "" };
    format!(
        "{} report --case {}{}{}",
        crate::PROGRAM,
        case.name,
        option(request.full, " --full"),
        option(request.oracle_only, " --oracle-only")
    )
}
