//! Columns of a list of grains under the names that its scene gives for them: which column is what, and in which unit.

use super::Trouble;
use super::list_header::{Layout, ListColumn, ReadColumn};
use super::list_text::is_number;
use super::numbers::positive;
use crate::quote::quoted;
use crate::scene::format_lists::ColumnsSection;

/// Units that a name may end with, and what they are in m, m/s, kg/m3 and rad/s. (There are two signs for micro.)
const LENGTHS: [(&str, f64); 9] = [
    ("m", 1.0),
    ("dm", 0.1),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("\u{b5}m", 1e-6),
    ("\u{3bc}m", 1e-6),
    ("nm", 1e-9),
    ("km", 1e3),
];
const SPEEDS: [(&str, f64); 4] = [("m/s", 1.0), ("cm/s", 1e-2), ("mm/s", 1e-3), ("um/s", 1e-6)];
const DENSITIES: [(&str, f64); 5] =
    [("kg/m3", 1.0), ("kg/m^3", 1.0), ("g/cm3", 1000.0), ("g/cm^3", 1000.0), ("g/cc", 1000.0)];
const SPINS: [(&str, f64); 3] = [("rad/s", 1.0), ("1/s", 1.0), ("s^-1", 1.0)];

/// Names of columns that a message shows.
const SHOWN: usize = 12;

/// Errors if a section cannot be that of any list.
pub(super) fn check(section: &ColumnsSection, at: &dyn Fn(&str) -> String) -> Result<(), Trouble> {
    named(section, at).map(|_| ())
}

/// The columns that a section names: the key of each, its name in the file, what it is, and its unit in SI.
fn named<'a>(
    section: &'a ColumnsSection,
    at: &dyn Fn(&str) -> String,
) -> Result<Vec<(&'static str, &'a str, ListColumn, f64)>, Trouble> {
    let scale = |key: &str, value: Option<f64>, hint: &str| {
        let value = value.unwrap_or(1.0);
        positive(&at(key), value, hint).map(|()| value)
    };
    let length = scale("lengths_in", section.lengths_in, "m, 1e-3 for mm")?;
    let speed = scale("velocities_in", section.velocities_in, "m/s, 1e-3 for mm/s")?;
    let density = scale("densities_in", section.densities_in, "kg/m3, 1000 for g/cm3")?;
    let all = [
        ("x", Some(&section.x), ListColumn::Place(0), length),
        ("y", Some(&section.y), ListColumn::Place(1), length),
        ("z", Some(&section.z), ListColumn::Place(2), length),
        ("diameter", section.diameter.as_ref(), ListColumn::Diameter, length),
        ("radius", section.radius.as_ref(), ListColumn::Radius, length),
        ("density", section.density.as_ref(), ListColumn::Density, density),
        ("velocity_x", section.velocity_x.as_ref(), ListColumn::Velocity(0), speed),
        ("velocity_y", section.velocity_y.as_ref(), ListColumn::Velocity(1), speed),
        ("velocity_z", section.velocity_z.as_ref(), ListColumn::Velocity(2), speed),
        ("spin_x", section.spin_x.as_ref(), ListColumn::Spin(0), 1.0),
        ("spin_y", section.spin_y.as_ref(), ListColumn::Spin(1), 1.0),
        ("spin_z", section.spin_z.as_ref(), ListColumn::Spin(2), 1.0),
    ];
    let has = |key: &str| all.iter().any(|(known, name, ..)| *known == key && name.is_some());
    match (has("diameter"), has("radius")) {
        (false, false) => {
            let problem = "it names neither a diameter nor a radius";
            return Err(Trouble::new(at("radius"), problem, "add `radius` or `diameter`"));
        }
        (true, true) => {
            let problem = "the size is already given by `diameter`";
            return Err(Trouble::new(at("radius"), problem, "remove one of them"));
        }
        _ => {}
    }
    for vector in [["velocity_x", "velocity_y", "velocity_z"], ["spin_x", "spin_y", "spin_z"]] {
        let is_there = vector.map(has);
        if is_there.contains(&true)
            && let Some(missing) = is_there.iter().position(|there| !there)
        {
            let problem = format!("it is missing: {} belong together", vector.join(", "));
            let remedy = format!("add `{}`, or remove the others", vector[missing]);
            return Err(Trouble::new(at(vector[missing]), problem, remedy));
        }
    }
    let given = |(key, name, what, si_unit): (_, Option<&'a String>, _, _)| {
        Some((key, name?.as_str(), what, si_unit))
    };
    Ok(all.into_iter().filter_map(given).collect())
}

