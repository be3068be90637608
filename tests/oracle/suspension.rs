//! Random suspensions settle more slowly than one grain alone.
//!
//! A periodic box holds few grains and adds a correction of its own, 10 to 20 % of the velocity. It is
//! known for each placement of the grains: an independent program sums the far field of the same grains
//! over all images (`golden/suspension/far_field.py`), and of an infinite suspension the same far field
//! has a closed form. What is compared with experiments is the velocity found, times the ratio of the
//! two.

use crate::common;

use common::suspension::Suspension;
use common::{Budget, golden_rows};

/// The exponent of Richardson and Zaki's law `(1 - phi)^n` at small Reynolds numbers: 4.65 by Richardson
/// & Zaki, Trans. Inst. Chem. Eng. 32, 35 (1954), 5.1 by Garside & Al-Dibouni, Ind. Eng. Chem. Process
/// Des. Dev. 16, 206 (1977).
const EXPONENTS: [f64; 2] = [4.65, 5.1];

#[test]
fn random_suspension_settles_as_its_far_field_and_as_richardson_and_zaki_say() {
    let mut budget = Budget::oracle(59_000_000);
    let rows = golden_rows("suspension/far_field.csv");
    let own = rows.iter().filter(|row| &row[0] == "0.1" && &row[1] == "20");
    let mut estimates = Vec::new();
    for (row, seed) in own.zip(1..=3) {
        let [phi, far_field, infinite]: [f64; 3] = [4, 5, 6].map(|i| row[i].parse().unwrap());
        let suspension = Suspension {
            solid_fraction: 0.1,
            grains: 20,
            cells: 6.0,
            tau: 0.7,
            reynolds: 0.05,
            seed,
        };
        let mut settling = suspension.at_rest();
        assert!((settling.solid_fraction - phi).abs() < 1e-6, "the same box as the far field's");
        let steps = settling.steps_to_steady();
        budget.spend(steps * settling.solver.fluid().domain().cell_count() as u64);
        settling.solver.run(steps).unwrap();
        let found = settling.velocity();
        println!("seed {seed}: {found:.4}, far field {far_field}");
        // The placement alone makes 25 % between these three; the far field knows it. It lacks the
        // stresslets, which slow the grains by about 8 % at this solid fraction (0.598 against 0.55 of
        // Hayakawa & Ichiki, Phys. Rev. E 51, R3815 (1995)); grains of 6 cells leak at this relaxation
        // time, which speeds them up by about as much (golden/sphere_arrays/study.csv).
        assert!(
            (found / far_field - 1.0).abs() < 0.08,
            "seed {seed}: settling velocity {found} of one grain's, by the far field of the \
             same grains {far_field}"
        );
        estimates.push((phi, found / far_field * infinite));
    }
    let phi = estimates[0].0;
    let mean = estimates.iter().map(|e| e.1).sum::<f64>() / estimates.len() as f64;
    let [upper, lower] = EXPONENTS.map(|n| (1.0 - phi).powf(n));
    println!("infinite suspension: {mean:.4}, Richardson-Zaki {lower:.4} to {upper:.4}");
    // Between the two exponents, and beyond them by what three placements scatter.
    assert!(
        mean > 0.95 * lower && mean < 1.05 * upper,
        "settling velocity of an infinite suspension {mean}, Richardson and Zaki's law gives \
         {lower} to {upper}"
    );
}
