//! Plane Poiseuille flow between half-way bounce-back walls, driven by a body force.
//!
//! The walls are half a cell outside the outermost nodes, so the exact profile in a channel of `H`
//! cells is `u(y) = G y (H - y)/(2 nu)` with nodes at `y = i + 1/2`. What bounce-back makes of it
//! is known in closed form: the same parabola moved by `u_slip = G (16 L - 3)/(24 nu)`.

use crate::common;

use common::collisions::{dhumieres, magic, srt};
use common::{Budget, golden_rows, observed_order};
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::C;
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::lattice::{Vec3, momentum, viscosity};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::Setup;
use psmrt_reference::solver::Solver;
use std::f64::consts::PI;

/// The smallest number of steps that is not below `time`.
fn steps(time: f64) -> u64 {
    (0_u32..).find(|&steps| f64::from(steps) >= time).unwrap().into()
}

/// Two plates and the fluid between them: one cell long, one cell wide, `width` cells across.
struct Channel {
    width: usize,
    /// Axis from wall to wall.
    across: usize,
    /// Axis of the flow.
    along: usize,
    /// Speed that the exact profile has in the middle.
    top_speed: f64,
    collision: Collision,
}

impl Channel {
    fn new(width: usize, top_speed: f64, collision: Collision) -> Self {
        Channel { width, across: 1, along: 0, top_speed, collision }
    }

    fn viscosity(&self) -> f64 {
        viscosity(self.collision.tau())
    }

    fn body_force(&self) -> f64 {
        // u_max = G H²/(8 ν)
        8.0 * self.viscosity() * self.top_speed / (self.width as f64).powi(2)
    }

    /// The exact velocity at the distance `y` from one wall.
    fn exact(&self, y: f64) -> f64 {
        // u = G y (H - y)/(2 ν)
        self.body_force() / (2.0 * self.viscosity()) * y * (self.width as f64 - y)
    }

    /// The steady flow. It starts from the exact profile, which is no gift to a wrong wall: that
    /// would move the flow by most of its error in the first window.
    fn steady(&self, budget: &mut Budget, tolerance: f64) -> Solver {
        let mut cells = [1; 3];
        cells[self.across] = self.width;
        let walls = |axis| if axis == self.across { Face::wall() } else { Face::Periodic };
        let faces = Faces { x: [walls(0); 2], y: [walls(1); 2], z: [walls(2); 2] };
        let mut force = Vec3::zeros();
        force[self.along] = self.body_force();
        let setup = Setup::fluid(Domain::new(cells, faces).unwrap(), self.collision);
        let mut solver = Solver::starting_from(setup.with_body_force(force), |centre| {
            let mut u = Vec3::zeros();
            u[self.along] = self.exact(centre[self.across]);
            (1.0, u)
        })
        .unwrap();
        // The slowest mode of the start falls by e in H²/(π² ν) steps, the rest sooner: once a
        // window of that length changes the mean by `tolerance`, 0.6 `tolerance` is left to go.
        let window = (self.width as f64).powi(2) / (PI * PI * self.viscosity());
        let along = self.along;
        budget.run_to_steady(&mut solver, steps(window), tolerance, |solver| {
            solver.mass_flux_field().iter().map(|j| j[along]).sum()
        });
        solver
    }
}

#[test]
fn error_of_bounce_back_walls_is_second_order_for_srt_and_mrt() {
    let mut budget = Budget::oracle(1_800_000);
    for (name, collision, tau) in [
        ("SRT", srt as fn(f64) -> Collision, 0.8),
        ("SRT", srt, 1.5),
        ("MRT", dhumieres, 0.8),
        ("MRT", dhumieres, 1.5),
    ] {
        let errors = [4, 8, 16, 32].map(|width| {
            // Diffusive scaling: tau stays, the speed falls with the width. The wall's error is
            // 1e-4 of the top speed or more, so 1e-9 leaves 1e-5 of it open.
            let channel = Channel::new(width, 0.4 / width as f64, collision(tau));
            let solver = channel.steady(&mut budget, 1e-9);
            let squares = solver.velocity_field().into_iter().enumerate();
            let squares = squares.map(|(i, u)| (u.x - channel.exact(i as f64 + 0.5)).powi(2));
            (1.0 / width as f64, (squares.sum::<f64>() / width as f64).sqrt() / channel.top_speed)
        });
        let order = observed_order(&errors);
        println!("{name}, tau {tau}: errors {errors:.6?}, order {order:.6}");
        // By the closed form the order is 2 and nothing else; MRT's density follows u², which adds
        // an error of fourth order (u² times the width's own second order).
        assert!((order - 2.0).abs() < 0.01, "{name}, tau {tau}: order {order}");
    }
}

