//! The state of a run as bytes: the part that is the same above every fluid engine, then the fluid's own, then
//! the free grains'.

use std::io::{self, Read, Write};

use psmrt_reference::coupling::FreeGrains;
use psmrt_reference::guard::{Evidence, Guard};
use psmrt_reference::solids::{Load, Solid};

use super::bytes::{
    drive, expect, put_drive, put_real, put_vector, put_whole, real, vector, whole,
};
use super::coupled::{Coupled, Grains};
use super::free_state;

impl Coupled {
    /// Writes all that it needs to go on from here, bit for bit.
    pub fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        put_whole(out, self.steps)?;
        let Evidence { first_mean_density, last_mean_density, last_max_speed } =
            self.guard.evidence();
        // NaN stands for "no look yet": the guard never keeps one.
        put_real(out, first_mean_density.unwrap_or(f64::NAN))?;
        put_real(out, last_mean_density)?;
        put_real(out, last_max_speed)?;
        let (solids, loads) = (self.solids(), self.fluid.loads().map_err(io::Error::other)?);
        put_whole(out, solids.len() as u64)?;
        for (solid, load) in solids.iter().zip(&loads) {
            let vectors = [
                &solid.centre,
                &solid.velocity,
                &solid.angular_velocity,
                &load.force,
                &load.torque,
            ];
            vectors.into_iter().try_for_each(|vector| put_vector(out, vector))?;
        }
        let moving = self.bodies.as_ref().map_or(&[][..], |bodies| &bodies.moving);
        if !moving.is_empty() {
            put_whole(out, moving.len() as u64)?;
        }
        for body in moving {
            body.turn_numbers().into_iter().try_for_each(|number| put_real(out, number))?;
        }
        put_drive(out, &self.setup().drive())?;
        put_whole(out, self.setup().domain.cell_count() as u64)?;
        self.fluid.save(out)?;
        match &self.grains {
            Some(Grains { moving, .. }) => {
                free_state::save(out, &moving.system().state(), moving.last_steps())
            }
            None => Ok(()),
        }
    }

    /// Takes the state that [`Self::save`] wrote for the same scene. After an error it is of no use.
    pub fn load(&mut self, from: &mut dyn Read) -> io::Result<()> {
        self.steps = whole(from)?;
        let evidence = Evidence {
            first_mean_density: Some(real(from)?).filter(|density| !density.is_nan()),
            last_mean_density: real(from)?,
            last_max_speed: real(from)?,
        };
        self.guard = Guard::going_on_from(self.setup().guard, evidence);
        let mut solids: Vec<Solid> = self.solids();
        let mut loads = Vec::new();
        expect(whole(from)?, solids.len(), "grains")?;
        for solid in &mut solids {
            (solid.centre, solid.velocity, solid.angular_velocity) =
                (vector(from)?, vector(from)?, vector(from)?);
            loads.push(Load { force: vector(from)?, torque: vector(from)? });
        }
        if let Some(bodies) = &self.bodies {
            expect(whole(from)?, bodies.moving.len(), "bodies that move")?;
        }
        for body in self.bodies.iter_mut().flat_map(|bodies| &mut bodies.moving) {
            body.set_turn([real(from)?, real(from)?, real(from)?, real(from)?]);
        }
        self.shape_bodies(&mut solids).map_err(io::Error::other)?;
        // The kinds of its values are the set-up's.
        let drive = drive(from, &self.setup().drive())?;
        self.fluid.set_drive(&drive).map_err(io::Error::other)?;
        expect(whole(from)?, self.setup().domain.cell_count(), "cells")?;
        self.fluid.load(from, solids, loads)?;
        if let Some(Grains { moving, part }) = &mut self.grains {
            let (state, last) = free_state::load(from, part)?;
            let domain = &self.fluid.setup().domain;
            *moving = FreeGrains::going_on_from(domain, (part.setup, state), part.settings, last)
                .map_err(io::Error::other)?;
        }
        // What changes in time is that of now.
        self.put_values_of_now().map_err(io::Error::other)
    }

    /// Takes the state that [`Self::save`] wrote for a scene that differs from this one by the values that drive fluid and
    /// grains alone: the state is of then, what drives it this scene's. After an error it is of no use.
    pub fn load_with_changes(&mut self, from: &mut dyn Read) -> io::Result<()> {
        let (drive, own) = (self.setup().drive(), self.solids());
        self.load(from)?;
        self.set_drive(&drive).map_err(io::Error::other)?;
        self.put_values_of_now().map_err(io::Error::other)?;
        self.prescribe_as(&own).map_err(io::Error::other)
    }
}
