//! Solid fraction of a sphere in a unit cell by another route than the code under test takes:
//! cross-sections, integrated along z.

use psmrt_reference::lattice::Vec3;
use std::f64::consts::PI;

/// Solid fraction by integrating the cross-sections of sphere and cell along z.
pub fn fraction_by_quadrature(centre: &Vec3, radius: f64) -> f64 {
    quadrature_with_step(centre, radius, STEP)
}

/// The same with a step of the caller's.
pub fn quadrature_with_step(centre: &Vec3, radius: f64, step: f64) -> f64 {
    let x = [-0.5 - centre.x, 0.5 - centre.x];
    let y = [-0.5 - centre.y, 0.5 - centre.y];
    let z = [(-0.5 - centre.z).max(-radius), (0.5 - centre.z).min(radius)];
    // The cross-section is smooth in z but where its circle touches a side or passes a corner.
    let mut squares = vec![0.0];
    squares.extend(x.iter().chain(&y).map(|side| side * side));
    squares.extend(x.iter().flat_map(|x| y.iter().map(move |y| x * x + y * y)));
    let heights = squares.iter().map(|square| radius * radius - square);
    let bounds = panels(z, heights);
    let section = |z: f64| circle_and_rectangle((radius * radius - z * z).max(0.0).sqrt(), x, y);
    bounds.windows(2).map(|panel| integral(panel[0], panel[1], step, section)).sum()
}

/// Area that a circle of radius `r` about the origin shares with a rectangle.
fn circle_and_rectangle(r: f64, x: [f64; 2], y: [f64; 2]) -> f64 {
    // ∫ sqrt(r² - x²) dx = [x sqrt(r² - x²) + r² asin(x/r)] / 2
    let half_chord = |x: f64| (r * r - x * x).max(0.0).sqrt();
    let below = |x: f64| 0.5 * (x * half_chord(x) + r * r * (x / r).clamp(-1.0, 1.0).asin());
    let side = [x[0].max(-r), x[1].min(r)];
    let bounds = panels(side, y.iter().map(|y| r * r - y * y));
    let strip = |p: f64, q: f64| {
        let arc = below(q) - below(p);
        let middle = half_chord(0.5 * (p + q));
        // The strip ends at the circle or at the rectangle, whichever comes first.
        let end = |circle: f64, arc: f64| {
            if circle < y[0] {
                y[0] * (q - p)
            } else if circle > y[1] {
                y[1] * (q - p)
            } else {
                arc
            }
        };
        end(middle, arc) - end(-middle, -arc)
    };
    bounds.windows(2).map(|panel| strip(panel[0], panel[1])).sum()
}

/// Ends of an interval, and the square roots, of either sign, that lie within it. Empty where the
/// interval is.
fn panels([low, high]: [f64; 2], squares: impl Iterator<Item = f64>) -> Vec<f64> {
    if low >= high {
        return Vec::new();
    }
    let roots = squares.filter(|&square| square > 0.0).map(f64::sqrt);
    let within = roots.flat_map(|root| [root, -root]).filter(|&root| low < root && root < high);
    let mut bounds: Vec<f64> = within.chain([low, high]).collect();
    bounds.sort_by(f64::total_cmp);
    bounds
}

/// Step of the quadrature in its own variable.
pub const STEP: f64 = 1.0 / 16.0;

/// `∫ f dz` from `p` to `q`; `f` may have any root at either end.
///
/// Source: Takahasi & Mori, Publ. RIMS Kyoto Univ. 9, 721 (1974): tanh-sinh quadrature.
fn integral(p: f64, q: f64, step: f64, f: impl Fn(f64) -> f64) -> f64 {
    // z(t) = (p + q)/2 + (q - p)/2 tanh(π/2 sinh t); beyond |t| = 3.25 the weight is below 1e-16
    let mut t = -3.25;
    let mut sum = 0.0;
    while t <= 3.25 {
        let u = 0.5 * PI * f64::sinh(t);
        let slope = 0.5 * PI * t.cosh() / (u.cosh() * u.cosh());
        sum += step * slope * f(0.5 * (p + q) + 0.5 * (q - p) * u.tanh());
        t += step;
    }
    0.5 * (q - p) * sum
}
