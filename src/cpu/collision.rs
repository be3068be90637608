//! The collision of as many cells as a vector has lanes: relaxation of the moments (SRT is MRT with equal rates), body
//! force, and the partially saturated term.
//!
//! Opposite directions are taken together: the sum of two opposite populations holds what is even in `c_a`, their
//! difference what is odd. Each of d'Humières' moments is of one kind only, so half of `M` is sums of sums and the
//! other half sums of differences, and a change is an even and an odd part for each pair. Populations are shifted,
//! `f_a - w_a`, as in the kernel: what is left is small, and single precision keeps its digits.

use psmrt_reference::collision::Collision;
use psmrt_reference::directions::Q;
use psmrt_reference::lattice::Vec3;
use psmrt_reference::partial_saturation::{SolidOperator, VISCOUS_FACTOR, Weighting};
use psmrt_reference::rates::Rates;

use crate::lanes::Lanes;

/// Lattice weights of the rest direction, of the six to faces of the cube and of the twelve to its edges.
const REST: f64 = 1.0 / 3.0;
const FACE: f64 = 1.0 / 18.0;
const EDGE: f64 = 1.0 / 36.0;

/// Lattice weight of direction `a`.
pub(super) fn weight(a: usize) -> f64 {
    match a {
        0 => REST,
        1..=6 => FACE,
        _ => EDGE,
    }
}

/// One value for each pair of opposite directions, named by the first: `xy` is (1, 1, 0), `x_y` (1, -1, 0).
#[derive(Clone, Copy)]
struct Pair<V> {
    x: V,
    y: V,
    z: V,
    xy: V,
    x_y: V,
    xz: V,
    x_z: V,
    yz: V,
    y_z: V,
}

impl<V: Lanes> Pair<V> {
    /// `f_a + f_-a`
    #[inline(always)]
    fn sums(f: &[V; Q]) -> Self {
        Pair {
            x: f[1] + f[2],
            y: f[3] + f[4],
            z: f[5] + f[6],
            xy: f[7] + f[10],
            x_y: f[9] + f[8],
            xz: f[11] + f[14],
            x_z: f[13] + f[12],
            yz: f[15] + f[18],
            y_z: f[17] + f[16],
        }
    }

    /// `f_a - f_-a`
    #[inline(always)]
    fn differences(f: &[V; Q]) -> Self {
        Pair {
            x: f[1] - f[2],
            y: f[3] - f[4],
            z: f[5] - f[6],
            xy: f[7] - f[10],
            x_y: f[9] - f[8],
            xz: f[11] - f[14],
            x_z: f[13] - f[12],
            yz: f[15] - f[18],
            y_z: f[17] - f[16],
        }
    }

    /// `self * factor + summand`
    #[inline(always)]
    fn times_plus(&self, factor: V, summand: &Self) -> Self {
        Pair {
            x: self.x.mul_add(factor, summand.x),
            y: self.y.mul_add(factor, summand.y),
            z: self.z.mul_add(factor, summand.z),
            xy: self.xy.mul_add(factor, summand.xy),
            x_y: self.x_y.mul_add(factor, summand.x_y),
            xz: self.xz.mul_add(factor, summand.xz),
            x_z: self.x_z.mul_add(factor, summand.x_z),
            yz: self.yz.mul_add(factor, summand.yz),
            y_z: self.y_z.mul_add(factor, summand.y_z),
        }
    }

    #[inline(always)]
    fn times(&self, factor: V) -> Self {
        Pair {
            x: self.x * factor,
            y: self.y * factor,
            z: self.z * factor,
            xy: self.xy * factor,
            x_y: self.x_y * factor,
            xz: self.xz * factor,
            x_z: self.x_z * factor,
            yz: self.yz * factor,
            y_z: self.y_z * factor,
        }
    }
}

/// A change of the populations: of the one at rest, and of each pair `even + odd` and `even - odd`.
#[derive(Clone, Copy)]
struct Change<V> {
    rest: V,
    even: Pair<V>,
    odd: Pair<V>,
}

