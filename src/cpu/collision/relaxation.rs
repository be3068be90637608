//! Moments: how they relax, what a body force adds, and the change of the populations that is left of it.
//!
//! Each of d'Humières' moments is either even or odd in `c_a`, so half of `M` is sums of sums and the other half sums of
//! differences.

use super::pairs::{Change, Pair, Sums};
use super::{Cell, Collider, scaled};
use crate::lanes::Lanes;

/// Moments that change in a collision, divided by the squared lengths of their rows of `M`.
#[derive(Clone, Copy)]
pub(super) struct Moments<V> {
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

impl<V: Lanes> Moments<V> {
    #[inline(always)]
    pub(super) fn times(&self, factor: V) -> Self {
        #[expect(clippy::manual_map, reason = "a closure may be compiled without the vectors")]
        let j = match self.j {
            None => None,
            Some(j) => Some(scaled(j, factor)),
        };
        Moments {
            e: self.e * factor,
            eps: self.eps * factor,
            pxx: self.pxx * factor,
            pixx: self.pixx * factor,
            pww: self.pww * factor,
            piww: self.piww * factor,
            pxy: self.pxy * factor,
            pyz: self.pyz * factor,
            pxz: self.pxz * factor,
            j,
            q: scaled(self.q, factor),
            m: scaled(self.m, factor),
        }
    }

    /// `self * factor + summand`; momentum is that of `summand`.
    #[inline(always)]
    pub(super) fn times_plus(&self, factor: V, summand: &Self) -> Self {
        let [qx, qy, qz] = self.q;
        let [mx, my, mz] = self.m;
        Moments {
            e: self.e.mul_add(factor, summand.e),
            eps: self.eps.mul_add(factor, summand.eps),
            pxx: self.pxx.mul_add(factor, summand.pxx),
            pixx: self.pixx.mul_add(factor, summand.pixx),
            pww: self.pww.mul_add(factor, summand.pww),
            piww: self.piww.mul_add(factor, summand.piww),
            pxy: self.pxy.mul_add(factor, summand.pxy),
            pyz: self.pyz.mul_add(factor, summand.pyz),
            pxz: self.pxz.mul_add(factor, summand.pxz),
            j: summand.j,
            q: [
                qx.mul_add(factor, summand.q[0]),
                qy.mul_add(factor, summand.q[1]),
                qz.mul_add(factor, summand.q[2]),
            ],
            m: [
                mx.mul_add(factor, summand.m[0]),
                my.mul_add(factor, summand.m[1]),
                mz.mul_add(factor, summand.m[2]),
            ],
        }
    }
}

impl<V: Lanes> Collider<V> {
    /// The change of the moments by relaxation and body force.
    #[inline(always)]
    pub(super) fn moments(&self, cell: &Cell<V>) -> Moments<V> {
        match self.force {
            None => self.relaxed(cell, cell.sums.j, &self.relax),
            Some(g) => {
                let driven = self.half_way(cell, g);
                let moments = self.relaxed(cell, driven, &self.relax);
                self.driven(&moments, g, driven, cell.inverse, &self.drive)
            }
        }
    }

    /// The momentum half-way through a collision in which `g` is added to it.
    #[inline(always)]
    pub(super) fn half_way(&self, cell: &Cell<V>, [gx, gy, gz]: [V; 3]) -> [V; 3] {
        // ρu = j + G/2
        let [jx, jy, jz] = cell.sums.j;
        [self.half.mul_add(gx, jx), self.half.mul_add(gy, jy), self.half.mul_add(gz, jz)]
    }

    /// `-s (m - m_eq)/|row|²` where the equilibrium has the momentum `j`; `relax` has the `-s/|row|²`.
    #[inline(always)]
    pub(super) fn relaxed(&self, cell: &Cell<V>, j: [V; 3], relax: &[V; 9]) -> Moments<V> {
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
        let [e_, eps_, nxx, pixx_, nww, piww_, nxy, q_, m_] = *relax;
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

    /// The same with Guo's source: `(1 - s/2) M F`, `drive` having the `(1 - s/2)/|row|²`: the derivative of the equilibrium moments along `j -> G`.
    #[inline(always)]
    pub(super) fn driven(
        &self,
        moments: &Moments<V>,
        g: [V; 3],
        j: [V; 3],
        inverse: V,
        drive: &[V; 9],
    ) -> Moments<V> {
        let [gx, gy, gz] = g;
        let [ux, uy, uz] = scaled(j, inverse);
        let (ugx, ugy, ugz) = (ux * gx, uy * gy, uz * gz);
        let ug = ugx + ugy + ugz;
        let pxx = self.two * (self.three.mul_add(ugx, -ug));
        let pww = self.two * (ugy - ugz);
        let [e, eps, nxx, pixx, nww, piww, nxy, q, _] = *drive;
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
            ..*moments
        }
    }

    /// `Mᵀ` times moments that are divided by the squared lengths of their rows: `M⁻¹ m`.
    #[inline(always)]
    pub(super) fn back(&self, moments: &Moments<V>) -> Change<V> {
        let Moments { e, eps, pxx, pixx, pww, piww, pxy, pyz, pxz, .. } = *moments;
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
}
