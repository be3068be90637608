//! The lattice and its moment space: weights, `M`, its inverse, `S-hat`, the two equilibria.

use crate::common;

use approx::assert_abs_diff_eq;
use common::random::{Random, largest_difference};
use faer::linalg::matmul::matmul;
use psmrt_reference::directions::{C, OPPOSITE, Q};
use psmrt_reference::equilibrium::{equilibrium, equilibrium_moments};
use psmrt_reference::forcing::{source, source_moments};
use psmrt_reference::lattice::{CS2, W, c, density, momentum};
use psmrt_reference::moments::{
    CellMatrix, NAMES, ROW_NORMS, inverse_moment_matrix, moment_matrix, relaxation_matrix,
};
use psmrt_reference::rates::{RateError, Rates};

fn product(left: &faer::Mat<f64>, right: &faer::Mat<f64>) -> faer::Mat<f64> {
    let mut product = faer::Mat::zeros(Q, Q);
    matmul(&mut product, faer::Accum::Replace, left, right, 1.0, faer::Par::Seq);
    product
}

#[test]
fn every_direction_has_its_opposite_and_they_are_the_nineteen_of_d3q19() {
    for a in 0..Q {
        assert_eq!(C[OPPOSITE[a]], C[a].map(|component| -component));
        assert!(C[a].iter().map(|component| component * component).sum::<i32>() <= 2);
        assert_eq!(C.iter().filter(|&&other| other == C[a]).count(), 1, "direction {a} is doubled");
    }
}

#[test]
fn weights_have_the_isotropy_that_navier_stokes_needs() {
    // Σ w = 1, Σ w c_i c_j = c_s² δ_ij, Σ w c_i c_j c_k c_l = c_s⁴ (δδ + δδ + δδ); the sums have 19
    // terms of at most 1/3, so round-off is below 19 eps/3 < 2e-15.
    let delta = |i: usize, j: usize| f64::from(u8::from(i == j));
    assert!((W.iter().sum::<f64>() - 1.0).abs() < 2e-15);
    for i in 0..3 {
        for j in 0..3 {
            let second: f64 = (0..Q).map(|a| W[a] * c(a)[i] * c(a)[j]).sum();
            assert!((second - CS2 * delta(i, j)).abs() < 2e-15);
            for k in 0..3 {
                for l in 0..3 {
                    let fourth: f64 =
                        (0..Q).map(|a| W[a] * c(a)[i] * c(a)[j] * c(a)[k] * c(a)[l]).sum();
                    let isotropic = delta(i, j) * delta(k, l)
                        + delta(i, k) * delta(j, l)
                        + delta(i, l) * delta(j, k);
                    assert!((fourth - CS2 * CS2 * isotropic).abs() < 2e-15);
                }
            }
        }
    }
}

#[test]
fn moment_matrix_is_the_published_one() {
    let rows = common::golden_rows("moments/literature.csv");
    for (a, name) in rows[0].iter().enumerate() {
        let [x, y, z] = C[a];
        assert_eq!(name, format!("c({x} {y} {z})"), "the table is in another direction order");
    }
    let m = moment_matrix();
    for moment in 0..Q {
        for a in 0..Q {
            let published: f64 = rows[moment + 1][a].parse().unwrap();
            assert_eq!(
                m[(moment, a)],
                published,
                "entry of M for {} along {:?} is not the published one",
                NAMES[moment],
                C[a]
            );
        }
    }
}

#[test]
fn rows_of_the_moment_matrix_are_orthogonal_with_the_known_norms() {
    let m = moment_matrix();
    let gram = product(&m, &m.transpose().to_owned());
    for i in 0..Q {
        for j in 0..Q {
            // Integers below 2^53: exact.
            assert_eq!(gram[(i, j)], if i == j { ROW_NORMS[i] } else { 0.0 });
        }
    }
}

