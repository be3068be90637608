//! Inlets, outlets and mirror planes.

use crate::common;

use common::Budget;
use psmrt_reference::boundary::anti_bounce_back;
use psmrt_reference::collision::Collision;
use psmrt_reference::directions::{C, Q};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::equilibrium::equilibrium;
use psmrt_reference::lattice::{CS2, Populations, Vec3, viscosity};
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

fn along_x(u: f64) -> Vec3 {
    Vec3::new(u, 0.0, 0.0)
}

fn inlet(u: f64) -> Face {
    Face::VelocityInlet { velocity: along_x(u) }
}

const AMBIENT: Face = Face::Pressure { density: 1.0 };

/// Rates with which half-way walls are exact, so that only inlets and outlets are tested.
fn exact_walls(tau: f64) -> Collision {
    Collision::Mrt { rates: Rates::magic(tau, 3.0 / 16.0).unwrap() }
}

fn solver(cells: [usize; 3], faces: Faces, collision: Collision) -> Solver {
    Solver::new(Setup::fluid(Domain::new(cells, faces).unwrap(), collision)).unwrap()
}

#[test]
fn inlet_fills_a_box_with_free_slip_sides_with_a_uniform_stream() {
    let open = Face::NonReflectingPressure { density: 1.0, memory: 100.0 };
    for outlet in [Face::FreeOutflow, AMBIENT, Face::DevelopedPressure { density: 1.0 }, open] {
        let faces = Faces { x: [inlet(0.05), outlet], y: [Face::FreeSlip; 2], ..Faces::PERIODIC };
        let mut solver = solver([12, 3, 2], faces, exact_walls(1.0));
        Budget::oracle(2_200_000).run(&mut solver, 30_000);
        // The start's sound wave has died away; what is left is round-off.
        for u in solver.velocity_field() {
            assert!(
                (u - along_x(0.05)).norm() < 1e-12,
                "velocity of a plug between an inlet of 0.05 and {outlet:?}: {u} instead of (0.05, 0, 0)"
            );
        }
    }
}

#[test]
fn channel_between_inlet_and_pressure_outlet_develops_the_parabola() {
    const H: usize = 8;
    const L: usize = 32;
    let u = 1e-4;
    let faces = Faces { x: [inlet(u), AMBIENT], y: [Face::wall(); 2], ..Faces::PERIODIC };
    let mut solver = solver([L, H, 1], faces, exact_walls(0.8));
    let mut budget = Budget::oracle(6_000_000);
    let middle = |solver: &Solver| solver.velocity_field()[L / 2 + L * (H / 2)].x;
    budget.run_to_steady(&mut solver, 1000, 1e-10, middle);
    let field = solver.velocity_field();
    let profile: Vec<f64> = (0..H).map(|y| field[L / 2 + L * y].x).collect();
    let mean = profile.iter().sum::<f64>() / H as f64;
    // Mass is conserved; the density falls along the channel by 12 nu u L/(H² c_s²) = 1.8e-4, by
    // which the velocity rises.
    assert!((mean / u - 1.0).abs() < 2e-4, "mean velocity {mean:e}");
    // The entrance at Re = 0.008 is forgotten like exp(-4.2 x/H) (Stokes flow): 2e-4 at x = 2 H,
    // where half of the parabola's deviation from the plug is 0.5.
    let exact = |y: usize| {
        let s = (2.0 * (y as f64 + 0.5) - H as f64) / H as f64;
        1.5 * (1.0 - s * s)
    };
    let exact_mean = (0..H).map(exact).sum::<f64>() / H as f64;
    for (y, u_y) in profile.iter().enumerate() {
        assert!(
            (u_y / mean - exact(y) / exact_mean).abs() < 5e-4,
            "velocity over its mean at y = {y}: {}, not that of the parabola: inlet or outlet \
             still bends the profile",
            u_y / mean
        );
    }
}

/// Flow in a channel of `h` cells between two pressures `length` apart: the pressure gradient that
/// drives the measured flux, over the one measured in the middle, and over the one that the faces
/// set. Both are 1 for Poiseuille flow from face to face.
fn driving_gradient(h: usize, length: usize, budget: &mut Budget) -> (f64, f64) {
    let (tau, difference) = (0.8, 2e-5 / h as f64);
    let face = |density| Face::Pressure { density };
    let x = [face(1.0 + 0.5 * difference), face(1.0 - 0.5 * difference)];
    let faces = Faces { x, y: [Face::wall(); 2], ..Faces::PERIODIC };
    let mut solver = solver([length, h, 1], faces, exact_walls(tau));
    let mean = |solver: &Solver| {
        solver.velocity_field().iter().map(|u| u.x).sum::<f64>() / (length * h) as f64
    };
    let mean = budget.run_to_steady(&mut solver, (h * h) as u64 * 2, 1e-9, mean);
    // u_mean = G H²/(12 ν), the cells' midpoint values averaging 1/(2 H²) more
    let h2 = (h * h) as f64;
    let driving = 12.0 * viscosity(tau) * mean / (h2 * (1.0 + 0.5 / h2));
    let rho = solver.density_field();
    let fall = rho[length / 2 - 1 + length * (h / 2)] - rho[length / 2 + length * (h / 2)];
    (driving / (CS2 * fall), driving / (CS2 * difference / length as f64))
}

