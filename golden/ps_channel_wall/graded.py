"""Where a plane wall of graded viscosity lies in Poiseuille flow: the steady state of the populations, solved for.

A periodic column of 3 + 8 + 3 cells of D3Q19 along z; the first and last three cells are solid, the outermost two of the
eight are filled to a fraction s. A body force G drives the fluid along x, slowly: all is linear in G, and the density is 1.
In the steady state each population has come from the neighbour, f_a(z + c_az) = f*_a(z): 14 x 19 linear equations.

Fluid: f* = f + C (f_eq(u) - f) + (1 - C/2) S(G), with f_eq = w (1 + 3 c.u) and S = 3 w c.G, u = j + G/2. C relaxes with
one rate (SRT), with one rate for what is even and one for what is odd in c (TRT), or has the rates of d'Humieres et al.,
Phil. Trans. R. Soc. A 360, 437 (2002), for the polynomials in c that they name, made orthogonal here by a QR
decomposition (MRT_rec).

A cell that is filled to e (reference/src/graded_viscosity.rs): the same with F = (1 - B) G - 2 B j for G,
B = k e/(1 - e + k e), k = (tau - 1/2)^2/(4 (tau - 1/2) + 0.4), and two rates: with x = (tau - 1/2)/(1 - e) what is even
relaxes with 1/(x + 1/2), what is odd with 1/(0.002/x + 1/2). No matrix of moments is needed for it. A full cell (x without
bound) keeps what is even and turns round what is odd.

Columns as in literature.csv: the parabola through the second and the fourth of the eight cells gives the curvature over
G/nu and the displacement outward of its zero; the flow rate is the sum of j + (1 - B) G/2 over half the column.

    python3 golden/ps_channel_wall/graded.py > golden/ps_channel_wall/graded.csv
"""

import numpy as np

C = np.array([(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if abs(x) + abs(y) + abs(z) < 3])
W = np.array([{0: 1 / 3, 1: 1 / 18, 2: 1 / 36}[int(np.abs(c).sum())] for c in C])
OPPOSITE = np.array([next(b for b in range(19) if (C[b] == -C[a]).all()) for a in range(19)])
IDENTITY = np.eye(19)
TURN = IDENTITY[OPPOSITE]
EVEN, ODD = (IDENTITY + TURN) / 2, (IDENTITY - TURN) / 2
SOLID, OPEN = 3, 8
G = 1.0


def dhumieres(tau):
    """The relaxation matrix with d'Humieres' rates."""
    x, y, z = C.T.astype(float)
    r = x * x + y * y + z * z
    stress = 1 / tau
    families = [
        ([np.ones(19)], 0.0), ([r], 1.19), ([r * r], 1.4), ([x, y, z], 0.0), ([r * x, r * y, r * z], 1.2),
        ([3 * x * x - r, y * y - z * z, x * y, y * z, x * z], stress),
        ([r * (3 * x * x - r), r * (y * y - z * z)], 1.4),
        ([x * (y * y - z * z), y * (z * z - x * x), z * (x * x - y * y)], 1.98),
    ]
    rows = np.array([row for rows, _ in families for row in rows])
    rates = np.array([rate for rows, rate in families for _ in rows])
    basis, _ = np.linalg.qr(rows.T)
    return basis @ np.diag(rates) @ basis.T


def two_rates(even, odd):
    return even * EVEN + odd * ODD


def collision(relaxation, taken, given):
    """Matrix and vector of f -> f* where the force along x is given - taken j."""
    j = C[:, 0].astype(float)[None, :]
    drive = (3 * W * C[:, 0])[:, None]
    # f_eq less its part at rest is 3 w c.u with u = j + F/2; the populations are deviations from w.
    force_of_f, velocity_of_f = -taken * j, j - taken / 2 * j
    half = IDENTITY - relaxation / 2
    matrix = IDENTITY + relaxation @ (drive @ velocity_of_f - IDENTITY) + half @ drive @ force_of_f
    vector = (relaxation @ drive * given / 2 + half @ drive * given)[:, 0]
    return matrix, vector


def wall(tau, name, fraction):
    """Curvature over G/nu, displacement outward, error of the flow rate."""
    excess = tau - 0.5
    fluid = {
        "SRT": two_rates(1 / tau, 1 / tau),
        "TRT_3/16": two_rates(1 / tau, 1 / (3 / 16 / excess + 0.5)),
        "MRT_rec": dhumieres(tau),
    }[name]
    k = excess**2 / (4 * excess + 0.4)
    filled = [1.0] * SOLID + [fraction] + [0.0] * (OPEN - 2) + [fraction] + [1.0] * SOLID
    cells = len(filled)
    weights = [k * e / (1 - e + k * e) for e in filled]
    equations, right = np.zeros((19 * cells, 19 * cells)), np.zeros(19 * cells)
    for z, (e, weight) in enumerate(zip(filled, weights)):
        if e == 0:
            relaxation = fluid
        elif e == 1:
            relaxation = two_rates(0.0, 2.0)
        else:
            x = excess / (1 - e)
            relaxation = two_rates(1 / (x + 0.5), 1 / (0.002 / x + 0.5))
        matrix, vector = collision(relaxation, 2 * weight, (1 - weight) * G)
        for a in range(19):
            row = 19 * ((z + C[a, 2]) % cells) + a
            equations[row, row] += 1
            equations[row, 19 * z : 19 * z + 19] -= matrix[a]
            right[row] = vector[a]
    # What the flow says nothing about (the mass, what runs along the walls) stays at 0: the least solution.
    f, *_ = np.linalg.lstsq(equations, right, rcond=1e-12)
    assert np.abs(equations @ f - right).max() < 1e-9
    j = f.reshape(cells, 19) @ C[:, 0]
    nu, half_gap = excess / 3, OPEN / 2 - fraction
    u = lambda cell: j[cell] + G / 2
    near, far = SOLID + OPEN // 2 - 1, SOLID + 1
    z_near, z_far = (SOLID + OPEN / 2 - (cell + 0.5) for cell in (near, far))
    bend = (u(near) - u(far)) / (z_far**2 - z_near**2)
    top = u(near) + bend * z_near**2
    half = range(SOLID + OPEN // 2)
    flow = sum(j[cell] for cell in half) + G / 2 * sum(1 - weights[cell] for cell in half)
    return bend / (G / (2 * nu)), (top / bend) ** 0.5 - half_gap, flow / (G * half_gap**3 / (3 * nu)) - 1


def main():
    print("# Where a plane wall of graded viscosity lies in Poiseuille flow: displacement outward, in cells.")
    print("# Made by: python3 golden/ps_channel_wall/graded.py, an independent computation (the steady populations, solved")
    print("# for; numpy). Columns and channel as in literature.csv.")
    print("tau,fluid_collision,weight_B,solid_operator,wall_offset_in_cell,curvature_over_exact,"
          "wall_displacement_outward_cells,flow_rate_error_H8minus2s")
    for tau in (0.51, 0.55, 0.6, 0.8, 1.0, 1.5):
        for name in ("SRT", "TRT_3/16", "MRT_rec"):
            for fraction in (0.0, 0.25, 0.5, 0.75):
                values = ",".join(f"{value:.5f}" for value in wall(tau, name, fraction))
                print(f"{tau},{name},graded,graded,{fraction},{values}")


if __name__ == "__main__":
    main()
