//! Free grains among solids that are none: every engine must tell them apart by what the set-up says, not by their order.

#![allow(dead_code, reason = "each test binary is a crate of its own")]

use std::sync::Arc;

use psmrt::engine::{Coupled, EngineName, starting_from};
use psmrt::kernel::Gpu;
use psmrt::scene::FreePart;
use psmrt_reference::coupling::{CouplingSettings, Gravity};
use psmrt_reference::domain::{Domain, Faces};
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::law::ContactLaw;
use psmrt_reference::grains::setup::{GrainSetup, PeriodicBox};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::setup::{Setup, SolidPhase};
use psmrt_reference::solids::Solid;

use crate::common::Budget;
use crate::common::collisions::dhumieres;

const CELLS: [usize; 3] = [20, 10, 12];
const STEPS: u64 = 60;

/// A belt at the bottom, a fixed sphere, a prescribed one, and two free grains, in this order but for `places`: the
/// number of each in the list.
fn engine(name: EngineName, gpu: Option<&Arc<Gpu>>, places: [usize; 5]) -> Coupled {
    let domain = Domain::new(CELLS, Faces::PERIODIC).unwrap();
    let bottom = (0..20).flat_map(|x| (0..10).map(move |y| [x, y, 0]));
    let fractions = bottom.map(|cell| (domain.index(cell), 0.7)).collect();
    let belt = Solid { velocity: Vec3::new(0.01, 0.0, 0.0), ..Solid::fixed_cells(fractions) };
    let fixed = Solid::fixed_sphere(Vec3::new(3.2, 5.1, 5.9), 1.6);
    let velocity = Vec3::new(0.0, 0.004, 0.0);
    let prescribed = Solid { velocity, ..Solid::fixed_sphere(Vec3::new(9.9, 2.1, 6.2), 1.6) };
    let grain = |at: Vec3, radius| Grain::sphere(at, radius, 2.0);
    let grains = vec![grain(Vec3::new(15.2, 3.3, 5.4), 1.7), grain(Vec3::new(6.3, 8.1, 7.2), 1.4)];
    let as_solid = |grain: &Grain| Solid::fixed_sphere(grain.position, grain.radius);
    let [one, two] = [as_solid(&grains[0]), as_solid(&grains[1])];
    let mut listed: Vec<(usize, Solid)> =
        places.into_iter().zip([belt, fixed, prescribed, one, two]).collect();
    listed.sort_by_key(|(place, _)| *place);
    let solids = listed.into_iter().map(|(_, solid)| solid).collect();
    let setup = Setup::fluid(domain, dhumieres(0.8))
        .with_solids(SolidPhase { solids, ..SolidPhase::default() });
    let law = ContactLaw::from_duration_and_restitution(10.0, 0.5, grains[0].mass).unwrap();
    let sides = PeriodicBox::all(CELLS.map(|n| n as f64));
    let acceleration = Vec3::new(0.0, 0.0, -1e-4);
    let part = FreePart {
        setup: GrainSetup { sides, ..GrainSetup::new(law) },
        grains,
        solids: vec![places[3], places[4]],
        planes: Vec::new(),
        settings: CouplingSettings {
            gravity: Some(Gravity::Reduced { acceleration }),
            ..CouplingSettings::default()
        },
    };
    starting_from(name, &setup, Some(&part), gpu, |_| (1.0, Vec3::zeros())).unwrap()
}

/// The same in another order is the same flow; and what is free moves, what is prescribed goes its way, the rest stays.
/// `rounding`: by how much a velocity may be off.
pub fn grains_among_other_solids_move_the_same_in_whatever_order_they_are_listed(
    name: EngineName,
    gpu: Option<&Arc<Gpu>>,
    budget: &mut Budget,
    rounding: f64,
) {
    let orders = [[0, 1, 2, 3, 4], [4, 3, 2, 1, 0], [1, 3, 4, 0, 2], [2, 0, 3, 4, 1]];
    let [expected, others @ ..] = orders.map(|places| {
        budget.spend(STEPS * CELLS.iter().product::<usize>() as u64);
        let mut engine = engine(name, gpu, places);
        engine.step(STEPS / 2).unwrap();
        // What is saved knows which is which.
        let mut saved = Vec::new();
        engine.save(&mut saved).unwrap();
        let mut engine = self::engine(name, gpu, places);
        engine.load(&mut &saved[..]).unwrap();
        engine.step(STEPS / 2).unwrap();
        let (solids, loads) = (engine.solids(), engine.loads());
        places.map(|place| (solids[place].clone(), loads[place]))
    });
    let [belt, fixed, prescribed, grains @ ..] = &expected;
    assert_eq!((belt.0.centre, fixed.0.centre), (Vec3::zeros(), Vec3::new(3.2, 5.1, 5.9)));
    let way = prescribed.0.centre - Vec3::new(9.9, 2.1, 6.2);
    assert!((way.y - 0.004 * STEPS as f64).abs() < 1e-9, "the prescribed one went {way:?}");
    for (grain, load) in grains {
        // Weight less buoyancy alone makes 6e-3 · (1 - 1/2) of 60 steps of 1e-4.
        assert!(grain.velocity.z < -1e-4, "{grain:?} does not fall");
        assert!(load.force.z > 0.0, "{load:?} does not hold it back");
    }
    for (other, order) in others.iter().zip(&orders[1..]) {
        for ((one, load), (two, other_load)) in expected.iter().zip(other) {
            let off = (one.velocity - two.velocity)
                .norm()
                .max((one.centre - two.centre).norm() / STEPS as f64)
                .max((load.force - other_load.force).norm() * 0.01);
            assert!(off <= rounding, "{order:?}: {two:?} is off {one:?} by {off:e}");
        }
    }
}
