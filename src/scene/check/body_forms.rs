//! The surface of a body, from the keys of a section: of an STL file, or by a formula.

use std::path::Path;

use nalgebra::{Unit, UnitQuaternion};
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;

use super::in_time::Files;
use super::numbers::{finite, needed, positive};
use super::{Attachment, Trouble};
use crate::bodies::mesh::Mesh;
use crate::bodies::pose::Pose;
use crate::bodies::{formula, stl};
use crate::input;
use crate::quote;
use crate::scene::format_bodies::{BodySection, BodyShapeName};
use crate::units::Units;

/// Longer bodies, over the longest side of the domain, are mistaken units.
const LARGEST_LENGTH: f64 = 1e6;

/// Bytes that an STL file may have: some 10 million triangles.
const LARGEST: u64 = 512 * input::MIB;

/// A body about its centre, in cells.
pub(super) struct Form {
    pub mesh: Mesh,
    /// The direction in which it has no end.
    pub endless: Endless,
}

/// Which way a body goes on beyond the domain.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Endless {
    /// It has an end.
    No,
    /// Along this direction, always the same.
    Along(Vec3),
    /// In all directions across this one.
    Across(Vec3),
    /// In all directions but for a bore of this radius along this one.
    Around { axis: Vec3, bore: f64 },
}

/// The surface about the centre, in cells.
pub(super) fn form(
    (body, centre): (&BodySection, &Vec3),
    number: usize,
    files: &mut Files,
    (domain, units): (&Domain, &Units),
) -> Result<Form, Trouble> {
    let at = |key: &str| format!("grains[{number}].body.{key}");
    only_for(body, &at)?;
    let length = |key: &'static str, given: Option<f64>| {
        let because = format!("a body of shape `{}` needs it", body.shape.word());
        let given = needed(&at(key), given, &because, "add it, in m")?;
        positive(&at(key), given, "m")?;
        not_huge(&at(key), given / units.si_dx, domain)
    };
    // From the centre, wherever it is, beyond the domain.
    let lengths = Vec3::from(domain.cells().map(|n| n as f64));
    let beyond = 4.0 * lengths.norm() + 2.0 * (centre - 0.5 * lengths).norm();
    let along = |key: &'static str, given: Option<[f64; 3]>| {
        let because = format!("a body of shape `{}` needs it", body.shape.word());
        let given = needed(&at(key), given, &because, "add a direction, for example [0, 0, 1]")?;
        direction(&at(key), given)
    };
    let turned =
        |mesh: Mesh, turn: UnitQuaternion<f64>| Pose { centre: Vec3::zeros(), turn }.place(&mesh);
    Ok(match body.shape {
        BodyShapeName::Stl => {
            let mesh = read(body, &at, number, files, units)?;
            not_huge(&at("scale"), mesh.reach(&Vec3::zeros()), domain)?;
            let mesh = turned(mesh, turn(body, &at)?);
            Form { mesh, endless: Endless::No }
        }
        BodyShapeName::Box => {
            let size =
                needed(&at("size"), body.size, "a box needs it", "add `size = [x, y, z]` in m")?;
            for edge in size {
                positive(&at("size"), edge, "m")?;
                not_huge(&at("size"), edge / units.si_dx, domain)?;
            }
            let edges = Units::to_lattice(size, units.si_dx);
            Form { mesh: turned(formula::cuboid(&edges), turn(body, &at)?), endless: Endless::No }
        }
        BodyShapeName::Cylinder => {
            let radius = 0.5 * length("diameter", body.diameter)?;
            let axis = along("axis", body.axis)?;
            let long = body.length.map(|given| length("length", Some(given))).transpose()?;
            let mesh =
                turned(formula::cylinder(radius, long.unwrap_or(beyond)), Pose::from_z_to(&axis));
            Form { mesh, endless: if long.is_some() { Endless::No } else { Endless::Along(*axis) } }
        }
        BodyShapeName::Pipe => {
            let inner = 0.5 * length("diameter", body.diameter)?;
            let wall = body.wall.map(|given| length("wall", Some(given))).transpose()?;
            let axis = along("axis", body.axis)?;
            let long = body.length.map(|given| length("length", Some(given))).transpose()?;
            let outer = inner + wall.unwrap_or(beyond);
            let mesh =
                turned(formula::pipe(inner, outer, long.unwrap_or(beyond)), Pose::from_z_to(&axis));
            let endless = match (wall, long) {
                (Some(_), Some(_)) => Endless::No,
                (Some(_), None) => Endless::Along(*axis),
                (None, _) => Endless::Around { axis: *axis, bore: inner },
            };
            Form { mesh, endless }
        }
        BodyShapeName::HalfSpace => {
            let normal = along("normal", body.normal)?;
            let mesh = turned(formula::half_space(beyond), Pose::from_z_to(&normal));
            Form { mesh, endless: Endless::Across(*normal) }
        }
    })
}

