//! Images of solids: read before the domain is known, since it may be taken from them. (Put into it by `placed_images.rs`.)

use std::path::Path;

use super::grain_kinds::foreign_keys;
use super::numbers::{absent, finite, needed, positive};
use super::{Attachment, Trouble};
use crate::input::has_ending;
use crate::number_type::NumberType;
use crate::quote;
use crate::scene::format_grains::{GrainsKind, GrainsSection, MotionKind};
use crate::scene::format_run::AxisName;
use crate::scene::format_voxels::{AxisOrderName, ByteOrderName, ImageSection};
use crate::voxels::body::VoxelBody;
use crate::voxels::image::{AxisOrder, Image, RawLayout};
use crate::voxels::phase::Phase;

const AXES: [&str; 3] = ["x", "y", "z"];

/// An image that a section names.
pub(super) struct ListedImage {
    /// Number of the section.
    pub section: usize,
    /// The image, cropped and mirrored.
    pub body: VoxelBody,
    /// Edge of a voxel, m.
    pub si_voxel: f64,
    /// Where its lowest corner lies, m.
    pub si_corner: [f64; 3],
    /// What a run keeps a copy of.
    pub attachment: Attachment,
}

/// The images of all sections; files are looked for in `folder`.
pub(super) fn images(
    sections: &[GrainsSection],
    folder: &Path,
) -> Result<Vec<ListedImage>, Trouble> {
    let are_images =
        sections.iter().enumerate().filter(|(_, section)| section.kind == GrainsKind::Voxels);
    are_images.map(|(number, section)| image(section, number, folder)).collect()
}

fn image(section: &GrainsSection, number: usize, folder: &Path) -> Result<ListedImage, Trouble> {
    let of_section = |key: &str| format!("grains[{number}].{key}");
    foreign_keys(section, &of_section)?;
    if section.motion != MotionKind::Fixed {
        let problem =
            "the voxels of an image lie in the cells that they cover, and cannot move from there";
        let remedy = "leave it out: an image is fixed";
        return Err(Trouble::new(of_section("motion"), problem, remedy));
    }
    let belongs = "grains that move (an image is fixed)";
    absent(&of_section("velocity"), section.velocity.as_ref(), belongs)?;
    absent(&of_section("spin"), section.spin.as_ref(), belongs)?;
    absent(&of_section("density"), section.density.as_ref(), "grains that are free")?;
    let at = |key: &str| format!("grains[{number}].image.{key}");
    let remedy = "add `image = { file = \"sand.npy\", voxel = 5e-6, solid = [1] }`";
    let because = "grains of kind `voxels` need it";
    let image = needed(&of_section("image"), section.image.as_ref(), because, remedy)?;
    positive(&at("voxel"), image.voxel, "m, the edge of a voxel")?;
    let si_corner = image.corner.unwrap_or([0.0; 3]);
    finite(&at("corner"), &si_corner, "m")?;
    let phase = phase(image, &at)?;
    let path = folder.join(&image.file);
    let raw = raw(image, &path, &at)?;
    let order = match image.axes {
        Some(AxisOrderName::Xyz) => AxisOrder::Xyz,
        Some(AxisOrderName::Zyx) | None => AxisOrder::Zyx,
    };
    let read = Image::read(&path, order, raw).map_err(|error| {
        let remedy = match raw {
            Some(_) => "`shape`, `numbers` and `header_bytes` say how long the file is",
            None => {
                "give a NumPy array (.npy), a TIFF stack (.tif), a folder of TIFF slices, or bare numbers with `shape` \
                 and `numbers`"
            }
        };
        Trouble::new(at("file"), format!("{}: {error}", quote::path(&path)), remedy)
    })?;
    let [first, used] = cropped(image, read.counts(), &at)?;
    let is_mirrored = |axis: AxisName| image.mirror.iter().flatten().any(|&named| named == axis);
    let is_mirrored = [AxisName::X, AxisName::Y, AxisName::Z].map(is_mirrored);
    let ending = if raw.is_some() { "raw" } else { "npy" };
    let body = VoxelBody { image: read, first, used, is_mirrored, phase };
    if let Some(place @ [x, y, z]) = body.unusable() {
        let problem =
            format!("voxel [{x}, {y}, {z}] (x, y, z from 0) is {}", body.image.number(place));
        let remedy = "give every voxel a finite number (numpy.nan_to_num), whole ones below 2^53, or crop the image";
        return Err(Trouble::new(at("file"), problem, remedy));
    }
    let attachment = Attachment::of_shared(
        &at("file"),
        &format!("grains_{number}.{ending}"),
        body.image.bytes(),
    );
    Ok(ListedImage { section: number, body, si_voxel: image.voxel, si_corner, attachment })
}

