//! What the fluid has given to each solid in a pass over a run of cells.

use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Load, Solid};
use pulp::{Simd, WithSimd};

use super::fields::{Fields, Seen};
use super::rigid::{Along, EIGHT, Rigid};
use crate::lanes::Real;

/// What one solid has received in one run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Received {
    pub(super) solid: usize,
    pub(super) load: Load,
    /// `Σ B_s`
    pub(super) displaced: f64,
}

/// Adds up what each solid has received, part by part.
pub(super) struct Receiving<'a, T> {
    pub(super) fields: &'a Fields<T>,
    pub(super) solids: &'a [Solid],
    pub(super) seen: &'a Seen<T>,
    /// What the operator takes of the momentum, over `B (j - ρ u_s)`.
    pub(super) gain: f64,
}

impl<T: Real> WithSimd for Receiving<'_, T> {
    type Output = Vec<Received>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<Received> {
        let mut all = Vec::new();
        let mut now: Option<(usize, Rigid, Sums)> = None;
        for (row, eights) in self.fields.rows() {
            if now.as_ref().is_none_or(|(solid, ..)| *solid != row.solid) {
                all.extend(now.take().map(|(solid, _, sums)| sums.received(solid, self.gain)));
                now = Some((row.solid, Rigid::of(&self.solids[row.solid]), Sums::default()));
            }
            let Some((_, rigid, sums)) = &mut now else { continue };
            let along = rigid.along(&row.arm);
            for (number, (at, fractions)) in eights.enumerate() {
                let x = number * EIGHT;
                let arm = row.arm + Vec3::new(x as f64, 0.0, 0.0);
                sums.add_eight(self.seen, at, fractions, &arm, &along.from(x));
            }
        }
        all.extend(now.map(|(solid, _, sums)| sums.received(solid, self.gain)));
        all
    }
}

/// Sums of force, torque and `B_s` over the cells of a part, those of each eighth cell of a row apart.
#[derive(Default)]
struct Sums {
    force: [[f64; EIGHT]; 3],
    torque: [[f64; EIGHT]; 3],
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
        along: &Along,
    ) {
        let Some([rho, jx, jy, jz, share]) = seen.eight(at) else { return };
        let u_s = along.eight();
        for x in 0..EIGHT {
            let (epsilon, rho) = (fractions[x].to_f64(), rho[x].to_f64());
            // F_s = -B_s Σ_a Λ_a c_a = B_s (j - ρ u_s), B_s = B_t ε_s / Σ ε_s
            let fx = epsilon * (jx[x].to_f64() - rho * u_s[0][x]);
            let fy = epsilon * (jy[x].to_f64() - rho * u_s[1][x]);
            let fz = epsilon * (jz[x].to_f64() - rho * u_s[2][x]);
            let (rx, ry, rz) = (arm.x + x as f64, arm.y, arm.z);
            self.force[0][x] += fx;
            self.force[1][x] += fy;
            self.force[2][x] += fz;
            self.torque[0][x] += ry * fz - rz * fy;
            self.torque[1][x] += rz * fx - rx * fz;
            self.torque[2][x] += rx * fy - ry * fx;
            self.displaced[x] += share[x].to_f64() * epsilon;
        }
    }

    fn received(&self, solid: usize, gain: f64) -> Received {
        let sum = |eight: &[f64; EIGHT]| eight.iter().sum::<f64>();
        let total = |of: &[[f64; EIGHT]; 3]| -> Vec3 { gain * Vec3::from(of.each_ref().map(sum)) };
        let (force, torque) = (total(&self.force), total(&self.torque));
        Received { solid, load: Load { force, torque }, displaced: sum(&self.displaced) }
    }
}
