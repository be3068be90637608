//! Grain sizes by a sieve curve: how much of the mass is finer than each of some diameters.

use psmrt_reference::grains::grain::sphere_volume;
use psmrt_reference::grains::random::SplitMix64;

use super::Amount;

/// Sieves of the curve that stands for a log-normal distribution, and how many standard deviations it reaches to either side:
/// beyond lies 0.3 % of the mass.
const SIEVES: i32 = 60;
const DEVIATIONS: f64 = 3.0;

/// Diameters further apart are no mixture that could be computed.
const WIDEST: f64 = 1e3;

/// How far the diameters of the grains may be off the curve.
pub const FOLLOWS: f64 = 0.02;

/// A sieve curve. Between two sieves the mass is evenly distributed over the logarithm of the diameter, a straight line on the
/// paper on which sieve curves are drawn; where two have the same diameter, that part of the mass has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Grading {
    /// Diameter, and the share of the mass that is finer; both rise, the share from 0 to 1.
    points: Vec<(f64, f64)>,
}

impl Grading {
    /// From diameters and the shares of the mass that are finer. Errors, in words, unless they make a curve.
    pub fn new(points: &[(f64, f64)]) -> Result<Self, String> {
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Err("it has no sieves".to_owned());
        };
        if let Some((diameter, _)) = points.iter().find(|(d, _)| !(*d > 0.0 && d.is_finite())) {
            return Err(format!("a diameter of {diameter:e} m is not above 0 and finite"));
        }
        if first.1 != 0.0 || last.1 != 1.0 {
            return Err(format!(
                "the share that is finer goes from {} to {}; it must go from 0 to 1",
                first.1, last.1
            ));
        }
        let falls = |pair: &&[(f64, f64)]| !(pair[0].0 <= pair[1].0 && pair[0].1 <= pair[1].1);
        if let Some(pair) = points.windows(2).find(falls) {
            return Err(format!(
                "{:e} m, {} comes after {:e} m, {}: diameters and shares must not fall",
                pair[1].0, pair[1].1, pair[0].0, pair[0].1
            ));
        }
        // Sieves that nothing stays on, and finer ones than any grain.
        let first = points.iter().rposition(|(_, finer)| *finer == 0.0).unwrap_or(0);
        let last = points.iter().position(|(_, finer)| *finer == 1.0).unwrap_or(points.len() - 1);
        let points = points[first..=last].to_vec();
        let [(low, _), .., (high, _)] = points[..] else {
            return Err("all of it has one diameter: use `diameter`".to_owned());
        };
        if high / low > WIDEST {
            return Err(format!(
                "its diameters go from {low:e} to {high:e} m; a factor of {WIDEST} is the limit"
            ));
        }
        Ok(Grading { points })
    }

    /// A log-normal distribution of the mass: its median diameter, and the factor of one standard deviation. Errors unless the
    /// median is positive and the factor above 1.
    pub fn log_normal(median: f64, deviation: f64) -> Result<Self, String> {
        if !(deviation > 1.0 && deviation.is_finite()) {
            return Err(format!(
                "the factor of one standard deviation is {deviation}; it must be above 1"
            ));
        }
        let edges: Vec<(f64, f64)> = (0..=SIEVES)
            .map(|sieve| {
                let z = DEVIATIONS * (2.0 * f64::from(sieve) / f64::from(SIEVES) - 1.0);
                (median * deviation.powf(z), normal(z))
            })
            .collect();
        let [low, high] = [-DEVIATIONS, DEVIATIONS].map(normal);
        let share = |(d, share): (f64, f64)| (d, ((share - low) / (high - low)).clamp(0.0, 1.0));
        let points: Vec<(f64, f64)> = edges.into_iter().map(share).collect();
        Self::new(&points)
    }

    /// Smallest and largest diameter.
    pub fn diameters(&self) -> [f64; 2] {
        [self.points[0].0, self.points[self.points.len() - 1].0]
    }

    /// Grains per mass of each part between two sieves, in units of spheres of diameter 1.
    fn counts(&self) -> Vec<f64> {
        let part = |pair: &[(f64, f64)]| {
            let (mass, [low, high]) = (pair[1].1 - pair[0].1, [pair[0].0, pair[1].0]);
            // dm/d(ln d) = const, dn = dm/d³:  n = m (low⁻³ - high⁻³)/(3 ln(high/low))
            match (high / low).ln() {
                log if log > 1e-9 => mass * (low.powi(-3) - high.powi(-3)) / (3.0 * log),
                _ => mass * low.powi(-3),
            }
        };
        self.points.windows(2).map(part).collect()
    }

    /// The diameter than which the share `number` of all grains, by number, is finer.
    fn diameter(&self, counts: &[f64], number: f64) -> f64 {
        let mut left = number * counts.iter().sum::<f64>();
        let last = counts.len() - 1;
        for (part, &count) in counts.iter().enumerate() {
            if left <= count || part == last {
                let [low, high] = [self.points[part].0, self.points[part + 1].0];
                // n ∝ low⁻³ - d⁻³ within the part
                let share = (left / count).clamp(0.0, 1.0);
                return (low.powi(-3) + share * (high.powi(-3) - low.powi(-3))).powf(-1.0 / 3.0);
            }
            left -= count;
        }
        self.points[last + 1].0
    }

    /// Radii in no order; `None` if there would be none, or too many. One grain is taken from each of as many equal parts of the
    /// curve by number, so that few already follow it. Of a volume all are scaled a little, so that they have it. With the
    /// factor by which their diameters are off the curve: of few grains under a wide one, whose coarse end is less than one
    /// grain ([`FOLLOWS`]).
    pub fn radii(&self, amount: Amount, seed: u64) -> Option<(Vec<f64>, f64)> {
        let counts = self.counts();
        // Of a curve of mass 1 and diameter 1: grains Σ n, volume π/6.
        let mean_volume = sphere_volume(0.5) / counts.iter().sum::<f64>();
        let count = match amount {
            Amount::Count(count) => count,
            Amount::Volume { volume, most } => {
                let count = (volume / mean_volume).round();
                if count > most as f64 {
                    return None;
                }
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "at most `most`"
                )]
                let count = count as usize;
                count
            }
        };
        let mut random = SplitMix64::new(!seed);
        let mut radii: Vec<f64> = (0..count)
            .map(|grain| {
                let number = (grain as f64 + random.unit()) / count as f64;
                0.5 * self.diameter(&counts, number)
            })
            .collect();
        // So that places do not go by size (Fisher & Yates).
        for end in (1..count).rev() {
            radii.swap(end, random.below(end + 1));
        }
        let sum: f64 = radii.iter().map(|&radius| sphere_volume(radius)).sum();
        let wanted = match amount {
            Amount::Volume { volume, .. } => volume,
            Amount::Count(_) => count as f64 * mean_volume,
        };
        let scale = (wanted / sum).cbrt();
        if let Amount::Volume { .. } = amount {
            radii.iter_mut().for_each(|radius| *radius *= scale);
        }
        (!radii.is_empty()).then_some((radii, scale))
    }
}

/// The share of a normal distribution below `z` standard deviations.
fn normal(z: f64) -> f64 {
    // Φ(z) = 1/2 + φ(z) (z + z³/3 + z⁵/(3·5) + ...)                       (Marsaglia, J. Stat. Softw. 11 (4), 2004)
    let (mut term, mut sum) = (z, z);
    for n in 1..100 {
        term *= z * z / f64::from(2 * n + 1);
        sum += term;
    }
    0.5 + sum * (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt()
}

/// The diameter than which the share `passing` of the mass of spheres is finer.
pub fn passing_diameter(diameters: &[f64], passing: f64) -> f64 {
    let mut sorted = diameters.to_vec();
    sorted.sort_by(f64::total_cmp);
    let total: f64 = sorted.iter().map(|d| d.powi(3)).sum();
    let mut sum = 0.0;
    for &diameter in &sorted {
        sum += diameter.powi(3);
        if sum >= passing * total {
            return diameter;
        }
    }
    sorted.last().copied().unwrap_or(f64::NAN)
}
