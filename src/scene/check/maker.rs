//! The set-up of free grains, made from the keys of `[contact]` and `[lubrication]`.

use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::Vec3;

use super::Trouble;
use super::contact::{Laws, laws, mirror, substeps};
use super::contact_values::Bodies;
use crate::scene::format_free::{ContactSection, LubricationSection};
use crate::units::Units;

/// Makes the set-up of the grains from the keys of `[contact]` and `[lubrication]`.
pub(super) struct Maker<'a> {
    pub grains: &'a [Grain],
    pub bodies: Bodies,
    pub domain: &'a Domain,
    /// Which faces cut grains in halves.
    pub mirrored: [[bool; 2]; 3],
    pub tau: f64,
    pub units: &'a Units,
}

impl Maker<'_> {
    /// The set-up and the faces that hold grains back. Errors at a value that cannot be used.
    pub fn make(
        &self,
        contact: &ContactSection,
        lubrication: Option<&LubricationSection>,
    ) -> Result<(GrainSetup, Vec<Plane>), Trouble> {
        let laws = laws(contact, &self.bodies, self.units)?;
        let planes = planes(self.domain, &laws, &self.mirrored);
        let length =
            |axis: usize| self.domain.is_periodic(axis).then(|| self.domain.cells()[axis] as f64);
        let setup = GrainSetup {
            sides: PeriodicBox { lengths: [length(0), length(1), length(2)] },
            lubrication: lubrication.map(|section| self.lubrication(section)).transpose()?,
            substeps: substeps(contact)?,
            ..GrainSetup::new(laws.grains)
        };
        Ok((setup, planes))
    }
}

/// The faces as planes: walls with their velocity, mirrors as what they mirror, and inlets, outflows
/// and pressure faces as sieves, which let the fluid pass and hold grains back.
fn planes(domain: &Domain, laws: &Laws, mirrored: &[[bool; 2]; 3]) -> Vec<Plane> {
    let mut planes = Vec::new();
    for axis in 0..3 {
        for (side, face) in domain.faces().axis(axis).into_iter().enumerate() {
            let (velocity, law) = match face {
                Face::Periodic => continue,
                // Grains whose centres lie on it are cut in halves: they touch nothing there.
                Face::FreeSlip if mirrored[axis][side] => continue,
                Face::FreeSlip => (Vec3::zeros(), mirror(&laws.grains)),
                Face::Wall { velocity } => (velocity, laws.walls),
                Face::VelocityInlet { .. }
                | Face::FreeOutflow
                | Face::Pressure { .. }
                | Face::DevelopedPressure { .. }
                | Face::NonReflectingPressure { .. } => (Vec3::zeros(), laws.walls),
            };
            let mut point = Vec3::zeros();
            let mut inward = Vec3::zeros();
            (point[axis], inward[axis]) =
                if side == 0 { (0.0, 1.0) } else { (domain.cells()[axis] as f64, -1.0) };
            planes.push(Plane { velocity, ..Plane::fixed(point, inward, law) });
        }
    }
    planes
}