#[test]
fn rows_of_the_moment_matrix_are_what_gram_schmidt_makes_of_the_monomials() {
    type Monomial = fn(f64, f64, f64, f64) -> f64; // of x, y, z and c²
    let monomials: [Monomial; Q] = [
        |_, _, _, _| 1.0,
        |_, _, _, c2| c2,
        |_, _, _, c2| c2 * c2,
        |x, _, _, _| x,
        |x, _, _, c2| x * c2,
        |_, y, _, _| y,
        |_, y, _, c2| y * c2,
        |_, _, z, _| z,
        |_, _, z, c2| z * c2,
        |x, _, _, _| x * x,
        |x, _, _, c2| x * x * c2,
        |_, y, z, _| y * y - z * z,
        |_, y, z, c2| (y * y - z * z) * c2,
        |x, y, _, _| x * y,
        |_, y, z, _| y * z,
        |x, _, z, _| x * z,
        |x, y, z, _| x * (y * y - z * z),
        |x, y, z, _| y * (z * z - x * x),
        |x, y, z, _| z * (x * x - y * y),
    ];
    let dot = |u: &[f64; Q], v: &[f64; Q]| -> f64 { (0..Q).map(|a| u[a] * v[a]).sum() };
    let m = moment_matrix();
    let mut basis: Vec<[f64; Q]> = Vec::new();
    for (moment, monomial) in monomials.iter().enumerate() {
        let mut row: [f64; Q] = std::array::from_fn(|a| {
            let c = c(a);
            monomial(c.x, c.y, c.z, c.norm_squared())
        });
        for earlier in &basis {
            let along = dot(&row, earlier);
            row = std::array::from_fn(|a| row[a] - along * earlier[a]);
        }
        let length = dot(&row, &row).sqrt();
        row = row.map(|value| value / length);
        for a in 0..Q {
            // The same up to its length; 19 projections of numbers of order one lose 1e-14 at most.
            let expected = m[(moment, a)] / ROW_NORMS[moment].sqrt();
            assert!(
                (row[a] - expected).abs() < 1e-14,
                "Gram-Schmidt gives another entry of M for {} along {:?}",
                NAMES[moment],
                C[a]
            );
        }
        basis.push(row);
    }
}

#[test]
fn inverse_of_the_moment_matrix_inverts_it_to_round_off() {
    let identity = product(&inverse_moment_matrix(), &moment_matrix());
    for i in 0..Q {
        for j in 0..Q {
            // Entries of M⁻¹ M are sums of 19 terms below one: a few tens of eps.
            assert!((identity[(i, j)] - f64::from(u8::from(i == j))).abs() < 1e-14);
        }
    }
}

#[test]
fn conserved_moments_are_exact() {
    let to_moments = CellMatrix::from_faer(&moment_matrix());
    let mut random = Random(1);
    for _ in 0..100 {
        let f = random.populations();
        let m = to_moments.times(&f);
        let j = momentum(&f);
        // The same sums in the same order: not even round-off differs.
        assert_eq!([m[0], m[3], m[5], m[7]], [density(&f), j.x, j.y, j.z]);
    }
}

#[test]
fn moment_equilibria_are_the_moments_of_the_velocity_equilibria() {
    let to_moments = CellMatrix::from_faer(&moment_matrix());
    let mut random = Random(2);
    for _ in 0..1000 {
        let (rho, u) = (random.between(0.8, 1.2), random.vector(0.3));
        let (m_eq, of_f_eq) =
            (equilibrium_moments(rho, &u), to_moments.times(&equilibrium(rho, &u)));
        let m = moment_matrix();
        for k in 0..Q {
            // Round-off of a sum, over the sum of the absolute terms.
            let f_eq = equilibrium(rho, &u);
            let gauge: f64 = (0..Q).map(|a| (m[(k, a)] * f_eq[a]).abs()).sum();
            assert!(
                (m_eq[k] - of_f_eq[k]).abs() < 8.0 * f64::EPSILON * gauge,
                "equilibrium of the moment {} is not the moment of the equilibrium",
                NAMES[k]
            );
        }
    }
}

