//! The grains' part of a step in the paper's section 7: 12,000 free grains of 4 cells in a closed box of
//! 160 x 160 x 250 cells, in contacts that last ten steps: `cargo bench -p psmrt-reference --bench grains`.
//! The fluid of that box takes 6.4 million cell updates a step (`step.rs` says how long these take).

use psmrt_reference::coupling::{CouplingSettings, FreeGrains, Gravity};
use psmrt_reference::coverage::{Coverage, CoverageRule};
use psmrt_reference::domain::{Domain, Face, Faces};
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::random::SplitMix64;
use psmrt_reference::grains::setup::GrainSetup;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::solids::Load;

const CELLS: [usize; 3] = [160, 160, 250];
const RADIUS: f64 = 2.0;
const COUNT: usize = 12_000;

fn main() {
    divan::main();
}

fn domain() -> Domain {
    let walls = [Face::wall(); 2];
    Domain::new(CELLS, Faces { x: walls, y: walls, z: walls }).expect("a closed box is valid")
}

/// Grains spread over the lowest `height` cells that sink at the Stokes velocity at tau = 1.
fn grains(height: f64) -> FreeGrains {
    let sinking =
        |place: Vec3| Grain::sphere(place, RADIUS, 2.5).moving(Vec3::new(0.0, 0.0, -1.4e-3));
    let mass = 2.5 * sphere_volume(RADIUS);
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, 0.5 * mass)
        .and_then(|law| law.with_friction(0.5))
        .expect("the law is valid");
    let high = Vec3::new(160.0, 160.0, 250.0);
    let planes = Plane::box_walls(Vec3::zeros(), high, &[0, 1, 2], law);
    let gravity = Some(Gravity::Reduced { acceleration: Vec3::new(0.0, 0.0, -1.7e-4) });
    let settings = CouplingSettings { gravity, ..CouplingSettings::default() };
    let grains = places(height).into_iter().map(sinking).collect();
    FreeGrains::new(&domain(), GrainSetup::new(law), grains, planes, settings).expect("valid")
}

/// Places on a cubic lattice, each off it by as much as lets no two grains overlap.
fn places(height: f64) -> Vec<Vec3> {
    let size = Vec3::new(160.0, 160.0, height);
    let edge = (size.product() / COUNT as f64).cbrt();
    let counts = size.map(|length| (length / edge).ceil());
    let step = size.component_div(&counts);
    let free = step.map(|length| (length - 2.0 * RADIUS).max(0.0));
    let mut random = SplitMix64::new(1);
    let mut places = Vec::new();
    let index = |i: f64| (0..).map(f64::from).take_while(move |&k| k < i);
    for z in index(counts.z) {
        for y in index(counts.y) {
            for x in index(counts.x) {
                let off = Vec3::from_fn(|axis, _| free[axis] * (random.unit() - 0.5));
                places.push(Vec3::new(x + 0.5, y + 0.5, z + 0.5).component_mul(&step) + off);
            }
        }
    }
    places.truncate(COUNT);
    places
}

fn on_threads(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads")
}

/// Loads that hold the grains at their velocity: weight less buoyancy.
fn drag() -> Vec<Load> {
    let force = Vec3::new(0.0, 0.0, 1.5 * sphere_volume(RADIUS) * 1.7e-4);
    vec![Load { force, torque: Vec3::zeros() }; COUNT]
}

/// Contacts and motion, all sub-steps of a step; `height` 250: the whole box, 6.3 % solid; 60: 26 %.
#[divan::bench(args = [(250, 1), (250, 2), (60, 1), (60, 2)])]
fn motion(bencher: divan::Bencher, (height, threads): (u32, usize)) {
    let (mut grains, loads, pool) = (grains(f64::from(height)), drag(), on_threads(threads));
    bencher.bench_local(|| pool.install(|| grains.step(&loads).expect("slow grains")));
}

/// Finding again what all grains cover after they have moved.
#[divan::bench(args = [1, 2])]
fn coverage(bencher: divan::Bencher, threads: usize) {
    let (grains, domain, pool) = (grains(250.0), domain(), on_threads(threads));
    let mut solids = grains.solids();
    let mut coverage = Coverage::new(&domain, &solids, CoverageRule::Exact);
    bencher.bench_local(|| {
        solids.iter_mut().for_each(|solid| solid.centre.z -= 1.4e-3);
        pool.install(|| coverage.update(&domain, &solids, CoverageRule::Exact));
    });
}
