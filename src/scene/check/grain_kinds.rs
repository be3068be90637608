//! The kinds of grains: which keys belong to which, and what spheres they make.

use std::path::Path;

use super::listed::{Ball, Site};
use super::numbers::{absent, finite, needed, positive};
use super::{Trouble, arrays, generated, grain_list};
use crate::scene::format_grains::{GrainsKind, GrainsSection};

/// Errors at a key that belongs to another kind.
pub(super) fn foreign_keys(
    section: &GrainsSection,
    at: &dyn Fn(&str) -> String,
) -> Result<(), Trouble> {
    let kind = section.kind;
    if !matches!(kind, GrainsKind::Sphere | GrainsKind::Body) {
        absent(&at("centre"), section.centre.as_ref(), "grains of kind `sphere` and `body`")?;
    }
    if kind != GrainsKind::Body {
        absent(&at("body"), section.body.as_ref(), "grains of kind `body`")?;
    }
    if kind != GrainsKind::Voxels {
        absent(&at("image"), section.image.as_ref(), "grains of kind `voxels`")?;
    }
    if kind == GrainsKind::Voxels {
        let belongs = "spheres (an image says itself where solid is)";
        absent(&at("diameter"), section.diameter.as_ref(), belongs)?;
        if section.file.is_some() {
            let remedy =
                "name it there: `image = { file = \"sand.npy\", voxel = 5e-6, solid = [1] }`";
            return Err(Trouble::new(at("file"), "an image is named by `image.file`", remedy));
        }
    } else if kind == GrainsKind::Body {
        let belongs = "spheres (the size of a body stands in `body`)";
        absent(&at("diameter"), section.diameter.as_ref(), belongs)?;
        if section.file.is_some() {
            let remedy =
                "name it there: `body = { shape = \"stl\", file = \"stone.stl\", scale = 1e-3 }`";
            return Err(Trouble::new(at("file"), "an STL file is named by `body.file`", remedy));
        }
    } else if kind == GrainsKind::Csv {
        let belongs = "grains of other kinds than `csv`; the file has its own";
        absent(&at("diameter"), section.diameter.as_ref(), belongs)?;
    } else {
        absent(&at("file"), section.file.as_ref(), "grains of kind `csv`")?;
    }
    if kind != GrainsKind::Csv {
        absent(&at("columns"), section.columns.as_ref(), "grains of kind `csv`")?;
    }
    if kind != GrainsKind::Array {
        let belongs = "grains of kind `array`";
        absent(&at("lattice"), section.lattice.as_ref(), belongs)?;
        absent(&at("counts"), section.counts.as_ref(), belongs)?;
    }
    if !matches!(kind, GrainsKind::Random | GrainsKind::Bed) {
        let belongs = "grains of kind `random` and `bed`";
        absent(&at("diameter_range"), section.diameter_range.as_ref(), belongs)?;
        absent(&at("grading"), section.grading.as_ref(), belongs)?;
        absent(&at("log_normal"), section.log_normal.as_ref(), belongs)?;
        absent(&at("count"), section.count.as_ref(), belongs)?;
        absent(&at("seed"), section.seed.as_ref(), belongs)?;
        absent(&at("gap"), section.gap.as_ref(), "grains of kind `random`")?;
        absent(&at("packing_friction"), section.packing_friction.as_ref(), "grains of kind `bed`")?;
        absent(&at("floor"), section.floor.as_ref(), "grains of kind `bed`")?;
    }
    if !matches!(kind, GrainsKind::Random | GrainsKind::Array) {
        let belongs = "grains of kind `array` and `random`";
        absent(&at("solid_fraction"), section.solid_fraction.as_ref(), belongs)?;
    }
    Ok(())
}

/// The spheres of a section, and the contents of the file that they come from, if they do.
pub(super) fn balls(
    section: &GrainsSection,
    folder: &Path,
    place: &Site,
) -> Result<(Vec<Ball>, Option<Vec<u8>>), Trouble> {
    let balls = match section.kind {
        GrainsKind::Sphere => vec![sphere(section, place.at)?],
        GrainsKind::Csv => {
            let remedy = "add `file = \"grains.csv\"`, relative to the scene file";
            let (key, because) = ((place.at)("file"), "grains of kind `csv` need it");
            let file = needed(&key, section.file.as_deref(), because, remedy)?;
            let (bytes, balls) =
                grain_list::read(place.at, &folder.join(file), section.columns.as_ref())?;
            return Ok((balls, Some(bytes)));
        }
        GrainsKind::Array => arrays::balls(section, &place.at, place.domain, place.units)?,
        GrainsKind::Random => generated::random(section, place)?,
        GrainsKind::Bed => generated::bed(section, place)?,
        // No spheres: `voxels.rs` and `bodies.rs` read them.
        GrainsKind::Voxels | GrainsKind::Body => Vec::new(),
    };
    Ok((balls, None))
}

fn sphere(section: &GrainsSection, at: &dyn Fn(&str) -> String) -> Result<Ball, Trouble> {
    let remedy = "add `centre = [x, y, z]` in m";
    let si_centre = needed(&at("centre"), section.centre, "a sphere needs it", remedy)?;
    finite(&at("centre"), &si_centre, "m")?;
    let remedy = "add `diameter`, in m";
    let si_diameter = needed(&at("diameter"), section.diameter, "a sphere needs it", remedy)?;
    positive(&at("diameter"), si_diameter, "m")?;
    Ok(Ball::of(si_centre, si_diameter))
}
