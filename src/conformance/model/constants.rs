//! Weights, `M`, `S-hat`, equilibria, weights of solids, formulas.

use nalgebra::SMatrix;
use psmrt_reference::coverage::exact_fraction;
use psmrt_reference::directions::{C, Q};
use psmrt_reference::lattice::Vec3;
use psmrt_reference::moments;
use psmrt_reference::rates::Rates;

use super::super::gauged::{Gauged, Gauged3, dot, given};
use super::super::mistakes::Mistake;
use super::super::task::{Constants, Formulas, SharedCells, SolidCells, Spheres, States};
use super::{Cell, GaugedAnswers, Model};

/// Square of the length of direction `a`.
fn square(a: usize) -> i32 {
    C[a].iter().map(|c| c * c).sum()
}

/// The weights `w_a`.
pub(super) fn weights(mistake: Option<Mistake>) -> [f64; Q] {
    let (face, edge) = match mistake {
        Some(Mistake::WeightsSwapped) => (1.0 / 36.0, 1.0 / 18.0),
        _ => (1.0 / 18.0, 1.0 / 36.0),
    };
    std::array::from_fn(|a| {
        [1.0 / 3.0, face, edge][if a == 0 { 0 } else { square(a).min(2) as usize }]
    })
}

/// The matrix `M`.
pub(super) fn moment_matrix(mistake: Option<Mistake>) -> [[f64; Q]; Q] {
    let matrix = moments::moment_matrix();
    let rows: [[f64; Q]; Q] = std::array::from_fn(|k| std::array::from_fn(|a| matrix[(k, a)]));
    match mistake {
        Some(Mistake::MomentsNotOrthogonal) => std::array::from_fn(|k| {
            std::array::from_fn(|a| monomial(k, C[a].map(f64::from)).unwrap_or(rows[k][a]))
        }),
        Some(Mistake::MomentsReordered) => {
            let grouped = [0, 1, 2, 3, 5, 7, 4, 6, 8, 9, 11, 13, 14, 15, 10, 12, 16, 17, 18];
            grouped.map(|k: usize| rows[k])
        }
        _ => rows,
    }
}

/// Row `k` of the matrix of plain monomials, where it differs from `M`.
fn monomial(k: usize, [x, y, z]: [f64; 3]) -> Option<f64> {
    let c2 = x * x + y * y + z * z;
    match k {
        1 => Some(c2),
        2 => Some(c2 * c2),
        4 => Some(c2 * x),
        6 => Some(c2 * y),
        8 => Some(c2 * z),
        10 => Some(c2 * (3.0 * x * x - c2)),
        12 => Some(c2 * (y * y - z * z)),
        _ => None,
    }
}

/// The columns of a matrix.
pub(super) fn columns(matrix: &[[f64; Q]; Q]) -> [[f64; Q]; Q] {
    std::array::from_fn(|column| std::array::from_fn(|row| matrix[row][column]))
}

/// The columns of its inverse.
pub(super) fn inverse_columns(matrix: &[[f64; Q]; Q]) -> [[f64; Q]; Q] {
    let matrix = SMatrix::<f64, Q, Q>::from_fn(|row, column| matrix[row][column]);
    // No mistake makes it singular.
    matrix.try_inverse().map_or([[f64::NAN; Q]; Q], |inverse| inverse.data.0)
}

/// A matrix, given by its columns, times the values of a cell. (The entries of the matrix are given
/// numbers, so values and gauges are plain sums.)
pub(super) fn product(columns: &[[f64; Q]; Q], vector: &Cell) -> Cell {
    let (mut values, mut gauges) = ([0.0; Q], [0.0; Q]);
    for (column, number) in columns.iter().zip(vector) {
        for row in 0..Q {
            values[row] += column[row] * number.value;
            gauges[row] += column[row].abs() * number.gauge;
        }
    }
    std::array::from_fn(|row| Gauged { value: values[row], gauge: gauges[row] })
}

/// Direction `a` as given numbers.
pub(super) fn direction(a: usize) -> Gauged3 {
    given(C[a].map(f64::from))
}

/// A vector as given numbers.
pub(super) fn vector(v: &Vec3) -> Gauged3 {
    given([v.x, v.y, v.z])
}

/// Density and bare momentum.
pub(super) fn conserved(f: &Cell) -> (Gauged, Gauged3) {
    let momentum = |axis: usize| (0..Q).map(|a| f[a] * f64::from(C[a][axis])).sum();
    (f.iter().copied().sum(), [momentum(0), momentum(1), momentum(2)])
}

