//! Lists of grains as scenes read them: CSV with a line for each grain.

use psmrt_reference::grains::grain::{Grain, sphere_volume};

use super::wrapped::wrapped;
use crate::engine::Coupled;
use crate::scene::Scene;
use crate::scene::check::grain_list::{COLUMNS, MOTION_COLUMNS};

/// The list of `grains` (places and radii in m), with `si_density` (kg/m3) as a last column if it is
/// given; `comments` stand above it. The same grains give the same bytes.
pub fn to_csv(grains: &[Grain], si_density: Option<f64>, comments: &[String]) -> String {
    let columns = if si_density.is_some() { &COLUMNS[..] } else { &COLUMNS[..COLUMNS.len() - 1] };
    let mut text: String = comments.iter().map(|comment| format!("# {comment}\n")).collect();
    text.push_str(&columns.join(","));
    text.push('\n');
    for Grain { position, radius, .. } in grains {
        let (x, y, z, diameter) = (position.x, position.y, position.z, 2.0 * radius);
        text.push_str(&format!("{x:?},{y:?},{z:?},{diameter:?}"));
        if let Some(si_density) = si_density {
            text.push_str(&format!(",{si_density:?}"));
        }
        text.push('\n');
    }
    text
}

/// The list of the free grains of a run where they are now, with their densities and motions. `None` if none is free.
pub fn of_run(scene: &Scene, engine: &Coupled) -> Option<String> {
    let (units, domain) = (&scene.units, &scene.setup.domain);
    let system = engine.free_grains()?;
    let steps = engine.steps();
    let mut text = format!(
        "# the free grains of a run after {steps} steps ({:.6e} s)\n{},{}\n",
        steps as f64 * units.si_dt,
        COLUMNS.join(","),
        MOTION_COLUMNS.join(",")
    );
    for grain in system.grains().iter().filter(|grain| !grain.held) {
        let si_place = (grain.position * units.si_dx).as_slice().to_vec();
        let mut values = wrapped(domain, &si_place, units.si_dx).to_vec();
        values.push(2.0 * grain.radius * units.si_dx);
        values.push(grain.mass / sphere_volume(grain.radius) * units.si_density);
        values.extend((grain.velocity * units.si_velocity()).iter());
        values.extend((grain.angular_velocity * units.si_angular_velocity()).iter());
        let values: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
        text.push_str(&values.join(","));
        text.push('\n');
    }
    Some(text)
}
