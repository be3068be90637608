//! How uncertain a result is because its grid is not infinitely fine, by the results of three grids.
//!
//! The grid convergence index (GCI) in the form of Celik, Ghia, Roache, Freitas, Coleman & Raad, J. Fluids Eng. 130,
//! 078001 (2008), which ASME V&V 20 (2009) recommends: with the results φ₁, φ₂, φ₃ from fine to coarse, `h` the cell size,
//! `r₂₁ = h₂/h₁`, `ε₂₁ = φ₂ - φ₁` and so on,
//!
//! ```text
//!   p = |ln|ε₃₂/ε₂₁| + q(p)|/ln r₂₁,   q(p) = ln[(r₂₁^p - s)/(r₃₂^p - s)],   s = sign(ε₃₂/ε₂₁)
//!   φ_ext = (r₂₁^p φ₁ - φ₂)/(r₂₁^p - 1)
//!   GCI = 1.25 |φ₁ - φ₂|/|φ₁|/(r₂₁^p - 1)
//! ```

/// Bounds of the order that the index is taken with: what three grids show beyond the scheme's own order is chance, and
/// an order near 0 would make any result uncertain without end.
const ORDERS: [f64; 2] = [0.5, 2.0];

/// What three grids say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Observed order.
    pub order: f64,
    /// The result of the finest grid.
    pub finest: f64,
    /// Uncertainty of that, relative.
    pub gci: f64,
    /// The result of an infinitely fine grid (Richardson), by the order that the index is taken with.
    pub extrapolated: f64,
}

/// The convergence of results on three or more grids: pairs of cells per length and result, the finest last. `None` if
/// there are fewer than three, or two are the same.
pub fn convergence(grids: &[(f64, f64)]) -> Option<Convergence> {
    let &[.., (n3, third), (n2, second), (n1, finest)] = grids else { return None };
    let (r21, r32) = (n1 / n2, n2 / n3);
    let (e21, e32) = (second - finest, third - second);
    if !(r21 > 1.0 && r32 > 1.0) || e21 == 0.0 || e32 == 0.0 {
        return None;
    }
    let s = (e32 / e21).signum();
    let mut order: f64 = 1.0;
    // A fixed point, found by repetition; it contracts for refinements as these.
    for _ in 0..200 {
        let q = ((r21.powf(order) - s) / (r32.powf(order) - s)).ln();
        let next = ((e32 / e21).abs().ln() + q).abs() / r21.ln();
        order = if next.is_finite() { 0.5 * (order + next.clamp(0.01, 20.0)) } else { 1.0 };
    }
    let used = order.clamp(ORDERS[0], ORDERS[1]);
    let gci = 1.25 * (e21 / finest).abs() / (r21.powf(used) - 1.0);
    // φ_ext = φ₁ - ε₂₁/(r₂₁^p - 1)
    let extrapolated = finest - e21 / (r21.powf(used) - 1.0);
    Some(Convergence { order, finest, gci, extrapolated })
}

#[cfg(test)]
mod tests {
    use super::convergence;

    #[test]
    fn an_error_of_second_order_is_found_to_be_so_on_any_three_grids() {
        let value = |n: f64| (n, 3.0 + 5.0 / (n * n));
        let found = convergence(&[value(8.0), value(12.0), value(20.0)]).unwrap();
        assert!((found.order - 2.0).abs() < 1e-6, "order {}", found.order);
        assert!((found.extrapolated - 3.0).abs() < 1e-9, "{}", found.extrapolated);
        // 1.25 times what is left: φ₁ - 3.
        let left = 5.0 / 400.0 / found.finest;
        assert!((found.gci / left - 1.25).abs() < 1e-6, "{} of {left}", found.gci);
    }

    #[test]
    fn the_example_of_celik_and_others_is_reproduced() {
        // Celik et al. (2008), Table 1, first column: N = 18000, 8000, 4500, r21 = 1.5, r32 = 1.333; dimensionless
        // reattachment length 6.063, 5.972, 5.863: p = 1.53, GCI = 2.2 %.
        let found = convergence(&[(1.0, 5.863), (4.0 / 3.0, 5.972), (2.0, 6.063)]).unwrap();
        assert!((found.order - 1.53).abs() < 0.01, "order {}", found.order);
        assert!((found.gci - 0.022).abs() < 0.0005, "GCI {}", found.gci);
        // The table's φ_ext²¹, 6.1685.
        assert!((found.extrapolated - 6.1685).abs() < 0.002, "{}", found.extrapolated);
    }

    #[test]
    fn results_that_are_the_same_or_too_few_have_no_order() {
        assert_eq!(convergence(&[(1.0, 2.0), (2.0, 1.0)]), None);
        assert_eq!(convergence(&[(1.0, 1.0), (2.0, 1.0), (4.0, 1.0)]), None);
    }
}
