//! Checksums of the kit: of the bytes, and of the values for machines that round differently.

use std::collections::BTreeMap;
use std::fmt::Write;

use sha2::{Digest, Sha256};

use super::KIT_VERSION;
use super::array::Array;
use super::given::inputs;
use super::kit::Kit;

/// How far kits that were made on different machines may differ, in double precision's epsilon times
/// the gauge: their mathematical libraries and instructions round differently.
pub const KIT_LIMIT: f64 = 4.0;

/// One line of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Path in the kit.
    pub file: String,
    /// SHA-256 of its bytes, as `sha256sum` prints it.
    pub sha256: String,
    /// Sum of the values, each with a sign that hangs on its place; none for the manifest.
    pub projection: Option<f64>,
    /// Sum of their gauges.
    pub gauge: f64,
}

/// The rows of a kit whose files are `files`: the manifest and every array that is given or expected.
pub fn rows(kit: &Kit, files: &BTreeMap<String, Vec<u8>>) -> Vec<Row> {
    let sum = |file: &str| hex(&Sha256::digest(files.get(file).map_or(&[][..], |bytes| bytes)));
    let mut rows = vec![Row {
        file: "manifest.json".to_owned(),
        sha256: sum("manifest.json"),
        projection: None,
        gauge: 0.0,
    }];
    let mut add = |file: String, array: &Array, gauge: f64| {
        let (sha256, projection) = (sum(&file), Some(projection(&array.values)));
        rows.push(Row { file, sha256, projection, gauge });
    };
    for solved in &kit.problems {
        let folder = format!("problems/{}", solved.problem.id);
        for input in inputs(&solved.problem.task) {
            let gauge = input.array.values.iter().map(|value| value.abs().max(1.0)).sum();
            add(format!("{folder}/given/{}.npy", input.name), &input.array, gauge);
        }
        for expected in &solved.expected {
            let gauge = expected.gauges.values.iter().sum();
            add(format!("{folder}/expected/{}.npy", expected.spec.name), &expected.values, gauge);
        }
    }
    rows
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string does not fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// Sum of values with signs that follow no pattern of the problems.
fn projection(values: &[f64]) -> f64 {
    let sign = |place: usize| {
        let mixed = (place as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        if (mixed ^ (mixed >> 29)) & (1 << 20) == 0 { 1.0 } else { -1.0 }
    };
    values.iter().enumerate().map(|(place, value)| sign(place) * value).sum()
}

/// The table as the kit holds it: CSV, its first line a comment with the version.
pub(super) fn table(kit: &Kit, files: &BTreeMap<String, Vec<u8>>) -> String {
    let mut table = format!("# kit version {KIT_VERSION}, made by `psmrt conformance export`\n");
    table.push_str("file,sha256,projection,gauge\n");
    for Row { file, sha256, projection, gauge } in rows(kit, files) {
        let projection = projection.map_or_else(String::new, |value| format!("{value:e}"));
        let _ = writeln!(table, "{file},{sha256},{projection},{gauge:e}");
    }
    table
}

/// Whether a row says the same as the committed one: the same bytes, or values within what machines may
/// differ in.
pub fn agree(row: &Row, committed: &Row) -> bool {
    if row.file != committed.file {
        return false;
    }
    if row.sha256 == committed.sha256 {
        return true;
    }
    let (Some(found), Some(right)) = (row.projection, committed.projection) else { return false };
    (found - right).abs() <= KIT_LIMIT * f64::EPSILON * committed.gauge
}

/// Version and rows of a committed table; `None` if it is no such table.
pub fn parse(text: &str) -> Option<(u32, Vec<Row>)> {
    let version = text.strip_prefix("# kit version ")?.split(',').next()?.parse().ok()?;
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let [file, sha256, projection, gauge] = fields[..] else { return None };
        Some(Row {
            file: file.to_owned(),
            sha256: sha256.to_owned(),
            projection: projection.parse().ok(),
            gauge: gauge.parse().ok()?,
        })
    };
    Some((version, text.lines().skip(2).map(row).collect::<Option<_>>()?))
}
