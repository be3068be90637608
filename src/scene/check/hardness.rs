//! How hard contacts must be: what weight and impacts ask of the stiffness of the normal spring.
//!
//! All linear contacts of a scene have one spring, of stiffness `k`. What presses on it, in SI words:
//!
//! *A bed at rest.* The free grains weigh `W = Σ (m_s - m_f) g`, less buoyancy. If they come to rest on the
//! area `A` of the domain across gravity, they press on the floor with `p = W/A`. A grain of diameter `d`
//! at the bottom carries what stands on `d²`, and its contacts give way by
//!
//! ```text
//!   δ/d = p d²/(k d) = p d/k
//! ```
//!
//! Forces in a bed scatter about that mean, and those above three times it are a few in a hundred: their
//! number falls as `exp(-1.4 F/<F>)` (Radjai, Jean, Moreau & Roux, Phys. Rev. Lett. 77, 274 (1996)). So the
//! mean is held below 0.3 % ([`IN_BED`]) and what the strongest carry stays near 1 %.
//!
//! *The heaviest grain on the smallest.* `δ/d = (m_s - m_f) g/(k d_min)`, below 1 % ([`ONE_ON_ONE`]); this
//! is also the heaviest grain alone on the floor.
//!
//! *Impacts.* A mass `m` that arrives at speed `v` is stopped when the spring has its energy,
//! `k δ²/2 = m v²/2` (the dashpot leaves less), so
//!
//! ```text
//!   δ/d = (v/d) √(m/k)
//! ```
//!
//! The speed is the smaller of that of a steady fall in still fluid, in which the drag of Schiller & Naumann
//! (Z. Ver. Dtsch. Ing. 77, 318 (1933)), `3π ρ_f ν d v (1 + 0.15 Re^0.687)`, carries the weight, and that of
//! a fall without drag through the domain, `√(2 (1 - m_f/m_s) g h)`. The heaviest grain that hits
//! the smallest overlaps it by less than 5 % of its diameter ([`IN_IMPACT`]).
//!
//! *Hertz's contact* of modulus `E*` gives way to the same forces and energies by `δ = (F/K)^(2/3)` and
//! `δ = (5 m v²/(4 K))^(2/5)` with `K = (4/3) E* √R*`: at the bottom of a bed `R*` is half the radius of the largest, and
//! elsewhere that of the largest on the smallest.
//!
//! None of this knows the time step: the sub-steps pay for it.

use std::f64::consts::PI;

use psmrt_reference::domain::Domain;
use psmrt_reference::grains::grain::{Grain, sphere_volume};
use psmrt_reference::grains::laws::Law;
use psmrt_reference::lattice::Vec3;

/// Mean overlap at the bottom of a bed at rest, in diameters, that default contacts keep to.
pub(crate) const IN_BED: f64 = 0.003;

/// Overlap of the heaviest grain at rest on the smallest, in diameters of that, alike.
pub(crate) const ONE_ON_ONE: f64 = 0.01;

/// Overlap of the fastest impact of the heaviest on the smallest, alike.
pub(crate) const IN_IMPACT: f64 = 0.05;

/// What weight and impacts do to contacts, in any consistent units in which the fluid has density 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Burden {
    /// Pressure of all free grains on their floor times the largest diameter; 0 if nothing holds a bed.
    in_bed: f64,
    /// Weight of the heaviest over the smallest diameter.
    one_on_one: f64,
    /// Largest `m v²` over the square of the smallest diameter.
    in_impact: f64,
    /// Smallest diameter of all grains.
    smallest: f64,
    /// Largest diameter of the free ones.
    largest: f64,
    /// Largest speed of an impact.
    speed: f64,
}

/// Overlaps in diameters of the smaller grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Overlaps {
    /// Mean, at the bottom of a bed of all free grains at rest.
    pub in_bed: f64,
    /// Of the heaviest grain at rest on the smallest.
    pub one_on_one: f64,
    /// Of the heaviest grain that falls on the smallest.
    pub in_impact: f64,
}

/// What is around the grains: it carries a part of their weight, and brakes their fall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Around {
    /// Fluid of density 1.
    Fluid {
        /// Its kinematic viscosity.
        nu: f64,
    },
    /// Nothing.
    Nothing,
}

impl Burden {
    /// What these grains, of which the free ones weigh, do under an acceleration `g`.
    pub fn new(grains: &[Grain], g: &Vec3, domain: &Domain, around: Around) -> Self {
        let free = || grains.iter().filter(|grain| !grain.held);
        let carried = |grain: &Grain| match around {
            Around::Fluid { .. } => sphere_volume(grain.radius),
            Around::Nothing => 0.0,
        };
        let weight = |grain: &Grain| (grain.mass - carried(grain)).abs() * g.norm();
        let largest = free().map(|grain| 2.0 * grain.radius).fold(0.0, f64::max);
        let smallest = grains.iter().map(|grain| 2.0 * grain.radius).fold(f64::INFINITY, f64::min);
        if g.norm() == 0.0 || largest == 0.0 {
            return Burden::default();
        }
        let total: f64 = free().map(weight).sum();
        let cells = domain.cells().map(|n| n as f64);
        let volume: f64 = cells.iter().product();
        let has_held = grains.iter().any(|grain| grain.held);
        // W_i/A_i, along each axis across which something can hold a bed
        let pressure = (0..3)
            .filter(|&axis| has_held || !domain.is_periodic(axis))
            .map(|axis| total * (g[axis].abs() / g.norm()) * cells[axis] / volume)
            .fold(0.0, f64::max);
        let height = match around {
            Around::Fluid { .. } => fall(domain, g),
            Around::Nothing => fall_without_drag(domain, g),
        };
        let speed = |grain: &Grain| {
            let steady = match around {
                Around::Fluid { nu } => settling_speed(weight(grain), grain.radius, nu),
                Around::Nothing => f64::INFINITY,
            };
            // v = √(2 (1 - m_f/m_s) g h)
            let dropped = (2.0 * weight(grain) / grain.mass * height).sqrt();
            steady.min(dropped)
        };
        let energy = |grain: &Grain| grain.mass * speed(grain).powi(2);
        Burden {
            in_bed: pressure * largest,
            one_on_one: free().map(weight).fold(0.0, f64::max) / smallest,
            in_impact: free().map(energy).fold(0.0, f64::max) / (smallest * smallest),
            smallest,
            largest,
            speed: free().map(speed).fold(0.0, f64::max),
        }
    }