#[test]
fn two_pressures_drive_poiseuille_flow_but_for_an_end_effect_of_a_twentieth_of_the_width() {
    // A pressure face holds the pressure and, on the diagonal links, lets no shear stress through:
    // like a jet's mouth, not like a cut through an endless channel. The streamlines spread there,
    // which makes each end shorter by a fixed fraction of the width, whatever grid and length.
    let mut budget = Budget::oracle(9_000_000);
    let mut shortening = |h: usize, length: usize| {
        let (in_the_middle, from_end_to_end) = driving_gradient(h, length, &mut budget);
        // The ends are forgotten like exp(-4.2 x/H): 2e-4 at two widths, which is where the middle
        // of the shorter channel lies.
        assert!(
            (in_the_middle - 1.0).abs() < 4e-4,
            "{h} cells wide: the flux needs {in_the_middle} times the pressure gradient found \
             in the middle, in Poiseuille flow 1"
        );
        0.5 * (1.0 - 1.0 / from_end_to_end) * length as f64 / h as f64
    };
    let (coarse, middle, fine) = (shortening(6, 24), shortening(8, 32), shortening(16, 64));
    let long = shortening(8, 64);
    println!("end effect in widths: {coarse} {middle} {fine}, twice as long {long}");
    // Grids of 8 and 16 cells agree to 1 % (second order would leave (1/8)² of it), and so do lengths.
    assert!((middle / fine - 1.0).abs() < 0.016 && (long / middle - 1.0).abs() < 0.01);
    assert!((middle / fine - 1.0).abs() < (coarse / fine - 1.0).abs());
    assert!(
        (0.04..0.06).contains(&fine),
        "the end effect of pressure faces on the fine grid is {fine} of the width, not about a twentieth"
    );
}

#[test]
fn developed_and_non_reflecting_pressure_faces_drive_poiseuille_flow_however_short_the_channel() {
    // Half as long as wide, where plain pressure faces let through 1.28 times as much.
    const H: usize = 8;
    const L: usize = 4;
    let mut budget = Budget::oracle(2_000_000);
    // Two non-reflecting faces give the fluid between them the inertia of 2 c_s T more cells: here as much again.
    let open = |density| Face::NonReflectingPressure { density, memory: 4.0 };
    let developed = |density| Face::DevelopedPressure { density };
    let faces: [fn(f64) -> Face; 2] = [developed, open];
    for (tau, face) in [0.55, 0.8, 2.0].into_iter().flat_map(|tau| faces.map(|face| (tau, face))) {
        let difference = 2e-6;
        let x = [face(1.0 + 0.5 * difference), face(1.0 - 0.5 * difference)];
        let faces = Faces { x, y: [Face::wall(); 2], ..Faces::PERIODIC };
        let mut solver = solver([L, H, 1], faces, exact_walls(tau));
        let mean = |solver: &Solver| {
            solver.velocity_field().iter().map(|u| u.x).sum::<f64>() / (L * H) as f64
        };
        let mean = budget.run_to_steady(&mut solver, (H * H) as u64, 1e-9, mean);
        // u(y) = G/(2 ν) y (H - y),  u_mean = G H²/(12 ν), the cells' midpoint values averaging 1/(2 H²) more
        let g = CS2 * difference / L as f64;
        let nu = viscosity(tau);
        let exact = g * (H * H) as f64 / (12.0 * nu) * (1.0 + 0.5 / (H * H) as f64);
        // Why 1e-5: the density differs by 2e-6 from end to end, and the start has died away to 1e-8.
        assert!(
            (mean / exact - 1.0).abs() < 1e-5,
            "tau = {tau}, {:?}: mean velocity {mean:e} for {exact:e} of Poiseuille's law",
            face(1.0)
        );
        for (cell, u) in solver.velocity_field().iter().enumerate() {
            let y = (cell / L) as f64 + 0.5;
            let parabola = g / (2.0 * nu) * y * (H as f64 - y);
            assert!(
                (u - along_x(parabola)).norm() < 1e-5 * exact,
                "tau = {tau}, {:?}, cell {cell}: {u} for {parabola:e} along x",
                face(1.0)
            );
        }
    }
}

#[test]
fn inlet_with_a_free_outflow_leaves_the_mean_density_free_and_its_drift_is_recorded() {
    let drift = |outlet| {
        let faces = Faces { x: [inlet(0.05), outlet], y: [Face::FreeSlip; 2], ..Faces::PERIODIC };
        let mut solver = solver([12, 2, 1], faces, exact_walls(1.0));
        Budget::oracle(500_000).run(&mut solver, 20_000);
        solver.check_now().unwrap();
        let mean = solver.density_field().iter().sum::<f64>() / 24.0;
        // The same sum in another order.
        assert!((solver.density_drift() - mean).abs() < 1e-14);
        mean - 1.0
    };
    // The sound wave of the start, whose pressure is of the order u/c_s = 9 %, leaves through a
    // free outflow only in part: a few percent stay in the box.
    let free = drift(Face::FreeOutflow);
    assert!(
        free > 0.01,
        "under a free outflow the mean density has drifted by only {free}: has the outlet begun to hold it?"
    );
    // A pressure outlet sets the density to its own, to the round-off of 20,000 steps.
    let held = drift(AMBIENT);
    assert!(
        held.abs() < 1e-3 * free,
        "a pressure outlet lets the mean density drift by {held}: nothing holds the level of the pressure"
    );
}