impl<V: Lanes> Change<V> {
    /// `self * factor + summand`
    #[inline(always)]
    fn times_plus(&self, factor: V, summand: &Self) -> Self {
        Change {
            rest: self.rest.mul_add(factor, summand.rest),
            even: self.even.times_plus(factor, &summand.even),
            odd: self.odd.times_plus(factor, &summand.odd),
        }
    }

    #[inline(always)]
    fn times(&self, factor: V) -> Self {
        Change {
            rest: self.rest * factor,
            even: self.even.times(factor),
            odd: self.odd.times(factor),
        }
    }

    #[inline(always)]
    fn added_to(&self, f: &[V; Q]) -> [V; Q] {
        let Change { rest, even, odd } = self;
        [
            f[0] + *rest,
            f[1] + (even.x + odd.x),
            f[2] + (even.x - odd.x),
            f[3] + (even.y + odd.y),
            f[4] + (even.y - odd.y),
            f[5] + (even.z + odd.z),
            f[6] + (even.z - odd.z),
            f[7] + (even.xy + odd.xy),
            f[8] + (even.x_y - odd.x_y),
            f[9] + (even.x_y + odd.x_y),
            f[10] + (even.xy - odd.xy),
            f[11] + (even.xz + odd.xz),
            f[12] + (even.x_z - odd.x_z),
            f[13] + (even.x_z + odd.x_z),
            f[14] + (even.xz - odd.xz),
            f[15] + (even.yz + odd.yz),
            f[16] + (even.y_z - odd.y_z),
            f[17] + (even.y_z + odd.y_z),
            f[18] + (even.yz - odd.yz),
        ]
    }
}

/// A vector times a number.
#[inline(always)]
fn scaled<V: Lanes>([x, y, z]: [V; 3], factor: V) -> [V; 3] {
    [x * factor, y * factor, z * factor]
}

/// What the collision of every cell needs to know.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    rates: Rates,
    body_force: Option<Vec3>,
    operator: SolidOperator,
    weighting: Weighting,
}

impl Rules {
    /// `operator` and `weighting` are of no account where no cell has solid in it.
    pub(super) fn new(
        collision: &Collision,
        body_force: Option<Vec3>,
        operator: SolidOperator,
        weighting: Weighting,
    ) -> Self {
        let rates = match *collision {
            Collision::Srt { tau } => {
                let s = 1.0 / tau;
                Rates { e: s, eps: s, q: s, nu: s, pi: s, m: s }
            }
            Collision::Mrt { rates } => rates,
        };
        Rules { rates, body_force, operator, weighting }
    }

    /// Whether the solid's part is quadratic in its velocity.
    pub(super) fn has_squares(&self) -> bool {
        self.operator != SolidOperator::FullBounceBack
    }

    /// What the solid takes of the momentum, over `B (j - ρ u_s)`.
    pub(super) fn gain(&self) -> f64 {
        match self.operator {
            SolidOperator::NonEquilibriumBounceBack | SolidOperator::Superposition => 1.0,
            SolidOperator::FullBounceBack => 2.0,
        }
    }

    /// The weight `B` of a cell of total solid fraction `epsilon`.
    pub(super) fn weight_of(&self, epsilon: f64) -> f64 {
        match self.weighting {
            Weighting::SolidFraction => epsilon,
            Weighting::NobleTorczynski => {
                let excess = self.rates.tau() - 0.5;
                epsilon * excess / ((1.0 - epsilon) + excess)
            }
            Weighting::Viscous => {
                let solid = VISCOUS_FACTOR * epsilon * (self.rates.tau() - 0.5);
                solid / ((1.0 - epsilon) + solid)
            }
        }
    }
}

/// The rules in vectors: rates over the squared lengths of the rows of `M`, and the numbers in the formulas.
#[derive(Clone, Copy)]
pub(super) struct Collider<V> {
    zero: V,
    one: V,
    half: V,
    two: V,
    three: V,
    four: V,
    four_and_half: V,
    five_and_half: V,
    eight: V,
    eleven: V,
    twelve: V,
    nineteen: V,
    thirty: V,
    thirty_eight: V,
    two_thirds: V,
    tenth: V,
    face: V,
    edge: V,
    rest_drop: V,
    tiny: V,
    /// `-s/|row|²` of e, eps, 3pxx, 3pixx, pww, piww, pxy, q, m
    relax: [V; 9],
    /// `(1 - s/2)/|row|²` of the same
    drive: [V; 9],
    force: Option<[V; 3]>,
    excess: V,
    viscous_excess: V,
    operator: SolidOperator,
    weighting: Weighting,
}

