//! Images put into the domain: as solids of it, with pores that let fluid through.

use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::Setup;
use psmrt_reference::solids::Solid;

use super::Trouble;
use super::grains::GrainList;
use super::in_time::Files;
use super::permeability::driven_axes;
use super::voxels::ListedImage;
use crate::units::Units;
use crate::voxels::pores::{pores, solid_cells};
use crate::voxels::shares::{Placed, solid_shares};

/// How far an image may reach out of the domain, cells: what rounding of lengths leaves.
const REACHES_OUT: f64 = 1e-6;

const AXES: [&str; 3] = ["x", "y", "z"];

impl ListedImage {
    fn key(&self, key: &str) -> String {
        format!("grains[{}].image{}{key}", self.section, if key.is_empty() { "" } else { "." })
    }

    /// Its lengths, m.
    pub fn si_size(&self) -> [f64; 3] {
        self.body.counts().map(|count| count as f64 * self.si_voxel)
    }

    /// It as a solid of the domain.
    fn solid(&self, domain: &Domain, units: &Units) -> Result<Solid, Trouble> {
        let cells = domain.cells();
        let corner = self.si_corner.map(|place| place / units.si_dx);
        let voxel = self.si_voxel / units.si_dx;
        let counts = self.body.counts();
        for axis in 0..3 {
            let [low, high] = [corner[axis], corner[axis] + counts[axis] as f64 * voxel];
            if low < -REACHES_OUT || high > cells[axis] as f64 + REACHES_OUT {
                let [si_low, si_high] = [low, high].map(|place| place * units.si_dx);
                let problem = format!(
                    "along {} it reaches from {si_low:.6e} to {si_high:.6e} m ({} voxels of {:e} m), out of the domain (0 to \
                     {:.6e} m)",
                    AXES[axis],
                    counts[axis],
                    self.si_voxel,
                    cells[axis] as f64 * units.si_dx
                );
                let remedy = "crop it (`crop_from`, `crop_to`), move it (`corner`), or leave `domain.size` and \
                              `domain.cells` out: the domain is as large as the image then";
                return Err(Trouble::new(self.key(""), problem, remedy));
            }
        }
        let fractions = solid_shares(&self.body, &Placed { corner, voxel, cells });
        if fractions.is_empty() {
            let problem = format!("no voxel of it is solid: {}", self.numbers_in_words());
            let remedy = "say which numbers are solid by `solid`, `solid_above` or `grey`";
            return Err(Trouble::new(self.key(""), problem, remedy));
        }
        if fractions.len() == domain.cell_count()
            && fractions.iter().all(|(_, share)| *share == 1.0)
        {
            let problem =
                format!("all of it is solid, no pore is left: {}", self.numbers_in_words());
            let remedy = "say which numbers are solid by `solid`, `solid_above` or `grey`";
            return Err(Trouble::new(self.key(""), problem, remedy));
        }
        let middle = [0, 1, 2].map(|axis| corner[axis] + 0.5 * counts[axis] as f64 * voxel);
        Ok(Solid { centre: Vec3::from(middle), ..Solid::fixed_cells(fractions) })
    }

    /// What numbers it has.
    fn numbers_in_words(&self) -> String {
        let [nx, ny, nz] = self.body.used;
        let mut found: Vec<f64> = Vec::new();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for z in 0..nz {
            for y in 0..ny {
                for x in 0..nx {
                    let [i, j, k] = self.body.first;
                    let number = self.body.image.number([i + x, j + y, k + z]);
                    (least, most) = (least.min(number), most.max(number));
                    if found.len() < 6 && !found.contains(&number) {
                        found.push(number);
                    }
                }
            }
        }
        if found.len() < 6 {
            found.sort_by(f64::total_cmp);
            let list: Vec<String> = found.iter().map(f64::to_string).collect();
            format!("its numbers are {}", list.join(", "))
        } else {
            format!("its numbers lie between {least} and {most}")
        }
    }
}

/// Puts the images behind the spheres of a list, and keeps their files. Errors if one does not fit.
pub(super) fn add(
    images: &[ListedImage],
    list: &mut GrainList,
    files: &mut Files,
    (domain, units): (&Domain, &Units),
) -> Result<(), Trouble> {
    for image in images {
        list.bodies.push(image.solid(domain, units)?);
        list.body_keys.push(image.key(""));
    }
    files.attachments.extend(images.iter().map(|image| image.attachment.clone()));
    Ok(())
}

/// Errors if no pore between images lets fluid through along an axis along which it is driven.
pub(super) fn check_pores(images: &[ListedImage], setup: &Setup) -> Result<(), Trouble> {
    let Some(image) = images.first() else { return Ok(()) };
    for axis in driven_axes(setup) {
        let found = pores(&setup.domain, &solid_cells(setup), axis);
        if found.through > 0 {
            continue;
        }
        let (how, remedy) = match setup.domain.is_periodic(axis) {
            true => (
                "comes back to where it began a period further on",
                format!(
                    "put its mirror image behind it (`mirror = [\"{}\"]`), so that its ends fit to each other; ",
                    AXES[axis]
                ),
            ),
            false => ("leads from end to end", String::new()),
        };
        let problem = format!(
            "no pore lets fluid through along {}, along which it is driven: the image has {} cells that are not solid \
             throughout, and no path between them {how}",
            AXES[axis], found.all
        );
        let remedy =
            remedy + "look at what is solid (`solid`, `solid_above`, `grey`) and at `axes`";
        return Err(Trouble::new(image.key(""), problem, remedy));
    }
    Ok(())
}
