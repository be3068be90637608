"""Permeability of voxel images by finite differences: a Stokes solver on a staggered (MAC) grid.

Run:  python stokes.py check                  (plane channel and square duct against the exact flow)
      python stokes.py spheres.npy 1 2 3      (one image, with 1, 2 and 3 cells along each voxel edge)
      python stokes.py spheres.npy rest 1 2   (with ends that resist the flow, as those of poromics do)

Rows for independent.csv go to the standard output, remarks to the standard error. The last row is the
value for an infinitely fine grid, by k(h) = k0 + c h^q through the last three values (h = cell width).

Needs numpy, scipy and numba. An image is an array [x, y, z], 1 = solid, 0 = pore. It shares no code
with psmrt and no lattice Boltzmann method.

Equations (viscosity and cell width 1):  -laplace(u) + grad(p) = 0,  div(u) = 0.
Velocities are on the cell faces, pressures in the cell centres. On the faces of solid voxels the
normal velocity is 0; where both cells beside a face are solid, the wall is half a cell away from
the tangential velocity of the next face (ghost value -u). The sides y and z are periodic. At the
planes x = 0 and x = nx the pressure is given (1 and 0) and d/dx of all velocities is 0.
With `rest` the pressure is lower than the given one by REST * u in each end plane (and higher at the
outlet), and the tangential velocities are held back there, as by a wall; k then comes from the mean
pressures inside the end planes. This is only for the comparison with poromics (see other_code.py).
The equations form one symmetric system, which is solved by the MINRES method.
Permeability: k = viscosity * U * L / pressure difference, where U is the flux over the whole cross-section.
"""
import sys
import time
from pathlib import Path

import numpy as np
from numba import njit
from scipy.sparse import coo_matrix

CLEAR = 6   # clear voxels at each x end of an image
REST = 6    # the jump of the density by 3 J in poromics is a pressure 6 u, viscosity and cell width 1


def build(solid, rest=False):
    """Matrix [[A, G], [G^T, 0]], right-hand side and the numbers of the unknowns (-1 = none)."""
    nx, ny, nz = solid.shape
    pore = ~solid.astype(bool)
    # Which faces hold a velocity: both cells beside the face are pore. x faces: nx + 1 planes.
    face = [np.concatenate([pore[:1], pore[1:] & pore[:-1], pore[-1:]]),
            pore & np.roll(pore, 1, 1), pore & np.roll(pore, 1, 2)]
    # Which faces are inside the solid (both cells solid).
    inside = [np.concatenate([~pore[:1], ~pore[1:] & ~pore[:-1], ~pore[-1:]]),
              ~pore & ~np.roll(pore, 1, 1), ~pore & ~np.roll(pore, 1, 2)]
    number, count = [], 0
    for exists in face + [pore]:
        n = np.full(exists.shape, -1)
        m = np.count_nonzero(exists)
        n[exists] = np.arange(count, count + m)
        count += m
        number.append(n)
    pnum = number[3]
    rows, cols, vals = [], [], []
    diagonal, rhs = np.zeros(count), np.zeros(count)

    def add(r, c, v):
        keep = (r >= 0) & (c >= 0)
        rows.append(r[keep]), cols.append(c[keep]), vals.append(np.broadcast_to(v, r.shape)[keep])

    for comp in range(3):
        num = number[comp]
        # A face in the plane x = 0 or x = nx has half a cell: its equation is halved.
        half = np.ones(num.shape)
        if comp == 0:
            half[0] = half[-1] = 0.5
        # Viscous terms, towards the lower and the upper neighbour along each axis.
        for axis in range(3):
            for side in (1, -1):
                neighbour, wall = np.roll(num, side, axis), np.roll(inside[comp], side, axis)
                weight = np.ones(num.shape) if axis == 0 else half.copy()
                if axis == 0:                # d/dx = 0 at both ends
                    end = 0 if side == 1 else -1
                    weight[end], neighbour[end], wall[end] = 0, -1, False
                own = num >= 0
                diagonal[num[own]] += (weight * np.where(wall, 2, 1))[own]
                add(num, neighbour, -weight)
        # Pressure gradient and, by symmetry, the divergence.
        if comp == 0:
            add(num[:-1], pnum, 1.0), add(pnum, num[:-1], 1.0)
            add(num[1:], pnum, -1.0), add(pnum, num[1:], -1.0)
            rhs[num[0][num[0] >= 0]] = 1.0   # pressure 1 at x = 0, pressure 0 at x = nx
        else:
            lower = np.roll(pnum, 1, comp)
            add(num, pnum, 1.0), add(pnum, num, 1.0)
            add(num, lower, -1.0), add(lower, num, -1.0)
    if rest:
        for n, resistance in zip(number, (REST, 2, 2)):
            for plane in (n[0], n[-1]):
                diagonal[plane[plane >= 0]] += resistance
    v = np.arange(pnum[pore].min())
    rows.append(v), cols.append(v), vals.append(diagonal[v])
    matrix = coo_matrix((np.concatenate(vals).astype(np.float32), (np.concatenate(rows), np.concatenate(cols))),
                        shape=(count, count)).tocsr()
    return matrix, rhs, number, diagonal


