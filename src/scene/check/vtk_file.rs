//! VTK's XML files of points, as ParaView reads and writes them: their arrays as numbers.
//!
//! "VTK File Formats" (Kitware) has four ways to store an array, all read here: as text, in base64, and appended behind the
//! elements, raw or in base64. Raw bytes are no XML, so that they are cut off before the elements are read.

use std::borrow::Cow;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use roxmltree::{Document, Node};

use super::list_text::Fault;
use crate::quote::quoted;

/// What opens the appended arrays.
const APPENDED: &[u8] = b"<AppendedData";

/// What to do about a file that is stored in another way.
const SAVE_AS: &str =
    "in ParaView: File, Save Data as .vtp with Data Mode Ascii, or with Compressor Type None";

/// The points of a file with their values.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Points {
    /// x, y, z of each point.
    pub places: Vec<[f64; 3]>,
    /// The arrays that were asked for.
    pub arrays: Vec<PointArray>,
}

/// An array with some values for each point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PointArray {
    pub name: String,
    /// Values of a point.
    pub components: usize,
    pub values: Vec<f64>,
}

/// Whether a file is one of VTK's: XML, which no list of grains begins with.
pub(super) fn is_vtk(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    text.starts_with(b"<?xml") || text.starts_with(b"<VTKFile")
}

/// The points of a file with those of its arrays that are `wanted`.
pub(super) fn points(bytes: &[u8], wanted: impl Fn(&str) -> bool) -> Result<Points, Fault> {
    let (head, appended) = parted(bytes)?;
    let document = Document::parse(&head).map_err(|error| {
        let problem = format!("it is no valid XML: {}", crate::quote::shown(&error.to_string()));
        (problem, "save it anew: it is cut off, or was changed by hand".to_owned())
    })?;
    let file = File::new(document.root_element(), appended)?;
    let mut points = Points::default();
    for piece in document.descendants().filter(|node| node.has_tag_name("Piece")) {
        file.add(piece, &wanted, &mut points)?;
    }
    Ok(points)
}

/// The elements of a file, and what is appended to them: how it is stored, and the bytes from the first array on.
fn parted(bytes: &[u8]) -> Result<(Cow<'_, str>, Option<Appended<'_>>), Fault> {
    let at = bytes.windows(APPENDED.len()).position(|window| window == APPENDED);
    let head = std::str::from_utf8(&bytes[..at.unwrap_or(bytes.len())]).map_err(|error| {
        let problem = format!("it is not UTF-8 text: see byte {}", error.valid_up_to());
        (problem, SAVE_AS.to_owned())
    })?;
    let head = head.trim_start_matches('\u{feff}');
    let Some(at) = at else { return Ok((Cow::Borrowed(head), None)) };
    // An underscore marks the first byte of the data.
    let rest = &bytes[at..];
    let start = rest.iter().position(|&byte| byte == b'>').and_then(|end| {
        let mark = rest[end..].iter().position(|&byte| byte == b'_')?;
        Some((&rest[..end], &rest[end + mark + 1..]))
    });
    let Some((tag, data)) = start else {
        return Err(("its appended data are cut off".to_owned(), "save it anew".to_owned()));
    };
    let is_raw = tag.windows(5).any(|window| window == b"\"raw\"" || window == b"'raw'");
    Ok((Cow::Owned(format!("{head}</VTKFile>")), Some(Appended { is_raw, data })))
}

/// Arrays behind the elements.
#[derive(Clone, Copy, Debug)]
struct Appended<'a> {
    /// Bytes as they are; else base64.
    is_raw: bool,
    data: &'a [u8],
}

/// How the arrays of a file are stored.
#[derive(Clone, Copy, Debug)]
struct File<'a> {
    appended: Option<Appended<'a>>,
    /// Bytes of the length that stands before an array.
    header: usize,
    is_little_endian: bool,
    compressor: Option<&'a str>,
}

