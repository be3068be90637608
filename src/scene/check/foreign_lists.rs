//! Lists of grains as other DEM codes write them: dumps of LAMMPS and LIGGGHTS, text of YADE. They become lists of our own, line for
//! line, so that messages name the line of the file. Lengths are metres: SI units in LAMMPS (`units si`) and LIGGGHTS.

use std::borrow::Cow;

use super::list_header::{COLUMNS, MOTION_COLUMNS};
use super::list_text::{Fault, numbered_lines};

/// Columns of a dump, and what they are called here.
const DUMP: [(&str, &str); 12] = [
    ("x", COLUMNS[0]),
    ("y", COLUMNS[1]),
    ("z", COLUMNS[2]),
    ("diameter", COLUMNS[3]),
    ("radius", "radius (m)"),
    ("density", COLUMNS[4]),
    ("vx", MOTION_COLUMNS[0]),
    ("vy", MOTION_COLUMNS[1]),
    ("vz", MOTION_COLUMNS[2]),
    ("omegax", MOTION_COLUMNS[3]),
    ("omegay", MOTION_COLUMNS[4]),
    ("omegaz", MOTION_COLUMNS[5]),
];

/// Where a dump has the grains of a frame.
const ATOMS: &str = "ITEM: ATOMS";

/// The text as a list of our own; as it is if it is none of the others'.
pub(super) fn as_list(text: &str) -> Result<Cow<'_, str>, Fault> {
    let first = text.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("");
    if first.starts_with("ITEM:") {
        of_dump(text).map(Cow::Owned)
    } else if first.starts_with("#format x_y_z_r") {
        Ok(Cow::Owned(of_yade(text)))
    } else {
        Ok(Cow::Borrowed(text))
    }
}

/// The last frame of a dump; all other lines become comments.
fn of_dump(text: &str) -> Result<String, Fault> {
    let lines: Vec<&str> = numbered_lines(text).map(|(_, line)| line.trim()).collect();
    let Some(at) = lines.iter().rposition(|line| line.starts_with(ATOMS)) else {
        let problem = "it is a dump without \"ITEM: ATOMS\": it has no grains".to_owned();
        return Err((problem, "dump custom with x y z radius".to_owned()));
    };
    let names: Vec<&str> = lines[at][ATOMS.len()..].split_whitespace().collect();
    let known = |name: &&str| DUMP.iter().find(|(theirs, _)| theirs == name).map(|(_, ours)| *ours);
    let ours: Vec<Option<&str>> = names.iter().map(known).collect();
    let list = |cells: Vec<&str>| -> String { cells.join(",") };
    let mut out = "#\n".repeat(at);
    out += &list(ours.iter().flatten().copied().collect());
    for line in &lines[at + 1..] {
        let cells = line.split_whitespace();
        let kept = cells.zip(&ours).filter(|(_, column)| column.is_some()).map(|(cell, _)| cell);
        out.push('\n');
        out += &list(kept.collect());
    }
    Ok(out)
}

/// YADE's `export.text`: x, y, z, radius and perhaps more, separated by blanks.
fn of_yade(text: &str) -> String {
    let lines = numbered_lines(text).enumerate().map(|(number, (_, line))| match number {
        0 => format!("{},radius (m)", COLUMNS[..3].join(",")),
        _ if line.trim_start().starts_with('#') => "#".to_owned(),
        _ => line.split_whitespace().take(4).collect::<Vec<_>>().join(","),
    });
    lines.collect::<Vec<_>>().join("\n")
}
