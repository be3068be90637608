//! Vectors of as many numbers as the processor takes at once, with `+ - *`, so that a formula is written once for
//! single and double precision and for every width.
//!
//! A product and a sum in one go ([`Lanes::mul_add`]) are rounded once on every processor, so a cell comes out with the
//! same bits whatever the width and whichever lane it falls into.

use std::ops::{Add, Mul, Neg, Sub};

use bytemuck::Pod;
use pulp::Simd;

/// A real number in single or double precision.
pub trait Real:
    Pod + Add<Output = Self> + PartialEq + Default + Send + Sync + std::fmt::Debug + 'static
{
    /// The vectors of these numbers.
    type Lanes<S: Simd>: Lanes<Real = Self, Token = S>;

    /// Its precision, as scenes spell it.
    const PRECISION: &'static str;

    /// The nearest number of this precision.
    fn from_f64(value: f64) -> Self;

    /// The same number in double precision.
    fn to_f64(self) -> f64;
}

/// A vector of numbers, one for each of several cells.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// What it is a vector of.
    type Real: Real;
    /// The proof that the processor has the instructions.
    type Token: Simd;
    /// How it lies in memory.
    type Raw: Copy;

    /// How many numbers it has.
    const COUNT: usize;

    /// The same number in all lanes.
    fn splat(token: Self::Token, value: f64) -> Self;

    /// The numbers as vectors, and those that are left over.
    fn split(values: &[Self::Real]) -> (&[Self::Raw], &[Self::Real]);

    /// The same, to be written.
    fn split_mut(values: &mut [Self::Real]) -> (&mut [Self::Raw], &mut [Self::Real]);

    /// From memory.
    fn load(token: Self::Token, raw: Self::Raw) -> Self;

    /// To memory.
    fn raw(self) -> Self::Raw;

    /// From fewer numbers than it has lanes; the others are 0.
    fn load_some(token: Self::Token, values: &[Self::Real]) -> Self;

    /// The first numbers, as many as are asked for.
    fn store_some(self, values: &mut [Self::Real]);

    /// `self * factor + summand`, rounded once.
    fn mul_add(self, factor: Self, summand: Self) -> Self;

    /// `self / divisor`
    fn over(self, divisor: Self) -> Self;

    /// Square roots.
    fn sqrt(self) -> Self;

    /// The smaller number of each lane.
    fn min(self, other: Self) -> Self;

    /// The larger number of each lane.
    fn max(self, other: Self) -> Self;

    /// `yes` where `self <= limit`, else `no`.
    fn at_most(self, limit: Self, yes: Self, no: Self) -> Self;
}

/// Writes out one precision: pulp's functions bear it in their names.
macro_rules! lanes {
    (
        $name:ident, $real:ty, $raw:ident, $precision:literal, $splat:ident, $split:ident, $split_mut:ident,
        $load_some:ident, $store_some:ident, $add:ident, $sub:ident, $mul:ident, $neg:ident, $div:ident,
        $mul_add:ident, $sqrt:ident, $min:ident, $max:ident, $at_most:ident, $select:ident
    ) => {
        /// A vector of numbers of one precision.
        #[derive(Clone, Copy)]
        pub struct $name<S: Simd> {
            token: S,
            raw: S::$raw,
        }

        impl<S: Simd> Add for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self { raw: self.token.$add(self.raw, other.raw), ..self }
            }
        }

        impl<S: Simd> Sub for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self { raw: self.token.$sub(self.raw, other.raw), ..self }
            }
        }

        impl<S: Simd> Mul for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                Self { raw: self.token.$mul(self.raw, other.raw), ..self }
            }
        }

        impl<S: Simd> Neg for $name<S> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { raw: self.token.$neg(self.raw), ..self }
            }
        }

        impl<S: Simd> Lanes for $name<S> {
            type Real = $real;
            type Token = S;
            type Raw = S::$raw;

            const COUNT: usize = size_of::<S::$raw>() / size_of::<$real>();

            #[inline(always)]
            fn splat(token: S, value: f64) -> Self {
                Self { token, raw: token.$splat(<$real>::from_f64(value)) }
            }

            #[inline(always)]
            fn split(values: &[$real]) -> (&[S::$raw], &[$real]) {
                S::$split(values)
            }

            #[inline(always)]
            fn split_mut(values: &mut [$real]) -> (&mut [S::$raw], &mut [$real]) {
                S::$split_mut(values)
            }

            #[inline(always)]
            fn load(token: S, raw: S::$raw) -> Self {
                Self { token, raw }
            }

            #[inline(always)]
            fn raw(self) -> S::$raw {
                self.raw
            }

            #[inline(always)]
            fn load_some(token: S, values: &[$real]) -> Self {
                Self { token, raw: token.$load_some(values) }
            }

            #[inline(always)]
            fn store_some(self, values: &mut [$real]) {
                self.token.$store_some(values, self.raw);
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                Self { raw: self.token.$mul_add(self.raw, factor.raw, summand.raw), ..self }
            }

            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                Self { raw: self.token.$div(self.raw, divisor.raw), ..self }
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                Self { raw: self.token.$sqrt(self.raw), ..self }
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self { raw: self.token.$min(self.raw, other.raw), ..self }
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self { raw: self.token.$max(self.raw, other.raw), ..self }
            }

            #[inline(always)]
            fn at_most(self, limit: Self, yes: Self, no: Self) -> Self {
                let mask = self.token.$at_most(self.raw, limit.raw);
                Self { raw: self.token.$select(mask, yes.raw, no.raw), ..self }
            }
        }

        impl Real for $real {
            type Lanes<S: Simd> = $name<S>;

            const PRECISION: &'static str = $precision;

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "rounding is what it is for")]
            fn from_f64(value: f64) -> Self {
                value as $real
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }
        }
    };
}

lanes!(
    Singles,
    f32,
    f32s,
    "single",
    splat_f32s,
    as_simd_f32s,
    as_mut_simd_f32s,
    partial_load_f32s,
    partial_store_f32s,
    add_f32s,
    sub_f32s,
    mul_f32s,
    neg_f32s,
    div_f32s,
    mul_add_f32s,
    sqrt_f32s,
    min_f32s,
    max_f32s,
    less_than_or_equal_f32s,
    select_f32s
);
lanes!(
    Doubles,
    f64,
    f64s,
    "double",
    splat_f64s,
    as_simd_f64s,
    as_mut_simd_f64s,
    partial_load_f64s,
    partial_store_f64s,
    add_f64s,
    sub_f64s,
    mul_f64s,
    neg_f64s,
    div_f64s,
    mul_add_f64s,
    sqrt_f64s,
    min_f64s,
    max_f64s,
    less_than_or_equal_f64s,
    select_f64s
);