impl Model {
    /// `f_eq`, its terms of second order multiplied by `factor`.
    fn equilibrium_with(&self, rho: Gauged, u: Gauged3, factor: Gauged) -> Cell {
        let (u2, one) = (dot(u, u), Gauged::from(1.0));
        std::array::from_fn(|a| {
            let cu = dot(direction(a), u);
            let square = cu * cu * if self.has(Mistake::EquilibriumThree) { 3.0 } else { 4.5 };
            let second = if self.has(Mistake::EquilibriumLinear) {
                Gauged::default()
            } else if self.has(Mistake::EquilibriumWithoutSquare) {
                square
            } else {
                square - u2 * 1.5
            };
            rho * (one + cu * 3.0 + second * factor) * self.weights[a]
        })
    }

    /// `f_eq(rho, u)`.
    pub(super) fn equilibrium(&self, rho: Gauged, u: Gauged3) -> Cell {
        self.equilibrium_with(rho, u, 1.0.into())
    }

    /// `m_eq(rho, u) = M f_eq(rho, u)`.
    pub(super) fn equilibrium_moments(&self, rho: Gauged, u: Gauged3) -> Cell {
        let constant = self.has(Mistake::ConstantDensity);
        let f_eq = self.equilibrium_with(rho, u, if constant { rho } else { 1.0.into() });
        let mut m_eq = product(&self.columns, &f_eq);
        if self.has(Mistake::OptimisedConstants) {
            m_eq[2] = rho * dot(u, u) * (-475.0 / 63.0);
            (m_eq[10], m_eq[12]) = (Gauged::default(), Gauged::default());
        }
        m_eq
    }

    /// The diagonal of `S-hat`.
    pub(super) fn s_hat(&self, rates: &Rates) -> [f64; Q] {
        let Rates { mut e, mut eps, mut q, mut nu, mut pi, mut m } = *rates;
        match self.mistake {
            Some(Mistake::RatesQAndMSwapped) => (q, m) = (m, q),
            Some(Mistake::RatesEAndEpsSwapped) => (e, eps) = (eps, e),
            Some(Mistake::S9IsTau) => nu = 1.0 / nu,
            Some(Mistake::PiRateIsEps) => pi = eps,
            Some(Mistake::PiRateIsNu) => pi = nu,
            _ => {}
        }
        self.diagonal([e, eps, q, nu, pi, m])
    }

    /// The diagonal matrix of the rates `e, eps, q, nu, pi, m`.
    pub(super) fn diagonal<T: Copy + Default>(&self, [e, eps, q, nu, pi, m]: [T; 6]) -> [T; Q] {
        let (none, thirteenth) = (T::default(), if self.has(Mistake::SHat13th) { nu } else { pi });
        let mut diagonal =
            [none, e, eps, none, q, none, q, none, q, nu, pi, nu, thirteenth, nu, nu, nu, m, m, m];
        if self.has(Mistake::SHatWithoutBlank) {
            diagonal[3..].rotate_left(1);
        }
        diagonal
    }

    /// Relaxation time of a viscosity.
    pub(super) fn relaxation_time(&self, nu: f64) -> Gauged {
        let nu = Gauged::from(nu);
        match self.mistake {
            Some(Mistake::ViscosityWithoutThird) => nu + 0.5.into(),
            Some(Mistake::ViscosityWithoutHalf) => nu * 3.0,
            _ => nu * 3.0 + 0.5.into(),
        }
    }

    /// The weight `B` of a solid fraction.
    pub(super) fn weight(&self, epsilon: Gauged, tau: f64) -> Gauged {
        if self.has(Mistake::BIsEpsilon) {
            return epsilon;
        }
        let half = if self.has(Mistake::BWithTau) { 0.0 } else { 0.5 };
        let beyond = Gauged::from(tau) - half.into();
        epsilon * beyond / (Gauged::from(1.0) - epsilon + beyond)
    }

    /// The weights of the solids of a cell and their sum, that of the cell. `weight`: that of a solid fraction.
    pub(super) fn share(
        &self,
        epsilons: &[f64],
        weight: impl Fn(Gauged) -> Gauged,
    ) -> (Vec<Gauged>, Gauged) {
        if self.has(Mistake::WeightsNotShared) {
            let weights: Vec<Gauged> = epsilons.iter().map(|&e| weight(e.into())).collect();
            let sum: Gauged = weights.iter().copied().sum();
            let total = Gauged { value: sum.value.min(1.0), gauge: sum.gauge };
            return (weights, total);
        }
        let sum: f64 = epsilons.iter().sum();
        let total = weight(sum.min(1.0).into());
        (epsilons.iter().map(|&e| total * Gauged::from(e / sum)).collect(), total)
    }

    /// Solid fraction of a sphere whose centre is at `offset` from that of the cell.
    pub(super) fn fraction(&self, offset: &Vec3, radius: f64) -> Gauged {
        let value = match self.mistake {
            Some(Mistake::CoverageStaircase) => f64::from(u8::from(offset.norm() <= radius)),
            Some(Mistake::CoverageLinear) => (radius - offset.norm() + 0.5).clamp(0.0, 1.0),
            Some(Mistake::RadiusIsDiameter) => exact_fraction(offset, 0.5 * radius),
            _ => exact_fraction(offset, radius),
        };
        // Volumes of cones of the sphere's size over the cell's faces make it up.
        Gauged { value, gauge: 1.0 + radius * radius }
    }

