//! What the fluid has given to each solid in a pass over a run of cells.

use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::{Load, Solid};
use pulp::{Simd, WithSimd};

use super::coverage::Coverage;
use super::fields::Seen;
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
    pub(super) of: (&'a Coverage<T>, &'a [Solid]),
    pub(super) run: usize,
    pub(super) first: usize,
    pub(super) seen: &'a Seen<T>,
    /// What the operator takes of the momentum, over `B (j - ρ u_s)`.
    pub(super) gain: f64,
}

impl<T: Real> WithSimd for Receiving<'_, T> {
    type Output = Vec<Received>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<Received> {
        let (coverage, solids) = self.of;
        let mut all = Vec::with_capacity(coverage.parts(self.run).len());
        for part in coverage.parts(self.run) {
            let rigid = Rigid::of(&solids[part.solid]);
            let mut sums = Sums::default();
            for row in coverage.rows(part, self.first) {
                let along = rigid.along(&row.arm);
                for x in (0..row.count).step_by(EIGHT) {
                    let arm = row.arm + Vec3::new(x as f64, 0.0, 0.0);
                    let epsilons = &row.epsilons[x..];
                    let count = (row.count - x).min(EIGHT);
                    sums.add_eight(self.seen, row.start + x, epsilons, count, &arm, &along.from(x));
                }
            }
            all.push(sums.received(part.solid, self.gain));
        }
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
    /// Adds up to eight cells of a row from `at` on, the first of which is at `arm` from the solid's centre.
    #[inline(always)]
    fn add_eight<T: Real>(
        &mut self,
        seen: &Seen<T>,
        at: usize,
        epsilons: &[T],
        count: usize,
        arm: &Vec3,
        along: &Along,
    ) {
        let [excess, jx, jy, jz, share] = &seen.of;
        let (excess, share) = (eight(excess, at), eight(share, at));
        let j = [eight(jx, at), eight(jy, at), eight(jz, at)];
        let epsilons = eight(epsilons, 0);
        let u_s = along.eight();
        for x in 0..EIGHT {
            // B_s = B_t ε_s / Σ ε_s
            let weight = if x < count { share[x] * epsilons[x] } else { 0.0 };
            let rho = 1.0 + excess[x];
            // F_s = -B_s Σ_a Λ_a c_a = B_s (j - ρ u_s)
            let fx = weight * (j[0][x] - rho * u_s[0][x]);
            let fy = weight * (j[1][x] - rho * u_s[1][x]);
            let fz = weight * (j[2][x] - rho * u_s[2][x]);
            let (rx, ry, rz) = (arm.x + x as f64, arm.y, arm.z);
            self.force[0][x] += fx;
            self.force[1][x] += fy;
            self.force[2][x] += fz;
            self.torque[0][x] += ry * fz - rz * fy;
            self.torque[1][x] += rz * fx - rx * fz;
            self.torque[2][x] += rx * fy - ry * fx;
            self.displaced[x] += weight;
        }
    }

    fn received(&self, solid: usize, gain: f64) -> Received {
        let sum = |eight: &[f64; EIGHT]| eight.iter().sum::<f64>();
        let total = |of: &[[f64; EIGHT]; 3]| -> Vec3 { gain * Vec3::from(of.each_ref().map(sum)) };
        let (force, torque) = (total(&self.force), total(&self.torque));
        Received { solid, load: Load { force, torque }, displaced: sum(&self.displaced) }
    }
}

/// Eight numbers from `at` on, in double precision.
#[inline(always)]
fn eight<T: Real>(values: &[T], at: usize) -> [f64; EIGHT] {
    let mut eight = [0.0; EIGHT];
    if let Some(values) = values[at..].first_chunk::<EIGHT>() {
        for x in 0..EIGHT {
            eight[x] = values[x].to_f64();
        }
    }
    eight
}
