//! Moving walls and mirror planes: Couette flow, plug flow, and a part of a box for the whole.

use crate::common;

use common::Budget;
use common::collisions::{dhumieres, magic, srt};
use psmrt_reference::boundary::bounce_back;
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::{C, OPPOSITE, Q};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::equilibrium::equilibrium;
use psmrt_reference::lattice::{CS2, Vec3, W, c, viscosity};
use psmrt_reference::setup::Setup;
use psmrt_reference::solver::Solver;
use std::f64::consts::PI;

fn unit(axis: usize) -> Vec3 {
    Vec3::from_fn(|i, _| if i == axis { 1.0 } else { 0.0 })
}

fn faces(of_axis: impl Fn(usize) -> [Face; 2]) -> Faces {
    Faces { x: of_axis(0), y: of_axis(1), z: of_axis(2) }
}

/// The smallest number of steps that is not below `time`.
fn steps(time: f64) -> u64 {
    (0_u32..).find(|&steps| f64::from(steps) >= time).unwrap().into()
}

/// Couette flow: `width` cells of fluid of density `rho` across one axis, one wall still, the other
/// (`side` 0: low, 1: high) moving along another axis.
struct Couette {
    width: usize,
    across: usize,
    side: usize,
    along: usize,
    speed: f64,
    rho: f64,
    collision: Collision,
}

impl Couette {
    fn new(speed: f64, rho: f64, collision: Collision) -> Self {
        Couette { width: 6, across: 1, side: 1, along: 0, speed, rho, collision }
    }

    /// Runs from a fluid that moves with a third of the wall's speed to the steady state; the
    /// largest error of the velocity over the speed of the wall.
    fn error(&self, budget: &mut Budget) -> f64 {
        let mut cells = [1; 3];
        cells[self.across] = self.width;
        let velocity = self.speed * unit(self.along);
        let faces = faces(|axis| match (axis == self.across, self.side) {
            (false, _) => [Face::Periodic; 2],
            (true, 0) => [Face::Wall { velocity }, Face::wall()],
            (true, _) => [Face::wall(), Face::Wall { velocity }],
        });
        let setup = Setup::fluid(Domain::new(cells, faces).unwrap(), self.collision);
        let mut solver = Solver::starting_from(setup, |_| (self.rho, velocity / 3.0)).unwrap();
        // The slowest mode falls by e in H²/(π² ν) steps.
        let h = self.width as f64;
        let window = h * h / (PI * PI * viscosity(self.collision.tau()));
        budget.run_to_steady(&mut solver, steps(window), 1e-13, |solver| {
            solver.velocity_field().iter().map(|u| u[self.along]).sum()
        });
        let mass: f64 = solver.density_field().iter().sum();
        // A wall that moves in its own plane lets nothing through: an epsilon of round-off a step
        // (SRT's has one sign in a steady state).
        let round_off = solver.steps() as f64 * f64::EPSILON;
        assert!(
            (mass / (h * self.rho) - 1.0).abs() < round_off,
            "mass between the plates: {mass}, not that of the start: the moving wall makes or takes some"
        );
        let error = |(i, u): (usize, Vec3)| {
            let y = if self.side == 1 { i as f64 + 0.5 } else { h - 0.5 - i as f64 };
            (u / self.speed - y / h * unit(self.along)).norm()
        };
        solver.velocity_field().into_iter().enumerate().map(error).fold(0.0, f64::max)
    }
}

#[test]
fn couette_flow_is_exact_at_any_density_along_any_axis() {
    let mut budget = Budget::oracle(1_200_000);
    let mut worst = 0.0_f64;
    for (across, along) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
        for (side, rho) in [(0, 1.0), (1, 1.0), (0, 1.1), (1, 1.1)] {
            for collision in [srt(0.6), srt(1.5), magic(0.6, 3.0 / 16.0), magic(1.5, 3.0 / 16.0)] {
                let flow = Couette { across, along, side, ..Couette::new(0.1, rho, collision) };
                let error = flow.error(&mut budget);
                worst = worst.max(error);
                // Steady to 1e-13 of the speed; round-off adds less (1e-17 a step on 0.1).
                assert!(error < 1e-12, "{collision:?}, wall {across}, density {rho}: {error:e}");
            }
        }
    }
    println!("worst {worst:.1e}");
}

#[test]
fn couette_flow_with_dhumieres_rates_is_exact_but_for_the_square_of_the_speed() {
    let mut budget = Budget::oracle(160_000);
    // Unequal rates of the even moments let the density follow u² in the few cells beside the moving
    // wall; its wall term takes that density, so that the momentum, still a straight line, is off.
    for tau in [0.55, 0.8, 1.5] {
        let errors = [0.1, 0.05, 0.01].map(|speed| {
            let error = Couette::new(speed, 1.0, dhumieres(tau)).error(&mut budget);
            error / speed.powi(2)
        });
        println!("tau {tau}: error over the square of the speed {errors:.5?}");
        // The next power is u⁴: a hundredth of the error at 0.1.
        assert!(
            (errors[0] / errors[2] - 1.0).abs() < 0.01,
            "tau {tau}: errors {errors:?} at three wall speeds over the square of the speed \
             differ: they are not of second order in it"
        );
        assert!(
            (errors[1] / errors[2] - 1.0).abs() < 0.01,
            "tau {tau}: errors {errors:?} at three wall speeds over the square of the speed \
             differ: they are not of second order in it"
        );
    }
}

