//! The time step, from whichever of dt, tau and lattice velocity is given.

use psmrt_reference::lattice::relaxation_time;
use psmrt_reference::rates::Rates;

use super::numbers::{absent, needed, positive, sane};
use super::{MAX_SPEED, Trouble};
use crate::scene::format::{FluidSection, TimeSection};
use crate::units::Units;

/// The largest relaxation time that is taken: places of walls and grains are lost far below.
const LARGEST_TAU: f64 = 1e4;

/// What messages propose.
const USUAL_TAU: f64 = 0.8;

/// The scales and the relaxation time.
pub(super) fn units_and_tau(
    section: &TimeSection,
    fluid: &FluidSection,
    si_dx: f64,
) -> Result<(Units, f64), Trouble> {
    let si_nu = fluid.kinematic_viscosity;
    if section.lattice_velocity.is_none() {
        let belongs = "`lattice_velocity`";
        absent("time.reference_velocity", section.reference_velocity.as_ref(), belongs)?;
    }
    let (key, si_dt) = match (section.dt, section.tau, section.lattice_velocity) {
        (Some(si_dt), None, None) => {
            positive("time.dt", si_dt, "s")?;
            ("time.dt", si_dt)
        }
        (None, Some(tau), None) => ("time.tau", step_of_tau(tau, si_dx, si_nu)?),
        (None, None, Some(speed)) => {
            let remedy = "add `reference_velocity`, the largest velocity that you expect, in m/s";
            let because = "`lattice_velocity` needs it";
            let si_speed =
                needed("time.reference_velocity", section.reference_velocity, because, remedy)?;
            ("time.lattice_velocity", step_of_speed(speed, si_speed, si_dx)?)
        }
        (None, None, None) => {
            let problem = "nothing says how long a time step is";
            let remedy = "add one of `dt` (s), `tau` (for example 0.8) and `lattice_velocity`";
            return Err(Trouble::new("time", problem, remedy));
        }
        (dt, tau, _) => {
            let second = if dt.is_some() && tau.is_some() { "tau" } else { "lattice_velocity" };
            let problem = "the time step is already set; exactly one of `dt`, `tau` and \
                           `lattice_velocity` is allowed";
            return Err(Trouble::new(format!("time.{second}"), problem, "remove one of them"));
        }
    };
    let units = Units { si_dx, si_dt, si_density: fluid.density };
    // A relaxation time that is given reaches the engine as it is: on its way through dt it would lose digits.
    let tau = section.tau.unwrap_or_else(|| relaxation_time(si_nu / units.si_viscosity()));
    let usual = format!(
        "`time.dt = {:.3e}` would be tau = {USUAL_TAU}: give that, instead of what sets it now",
        step_of_tau(USUAL_TAU, si_dx, si_nu)?
    );
    if let Err(error) = Rates::srt(tau) {
        return Err(Trouble::new(key, error.to_string(), usual));
    }
    let can_be_meant = tau <= LARGEST_TAU;
    if !can_be_meant {
        let problem =
            format!("the relaxation time is {tau:.3e} time steps; {LARGEST_TAU:e} is the limit");
        return Err(Trouble::new(key, problem, usual));
    }
    if !units.si_all().iter().all(|scale| scale.is_normal()) {
        let problem = format!("with a time step of {si_dt:.3e} s the scales are no numbers");
        return Err(Trouble::new(key, problem, usual));
    }
    Ok((units, tau))
}

/// The time step with which the viscosity gets the relaxation time `tau`.
fn step_of_tau(tau: f64, si_dx: f64, si_nu: f64) -> Result<f64, Trouble> {
    if !(tau > 0.5 && tau.is_finite()) {
        let problem = "it must be above 0.5: at 0.5 and below the fluid has no viscosity";
        return Err(Trouble::new(
            "time.tau",
            problem,
            "0.55 to 0.8 give the best accuracy for their cost; try 0.6",
        ));
    }
    // ν = (τ - 1/2)/3 dx²/dt
    Ok((tau - 0.5) / 3.0 * si_dx * si_dx / si_nu)
}

/// The time step with which `si_speed` becomes `speed` cells per step.
fn step_of_speed(speed: f64, si_speed: f64, si_dx: f64) -> Result<f64, Trouble> {
    positive("time.reference_velocity", si_speed, "m/s")?;
    sane("time.reference_velocity", si_speed, 1e-15..=1e9, "m/s")?;
    if !(speed > 0.0 && speed <= MAX_SPEED) {
        let problem = format!("it must be above 0 and at most {MAX_SPEED} cells per time step");
        return Err(Trouble::new(
            "time.lattice_velocity",
            problem,
            "0.01 to 0.1 is usual; try 0.05",
        ));
    }
    Ok(speed * si_dx / si_speed)
}
