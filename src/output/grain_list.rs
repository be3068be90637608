//! Lists of grains as scenes read them: CSV with a line for each grain.

use psmrt_reference::grains::grain::Grain;

use crate::scene::check::grain_list::COLUMNS;

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
