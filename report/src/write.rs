//! Figures to files.

use std::path::Path;

use crate::error::PlotError;
use crate::figure::Figure;
use crate::render::render_svg;

/// Writes a figure to a file that ends in `.svg`, replacing it if it is there. Folders are not
/// created.
///
/// # Errors
/// What [`render_svg`] refuses; a path that is a folder, lies in no folder, or ends otherwise.
pub fn write_svg(figure: &Figure, path: impl AsRef<Path>) -> Result<(), PlotError> {
    let path = path.as_ref();
    let refuse = |reason: String| Err(PlotError::Write { path: path.to_owned(), reason });
    if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg")) {
        return refuse("figures are SVG; let the name end in .svg".into());
    }
    if path.is_dir() {
        return refuse("it is a folder; name a file in it".into());
    }
    let parent = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !parent.is_dir() {
        let parent = parent.display();
        return refuse(format!("the folder {parent} does not exist; create it first"));
    }
    let svg = render_svg(figure)?;
    match std::fs::write(path, svg) {
        Ok(()) => Ok(()),
        Err(error) => refuse(format!("{error}; check the folder's permissions and free space")),
    }
}
