//! Contacts at one instant.

use super::super::gauged::{Gauged, Gauged3, cross, dot, plus, times};
use super::super::mistakes::Mistake;
use super::super::task::{Contacts, TouchingPair};
use super::constants::vector;
use super::{GaugedAnswers, Model};

/// The part of `v` across the unit vector `n`.
fn across(v: Gauged3, n: Gauged3) -> Gauged3 {
    let along = times(n, dot(v, n));
    std::array::from_fn(|i| v[i] - along[i])
}

/// Length of a vector; its gauge is that of the components.
fn length(v: Gauged3) -> Gauged {
    dot(v, v).sqrt()
}

/// `wanted`, cut down to the length `limit`.
fn limited(wanted: Gauged3, limit: Gauged) -> Gauged3 {
    let size = length(wanted);
    if size.value <= limit.value { wanted } else { times(wanted, limit / size) }
}

impl Model {
    fn contact(&self, pair: &TouchingPair, plane: bool) -> (Gauged3, [Gauged3; 2]) {
        let [r1, r2] = pair.radii.map(Gauged::from);
        let offset = vector(&pair.offset);
        let distance = length(offset);
        let n = offset.map(|component| component / distance);
        let overlap = r1 + r2 - distance;
        let half = overlap * if self.has(Mistake::ArmsAreRadii) { 0.0 } else { 0.5 };
        let arms = match (plane, self.has(Mistake::ArmsAreRadii)) {
            (true, true) => [r1, Gauged::default()],
            (true, false) => [distance, Gauged::default()],
            (false, _) => [r1 - half, r2 - half],
        };
        let spins = pair.motions.map(|motion| vector(&motion.angular_velocity));
        let velocities = pair.motions.map(|motion| vector(&motion.velocity));
        let mut u: Gauged3 = std::array::from_fn(|i| velocities[0][i] - velocities[1][i]);
        if !self.has(Mistake::SlipWithoutSpin) {
            u = plus(u, cross(plus(times(spins[0], arms[0]), times(spins[1], arms[1])), n));
        }
        let dashpot = dot(u, n) * pair.law.damping;
        let dashpot = if self.has(Mistake::ContactDampingSign) { -dashpot } else { dashpot };
        let normal = overlap * pair.law.stiffness + dashpot;
        let normal = if self.has(Mistake::ContactPulls) { normal } else { normal.at_least_zero() };
        let mut force = times(n, -normal);
        if let Some(friction) = pair.law.friction {
            let spring = times(vector(&pair.springs.spring), friction.stiffness.into());
            let wanted = plus(spring, times(across(u, n), friction.damping.into()));
            let limit = normal.at_least_zero() * friction.coefficient;
            let missing = self.has(Mistake::CoulombMissing);
            let tangential = if missing { wanted } else { limited(wanted, limit) };
            force = std::array::from_fn(|i| force[i] - tangential[i]);
        }
        let turn = cross(n, force);
        let sign = if self.has(Mistake::SecondTorqueReversed) { -1.0 } else { 1.0 };
        let mut torques = [times(turn, arms[0]), times(turn, arms[1] * sign)];
        if let Some(rolling) = pair.law.rolling {
            let radius = if plane { r1 } else { r1 * r2 / (r1 + r2) };
            let square = radius * radius;
            let angular_velocity = across(std::array::from_fn(|i| spins[0][i] - spins[1][i]), n);
            let spring = times(vector(&pair.springs.rolling), square * rolling.stiffness);
            let wanted = plus(spring, times(angular_velocity, square * rolling.damping));
            let couple = limited(wanted, radius * normal.at_least_zero() * rolling.coefficient);
            torques[0] = std::array::from_fn(|i| torques[0][i] - couple[i]);
            torques[1] = plus(torques[1], couple);
        }
        (force, torques)
    }

    pub(super) fn contacts(&self, problem: &Contacts) -> GaugedAnswers {
        let contact = |pair| self.contact(pair, problem.plane);
        let (forces, torques): (Vec<Gauged3>, Vec<[Gauged3; 2]>) =
            problem.pairs.iter().map(contact).unzip();
        let n = problem.pairs.len();
        GaugedAnswers::default().with("force", &[n, 3], forces.as_flattened()).with(
            "torque",
            &[n, 2, 3],
            torques.as_flattened().as_flattened(),
        )
    }
}
