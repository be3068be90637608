//! Grains from a CSV file.

use std::path::Path;

use super::Trouble;
use super::grains::Ball;

/// The first line of a list of grains; the last column may be absent.
pub const COLUMNS: [&str; 5] = ["x (m)", "y (m)", "z (m)", "diameter (m)", "density (kg/m3)"];

/// Columns that must be there.
const NEEDED: usize = 4;

/// The contents of a file and the grains in it.
pub(super) fn read(key: &str, path: &Path) -> Result<(Vec<u8>, Vec<Ball>), Trouble> {
    let shown = path.display();
    let bytes = std::fs::read(path).map_err(|error| {
        let remedy = "the name is relative to the scene file";
        Trouble::new(key, format!("{shown} cannot be read: {error}"), remedy)
    })?;
    let wanted = COLUMNS[..NEEDED].join(",");
    let mut reader =
        csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(&bytes[..]);
    let bad = |line: u64, problem: String, remedy: String| {
        Err(Trouble::new(key, format!("{shown}, line {line}: {problem}"), remedy))
    };
    let columns = match reader.headers() {
        Ok(columns) => columns.clone(),
        Err(error) => return bad(1, error.to_string(), format!("let it start with {wanted}")),
    };
    for (number, name) in COLUMNS.iter().enumerate() {
        if columns.get(number) != Some(name) && (number < NEEDED || columns.len() > NEEDED) {
            let found = columns.get(number).unwrap_or("");
            let problem = format!("column {} is \"{found}\", not \"{name}\"", number + 1);
            let remedy = format!("let the first line be {wanted} and perhaps ,{}", COLUMNS[NEEDED]);
            return bad(1, problem, remedy);
        }
    }
    if let Some(extra) = columns.get(COLUMNS.len()) {
        return bad(
            1,
            format!("there is a column too many, \"{extra}\""),
            format!("keep {wanted}"),
        );
    }
    let mut balls = Vec::new();
    for row in reader.records() {
        let row = match row {
            Ok(row) => row,
            Err(error) => {
                let line = error.position().map_or(1, csv::Position::line);
                return bad(line, error.to_string(), format!("each line has {wanted}"));
            }
        };
        let line = row.position().map_or(1, csv::Position::line);
        let mut values = [0.0; COLUMNS.len()];
        for (number, value) in values.iter_mut().enumerate().take(columns.len()) {
            let text = row.get(number).unwrap_or("");
            *value = match text.parse::<f64>() {
                Ok(value) if value.is_finite() && (number < 3 || value > 0.0) => value,
                _ => {
                    let problem = format!("{} = \"{text}\" is not allowed", COLUMNS[number]);
                    let remedy = "give finite numbers, and diameter and density above 0";
                    return bad(line, problem, remedy.to_owned());
                }
            };
        }
        let [x, y, z, si_diameter, density] = values;
        let si_density = (columns.len() > NEEDED).then_some(density);
        balls.push(Ball { si_centre: [x, y, z], si_diameter, si_density });
    }
    if balls.is_empty() {
        return bad(2, "there are no grains in it".to_owned(), "add a line for each".to_owned());
    }
    Ok((bytes, balls))
}