/// The squared lengths of the rows of `M` of e, eps, 3pxx, 3pixx, pww, piww, pxy, q, m.
const SQUARED_LENGTHS: [f64; 9] = [2394.0, 252.0, 36.0, 72.0, 12.0, 24.0, 4.0, 40.0, 8.0];

impl<V: Lanes> Collider<V> {
    #[inline(always)]
    pub(super) fn new(token: V::Token, rules: &Rules) -> Self {
        let all = |value: f64| V::splat(token, value);
        let Rates { e, eps, q, nu, pi, m } = rules.rates;
        let rates = [e, eps, nu, pi, nu, pi, nu, q, m];
        let per_row = |value: fn(f64) -> f64| -> [V; 9] {
            std::array::from_fn(|row| all(value(rates[row]) / SQUARED_LENGTHS[row]))
        };
        Collider {
            zero: all(0.0),
            one: all(1.0),
            half: all(0.5),
            two: all(2.0),
            three: all(3.0),
            four: all(4.0),
            four_and_half: all(4.5),
            five_and_half: all(5.5),
            eight: all(8.0),
            eleven: all(11.0),
            twelve: all(12.0),
            nineteen: all(19.0),
            thirty: all(30.0),
            thirty_eight: all(38.0),
            two_thirds: all(2.0 / 3.0),
            tenth: all(0.1),
            face: all(FACE),
            edge: all(EDGE),
            rest_drop: all(-1.5 * REST),
            tiny: all(1e-30),
            relax: per_row(|s| -s),
            drive: per_row(|s| 1.0 - 0.5 * s),
            force: rules.body_force.map(|g| [all(g.x), all(g.y), all(g.z)]),
            excess: all(rules.rates.tau() - 0.5),
            viscous_excess: all(VISCOUS_FACTOR * (rules.rates.tau() - 0.5)),
            operator: rules.operator,
            weighting: rules.weighting,
        }
    }

    /// Post-collision populations of cells full of fluid.
    #[inline(always)]
    pub(super) fn fluid(&self, f: &[V; Q]) -> [V; Q] {
        let cell = self.cell(f);
        self.fluid_change(&cell).added_to(f)
    }

    /// Post-collision populations of cells of which solids fill `epsilon` in all, with the sum of their velocities,
    /// each times what it fills (`None` if all are at rest); and what loads are made of: density less 1 and momentum
    /// before the collision, and the weight per solid fraction, `B/Σ ε_s`.
    #[inline(always)]
    pub(super) fn saturated(
        &self,
        f: &[V; Q],
        epsilon: V,
        motion: Option<[V; 3]>,
    ) -> ([V; Q], [V; 5]) {
        let cell = self.cell(f);
        let inverse = self.one.over(epsilon.max(self.tiny));
        // The mean by what each fills.
        #[expect(clippy::manual_map, reason = "a closure may be compiled without the vectors")]
        let solid_velocity = match motion {
            None => None,
            Some(sum) => Some(scaled(sum, inverse)),
        };
        let weight = self.weight_of(epsilon);
        let fluid_change = self.fluid_change(&cell);
        let solid_change = self.solid_change(&cell, &fluid_change, solid_velocity);
        // f* = f + (1 - B) Ω + B Λ
        let change = fluid_change.times_plus(self.one - weight, &solid_change.times(weight));
        let [jx, jy, jz] = cell.sums.j;
        (change.added_to(f), [cell.sums.excess, jx, jy, jz, weight * inverse])
    }

