//! Values to positions along an axis.

use crate::error::PlotError;
use crate::figure::Axis;
use crate::scale::Scale;

/// The part of an axis that is shown, on the drawn scale: values, or their decimal logarithms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    pub(crate) scale: Scale,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Closer than this, relative to their size, and two values are one.
const RESOLUTION: f64 = 1e-12;

impl Span {
    /// The axis' own range, or one around the values (which must suit the scale).
    pub(crate) fn of(axis: &Axis, values: &[f64]) -> Result<Self, PlotError> {
        let span = match axis.range {
            Some((low, high)) => Self::given(axis, low, high)?,
            None => Self::around(axis.scale, values),
        };
        if (span.high - span.low).is_finite() {
            return Ok(span);
        }
        Err(bad(axis, "its values span more than a 64-bit number can hold".into()))
    }

    fn given(axis: &Axis, low: f64, high: f64) -> Result<Self, PlotError> {
        let log = axis.scale == Scale::Log;
        let range = format!("the range {low:?} to {high:?}");
        if !(low.is_finite() && high.is_finite()) {
            return Err(bad(axis, format!("{range} is not finite")));
        }
        if log && low.min(high) <= 0.0 {
            return Err(bad(axis, format!("{range} is not positive, and the axis is log")));
        }
        if low >= high {
            return Err(bad(axis, format!("{range} is empty; give the smaller value first")));
        }
        let span = Self { scale: axis.scale, low: on(axis.scale, low), high: on(axis.scale, high) };
        if span.is_a_point() {
            return Err(bad(axis, format!("{range} is too narrow to tell its values apart")));
        }
        Ok(span)
    }

    fn around(scale: Scale, values: &[f64]) -> Self {
        let values = || values.iter().map(|v| on(scale, *v));
        let low = values().fold(f64::INFINITY, f64::min);
        let high = values().fold(f64::NEG_INFINITY, f64::max);
        let span = Self { scale, low, high };
        let margin = match (span.is_a_point(), scale) {
            (false, _) => 0.05 * (high - low),
            (true, Scale::Log) => 2.0_f64.log10(), // half and twice the one value
            (true, Scale::Linear) if low == 0.0 => 1.0,
            (true, Scale::Linear) => (0.1 * low.abs()).max(f64::MIN_POSITIVE),
        };
        Self { scale, low: low - margin, high: high + margin }
    }

    fn is_a_point(&self) -> bool {
        self.high - self.low <= RESOLUTION * self.low.abs().max(self.high.abs())
    }

    /// 0 at the low end, 1 at the high end; far outside it stays finite.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        let fraction = (on(self.scale, value) - self.low) / (self.high - self.low);
        fraction.clamp(-1e6, 1e6)
    }

    /// Whether a value lies in the range, ends included.
    pub(crate) fn contains(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.fraction(value))
    }
}

fn on(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        Scale::Log => value.log10(),
    }
}

pub(crate) fn bad(axis: &Axis, reason: String) -> PlotError {
    PlotError::BadAxis { label: axis.label.clone(), reason }
}
