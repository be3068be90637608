//! The rule by which a population enters through faces.

use psmrt_reference::directions::{C, OPPOSITE, number_of};
use psmrt_reference::domain::{Domain, Face};
use psmrt_reference::lattice::Vec3;

use super::states::{Near, Side, along, density_at, face_at, place_at, velocity_at};
use crate::cpu::collision::weight;
use crate::cpu::grid::Grid;
use crate::lanes::Real;

/// Where what enters a cell comes from. `shift` leads from the cell to the one whose populations are looked at.
#[derive(Clone, Debug)]
pub(super) enum Rule {
    /// `f*` of another direction or cell: periodic faces, mirrors, free outflow.
    Copy { direction: usize, shift: isize },
    /// Half-way bounce-back with the sum of the velocities at these faces.
    BounceBack { faces: Vec<Side> },
    /// Anti-bounce-back at the density of this face.
    AntiBounceBack { face: Side },
    /// Non-equilibrium extrapolation at the mean density of these faces.
    CarriedOver { direction: usize, shift: isize, faces: Vec<Side> },
}

/// The slow mean of the outward velocity in each cell at a non-reflecting face, x before y before z.
#[derive(Clone, Debug)]
pub(super) struct SlowMeans {
    pub(super) face: Side,
    pub(super) values: Vec<f64>,
}

impl Rule {
    /// From the cell that is entered to the one whose populations are looked at.
    pub(super) fn shift(&self) -> isize {
        match self {
            Rule::Copy { shift, .. } | Rule::CarriedOver { shift, .. } => *shift,
            Rule::BounceBack { .. } | Rule::AntiBounceBack { .. } => 0,
        }
    }

    /// The direction whose `f*`, of the cell that is looked at, enters along `a` as it is, with the velocities of now: any
    /// but those that walls in motion or held densities change.
    pub(super) fn copied(&self, domain: &Domain, a: usize) -> Option<usize> {
        match self {
            Rule::Copy { direction, .. } => Some(*direction),
            Rule::BounceBack { faces } if wall_gain(domain, faces, a) == 0.0 => Some(OPPOSITE[a]),
            Rule::BounceBack { .. } | Rule::AntiBounceBack { .. } | Rule::CarriedOver { .. } => {
                None
            }
        }
    }

    /// Whether it asks for density and velocity of the cell that it comes from.
    pub(super) fn asks_for_state(&self, domain: &Domain) -> bool {
        match self {
            Rule::Copy { .. } => false,
            Rule::BounceBack { faces } => {
                faces.iter().any(|&face| velocity_at(domain, face) != Vec3::zeros())
            }
            Rule::AntiBounceBack { .. } | Rule::CarriedOver { .. } => true,
        }
    }

    /// What enters along `a` from cell `from`, `f` and `near` being its populations and its state after the collision.
    pub(super) fn enters<T: Real>(
        &self,
        domain: &Domain,
        slow_means: &[SlowMeans],
        a: usize,
        from: usize,
        f: impl Fn(usize) -> T,
        near: &Near,
    ) -> T {
        let back = f(OPPOSITE[a]);
        match self {
            Rule::Copy { direction, .. } => f(*direction),
            Rule::BounceBack { faces } => {
                // f_a(x, t+1) = f*_-a(x, t) + 2 w_a ρ (c_a·u_w)/c_s²
                T::from_f64(back.to_f64() + wall_gain(domain, faces, a) * (1.0 + near.excess))
            }
            Rule::AntiBounceBack { face } => {
                let rho_w = density_at(domain, *face);
                // f_a(x, t+1) = -f*_-a(x, t) + 2 w_a ρ_w [1 + 9/2 (c_a·u)² - 3/2 u²]
                let gain = (rho_w - 1.0) + rho_w * near.squares(a);
                T::from_f64(2.0 * weight(a) * gain - back.to_f64())
            }
            Rule::CarriedOver { direction: b, faces, .. } => {
                let excess =
                    faces.iter().map(|&face| face_excess(domain, face, slow_means, from, near));
                let excess = excess.sum::<f64>() / faces.len() as f64;
                // f_a(x, t+1) = f*_a(x') + f_a^eq(2 ρ_w - ρ', u') - f_a^eq(ρ', u')
                let gain = 2.0 * (excess - near.excess) * weight(*b) * near.equilibrium(*b);
                T::from_f64(f(*b).to_f64() + gain)
            }
        }
    }
}

/// `2 w_a (c_a·u_w)/c_s²`, with the sum of the velocities at these faces.
fn wall_gain(domain: &Domain, faces: &[Side], a: usize) -> f64 {
    let wall: Vec3 = faces.iter().map(|&face| velocity_at(domain, face)).sum();
    6.0 * weight(a) * along(a, &wall)
}

/// The rule of the links of direction `a` that come from outside along the axes `crossed`: a wall or an inlet comes
/// before a face of given pressure, this before one that carries the flow over; the others wrap, mirror or clamp.
pub(super) fn rule<T: Real>(domain: &Domain, grid: &Grid<T>, a: usize, crossed: &[usize]) -> Rule {
    let mut shift = -grid.stride(a);
    let mut direction = C[a];
    let (mut walls, mut pressure, mut carried) = (Vec::new(), None, Vec::new());
    for &axis in crossed {
        let c = C[a][axis];
        let face = (axis, usize::from(c < 0));
        let step = [1, domain.cells()[0], domain.cells()[0] * domain.cells()[1]][axis] as isize;
        let across = domain.cells()[axis] as isize * step;
        // Back to the cell's own coordinate, or to the far end of the axis.
        match face_at(domain, face) {
            Face::Periodic => shift += c as isize * across,
            other => {
                shift += c as isize * step;
                match other {
                    Face::FreeSlip => direction[axis] = -c,
                    Face::Wall { .. } | Face::VelocityInlet { .. } => walls.push(face),
                    Face::Pressure { .. } => pressure = Some(face),
                    Face::DevelopedPressure { .. } | Face::NonReflectingPressure { .. } => {
                        carried.push(face);
                    }
                    Face::FreeOutflow | Face::Periodic => {}
                }
            }
        }
    }
    let direction = number_of(direction);
    match (walls.is_empty(), pressure) {
        (false, _) => Rule::BounceBack { faces: walls },
        (true, Some(face)) => Rule::AntiBounceBack { face },
        (true, None) if carried.is_empty() => Rule::Copy { direction, shift },
        (true, None) => Rule::CarriedOver { direction, shift, faces: carried },
    }
}

/// Density less 1 at a developed or non-reflecting face whose cell holds `near`.
pub(super) fn face_excess(
    domain: &Domain,
    face: Side,
    slow_means: &[SlowMeans],
    cell: usize,
    near: &Near,
) -> f64 {
    let held = density_at(domain, face) - 1.0;
    match slow_means.iter().find(|means| means.face == face) {
        None => held,
        Some(means) => {
            let at = place_at(domain, face.0, domain.coordinates(cell));
            // ρ_w = ρ_0 + ρ/c_s (u_n - m)
            held + (1.0 + near.excess) * 3.0_f64.sqrt() * (near.outward(face) - means.values[at])
        }
    }
}
