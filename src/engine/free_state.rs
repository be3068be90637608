//! The state of free grains as bytes: what any engine saves of them besides its fluid.
//!
//! Grains, planes, springs of all contacts, contact loads, and what the coupling carries from the last
//! step: read back, they go on bit for bit.

use std::io::{self, Read, Write};

use nalgebra::{Quaternion, UnitQuaternion};
use psmrt_reference::coupling::LastStep;
use psmrt_reference::grains::contact::ContactMemory;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::neighbours::Candidate;
use psmrt_reference::grains::pairs::PairContact;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::system::{GrainState, PlaneContact};
use psmrt_reference::solids::Load;

use super::bytes::{expect, put_real, put_vector, put_whole, real, vector, whole};
use crate::scene::FreePart;

/// Writes the state of the grains and what is carried from the last step.
pub fn save(out: &mut dyn Write, state: &GrainState, last: &[LastStep]) -> io::Result<()> {
    put_whole(out, state.grains.len() as u64)?;
    for ((grain, load), last) in state.grains.iter().zip(&state.contact_loads).zip(last) {
        let vectors =
            [&grain.position, &grain.velocity, &grain.angular_velocity, &load.force, &load.torque];
        let before = [&last.velocity, &last.angular_velocity];
        let acted = [&last.load, &last.outside, &last.contacts];
        let acted = acted.into_iter().flat_map(|load| [&load.force, &load.torque]);
        vectors
            .into_iter()
            .chain(before)
            .chain(acted)
            .try_for_each(|vector| put_vector(out, vector))?;
        grain.orientation.coords.iter().try_for_each(|&value| put_real(out, value))?;
    }
    put_whole(out, state.planes.len() as u64)?;
    state.planes.iter().try_for_each(|plane| put_vector(out, &plane.point))?;
    put_whole(out, state.pair_contacts.len() as u64)?;
    for PairContact { pair, memory } in &state.pair_contacts {
        put_whole(out, pair.first.into())?;
        put_whole(out, pair.second.into())?;
        for image in pair.image {
            // The bits of a signed number, widened with its sign.
            put_whole(out, i64::from(image).cast_unsigned())?;
        }
        put_memory(out, memory)?;
    }
    put_whole(out, state.plane_contacts.len() as u64)?;
    for PlaneContact { grain, plane, memory } in &state.plane_contacts {
        put_whole(out, *grain as u64)?;
        put_whole(out, *plane as u64)?;
        put_memory(out, memory)?;
    }
    Ok(())
}

/// Reads what [`save`] wrote for the same scene, of which `part` has all that does not change.
pub fn load(from: &mut dyn Read, part: &FreePart) -> io::Result<(GrainState, Vec<LastStep>)> {
    let FreePart { grains, planes, .. } = part;
    expect(whole(from)?, grains.len(), "free grains")?;
    let (mut contact_loads, mut last, mut moved) = (Vec::new(), Vec::new(), Vec::new());
    for grain in grains {
        let (position, velocity, angular_velocity) = (vector(from)?, vector(from)?, vector(from)?);
        contact_loads.push(load_of(from)?);
        let (before, spin_before) = (vector(from)?, vector(from)?);
        last.push(LastStep {
            velocity: before,
            angular_velocity: spin_before,
            load: load_of(from)?,
            outside: load_of(from)?,
            contacts: load_of(from)?,
        });
        let [i, j, k, w] = [real(from)?, real(from)?, real(from)?, real(from)?];
        // Its length was 1 to round-off; normalising it anew would change the last bits.
        let orientation = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
        moved.push(Grain { position, velocity, angular_velocity, orientation, ..*grain });
    }
    expect(whole(from)?, planes.len(), "planes")?;
    let plane = |plane: &Plane| Ok(Plane { point: vector(from)?, ..*plane });
    let planes = planes.iter().map(plane).collect::<io::Result<Vec<_>>>()?;
    let count = grains.len();
    let pair_contacts =
        (0..whole(from)?).map(|_| pair_contact(from, count)).collect::<io::Result<_>>()?;
    let plane_contacts = (0..whole(from)?)
        .map(|_| plane_contact(from, count, planes.len()))
        .collect::<io::Result<_>>()?;
    let state = GrainState { grains: moved, planes, pair_contacts, plane_contacts, contact_loads };
    Ok((state, last))
}

fn load_of(from: &mut dyn Read) -> io::Result<Load> {
    Ok(Load { force: vector(from)?, torque: vector(from)? })
}

fn put_memory(out: &mut dyn Write, memory: &ContactMemory) -> io::Result<()> {
    let ContactMemory { normal, spring, rolling, overlap } = memory;
    [normal, spring, rolling].into_iter().try_for_each(|vector| put_vector(out, vector))?;
    put_real(out, *overlap)
}

fn memory(from: &mut dyn Read) -> io::Result<ContactMemory> {
    let (normal, spring, rolling) = (vector(from)?, vector(from)?, vector(from)?);
    Ok(ContactMemory { normal, spring, rolling, overlap: real(from)? })
}

fn pair_contact(from: &mut dyn Read, grains: usize) -> io::Result<PairContact> {
    let (first, second) = (number(from, grains)?, number(from, grains)?);
    let narrow = |error| io::Error::other(format!("a grain or image out of range: {error}"));
    let mut image = [0; 3];
    for along in &mut image {
        *along = i32::try_from(whole(from)?.cast_signed()).map_err(narrow)?;
    }
    let first = u32::try_from(first).map_err(narrow)?;
    let second = u32::try_from(second).map_err(narrow)?;
    Ok(PairContact { pair: Candidate { first, second, image }, memory: memory(from)? })
}

fn plane_contact(from: &mut dyn Read, grains: usize, planes: usize) -> io::Result<PlaneContact> {
    let (grain, plane) = (number(from, grains)?, number(from, planes)?);
    Ok(PlaneContact { grain, plane, memory: memory(from)? })
}

/// A number below `end`.
fn number(from: &mut dyn Read, end: usize) -> io::Result<usize> {
    let found = whole(from)?;
    usize::try_from(found)
        .ok()
        .filter(|&number| number < end)
        .ok_or_else(|| io::Error::other(format!("a contact names number {found}, there are {end}")))
}