#[test]
fn magic_rates_put_the_wall_exactly_half_way_at_every_tau_along_every_axis() {
    let mut budget = Budget::oracle(2_100_000);
    for tau in [0.505, 0.55, 0.8, 1.5, 3.0] {
        for (across, along) in [(0, 1), (1, 2), (2, 0)] {
            let channel = Channel { across, along, ..Channel::new(7, 0.1, magic(tau, 3.0 / 16.0)) };
            let steady = 1e-13;
            let solver = channel.steady(&mut budget, steady);
            let profile = solver.velocity_field().into_iter().enumerate();
            let error = profile.map(|(i, u)| (u[along] - channel.exact(i as f64 + 0.5)).abs());
            let error = error.fold(0.0, f64::max) / channel.top_speed;
            // Round-off works on the fluid as a body force does. The ten populations with a share in
            // the momentum add up to 1/3, and each of the few sums that make them rounds off up to
            // half an epsilon of it: a force below one epsilon per cell and step, which moves the
            // top speed by epsilon/G of itself. The rest is what was left to go.
            let round_off = f64::EPSILON / channel.body_force();
            println!("tau {tau}, walls across {across}: {error:.1e}, bound {round_off:.1e}");
            assert!(error < round_off + steady, "tau {tau}, walls across axis {across}: {error:e}");
        }
    }
}

/// The collision that a row of the table names, if this oracle has a preset for it.
fn collision_of_row(name: &str, tau: f64) -> Option<Collision> {
    let trt = |name: &str| match name {
        "TRT_3/16" => Some(3.0 / 16.0),
        "TRT_1/4" => Some(1.0 / 4.0),
        "TRT_1/6" => Some(1.0 / 6.0),
        "TRT_1/12" => Some(1.0 / 12.0),
        _ => None,
    };
    match name {
        "SRT" => Some(srt(tau)),
        "MRT_dHumieres_1.19_1.4_1.2_1.98" => Some(dhumieres(tau)),
        "MRT_sq=sm=8(2-sv)/(8-sv)" => {
            let s = 1.0 / tau;
            let odd = 8.0 * (2.0 - s) / (8.0 - s);
            let rates = Rates::dhumieres(tau).unwrap().with("q", odd).unwrap();
            Some(Collision::Mrt { rates: rates.with("m", odd).unwrap() })
        }
        // A misprint: no preset can name it (and here its thirteenth entry plays no part).
        "MRT_paper_printed_S" => None,
        name => Some(magic(tau, trt(name).unwrap_or_else(|| panic!("unknown row {name}")))),
    }
}

/// What decides where the wall is: `L = (L_q + 3 L_m)/4`, `L_k = (tau - 1/2)(1/s_k - 1/2)`.
fn wall_parameter(collision: &Collision) -> f64 {
    let rates = match *collision {
        Collision::Srt { tau } => Rates::srt(tau).unwrap(),
        Collision::Mrt { rates } => rates,
    };
    let l = |s: f64| (rates.tau() - 0.5) * (1.0 / s - 0.5);
    (l(rates.q) + 3.0 * l(rates.m)) / 4.0
}

