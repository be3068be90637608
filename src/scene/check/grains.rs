//! Grains: all sections together as one list, in lattice units.

use std::path::Path;

use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use super::listed::{Ball, Listed, Site, check_size, place_key, size_key};
use super::numbers::{absent, beyond, finite, needed, positive, shorter_step};
use super::{MAX_SPEED, Trouble, grain_kinds, neighbours};
use crate::scene::format_grains::{GrainsSection, MotionKind};
use crate::units::Units;

/// Densities of free grains over that of the fluid: beyond lie mistaken units.
const DENSITY_RATIOS: std::ops::RangeInclusive<f64> = 0.01..=1000.0;

/// The contents of a file that a scene names: a run keeps a copy.
#[derive(Clone, Debug, PartialEq)]
pub struct Attachment {
    /// Number of the `[[grains]]` section that names it.
    pub section: usize,
    /// What is in it.
    pub bytes: Vec<u8>,
    /// Whether it has densities that nobody uses: its grains are not free.
    pub unused_densities: bool,
}

impl Attachment {
    /// Name of the copy in the folder of a run.
    pub fn file_name(&self) -> String {
        format!("grains_{}.csv", self.section)
    }
}

/// All grains of a scene, and the files they come from.
#[derive(Clone, Debug, Default)]
pub(super) struct GrainList {
    pub grains: Vec<Listed>,
    pub attachments: Vec<Attachment>,
}

impl GrainList {
    /// The grains of a scene.
    pub fn new(
        sections: &[GrainsSection],
        folder: &Path,
        domain: &Domain,
        units: &Units,
    ) -> Result<Self, Trouble> {
        let mut list = GrainList::default();
        for (number, section) in sections.iter().enumerate() {
            let at = |key: &str| format!("grains[{number}].{key}");
            grain_kinds::foreign_keys(section, &at)?;
            let (velocity, angular_velocity) = motion(section, &at, units)?;
            let place = Site { at: &at, domain, units };
            let (balls, bytes) = grain_kinds::balls(section, folder, &place)?;
            let unused_densities =
                section.motion != MotionKind::Free && balls.iter().any(|b| b.si_density.is_some());
            list.attachments.extend(bytes.map(|bytes| Attachment {
                section: number,
                bytes,
                unused_densities,
            }));
            for ball in balls {
                let on_line = |trouble: Trouble| trouble.on_line(ball.line);
                let density = density(section, &at, &ball, units).map_err(on_line)?;
                let centre = Units::to_lattice(ball.si_centre, units.si_dx);
                let radius = 0.5 * ball.si_diameter / units.si_dx;
                let (key, motion) = (place_key(section, &at), section.motion);
                check_size(&size_key(section, &at), radius, domain, units).map_err(on_line)?;
                check_speed(&at("spin"), &velocity, &angular_velocity, radius, units)
                    .map_err(on_line)?;
                neighbours::inside(&key, domain, &centre, radius, units).map_err(on_line)?;
                let line = ball.line;
                list.grains.push(Listed {
                    key,
                    line,
                    motion,
                    centre,
                    radius,
                    density,
                    velocity,
                    angular_velocity,
                });
            }
        }
        neighbours::apart(domain, &list.grains, units)?;
        Ok(list)
    }

    /// The free ones.
    pub fn free(&self) -> impl Iterator<Item = &Listed> {
        self.grains.iter().filter(|listed| listed.motion == MotionKind::Free)
    }

    /// All as solids of the fluid.
    pub fn solids(&self) -> Vec<Solid> {
        let solid = |listed: &Listed| {
            let Listed { centre, radius, velocity, angular_velocity, .. } = *listed;
            Solid { shape: Shape::Sphere { radius }, centre, velocity, angular_velocity }
        };
        self.grains.iter().map(solid).collect()
    }
}

/// Velocity and angular velocity in lattice units.
fn motion(
    section: &GrainsSection,
    at: &impl Fn(&str) -> String,
    units: &Units,
) -> Result<(Vec3, Vec3), Trouble> {
    match section.motion {
        MotionKind::Fixed => {
            let belongs = "`motion = \"prescribed\"` or \"free\"";
            absent(&at("velocity"), section.velocity.as_ref(), belongs)?;
            absent(&at("spin"), section.spin.as_ref(), belongs)?;
        }
        MotionKind::Prescribed if section.velocity.is_none() && section.spin.is_none() => {
            let problem = "it needs `velocity` (m/s) or `spin` (rad/s), and has neither";
            return Err(Trouble::new(at("motion"), problem, "add one of them, or use \"fixed\""));
        }
        MotionKind::Prescribed | MotionKind::Free => {}
    }
    let velocity = match section.velocity {
        Some(si_velocity) => super::velocity(&at("velocity"), si_velocity, units)?,
        None => Vec3::zeros(),
    };
    let angular_velocity = section.spin.unwrap_or([0.0; 3]);
    finite(&at("spin"), &angular_velocity, "rad/s")?;
    Ok((velocity, Units::to_lattice(angular_velocity, units.si_angular_velocity())))
}

/// Density of a grain over that of the fluid, if it is free; else 1.
fn density(
    section: &GrainsSection,
    at: &impl Fn(&str) -> String,
    ball: &Ball,
    units: &Units,
) -> Result<f64, Trouble> {
    let key = at("density");
    if section.motion != MotionKind::Free {
        absent(&key, section.density.as_ref(), "`motion = \"free\"`")?;
        return Ok(1.0);
    }
    if ball.si_density.is_some() {
        let belongs = "grains of which the file has no column `density (kg/m3)`";
        absent(&key, section.density.as_ref(), belongs)?;
    }
    let remedy = "add `density`, in kg/m3 (quartz has 2650)";
    let si_density =
        needed(&key, section.density.or(ball.si_density), "a free grain needs it", remedy)?;
    positive(&key, si_density, "kg/m3, quartz has 2650")?;
    let ratio = si_density / units.si_density;
    if DENSITY_RATIOS.contains(&ratio) {
        return Ok(ratio);
    }
    let problem = format!(
        "it is {ratio:.3e} times the density of the fluid; {} to {} times are allowed",
        DENSITY_RATIOS.start(),
        DENSITY_RATIOS.end()
    );
    Err(Trouble::new(key, problem, "densities are in kg/m3: water has 1000, quartz 2650"))
}

fn check_speed(
    key: &str,
    velocity: &Vec3,
    angular_velocity: &Vec3,
    radius: f64,
    units: &Units,
) -> Result<(), Trouble> {
    let speed = velocity.norm() + angular_velocity.norm() * radius;
    if speed <= MAX_SPEED {
        return Ok(());
    }
    let problem = format!(
        "the surface moves at {} cells per time step; at most {MAX_SPEED} is allowed",
        beyond(speed, MAX_SPEED)
    );
    let remedy = shorter_step(units, 0.5 * MAX_SPEED / speed) + ", or use a slower spin";
    Err(Trouble::new(key, problem, remedy))
}
