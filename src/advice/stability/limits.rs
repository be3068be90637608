//! What the maps of stability say in a line each: how fast a flow may be, and how light a free grain. The numbers stand in
//! `src/advice/coefficients.csv`.

use psmrt_reference::collision::{Collision, Preset};
use psmrt_reference::coupling::InternalFluid;
use psmrt_reference::partial_saturation::Weighting;

use crate::advice::coefficients::groups;

/// A flow that the warnings compare a scene with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measured {
    /// A fluid alone: the shear layer.
    Fluid,
    /// A dense bed with this weight: the ordered bed; the velocity is the superficial one.
    Bed(Weighting),
}

/// How fast a flow may be, cells per step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Largest velocity that survived.
    pub lives: f64,
    /// Largest velocity that was not wrong; `None` if all were, or if accuracy was not judged by
    /// velocity.
    pub right: Option<f64>,
}

impl Limit {
    /// The largest velocity that survives and that the map does not call wrong. Where it calls all wrong
    /// (beds at large tau, on its own grid of 13 cells per diameter), velocity is not what is wrong.
    pub fn most(&self) -> f64 {
        self.right.map_or(self.lives, |right| right.min(self.lives))
    }
}

impl Measured {
    /// What the map says of a collision: the smaller of the limits at the measured relaxation times on
    /// either side. `None` where nothing was measured: rates of one's own, tau beyond the map.
    pub fn limit(self, collision: &Collision) -> Option<Limit> {
        self.limit_of(Preset::of(collision)?, collision.tau())
    }

    /// The same of a model.
    pub fn limit_of(self, model: Preset, tau: f64) -> Option<Limit> {
        let flow = match self {
            Measured::Fluid => "shear layer",
            Measured::Bed(Weighting::NobleTorczynski) => "bed NT",
            Measured::Bed(Weighting::SolidFraction) => "bed eps",
            Measured::Bed(Weighting::Graded) => "bed graded",
        };
        let own = lines("fastest", &format!("{flow} {}", model.word()));
        let above = own.iter().position(|one| one.tau >= tau)?;
        let is_measured = own[above].tau - tau < 1e-9;
        let around = &own[if is_measured { above } else { above.saturating_sub(1) }..=above];
        let lives = around.iter().filter_map(|one| one.lives).fold(f64::INFINITY, f64::min);
        let right = around.iter().map(|one| one.right.unwrap_or(0.0)).fold(f64::INFINITY, f64::min);
        lives.is_finite().then_some(Limit { lives, right: Some(right).filter(|&u| u > 0.0) })
    }
}

/// Limits at a relaxation time.
struct Line {
    tau: f64,
    /// Velocity that survived, or the density of the lightest grain that was right.
    lives: Option<f64>,
    /// Velocity that was right.
    right: Option<f64>,
}

/// The limits of a row of coefficients, by relaxation time; none if there is no such row.
fn lines(name: &str, of: &str) -> Vec<Line> {
    let line = |group: Vec<Option<f64>>| {
        let number = |i: usize| group.get(i).copied().flatten();
        Some(Line { tau: number(0)?, lives: number(1), right: number(2) })
    };
    groups(name, of).unwrap_or_default().into_iter().filter_map(line).collect()
}

/// The smallest density of a free grain, over that of the fluid, down to which all were right at the measured
/// relaxation times on either side. `None` beyond the map.
pub fn lightest(inside: InternalFluid, tau: f64) -> Option<f64> {
    let own = lines("lightest", word(inside));
    let above = own.iter().position(|one| one.tau >= tau - 1e-9)?;
    let is_measured = (own[above].tau - tau).abs() < 1e-9;
    let below = if is_measured { above } else { above.checked_sub(1)? };
    Some(own[below].lives?.max(own[above].lives?))
}

fn word(inside: InternalFluid) -> &'static str {
    match inside {
        InternalFluid::Lagged => "lagged",
        InternalFluid::Kept => "kept",
    }
}

/// The relaxation times of that map.
pub fn taus_of_movers() -> Vec<f64> {
    let both = [InternalFluid::Lagged, InternalFluid::Kept];
    let lines = both.into_iter().flat_map(|inside| lines("lightest", word(inside)));
    let mut taus: Vec<f64> = lines.map(|line| line.tau).collect();
    taus.sort_by(f64::total_cmp);
    taus.dedup();
    taus
}