impl<'a> File<'a> {
    fn new(root: Node<'a, 'a>, appended: Option<Appended<'a>>) -> Result<Self, Fault> {
        let kind = root.attribute("type").unwrap_or("");
        if !root.has_tag_name("VTKFile") || !["PolyData", "UnstructuredGrid"].contains(&kind) {
            let found = match kind {
                "" => format!("it is XML of kind {}", quoted(root.tag_name().name())),
                kind => format!("it holds data of kind {}", quoted(kind)),
            };
            let remedy = "give a file of points: .vtp (PolyData), as a record of kind `grains` writes, or .vtu";
            return Err((format!("{found}, not points"), remedy.to_owned()));
        }
        Ok(File {
            appended,
            header: if root.attribute("header_type") == Some("UInt64") { 8 } else { 4 },
            is_little_endian: root.attribute("byte_order") != Some("BigEndian"),
            compressor: root.attribute("compressor"),
        })
    }

    /// Adds the points of a piece, of which a file has one or several.
    fn add(
        &self,
        piece: Node<'_, '_>,
        wanted: impl Fn(&str) -> bool,
        points: &mut Points,
    ) -> Result<(), Fault> {
        let arrays_of = |element: &str| {
            let inside = piece.children().filter(|child| child.has_tag_name(element));
            let arrays = inside.flat_map(|node| node.children());
            arrays.filter(|node| node.has_tag_name("DataArray")).collect::<Vec<_>>()
        };
        let said = piece.attribute("NumberOfPoints").unwrap_or("");
        let Ok(count) = said.trim().parse::<usize>() else {
            let problem = format!("a piece says that it has {} points", quoted(said));
            return Err((problem, "save it anew: it was changed by hand".to_owned()));
        };
        let of = |array: Node<'_, '_>, name: &str, components: usize| -> Result<Vec<f64>, Fault> {
            let values = self.values(array, name)?;
            if count.checked_mul(components) == Some(values.len()) {
                return Ok(values);
            }
            let problem = format!(
                "array {} has {} values, {count} points of {components} need {}",
                quoted(name),
                values.len(),
                count.saturating_mul(components)
            );
            Err((problem, "save it anew: it is cut off, or was changed by hand".to_owned()))
        };
        if count == 0 {
            return Ok(());
        }
        let places = arrays_of("Points");
        let Some(&places) = places.first() else {
            return Err(("it has points without places".to_owned(), "save it anew".to_owned()));
        };
        let flat = of(places, "Points", 3)?;
        points.places.extend(flat.chunks_exact(3).map(|xyz| [xyz[0], xyz[1], xyz[2]]));
        let mut seen = Vec::new();
        for array in arrays_of("PointData") {
            let name = array.attribute("Name").unwrap_or("");
            if !wanted(name) {
                continue;
            }
            if seen.contains(&name) {
                let problem = format!("a piece has array {} twice", quoted(name));
                return Err((problem, "save it anew: it was changed by hand".to_owned()));
            }
            seen.push(name);
            let components = array.attribute("NumberOfComponents").unwrap_or("1");
            let components = components.trim().parse().unwrap_or(1);
            let values = of(array, name, components)?;
            match points.arrays.iter_mut().find(|known| known.name == name) {
                Some(known) => known.values.extend(values),
                None => {
                    points.arrays.push(PointArray { name: name.to_owned(), components, values });
                }
            }
        }
        Ok(())
    }