/// What is solid.
fn phase(image: &ImageSection, at: &impl Fn(&str) -> String) -> Result<Phase, Trouble> {
    let given =
        [image.solid.is_some(), image.solid_above.is_some(), image.grey.is_some()].map(usize::from);
    if given.iter().sum::<usize>() > 1 {
        let key = if image.grey.is_some() { "grey" } else { "solid_above" };
        let problem = "what is solid is said more than once";
        return Err(Trouble::new(
            at(key),
            problem,
            "keep one of `solid`, `solid_above` and `grey`",
        ));
    }
    match (&image.solid, image.solid_above, image.grey) {
        (Some(solid), ..) if solid.is_empty() => {
            let remedy = "give the numbers of solid voxels, for example [1]";
            Err(Trouble::new(at("solid"), "the list is empty", remedy))
        }
        (Some(solid), ..) => {
            finite(&at("solid"), solid, "the numbers of solid voxels")?;
            Ok(Phase::Values(solid.clone()))
        }
        (_, Some(threshold), _) => {
            finite(&at("solid_above"), &[threshold], "a number of the image")?;
            Ok(Phase::Above(threshold))
        }
        (_, _, Some(grey @ [pore, solid])) => {
            finite(&at("grey"), &grey, "numbers of the image")?;
            if pore == solid {
                let problem = "the grey of a pore and that of a solid are the same";
                let remedy = "give [grey of a pore, grey of a solid], for example [0, 255]";
                return Err(Trouble::new(at("grey"), problem, remedy));
            }
            Ok(Phase::Grey { pore, solid })
        }
        (None, None, None) => {
            let remedy = "add `solid = [1]`, `solid_above = 128` or `grey = [0, 255]`";
            Err(Trouble::new(at("solid"), "it is missing: nothing says what is solid", remedy))
        }
    }
}

/// How bare numbers are to be read, if the file holds such.
fn raw(
    image: &ImageSection,
    path: &Path,
    at: &impl Fn(&str) -> String,
) -> Result<Option<RawLayout>, Trouble> {
    let says_itself = path.is_dir() || has_ending(path, &["npy", "tif", "tiff"]);
    if has_ending(path, &["tif", "tiff"]) || path.is_dir() {
        absent(&at("axes"), image.axes.as_ref(), "arrays (the slices of a TIFF file follow z)")?;
    }
    if says_itself {
        let belongs = "bare numbers (this file says it itself)";
        absent(&at("shape"), image.shape.as_ref(), belongs)?;
        absent(&at("numbers"), image.numbers.as_ref(), belongs)?;
        absent(&at("byte_order"), image.byte_order.as_ref(), belongs)?;
        absent(&at("header_bytes"), image.header_bytes.as_ref(), belongs)?;
        return Ok(None);
    }
    if !path.exists() {
        // Said of the file, not of how it would be read.
        return Ok(None);
    }
    let because = "the file is no .npy or TIFF file, and bare numbers need it";
    let shape = needed(&at("shape"), image.shape, because, "add `shape = [nx, ny, nz]`")?;
    let remedy = "add `numbers = \"u8\"`, or another type";
    let numbers = needed(&at("numbers"), image.numbers, because, remedy)?;
    let whole = |key: &str, given: i64, least: i64| {
        usize::try_from(given).ok().filter(|_| given >= least).ok_or_else(|| {
            let problem = format!("it must be a whole number of at least {least}");
            Trouble::new(at(key), problem, "give such a number")
        })
    };
    let mut counts = [0; 3];
    for axis in 0..3 {
        counts[axis] = whole("shape", shape[axis], 1)?;
    }
    let start = whole("header_bytes", image.header_bytes.unwrap_or(0), 0)?;
    let little = NumberType::named(numbers.word())
        .ok_or_else(|| Trouble::new(at("numbers"), "it is not read", "take another type"))?;
    let is_big = image.byte_order == Some(ByteOrderName::Big);
    let number = if is_big { little.big_endian() } else { little };
    Ok(Some(RawLayout { counts, number, start }))
}

/// The first voxel that is used and how many are, along each axis.
fn cropped(
    image: &ImageSection,
    counts: [usize; 3],
    at: &impl Fn(&str) -> String,
) -> Result<[[usize; 3]; 2], Trouble> {
    let (mut first, mut used) = ([0; 3], counts);
    for axis in 0..3 {
        let place = |given: Option<[i64; 3]>, absent: usize| match given {
            Some(given) => usize::try_from(given[axis]).ok(),
            None => Some(absent),
        };
        let count = counts[axis];
        let from = place(image.crop_from, 0);
        let to = place(image.crop_to, count);
        match (from, to) {
            (Some(from), Some(to)) if from < to && to <= count => {
                (first[axis], used[axis]) = (from, to - from);
            }
            _ => {
                let is_from = from.is_none_or(|from| from >= count) || image.crop_to.is_none();
                let key = if is_from { "crop_from" } else { "crop_to" };
                let [given_from, given_to] = [image.crop_from, image.crop_to].map(|given| {
                    given.map_or("absent".to_owned(), |given| given[axis].to_string())
                });
                let problem = format!(
                    "along {} the image has {count} voxels, and the part from {given_from} to {given_to} is none of it",
                    AXES[axis]
                );
                let remedy = format!(
                    "give `crop_from` from 0 and a larger `crop_to` of at most [{}, {}, {}]",
                    counts[0], counts[1], counts[2]
                );
                return Err(Trouble::new(at(key), problem, remedy));
            }
        }
    }
    Ok([first, used])
}
