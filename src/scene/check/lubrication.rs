//! The `[lubrication]` section in lattice units.

use psmrt_reference::domain::Face;
use psmrt_reference::grains::lubrication::Lubrication;
use psmrt_reference::lattice::viscosity;

use super::Trouble;
use super::maker::Maker;
use super::numbers::positive;
use crate::scene::format_free::LubricationSection;

/// The smallest gap of lubrication over the smallest radius, where a scene says nothing.
const ROUGHNESS: f64 = 1e-3;

impl Maker<'_> {
    /// The correction between close surfaces. Errors where it makes no sense.
    pub fn lubrication(&self, section: &LubricationSection) -> Result<Lubrication, Trouble> {
        for axis in 0..3 {
            for (side, face) in self.domain.faces().axis(axis).into_iter().enumerate() {
                if face == Face::FreeSlip && !self.mirrored[axis][side] {
                    let problem = "a mirror plane (`free_slip`) would get the lubrication of a wall, \
                                   four times that between a grain and its mirror image";
                    let remedy = "make that face a wall or periodic, or remove [lubrication]";
                    return Err(Trouble::new("lubrication", problem, remedy));
                }
            }
        }
        for (name, si_gap) in
            [("smallest_gap", section.smallest_gap), ("cutoff_gap", section.cutoff_gap)]
        {
            if let Some(si_gap) = si_gap {
                positive(&format!("lubrication.{name}"), si_gap, "m")?;
            }
        }
        let si_dx = self.units.si_dx;
        let radii = || self.grains.iter().map(|grain| grain.radius);
        let smallest = radii().fold(f64::INFINITY, f64::min);
        let cutoff_gap = section.cutoff_gap.map_or(1.0, |si_gap| si_gap / si_dx);
        let smallest_gap = section.smallest_gap.map_or(ROUGHNESS * smallest, |gap| gap / si_dx);
        let largest_cutoff = self.largest_cutoff(radii().fold(0.0, f64::max));
        if cutoff_gap > largest_cutoff {
            let problem = format!(
                "it must be {:.2e} m or less: lubrication acts in gaps smaller than a grain, and not across \
                 the whole box",
                0.99 * largest_cutoff * si_dx
            );
            let remedy = "leave it out for the edge of a cell";
            return Err(Trouble::new("lubrication.cutoff_gap", problem, remedy));
        }
        if smallest_gap < cutoff_gap {
            let while_touching = section.while_touching.unwrap_or(true);
            let viscosity = viscosity(self.tau);
            return Ok(Lubrication { viscosity, cutoff_gap, smallest_gap, while_touching });
        }
        let key = if section.smallest_gap.is_some() { "smallest_gap" } else { "cutoff_gap" };
        let problem = format!(
            "the gaps are {:.3e} m (smallest) and {:.3e} m (cut-off); the smallest must be above 0 \
             and below the cut-off",
            smallest_gap * si_dx,
            cutoff_gap * si_dx
        );
        let remedy = "common are a thousandth of a radius and the edge of a cell";
        Err(Trouble::new(format!("lubrication.{key}"), problem, remedy))
    }

    /// The largest cut-off, cells: a diameter, and short enough that no grain reaches its own image.
    fn largest_cutoff(&self, largest_radius: f64) -> f64 {
        let periodic = (0..3).filter(|&axis| self.domain.is_periodic(axis));
        let rooms = periodic.map(|axis| self.domain.cells()[axis] as f64 - 2.0 * largest_radius);
        rooms.filter(|&room| room > 1.0).fold(2.0 * largest_radius, f64::min)
    }
}