@njit(fastmath=True)
def multiply(indptr, indices, data, x, y):
    dot = 0.0
    for i in range(y.size):
        s = 0.0
        for j in range(indptr[i], indptr[i + 1]):
            s += data[j] * x[indices[j]]
        y[i] = s
        dot += s * x[i]
    return dot


@njit(fastmath=True)
def lanczos(y, r1, r2, inv, a, b):
    """y += a*r1 + b*r2; give y . inv*y"""
    dot = 0.0
    for i in range(y.size):
        y[i] += a * r1[i] + b * r2[i]
        dot += y[i] * y[i] * inv[i]
    return dot


@njit(fastmath=True)
def update(x, v, w1, w2, a, b, c, phi):
    """w1 becomes the new direction (v + a*w1 + b*w2)*c; x += phi*w1"""
    for i in range(x.size):
        w1[i] = (v[i] + a * w1[i] + b * w2[i]) * c
        x[i] += phi * w1[i]


def solve(solid, start=None, rest=False, tolerance=1e-6, every=50, most=20000):
    """Flux through the planes x, in cells^2 per unit (pressure / viscosity), and the fields."""
    matrix, rhs, number, diagonal = build(solid, rest)
    ptr, idx, val = matrix.indptr, matrix.indices, matrix.data
    planes = number[0]
    inv = np.where(diagonal > 0, 1 / np.maximum(diagonal, 1), 5.0)  # preconditioner
    x = np.zeros(rhs.size) if start is None else start(number, rhs.size)
    # MINRES after Paige and Saunders (1975).
    y = np.empty_like(rhs)
    multiply(ptr, idx, val, x, y)
    r2 = rhs - y
    r1 = np.zeros_like(rhs)
    beta = np.sqrt(np.sum(r2 * r2 * inv))
    oldb, dbar, epsln, phibar, cs, sn = 0.0, 0.0, 0.0, beta, -1.0, 0.0
    w1, w2 = np.zeros_like(rhs), np.zeros_like(rhs)
    last = 0.0
    for it in range(1, most + 1):
        v = inv * r2 / beta
        y = np.empty_like(rhs) if it == 1 else r1_free
        alpha = multiply(ptr, idx, val, v, y)
        new = np.sqrt(lanczos(y, r1, r2, inv, -beta / oldb if it > 1 else 0.0, -alpha / beta))
        r1_free, r1, r2 = r1, r2, y
        oldb, beta = beta, new
        oldeps, delta = epsln, cs * dbar + sn * alpha
        gbar, epsln, dbar = sn * dbar - cs * alpha, sn * beta, -cs * beta
        gamma = np.hypot(gbar, beta)
        cs, sn = gbar / gamma, beta / gamma
        phi, phibar = cs * phibar, sn * phibar
        update(x, v, w1, w2, -oldeps, -delta, 1 / gamma, phi)
        w1, w2 = w2, w1
        if it % every == 0:
            flux = np.where(planes >= 0, x[planes], 0).sum(axis=(1, 2))
            mean = flux.mean()
            spread = np.ptp(flux) / abs(mean)
            if abs(mean - last) < tolerance * abs(mean) and spread < 3e-5:
                break
            last = mean
    return mean, spread, it, [np.where(n >= 0, x[n], 0) for n in number]