#[test]
fn closed_box_under_a_body_force_comes_to_rest_in_hydrostatic_balance() {
    let g = 1e-4;
    let walls = [Face::wall(); 2];
    let domain = Domain::new([3, 3, 16], Faces { x: walls, y: walls, z: walls }).unwrap();
    let setup = Setup::fluid(domain, exact_walls(0.8)).with_body_force(Vec3::new(0.0, 0.0, -g));
    let mut solver = Solver::new(setup).unwrap();
    Budget::oracle(3_000_000).run(&mut solver, 20_000);
    let (rho, u) = (solver.density_field(), solver.velocity_field());
    // At rest to round-off of the populations (1e-16 each, gathered over 20,000 steps).
    let largest = u.iter().map(|u| u.norm()).fold(0.0, f64::max);
    assert!(
        largest < 1e-13,
        "fluid at rest in a hydrostatic pressure flows at up to {largest:e} cells a step: the \
         body force and the faces do not balance"
    );
    // c_s² dρ/dz = -g between the nodes, exactly: the lattice's discrete balance. (G is a force per
    // volume, so it does not grow with the density.)
    for z in 1..16 {
        let gradient = CS2 * (rho[9 * z] - rho[9 * (z - 1)]);
        assert!(
            (gradient + g).abs() < 1e-13,
            "pressure gradient at z = {z} plus the body force: {gradient:e} does not balance it"
        );
    }
}

#[test]
fn quarter_of_a_box_between_mirror_planes_has_the_flow_of_the_whole_box() {
    // Whole: y and z run from wall to wall (or moving wall), with a sphere in the middle. Quarter:
    // the same cut by two mirror planes. Inlets, outlets and walls meet the mirrors at edges and
    // corners.
    let sliding = Face::Wall { velocity: along_x(0.03) };
    let fastened = Face::wall();
    let cases = [
        [inlet(0.02), AMBIENT],
        [inlet(0.02), Face::FreeOutflow],
        [Face::Pressure { density: 1.01 }, AMBIENT],
        [Face::DevelopedPressure { density: 1.01 }, Face::DevelopedPressure { density: 1.0 }],
        [inlet(0.02), Face::NonReflectingPressure { density: 1.0, memory: 30.0 }],
        [Face::wall(), Face::wall()],
        [Face::Periodic, Face::Periodic],
    ];
    let mut budget = Budget::oracle(560_000);
    for x in cases {
        let run = |cells, y, z, budget: &mut Budget| -> Vec<Populations> {
            let domain = Domain::new(cells, Faces { x, y, z }).unwrap();
            let sphere = Solid::fixed_sphere(Vec3::new(3.7, 4.0, 5.0), 2.3);
            let phase = SolidPhase { solids: vec![sphere], ..SolidPhase::default() };
            let setup =
                Setup::fluid(domain, Collision::Mrt { rates: Rates::dhumieres(0.7).unwrap() })
                    .with_solids(phase)
                    .with_body_force(along_x(1e-4));
            let mut solver = Solver::new(setup).unwrap();
            budget.run(&mut solver, 100);
            solver.populations().to_vec()
        };
        let whole = run([8, 8, 10], [sliding; 2], [fastened; 2], &mut budget);
        let quarter =
            run([8, 4, 5], [sliding, Face::FreeSlip], [fastened, Face::FreeSlip], &mut budget);
        for z in 0..5 {
            for y in 0..4 {
                for i in 0..8 {
                    let (whole, quarter) =
                        (whole[i + 8 * (y + 8 * z)], quarter[i + 8 * (y + 4 * z)]);
                    let off = common::random::largest_difference(&whole, &quarter);
                    // Round-off of 100 steps; the whole box sums over mirror images in another order.
                    assert!(
                        off < 1e-14,
                        "quarter between mirror planes against the whole box at {i} {y} {z} (x \
                         faces {x:?}): populations differ by {off:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_pressure_face_sends_a_stream_at_equilibrium_back_in_as_it_goes_out() {
    // At equilibrium f_a + f_-a is even in u, and all that the face puts back: any density, any u.
    let (rho, u) = (1.3, Vec3::new(0.05, -0.02, 0.03));
    let f = equilibrium(rho, &u);
    for a in 0..Q {
        let back = anti_bounce_back(&f, a, rho);
        // Why: ten terms of at most 0.5, each rounded.
        assert!(
            (back - f[a]).abs() < 1e-15,
            "anti-bounce-back of an equilibrium at its own density, direction {a}, c = {:?}: \
             {back} instead of {}",
            C[a],
            f[a]
        );
    }
}