    /// `B(min(1, epsilon))`
    #[inline(always)]
    fn weight_of(&self, epsilon: V) -> V {
        let epsilon = epsilon.min(self.one);
        match self.weighting {
            Weighting::SolidFraction => epsilon,
            // B = ε (τ - 1/2) / [(1 - ε) + (τ - 1/2)]
            Weighting::NobleTorczynski => {
                (epsilon * self.excess).over((self.one - epsilon) + self.excess)
            }
            // B = c ε (τ - 1/2) / [(1 - ε) + c ε (τ - 1/2)]
            Weighting::Viscous => {
                let solid = epsilon * self.viscous_excess;
                solid.over((self.one - epsilon) + solid)
            }
        }
    }

    /// Density less 1 and momentum.
    #[inline(always)]
    pub(super) fn sums(f: &[V; Q]) -> [V; 4] {
        let sums = Sums::of(f);
        let [jx, jy, jz] = sums.j;
        [sums.excess, jx, jy, jz]
    }

    #[inline(always)]
    fn cell(&self, f: &[V; Q]) -> Cell<V> {
        let sums = Sums::of(f);
        let rho = sums.excess + self.one;
        Cell { rho, inverse: self.one.over(rho), sums }
    }

    /// Relaxation and body force.
    #[inline(always)]
    fn fluid_change(&self, cell: &Cell<V>) -> Change<V> {
        match self.force {
            None => self.back(self.relaxed(cell, cell.sums.j)),
            Some(g) => {
                // ρu = j + G/2
                let [jx, jy, jz] = cell.sums.j;
                let [gx, gy, gz] = g;
                let forced = [
                    self.half.mul_add(gx, jx),
                    self.half.mul_add(gy, jy),
                    self.half.mul_add(gz, jz),
                ];
                self.back(self.driven(self.relaxed(cell, forced), g, forced, cell.inverse))
            }
        }
    }

    /// `-s (m - m_eq)/|row|²` where the equilibrium has the momentum `j`.
    #[inline(always)]
    fn relaxed(&self, cell: &Cell<V>, j: [V; 3]) -> Moments<V> {
        let sums = &cell.sums;
        let Sums { even, odd, .. } = sums;
        let [exy, exz, eyz] = sums.planes;
        let [jx, jy, jz] = j;
        let [ux, uy, uz] = scaled(j, cell.inverse);
        let (jjx, jjy, jjz) = (jx * ux, jy * uy, jz * uz);
        let jj = jjx + jjy + jjz;
        // e = -30 f_0 - 11 Σ_faces + 8 Σ_edges,  e_eq = -11 ρ + 19 j²/ρ
        let e =
            self.eight.mul_add(sums.edges, -self.eleven.mul_add(sums.faces, self.thirty * sums.f0));
        let e = e + self.eleven.mul_add(sums.excess, -(self.nineteen * jj));
        // ε = 12 f_0 - 4 Σ_faces + Σ_edges,  ε_eq = 3 ρ - 11/2 j²/ρ
        let eps = self.twelve.mul_add(sums.f0, sums.edges - self.four * sums.faces);
        let eps = eps + self.five_and_half.mul_add(jj, -(self.three * sums.excess));
        // 3 p_xx = (2 Σ_x - Σ_y - Σ_z) + (Σ_xy + Σ_xz - 2 Σ_yz), faces and edges; π_xx = -2 faces + edges
        let faces = self.two.mul_add(even.x, -(even.y + even.z));
        let edges = exy + exz - self.two * eyz;
        let pxx_eq = self.three.mul_add(jjx, -jj);
        let pxx = faces + edges - pxx_eq;
        let pixx = self.half.mul_add(pxx_eq, edges - self.two * faces);
        let (faces, edges) = (even.y - even.z, exy - exz);
        let pww_eq = jjy - jjz;
        let pww = faces + edges - pww_eq;
        let piww = self.half.mul_add(pww_eq, edges - self.two * faces);
        let pxy = (even.xy - even.x_y) - jx * uy;
        let pyz = (even.yz - even.y_z) - jy * uz;
        let pxz = (even.xz - even.x_z) - jx * uz;
        // q_x = -4 (f_x - f_-x) + Σ_edges,  q_eq = -2/3 j
        let [kx, ky, kz] = sums.along_edges;
        let qx = self.two_thirds.mul_add(jx, kx - self.four * odd.x);
        let qy = self.two_thirds.mul_add(jy, ky - self.four * odd.y);
        let qz = self.two_thirds.mul_add(jz, kz - self.four * odd.z);
        let [e_, eps_, nxx, pixx_, nww, piww_, nxy, q_, m_] = self.relax;
        let [mx, my, mz] = sums.third;
        Moments {
            e: e * e_,
            eps: eps * eps_,
            pxx: pxx * nxx,
            pixx: pixx * pixx_,
            pww: pww * nww,
            piww: piww * piww_,
            pxy: pxy * nxy,
            pyz: pyz * nxy,
            pxz: pxz * nxy,
            j: None,
            q: [qx * q_, qy * q_, qz * q_],
            m: [mx * m_, my * m_, mz * m_],
        }
    }

