//! One grain on its way from a section or a file to the list of all: a sphere in SI units, then in lattice units with the key
//! to blame for it.

use psmrt_reference::domain::Domain;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::lattice::Vec3;

use super::Trouble;
use crate::scene::format_grains::{GrainsKind, GrainsSection, MotionKind};
use crate::units::Units;

/// A grain with fewer cells across is not seen by the fluid as a sphere at all.
pub const MIN_CELLS_PER_DIAMETER: f64 = 2.0;

/// A sphere, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ball {
    pub si_centre: [f64; 3],
    pub si_diameter: f64,
    /// Where its file gives one.
    pub si_density: Option<f64>,
    /// Where its file gives one.
    pub si_velocity: Option<[f64; 3]>,
    /// Where its file gives one.
    pub si_spin: Option<[f64; 3]>,
    /// Its line in the file that it comes from, from 1.
    pub line: Option<usize>,
}

impl Ball {
    /// A sphere of which no more is given.
    pub fn of(si_centre: [f64; 3], si_diameter: f64) -> Self {
        let (si_density, si_velocity, si_spin, line) = (None, None, None, None);
        Ball { si_centre, si_diameter, si_density, si_velocity, si_spin, line }
    }
}

/// Where grains are put down: the domain, and how a key of their section is called.
pub(super) struct Site<'a> {
    pub at: &'a dyn Fn(&str) -> String,
    pub domain: &'a Domain,
    pub units: &'a Units,
    /// Whether there is no fluid, whose cells would have to resolve the grains.
    pub is_dry: bool,
}

impl Site<'_> {
    /// Lengths of the domain, m.
    pub fn si_lengths(&self) -> [f64; 3] {
        self.domain.cells().map(|n| n as f64 * self.units.si_dx)
    }
}

/// A grain in lattice units, with the key to blame for it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Listed {
    pub key: String,
    /// Its line in the file that it comes from.
    pub line: Option<usize>,
    pub motion: MotionKind,
    pub centre: Vec3,
    pub radius: f64,
    /// Over that of the fluid; 1 for grains that are not free, where it means nothing.
    pub density: f64,
    pub velocity: Vec3,
    pub angular_velocity: Vec3,
}

impl Listed {
    /// Trouble with it.
    pub fn trouble(&self, problem: String, remedy: &str) -> Trouble {
        Trouble::new(&self.key, problem, remedy).on_line(self.line)
    }

    /// How messages about several grains call it, `number` from 0.
    pub fn name(&self, number: usize) -> String {
        match self.line {
            Some(line) => format!("grain {number} (from 0; line {line} of {})", self.key),
            None => format!("grain {number} (from 0; {})", self.key),
        }
    }
}

/// Errors if a grain is too coarse.
pub(super) fn check_size(
    key: &str,
    radius: f64,
    &Site { domain, units, is_dry, .. }: &Site<'_>,
) -> Result<(), Trouble> {
    let lengths = domain.cells().map(|cells| cells as f64);
    let largest = 4.0 * Vec3::from(lengths).norm();
    if 2.0 * radius > largest {
        let [x, y, z] = lengths.map(|length| length * units.si_dx);
        let problem = format!(
            "a grain of {:.4e} m is far larger than the domain ({x:.4e} x {y:.4e} x {z:.4e} m): nothing is \
             left of it, wherever the centre lies",
            2.0 * radius * units.si_dx
        );
        let remedy = format!(
            "lengths are in metres (a micrometre is 1e-6); a sphere that mirror faces cut may be up to \
             {:.1e} m across",
            largest * units.si_dx
        );
        return Err(Trouble::new(key, problem, remedy));
    }
    if is_dry || 2.0 * radius >= MIN_CELLS_PER_DIAMETER {
        return Ok(());
    }
    let problem = format!(
        "a grain of {:.4e} m is {:.2} cells across; at least {MIN_CELLS_PER_DIAMETER} are needed, \
         8 or more are good",
        2.0 * radius * units.si_dx,
        2.0 * radius
    );
    let remedy = format!("use `domain.dx = {:.3e}` (m) or less", radius * units.si_dx / 4.0);
    Err(Trouble::new(key, problem, remedy))
}

impl Listed {
    /// Mass in lattice units.
    pub fn mass(&self) -> f64 {
        Grain::sphere(self.centre, self.radius, self.density).mass
    }

    /// It as a grain.
    pub fn to_grain(&self) -> Grain {
        let grain = Grain::sphere(self.centre, self.radius, self.density)
            .moving(self.velocity)
            .spinning(self.angular_velocity);
        Grain { held: self.motion != MotionKind::Free, ..grain }
    }
}

/// The key to blame for where a grain is.
pub(super) fn place_key(section: &GrainsSection, at: &dyn Fn(&str) -> String) -> String {
    match section.kind {
        GrainsKind::Sphere => at("centre"),
        GrainsKind::Csv => at("file"),
        GrainsKind::Array if section.diameter.is_some() => at("diameter"),
        GrainsKind::Array => at("solid_fraction"),
        GrainsKind::Voxels => at("image"),
        GrainsKind::Body => at("body"),
        GrainsKind::Bed => at("count"),
        GrainsKind::Random if section.count.is_some() => at("count"),
        GrainsKind::Random => at("solid_fraction"),
    }
}

/// The key to blame for how large a grain is.
pub(super) fn size_key(section: &GrainsSection, at: &dyn Fn(&str) -> String) -> String {
    match section.kind {
        GrainsKind::Csv | GrainsKind::Array => place_key(section, at),
        _ if section.diameter_range.is_some() => at("diameter_range"),
        _ if section.grading.is_some() => at("grading"),
        _ if section.log_normal.is_some() => at("log_normal"),
        _ => at("diameter"),
    }
}
