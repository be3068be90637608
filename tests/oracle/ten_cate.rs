//! A sphere that settles in a tank, against the experiments of ten Cate et al. (2002).

use crate::common;

use common::Budget;
use common::settling::{Comparison, Experiment, Fall, compare};

#[test]
fn sphere_of_ten_cate_falls_as_measured_at_8_cells_per_diameter() {
    let mut budget = Budget::oracle(76_000_000);
    let experiment = Experiment::named("E4"); // Re 32
    let mut fall = Fall::new(&experiment, 8.0, 0.55);
    let mut path = vec![fall.moment()];
    while path.last().is_some_and(|moment| moment.gap > 0.002) {
        budget.spend(fall.solver.fluid().domain().cell_count() as u64);
        fall.solver.step().unwrap();
        path.push(fall.moment());
    }
    let found @ Comparison { largest, velocity, gap_offset, gap, si_delay, braking } =
        compare(&experiment, &path);
    println!("{found:.4?}");
    // Measured and digitised to about 2 % of the largest velocity; the drag of a sphere of 8 cells at
    // this relaxation time is within 1.5 % (golden/sphere_arrays/study.csv), the velocity at this
    // Reynolds number goes with a power of it less than one. Together below 3 %.
    assert!(
        largest.abs() < 0.03,
        "largest velocity of the settling sphere is {largest} of the measured one off, 3 % is allowed"
    );
    assert!(
        velocity < 0.03,
        "velocities before the last diameter scatter about the measured ones by {velocity}, 3 % is allowed"
    );
    // The first measured gaps are 0.1 to 0.2 diameters too large by themselves, and their time of
    // release is known to a frame of the camera or two (0.02 s is 0.15 diameters): an offset. Without
    // it what is left is the digitising, 0.05 diameters, and the 2 % of velocity over a fall of
    // seven diameters.
    assert!(
        gap_offset.abs() < 0.35,
        "heights are {gap_offset} diameters off the measured ones on average: the release is at another time"
    );
    assert!(gap < 0.15, "heights scatter about the measured ones by {gap} diameters");
    // It brakes at the bottom as measured, later by no more than that offset takes.
    assert!(
        braking < 0.05,
        "velocities near the bottom are {braking} of the largest off the measured ones"
    );
    assert!(
        si_delay < 0.35 * experiment.si_diameter / experiment.si_largest,
        "near the bottom the sphere comes {si_delay} s late, more than the release explains"
    );
}
