//! Lists of grains as other DEM codes write them: dumps of LAMMPS and LIGGGHTS, text of YADE. They become lists of our own, line for
//! line, so that messages name the line of the file. Lengths are metres: SI units in LAMMPS (`units si`) and LIGGGHTS.

use std::borrow::Cow;

use super::list_header::{COLUMNS, MOTION_COLUMNS};
use super::list_text::{Fault, numbered_lines};
use crate::quote::quoted;

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

/// The last frame of a dump, with places from the low corner of its box; all other lines become comments. Errors if the frame is
/// cut off, or not in SI units.
fn of_dump(text: &str) -> Result<String, Fault> {
    let lines: Vec<&str> = numbered_lines(text).map(|(_, line)| line.trim()).collect();
    let remedy = "in LAMMPS: dump_modify ... units yes, units si; columns x y z radius";
    let fault = |problem: String| Err((problem, remedy.to_owned()));
    let Some(at) = lines.iter().rposition(|line| line.starts_with(ATOMS)) else {
        return fault("it is a dump without \"ITEM: ATOMS\": it has no grains".to_owned());
    };
    // What follows an item of the same frame, or of one before.
    let after = |item: &str| {
        let place = lines[..at].iter().rposition(|line| line.starts_with(item))?;
        Some(&lines[place + 1..])
    };
    if let Some(&units) = after("ITEM: UNITS").and_then(|rest| rest.first())
        && units != "si"
    {
        return fault(format!("its units are {}; lists are in SI units", quoted(units)));
    }
    let rows: Vec<&str> = lines[at + 1..]
        .iter()
        .copied()
        .take_while(|line| !line.starts_with("ITEM:"))
        .filter(|line| !line.is_empty())
        .collect();
    let count = after("ITEM: NUMBER OF ATOMS").and_then(|rest| rest.first()?.parse::<usize>().ok());
    if let Some(count) = count.filter(|&count| count != rows.len()) {
        let problem =
            format!("its last frame is cut off: {} of {count} grains are there", rows.len());
        let remedy = "remove the lines of that frame, from its \"ITEM: TIMESTEP\" on";
        return Err((problem, remedy.to_owned()));
    }
    let low = |axis: usize| -> f64 {
        let bounds = after("ITEM: BOX BOUNDS").and_then(|rest| rest.get(axis));
        let low = bounds.and_then(|line| line.split_whitespace().next()?.parse().ok());
        low.unwrap_or(0.0)
    };
    let names: Vec<&str> = lines[at][ATOMS.len()..].split_whitespace().collect();
    if let Some(scaled) = names.iter().find(|name| ["xs", "xu", "xsu"].contains(name)) {
        return fault(format!(
            "its places are {}, scaled or unwrapped; x, y and z are read",
            quoted(scaled)
        ));
    }
    // Of a grain that has both the radius counts.
    let is_left_out = |name: &str| name == "diameter" && names.contains(&"radius");
    let known = |name: &&str| {
        let known = DUMP.iter().find(|(theirs, _)| theirs == name);
        known.filter(|_| !is_left_out(name)).map(|(_, ours)| *ours)
    };
    let ours: Vec<Option<&str>> = names.iter().map(known).collect();
    let mut out = "#\n".repeat(at);
    out += &ours.iter().flatten().copied().collect::<Vec<_>>().join(",");
    for row in rows {
        let kept = row.split_whitespace().zip(&ours).filter_map(|(cell, column)| {
            let axis = COLUMNS[..3].iter().position(|name| Some(*name) == *column);
            column.as_ref()?;
            match axis.map(low).filter(|&low| low != 0.0).zip(cell.parse::<f64>().ok()) {
                Some((low, place)) => Some((place - low).to_string()),
                None => Some(cell.to_owned()),
            }
        });
        out.push('\n');
        out += &kept.collect::<Vec<_>>().join(",");
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
