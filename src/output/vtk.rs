//! VTK's XML files, for ParaView: image data (`.vti`), points (`.vtp`) and time series (`.pvd`).
//!
//! Arrays are appended raw, little-endian, as "VTK File Formats" (Kitware) describes it, and are
//! written as they come, so that a field is never in memory twice.
//!
//! Own short code, checked with VTK itself (the tests of scene outputs): the crate vtkio is a release candidate and holds whole arrays
//! in memory.

use std::io::{self, Write};

/// An array of a file.
pub struct Array<'a> {
    /// Its name.
    pub name: &'static str,
    /// Values per cell or point.
    pub components: usize,
    /// All values, `components` per cell or point; x fastest.
    pub values: Box<dyn Iterator<Item = f64> + 'a>,
}

impl<'a> Array<'a> {
    /// An array of that name.
    pub fn new(
        name: &'static str,
        components: usize,
        values: impl Iterator<Item = f64> + 'a,
    ) -> Self {
        Array { name, components, values: Box::new(values) }
    }
}

const HEAD: &str = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";

/// A domain of `cells` cells of edge `spacing` from the origin, with values per cell in single
/// precision.
pub fn image(
    out: &mut impl Write,
    cells: [usize; 3],
    spacing: f64,
    arrays: Vec<Array<'_>>,
) -> io::Result<()> {
    let [nx, ny, nz] = cells;
    let (count, extent) = (nx * ny * nz, format!("0 {nx} 0 {ny} 0 {nz}"));
    writeln!(out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" {HEAD}>")?;
    writeln!(
        out,
        "<ImageData WholeExtent=\"{extent}\" Origin=\"0 0 0\" \
         Spacing=\"{spacing:?} {spacing:?} {spacing:?}\">\n<Piece Extent=\"{extent}\">\n<CellData>"
    )?;
    let mut offset = 0;
    for array in &arrays {
        declare(out, array, "Float32", &mut offset, count * array.components * size_of::<f32>())?;
    }
    writeln!(out, "</CellData>\n</Piece>\n</ImageData>")?;
    append(out, |out| {
        for array in arrays {
            #[expect(clippy::cast_possible_truncation, reason = "single precision is for looking")]
            let bytes = |value: f64| (value as f32).to_le_bytes();
            block(out, count * array.components, array.values.map(bytes))?;
        }
        Ok(())
    })
}

/// `count` points with values in double precision; the first array holds their places.
pub fn points(out: &mut impl Write, count: usize, arrays: Vec<Array<'_>>) -> io::Result<()> {
    writeln!(out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" {HEAD}>")?;
    writeln!(
        out,
        "<PolyData>\n<Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" \
         NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">"
    )?;
    let mut offset = 0;
    for (number, array) in arrays.iter().enumerate() {
        writeln!(out, "{}", ["<Points>", "<PointData>", ""][number.min(2)])?;
        declare(out, array, "Float64", &mut offset, count * array.components * size_of::<f64>())?;
        if number == 0 {
            writeln!(out, "</Points>")?;
        }
    }
    writeln!(out, "</PointData>\n<Verts>")?;
    for name in ["connectivity", "offsets"] {
        whole_numbers(out, name, &mut offset, count)?;
    }
    writeln!(out, "</Verts>\n</Piece>\n</PolyData>")?;
    append(out, |out| {
        for array in arrays {
            block(out, count * array.components, array.values.map(f64::to_le_bytes))?;
        }
        block(out, count, (0..count as u64).map(u64::to_le_bytes))?;
        block(out, count, (1..=count as u64).map(u64::to_le_bytes))
    })
}

/// `count` lines of two points each with values in double precision; the first array holds the places of their ends, the
/// others one value a line.
pub fn lines(out: &mut impl Write, count: usize, arrays: Vec<Array<'_>>) -> io::Result<()> {
    writeln!(out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" {HEAD}>")?;
    writeln!(
        out,
        "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{count}\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">",
        2 * count
    )?;
    let of = |number: usize| if number == 0 { 2 * count } else { count };
    let mut offset = 0;
    for (number, array) in arrays.iter().enumerate() {
        writeln!(out, "{}", ["<Points>", "<CellData>", ""][number.min(2)])?;
        let bytes = of(number) * array.components * size_of::<f64>();
        declare(out, array, "Float64", &mut offset, bytes)?;
        if number == 0 {
            writeln!(out, "</Points>")?;
        }
    }
    writeln!(out, "</CellData>\n<Lines>")?;
    for (name, numbers) in [("connectivity", 2 * count), ("offsets", count)] {
        whole_numbers(out, name, &mut offset, numbers)?;
    }
    writeln!(out, "</Lines>\n</Piece>\n</PolyData>")?;
    append(out, |out| {
        for (number, array) in arrays.into_iter().enumerate() {
            block(out, of(number) * array.components, array.values.map(f64::to_le_bytes))?;
        }
        block(out, 2 * count, (0..2 * count as u64).map(u64::to_le_bytes))?;
        block(out, count, (1..=count as u64).map(|line| (2 * line).to_le_bytes()))
    })
}

/// A time series: times (s) and the files that belong to them.
pub fn series(out: &mut impl Write, files: &[(f64, String)]) -> io::Result<()> {
    writeln!(out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" {HEAD}>\n<Collection>")?;
    for (time, file) in files {
        writeln!(out, "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{file}\"/>")?;
    }
    writeln!(out, "</Collection>\n</VTKFile>")
}

/// Says where an array of `bytes` bytes begins.
fn declare(
    out: &mut impl Write,
    array: &Array<'_>,
    kind: &str,
    offset: &mut usize,
    bytes: usize,
) -> io::Result<()> {
    let Array { name, components, .. } = array;
    writeln!(
        out,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"appended\" offset=\"{offset}\"/>"
    )?;
    *offset += size_of::<u64>() + bytes;
    Ok(())
}

/// Says where as many whole numbers begin.
fn whole_numbers(
    out: &mut impl Write,
    name: &str,
    offset: &mut usize,
    count: usize,
) -> io::Result<()> {
    writeln!(
        out,
        "<DataArray type=\"Int64\" Name=\"{name}\" format=\"appended\" offset=\"{offset}\"/>"
    )?;
    *offset += size_of::<u64>() + count * size_of::<u64>();
    Ok(())
}

fn append<W: Write>(out: &mut W, blocks: impl FnOnce(&mut W) -> io::Result<()>) -> io::Result<()> {
    // The underscore marks the first byte of the data.
    write!(out, "<AppendedData encoding=\"raw\">\n_")?;
    blocks(out)?;
    writeln!(out, "\n</AppendedData>\n</VTKFile>")
}

/// The length of an array in bytes, and the array.
fn block<const N: usize>(
    out: &mut impl Write,
    count: usize,
    values: impl Iterator<Item = [u8; N]>,
) -> io::Result<()> {
    out.write_all(&((count * N) as u64).to_le_bytes())?;
    let mut written = 0;
    for value in values {
        out.write_all(&value)?;
        written += 1;
    }
    match written == count {
        true => Ok(()),
        false => Err(io::Error::other(format!("{written} values where {count} were declared"))),
    }
}
