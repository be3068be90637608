//! What a record holds, kind by kind, and which keys belong to which.

use psmrt_reference::domain::Domain;
use psmrt_reference::setup::Setup;

use super::free::FreePart;
use super::numbers::{absent, finite, needed};
use super::{Trouble, permeability};
use crate::scene::format_run::{FieldFormat, Quantity, RecordKind, RecordSection};
use crate::units::Units;

/// What a record holds.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// Means over the domain.
    Box,
    /// A line along `axis` through the point `through`.
    Profile {
        /// 0, 1 or 2.
        axis: usize,
        /// A point on the line, in cells.
        through: [f64; 3],
    },
    /// Force and torque on each grain.
    Loads,
    /// Pressure, velocity and solid fraction of all cells, a set of files each time.
    Fields {
        /// File formats, at least one.
        formats: Vec<FieldFormat>,
    },
    /// A picture of a plane, each time.
    Slice {
        /// Normal of the plane: 0, 1 or 2.
        normal: usize,
        /// Place of the plane along the normal, in cells.
        at: f64,
        /// What the colours show.
        quantity: Quantity,
        /// The values at the ends of the scale of colours, SI units; those of each picture where `None`.
        si_range: Option<[f64; 2]>,
    },
    /// All grains, a file each time.
    Grains,
    /// Means over the free grains.
    GrainMeans,
    /// Layers across `axis`.
    Layers {
        /// 0, 1 or 2.
        axis: usize,
        /// How many.
        count: usize,
    },
    /// Forces on the faces.
    Walls,
    /// Contacts of the free grains summed up.
    ContactMeans,
    /// All contacts of the free grains, a file each time.
    Contacts,
    /// Permeability of a bed.
    Permeability {
        /// Axis of the flow: 0, 1 or 2.
        axis: usize,
        /// Gravity that heads are taken with, m/s2.
        si_gravity: f64,
    },
}

/// What a record of a section holds.
pub(super) fn what(
    section: &RecordSection,
    at: &impl Fn(&str) -> String,
    setup: &Setup,
    free: Option<&FreePart>,
    units: &Units,
) -> Result<What, Trouble> {
    if section.kind != RecordKind::Fields {
        absent(&at("formats"), section.formats.as_ref(), "records of kind `fields`")?;
    }
    if matches!(section.kind, RecordKind::Loads | RecordKind::Grains) && setup.solid_phase.is_none()
    {
        let problem = "the scene has no grains to record";
        return Err(Trouble::new(at("kind"), problem, "add [[grains]], or remove this record"));
    }
    let of_free = [RecordKind::GrainMeans, RecordKind::ContactMeans, RecordKind::Contacts];
    if of_free.contains(&section.kind) && free.is_none() {
        let problem = "the scene has no free grains to record";
        let remedy = "add `motion = \"free\"` to grains, or remove this record";
        return Err(Trouble::new(at("kind"), problem, remedy));
    }
    let has_point = matches!(section.kind, RecordKind::Profile | RecordKind::Slice);
    if !has_point {
        absent(&at("point"), section.point.as_ref(), "records of kind `profile` and `slice`")?;
    }
    if section.kind != RecordKind::Layers {
        absent(&at("layers"), section.layers.as_ref(), "records of kind `layers`")?;
        if !has_point && section.kind != RecordKind::Permeability {
            let belongs = "records of kind `profile`, `slice`, `layers` and `permeability`";
            absent(&at("axis"), section.axis.as_ref(), belongs)?;
        }
    }
    if section.kind != RecordKind::Slice {
        absent(&at("quantity"), section.quantity.as_ref(), "records of kind `slice`")?;
        absent(&at("range"), section.range.as_ref(), "records of kind `slice`")?;
    }
    let axis = || {
        let remedy = "add `axis = \"x\"`, \"y\" or \"z\"";
        let because = "profiles, slices and layers need it";
        Ok(needed(&at("axis"), section.axis, because, remedy)?.index())
    };
    let through = || match section.point {
        Some(point) => place_of(&at("point"), point, &setup.domain, units),
        None => Ok(middle(&setup.domain)),
    };
    Ok(match section.kind {
        RecordKind::Box => What::Box,
        RecordKind::Profile => What::Profile { axis: axis()?, through: through()? },
        RecordKind::Slice => {
            let normal = axis()?;
            let quantity = section.quantity.unwrap_or_default();
            let si_range = section.range.map(|range| si_range(&at("range"), range)).transpose()?;
            What::Slice { normal, at: through()?[normal], quantity, si_range }
        }
        RecordKind::Loads => What::Loads,
        RecordKind::Grains => What::Grains,
        RecordKind::GrainMeans => What::GrainMeans,
        RecordKind::Layers => {
            let axis = axis()?;
            What::Layers {
                axis,
                count: layers(&at("layers"), section.layers, axis, &setup.domain)?,
            }
        }
        RecordKind::Walls => walls(&at("kind"), &setup.domain)?,
        RecordKind::ContactMeans => What::ContactMeans,
        RecordKind::Contacts => What::Contacts,
        RecordKind::Permeability => {
            let (axis, si_gravity) = permeability::flow(at, section.axis, setup, free, units)?;
            What::Permeability { axis, si_gravity }
        }
        RecordKind::Fields => {
            let formats = section.formats.clone().unwrap_or_else(|| vec![FieldFormat::Vti]);
            if formats.is_empty() {
                let remedy = "give \"vti\", \"npy\" or both";
                return Err(Trouble::new(at("formats"), "the list is empty", remedy));
            }
            What::Fields { formats }
        }
    })
}

