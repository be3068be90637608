//! Where the ticks and grid lines of an axis go.

use crate::decimal::{Decimal, labels};
use crate::figure::Axis;
use crate::scale::Scale;
use crate::span::Span;

/// The grid lines of one axis.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Ticks {
    /// Values with a label.
    pub(crate) major: Vec<(f64, String)>,
    /// Values with a faint line and no label.
    pub(crate) minor: Vec<f64>,
}

impl Ticks {
    /// The ticks of an axis: those that the caller chose, or some `wanted` round ones.
    pub(crate) fn of(axis: &Axis, span: &Span, wanted: f64) -> Self {
        match (&axis.names, &axis.ticks) {
            (Some(names), _) => {
                let values = (1..).map(f64::from).zip(names.iter().cloned());
                Ticks { major: values.collect(), minor: Vec::new() }
            }
            (None, Some(values)) => Self::given(values, span),
            (None, None) => Self::round(span, wanted),
        }
    }

    /// Ticks at values that the caller chose.
    pub(crate) fn given(values: &[f64], span: &Span) -> Self {
        let mut shown: Vec<f64> = values.iter().copied().filter(|v| span.contains(*v)).collect();
        shown.sort_by(f64::total_cmp);
        shown.dedup();
        let shown: Vec<_> = shown.into_iter().map(Decimal::near).collect();
        Self::labelled(&shown, Vec::new())
    }

    /// Ticks at round values, about `wanted` of them.
    pub(crate) fn round(span: &Span, wanted: f64) -> Self {
        match span.scale {
            Scale::Linear => Self::labelled(&steps(span.low, span.high, wanted), Vec::new()),
            Scale::Log => log(span, wanted),
        }
    }

    fn labelled(major: &[Decimal], minor: Vec<Decimal>) -> Self {
        let major = major.iter().map(|t| t.value()).zip(labels(major)).collect();
        Self { major, minor: minor.into_iter().map(Decimal::value).collect() }
    }
}

/// Multiples of 1, 2 or 5 times a power of ten within `low..=high`.
fn steps(low: f64, high: f64, wanted: f64) -> Vec<Decimal> {
    let raw = (high - low) / wanted.max(1.0);
    let power = whole(raw.log10().floor());
    let candidates = [(1, power), (2, power), (5, power), (1, power + 1)];
    let step = candidates
        .map(|(digits, exponent)| Decimal { digits: i64::from(digits), exponent })
        .into_iter()
        .find(|step| step.value() >= raw * (1.0 - 1e-9));
    let Some(step) = step.filter(|step| step.value() > 0.0) else { return Vec::new() };
    let slack = 1e-9;
    let first = whole64((low / step.value() - slack).ceil());
    let last = whole64((high / step.value() + slack).floor());
    let ticks = first..=last.min(first.saturating_add(100));
    ticks.map(|k| Decimal { digits: k * step.digits, exponent: step.exponent }).collect()
}

/// Powers of ten; over short ranges their multiples too.
fn log(span: &Span, wanted: f64) -> Ticks {
    let slack = 1e-9;
    let first = whole((span.low - slack).ceil());
    let last = whole((span.high + slack).floor());
    let inside = |ticks: Vec<Decimal>| -> Vec<Decimal> {
        ticks.into_iter().filter(|t| span.contains(t.value())).collect()
    };
    let multiples = |digits: &[i64]| {
        let powers = first - 1..=last;
        let times = |exponent| digits.iter().map(move |&digits| Decimal { digits, exponent });
        inside(powers.flat_map(times).collect())
    };
    let powers = multiples(&[1]);
    let nine = [1, 2, 3, 4, 5, 6, 7, 8, 9];
    if powers.len() >= 3 {
        let wanted = usize::try_from(whole(wanted.max(2.0))).unwrap_or(2);
        let stride = powers.len().div_ceil(wanted);
        let major: Vec<_> = powers.iter().copied().step_by(stride).collect();
        let minor = match stride {
            1 => multiples(&nine),
            _ if powers.len() <= 50 => powers,
            _ => Vec::new(), // they would run into a grey area
        };
        return Ticks::labelled(&major, minor);
    }
    for digits in [&[1, 2, 5][..], &nine] {
        let major = multiples(digits);
        if major.len() >= 3 {
            return Ticks::labelled(&major, multiples(&nine));
        }
    }
    let (low, high) = (10f64.powf(span.low), 10f64.powf(span.high));
    Ticks::labelled(&inside(steps(low, high, wanted)), Vec::new())
}

/// The integer that a rounded float holds.
#[expect(clippy::cast_possible_truncation, reason = "rounded before; `as` saturates")]
fn whole(value: f64) -> i32 {
    value as i32
}

/// The same, for the digits of a tick.
#[expect(clippy::cast_possible_truncation, reason = "rounded before; `as` saturates")]
fn whole64(value: f64) -> i64 {
    value as i64
}