    /// The same with Guo's source: `(1 - s/2) M F`, the derivative of the equilibrium moments along `j -> G`.
    #[inline(always)]
    fn driven(&self, moments: Moments<V>, g: [V; 3], j: [V; 3], inverse: V) -> Moments<V> {
        let [gx, gy, gz] = g;
        let [ux, uy, uz] = scaled(j, inverse);
        let (ugx, ugy, ugz) = (ux * gx, uy * gy, uz * gz);
        let ug = ugx + ugy + ugz;
        let pxx = self.two * (self.three.mul_add(ugx, -ug));
        let pww = self.two * (ugy - ugz);
        let [e, eps, nxx, pixx, nww, piww, nxy, q, _] = self.drive;
        let (pxy, pyz, pxz) =
            (ux.mul_add(gy, uy * gx), uy.mul_add(gz, uz * gy), ux.mul_add(gz, uz * gx));
        let flux = self.two_thirds * q;
        let [qx, qy, qz] = moments.q;
        Moments {
            e: (self.thirty_eight * ug).mul_add(e, moments.e),
            eps: moments.eps - self.eleven * ug * eps,
            pxx: pxx.mul_add(nxx, moments.pxx),
            pixx: moments.pixx - self.half * pxx * pixx,
            pww: pww.mul_add(nww, moments.pww),
            piww: moments.piww - self.half * pww * piww,
            pxy: pxy.mul_add(nxy, moments.pxy),
            pyz: pyz.mul_add(nxy, moments.pyz),
            pxz: pxz.mul_add(nxy, moments.pxz),
            j: Some(scaled(g, self.tenth)),
            q: [qx - gx * flux, qy - gy * flux, qz - gz * flux],
            ..moments
        }
    }

    /// `Mᵀ` times moments that are divided by the squared lengths of their rows: `M⁻¹ m`.
    #[inline(always)]
    fn back(&self, moments: Moments<V>) -> Change<V> {
        let Moments { e, eps, pxx, pixx, pww, piww, pxy, pyz, pxz, .. } = moments;
        let rest = self.twelve.mul_add(eps, -(self.thirty * e));
        let face = -self.four.mul_add(eps, self.eleven * e);
        let edge = self.eight.mul_add(e, eps);
        // Faces: 2, -1, -1 of (3 p_xx - 2 π_xx) and 0, 1, -1 of (p_ww - 2 π_ww).
        let (xx, ww) = (pxx - self.two * pixx, pww - self.two * piww);
        let across = face - xx;
        // Edges: 1, 1, -2 of (3 p_xx + π_xx) and 1, -1, 0 of (p_ww + π_ww) in the planes xy, xz, yz.
        let (exx, eww) = (pxx + pixx, pww + piww);
        let beside = edge + exx;
        let (in_xy, in_xz) = (beside + eww, beside - eww);
        let in_yz = edge - self.two * exx;
        let even = Pair {
            x: self.two.mul_add(xx, face),
            y: across + ww,
            z: across - ww,
            xy: in_xy + pxy,
            x_y: in_xy - pxy,
            xz: in_xz + pxz,
            x_z: in_xz - pxz,
            yz: in_yz + pyz,
            y_z: in_yz - pyz,
        };
        let [qx, qy, qz] = moments.q;
        let [mx, my, mz] = moments.m;
        // Faces: j - 4 q; edges: j + q, and ± m.
        let (faces, [qx, qy, qz]) = match moments.j {
            None => ([-(self.four * qx), -(self.four * qy), -(self.four * qz)], [qx, qy, qz]),
            Some([jx, jy, jz]) => (
                [jx - self.four * qx, jy - self.four * qy, jz - self.four * qz],
                [jx + qx, jy + qy, jz + qz],
            ),
        };
        let (x_xy, x_xz) = (qx + mx, qx - mx);
        let (y_yz, y_xy) = (qy + my, qy - my);
        let (z_xz, z_yz) = (qz + mz, qz - mz);
        let odd = Pair {
            x: faces[0],
            y: faces[1],
            z: faces[2],
            xy: x_xy + y_xy,
            x_y: x_xy - y_xy,
            xz: x_xz + z_xz,
            x_z: x_xz - z_xz,
            yz: y_yz + z_yz,
            y_z: y_yz - z_yz,
        };
        Change { rest, even, odd }
    }