#[test]
fn wall_term_takes_the_density_of_the_cell_a_constant_one_would_slow_the_wall_down() {
    let (rho, u_w) = (1.1, Vec3::new(0.05, 0.0, 0.02));
    // A fluid of any density that moves with the wall goes on doing so.
    let f = equilibrium(rho, &u_w);
    for a in (0..Q).filter(|&a| C[a][1] == 1) {
        // Sums of three terms below 0.1.
        assert!(
            (bounce_back(&f, a, &u_w) - f[a]).abs() < 1e-16,
            "direction {a}: a moving wall does not return an equilibrium at its own velocity \
             and density unchanged"
        );
        // With density 1 in its place the term is that of a wall at u_w/1.1: 9% too slow.
        let constant = f[OPPOSITE[a]] + 2.0 * W[a] * c(a).dot(&u_w) / CS2;
        let slow = bounce_back(&f, a, &(u_w / rho));
        assert!(
            (constant - slow).abs() < 1e-16,
            "direction {a}: with density 1 in its place the wall term is not that of a slower wall"
        );
    }
    // And such a wall drags the whole fluid at 1/1.1 of the speed.
    let mut budget = Budget::oracle(10_000);
    let slow = Couette::new(0.1 / rho, rho, srt(0.8));
    assert!(slow.error(&mut budget) < 1e-12, "exact for the slow wall, as above");
}

#[test]
fn plug_flow_between_free_slip_walls_stays_plug_flow() {
    let mut budget = Budget::oracle(110_000);
    for along in 0..3 {
        for collision in [srt(0.6), dhumieres(0.6), magic(0.6, 3.0 / 16.0)] {
            let faces =
                faces(|axis| [if axis == along { Face::Periodic } else { Face::FreeSlip }; 2]);
            let setup = Setup::fluid(Domain::new([3, 4, 5], faces).unwrap(), collision);
            let plug = 0.1 * unit(along);
            let mut solver = Solver::starting_from(setup, |_| (1.1, plug)).unwrap();
            budget.run(&mut solver, 200);
            for u in solver.velocity_field() {
                // 200 steps, each with round-off of 1e-17 in the momentum.
                assert!(
                    (u - plug).norm() < 1e-14,
                    "plug flow along {along} between free-slip faces, {collision:?}: {u:?}: a \
                     face or edge changes it"
                );
            }
        }
    }
}

/// A box with walls across the axes that are `mirrored`, periodic along the others, in which a
/// force drives a flow that starts from a state even about the middle; `part`: only the upper half
/// of each mirrored axis, with a mirror plane in place of the middle.
fn symmetric_box(mirrored: [bool; 3], part: bool, collision: Collision) -> Solver {
    let (half, full) = (4, 8);
    let faces = faces(|axis| match (mirrored[axis], part) {
        (false, _) => [Face::Periodic; 2],
        (true, false) => [Face::wall(); 2],
        (true, true) => [Face::FreeSlip, Face::wall()],
    });
    let cells = mirrored.map(|mirrored| if mirrored && part { half } else { full });
    let force = Vec3::from_fn(|axis, _| if mirrored[axis] { 0.0 } else { 1e-4 });
    let setup = Setup::fluid(Domain::new(cells, faces).unwrap(), collision).with_body_force(force);
    Solver::starting_from(setup, |centre| {
        // Angle from the middle of each axis: even functions of it are mirrored, sines turn over.
        let angle = Vec3::from_fn(|axis, _| {
            let middle = if mirrored[axis] && part { 0.0 } else { half as f64 };
            (centre[axis] - middle) * PI / half as f64
        });
        let even = angle.map(f64::cos);
        let u = Vec3::from_fn(|axis, _| {
            let others = even[(axis + 1) % 3] + 0.5 * even[(axis + 2) % 3];
            0.03 * others * if mirrored[axis] { angle[axis].sin() } else { 1.0 + angle[axis].sin() }
        });
        (1.0 + 0.01 * (even.x + even.y + even.z), u)
    })
    .unwrap()
}

#[test]
fn part_of_a_box_beside_mirror_planes_has_the_flow_of_the_whole() {
    let mut budget = Budget::oracle(150_000);
    for number in 1..8_u8 {
        let mirrored = [1, 2, 4].map(|bit| number & bit != 0);
        let collision = if number % 2 == 0 { srt(0.6) } else { dhumieres(0.6) };
        let mut whole = symmetric_box(mirrored, false, collision);
        let mut part = symmetric_box(mirrored, true, collision);
        budget.run(&mut whole, 30);
        budget.run(&mut part, 30);
        let (u_whole, u_part) = (whole.velocity_field(), part.velocity_field());
        let largest = u_whole.iter().map(|u| u.norm()).fold(0.0, f64::max);
        for (cell, u) in u_part.iter().enumerate() {
            let at = part.domain().coordinates(cell);
            let at = std::array::from_fn(|axis| at[axis] + if mirrored[axis] { 4 } else { 0 });
            // The same sums in another order: round-off of 30 steps, 1e-16 each.
            let difference = (u - u_whole[whole.domain().index(at)]).norm();
            assert!(
                difference < 3e-15,
                "part of a box beside mirror planes {mirrored:?}, at {at:?}: its velocity \
                 differs from that in the whole by {difference:e}"
            );
        }
        println!("mirrored {mirrored:?}: fastest {largest:.1e}");
        assert!(largest > 1e-4, "the flow still moves");
    }
}
