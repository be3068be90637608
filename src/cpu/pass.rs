//! One pass over a run of cells: each vector of populations is read, collided and left in its place.

use psmrt_reference::directions::{OPPOSITE, Q};
use pulp::{Simd, WithSimd};

use super::collision::{Collider, Rules};
use super::fields::{Fields, Seen};
use super::prefetch::ask_ahead;
use crate::lanes::{Lanes, Real};

/// The vectors of numbers of type `T` on a processor with the instructions `S`.
type LanesOf<T, S> = <T as Real>::Lanes<S>;

/// The pass, for whichever instructions the processor has.
pub(super) struct Pass<'a, 'b, T> {
    pub(super) rules: &'a Rules,
    pub(super) run: &'a mut [&'b mut [T]; Q],
    /// What solids cover of the run, if any is there, and where density and momentum of the covered cells are to
    /// be kept, if somebody adds up forces.
    pub(super) solids: Option<(&'a Fields<T>, Option<&'a mut Seen<T>>)>,
}

impl<T: Real> WithSimd for Pass<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, token: S) {
        let collider = Collider::<LanesOf<T, S>>::new(token, self.rules);
        let mut bodies: [&mut [<LanesOf<T, S> as Lanes>::Raw]; Q] = Default::default();
        let mut tails: [&mut [T]; Q] = Default::default();
        for (a, values) in self.run.iter_mut().enumerate() {
            (bodies[a], tails[a]) = LanesOf::<T, S>::split_mut(values);
        }
        let (vectors, rest) = (bodies[0].len(), tails[0].len());
        // All are as long; said so that no index need be checked against each.
        for body in &mut bodies {
            *body = &mut std::mem::take(body)[..vectors];
        }
        match self.solids {
            None => {
                for i in 0..vectors {
                    for body in &bodies {
                        ask_ahead(body, i);
                    }
                    let f: [LanesOf<T, S>; Q] =
                        std::array::from_fn(|a| Lanes::load(token, bodies[a][i]));
                    let post = collider.fluid(&f);
                    for a in 0..Q {
                        bodies[OPPOSITE[a]][i] = post[a].raw();
                    }
                }
                if rest > 0 {
                    let f: [LanesOf<T, S>; Q] =
                        std::array::from_fn(|a| Lanes::load_some(token, tails[a]));
                    let post = collider.fluid(&f);
                    for a in 0..Q {
                        post[a].store_some(tails[OPPOSITE[a]]);
                    }
                }
            }
            Some((fields, mut seen)) => {
                let (lanes, cells) =
                    (LanesOf::<T, S>::COUNT, vectors * LanesOf::<T, S>::COUNT + rest);
                let (epsilons, last_epsilon) = LanesOf::<T, S>::split(&fields.epsilon[..cells]);
                let motion = match fields.motion() {
                    None => None,
                    Some([x, y, z]) => Some([
                        LanesOf::<T, S>::split(&x[..cells]),
                        LanesOf::<T, S>::split(&y[..cells]),
                        LanesOf::<T, S>::split(&z[..cells]),
                    ]),
                };
                // Full bounce-back off a solid at rest leaves each population in the place of the opposite one, where
                // it is already.
                let leaves_filled = self.rules.leaves_filled() && seen.is_none();
                for i in 0..vectors {
                    if leaves_filled && fields.is_filled(i * lanes) {
                        continue;
                    }
                    for body in &bodies {
                        ask_ahead(body, i);
                    }
                    let f: [LanesOf<T, S>; Q] =
                        std::array::from_fn(|a| Lanes::load(token, bodies[a][i]));
                    let post = if fields.is_covered(i * lanes, lanes) {
                        let epsilon = LanesOf::<T, S>::load(token, epsilons[i]);
                        let motion = match motion {
                            None => None,
                            Some([(x, _), (y, _), (z, _)]) => {
                                let sum = [
                                    Lanes::load(token, x[i]),
                                    Lanes::load(token, y[i]),
                                    Lanes::load(token, z[i]),
                                ];
                                Some(sum)
                            }
                        };
                        let (post, now) = collider.saturated(&f, epsilon, motion);
                        if let Some(seen) = &mut seen {
                            for k in 0..5 {
                                LanesOf::<T, S>::split_mut(&mut seen.of[k][..cells]).0[i] =
                                    now[k].raw();
                            }
                        }
                        post
                    } else {
                        collider.fluid(&f)
                    };
                    for a in 0..Q {
                        bodies[OPPOSITE[a]][i] = post[a].raw();
                    }
                }
                if rest > 0 {
                    let f: [LanesOf<T, S>; Q] =
                        std::array::from_fn(|a| Lanes::load_some(token, tails[a]));
                    let post = if fields.is_covered(vectors * lanes, rest) {
                        let epsilon = LanesOf::<T, S>::load_some(token, last_epsilon);
                        let motion = match motion {
                            None => None,
                            Some([(_, x), (_, y), (_, z)]) => {
                                let sum = [
                                    Lanes::load_some(token, x),
                                    Lanes::load_some(token, y),
                                    Lanes::load_some(token, z),
                                ];
                                Some(sum)
                            }
                        };
                        let (post, now) = collider.saturated(&f, epsilon, motion);
                        if let Some(seen) = &mut seen {
                            for k in 0..5 {
                                now[k].store_some(
                                    LanesOf::<T, S>::split_mut(&mut seen.of[k][..cells]).1,
                                );
                            }
                        }
                        post
                    } else {
                        collider.fluid(&f)
                    };
                    for a in 0..Q {
                        post[a].store_some(tails[OPPOSITE[a]]);
                    }
                }
            }
        }
    }
}