    /// `Lambda` of solids that move with `solid_velocity` here, `None` if they are at rest. It is linear in the
    /// equilibrium of each solid's velocity; what their squares add to that of the mean is put in afterwards, cell
    /// by cell (`meetings.rs`).
    #[inline(always)]
    fn solid_change(
        &self,
        cell: &Cell<V>,
        fluid_change: &Change<V>,
        solid_velocity: Option<[V; 3]>,
    ) -> Change<V> {
        let (face, edge) = (self.face * cell.rho, self.edge * cell.rho);
        if self.operator == SolidOperator::FullBounceBack {
            // Λ_a = f_-a - f_-a^eq(u_p) + f_a^eq(u_p) - f_a, all odd in c_a: -(f_a - f_-a) + 6 w ρ c·u_p
            let (face, edge) = (self.three * face, self.three * edge);
            let odd = match solid_velocity {
                None => cell.sums.odd.times(-self.one),
                Some(u_p) => {
                    let twice = self.along(face, edge, scaled(u_p, self.two));
                    cell.sums.odd.times_plus(-self.one, &twice)
                }
            };
            return Change { rest: self.zero, even: odd.times(self.zero), odd };
        }
        let u = scaled(cell.sums.j, cell.inverse);
        let fluid = self.squares(u);
        // f_eq(u_p) - f_eq(u), what is even in c_a: w ρ [9/2 ((c·u_p)² - (c·u)²) - 3/2 (u_p² - u²)]
        let (squares, square) = match solid_velocity {
            None => (fluid.along.times(-self.four_and_half), -fluid.all),
            Some(velocity) => {
                let solid = self.squares(velocity);
                let fluid_part = fluid.along.times(-self.four_and_half);
                (solid.along.times_plus(self.four_and_half, &fluid_part), solid.all - fluid.all)
            }
        };
        let drop = self.three * self.half * square;
        let even = Pair {
            x: face * (squares.x - drop),
            y: face * (squares.y - drop),
            z: face * (squares.z - drop),
            xy: edge * (squares.xy - drop),
            x_y: edge * (squares.x_y - drop),
            xz: edge * (squares.xz - drop),
            x_z: edge * (squares.x_z - drop),
            yz: edge * (squares.yz - drop),
            y_z: edge * (squares.y_z - drop),
        };
        let rest = self.rest_drop * cell.rho * square;
        let (face, edge) = (self.three * face, self.three * edge);
        if self.operator == SolidOperator::Superposition {
            // Λ_a = f_a^eq(u_p) - f_a^eq(u) + Ω_a, Ω being what relaxes at the bare velocity
            let omega = match self.force {
                None => *fluid_change,
                Some(_) => self.back(self.relaxed(cell, cell.sums.j)),
            };
            let [x, y, z] = match solid_velocity {
                None => [-u[0], -u[1], -u[2]],
                Some([x, y, z]) => [x - u[0], y - u[1], z - u[2]],
            };
            let odd = self.along(face, edge, [x, y, z]);
            return Change {
                rest: rest + omega.rest,
                even: even.times_plus(self.one, &omega.even),
                odd: odd.times_plus(self.one, &omega.odd),
            };
        }
        // Λ_a = f_-a - f_-a^eq(u) + f_a^eq(u_p) - f_a, what is odd in c_a: -(f_a - f_-a) + 3 w ρ c·(u + u_p)
        let [x, y, z] = match solid_velocity {
            None => u,
            Some([x, y, z]) => [x + u[0], y + u[1], z + u[2]],
        };
        let odd = self.along(face, edge, [x, y, z]);
        Change { rest, even, odd: cell.sums.odd.times_plus(-self.one, &odd) }
    }

