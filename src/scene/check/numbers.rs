//! Checks of single numbers.

use std::ops::RangeInclusive;

use super::Trouble;
use crate::units::Units;

/// Steps that a run can count.
const MOST_STEPS: f64 = 1e15;

/// Errors unless every component is a finite number. `unit` says what it is measured in.
pub(super) fn finite(key: &str, values: &[f64], unit: &str) -> Result<(), Trouble> {
    if values.iter().all(|value| value.is_finite()) {
        return Ok(());
    }
    Err(Trouble::new(key, "it must be finite", format!("give a finite number ({unit})")))
}

/// Errors unless `value` is positive and finite. `hint` says what it is measured in.
pub(super) fn positive(key: &str, value: f64, hint: &str) -> Result<(), Trouble> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    let remedy = format!("give a number above 0 ({hint})");
    Err(Trouble::new(key, "it must be positive and finite", remedy))
}

/// Coefficients of friction and of rolling resistance that are accepted. Those of rough grains are below 2; a larger one
/// than this holds two grains together as well as any.
pub(crate) const COEFFICIENTS: RangeInclusive<f64> = 0.0..=10.0;

/// Errors unless `value` is such a coefficient. `usual` is the remedy.
pub(super) fn coefficient(key: &str, value: f64, usual: &str) -> Result<(), Trouble> {
    if COEFFICIENTS.contains(&value) {
        return Ok(());
    }
    let (low, high) = (COEFFICIENTS.start(), COEFFICIENTS.end());
    Err(Trouble::new(key, format!("it must lie between {low} and {high}"), usual))
}

/// Errors unless `value` lies within `limits`, far wider than anything that has been computed: within
/// them all scales of a scene are finite numbers.
pub(super) fn sane(
    key: &str,
    value: f64,
    limits: RangeInclusive<f64>,
    unit: &str,
) -> Result<(), Trouble> {
    if limits.contains(&value) {
        return Ok(());
    }
    let problem = format!("it must lie between {:e} and {:e} {unit}", limits.start(), limits.end());
    Err(Trouble::new(key, problem, format!("give it in {unit}, SI units")))
}

/// A number that is beyond `limit`, with so many digits that it can be seen.
pub(super) fn beyond(value: f64, limit: f64) -> String {
    let written = |digits: usize| match value.abs() {
        size if (1e-3..1e4).contains(&size) => format!("{value:.digits$}"),
        _ => format!("{value:.digits$e}"),
    };
    let differs = |text: &String| text.parse::<f64>().is_ok_and(|read| read != limit);
    (3..17).map(written).find(differs).unwrap_or_else(|| format!("{value:?}"))
}

/// What to do about something that falls with the time step: to make that `factor` times as long.
pub(super) fn shorter_step(units: &Units, factor: f64) -> String {
    let si_dt = units.si_dt * factor;
    format!("shorten the time step (`time.dt = {si_dt:.3e}` or less, instead of what sets it now)")
}

/// A whole number above 0.
pub(super) fn count(key: &str, value: i64) -> Result<u64, Trouble> {
    u64::try_from(value).ok().filter(|&count| count > 0).ok_or_else(|| {
        Trouble::new(key, "it must be a whole number of at least 1", "give 1 or more")
    })
}

/// Errors if a key is given where it does not apply.
pub(super) fn absent<T>(key: &str, value: Option<&T>, belongs: &str) -> Result<(), Trouble> {
    match value {
        None => Ok(()),
        Some(_) => Err(Trouble::new(key, format!("it applies to {belongs} only"), "remove it")),
    }
}

/// The value of a key that is needed here.
pub(super) fn needed<T>(
    key: &str,
    value: Option<T>,
    because: &str,
    remedy: &str,
) -> Result<T, Trouble> {
    value.ok_or_else(|| Trouble::new(key, format!("it is missing: {because}"), remedy))
}

/// A duration in whole steps, at least 1.
pub(super) fn steps(key: &str, si_time: f64, si_dt: f64) -> Result<u64, Trouble> {
    positive(key, si_time, "s")?;
    let steps = (si_time / si_dt).round();
    if steps < 1.0 {
        let problem = format!("it is shorter than half a time step ({si_dt:.3e} s)");
        let remedy = format!("give at least one time step: `{key} = {si_dt:.3e}`");
        return Err(Trouble::new(key, problem, remedy));
    }
    let can_be_counted = steps <= MOST_STEPS;
    if !can_be_counted {
        let problem =
            format!("it is {steps:.1e} time steps of {si_dt:.3e} s; {MOST_STEPS:e} is the limit");
        return Err(Trouble::new(key, problem, "give a shorter time"));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e15")]
    let steps = steps as u64;
    Ok(steps)
}