def refined_start(fields, old, new):
    """A start from the fields of a grid with `old` cells per voxel for one with `new`."""
    def start(number, size):
        x = np.zeros(size)
        for comp, (n, f) in enumerate(zip(number, fields)):
            at = [np.arange(m) * old // new for m in n.shape]
            f = f[np.ix_(*at)] * ((new / old) if comp < 3 else 1)
            x[n[n >= 0]] = f[n >= 0]
        return x
    return start


def order(k, h):
    """Solve k(h) = k0 + c * h**q for three widths h (falling); give k0 and q."""
    low, high = 0.05, 6.0
    def mismatch(q):
        return (k[0] - k[1]) * (h[1]**q - h[2]**q) - (k[1] - k[2]) * (h[0]**q - h[1]**q)
    for _ in range(80):
        mid = (low + high) / 2
        low, high = (mid, high) if mismatch(mid) * mismatch(low) > 0 else (low, mid)
    return k[2] - (k[1] - k[2]) / ((h[1] / h[2])**low - 1), low


def permeability(image, cells, fields=None, before=1, rest=False):
    """k in voxels^2 with `cells` cells along each voxel edge."""
    solid = image.astype(bool)
    for axis in range(3):
        solid = np.repeat(solid, cells, axis)
    length = (image.shape[0] - 2 * CLEAR) * cells
    area = solid.shape[1] * solid.shape[2]
    start = refined_start(fields, before, cells) if fields else None
    flux, spread, iterations, fields = solve(solid, start, rest)
    difference = 1 - 2 * REST * flux / area if rest else 1
    return flux / area * length / difference / cells**2, spread, iterations, fields


def check():
    """Channel between plates and square duct, of width 8, 16, 32 cells; exact flux per dp/L/viscosity."""
    for name, exact in (("plates", 1 / 12), ("duct", 0.0351443)):
        for a in (8, 16, 32):
            solid = np.zeros((6, a + 2, a + 2 if name == "duct" else 2), bool)
            solid[:, [0, -1]] = True
            if name == "duct":
                solid[:, :, [0, -1]] = True
            flux, spread, it, _ = solve(solid)
            value = flux * 6 / (a**4 if name == "duct" else 2 * a**3)
            print(f"{name} {a:3d} cells: {value:.7f}, exact {exact:.7f}, error {value / exact - 1:+.2e}, "
                  f"spread of the flux {spread:.0e}, {it} iterations")


def main(path, cells, rest=False):
    image = np.load(path)
    name, porosity = Path(path).stem, 1 - image[CLEAR:-CLEAR].mean()

    def row(c, k):
        print(f"{name},finite_differences{'_resting_ends' if rest else ''},{c},{k:.6f},{porosity:.4f}", flush=True)

    ks, fields, before = [], None, 1
    for c in cells:
        t = time.time()
        k, spread, it, fields = permeability(image, c, fields, before, rest)
        before = c
        ks.append(k)
        print(f"{name}, {c} cells: spread of the flux {spread:.0e}, {it} iterations, {time.time() - t:.0f} s",
              file=sys.stderr, flush=True)
        row(c, k)
    if len(cells) >= 3:
        k0, q = order(ks[-3:], [1 / c for c in cells[-3:]])
        print(f"{name}: order {q:.2f} from {cells[-3:]} cells", file=sys.stderr)
        row("inf", k0)


if __name__ == "__main__":
    if sys.argv[1] == "check":
        check()
    else:
        main(sys.argv[1], [int(c) for c in sys.argv[2:] if c != "rest"], "rest" in sys.argv)
