//! The domain: how many cells it has.

use super::Trouble;
use super::numbers::{beyond, positive, sane};
use crate::scene::format::DomainSection;

/// How far a length may be from a whole number of cells, in cells.
const WHOLE: f64 = 1e-6;

/// Cells along x, y, z; those of an image of lengths `si_image` where the section has neither `size` nor `cells`. In a dry
/// scene they take no memory.
pub(super) fn cells(
    section: &DomainSection,
    si_image: Option<[f64; 3]>,
    is_dry: bool,
) -> Result<[usize; 3], Trouble> {
    positive("domain.dx", section.dx, "m, the edge of a cell")?;
    sane("domain.dx", section.dx, 1e-12..=1e6, "m")?;
    let cells = match (&section.size, &section.cells) {
        (Some(size), None) => whole_cells(*size, section.dx)?,
        (None, Some(cells)) => given_cells(*cells)?,
        (Some(_), Some(_)) => {
            let problem = "the domain has both `size` and `cells`";
            return Err(Trouble::new("domain.cells", problem, "give one of them, with `dx`"));
        }
        (None, None) if si_image.is_some() => {
            whole_cells_of_image(si_image.unwrap_or_default(), section.dx)?
        }
        (None, None) => {
            let problem = "the domain has neither `size` (m) nor `cells`";
            return Err(Trouble::new("domain", problem, "add `size = [x, y, z]` in m"));
        }
    };
    let key = if section.size.is_some() { "domain.size" } else { "domain.cells" };
    check_memory(cells, key, is_dry)?;
    Ok(cells)
}

/// The cells of an image.
fn whole_cells_of_image(si_size: [f64; 3], si_dx: f64) -> Result<[usize; 3], Trouble> {
    whole_cells(si_size, si_dx).map_err(|_| {
        let [x, y, z] = si_size;
        let problem = format!(
            "the image is {x:.6e} x {y:.6e} x {z:.6e} m, which is no whole number of cells of {si_dx:e} m"
        );
        let remedy = "crop the image (`crop_to`), take a dx that divides it, or give `size` or `cells`";
        Trouble::new("domain.dx", problem, remedy)
    })
}

fn whole_cells(si_size: [f64; 3], si_dx: f64) -> Result<[usize; 3], Trouble> {
    for si_length in si_size {
        positive("domain.size", si_length, "m, each of the three lengths")?;
    }
    let near = si_size.map(|si_length| (si_length / si_dx).round().max(1.0));
    let mut cells = [0; 3];
    for axis in 0..3 {
        let length = si_size[axis] / si_dx;
        let whole = near[axis];
        let is_whole = (length - whole).abs() <= WHOLE * whole;
        if length.is_finite() && !is_whole {
            let problem = format!(
                "along {} it is {} cells of {si_dx:e} m; it must be a whole number",
                ["x", "y", "z"][axis],
                beyond(length, whole)
            );
            let [x, y, z] = near.map(|cells| tidy(cells * si_dx));
            let [nx, ny, nz] = near;
            let remedy = format!(
                "write `size = [{x:e}, {y:e}, {z:e}]` ({nx} x {ny} x {nz} cells), or take another dx"
            );
            return Err(Trouble::new("domain.size", problem, remedy));
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let whole = whole as usize;
        cells[axis] = whole;
    }
    Ok(cells)
}

/// The number with as few digits as tell it to the twelfth.
fn tidy(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

fn given_cells(given: [i64; 3]) -> Result<[usize; 3], Trouble> {
    let mut cells = [0; 3];
    for axis in 0..3 {
        cells[axis] = usize::try_from(given[axis]).ok().filter(|&n| n > 0).ok_or_else(|| {
            let problem = "each of the three must be a whole number of at least 1";
            Trouble::new("domain.cells", problem, "give at least 1 cell along each axis")
        })?;
    }
    Ok(cells)
}

/// Bytes that the oracle needs for a cell: two sets of populations and a slot for coverage.
pub const BYTES_PER_CELL: u64 = 2 * 19 * 8 + 4;

/// Errors if the domain cannot be numbered, or the cells of its fluid cannot fit into this machine's memory.
fn check_memory(cells: [usize; 3], key: &str, is_dry: bool) -> Result<(), Trouble> {
    let remedy = "use a larger `dx` or a smaller domain; mirror planes (`free_slip`) halve it";
    let count = cells.iter().try_fold(1_usize, |product, &n| product.checked_mul(n));
    let Some(count) = count.filter(|&count| count < u32::MAX as usize) else {
        let problem =
            format!("{cells:?} cells are too many to be numbered; 4294967294 is the limit");
        return Err(Trouble::new(key, problem, remedy));
    };
    let need = count as u64 * BYTES_PER_CELL;
    match crate::machine::memory_bytes() {
        Some(memory) if need > memory && !is_dry => {
            let problem = format!(
                "{count} cells need {:.1} GiB; this machine has {:.1} GiB",
                gib(need),
                gib(memory)
            );
            Err(Trouble::new(key, problem, remedy))
        }
        _ => Ok(()),
    }
}

fn gib(bytes: u64) -> f64 {
    bytes as f64 / (1_u64 << 30) as f64
}
