//! How solids hold the fluid of their cells before a collision ([`Grip`]): a look at the cells that free solids cover.

use nalgebra::Matrix3;
use psmrt_reference::directions::Q;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Grip, Load, Solid};
use pulp::{Simd, WithSimd};

use super::collision::{Collider, Rules};
use super::fields::{Fields, Seen};
use super::prefetch::{ahead_of, ask_ahead};
use super::rigid::EIGHT;
use crate::lanes::{Lanes, Real};

/// Density and momentum of the covered cells of a run, times `B/Σ ε_s`, and that itself.
pub(super) struct Looking<'a, 'b, T> {
    pub(super) rules: &'a Rules,
    pub(super) run: &'a [&'b mut [T]; Q],
    pub(super) fields: &'a Fields<T>,
    pub(super) seen: &'a mut Seen<T>,
}

impl<T: Real> WithSimd for Looking<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, token: S) {
        let collider = Collider::<T::Lanes<S>>::new(token, self.rules);
        let mut bodies: [&[<T::Lanes<S> as Lanes>::Raw]; Q] = [&[]; Q];
        let mut tails: [&[T]; Q] = [&[]; Q];
        for (a, values) in self.run.iter().enumerate() {
            (bodies[a], tails[a]) = <T::Lanes<S> as Lanes>::split(values);
        }
        let (vectors, rest, lanes) = (bodies[0].len(), tails[0].len(), T::Lanes::<S>::COUNT);
        let cells = vectors * lanes + rest;
        let (epsilons, last_epsilon) = T::Lanes::<S>::split(&self.fields.epsilon[..cells]);
        let [(rho, rho_), (x, x_), (y, y_), (z, z_), (share, share_)] =
            self.seen.of.each_mut().map(|of| <T::Lanes<S> as Lanes>::split_mut(&mut of[..cells]));
        let ahead = ahead_of::<<T::Lanes<S> as Lanes>::Raw>();
        for i in 0..vectors {
            // Of what is far ahead only what will be looked at: the rest need not come from memory.
            if i + ahead < vectors && self.fields.is_covered((i + ahead) * lanes, lanes) {
                for body in &bodies {
                    ask_ahead(body, i);
                }
            }
            if !self.fields.is_covered(i * lanes, lanes) {
                continue;
            }
            let f: [T::Lanes<S>; Q] = std::array::from_fn(|a| Lanes::load(token, bodies[a][i]));
            let now = collider.shared(&f, Lanes::load(token, epsilons[i]));
            (rho[i], x[i], y[i]) = (now[0].raw(), now[1].raw(), now[2].raw());
            (z[i], share[i]) = (now[3].raw(), now[4].raw());
        }
        if rest > 0 && self.fields.is_covered(vectors * lanes, rest) {
            let f: [T::Lanes<S>; Q] = std::array::from_fn(|a| Lanes::load_some(token, tails[a]));
            let now = collider.shared(&f, Lanes::load_some(token, last_epsilon));
            now[0].store_some(rho_);
            now[1].store_some(x_);
            now[2].store_some(y_);
            now[3].store_some(z_);
            now[4].store_some(share_);
        }
    }
}

/// The grip of one solid on one run.
pub(super) struct Held {
    pub(super) solid: usize,
    pub(super) grip: Grip,
}

/// Adds up the grips of the solids on a run that has been looked at.
pub(super) struct Gripping<'a, T> {
    pub(super) fields: &'a Fields<T>,
    pub(super) seen: &'a Seen<T>,
    /// What the operator takes of the momentum, over `B (j - ρ u_s)`.
    pub(super) gain: f64,
}

impl<T: Real> WithSimd for Gripping<'_, T> {
    type Output = Vec<Held>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<Held> {
        let mut all = Vec::new();
        let mut now: Option<(usize, Sums)> = None;
        for (row, eights) in self.fields.rows() {
            if now.as_ref().is_none_or(|(solid, _)| *solid != row.solid) {
                all.extend(now.take().map(|(solid, sums)| sums.held(solid, self.gain)));
                now = Some((row.solid, Sums::default()));
            }
            let Some((_, sums)) = &mut now else { continue };
            for (number, (at, fractions)) in eights.enumerate() {
                let arm = row.arm + Vec3::new((number * EIGHT) as f64, 0.0, 0.0);
                sums.add_eight(self.seen, at, fractions, &arm);
            }
        }
        all.extend(now.map(|(solid, sums)| sums.held(solid, self.gain)));
        all
    }
}