    /// Largest speed at which a grain falls on something; 0 if nothing weighs.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// The overlaps that contacts of this law allow.
    pub fn overlaps(&self, law: &Law) -> Overlaps {
        match law {
            Law::Linear(law) => Overlaps {
                in_bed: self.in_bed / law.stiffness,
                one_on_one: self.one_on_one / law.stiffness,
                in_impact: (self.in_impact / law.stiffness).sqrt(),
            },
            Law::Hertz(_) if self.smallest == 0.0 => {
                Overlaps { in_bed: 0.0, one_on_one: 0.0, in_impact: 0.0 }
            }
            Law::Hertz(_) => {
                let (small, large) = (self.smallest, self.largest);
                let radius = 0.5 * small * large / (small + large);
                let (bed, weight) = (self.in_bed * large, self.one_on_one * small);
                // A mass of 1 that has the energy of the impact.
                let speed = self.in_impact.sqrt() * small;
                Overlaps {
                    in_bed: law.overlap_at_rest(bed, 0.25 * large) / large,
                    one_on_one: law.overlap_at_rest(weight, radius) / small,
                    in_impact: law.overlap_of_impact(speed, radius, 1.0) / small,
                }
            }
        }
    }

    /// How many times harder contacts of this law would keep all of them to their limits: stiffness or modulus.
    pub fn asks_of(&self, law: &Law) -> f64 {
        match law {
            Law::Linear(law) => self.stiffness() / law.stiffness,
            Law::Hertz(_) => {
                let Overlaps { in_bed, one_on_one, in_impact } = self.overlaps(law);
                let at_rest = (in_bed / IN_BED).max(one_on_one / ONE_ON_ONE);
                harder_at_rest(law, at_rest).max(harder_in_impact(law, in_impact / IN_IMPACT))
            }
        }
    }

    /// The stiffness that keeps all of them to their limits; 0 if nothing weighs.
    pub fn stiffness(&self) -> f64 {
        let at_rest = (self.in_bed / IN_BED).max(self.one_on_one / ONE_ON_ONE);
        at_rest.max(self.in_impact / (IN_IMPACT * IN_IMPACT))
    }
}

/// How many times harder contacts must be for an overlap at rest that is `times` less deep.
pub(crate) fn harder_at_rest(law: &Law, times: f64) -> f64 {
    match law {
        Law::Linear(_) => times,
        Law::Hertz(_) => times.powf(1.5),
    }
}

/// The same for an overlap of impact.
pub(crate) fn harder_in_impact(law: &Law, times: f64) -> f64 {
    match law {
        Law::Linear(_) => times * times,
        Law::Hertz(_) => times.powf(2.5),
    }
}

/// How far a grain can fall: through the domain, or for ever where gravity points along a periodic axis.
fn fall(domain: &Domain, g: &Vec3) -> f64 {
    let along = |axis: usize| match domain.is_periodic(axis) {
        true => f64::INFINITY,
        false => domain.cells()[axis] as f64 * g[axis].abs() / g.norm(),
    };
    (0..3).filter(|&axis| g[axis] != 0.0).map(along).sum()
}

/// The same without drag: what falls for ever along a periodic axis meets nothing but what falls with it.
fn fall_without_drag(domain: &Domain, g: &Vec3) -> f64 {
    // v² = 2 Σ |g_i| L_i
    let along = |axis: usize| domain.cells()[axis] as f64 * g[axis].abs() / g.norm();
    (0..3).filter(|&axis| !domain.is_periodic(axis)).map(along).sum()
}

/// Speed of the steady fall of a sphere that weighs `weight` (less buoyancy) in still fluid of density 1.
pub(crate) fn settling_speed(weight: f64, radius: f64, nu: f64) -> f64 {
    // W = 3π ν d v (1 + 0.15 Re^0.687), Re = v d/ν
    let d = 2.0 * radius;
    let stokes = weight / (3.0 * PI * nu * d);
    let factor = |v: f64| 1.0 + 0.15 * (v * d / nu).powf(0.687);
    // Drag grows with v: halve the interval until it is a thousandth of the speed.
    let (mut low, mut high) = (0.0, stokes);
    while high - low > 1e-3 * high {
        let middle = 0.5 * (low + high);
        if middle * factor(middle) < stokes { low = middle } else { high = middle }
    }
    high
}