#[test]
fn moments_of_the_body_force_are_the_moments_of_guos_source() {
    let to_moments = CellMatrix::from_faer(&moment_matrix());
    let mut random = Random(3);
    for _ in 0..1000 {
        let (u, g) = (random.vector(0.3), random.vector(1.0));
        let (written_out, summed) = (source_moments(&u, &g), to_moments.times(&source(&u, &g)));
        for k in 0..Q {
            // Sums of 19 terms of at most 30 |F_a| <= 30 w 3 (|c| + |u|) |G| < 20.
            assert!(
                (written_out[k] - summed[k]).abs() < 1e-13,
                "body force of the moment {} is not the moment of Guo's source",
                NAMES[k]
            );
        }
    }
}

#[test]
fn s_hat_has_nineteen_entries_and_leaves_the_conserved_moments_alone() {
    let rates = Rates::dhumieres(0.8).unwrap();
    let s_hat = relaxation_matrix(&rates.diagonal());
    let published = common::golden_rows("moments/rates.csv");
    for k in 0..Q {
        assert_eq!(published[k + 1][1].to_string(), NAMES[k]);
        let expected = match &published[k + 1][7] {
            "1/tau" => 1.0 / 0.8,
            number => number.parse::<f64>().unwrap(),
        };
        assert_eq!(s_hat.column_vector()[k], expected, "entry {k} of S-hat, that of {}", NAMES[k]);
    }
}

#[test]
fn magic_rates_hold_their_parameter() {
    for lambda in [1.0 / 12.0, 1.0 / 6.0, 3.0 / 16.0, 0.25] {
        for tau in [0.501, 0.6, 1.0, 3.0] {
            let rates = Rates::magic(tau, lambda).unwrap();
            let product = (1.0 / rates.nu - 0.5) * (1.0 / rates.q - 0.5);
            // 1/s - 1/2 loses digits as tau approaches 1/2: eps/(tau - 1/2) < 3e-13.
            assert!((product - lambda).abs() < 1e-12, "tau = {tau}, Lambda = {lambda}");
            assert_eq!(
                (rates.e, rates.eps, rates.pi, rates.m),
                (rates.nu, rates.nu, rates.nu, rates.q)
            );
        }
    }
}

#[test]
fn rates_outside_zero_to_two_are_refused_by_name() {
    let rates = Rates::dhumieres(0.8).unwrap();
    for value in [0.0, 2.0, -0.1, 2.1, f64::NAN, f64::INFINITY] {
        let message = rates.with("q", value).unwrap_err().to_string();
        assert!(message.contains("s_q") && message.contains("between 0 and 2"), "{message}");
    }
    assert_eq!(rates.with("nu", 1.0), Err(RateError::Stress));
    assert_eq!(rates.with("s9", 1.0), Err(RateError::Unknown { name: "s9".into() }));
    // Each name sets its own rate and no other.
    let changed = |name| rates.with(name, 1.5).unwrap();
    assert_eq!(changed("e"), Rates { e: 1.5, ..rates });
    assert_eq!(changed("eps"), Rates { eps: 1.5, ..rates });
    assert_eq!(changed("q"), Rates { q: 1.5, ..rates });
    assert_eq!(changed("pi"), Rates { pi: 1.5, ..rates });
    assert_eq!(changed("m"), Rates { m: 1.5, ..rates });
    for tau in [0.5, 0.3, f64::NAN, f64::INFINITY] {
        assert!(Rates::srt(tau).is_err() && Rates::dhumieres(tau).is_err());
    }
    for lambda in [0.0, -1.0, f64::NAN] {
        assert!(matches!(Rates::magic(0.8, lambda), Err(RateError::Magic { .. })));
    }
}

#[test]
fn density_and_momentum_of_an_equilibrium_are_those_it_was_made_of() {
    let mut random = Random(4);
    for _ in 0..100 {
        let (rho, u) = (random.between(0.8, 1.2), random.vector(0.3));
        let f = equilibrium(rho, &u);
        // Sums of 19 terms below 1.2: a few eps.
        assert_abs_diff_eq!(density(&f), rho, epsilon = 4e-15);
        assert_abs_diff_eq!(momentum(&f), rho * u, epsilon = 4e-15);
    }
    let still = equilibrium(1.0, &psmrt_reference::lattice::Vec3::zeros());
    assert!(largest_difference(&still, &W) == 0.0);
}