/// Sums over the cells of a part, those of each eighth cell of a row apart; all without the operator's gain.
#[derive(Default)]
struct Sums {
    /// `B j`
    impulse: [[f64; EIGHT]; 3],
    /// `r × B j`
    moment: [[f64; EIGHT]; 3],
    /// `B ρ`
    mass: [f64; EIGHT],
    /// `B ρ r`
    mass_arm: [[f64; EIGHT]; 3],
    /// `B ρ r rᵀ`: xx, yy, zz, xy, xz, yz
    squares: [[f64; EIGHT]; 6],
    /// `B`
    displaced: [f64; EIGHT],
}

impl Sums {
    /// Adds eight cells of a row from `at` on, the first of which is at `arm` from the solid's centre.
    #[inline(always)]
    fn add_eight<T: Real>(
        &mut self,
        seen: &Seen<T>,
        at: usize,
        fractions: &[T; EIGHT],
        arm: &Vec3,
    ) {
        let Some([rho, jx, jy, jz, share]) = seen.eight(at) else { return };
        for x in 0..EIGHT {
            let epsilon = fractions[x].to_f64();
            let (rx, ry, rz) = (arm.x + x as f64, arm.y, arm.z);
            let b_rho = epsilon * rho[x].to_f64();
            let px = epsilon * jx[x].to_f64();
            let py = epsilon * jy[x].to_f64();
            let pz = epsilon * jz[x].to_f64();
            self.impulse[0][x] += px;
            self.impulse[1][x] += py;
            self.impulse[2][x] += pz;
            self.moment[0][x] += ry * pz - rz * py;
            self.moment[1][x] += rz * px - rx * pz;
            self.moment[2][x] += rx * py - ry * px;
            self.mass[x] += b_rho;
            let (sx, sy, sz) = (b_rho * rx, b_rho * ry, b_rho * rz);
            self.mass_arm[0][x] += sx;
            self.mass_arm[1][x] += sy;
            self.mass_arm[2][x] += sz;
            self.squares[0][x] += sx * rx;
            self.squares[1][x] += sy * ry;
            self.squares[2][x] += sz * rz;
            self.squares[3][x] += sx * ry;
            self.squares[4][x] += sx * rz;
            self.squares[5][x] += sy * rz;
            self.displaced[x] += share[x].to_f64() * epsilon;
        }
    }

    fn held(&self, solid: usize, gain: f64) -> Held {
        let sum = |eight: &[f64; EIGHT]| eight.iter().sum::<f64>();
        let total = |of: &[[f64; EIGHT]; 3]| -> Vec3 { gain * Vec3::from(of.each_ref().map(sum)) };
        let [xx, yy, zz, xy, xz, yz] = self.squares.each_ref().map(|of| gain * sum(of));
        // r² I - r rᵀ
        let inertia = Matrix3::new(yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy);
        let grip = Grip {
            impulse: total(&self.impulse),
            moment: total(&self.moment),
            mass: gain * sum(&self.mass),
            mass_arm: total(&self.mass_arm),
            inertia,
            displaced: sum(&self.displaced),
        };
        Held { solid, grip }
    }
}

/// What a solid receives in the collision, and its `Σ B_s`.
pub(super) fn received_by((grip, solid): (&Grip, &Solid)) -> (Load, f64) {
    let (u, w) = (solid.velocity, solid.angular_velocity);
    // F = J - m U - ω × S,  T = L - S × U - Θ ω
    let force = grip.impulse - grip.mass * u - w.cross(&grip.mass_arm);
    let torque = grip.moment - grip.mass_arm.cross(&u) - grip.inertia * w;
    (Load { force, torque }, grip.displaced)
}

/// The grips of each of `solids` solids, added up in the order of the runs.
pub(super) fn added_up(held: &[Vec<Held>], solids: usize) -> Vec<Grip> {
    let mut all = vec![Grip::default(); solids];
    for Held { solid, grip } in held.iter().flatten() {
        let sum = &mut all[*solid];
        sum.impulse += grip.impulse;
        sum.moment += grip.moment;
        sum.mass += grip.mass;
        sum.mass_arm += grip.mass_arm;
        sum.inertia += grip.inertia;
        sum.displaced += grip.displaced;
    }
    all
}