    /// `c_a·v` times the factor of its kind.
    #[inline(always)]
    fn along(&self, face: V, edge: V, [x, y, z]: [V; 3]) -> Pair<V> {
        Pair {
            x: face * x,
            y: face * y,
            z: face * z,
            xy: edge * (x + y),
            x_y: edge * (x - y),
            xz: edge * (x + z),
            x_z: edge * (x - z),
            yz: edge * (y + z),
            y_z: edge * (y - z),
        }
    }

    /// `(c_a·v)²` of each pair, and `v²`.
    #[inline(always)]
    fn squares(&self, v: [V; 3]) -> Squares<V> {
        let c = self.along(self.one, self.one, v);
        let along = Pair {
            x: c.x * c.x,
            y: c.y * c.y,
            z: c.z * c.z,
            xy: c.xy * c.xy,
            x_y: c.x_y * c.x_y,
            xz: c.xz * c.xz,
            x_z: c.x_z * c.x_z,
            yz: c.yz * c.yz,
            y_z: c.y_z * c.y_z,
        };
        Squares { all: along.x + along.y + along.z, along }
    }
}

/// A cell before its collision.
struct Cell<V> {
    sums: Sums<V>,
    rho: V,
    /// `1/ρ`
    inverse: V,
}

/// Sums of the populations of a cell.
struct Sums<V> {
    f0: V,
    /// `f_a + f_-a`
    even: Pair<V>,
    /// `f_a - f_-a`
    odd: Pair<V>,
    /// Sums over the four edges in the planes xy, xz and yz.
    planes: [V; 3],
    faces: V,
    edges: V,
    /// `ρ - 1`
    excess: V,
    /// Momentum, and the part of it that edges carry.
    j: [V; 3],
    along_edges: [V; 3],
    /// `m_x, m_y, m_z`
    third: [V; 3],
}

impl<V: Lanes> Sums<V> {
    #[inline(always)]
    fn of(f: &[V; Q]) -> Self {
        let (even, odd) = (Pair::sums(f), Pair::differences(f));
        let (exy, exz, eyz) = (even.xy + even.x_y, even.xz + even.x_z, even.yz + even.y_z);
        let faces = even.x + even.y + even.z;
        let edges = exy + exz + eyz;
        // The parts of the momentum that the edges carry, plane by plane.
        let (x_xy, y_xy) = (odd.xy + odd.x_y, odd.xy - odd.x_y);
        let (x_xz, z_xz) = (odd.xz + odd.x_z, odd.xz - odd.x_z);
        let (y_yz, z_yz) = (odd.yz + odd.y_z, odd.yz - odd.y_z);
        let [kx, ky, kz] = [x_xy + x_xz, y_xy + y_yz, z_xz + z_yz];
        Sums {
            f0: f[0],
            even,
            odd,
            planes: [exy, exz, eyz],
            faces,
            edges,
            excess: f[0] + faces + edges,
            j: [odd.x + kx, odd.y + ky, odd.z + kz],
            along_edges: [kx, ky, kz],
            third: [x_xy - x_xz, y_yz - y_xy, z_xz - z_yz],
        }
    }
}

/// Moments that change in a collision, divided by the squared lengths of their rows of `M`.
#[derive(Clone, Copy)]
struct Moments<V> {
    e: V,
    eps: V,
    pxx: V,
    pixx: V,
    pww: V,
    piww: V,
    pxy: V,
    pyz: V,
    pxz: V,
    /// Momentum, which only a body force changes.
    j: Option<[V; 3]>,
    q: [V; 3],
    m: [V; 3],
}

struct Squares<V> {
    along: Pair<V>,
    all: V,
}
