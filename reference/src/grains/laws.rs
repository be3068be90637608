//! The two contact laws, and what is asked of both.

use crate::grains::contact::{ContactMemory, Geometry, PairForce, Relative, contact_force};
use crate::grains::grain::Grain;
use crate::grains::hertz::{HertzLaw, relaxed};
use crate::grains::law::{ContactLaw, LawError};

/// How two surfaces act on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Springs of one stiffness, whatever the overlap.
    Linear(ContactLaw),
    /// Elastic spheres.
    Hertz(HertzLaw),
}

impl From<ContactLaw> for Law {
    fn from(law: ContactLaw) -> Self {
        Law::Linear(law)
    }
}

impl From<HertzLaw> for Law {
    fn from(law: HertzLaw) -> Self {
        Law::Hertz(law)
    }
}

impl Law {
    /// The law if it is linear.
    pub fn linear(&self) -> Option<&ContactLaw> {
        match self {
            Law::Linear(law) => Some(law),
            Law::Hertz(_) => None,
        }
    }

    /// The law if it is Hertz's.
    pub fn hertz(&self) -> Option<&HertzLaw> {
        match self {
            Law::Linear(_) => None,
            Law::Hertz(law) => Some(law),
        }
    }

    /// Stiffness and damping at this `overlap` of bodies of reduced radius `radius` and reduced mass `mass`.
    pub fn at(&self, overlap: f64, radius: f64, mass: f64) -> ContactLaw {
        match self {
            Law::Linear(law) => *law,
            Law::Hertz(law) => law.at(overlap, radius, mass),
        }
    }

    /// Overlap at which the spring alone balances `force`.
    pub fn overlap_at_rest(&self, force: f64, radius: f64) -> f64 {
        match self {
            Law::Linear(law) => force / law.stiffness,
            // F = (4/3) E* √R* δ^(3/2); at δ = 1 the stiffness is K
            Law::Hertz(law) => (force / law.at(1.0, radius, 1.0).stiffness).powf(2.0 / 3.0),
        }
    }

    /// Overlap at which the spring alone stops `mass` that arrives at `speed`.
    pub fn overlap_of_impact(&self, speed: f64, radius: f64, mass: f64) -> f64 {
        match self {
            // m v² = k δ²
            Law::Linear(law) => speed * (mass / law.stiffness).sqrt(),
            // m v²/2 = (2/5) K δ^(5/2)
            Law::Hertz(law) => {
                let k = law.at(1.0, radius, mass).stiffness;
                (1.25 * mass * speed * speed / k).powf(0.4)
            }
        }
    }

    /// Speed that the spring alone gives `mass` as it relaxes from `overlap`.
    pub fn speed_of_release(&self, overlap: f64, radius: f64, mass: f64) -> f64 {
        let stiffness = self.at(overlap, radius, mass).stiffness;
        match self {
            Law::Linear(_) => overlap * (stiffness / mass).sqrt(),
            // m v²/2 = (2/5) K δ^(5/2), K √δ being the stiffness F/δ
            Law::Hertz(_) => overlap * (0.8 * stiffness / mass).sqrt(),
        }
    }

    /// Errors unless its values can be used.
    pub fn checked(&self) -> Result<(), LawError> {
        match self {
            Law::Linear(law) => law.checked().map(|_| ()),
            Law::Hertz(law) => law.checked().map(|_| ()),
        }
    }

    /// As [`contact_force`], between bodies of these masses; one that nothing moves has an infinite mass.
    pub fn force(
        &self,
        masses: [f64; 2],
        geometry: &Geometry,
        ways: [&Relative; 2],
        dt: f64,
        memory: &mut Option<ContactMemory>,
    ) -> Option<PairForce> {
        match self {
            Law::Linear(law) => contact_force(law, geometry, ways, dt, memory),
            Law::Hertz(law) => {
                if let Some(before) = memory {
                    *before = relaxed(before, geometry.overlap, ways[0], dt);
                }
                let reduced = 1.0 / (1.0 / masses[0] + 1.0 / masses[1]);
                let now = law.at(geometry.overlap, geometry.rolling_radius, reduced);
                contact_force(&now, geometry, ways, dt, memory)
            }
        }
    }

    /// The shortest time scale of contacts among `grains` of which some are free.
    pub fn shortest_time(&self, grains: &[Grain]) -> f64 {
        match self {
            Law::Linear(law) => {
                let mut masses: Vec<f64> = free(grains).map(|grain| grain.mass).collect();
                masses.sort_by(f64::total_cmp);
                let Some(&lightest) = masses.first() else { return f64::INFINITY };
                // m₁ m₂/(m₁ + m₂), or m₁ against a grain that is held
                let second = masses.get(1).copied().filter(|_| masses.len() == grains.len());
                let reduced =
                    second.map_or(lightest, |second| lightest * second / (lightest + second));
                law.shortest_time(reduced)
            }
            // Of all partners a grain's own double has the shortest contact, in which springs go as √(0.1 R R*), 1/m is
            // 2/m_i and R* is R/2. That of the grain with the largest R/m is the shortest: let R_i be the smaller radius
            // of a pair and q the largest R/m. Then 1/m <= q/R*, √(R* R_i)/m <= q √(R_i/R*) = q √(1 + R_i/R_j) <= q √2.
            Law::Hertz(law) => {
                let with_double = |grain: &Grain| {
                    law.shortest_time(grain.radius, 0.5 * grain.radius, 0.5 * grain.mass)
                };
                free(grains).map(with_double).fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// The shortest time scale of contacts of `grains` with a plane.
    pub fn shortest_time_on_plane(&self, grains: &[Grain]) -> f64 {
        match self {
            Law::Linear(law) => {
                let lightest = free(grains).map(|grain| grain.mass).min_by(f64::total_cmp);
                lightest.map_or(f64::INFINITY, |mass| law.shortest_time(mass))
            }
            Law::Hertz(law) => {
                let one = |grain: &Grain| law.shortest_time(grain.radius, grain.radius, grain.mass);
                free(grains).map(one).fold(f64::INFINITY, f64::min)
            }
        }
    }
}

fn free(grains: &[Grain]) -> impl Iterator<Item = &Grain> {
    grains.iter().filter(|grain| !grain.held)
}
