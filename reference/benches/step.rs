//! One step of the oracle in cell updates per second, on one and two threads:
//! `cargo bench -p psmrt-reference`.

use divan::counter::ItemsCount;
use psmrt_reference::collision::Collision;
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::guard::GuardSettings;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::rates::Rates;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;
use psmrt_reference::solver::Solver;

const SIDE: usize = 48;
const TAU: f64 = 0.8;

fn main() {
    divan::main();
}

fn fluid(collision: Collision) -> Setup {
    let domain = Domain::new([SIDE; 3], Faces::PERIODIC).expect("a periodic cube is a valid box");
    Setup::fluid(domain, collision)
}

fn mrt() -> Collision {
    Collision::Mrt { rates: Rates::dhumieres(TAU).expect("tau is valid") }
}

/// Body-centred cubic bed of spheres of 12 cells: a third of the box is solid.
fn bed() -> SolidPhase {
    let edge = 12.0;
    let cells = SIDE / 12;
    let solids = (0..cells * cells * cells)
        .map(|i| {
            let corner = Vec3::new(
                (i % cells) as f64,
                (i / cells % cells) as f64,
                (i / cells / cells) as f64,
            );
            Solid::fixed_sphere(corner.add_scalar(0.5) * edge, 5.1)
        })
        .collect();
    SolidPhase { solids, ..SolidPhase::default() }
}

fn steps(bencher: divan::Bencher, setup: Setup, threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let mut solver =
        Solver::starting_from(setup, |x| (1.0, Vec3::new(0.01 * (0.1 * x.y).sin(), 0.0, 0.0)))
            .expect("the set-up is valid");
    bencher
        .counter(ItemsCount::new(SIDE * SIDE * SIDE))
        .bench_local(|| pool.install(|| solver.step().expect("the flow is slow")));
}

#[divan::bench(args = [1, 2])]
fn srt(bencher: divan::Bencher, threads: usize) {
    steps(bencher, fluid(Collision::Srt { tau: TAU }), threads);
}

#[divan::bench(args = [1, 2])]
fn mrt_fluid(bencher: divan::Bencher, threads: usize) {
    steps(bencher, fluid(mrt()), threads);
}

#[divan::bench(args = [1, 2])]
fn mrt_body_force(bencher: divan::Bencher, threads: usize) {
    let setup = fluid(mrt()).with_body_force(Vec3::new(1e-6, 0.0, 0.0));
    steps(bencher, setup, threads);
}

#[divan::bench(args = [1, 2])]
fn ps_mrt_bed(bencher: divan::Bencher, threads: usize) {
    steps(bencher, fluid(mrt()).with_solids(bed()), threads);
}

#[divan::bench(args = [1, 2])]
fn ps_srt_bed(bencher: divan::Bencher, threads: usize) {
    steps(bencher, fluid(Collision::Srt { tau: TAU }).with_solids(bed()), threads);
}

/// What the guard costs: looking at every step against never looking.
#[divan::bench(args = [1, 16, 1_000_000])]
fn guard_interval(bencher: divan::Bencher, interval: u64) {
    let guard = GuardSettings { interval, ..GuardSettings::default() };
    steps(bencher, Setup { guard, ..fluid(mrt()) }, 1);
}
