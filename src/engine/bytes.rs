//! Numbers as bytes, little-endian: what goes in comes out with the same bits.

use std::io::{self, Read, Write};

use psmrt_reference::drive::{Drive, FaceValue};
use psmrt_reference::lattice::Vec3;

pub(super) fn put_whole(out: &mut dyn Write, value: u64) -> io::Result<()> {
    out.write_all(&value.to_le_bytes())
}

pub(super) fn put_real(out: &mut dyn Write, value: f64) -> io::Result<()> {
    out.write_all(&value.to_le_bytes())
}

pub(super) fn put_vector(out: &mut dyn Write, vector: &Vec3) -> io::Result<()> {
    vector.iter().try_for_each(|&value| put_real(out, value))
}

/// Writes the values of a drive, those that it has.
pub(super) fn put_drive(out: &mut dyn Write, drive: &Drive) -> io::Result<()> {
    drive.body_force.iter().try_for_each(|force| put_vector(out, force))?;
    drive.faces.iter().flatten().try_for_each(|value| match value {
        FaceValue::None => Ok(()),
        FaceValue::Velocity(velocity) => put_vector(out, velocity),
        FaceValue::Density(density) => put_real(out, *density),
    })
}

/// Reads a drive with values of the same kinds as those of `like`.
pub(super) fn drive(from: &mut dyn Read, like: &Drive) -> io::Result<Drive> {
    let mut drive = like.clone();
    if let Some(force) = &mut drive.body_force {
        *force = vector(from)?;
    }
    for value in drive.faces.iter_mut().flatten() {
        match value {
            FaceValue::None => {}
            FaceValue::Velocity(velocity) => *velocity = vector(from)?,
            FaceValue::Density(density) => *density = real(from)?,
        }
    }
    Ok(drive)
}

pub(super) fn whole(from: &mut dyn Read) -> io::Result<u64> {
    let mut bytes = [0; 8];
    from.read_exact(&mut bytes)?;
    Ok(u64::from_le_bytes(bytes))
}

pub(super) fn real(from: &mut dyn Read) -> io::Result<f64> {
    Ok(f64::from_bits(whole(from)?))
}

pub(super) fn vector(from: &mut dyn Read) -> io::Result<Vec3> {
    Ok(Vec3::new(real(from)?, real(from)?, real(from)?))
}

/// Errors unless the file has as many as the scene.
pub(super) fn expect(found: u64, wanted: usize, what: &str) -> io::Result<()> {
    if found == wanted as u64 {
        return Ok(());
    }
    Err(io::Error::other(format!("it has {found} {what}, the scene {wanted}")))
}