/// How many layers of cells across `axis`.
fn layers(key: &str, layers: Option<i64>, axis: usize, domain: &Domain) -> Result<usize, Trouble> {
    let (cells, name) = (domain.cells()[axis], ["x", "y", "z"][axis]);
    // The gradient of a layer is that between its neighbours.
    let least = if domain.is_periodic(axis) { 1 } else { 2 };
    let remedy = format!("add `layers = {}`, say", (cells / 8).max(least));
    let asked = needed(key, layers, "it says how many layers there are", &remedy)?;
    match usize::try_from(asked) {
        Ok(count) if (least..=cells).contains(&count) => Ok(count),
        _ => {
            let problem = format!(
                "{asked} layers: there may be {least} to {cells}, the cells of the domain along {name}"
            );
            Err(Trouble::new(key, problem, format!("give {}, say", (cells / 8).max(least))))
        }
    }
}

/// Errors if there is no face to record.
fn walls(key: &str, domain: &Domain) -> Result<What, Trouble> {
    if (0..3).all(|axis| domain.is_periodic(axis)) {
        let problem = "all faces are periodic: none has forces to record";
        return Err(Trouble::new(key, problem, "make a face a wall, or remove this record"));
    }
    Ok(What::Walls)
}

/// The ends of a scale of colours.
fn si_range(key: &str, range: [f64; 2]) -> Result<[f64; 2], Trouble> {
    finite(key, &range, "in the unit of the quantity: m/s or Pa")?;
    // A span that rounding eats up has no ticks.
    let [low, high] = range;
    if high - low > 1e-9 * low.abs().max(high.abs()) {
        return Ok(range);
    }
    let problem = format!("its second value, {high}, must be above its first, {low}");
    Err(Trouble::new(key, problem, "give the lowest value first, for example [0.0, 1e-3]"))
}

/// The middle of the domain, in cells.
pub fn middle(domain: &Domain) -> [f64; 3] {
    domain.cells().map(|n| 0.5 * n as f64)
}

/// A point in cells.
fn place_of(
    key: &str,
    si_point: [f64; 3],
    domain: &Domain,
    units: &Units,
) -> Result<[f64; 3], Trouble> {
    finite(key, &si_point, "m")?;
    let mut place = [0.0; 3];
    for axis in 0..3 {
        let along = si_point[axis] / units.si_dx;
        let n = domain.cells()[axis];
        if !(0.0..=n as f64).contains(&along) {
            let problem = format!(
                "it lies outside the domain, which spans 0 to {:.6e} m along {}",
                n as f64 * units.si_dx,
                ["x", "y", "z"][axis]
            );
            return Err(Trouble::new(key, problem, "give a point inside the domain"));
        }
        place[axis] = along;
    }
    Ok(place)
}
