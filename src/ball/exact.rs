//! Solid fraction of a sphere in a cell, by inclusion and exclusion.
//!
//! The common volume is an alternating sum, over the eight corners of the cell, of the volume that the
//! ball shares with the box between its centre and the corner. Where the corner lies in the ball that
//! is the box; where it does not, it is an eighth of the ball less what lies beyond each of the box's
//! three outer sides, what lies beyond two of them counted once.

use std::f64::consts::PI;

/// Solid fraction, 0 to 1, of the cell `-1/2..1/2`³ in a ball of `radius` cells about `centre`. Its
/// error is a few times `1e-16 (1 + radius³)`, far below the single precision that it is used in.
pub fn solid_fraction(centre: [f64; 3], radius: f64) -> f64 {
    let near = centre.map(|c| (c.abs() - 0.5).max(0.0));
    let far = centre.map(|c| c.abs() + 0.5);
    if square(near) >= radius * radius {
        return 0.0;
    }
    if square(far) <= radius * radius {
        return 1.0;
    }
    let ends = centre.map(|c| [-0.5 - c, 0.5 - c]);
    let mut volume = 0.0;
    for corner in 0..8_usize {
        let at: [f64; 3] = std::array::from_fn(|axis| ends[axis][corner >> axis & 1]);
        // The box from the centre to the corner counts as negative as often as the corner is a lower
        // end or lies below the centre.
        let lower = 3 - corner.count_ones() as usize + at.iter().filter(|x| **x < 0.0).count();
        let part = corner_volume(at.map(f64::abs), radius);
        volume += if lower.is_multiple_of(2) { part } else { -part };
    }
    volume.clamp(0.0, 1.0)
}

fn square([x, y, z]: [f64; 3]) -> f64 {
    x * x + y * y + z * z
}

/// Volume that the ball of radius `a` about the origin shares with the box from there to `corner`, whose
/// components are not negative.
fn corner_volume(corner: [f64; 3], a: f64) -> f64 {
    let [x, y, z] = corner.map(|c| c.min(a));
    if x * x + y * y + z * z <= a * a {
        return x * y * z;
    }
    let beyond_one = quarter_cap(x, a) + quarter_cap(y, a) + quarter_cap(z, a);
    let beyond_two = half_wedge(x, y, a) + half_wedge(y, z, a) + half_wedge(z, x, a);
    // Nothing lies beyond all three: the corner is outside.
    PI * a * a * a / 6.0 - beyond_one + beyond_two
}

/// Volume of the part of an eighth of the ball that lies beyond the plane at distance `x`.
fn quarter_cap(x: f64, a: f64) -> f64 {
    // V = π/12 (a - x)² (2a + x)
    PI / 12.0 * (a - x) * (a - x) * (2.0 * a + x)
}

/// Volume of the part of an eighth of the ball that lies beyond the planes at distances `x` and `y`
/// across two axes.
fn half_wedge(x: f64, y: f64, a: f64) -> f64 {
    let s2 = a * a - x * x - y * y;
    if s2 <= 0.0 {
        return 0.0;
    }
    let s = s2.sqrt();
    // V = ∫∫ √(a² - X² - Y²) dX dY over X > x, Y > y
    //   = x y s/3 - x (3a² - x²)/6 atan(s/y) - y (3a² - y²)/6 atan(s/x) + a³/3 atan(a s/(x y))
    x * y * s / 3.0
        - x * (3.0 * a * a - x * x) / 6.0 * s.atan2(y)
        - y * (3.0 * a * a - y * y) / 6.0 * s.atan2(x)
        + a * a * a / 3.0 * (a * s).atan2(x * y)
}
