//! Grains: all sections together as one list, in lattice units.

use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Shape, Solid};

use super::in_time::Files;
use super::listed::{Ball, Listed, Site, check_size, place_key, size_key};
use super::numbers::{absent, beyond, finite, needed, positive, shorter_step};
use super::signal_file::Subject;
use super::{Attachment, MAX_SPEED, Trouble, grain_kinds, in_time, neighbours};
use crate::in_time::{Prescribed, Signal};
use crate::scene::format_grains::{GrainsKind, GrainsSection, MotionKind};
use crate::scene::format_time::VectorInTime;
use crate::units::Units;

/// Densities of free grains over that of the fluid: beyond lie mistaken units.
const DENSITY_RATIOS: std::ops::RangeInclusive<f64> = 0.01..=1000.0;

/// All grains of a scene, those of them whose motion changes in time, and the solids that are no spheres.
#[derive(Clone, Debug, Default)]
pub(super) struct GrainList {
    pub grains: Vec<Listed>,
    pub prescribed: Vec<Prescribed>,
    /// Solids of other shapes.
    pub bodies: Vec<Solid>,
    /// For each of these the key to blame for where it is.
    pub body_keys: Vec<String>,
}

impl GrainList {
    /// The grains of a scene.
    pub fn new(
        sections: &[GrainsSection],
        files: &mut Files,
        (domain, units): (&Domain, &Units),
        is_dry: bool,
    ) -> Result<Self, Trouble> {
        let mut list = GrainList::default();
        for (number, section) in sections.iter().enumerate() {
            let at = |key: &str| format!("grains[{number}].{key}");
            grain_kinds::foreign_keys(section, &at)?;
            if section.kind == GrainsKind::Body {
                continue; // `bodies.rs`
            }
            let motion = motion(section, &at, units, files)?;
            let (velocity, angular_velocity) = (motion.0.at(0.0), motion.1.at(0.0));
            let fastest = (motion.0.largest(Vec3::norm), motion.1.largest(Vec3::norm));
            let place = Site { at: &at, domain, units, is_dry };
            let (balls, bytes) = grain_kinds::balls(section, files.folder, &place)?;
            let unused = unused(section.motion, &balls);
            files
                .attachments
                .extend(bytes.map(|bytes| Attachment::of_grains(number, bytes, unused)));
            let solids = list.grains.len()..list.grains.len() + balls.len();
            if motion.0.varies() || motion.1.varies() {
                let (velocity, angular_velocity) = motion;
                list.prescribed.push(Prescribed {
                    solids,
                    section: number,
                    velocity,
                    angular_velocity,
                });
            }
            for ball in balls {
                let on_line = |trouble: Trouble| trouble.on_line(ball.line);
                let density = density(section, &ball, &place).map_err(on_line)?;
                let centre = Units::to_lattice(ball.si_centre, units.si_dx);
                let radius = 0.5 * ball.si_diameter / units.si_dx;
                let (key, motion) = (place_key(section, &at), section.motion);
                let own = own_motion(section, &at, &ball, units).map_err(on_line)?;
                let (velocity, angular_velocity) =
                    (own.0.unwrap_or(velocity), own.1.unwrap_or(angular_velocity));
                let fastest = (own.0.unwrap_or(fastest.0), own.1.unwrap_or(fastest.1));
                check_size(&size_key(section, &at), radius, &place).map_err(on_line)?;
                check_speed(&at("spin"), &fastest.0, &fastest.1, radius, units).map_err(on_line)?;
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

    /// Velocity and angular velocity of grain `number`, at the start and where they are largest.
    pub fn motions(&self, number: usize) -> Vec<(Vec3, Vec3)> {
        let start = &self.grains[number];
        let mut motions = vec![(start.velocity, start.angular_velocity)];
        for prescribed in self.prescribed.iter().filter(|all| all.solids.contains(&number)) {
            let still = Vec3::zeros();
            motions.extend(prescribed.velocity.corners().into_iter().map(|v| (v, still)));
            motions.extend(prescribed.angular_velocity.corners().into_iter().map(|w| (still, w)));
        }
        motions
    }

    /// All as solids of the fluid: the spheres, and behind them the other solids.
    pub fn solids(&self) -> Vec<Solid> {
        let solid = |listed: &Listed| {
            let Listed { centre, radius, velocity, angular_velocity, .. } = *listed;
            Solid { shape: Shape::Sphere { radius }, centre, velocity, angular_velocity }
        };
        self.grains.iter().map(solid).chain(self.bodies.iter().cloned()).collect()
    }
}

/// Velocity and angular velocity in lattice units.
pub(super) fn motion(
    section: &GrainsSection,
    at: &impl Fn(&str) -> String,
    units: &Units,
    files: &mut Files,
) -> Result<(Signal<Vec3>, Signal<Vec3>), Trouble> {
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
        MotionKind::Free => {
            only_at_start(&at("velocity"), section.velocity.as_ref())?;
            only_at_start(&at("spin"), section.spin.as_ref())?;
        }
        MotionKind::Prescribed => {}
    }
    let still = VectorInTime::Constant([0.0; 3]);
    let (key, given) = (at("velocity"), section.velocity.as_ref().unwrap_or(&still));
    let velocity =
        in_time::vector(Subject::vector(&key, "m/s"), given, units, files, |si_velocity| {
            super::velocity(&key, si_velocity, units)
        })?;
    let (key, given) = (at("spin"), section.spin.as_ref().unwrap_or(&still));
    let spin = in_time::vector(Subject::vector(&key, "rad/s"), given, units, files, |si_spin| {
        finite(&key, &si_spin, "rad/s")?;
        Ok(Units::to_lattice(si_spin, units.si_angular_velocity()))
    })?;
    Ok((velocity, spin))
}

/// Velocity and angular velocity, lattice units, that the list of a free grain gives it.
fn own_motion(
    section: &GrainsSection,
    at: &impl Fn(&str) -> String,
    ball: &Ball,
    units: &Units,
) -> Result<(Option<Vec3>, Option<Vec3>), Trouble> {
    if section.motion != MotionKind::Free {
        return Ok((None, None));
    }
    for (key, own, given) in
        [("velocity", ball.si_velocity, &section.velocity), ("spin", ball.si_spin, &section.spin)]
    {
        if own.is_some() {
            let belongs = format!("grains of which the file has no columns for the {key}");
            absent(&at(key), given.as_ref(), &belongs)?;
        }
    }
    let velocity = ball.si_velocity.map(|own| super::velocity(&at("file"), own, units));
    let spin = ball.si_spin.map(|own| Units::to_lattice(own, units.si_angular_velocity()));
    Ok((velocity.transpose()?, spin))
}

/// What the list of grains that move so says of them and nobody uses.
fn unused(motion: MotionKind, balls: &[Ball]) -> Vec<&'static str> {
    let is_given = [
        ("densities", balls.iter().any(|ball| ball.si_density.is_some())),
        ("velocities", balls.iter().any(|ball| ball.si_velocity.is_some())),
        ("angular velocities", balls.iter().any(|ball| ball.si_spin.is_some())),
    ];
    let unused = is_given.into_iter().filter(|(_, given)| *given && motion != MotionKind::Free);
    unused.map(|(columns, _)| columns).collect()
}

/// Errors if a free grain is given a motion that changes: it has the one that acts on it.
fn only_at_start(key: &str, value: Option<&VectorInTime>) -> Result<(), Trouble> {
    let Some(VectorInTime::Changing(_)) = value else { return Ok(()) };
    let problem = "a free grain moves by what acts on it: this is its motion at the start";
    let remedy = "give three numbers, or use `motion = \"prescribed\"`";
    Err(Trouble::new(key, problem, remedy))
}

/// Density of a grain over that of the fluid, if it is free; else 1.
fn density(section: &GrainsSection, ball: &Ball, place: &Site<'_>) -> Result<f64, Trouble> {
    let key = (place.at)("density");
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
    let ratio = si_density / place.units.si_density;
    if DENSITY_RATIOS.contains(&ratio) {
        return Ok(ratio);
    }
    let (low, high) = (DENSITY_RATIOS.start(), DENSITY_RATIOS.end());
    let problem = match place.is_dry {
        false => format!(
            "it is {ratio:.3e} times the density of the fluid; {low} to {high} times are allowed"
        ),
        true => {
            let [low, high] = [low, high].map(|ratio| ratio * place.units.si_density);
            format!("{low} to {high} kg/m3 are allowed")
        }
    };
    Err(Trouble::new(key, problem, "densities are in kg/m3: water has 1000, quartz 2650"))
}

pub(super) fn check_speed(
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
