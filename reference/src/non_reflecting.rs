//! Pressure faces that let sound out: the density at the face follows the wave that arrives, and over times longer
//! than a memory `T` it is the given one.
//!
//! With `u_n` the outward velocity of the cell at the face, `ρ` its density and `c_s` the speed of sound:
//!
//! ```text
//! ρ_w = ρ_0 + ρ/c_s (u_n - m)      density at the face; all else as at a developed pressure face
//! dm/dt = (u_n - m)/T              m: the slow mean of u_n, one number for each cell at the face
//! ```
//!
//! **Why.** In linear acoustics along the normal a wave that leaves has `δρ = ρ δu_n/c_s`, one that comes in
//! `δρ = -ρ δu_n/c_s`. With `m` at rest the first line is the first of these: nothing comes in. With both lines
//! `d(δρ - ρ u_n/c_s)/dt = -δρ/T`, which is the relaxation towards a far pressure of Rudy & Strikwerda, J. Comput.
//! Phys. 36, 55 (1980), and Poinsot & Lele, J. Comput. Phys. 101, 104 (1992), with their `K = 1/T`: there as a rate
//! of the incoming characteristic (Thompson, J. Comput. Phys. 68, 1 (1987)), from gradients; here integrated once, so
//! that the density is given and no gradient is needed. At angular frequency `ω` with `H = iωT/(1 + iωT)`, the share
//! of `u_n` that `u_n - m` is, a wave of amplitude 1 that comes back as `r` has `1 + r = H (1 - r)`:
//!
//! ```text
//! r = -1/(1 + 2iωT),   |r| = 1/√(1 + (2ωT)²)       (Selle, Nicoud & Poinsot, AIAA J. 42, 958 (2004))
//! ```
//!
//! so sound of a period well below `4πT` leaves, and what changes slowly sees a face of given pressure. A wave that
//! arrives at the angle `θ` to the normal has `1 + r = H cos θ (1 - r)`; of sound `tan⁴(θ/2)` of the energy comes back.
//!
//! **How long a memory.** Between such a face and a velocity inlet, which sends all sound back, `L` cells apart, a mode
//! `exp(zt c_s/(2L))` has `1 + θz + exp(-z) = 0` with `θ = T c_s/L`. Its slowest root swings below `θ = 3.59` and
//! creeps above; there the flow settles fastest. With `K = σ c_s/L` that is `σ = 0.28`: Rudy & Strikwerda found 0.27,
//! Poinsot & Lele take 0.25, `T = 4 L/c_s`, which scenes have as their default.
//!
//! Characteristic conditions for lattice Boltzmann are those of Izquierdo & Fueyo, Phys. Rev. E 78, 046707 (2008),
//! Heubes, Bartel & Ehrhardt, J. Comput. Appl. Math. 262, 51 (2014), and Wissocq et al., J. Comput. Phys. 331, 1
//! (2017): they march density and velocity of the outermost nodes by the characteristic equations. Ours are the
//! integrated form, the slow mean as its state, and its marriage to the non-equilibrium extrapolation of
//! [`crate::boundary`].

use crate::domain::{Domain, Face};
use crate::lattice::{CS2, Populations, density, momentum};

/// The slow mean `m` of the outward velocity in each cell at a non-reflecting face.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowMeans {
    /// Face by face; a cell at two such faces has two.
    means: Vec<f64>,
}

/// Axis (0 to 2) and side (0: low, 1: high) of a face.
type Side = (usize, usize);

impl SlowMeans {
    /// The means are the velocities that the cells have in `f`: all faces start with their densities.
    pub fn starting_from(domain: &Domain, f: &[Populations]) -> Self {
        let cells = faces(domain).flat_map(|(face, _)| face_cells(domain, face));
        let means = cells.map(|(face, x)| outward(face, &f[domain.index(x)])).collect();
        SlowMeans { means }
    }

    /// The means that [`Self::values`] gave.
    ///
    /// # Panics
    /// If there are not as many as cells at such faces: a mistake in the calling code.
    pub fn going_on_from(domain: &Domain, means: Vec<f64>) -> Self {
        let cells: usize = faces(domain).map(|(face, _)| cell_count(domain, face)).sum();
        assert_eq!(means.len(), cells, "one slow mean per cell at a non-reflecting face");
        SlowMeans { means }
    }

    /// The means, face by face in the order -x, +x, -y, ..., each with the cells in the order of the domain.
    pub fn values(&self) -> &[f64] {
        &self.means
    }

    /// Density at a non-reflecting face of density `rho_0`, where `x` is its cell and `post` what it holds.
    pub fn face_density(
        &self,
        domain: &Domain,
        face: Side,
        rho_0: f64,
        x: [usize; 3],
        post: &Populations,
    ) -> f64 {
        let before = faces(domain).take_while(|&(known, _)| known != face);
        let first: usize = before.map(|(face, _)| cell_count(domain, face)).sum();
        let [(along, n), (across, _)] = plane(domain, face);
        let m = self.means[first + x[along] + n * x[across]];
        // ρ_w = ρ_0 + ρ/c_s (u_n - m)
        rho_0 + density(post) / CS2.sqrt() * (outward(face, post) - m)
    }

    /// Lets the means follow the velocities of the step whose populations were streamed from `post`.
    pub fn follow(&mut self, domain: &Domain, post: &[Populations]) {
        let cells = faces(domain)
            .flat_map(|(face, t)| face_cells(domain, face).map(move |(_, x)| (face, t, x)));
        for (m, (face, t, x)) in self.means.iter_mut().zip(cells) {
            // m(t+1) = m(t) + (u_n(t) - m(t))/T
            *m += (outward(face, &post[domain.index(x)]) - *m) / t;
        }
    }
}

/// The non-reflecting faces and their memories.
fn faces(domain: &Domain) -> impl Iterator<Item = (Side, f64)> + '_ {
    (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]).filter_map(|(axis, side)| {
        match domain.faces().axis(axis)[side] {
            Face::NonReflectingPressure { memory, .. } => Some(((axis, side), memory)),
            _ => None,
        }
    })
}

/// The two axes in the plane of a face, with their numbers of cells.
fn plane(domain: &Domain, (axis, _): Side) -> [(usize, usize); 2] {
    let [along, across] = [[1, 2], [0, 2], [0, 1]][axis];
    [(along, domain.cells()[along]), (across, domain.cells()[across])]
}

/// How many cells lie at a face.
fn cell_count(domain: &Domain, face: Side) -> usize {
    plane(domain, face).iter().map(|&(_, cells)| cells).product()
}

/// The cells at a face, each with the face.
fn face_cells(domain: &Domain, face: Side) -> impl Iterator<Item = (Side, [usize; 3])> + use<> {
    let (axis, side) = face;
    let outermost = if side == 0 { 0 } else { domain.cells()[axis] - 1 };
    let [(along, n), (across, m)] = plane(domain, face);
    (0..n * m).map(move |number| {
        let mut x = [outermost; 3];
        (x[along], x[across]) = (number % n, number / n);
        (face, x)
    })
}

/// Velocity out of the domain through a face.
fn outward((axis, side): Side, f: &Populations) -> f64 {
    let sign = if side == 0 { -1.0 } else { 1.0 };
    sign * momentum(f)[axis] / density(f)
}
