//! Whole scenes: collide, stream, move the solids.

use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::domain::Domain;
use psmrt_reference::lattice::{Vec3, viscosity};
use psmrt_reference::rates::Rates;
use psmrt_reference::solids::{Shape, Solid};

use super::super::gauged::{Gauged, Gauged3, cross, given, plus};
use super::super::mistakes::Mistake;
use super::super::task::{Scene, Wanted};
use super::cell::Rules;
use super::constants::{conserved, vector};
use super::{Cell, GaugedAnswers, Model};

/// What a solid covers of a cell: number of the solid, fraction, arm of the nearest image.
type Share = (usize, f64, Vec3);

/// A scene under way.
struct State {
    f: Vec<Cell>,
    solids: Vec<Solid>,
    shares: Vec<Vec<Share>>,
    loads: Vec<(Gauged3, Gauged3)>,
}

impl Model {
    pub(super) fn scene(&self, scene: &Scene) -> GaugedAnswers {
        let domain = &scene.setup.domain;
        let phase = scene.setup.solid_phase.as_ref();
        let rules = Rules {
            collision: self.collision(scene),
            body_force: scene.setup.body_force,
            operator: phase.map(|phase| (phase.operator, phase.weighting)),
        };
        let solids = phase.map_or_else(Vec::new, |phase| phase.solids.clone());
        let mut state = State {
            f: scene.populations.iter().map(|f| given(*f)).collect(),
            shares: self.cover(domain, &solids),
            loads: vec![Default::default(); solids.len()],
            solids,
        };
        for step in 0..scene.steps {
            if step > 0 {
                // Round-off is made anew in each step; that of all steps adds up as a random walk.
                state.f.iter_mut().flatten().for_each(|f| *f = f.as_given());
            }
            self.step(domain, &rules, &mut state);
        }
        let walk = (scene.steps as f64).sqrt();
        state.f.iter_mut().flatten().for_each(|f| f.gauge *= walk);
        for (force, torque) in &mut state.loads {
            force.iter_mut().chain(torque).for_each(|number| number.gauge *= walk);
        }
        let none = GaugedAnswers::default();
        scene
            .wanted
            .iter()
            .fold(none, |answers, wanted| self.observe(scene, &state, wanted, answers))
    }

    /// The collision, with `tau` found from the viscosity where that is given.
    fn collision(&self, scene: &Scene) -> Collision {
        let given = scene.setup.collision;
        if !scene.viscosity_given {
            return given;
        }
        let tau = self.relaxation_time(viscosity(given.tau())).value;
        match given {
            Collision::Srt { .. } => Collision::Srt { tau },
            Collision::Mrt { rates } => Collision::Mrt { rates: Rates { nu: 1.0 / tau, ..rates } },
        }
    }

    fn step(&self, domain: &Domain, rules: &Rules, state: &mut State) {
        if self.has(Mistake::StreamBeforeCollision) {
            state.f = self.stream(domain, &state.f);
            self.collide_all(domain, rules, state);
        } else {
            self.collide_all(domain, rules, state);
            state.f = self.stream(domain, &state.f);
        }
        if state.solids.iter().any(Solid::moves) {
            state.solids.iter_mut().for_each(|solid| solid.centre += solid.velocity);
            if !self.has(Mistake::CoverageNotUpdated) {
                state.shares = self.cover(domain, &state.solids);
            }
        }
    }

    fn collide_all(&self, domain: &Domain, rules: &Rules, state: &mut State) {
        state.loads.fill(Default::default());
        for (cell, f) in state.f.iter_mut().enumerate() {
            let shares = &state.shares[cell];
            let centre = domain.centre(domain.coordinates(cell));
            let raw = |share: &Share| centre - state.solids[share.0].centre;
            let here: Vec<(f64, Gauged3)> = shares
                .iter()
                .map(|share| {
                    let arm = if self.has(Mistake::ArmNotWrapped) { raw(share) } else { share.2 };
                    (share.1, self.velocity_at(&state.solids[share.0], &arm))
                })
                .collect();
            let (post, forces) = self.collide(f, rules, &here);
            *f = post;
            for (share, force) in shares.iter().zip(forces) {
                let arm = match self.mistake {
                    Some(Mistake::ArmNotWrapped | Mistake::TorqueArmNotWrapped) => raw(share),
                    Some(Mistake::TorqueAboutOrigin) => centre,
                    _ => share.2,
                };
                let turn = if self.has(Mistake::TorqueReversed) {
                    cross(force, vector(&arm))
                } else {
                    cross(vector(&arm), force)
                };
                let load = &mut state.loads[share.0];
                *load = (plus(load.0, force), plus(load.1, turn));
            }
        }
    }