    /// The values of an array, however they are stored.
    fn values(&self, array: Node<'_, '_>, name: &str) -> Result<Vec<f64>, Fault> {
        let format = array.attribute("format").unwrap_or("ascii");
        // Around comments and what ParaView notes about an array.
        let texts = array.children().filter(|child| child.is_text());
        let text: String = texts.filter_map(|child| child.text()).collect();
        if format == "ascii" {
            return text.split_ascii_whitespace().map(|word| number(word, name)).collect();
        }
        if let Some(compressor) = self.compressor.filter(|compressor| !compressor.is_empty()) {
            let problem =
                format!("its arrays are compressed ({})", crate::quote::shown(compressor));
            return Err((problem, SAVE_AS.to_owned()));
        }
        if !self.is_little_endian {
            let problem = "its numbers are big-endian, of which only those in text are read";
            return Err((problem.to_owned(), SAVE_AS.to_owned()));
        }
        let cut_off = || {
            let problem = format!("array {} is cut off", quoted(name));
            (problem, "save it anew: it is cut off, or was changed by hand".to_owned())
        };
        let bytes = match (format, self.appended) {
            ("binary", _) => {
                let text: Vec<u8> =
                    text.bytes().filter(|byte| !byte.is_ascii_whitespace()).collect();
                let bytes = self.in_base64(&text).ok_or_else(cut_off)?;
                Cow::Owned(bytes.into_owned())
            }
            ("appended", Some(Appended { is_raw, data })) => {
                let offset = array.attribute("offset").and_then(|text| text.trim().parse().ok());
                let from =
                    offset.and_then(|offset: usize| data.get(offset..)).ok_or_else(cut_off)?;
                let bytes = match is_raw {
                    true => self.behind_its_length(from).map(Cow::Borrowed),
                    false => self.in_base64(from),
                };
                bytes.ok_or_else(cut_off)?
            }
            _ => {
                let problem = format!("array {} is stored as {}", quoted(name), quoted(format));
                return Err((problem, SAVE_AS.to_owned()));
            }
        };
        self.numbers(array, name, &bytes)
    }

    /// The bytes of an array that begins with their number.
    fn behind_its_length<'b>(&self, from: &'b [u8]) -> Option<&'b [u8]> {
        let mut length = [0; 8];
        length[..self.header].copy_from_slice(from.get(..self.header)?);
        let length = usize::try_from(u64::from_le_bytes(length)).ok()?;
        from[self.header..].get(..length)
    }

    /// The same of an array in base64: the number of bytes and the bytes are one text.
    fn in_base64<'b>(&self, from: &[u8]) -> Option<Cow<'b, [u8]>> {
        // As many characters as hold the number and at most three bytes more.
        let first = STANDARD.decode(from.get(..self.header.div_ceil(3) * 4)?).ok()?;
        let mut length = [0; 8];
        length[..self.header].copy_from_slice(first.get(..self.header)?);
        let length = usize::try_from(u64::from_le_bytes(length)).ok()?;
        let characters = length.checked_add(self.header)?.div_ceil(3).checked_mul(4)?;
        let mut all = STANDARD.decode(from.get(..characters)?).ok()?;
        Some(Cow::Owned(all.split_off(self.header)))
    }

    fn numbers(&self, array: Node<'_, '_>, name: &str, bytes: &[u8]) -> Result<Vec<f64>, Fault> {
        let single =
            |four: &[u8]| f64::from(f32::from_le_bytes([four[0], four[1], four[2], four[3]]));
        let double = |eight: &[u8]| {
            let mut number = [0; 8];
            number.copy_from_slice(eight);
            f64::from_le_bytes(number)
        };
        match array.attribute("type") {
            Some("Float32") => Ok(bytes.chunks_exact(4).map(single).collect()),
            Some("Float64") => Ok(bytes.chunks_exact(8).map(double).collect()),
            kind => {
                let kind = quoted(kind.unwrap_or(""));
                let problem = format!("array {} is of type {kind}", quoted(name));
                Err((problem, "Float32 and Float64 are read; in text any numbers".to_owned()))
            }
        }
    }
}

fn number(word: &str, name: &str) -> Result<f64, Fault> {
    word.parse().map_err(|_| {
        let problem = format!("array {}: {} is no number", quoted(name), quoted(word));
        (problem, "write decimals with points, separated by blanks".to_owned())
    })
}
