//! Density and momentum of the cells of a run before their collision.

use psmrt_reference::directions::Q;
use pulp::{Simd, WithSimd};

use super::collision::Collider;
use super::fields::Seen;
use super::rigid::EIGHT;
use crate::lanes::{Lanes, Real};

/// Density less 1 and momentum of cells, from their populations.
pub(super) struct Sums<'a, T> {
    pub(super) run: &'a [&'a mut [T]; Q],
    pub(super) seen: &'a mut Seen<T>,
}

impl<T: Real> WithSimd for Sums<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, token: S) {
        let mut bodies: [&[<T::Lanes<S> as Lanes>::Raw]; Q] = [&[]; Q];
        let mut tails: [&[T]; Q] = [&[]; Q];
        for a in 0..Q {
            (bodies[a], tails[a]) = <T::Lanes<S> as Lanes>::split(&*self.run[a]);
        }
        let cells = self.run[0].len();
        let [(rho, rho_), (x, x_), (y, y_), (z, z_), _] =
            self.seen.of.each_mut().map(|of| <T::Lanes<S> as Lanes>::split_mut(&mut of[..cells]));
        for i in 0..rho.len() {
            let f: [T::Lanes<S>; Q] = std::array::from_fn(|a| Lanes::load(token, bodies[a][i]));
            let [excess, jx, jy, jz] = Collider::sums(&f);
            (rho[i], x[i], y[i], z[i]) = (excess.raw(), jx.raw(), jy.raw(), jz.raw());
        }
        if !rho_.is_empty() {
            let f: [T::Lanes<S>; Q] = std::array::from_fn(|a| Lanes::load_some(token, tails[a]));
            let [excess, jx, jy, jz] = Collider::sums(&f);
            excess.store_some(rho_);
            jx.store_some(x_);
            jy.store_some(y_);
            jz.store_some(z_);
        }
    }
}

/// Looks at density and momentum of the first `count` cells as a guard would: the square of the largest speed, and
/// whether all densities are positive and all speeds at most `limit`.
pub(super) struct Judging<'a, T> {
    pub(super) seen: &'a Seen<T>,
    pub(super) count: usize,
    pub(super) limit: f64,
}

impl<T: Real> WithSimd for Judging<'_, T> {
    type Output = (f64, bool);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> (f64, bool) {
        let (mut fastest, mut is_fit) = ([0.0_f64; EIGHT], [true; EIGHT]);
        let most = self.limit * self.limit;
        for at in (0..self.count).step_by(EIGHT) {
            let Some([excess, jx, jy, jz, _]) = self.seen.eight(at) else { break };
            // What lies behind the last cell is left from other runs.
            let cells = EIGHT.min(self.count - at);
            for x in 0..EIGHT {
                let [jx, jy, jz] = [jx[x].to_f64(), jy[x].to_f64(), jz[x].to_f64()];
                let rho = 1.0 + excess[x].to_f64();
                let square = (jx * jx + jy * jy + jz * jz) / (rho * rho);
                let counts = x < cells;
                fastest[x] = if counts & (square > fastest[x]) { square } else { fastest[x] };
                is_fit[x] &= !counts | ((rho > 0.0) & (square <= most));
            }
        }
        (fastest.into_iter().fold(0.0, f64::max), is_fit == [true; EIGHT])
    }
}

/// The sum of the numbers in eight interleaved parts: always the same order, and vectors can be used for it.
pub(super) fn sum<T: Real>(values: &[T]) -> f64 {
    let mut parts = [0.0; 8];
    for eight in values.chunks(8) {
        for (part, value) in parts.iter_mut().zip(eight) {
            *part += value.to_f64();
        }
    }
    parts.iter().sum()
}
