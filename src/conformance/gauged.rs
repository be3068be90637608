//! Numbers that carry their gauge: the sum of the absolute terms that make them up.
//!
//! A sum that cancels has a small value and a large gauge; round-off is in proportion to the gauge.
//! Errors of a candidate are therefore measured in its machine epsilon times the gauge, as the testers
//! of reference LAPACK do. Products and quotients carry the excess of their parts over their size to
//! first order.
//!
//! Gauges of whole scenes are those of one step, times the square root of the number of steps.

use std::iter::Sum;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its gauge, which is never below the value's size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gauged {
    /// The value.
    pub value: f64,
    /// Sum of the absolute terms that make it up.
    pub gauge: f64,
}

/// A vector of gauged numbers.
pub type Gauged3 = [Gauged; 3];

impl From<f64> for Gauged {
    /// A given number: its gauge is its size.
    fn from(value: f64) -> Self {
        Gauged { value, gauge: value.abs() }
    }
}

impl Gauged {
    /// By how much the gauge exceeds the value's size.
    fn excess(self) -> f64 {
        self.gauge - self.value.abs()
    }

    /// Square root: d√x = dx/(2 √x).
    pub fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        let excess = if value > 0.0 { self.excess() / (2.0 * value) } else { self.gauge.sqrt() };
        Gauged { value, gauge: value + excess }
    }

    /// The larger of this and zero.
    pub fn at_least_zero(self) -> Self {
        Gauged { value: self.value.max(0.0), gauge: self.gauge }
    }

    /// The same value as if it had been given.
    pub fn as_given(self) -> Self {
        self.value.into()
    }
}

impl Add for Gauged {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Gauged { value: self.value + other.value, gauge: self.gauge + other.gauge }
    }
}

impl Sub for Gauged {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Gauged {
    type Output = Self;
    fn neg(self) -> Self {
        Gauged { value: -self.value, gauge: self.gauge }
    }
}

impl Mul for Gauged {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // d(x y) = x dy + y dx
        let value = self.value * other.value;
        let excess = self.value.abs() * other.excess() + other.value.abs() * self.excess();
        Gauged { value, gauge: value.abs() + excess }
    }
}

impl Mul<f64> for Gauged {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        Gauged { value: self.value * other, gauge: self.gauge * other.abs() }
    }
}

impl Div for Gauged {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        // d(x/y) = dx/y - (x/y) dy/y
        let value = self.value / other.value;
        let excess = (self.excess() + value.abs() * other.excess()) / other.value.abs();
        Gauged { value, gauge: value.abs() + excess }
    }
}

impl Sum for Gauged {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Gauged::default(), Add::add)
    }
}

/// Given numbers.
pub fn given<const N: usize>(values: [f64; N]) -> [Gauged; N] {
    values.map(Gauged::from)
}

/// Scalar product.
pub fn dot(a: Gauged3, b: Gauged3) -> Gauged {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
pub fn cross(a: Gauged3, b: Gauged3) -> Gauged3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Sum of two vectors or sets of values.
pub fn plus<const N: usize>(a: [Gauged; N], b: [Gauged; N]) -> [Gauged; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// A vector or set of values times a number.
pub fn times<const N: usize>(a: [Gauged; N], factor: Gauged) -> [Gauged; N] {
    a.map(|value| value * factor)
}