    /// Velocity of a solid at `arm` from its centre.
    fn velocity_at(&self, solid: &Solid, arm: &Vec3) -> Gauged3 {
        let (angular_velocity, arm) = (vector(&solid.angular_velocity), vector(arm));
        let turning = match self.mistake {
            Some(Mistake::RotationMissing) => Gauged3::default(),
            Some(Mistake::SpinReversed) => cross(arm, angular_velocity),
            _ => cross(angular_velocity, arm),
        };
        plus(vector(&solid.velocity), turning)
    }

    /// What solids cover, cell by cell.
    fn cover(&self, domain: &Domain, solids: &[Solid]) -> Vec<Vec<Share>> {
        let share = |cell: usize, number: usize| {
            let mut arm = domain.centre(domain.coordinates(cell)) - solids[number].centre;
            let radius = match &solids[number].shape {
                Shape::Sphere { radius } => *radius,
                Shape::Cells { fractions, .. } => {
                    let given = fractions.iter().find(|(place, _)| *place == cell);
                    return given.filter(|given| given.1 > 0.0).map(|given| (number, given.1, arm));
                }
            };
            for axis in (0..3).filter(|&axis| domain.is_periodic(axis)) {
                let length = domain.cells()[axis] as f64;
                arm[axis] -= length * (arm[axis] / length).round();
            }
            let epsilon = self.fraction(&-arm, radius).value;
            (epsilon > 0.0).then_some((number, epsilon, arm))
        };
        let covered = |cell| (0..solids.len()).filter_map(|number| share(cell, number)).collect();
        (0..domain.cell_count()).map(covered).collect()
    }

    /// Adds what is wanted.
    fn observe(
        &self,
        scene: &Scene,
        state: &State,
        wanted: &Wanted,
        answers: GaugedAnswers,
    ) -> GaugedAnswers {
        let [nx, ny, nz] = scene.setup.domain.cells();
        let g = scene.setup.body_force.as_ref().map(vector);
        let velocity = |cell: usize| {
            let (rho, j) = conserved(&state.f[cell]);
            g.map_or_else(|| j[0] / rho, |g| self.forced_velocity(rho, j, g)[0])
        };
        let solids = state.solids.len();
        match wanted {
            Wanted::Populations => {
                answers.with("populations", &[nz, ny, nx, Q], state.f.as_flattened())
            }
            Wanted::Loads => {
                let forces: Vec<Gauged> = state.loads.iter().flat_map(|load| load.0).collect();
                let torques: Vec<Gauged> = state.loads.iter().flat_map(|load| load.1).collect();
                answers.with("force", &[solids, 3], &forces).with("torque", &[solids, 3], &torques)
            }
            Wanted::Profile => {
                let profile: Vec<Gauged> = (0..ny).map(|y| velocity(nx * y)).collect();
                answers.with("velocity_profile", &[ny], &profile)
            }
            Wanted::ShearViscosity { amplitude } => {
                let (k, sines) = scene.shear_wave();
                let sum: Gauged =
                    sines.iter().enumerate().map(|(cell, &sine)| velocity(cell) * sine).sum();
                let now = sum * (2.0 / sines.len() as f64 / amplitude);
                let per_step = -1.0 / (k * k * scene.steps as f64);
                // d ln a = da/a
                let value = now.value.ln() * per_step;
                let gauge = (now.gauge / now.value + now.value.ln().abs()) * per_step.abs();
                answers.with("viscosity", &[], &[Gauged { value, gauge }])
            }
            Wanted::Drag => {
                let drag = state.loads.iter().map(|load| load.0[0]).sum();
                let n = state.f.len();
                let mean = (0..n).map(velocity).sum::<Gauged>() * (1.0 / n as f64);
                answers.with("drag", &[], &[drag]).with("mean_velocity", &[], &[mean])
            }
        }
    }
}