    pub(super) fn constants(&self, problem: &Constants) -> GaugedAnswers {
        // Entries of M and S-hat that cancel to 0 may be computed as sums of terms of the size of 1.
        let near = |value: f64| Gauged { value, gauge: value.abs().max(1.0) };
        let directions: Vec<Gauged> = C.iter().flat_map(|c| given(c.map(f64::from))).collect();
        let opposites: Vec<Gauged> =
            self.opposite.iter().map(|&a| Gauged::from(a as f64)).collect();
        let matrix: Vec<Gauged> = self.matrix.iter().flatten().map(|&value| near(value)).collect();
        let tau: Vec<Gauged> =
            problem.viscosities.iter().map(|&nu| self.relaxation_time(nu)).collect();
        GaugedAnswers::default()
            .with("directions", &[Q, 3], &directions)
            .with("weights", &[Q], &given(self.weights))
            .with("opposites", &[Q], &opposites)
            .with("moment_matrix", &[Q, Q], &matrix)
            .with("s_hat", &[Q], &self.s_hat(&problem.rates).map(near))
            .with("relaxation_time", &[tau.len()], &tau)
    }

    pub(super) fn states(&self, problem: &States) -> GaugedAnswers {
        let cells: Vec<Cell> = problem.f.iter().map(|f| given(*f)).collect();
        let (rho, j): (Vec<Gauged>, Vec<Gauged3>) = cells.iter().map(conserved).unzip();
        let moments: Vec<Cell> = cells.iter().map(|f| product(&self.columns, f)).collect();
        let at = || problem.at.iter().map(|(rho, u)| (Gauged::from(*rho), vector(u)));
        let f_eq: Vec<Cell> = at().map(|(rho, u)| self.equilibrium(rho, u)).collect();
        let m_eq: Vec<Cell> = at().map(|(rho, u)| self.equilibrium_moments(rho, u)).collect();
        let (n, states) = (cells.len(), problem.at.len());
        GaugedAnswers::default()
            .with("density", &[n], &rho)
            .with("momentum", &[n, 3], j.as_flattened())
            .with("moments", &[n, Q], moments.as_flattened())
            .with("equilibrium", &[states, Q], f_eq.as_flattened())
            .with("equilibrium_moments", &[states, Q], m_eq.as_flattened())
    }

    pub(super) fn solid_fractions(&self, problem: &Spheres) -> GaugedAnswers {
        let fraction = |(offset, radius): &(Vec3, f64)| self.fraction(offset, *radius);
        let fractions: Vec<Gauged> = problem.spheres.iter().map(fraction).collect();
        GaugedAnswers::default().with("solid_fraction", &[fractions.len()], &fractions)
    }

    pub(super) fn weights_of(&self, problem: &SolidCells) -> GaugedAnswers {
        let weight = |&(epsilon, tau): &(f64, f64)| self.weight(epsilon.into(), tau);
        let weights: Vec<Gauged> = problem.cells.iter().map(weight).collect();
        GaugedAnswers::default().with("weight", &[weights.len()], &weights)
    }

    pub(super) fn shared_weights(&self, problem: &SharedCells) -> GaugedAnswers {
        let share = |(epsilons, tau): &([f64; 2], f64)| {
            self.share(epsilons, |epsilon| self.weight(epsilon, *tau)).0
        };
        let weights: Vec<Gauged> = problem.cells.iter().flat_map(share).collect();
        GaugedAnswers::default().with("weight", &[problem.cells.len(), 2], &weights)
    }

    pub(super) fn formulas(&self, problem: &Formulas) -> GaugedAnswers {
        let drag = |&re: &f64| {
            let root = Gauged::from(re).sqrt();
            let one = Gauged::from(1.0);
            let root = if self.has(Mistake::DragLawPrinted) { one / root } else { root };
            Gauged::from(24.0) / re.into() + Gauged::from(6.0) / (one + root) + 0.4.into()
        };
        let drag: Vec<Gauged> = problem.reynolds.iter().map(drag).collect();
        let [d, v, nu] = problem.settling;
        let settling = if self.has(Mistake::SettlingReynoldsPrinted) { 0.3 } else { d * v / nu };
        let [count, diameter, porosity, x, y] = problem.bed;
        let spheres = count * std::f64::consts::PI / 6.0 * diameter.powi(3);
        let length =
            if self.has(Mistake::BedIsACube) { x } else { spheres / ((1.0 - porosity) * x * y) };
        GaugedAnswers::default()
            .with("drag_coefficient", &[drag.len()], &drag)
            .with("settling_reynolds", &[], &[settling.into()])
            .with("bed_length", &[], &[length.into()])
    }
}
