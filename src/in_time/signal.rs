//! A value as a function of time.

use std::f64::consts::TAU;
use std::ops::{Add, Mul, Sub};

/// A value as a function of time.
#[derive(Clone, Debug, PartialEq)]
pub enum Signal<T> {
    /// Always the same.
    Constant(T),
    /// Linear between rows of time and value, whose times do not fall. Where two rows have the same time it jumps: from
    /// then on it has the second value. Before the first row it has that row's value, after the last that one's. There
    /// is at least one row.
    Table(Vec<(f64, T)>),
    /// `mean + amplitude sin(2π t/period + phase)`
    Sine {
        /// Mean.
        mean: T,
        /// Amplitude.
        amplitude: T,
        /// Period.
        period: f64,
        /// Phase, radians.
        phase: f64,
    },
}

impl<T> Signal<T>
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    /// The value at a time.
    pub fn at(&self, time: f64) -> T {
        match self {
            Signal::Constant(value) => *value,
            Signal::Table(rows) => {
                let after = rows.partition_point(|&(row, _)| row <= time);
                match (after.checked_sub(1).map(|before| rows[before]), rows.get(after)) {
                    (Some((t0, from)), Some(&(t1, to))) => {
                        // from + (to - from)(t - t₀)/(t₁ - t₀)
                        from + (to - from) * ((time - t0) / (t1 - t0))
                    }
                    (Some((_, value)), None) | (None, Some(&(_, value))) => value,
                    (None, None) => unreachable!("a table has a row"),
                }
            }
            Signal::Sine { mean, amplitude, period, phase } => {
                *mean + *amplitude * (TAU * (time / period) + phase).sin()
            }
        }
    }

    /// Values between which all others lie, on the straight lines from one to the next: what holds for them and is
    /// convex, holds at all times.
    pub fn corners(&self) -> Vec<T> {
        match self {
            Signal::Constant(value) => vec![*value],
            Signal::Table(rows) => rows.iter().map(|&(_, value)| value).collect(),
            Signal::Sine { mean, amplitude, .. } => vec![*mean + *amplitude, *mean - *amplitude],
        }
    }

    /// The corner that is largest by `size`.
    pub fn largest(&self, size: impl Fn(&T) -> f64) -> T {
        let corners = self.corners();
        corners.iter().skip(1).fold(corners[0], |most, corner| {
            if size(corner) > size(&most) { *corner } else { most }
        })
    }

    /// Whether it changes at all.
    pub fn varies(&self) -> bool {
        !matches!(self, Signal::Constant(_))
    }

    /// The time from which on it stays as it is; infinite if there is none.
    pub fn end(&self) -> f64 {
        match self {
            Signal::Constant(_) => f64::NEG_INFINITY,
            Signal::Table(rows) => rows.last().map_or(f64::NEG_INFINITY, |&(time, _)| time),
            Signal::Sine { .. } => f64::INFINITY,
        }
    }
}