/// Errors at a key that belongs to another shape.
fn only_for(body: &BodySection, at: &impl Fn(&str) -> String) -> Result<(), Trouble> {
    use BodyShapeName::{Box, Cylinder, HalfSpace, Pipe, Stl};
    let keys = [
        ("file", body.file.is_some(), &[Stl][..]),
        ("scale", body.scale.is_some(), &[Stl]),
        ("origin", body.origin.is_some(), &[Stl]),
        ("size", body.size.is_some(), &[Box]),
        ("diameter", body.diameter.is_some(), &[Cylinder, Pipe]),
        ("wall", body.wall.is_some(), &[Pipe]),
        ("length", body.length.is_some(), &[Cylinder, Pipe]),
        ("axis", body.axis.is_some(), &[Cylinder, Pipe]),
        ("normal", body.normal.is_some(), &[HalfSpace]),
        ("turn", body.turn.is_some(), &[Stl, Box]),
    ];
    for (key, is_given, shapes) in keys {
        if is_given && !shapes.contains(&body.shape) {
            let words: Vec<String> =
                shapes.iter().map(|shape| format!("`{}`", shape.word())).collect();
            let problem = format!("it applies to bodies of shape {} only", words.join(" and "));
            return Err(Trouble::new(at(key), problem, "remove it, or change `shape`"));
        }
    }
    Ok(())
}

/// The surface in an STL file about its origin, in cells.
fn read(
    body: &BodySection,
    at: &impl Fn(&str) -> String,
    number: usize,
    files: &mut Files,
    units: &Units,
) -> Result<Mesh, Trouble> {
    let because = "a body of shape `stl` needs it";
    let file = needed(&at("file"), body.file.as_deref(), because, "add `file = \"stone.stl\"`")?;
    let remedy = "add how long a unit of the file is, m: `scale = 1e-3` for millimetres";
    let scale = needed(&at("scale"), body.scale, because, remedy)?;
    positive(&at("scale"), scale, "m")?;
    let path = files.folder.join(Path::new(file));
    let said = |problem: String, remedy: &str| {
        Trouble::new(at("file"), format!("{}: {problem}", quote::path(&path)), remedy)
    };
    let bytes = input::read(&path, LARGEST).map_err(|error| {
        said(error.to_string(), "give the name of an STL file, relative to the scene")
    })?;
    let mesh = stl::mesh(bytes.clone()).map_err(|error| {
        let remedy = "mend the surface in the program that made it (MeshLab, Blender and others close holes, turn triangles over \
                      and take crossing parts apart), or take `shape = \"box\"` and others for simple bodies";
        said(error.to_string(), remedy)
    })?;
    let origin = match body.origin {
        Some(origin) => {
            finite(&at("origin"), &origin, "in units of the file")?;
            Vec3::from(origin)
        }
        None => mesh.middle(),
    };
    files.attachments.push(Attachment::of_field(
        &at("file"),
        &format!("grains_{number}.stl"),
        bytes,
    ));
    Ok(mesh.mapped(|vertex| (vertex - origin) * (scale / units.si_dx)))
}

fn turn(body: &BodySection, at: &impl Fn(&str) -> String) -> Result<UnitQuaternion<f64>, Trouble> {
    let Some(turn) = &body.turn else { return Ok(UnitQuaternion::identity()) };
    finite(&at("turn.degrees"), &[turn.degrees], "degrees")?;
    let axis = direction(&at("turn.axis"), turn.axis)?;
    Ok(UnitQuaternion::from_axis_angle(&axis, turn.degrees.to_radians()))
}

fn direction(key: &str, given: [f64; 3]) -> Result<Unit<Vec3>, Trouble> {
    finite(key, &given, "a direction")?;
    Unit::try_new(Vec3::from(given), 1e-100).ok_or_else(|| {
        Trouble::new(key, "a direction cannot be 0", "give one, for example [0, 0, 1]")
    })
}

/// A length in cells, unless it is out of all proportion to the domain.
fn not_huge(key: &str, length: f64, domain: &Domain) -> Result<f64, Trouble> {
    let longest = domain.cells().into_iter().max().unwrap_or(1) as f64;
    if length <= LARGEST_LENGTH * longest {
        return Ok(length);
    }
    let problem = format!(
        "the body would be {length:.1e} cells long, and the domain has {longest} along its longest side; {LARGEST_LENGTH:.0} times \
         that is the limit"
    );
    Err(Trouble::new(key, problem, "lengths are in metres (a micrometre is 1e-6)"))
}