#[test]
fn wall_slip_follows_the_closed_form_for_every_collision_and_tau() {
    let mut budget = Budget::oracle(8_000_000);
    let rows = golden_rows("poiseuille/bounceback_wall.csv");
    let mut compared = 0;
    for row in rows.iter().skip(1) {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let (tau, name) = (number(0), &row[1]);
        let Some(collision) = collision_of_row(name, tau) else { continue };
        let channel = Channel::new(8, 0.01, collision);
        let solver = channel.steady(&mut budget, 1e-10);
        // The momentum, not the velocity: it is linear in G, whatever MRT's density does at u².
        let flux = solver.mass_flux_field().into_iter().enumerate();
        let slips: Vec<f64> = flux
            .map(|(i, j)| (j.x - channel.exact(i as f64 + 0.5)) / channel.body_force())
            .collect();
        let closed = (16.0 * wall_parameter(&collision) - 3.0) / (24.0 * channel.viscosity());
        // All in units of the top speed over G. Against the closed form: the 1e-10 to which the
        // flow is steady, for any mode slower than the window; a nearby wrong form (3 L_m + L_q
        // swapped) is off by 1e-3.
        let unit = channel.top_speed / channel.body_force();
        for slip in &slips {
            assert!(
                (slip - closed).abs() < 2e-10 * unit,
                "{name}, tau {tau}: {slip}, not {closed}"
            );
        }
        // Against the table: half a unit of its sixth digit, the 1.2e-10 by which its own zeros
        // differ from zero, and ours.
        let (mean, table) = (slips.iter().sum::<f64>() / 8.0, number(3));
        assert!(
            (mean - table).abs() < 5e-6 * table.abs() + 3e-10 * unit,
            "{name}, tau {tau}: {mean}, table {table}"
        );
        // The place of the wall, from (H/2 + offset)² = H²/4 + 2 nu u_slip/G; an error of the
        // slip enters it doubled in these units.
        let offset = (16.0 + 2.0 * channel.viscosity() * mean).sqrt() - 4.0;
        assert!(
            (offset - number(4)).abs() < 5e-6 * number(4).abs() + 1e-9,
            "{name}, tau {tau}: offset of the wall differs from the table of the independent computation"
        );
        compared += 1;
    }
    assert_eq!(compared, 8 * 7, "eight taus and seven collisions");
}

#[test]
fn flux_between_walls_is_the_mean_of_the_momentum_before_and_after_collision() {
    let mut budget = Budget::oracle(20_000);
    // nu = 0.128: half the force is then 1.2% of the mean velocity in eight cells.
    let channel = Channel::new(8, 0.1, magic(0.884, 3.0 / 16.0));
    let (h, nu, g) = (8.0_f64, channel.viscosity(), channel.body_force());
    let mut solver = channel.steady(&mut budget, 1e-13);
    let flux: f64 = solver.mass_flux_field().iter().map(|j| j.x).sum();
    let velocity: f64 = solver.velocity_field().iter().map(|u| u.x).sum();
    let bare: f64 = solver.populations().iter().map(|f| momentum(f).x).sum();
    // What crosses a plane x = const in a step, counted one by one: all that now moves along x and
    // did not come back from a wall (that went half-way out, to the plane, and back).
    budget.run(&mut solver, 1);
    let crossed: f64 = (0..8_usize)
        .flat_map(|y| (0..C.len()).map(move |a| (y, a)))
        .filter(|&(y, a)| y.checked_add_signed(-C[a][1] as isize).is_some_and(|from| from < 8))
        .map(|(y, a)| f64::from(C[a][0]) * solver.populations()[y][a])
        .sum();
    // The exact velocity summed over the nodes.
    let exact = g / (2.0 * nu) * (h.powi(3) / 6.0 + h / 12.0);
    // 1e-12: the flow is steady to 1e-13, and sums of 8 to 80 numbers round off less.
    assert!((flux / exact - 1.0).abs() < 1e-12, "flux {flux}, exact {exact}");
    assert!((velocity / exact - 1.0).abs() < 1e-12, "density 1: the same, {velocity}");
    assert!((crossed / exact - 1.0).abs() < 1e-12, "counted {crossed}, exact {exact}");
    // The bare momentum lacks half the force in each cell: G H/2.
    assert!(((exact - bare) / (g * h / 2.0) - 1.0).abs() < 1e-9, "round-off of the difference");
    assert!(1.0 - bare / exact > 0.0118, "1.2% (6 nu/H², less 0.8% of itself)");
}