/// Where a list has what: its first line, `names`, read as `section` says. `at` gives the full name of a key of the section, and
/// `file_and_line` where that line stands.
pub(super) fn layout(
    section: &ColumnsSection,
    at: &dyn Fn(&str) -> String,
    names: &[&str],
    file_and_line: &str,
) -> Result<Layout, Trouble> {
    let mut columns: Vec<Option<ReadColumn>> = names.iter().map(|_| None).collect();
    for (key, name, what, si_unit) in named(section, at)? {
        let mut places = names.iter().enumerate().filter(|(_, found)| **found == name.trim());
        let Some((place, _)) = places.next() else {
            return Err(Trouble::new(
                at(key),
                format!("{file_and_line}: there is no column {}", quoted(name)),
                absent_remedy(names),
            ));
        };
        if places.next().is_some() {
            let problem = format!("{file_and_line}: {} is there twice", quoted(name));
            return Err(Trouble::new(at(key), problem, "give the columns different names"));
        }
        if let Some(other) = &columns[place] {
            let problem = format!("{} is already {}", quoted(name), other.what.title());
            return Err(Trouble::new(at(key), problem, "name a column once"));
        }
        // What a name says goes before what is said of all names.
        let si_unit = unit_of(name, what)
            .map_err(|(problem, remedy)| Trouble::new(at(key), problem, remedy))?
            .unwrap_or(si_unit);
        columns[place] = Some(ReadColumn { what, name: name.to_owned(), si_unit });
    }
    Ok(Layout { columns, delimiter: section.delimiter })
}

/// What to do about a column that is not there.
fn absent_remedy(names: &[&str]) -> String {
    let separators = [(';', "semicolon"), ('\t', "tab"), (',', "comma"), (' ', "blanks")];
    let other = |single: &str| separators.into_iter().find(|(sign, _)| single.contains(*sign));
    match names {
        [single] if let Some((_, delimiter)) = other(single) => {
            format!("if columns are separated otherwise, add `delimiter = \"{delimiter}\"`")
        }
        _ if names.iter().all(|name| is_number(name)) => {
            "the names of the columns are missing: put a line with them above the numbers"
                .to_owned()
        }
        _ => {
            let known = names.iter().take(SHOWN).map(|name| quoted(name));
            let more = if names.len() > SHOWN { ", ..." } else { "" };
            format!("its columns are {}{more}", known.collect::<Vec<_>>().join(", "))
        }
    }
}

/// The unit that a name ends with, `X [mm]`, in SI, if it names one. Errors if that is none of the quantity's; of a length any
/// other word may stand there.
fn unit_of(name: &str, what: ListColumn) -> Result<Option<f64>, (String, String)> {
    let Some((_, unit)) = name.trim().trim_end_matches([')', ']']).rsplit_once(['(', '[']) else {
        return Ok(None);
    };
    let (known, key): (&[(&str, f64)], &str) = match what {
        ListColumn::Place(_) | ListColumn::Diameter | ListColumn::Radius => {
            (&LENGTHS, "lengths_in")
        }
        ListColumn::Velocity(_) => (&SPEEDS, "velocities_in"),
        ListColumn::Density => (&DENSITIES, "densities_in"),
        ListColumn::Spin(_) => (&SPINS, ""),
    };
    if let Some((_, si_unit)) = known.iter().find(|(word, _)| *word == unit.trim()) {
        return Ok(Some(*si_unit));
    }
    if key == "lengths_in" {
        return Ok(None);
    }
    let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
    let problem = format!("column {} is in a unit that is not known", quoted(name));
    let more = match key {
        "" => "rename the column and give angles in rad".to_owned(),
        key => format!("rename the column and give the unit by `{key}`"),
    };
    Err((problem, format!("known are {}; else {more}", words.join(", "))))
}
